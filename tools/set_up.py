"""Makes the environment for ``make``: system packages where they are missing, then the project itself.

Uses the standard library only. Where it may not install system packages, it says in one line what to run.
"""

from __future__ import annotations

import ctypes
import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXTRAS = "dev"
LIBRARIES = {  # what Open3D and Qt load, and the package of Debian and Ubuntu that brings it
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libX11.so.6": "libx11-6",
    "libusb-1.0.so.0": "libusb-1.0-0",
    "libgomp.so.1": "libgomp1",
    "libstdc++.so.6": "libstdc++6",
    "libxkbcommon.so.0": "libxkbcommon0",
    "libdbus-1.so.3": "libdbus-1-3",
    "libfontconfig.so.1": "libfontconfig1",
    "libglib-2.0.so.0": "libglib2.0-0",
}
WINDOW_LIBRARIES = {  # what Qt's own windows need beside them; offscreen work does without
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-shape.so.0": "libxcb-shape0",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
}
WINDOW_PROGRAMS = {"Xvfb": "xvfb", "xauth": "xauth"}  # a screen for the tests of the window


def main(folder: str) -> int:
    """Set up ``folder``; 0 when ready, 1 with one line on stderr when not."""
    missing = missing_packages()
    wanted = missing_window_packages()
    if (missing or wanted) and not install_packages([*missing, *wanted]) and missing:
        return say(
            "Floorcast needs system packages that only an administrator can install; run: "
            f"sudo apt-get install -y --no-install-recommends {' '.join(missing)}   and then make again."
        )
    python = make_environment(ROOT / folder)
    if python is None:
        return say(f"Python could not make a virtual environment in {folder}; see its message above.")
    return install_project(python)


def say(line: str) -> int:
    """One line on stderr; returns the status of a failure."""
    sys.stderr.write(line + "\n")
    return 1


def missing_packages() -> list[str]:
    """Names of the system packages that are needed and not there."""
    if not sys.platform.startswith("linux"):
        return []
    packages = [package for library, package in LIBRARIES.items() if not loads(library)]
    if not all(importlib.util.find_spec(module) for module in ("venv", "ensurepip")):
        packages.append(f"python3.{sys.version_info.minor}-venv")
    return packages


def missing_window_packages() -> list[str]:
    """Names of the packages without which there are no windows, but everything else."""
    if not sys.platform.startswith("linux"):
        return []
    libraries = [package for library, package in WINDOW_LIBRARIES.items() if not loads(library)]
    return libraries + [package for name, package in WINDOW_PROGRAMS.items() if not shutil.which(name)]


def loads(library: str) -> bool:
    """True where the system's loader finds ``library``."""
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def install_packages(packages: list[str]) -> bool:
    """Install ``packages`` with apt, where that is possible without asking for a password."""
    prefix = privilege()
    if prefix is None or not shutil.which("apt-get"):
        return False
    sys.stderr.write(f"Installing system packages: {' '.join(packages)}\n")
    apt = [*prefix, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-qq", "-o", "Acquire::Retries=3"]
    run([*apt, "update"])  # a failure shows up in the next line
    return run([*apt, "install", "-y", "--no-install-recommends", *packages])


def privilege() -> list[str] | None:
    """What to put before a command so that it runs as root; None where that is not possible."""
    if os.geteuid() == 0:
        return []
    if shutil.which("sudo") and run(["sudo", "-n", "true"], quiet=True):
        return ["sudo", "-n"]
    return None


def make_environment(folder: Path) -> Path | None:
    """A virtual environment of this Python in ``folder``; returns its interpreter."""
    python = folder / "bin" / "python"
    version = f"import sys; sys.exit(sys.version_info[:2] != {sys.version_info[:2]!r})"
    if python.exists() and run([str(python), "-c", f"import pip; {version}"], quiet=True):
        return python
    return python if run([sys.executable, "-m", "venv", "--clear", str(folder)]) else None


def install_project(python: Path) -> int:
    """Install Floorcast with its pinned dependencies into the environment of ``python``."""
    sys.stderr.write(
        "Installing Floorcast and what it needs (about 650 MB, some minutes the first time) ...\n"
    )
    pip = [str(python), "-m", "pip", "--disable-pip-version-check", "install", "--quiet", "--retries", "5"]
    if not run([*pip, "--editable", f".[{EXTRAS}]"]):
        return say(
            "pip could not install the dependencies (see above); check the network and run make again."
        )
    return 0


def run(command: list[str], *, quiet: bool = False) -> bool:
    """True where ``command`` succeeds; it gets no input, so that nothing ever waits for an answer."""
    output = subprocess.DEVNULL if quiet else sys.stderr
    try:
        done = subprocess.run(
            command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=output, stderr=output, check=False
        )
    except OSError as error:
        say(f"{command[0]}: {error.strerror}")
        return False
    return done.returncode == 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else ".venv"))

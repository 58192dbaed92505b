"""The set-up says in one line what to run where it may not install system packages itself."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

TOOLS = Path(__file__).resolve().parents[1] / "tools"


@pytest.fixture
def set_up() -> ModuleType:
    spec = importlib.util.spec_from_file_location("set_up", TOOLS / "set_up.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def commands(set_up: ModuleType, monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """The commands that would be run; sudo asks for a password, everything else succeeds."""
    asked: list[list[str]] = []

    def run(command: list[str], *, quiet: bool = False) -> bool:
        asked.append(command)
        return command[0] != "sudo"

    monkeypatch.setattr(set_up, "run", run)
    return asked


linux_only = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="system packages are Linux's")


@linux_only
def test_without_the_right_to_install_one_line_says_what_to_run(
    set_up: ModuleType,
    commands: list[list[str]],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(set_up, "loads", lambda library: library not in ("libGL.so.1", "libgomp.so.1"))
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    assert set_up.main("nowhere") == 1
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert "sudo apt-get install -y --no-install-recommends libgl1 libgomp1" in err
    assert all(command[0] == "sudo" for command in commands)


@linux_only
def test_root_installs_what_is_missing_and_nothing_else(
    set_up: ModuleType, commands: list[list[str]], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(set_up, "loads", lambda library: library != "libusb-1.0.so.0")
    monkeypatch.setattr(set_up, "missing_window_packages", list)
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setattr(set_up.shutil, "which", lambda name: f"/usr/bin/{name}")
    assert set_up.main(str(tmp_path / "venv")) == 0
    apt = [c for c in commands if "apt-get" in c]
    assert [c[c.index("apt-get") + 4] for c in apt] == ["update", "install"]
    assert apt[1][-1] == "libusb-1.0-0" and "libgl1" not in apt[1]
    assert commands[-1][-2:] == ["--editable", ".[dev]"]


@linux_only
def test_without_what_windows_need_everything_else_goes_on(
    set_up: ModuleType, commands: list[list[str]], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(set_up, "loads", lambda library: "xcb" not in library)
    monkeypatch.setattr(os, "geteuid", lambda: 1000)  # and sudo asks for a password
    assert "libxcb-cursor0" in set_up.missing_window_packages()
    assert set_up.main(str(tmp_path / "venv")) == 0
    assert commands[-1][-2:] == ["--editable", ".[dev]"]


@linux_only
def test_a_python_without_venv_needs_its_package(set_up: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(set_up, "loads", lambda library: True)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "ensurepip" else find(name))
    assert set_up.missing_packages() == [f"python3.{sys.version_info.minor}-venv"]


def test_a_machine_without_a_fitting_python(tmp_path: Path) -> None:
    (tmp_path / "python3").write_text("#!/bin/sh\nexit 1\n")  # the stub of a version manager
    (tmp_path / "python3").chmod(0o755)
    os.symlink("/usr/bin/dirname", tmp_path / "dirname")
    done = subprocess.run(
        ["/bin/sh", str(TOOLS / "set_up.sh"), "x"],
        env={"PATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1 and "needs Python 3.11 to 3.14" in done.stderr

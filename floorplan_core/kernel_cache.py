"""Where compiled kernels are kept: one folder for each state of the sources that hold kernels.

Numba looks at the file of a kernel only; when a function inlined from another file changes, it goes on
with the stale machine code. A folder named by the digest of all these sources cannot be stale; it also works
where the package itself cannot be written. ``NUMBA_CACHE_DIR`` in the environment wins.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

_HOMES = ("geometry", "stages", "readers", "simulation")  # the packages that hold kernels
_KEPT = 3  # folders of earlier states that stay


def use_kernel_cache() -> None:
    """Point numba to the folder of this state of the sources; called before the first kernel is defined."""
    if "NUMBA_CACHE_DIR" in os.environ:
        return
    folder = _cache_root() / source_digest()
    try:
        if not folder.exists():
            folder.mkdir(parents=True)
            _forget_old(folder)
    except OSError:
        return  # numba finds a place itself
    os.environ["NUMBA_CACHE_DIR"] = str(folder)
    if "numba" in sys.modules:  # it has read the environment already
        sys.modules["numba"].config.CACHE_DIR = str(folder)


def kernels_compiled() -> bool:
    """True where an earlier run left compiled kernels of this state of the sources."""
    folder = os.environ.get("NUMBA_CACHE_DIR")
    return folder is not None and next(Path(folder).rglob("*.nbi"), None) is not None


def on_first_compilation(tell: Callable[[], None]) -> None:
    """Call ``tell`` once, when a kernel is first compiled, not read from the cache; perhaps from a thread."""
    from numba.core import event

    class First(event.Listener):  # type: ignore[misc]  # numba has no types
        told = False

        def on_start(self, event: object) -> None:
            if not self.told:
                self.told = True
                tell()

        def on_end(self, event: object) -> None:
            pass

    event.register("numba:compile", First())


def import_numba() -> None:
    """Import numba with its array functions, but not ``scipy.linalg``, which takes as long as all the rest.

    Numba imports it only to see that it is there; a kernel that needs it imports it again. None of ours does.
    """
    names = ("scipy.linalg", "scipy.linalg.cython_blas")
    if "numba.np.arraymath" in sys.modules or "scipy.linalg" in sys.modules:
        return
    import numba  # before the stand-ins: it imports scipy itself

    stand_ins = {name: ModuleType(name) for name in names}
    sys.modules.update(stand_ins)
    try:
        import numba.np.arraymath  # noqa: F401
    finally:
        for name, module in stand_ins.items():
            if sys.modules.get(name) is module:
                del sys.modules[name]


def source_digest() -> str:
    """12 hexadecimal digits of all sources that hold kernels."""
    package, digest = Path(__file__).parent, hashlib.sha1(usedforsecurity=False)
    for home in _HOMES:
        for path in sorted((package / home).glob("*.py")):
            if b"njit" in (text := path.read_bytes()):
                digest.update(path.name.encode() + text)
    return digest.hexdigest()[:12]


def _cache_root() -> Path:
    from platformdirs import user_cache_dir

    return Path(user_cache_dir("floorcast")) / "kernels"


def _forget_old(current: Path) -> None:
    """Remove all but the newest folders of earlier states."""
    others = sorted((p for p in current.parent.iterdir() if p != current), key=lambda p: p.stat().st_mtime)
    for path in others[:-_KEPT]:
        shutil.rmtree(path, ignore_errors=True)

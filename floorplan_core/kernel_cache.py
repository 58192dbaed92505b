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
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import ModuleType
from typing import Any

_HOMES = ("geometry", "stages", "readers", "simulation")  # the packages that hold kernels
_OF_SURVEYS = ("geometry", "stages")  # those of them that every survey uses
_KEPT = 3  # folders of earlier states that stay
_waiting: list[Any] = []  # the listener that numba has, for it does not say


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


def kernels_complete() -> bool:
    """True where an earlier run compiled all that a usual survey needs, in this state of the sources."""
    mark = _mark()
    return mark is not None and mark.exists()


def note_complete() -> None:
    """All that a usual survey needs is compiled."""
    mark = _mark()
    if mark is not None:
        with suppress(OSError):
            mark.touch()


def _mark() -> Path | None:
    folder = os.environ.get("NUMBA_CACHE_DIR")
    return None if folder is None else Path(folder) / f"complete-{source_digest()}"


def kernel_count() -> int:
    """About how many kernels a survey needs: those of its stages."""
    package = Path(__file__).parent
    sources = (p.read_text(encoding="utf-8") for home in _OF_SURVEYS for p in (package / home).glob("*.py"))
    return sum(line.startswith("@njit") for text in sources for line in text.splitlines())


@contextmanager
def compilations(tell: Callable[[int], None]) -> Iterator[None]:
    """Call ``tell`` with the number of our kernels compiled so far after each; perhaps from a thread."""
    from numba.core import event

    class Counter(event.Listener):  # type: ignore[misc]  # numba has no types
        def __init__(self) -> None:
            self.done: set[tuple[str, str]] = set()

        def on_start(self, event: object) -> None:
            pass

        def on_end(self, event: Any) -> None:
            function = event.data["dispatcher"].py_func  # often one of numba's own
            name = function.__module__, function.__qualname__
            if name[0].startswith(__package__) and name not in self.done:
                self.done.add(name)
                tell(len(self.done))

    with event.install_listener("numba:compile", Counter()):
        yield


def on_first_compilation(tell: Callable[[], None]) -> None:
    """Call ``tell`` once, when a kernel is first compiled, not read from the cache; perhaps from a thread.

    Who asked before is told no more: of several commands in one process only the one that runs.
    """
    from numba.core import event

    while _waiting:
        event.unregister("numba:compile", _waiting.pop())

    class First(event.Listener):  # type: ignore[misc]  # numba has no types
        told = False

        def on_start(self, event: object) -> None:
            if not self.told:
                self.told = True
                tell()

        def on_end(self, event: object) -> None:
            pass

    _waiting.append(First())
    event.register("numba:compile", _waiting[0])


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

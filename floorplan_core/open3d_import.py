"""Open3D, imported late and without the web plotting that it would bring along.

``import open3d`` takes seconds, and loads dash and plotly only to draw in notebooks. A stub in their place
halves the time, and lets the frozen program do without both.

In the frozen program Open3D's library, a quarter of the whole, lies packed: few people need it, and it is not
needed to start. It is unpacked into the user's cache the first time, and linked from there before the import,
which then takes the library that is loaded already (docs/decisions/0031-frozen-size.md).
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import sys
import tempfile
from pathlib import Path
from types import ModuleType
from typing import Any

from floorplan_core.errors import OutputError

PACKED = ".zst"  # what build_app.spec adds to the name of a packed library
_PLOTS = "open3d.visualization.draw_plotly"
_NAMES = ("get_plotly_fig", "draw_plotly", "draw_plotly_server")
_BEFORE = "libtbb*.so*"  # what the library itself needs, found no longer from where it is unpacked


def load_open3d() -> Any:
    """The module ``open3d``.

    :raises OutputError: if its packed library finds no room on the disk.
    """
    if "open3d" not in sys.modules:
        if _PLOTS not in sys.modules:
            sys.modules[_PLOTS] = _stub()
        if (frozen := getattr(sys, "_MEIPASS", None)) is not None:
            link_packed(Path(frozen) / "open3d", _cache())
    import open3d

    return open3d


def link_packed(package: Path, cache: Path) -> list[Path]:
    """Unpack the packed libraries of ``package`` into ``cache``, unless they are there, and load them.

    :return: where they lie.
    :raises OutputError: if they cannot be written.
    """
    packed = sorted(package.glob(f"*{PACKED}"))
    if not packed:
        return []
    for needed in sorted(package.glob(_BEFORE)):
        ctypes.CDLL(str(needed), mode=ctypes.RTLD_GLOBAL)
    libraries = [_unpacked(path, cache) for path in packed]
    for library in libraries:
        ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
    return libraries


def _unpacked(packed: Path, cache: Path) -> Path:
    """The library of a packed file; appears whole or not at all, in a folder named by its content."""
    content = packed.read_bytes()
    folder = cache / hashlib.sha1(content, usedforsecurity=False).hexdigest()[:12]
    target = folder / packed.name.removesuffix(PACKED)
    if target.is_file():
        return target
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=folder, delete=False) as file:
            file.write(_zstd().decompress(content))
        Path(file.name).chmod(0o755)
        os.replace(file.name, target)
    except OSError as error:
        raise OutputError(
            f"Open3D cannot be unpacked into {folder}: {error.strerror}; free 250 MB there, "
            "or set XDG_CACHE_HOME to a folder with room."
        ) from error
    return target


def _cache() -> Path:
    from platformdirs import user_cache_dir

    return Path(user_cache_dir("floorcast")) / "libraries"


def _zstd() -> Any:
    if sys.version_info >= (3, 14):
        from compression import zstd
    else:
        from backports import zstd
    return zstd


def _stub() -> ModuleType:
    stub = ModuleType(_PLOTS, "Left out: floorplan_core.open3d_import.")
    for name in _NAMES:
        setattr(stub, name, _left_out)
    return stub


def _left_out(*_: object, **__: object) -> None:
    raise NotImplementedError("plots in notebooks are left out (floorplan_core.open3d_import)")

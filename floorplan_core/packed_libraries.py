"""Libraries that lie packed in the frozen program: unpacked into the user's cache once, linked from there.

Only Linux packs them (``build_app.spec``, docs/decisions/0031-frozen-size.md): the program's folder
``packed`` then holds ``PACKAGE-DIGEST.tar.zst``. Once they are loaded, the package's modules link to them
by their names, wherever they lie.
"""

from __future__ import annotations

import ctypes
import io
import os
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from floorplan_core.errors import OutputError

PACKED = ".tar.zst"


class LinkBeforeImport(MetaPathFinder):
    """Links the packed libraries of a package when it is about to be imported.

    It finds one kind of module itself: a packed extension of the package's own name. OpenCV's package imports
    itself once more, and expects its extension.
    """

    def __init__(self, folder: Path) -> None:
        """``folder``: of the packed libraries."""
        self._waiting = {path.name.rpartition("-")[0]: path for path in sorted(folder.glob(f"*{PACKED}"))}
        self._extensions: dict[str, Path] = {}

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """None, so that the next finder goes on; or where the extension lies, when asked again.

        :raises OutputError: if the libraries cannot be unpacked.
        """
        if fullname in self._waiting:
            for library in link_packed(self._waiting[fullname], user_cache()):
                if library.name.startswith(f"{fullname}."):
                    self._extensions[fullname] = library
            del self._waiting[fullname]
            return None
        extension = self._extensions.pop(fullname, None)
        return None if extension is None else spec_from_file_location(fullname, extension)


def link_packed(packed: Path, cache: Path) -> list[Path]:
    """Unpack libraries into ``cache``, unless they are there; load them. They find each other where they lie.

    :return: where they lie.
    :raises OutputError: if they cannot be written.
    """
    files = sorted(_unpacked(packed, cache).iterdir())
    for library in files:
        if library.name.startswith("lib"):  # else an extension, which the import loads
            ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
    return files


def user_cache() -> Path:
    """Where unpacked libraries are kept."""
    from platformdirs import user_cache_dir

    return Path(user_cache_dir("floorcast")) / "libraries"


def _unpacked(packed: Path, cache: Path) -> Path:
    """The folder of what was packed; appears whole or not at all. The name of the pack holds its digest."""
    target = cache / packed.name.removesuffix(PACKED)
    if target.is_dir():
        return target
    import shutil  # all but the first start do without these
    import tarfile
    import tempfile

    made = None
    try:
        cache.mkdir(parents=True, exist_ok=True)
        made = Path(tempfile.mkdtemp(dir=cache))
        with tarfile.open(fileobj=io.BytesIO(_zstd().decompress(packed.read_bytes()))) as tar:
            tar.extractall(made, filter="data")
        os.replace(made, target)
    except OSError as error:
        if made is not None:
            shutil.rmtree(made, ignore_errors=True)
        if not target.is_dir():  # else another process was faster
            raise OutputError(
                f"Libraries of the program cannot be unpacked into {cache}: {error.strerror}; "
                "free 400 MB there, or set XDG_CACHE_HOME to a folder with room."
            ) from error
    return target


def _zstd() -> Any:
    if sys.version_info >= (3, 14):
        from compression import zstd
    else:
        from backports import zstd
    return zstd

"""Plans and stage results on disk, without loss and without pickle: a zip of plain arrays and a JSON tree.

Any frozen dataclass of :mod:`floorplan_core.model` and any settings of :mod:`floorplan_core.config` go in,
with everything inside them: numbers, text, tuples, lists, dictionaries, numpy arrays, enums and shapely
geometries (as WKB). The file is a zip with ``tree.json`` and one ``.npy`` member for each type of array,
all arrays of that type end to end; the tree refers to them by type, start and shape. Files are byte-identical
for equal content. Reading executes nothing, allocates no more than the file holds, and refuses whatever does
not fit the declared fields with one sentence (:class:`InputError`).
"""

from __future__ import annotations

import io
import json
import struct
import zipfile
import zlib
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.intermediates_tree import Malformed, Pools, decode, encode

FORMAT = "floorcast intermediate"
FORMAT_VERSION = 1
TREE = "tree.json"
EPOCH = (1980, 1, 1, 0, 0, 0)  # no time stamps: the same content gives the same bytes
COMPRESSION_LEVEL = 1  # the grids shrink by 20; higher levels cost ten times as long for a tenth more
MAX_MEMBER_BYTES = 8 * 2**30  # no plan comes near; a larger member is a bomb
MAX_TREE_BYTES = 2**29

_DAMAGE = (  # what zipfile, zlib, json and numpy raise for bytes that are not theirs
    ValueError,
    KeyError,
    EOFError,
    OverflowError,
    NotImplementedError,
    RecursionError,
    struct.error,
    zipfile.BadZipFile,
    zlib.error,
)

T = TypeVar("T")


def save(value: object, path: Path) -> None:
    """Write ``value`` to ``path``. Raises TypeError for what is not data (functions, object arrays)."""
    path.write_bytes(dumps(value))


def load(path: Path, expected: type[T]) -> T:
    """Read what :func:`save` wrote; :class:`InputError` unless it is a whole, well-formed ``expected``."""
    try:
        value = loads(path.read_bytes())
    except OSError as error:
        raise InputError(f"Cannot read {path.name}: {(error.strerror or str(error)).lower()}.") from error
    except (Malformed, *_DAMAGE) as error:
        raise InputError(f"{path.name} is not an undamaged Floorcast file ({_why(error)}).") from error
    if not isinstance(value, expected):
        raise InputError(
            f"{path.name} holds a {type(value).__name__}, where a {expected.__name__} is wanted."
        )
    return value


def dumps(value: object) -> bytes:
    """``value`` as the bytes of a file."""
    pools = Pools()
    tree = {"format": FORMAT, "version": FORMAT_VERSION, "root": encode(value, pools)}
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        _add(archive, TREE, json.dumps(tree, separators=(",", ":"), ensure_ascii=False).encode())
        for name, parts in sorted(pools.parts.items()):
            _add(archive, f"{name}.npy", _npy(np.concatenate(parts)))
    return buffer.getvalue()


def _add(archive: zipfile.ZipFile, name: str, data: bytes) -> None:
    entry = zipfile.ZipInfo(name, EPOCH)
    archive.writestr(entry, data, zipfile.ZIP_DEFLATED, COMPRESSION_LEVEL)


def _npy(array: NDArray[Any]) -> bytes:
    buffer = io.BytesIO()
    np.lib.format.write_array(buffer, array, allow_pickle=False)
    return buffer.getvalue()


def loads(data: bytes) -> object:
    """The value in the bytes of a file; raises :class:`Malformed` and what the libraries raise."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        tree = json.loads(_member(archive, TREE, MAX_TREE_BYTES))
        if not isinstance(tree, dict) or tree.get("format") != FORMAT:
            raise Malformed("it is another kind of zip file")
        if tree.get("version") != FORMAT_VERSION:
            raise Malformed(f"its version is {tree.get('version')!r}, this program reads {FORMAT_VERSION}")
        names = [n for n in archive.namelist() if n != TREE]
        pools = {n.removesuffix(".npy"): _array(_member(archive, n, MAX_MEMBER_BYTES)) for n in names}
    return decode(tree.get("root"), pools)


def _member(archive: zipfile.ZipFile, name: str, limit: int) -> bytes:
    try:
        size = archive.getinfo(name).file_size
    except KeyError:
        raise Malformed(f"it has no {name}") from None
    if size > limit:
        raise Malformed(f"{name} claims {size} bytes")
    try:
        return archive.read(name)
    except (NotImplementedError, RuntimeError) as error:  # unknown compression, encryption
        raise Malformed(str(error)) from error


def _array(data: bytes) -> NDArray[Any]:
    """The one-dimensional array of an .npy member; its header may not promise more than the member holds."""
    stream = io.BytesIO(data)
    if np.lib.format.read_magic(stream) != (1, 0):
        raise Malformed("an array has an unknown header")
    shape, _, dtype = np.lib.format.read_array_header_1_0(stream)
    if dtype.kind not in "biuf" or len(shape) != 1:
        raise Malformed(f"an array has type {dtype} and shape {shape}")
    if shape[0] * dtype.itemsize != len(data) - stream.tell():
        raise Malformed("an array is shorter or longer than its header says")
    return np.frombuffer(data, dtype=dtype, offset=stream.tell())


def _why(error: Exception) -> str:
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    return " ".join(str(error).split())[:200] or type(error).__name__

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
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.intermediates_tree import Malformed, Pools, decode, encode

FORMAT = "floorcast intermediate"
FORMAT_VERSION = 1
TREE = "tree.json"
COMPRESSION_LEVEL = 1  # the grids shrink by 20; higher levels cost ten times as long for a tenth more
MAX_MEMBER_BYTES = 8 * 2**30  # no plan comes near; a larger member is a bomb
MAX_TREE_BYTES = 2**29
MOST_SHRUNK = 1100  # times that deflate can shrink anything: 1032
PIECE = 1 << 20  # bytes that are unpacked together

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
    pools = Pools()
    tree = encode(value, pools)  # before the file is there: what is not data leaves none behind
    with path.open("wb") as file:
        _write(file, tree, pools)


def load(path: Path, expected: type[T]) -> T:
    """Read what :func:`save` wrote; :class:`InputError` unless it is a whole, well-formed ``expected``."""
    try:
        with path.open("rb") as file:
            value = _read(file)
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
    pools, buffer = Pools(), io.BytesIO()
    _write(buffer, encode(value, pools), pools)
    return buffer.getvalue()


def _write(file: IO[bytes], tree: Any, pools: Pools) -> None:
    """The file; arrays go into it one after the other, as those of a large site take half a gigabyte."""
    tree = {"format": FORMAT, "version": FORMAT_VERSION, "root": tree}
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=COMPRESSION_LEVEL) as archive:
        _add(archive, TREE, [json.dumps(tree, separators=(",", ":"), ensure_ascii=False).encode()])
        for name, parts in sorted(pools.parts.items()):
            _add(archive, f"{name}.npy", [_npy_header(parts), *parts])


def _add(archive: zipfile.ZipFile, name: str, parts: Sequence[bytes | NDArray[Any]]) -> None:
    """A member of these bytes. Its time is 1980, which :class:`zipfile.ZipInfo` has where none is given."""
    size = sum(part.nbytes if isinstance(part, np.ndarray) else len(part) for part in parts)
    with archive.open(name, "w", force_zip64=1.05 * size > zipfile.ZIP64_LIMIT) as member:
        for part in parts:  # beyond that limit a member needs the sizes of large files
            member.write(part.view(np.uint8).data if isinstance(part, np.ndarray) else part)


def _npy_header(parts: Sequence[NDArray[Any]]) -> bytes:
    """What comes before the numbers of one array that is all of ``parts``, end to end."""
    buffer = io.BytesIO()
    head = np.lib.format.header_data_from_array_1_0(parts[0][:0])
    np.lib.format.write_array_header_1_0(buffer, {**head, "shape": (sum(len(part) for part in parts),)})
    return buffer.getvalue()


def loads(data: bytes) -> object:
    """The value in the bytes of a file; raises :class:`Malformed` and what the libraries raise."""
    return _read(io.BytesIO(data))


def _read(file: IO[bytes]) -> object:
    with zipfile.ZipFile(file) as archive:
        tree = json.loads(_member(archive, TREE, MAX_TREE_BYTES))
        if not isinstance(tree, dict) or tree.get("format") != FORMAT:
            raise Malformed("it is another kind of zip file")
        if tree.get("version") != FORMAT_VERSION:
            raise Malformed(f"its version is {tree.get('version')!r}, this program reads {FORMAT_VERSION}")
        names = [n for n in archive.namelist() if n != TREE]
        pools = {n.removesuffix(".npy"): _array(archive, n) for n in names}
    return decode(tree.get("root"), pools)


def _member(archive: zipfile.ZipFile, name: str, limit: int) -> bytes:
    with _opened(archive, name, limit) as (member, _):
        return member.read()


@contextmanager
def _opened(archive: zipfile.ZipFile, name: str, limit: int) -> Iterator[tuple[IO[bytes], int]]:
    """A member and how many bytes it claims to hold."""
    try:
        entry = archive.getinfo(name)
    except KeyError:
        raise Malformed(f"it has no {name}") from None
    if entry.file_size > min(limit, MOST_SHRUNK * (entry.compress_size + 1)):
        raise Malformed(f"{name} claims {entry.file_size} bytes")
    try:
        with archive.open(entry) as member:
            yield member, entry.file_size
    except (NotImplementedError, RuntimeError) as error:  # unknown compression, encryption
        raise Malformed(str(error)) from error


def _array(archive: zipfile.ZipFile, name: str) -> NDArray[Any]:
    """The one-dimensional array of an .npy member; its header may not promise more than the member holds.

    Unpacked into its place piece by piece: nothing of it is held twice.
    """
    with _opened(archive, name, MAX_MEMBER_BYTES) as (member, size):
        if np.lib.format.read_magic(member) != (1, 0):
            raise Malformed("an array has an unknown header")
        shape, _, dtype = np.lib.format.read_array_header_1_0(member)
        if dtype.kind not in "biuf" or len(shape) != 1:
            raise Malformed(f"an array has type {dtype} and shape {shape}")
        if shape[0] < 0 or shape[0] * dtype.itemsize != size - member.tell():
            raise Malformed("an array is shorter or longer than its header says")
        out = np.zeros(shape[0], dtype=dtype)
        flat, at = out.view(np.uint8), 0
        while piece := member.read(PIECE):
            if at + len(piece) > len(flat):
                raise Malformed("an array is longer than its header says")
            flat[at : at + len(piece)] = np.frombuffer(piece, dtype=np.uint8)
            at += len(piece)
        if at != len(flat):
            raise Malformed("an array is shorter than its header says")
        return out


def _why(error: Exception) -> str:
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    return " ".join(str(error).split())[:200] or type(error).__name__

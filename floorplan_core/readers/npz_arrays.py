"""Arrays inside NPZ and NPY files as streams of rows: nothing is allocated that the file cannot fill."""

from __future__ import annotations

import ast
import re
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import prod
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError

MAX_MEMBERS = 10_000
MAX_RATIO = 200  # unpacked to packed bytes: coordinates never compress like that, bombs do
BOMB_BYTES = 1 << 28  # smaller members may compress as well as they like
PLAIN_KINDS = "fiu"
MAGIC = b"\x93NUMPY"
MAX_HEADER_BYTES = 1 << 16
MAX_LENGTH = 1 << 53
MAX_ITEM = 1 << 14  # bytes of one record
WIDEST = 64  # columns of one point
PLAIN_TYPE = re.compile(r"[<>|=]?[a-zA-Z][0-9]{0,6}")


@dataclass(frozen=True)
class StoredArray:
    """The header of one stored array and where it is."""

    path: Path
    member: str | None  # of the archive; None for a bare NPY file
    name: str
    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    fortran: bool
    fields: tuple[str, ...] = ()  # of records: those whose numbers are the columns

    @property
    def is_points(self) -> bool:
        """True for (N, 3) or wider plain numbers."""
        return len(self.shape) == 2 and 3 <= self.shape[1] <= WIDEST and self.is_plain

    @property
    def is_plain(self) -> bool:
        """True for numbers; False for text, complex numbers and records without chosen fields."""
        kinds = {self.dtype[field].base.kind for field in self.fields} or {self.dtype.kind}
        return kinds <= set(PLAIN_KINDS)

    def as_rows(self) -> StoredArray:
        """The same numbers as (N, 3) where they can be nothing else: (3, N), or an image (h, w, 3)."""
        if len(self.shape) == 2 and self.shape[0] == 3 and self.shape[1] > WIDEST and self.is_plain:
            return replace(self, shape=self.shape[::-1], fortran=not self.fortran)
        if len(self.shape) == 3 and self.shape[2] == 3 and self.dtype.kind == "f" and not self.fortran:
            return replace(self, shape=(self.shape[0] * self.shape[1], 3))
        return self

    def columns(self, *fields: str) -> StoredArray:
        """The numbers of some fields of records, as an array of its own."""
        width = sum(prod(self.dtype[field].shape) for field in fields)
        shape = (prod(self.shape), width) if width > 1 else (prod(self.shape),)
        return replace(self, shape=shape, fields=fields, fortran=False)

    def rows(self, count: int) -> Iterator[NDArray[Any]]:
        """Blocks of at most ``count`` rows, in order."""
        width = prod(self.shape[1:])
        if self.fields:
            yield from self._rows_of_records(count)
            return
        if self.fortran and width > 1:
            yield from self._rows_by_column(count, width)
            return
        with _open(self.path, self.member) as stream:
            _read_header(stream, self.path.name)
            for start in range(0, self.shape[0], count):
                rows = min(count, self.shape[0] - start)
                yield self._read(stream, rows * width).reshape(rows, *self.shape[1:])

    def _rows_of_records(self, count: int) -> Iterator[NDArray[Any]]:
        with _open(self.path, self.member) as stream:
            _read_header(stream, self.path.name)
            for start in range(0, self.shape[0], count):
                rows = min(count, self.shape[0] - start)
                records = self._read(stream, rows)
                parts = [records[field].reshape(rows, -1) for field in self.fields]
                yield np.concatenate(parts, axis=1).reshape(rows, *self.shape[1:])

    def _rows_by_column(self, count: int, width: int) -> Iterator[NDArray[Any]]:
        """Fortran order keeps column after column: as many streams as columns that we use."""
        from contextlib import ExitStack

        with ExitStack() as stack:
            streams = [stack.enter_context(_open(self.path, self.member)) for _ in range(min(3, width))]
            for column, stream in enumerate(streams):
                _read_header(stream, self.path.name)
                stream.seek(column * self.shape[0] * self.dtype.itemsize, 1)
            for start in range(0, self.shape[0], count):
                rows = min(count, self.shape[0] - start)
                yield np.column_stack([self._read(stream, rows) for stream in streams])

    def _read(self, stream: IO[bytes], items: int) -> NDArray[Any]:
        wanted = items * self.dtype.itemsize
        try:
            raw = stream.read(wanted)
        except (zipfile.BadZipFile, zlib.error, EOFError, OSError) as error:
            raise InputError(f"{self.path.name} is damaged: {self.name!r} cannot be unpacked.") from error
        if len(raw) < wanted:
            raise _truncated(self.path, self.name, self.shape)
        return np.frombuffer(raw, dtype=self.dtype)


def list_arrays(path: Path) -> dict[str, StoredArray]:
    """The arrays of plain numbers by name; :class:`InputError` for damaged files and zip bombs."""
    with path.open("rb") as handle:
        if handle.read(2) != b"PK":
            handle.seek(0)
            stored = _stored(handle, path, None, path.stem)
            _check_size(stored, path.stat().st_size - handle.tell())
            return {stored.name: stored}
    arrays = {}
    try:
        with zipfile.ZipFile(path) as archive:
            for info in archive.infolist()[:MAX_MEMBERS]:
                if not info.filename.endswith(".npy"):
                    continue
                _refuse_bomb(path, info)
                with archive.open(info) as stream:
                    stored = _stored(stream, path, info.filename, info.filename.removesuffix(".npy"))
                    if stored.is_plain or stored.dtype.names:
                        _check_size(stored, info.file_size - stream.tell())
                        arrays[stored.name] = stored
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError) as error:
        raise InputError(f"{path.name} is truncated or damaged: {str(error)[:80]}.") from error
    return arrays


def _stored(stream: IO[bytes], path: Path, member: str | None, name: str) -> StoredArray:
    shape, fortran, dtype = _read_header(stream, path.name)
    if dtype.hasobject:
        raise InputError(
            f"{path.name} holds pickled objects ({name!r}), which are refused because reading them could run "
            "code; save plain arrays of numbers."
        )
    return StoredArray(path, member, name, shape, dtype, fortran)


def _read_header(stream: IO[bytes], name: str) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """Shape, order and type. (numpy's own parser trusts lengths and evaluates more than it should.)"""
    magic = stream.read(len(MAGIC) + 2)
    size_bytes = 2 if magic[len(MAGIC) :] == b"\x01\x00" else 4
    size = int.from_bytes(stream.read(size_bytes), "little")
    if not magic.startswith(MAGIC) or size > MAX_HEADER_BYTES:
        raise InputError(f"{name} is not a valid numpy file: its header is damaged.")
    try:
        entries = ast.literal_eval(stream.read(size).decode("latin-1").strip())
        return _shape(entries["shape"]), bool(entries["fortran_order"]), _dtype(entries["descr"])
    except (ValueError, TypeError, KeyError, SyntaxError, MemoryError, RecursionError):
        raise InputError(f"{name} is not a valid numpy file: its header is damaged.") from None


def _shape(value: Any) -> tuple[int, ...]:
    if not isinstance(value, tuple) or not all(type(n) is int and 0 <= n <= MAX_LENGTH for n in value):
        raise ValueError(value)
    return value


def _dtype(descr: Any) -> np.dtype[Any]:
    """A plain type, or a record of named fields of plain types."""
    if isinstance(descr, list):
        return _record(descr)
    if not isinstance(descr, str) or not PLAIN_TYPE.fullmatch(descr):
        raise ValueError(descr)
    return np.dtype(descr)


def _record(descr: list[Any]) -> np.dtype[Any]:
    """A record; bytes without a name that fill it up (as aligned ones have them) are passed over."""
    names, formats, offsets, size = [], [], [], 0
    for name, kind, *more in descr:
        shape = _shape(more[0]) if more else ()
        if isinstance(kind, list) or not isinstance(name, str):  # records within records: nobody's points
            return np.dtype("V1")
        part = np.dtype((_dtype(kind), shape))
        if name:
            names.append(name)
            formats.append(part)
            offsets.append(size)
        size += part.itemsize
        if size > MAX_ITEM:
            raise ValueError(descr)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": size})


def _check_size(stored: StoredArray, there: int) -> None:
    if prod(stored.shape) * stored.dtype.itemsize > there:
        raise _truncated(stored.path, stored.name, stored.shape)


def _truncated(path: Path, name: str, shape: tuple[int, ...]) -> InputError:
    return InputError(
        f"{path.name} is truncated: its array {name!r} should have the shape {shape}, "
        "the file holds less; copy it again."
    )


def _refuse_bomb(path: Path, info: zipfile.ZipInfo) -> None:
    if info.file_size > max(BOMB_BYTES, MAX_RATIO * max(1, info.compress_size)):
        raise InputError(
            f"{path.name} was refused: {info.filename} unpacks from {info.compress_size:,} to "
            f"{info.file_size:,} bytes, which no point cloud does."
        )


def _open(path: Path, member: str | None) -> IO[bytes]:
    """A stream over the member (or file); closing it closes the archive, too."""
    if member is None:
        return path.open("rb")
    with zipfile.ZipFile(path) as archive:  # the open member keeps the archive's file alive
        return archive.open(member)

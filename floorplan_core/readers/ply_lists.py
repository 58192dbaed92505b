"""Elements of binary PLY files that hold lists: how long they are, so that what follows can be found."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from floorplan_core.errors import InputError
from floorplan_core.readers.ply_header import PlyElement

BLOCK_BYTES = 1 << 22  # of records that are walked one by one


def record_dtype(element: PlyElement, byte_order: str, lengths: dict[str, int]) -> np.dtype[Any]:
    """The packed record of an element whose list properties have the given lengths.

    A list becomes a field ``name#n`` with its count and a field ``name`` with its items; names that are
    repeated get a number, because numpy wants them different.
    """
    fields: list[tuple[str, str] | tuple[str, str, tuple[int]]] = []
    seen: dict[str, int] = {}
    for item in element.properties:
        seen[item.name] = seen.get(item.name, 0) + 1
        name = item.name if seen[item.name] == 1 else f"{item.name}#{seen[item.name]}"
        if item.count_type:
            fields.append((f"{name}#n", byte_order + item.count_type))
            fields.append((name, byte_order + item.type, (lengths[item.name],)))
        else:
            fields.append((name, byte_order + item.type))
    return np.dtype(fields)


def constant_record(path: Path, element: PlyElement, byte_order: str, offset: int) -> np.dtype[Any]:
    """The record of an element without lists, or with lists that are all as long as its first ones."""
    if not element.properties:
        raise InputError(f"{path.name} claims to be PLY but its element {element.name!r} has no properties.")
    if not element.has_lists:
        return record_dtype(element, byte_order, {})
    lengths = _first_lengths(path, element, byte_order, offset)
    dtype = record_dtype(element, byte_order, lengths)
    present = (path.stat().st_size - offset) // dtype.itemsize
    if not _lengths_constant(path, element, dtype, offset, min(element.count, present), lengths):
        raise InputError(
            f"{path.name} has lists of differing lengths in its element {element.name!r}; "
            "write its points without list properties."
        )
    return dtype


def skip_list_element(path: Path, element: PlyElement, byte_order: str, offset: int) -> int:
    """The byte after a whole element that begins at ``offset``."""
    if not element.has_lists:
        width = record_dtype(element, byte_order, {}).itemsize if element.properties else 0
        return offset + element.count * width
    if element.count == 0:
        return offset
    lengths = _first_lengths(path, element, byte_order, offset)
    dtype = record_dtype(element, byte_order, lengths)
    end = offset + element.count * dtype.itemsize
    if end <= path.stat().st_size and _lengths_constant(path, element, dtype, offset, element.count, lengths):
        return end
    return _walk(path, element, byte_order, offset)


def _first_lengths(path: Path, element: PlyElement, byte_order: str, offset: int) -> dict[str, int]:
    """Lengths of the lists of the first record."""
    lengths: dict[str, int] = {}
    with path.open("rb") as handle:
        handle.seek(offset)
        for item in element.properties:
            if item.count_type:
                dtype = np.dtype(byte_order + item.count_type)
                raw = handle.read(dtype.itemsize)
                length = int(np.frombuffer(raw, dtype)[0]) if len(raw) == dtype.itemsize else -1
                if not 0 <= length * np.dtype(item.type).itemsize <= path.stat().st_size:
                    raise _bad_list(path, element)
                lengths[item.name] = length
                handle.seek(length * np.dtype(item.type).itemsize, 1)
            else:
                handle.seek(np.dtype(item.type).itemsize, 1)
    return lengths


def _lengths_constant(
    path: Path, element: PlyElement, dtype: np.dtype[Any], offset: int, count: int, lengths: dict[str, int]
) -> bool:
    rows_at_once = max(1, BLOCK_BYTES // dtype.itemsize)
    with path.open("rb") as handle:
        handle.seek(offset)
        for start in range(0, count, rows_at_once):
            rows = np.fromfile(handle, dtype, min(rows_at_once, count - start))
            for name, length in lengths.items():
                if not (rows[f"{name}#n"] == length).all():
                    return False
    return True


def _walk(path: Path, element: PlyElement, byte_order: str, offset: int) -> int:
    """Record by record: only where lists differ in length, as in meshes of triangles and quads."""
    sizes = [
        (np.dtype(byte_order + p.count_type) if p.count_type else None, np.dtype(p.type).itemsize)
        for p in element.properties
    ]
    size = path.stat().st_size
    data = np.memmap(path, dtype=np.uint8, mode="r")
    for _ in range(element.count):
        for count_dtype, width in sizes:
            if count_dtype is None:
                offset += width
                continue
            raw = bytes(data[offset : offset + count_dtype.itemsize])
            length = int(np.frombuffer(raw, count_dtype)[0]) if len(raw) == count_dtype.itemsize else -1
            offset += count_dtype.itemsize + length * width
            if length < 0 or offset > size:
                raise _bad_list(path, element)
    return offset


def _bad_list(path: Path, element: PlyElement) -> InputError:
    return InputError(
        f"{path.name} is truncated or damaged: the lists of its element {element.name!r} "
        f"do not fit into its {path.stat().st_size:,} bytes."
    )

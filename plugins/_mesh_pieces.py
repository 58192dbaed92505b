"""Large meshes, read by pieces: the triangles of binary STL and PLY files, without holding them.

Of STL nothing is held, of PLY the corners (as they are stored). Other formats have to be loaded whole;
where memory does not suffice for that, it is said before instead of being ended by the system.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from floorcast_plugins._mesh_files import MAX_PLY_HEADER, STL_HEAD, is_text_stl
from floorplan_core.api import InputError, PlyHeader, find_xyz, parse_ply_header

LARGE = 128 << 20  # bytes: smaller files are loaded whole, whatever their format
PIECE = 1 << 16  # triangles
INDEX_NAMES = ("vertex_indices", "vertex_index")
# Bytes of memory that trimesh takes for a byte of the file, at most, as measured with each format.
WHOLE = {"obj": 10, "off": 20, "stl": 12, "ply": 20, "glb": 10, "gltf": 10}

STL_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


@dataclass(frozen=True)
class Pieces:
    """Triangles that can be passed over again and again."""

    count: int
    corners: Callable[[], Iterator[Any]]  # (B, 3, 3) float64, file coordinates


def pieces_of(path: Path, kind: str) -> Pieces | None:
    """The triangles of a large file; None for what is small, or cannot be read by pieces."""
    if path.stat().st_size < LARGE:
        return None
    with path.open("rb") as handle:
        head = handle.read(MAX_PLY_HEADER)
    if kind == "stl" and not is_text_stl(head):
        count = int.from_bytes(head[80:STL_HEAD], "little")
        return Pieces(count, partial(_stl_corners, path, count))
    return _ply_pieces(path, parse_ply_header(head, path.name)) if kind == "ply" else None


def check_memory(path: Path, kind: str) -> None:
    """:class:`InputError` for a mesh that has to be loaded whole and is too large for that."""
    size, free = path.stat().st_size, free_memory()
    needed = WHOLE.get(kind, max(WHOLE.values())) * size
    if free is not None and size >= LARGE and needed > free:
        raise InputError(
            f"{path.name} is a mesh of {size / 1e9:.1f} GB in a form that is loaded whole, which takes up to "
            f"{needed / 1e9:.0f} GB of memory, and {free / 1e9:.1f} GB are free; save it as binary STL or as "
            "binary PLY of triangles, which are read by pieces."
        )


def free_memory() -> int | None:
    """Bytes that a process may still take without driving others out; None where nobody says."""
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        return next(int(line.split()[1]) << 10 for line in lines if line.startswith("MemAvailable:"))
    except (OSError, ValueError, StopIteration):
        pass
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None


def _stl_corners(path: Path, count: int) -> Iterator[Any]:
    with path.open("rb") as handle:
        handle.seek(STL_HEAD)
        for start in range(0, count, PIECE):
            yield _records(handle, path, STL_TRIANGLE, min(PIECE, count - start))["corners"].astype(
                np.float64
            )


def _ply_pieces(path: Path, header: PlyHeader) -> Pieces | None:
    """Corners and then triangles, both in records of one size; None for any other file."""
    order, elements = header.byte_order, [e for e in header.elements if e.count]
    if not order or [e.name for e in elements[:2]] != ["vertex", "face"] or elements[0].has_lists:
        return None
    vertex, face = elements[:2]
    xyz = find_xyz([p.name for p in vertex.properties])
    lists = [p for p in face.properties if p.count_type]
    if xyz is None or len(lists) != 1 or lists[0].name not in INDEX_NAMES:
        return None
    at = np.dtype([(p.name, order + p.type) for p in vertex.properties])
    fields: list[Any] = []
    for item in face.properties:
        if item.count_type:
            fields += [("count", order + item.count_type), ("corners", order + item.type, 3)]
        else:
            fields.append((item.name, order + item.type))
    record, offset = np.dtype(fields), header.size + vertex.count * at.itemsize
    if path.stat().st_size - offset < face.count * record.itemsize:
        return None
    if not all((block["count"] == 3).all() for block in _blocks(path, offset, record, face.count)):
        return None
    vertices = _vertices(path, header.size, at, vertex.count, xyz)
    return Pieces(face.count, partial(_ply_corners, path, offset, record, face.count, vertices))


def _vertices(path: Path, offset: int, record: Any, count: int, xyz: tuple[str, str, str]) -> Any:
    """(V, 3) in the precision in which they are stored."""
    out = np.empty((count, 3), dtype=np.result_type(*(record[name] for name in xyz)).newbyteorder("="))
    start = 0
    for block in _blocks(path, offset, record, count):
        for axis, name in enumerate(xyz):
            out[start : start + len(block), axis] = block[name]
        start += len(block)
    return out


def _ply_corners(path: Path, offset: int, record: Any, count: int, vertices: Any) -> Iterator[Any]:
    for block in _blocks(path, offset, record, count):
        index = block["corners"].astype(np.int64)
        if index.min() < 0 or index.max() >= len(vertices):
            raise InputError(
                f"{path.name} is damaged: a triangle refers to corner {int(index.max()):,} of "
                f"{len(vertices):,}."
            )
        yield vertices[index].astype(np.float64)


def _blocks(path: Path, offset: int, record: Any, count: int) -> Iterator[Any]:
    with path.open("rb") as handle:
        handle.seek(offset)
        for start in range(0, count, PIECE):
            yield _records(handle, path, record, min(PIECE, count - start))


def _records(handle: Any, path: Path, record: Any, count: int) -> Any:
    data = handle.read(count * record.itemsize)
    if len(data) < count * record.itemsize:
        raise InputError(f"{path.name} became shorter while it was read; copy it whole and try again.")
    return np.frombuffer(data, dtype=record)

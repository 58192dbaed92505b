"""NPZ and NPY: arrays of points, streamed from the archive; pickled objects are refused."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from floorplan_core.errors import InputError
from floorplan_core.geometry.lattice import lattice_spacing, share_enclosed
from floorplan_core.model import Reconstruction
from floorplan_core.observer import Observer
from floorplan_core.plugins import ReadOptions
from floorplan_core.readers.assemble import assemble
from floorplan_core.readers.fields import SCAN_ID_NAMES, STAMP_NAMES, find_name, find_xyz
from floorplan_core.readers.npz_arrays import StoredArray, list_arrays
from floorplan_core.readers.records import as_scan_id, join_chunks
from floorplan_core.readers.source import (
    CHUNK_POINTS,
    SAMPLE_POINTS,
    EmptyInput,
    PointSource,
    RawChunk,
    ScanIds,
)

POINT_NAMES = (
    "points", "xyz", "pts", "positions", "position", "coords", "coordinates", "vertices", "cloud", "centers",
    "pos", "arr_0",
)  # fmt: skip

_VOLUME = 0.25  # share of enclosed voxels from which they fill space: 0.69 of free space, 0.01 of surfaces


class NpzReader:
    """Point clouds in numpy's own files."""

    name = "NPZ"
    suffixes: tuple[str, ...] = (".npz", ".npy")
    description = (
        "numpy arrays: points (N, 3), (3, N) or (h, w, 3), or records with x, y and z; optional scan_id"
    )

    def sniff(self, path: Path, head: bytes) -> float:
        """1 for an array; 0.9 for an archive whose first member is one."""
        if head.startswith(b"\x93NUMPY"):
            return 1.0
        return 0.9 if head.startswith(b"PK\x03\x04") and b".npy" in head[:512] else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the file; :class:`InputError` where it holds no array of points."""
        return assemble(npz_source(path), options, observer)


def npz_source(path: Path) -> PointSource:
    """The points of an NPZ or NPY file."""
    arrays = _with_fields(list_arrays(path))
    points = _points_array(path, arrays)
    columns = [points]
    names = [name for name in arrays if arrays[name] is not points]
    scan_id, stamp = find_name(names, SCAN_ID_NAMES), find_name(names, STAMP_NAMES)
    for name in (scan_id, stamp):
        if name is not None and arrays[name].shape not in ((points.shape[0],), (points.shape[0], 1)):
            raise InputError(
                f"{path.name} has {points.shape[0]:,} points but {name!r} has the shape {arrays[name].shape}."
            )
    columns += [arrays[name] for name in (scan_id, stamp) if name is not None]
    chunks = partial(_chunks, columns, scan_id is not None, stamp is not None)
    _require_surfaces(path, points)
    sample, ids = _inspect(chunks(), points.shape[0])
    return PointSource(path, "NPZ", chunks, lambda: sample, points.shape[0], scan_id is not None, ids)


def _require_surfaces(path: Path, points: StoredArray) -> None:
    """:class:`InputError` where the file lists the voxels of a volume: free space, which has no walls."""
    first = next(points.rows(CHUNK_POINTS))[:, :3].astype(np.float64)
    first = first[np.isfinite(first).all(axis=1)]
    spacing = lattice_spacing(first)
    if spacing and share_enclosed(first, spacing) > _VOLUME:
        raise InputError(
            f"{path.name} lists voxels of {spacing:.2g} m that fill space, like the free space of a map, and "
            "a plan needs surfaces: open the map itself (an OctoMap .bt or .ot has both) or its occupied "
            "voxels."
        )


def _with_fields(arrays: dict[str, StoredArray]) -> dict[str, StoredArray]:
    """All arrays; of records their coordinates, under the name of the array, scan ids and times."""
    found = {}
    for name, array in arrays.items():
        fields = array.dtype.names or ()
        whole = find_name(fields, POINT_NAMES)
        xyz = find_xyz(fields) or (() if whole is None else (whole,))
        if not xyz:
            found[name] = array.as_rows()
            continue
        found[name] = array.columns(*xyz)
        for wanted in (SCAN_ID_NAMES, STAMP_NAMES):
            field = find_name(fields, wanted)
            if field is not None:
                found.setdefault(field, array.columns(field))
    return found


def _points_array(path: Path, arrays: dict[str, StoredArray]) -> StoredArray:
    """The array of the usual names, else the only one of the right shape."""
    fitting = {name: a for name, a in arrays.items() if a.is_points}
    if len(records := [a for a in fitting.values() if a.fields]) == 1:
        return _not_empty(path, records[0])
    name = find_name(fitting, POINT_NAMES)
    if name is None and len(fitting) == 1:
        name = next(iter(fitting))
    if name is None:
        shapes = ", ".join(f"{n} {a.shape}" for n, a in list(arrays.items())[:8]) or "none"
        raise InputError(f"{path.name} holds no array of points of shape (N, 3); its arrays: {shapes}.")
    return _not_empty(path, fitting[name])


def _not_empty(path: Path, points: StoredArray) -> StoredArray:
    if points.shape[0] == 0:
        raise EmptyInput(f"{path.name} holds 0 points.")
    return points


def _chunks(columns: list[StoredArray], has_scan_id: bool, has_stamps: bool) -> Iterator[RawChunk]:
    """Equal rows of all columns; the archive's members are read side by side."""
    for parts in zip(*(column.rows(CHUNK_POINTS) for column in columns), strict=True):
        rest = list(parts[1:])
        ids = as_scan_id(rest.pop(0).reshape(-1)) if has_scan_id else None
        stamps = rest.pop(0).reshape(-1).astype(np.float64) if has_stamps else None
        points = parts[0][:, :3]
        small = points.dtype.itemsize <= 2 or points.dtype == np.float32
        yield RawChunk(points.astype(np.float32 if small else np.float64), ids, stamps)


def _inspect(chunks: Iterator[RawChunk], count: int) -> tuple[RawChunk, ScanIds | None]:
    """A strided sample and the range of the scan ids: one pass, because archives cannot be sought in."""
    stride = max(1, -(-count // SAMPLE_POINTS))
    parts, lowest, highest, ordered = [], np.iinfo(np.int32).max, -1, True
    last: int | None = None
    for chunk in chunks:
        ids = chunk.scan_id
        parts.append(RawChunk(chunk.points[::stride], None if ids is None else ids[::stride]))
        if ids is not None:
            ordered = ordered and bool((ids[1:] >= ids[:-1]).all()) and (last is None or last <= ids[0])
            last, lowest, highest = int(ids[-1]), min(lowest, int(ids.min())), max(highest, int(ids.max()))
    return join_chunks(parts), None if last is None else ScanIds(lowest, highest, ordered)

"""Fixed-size binary records (PLY, PCD): chunks, samples and scan ids at the speed of reading.

A small buffer that stays in the processor's cache is filled again and again; only the columns that we use
leave it. That is twice as fast as mapping the file and needs memory for one chunk only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from io import FileIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.readers.colours import NO_COLOURS, ColourColumns, intensity_of, rgb_of
from floorplan_core.readers.source import CHUNK_POINTS, SAMPLE_BLOCKS, SAMPLE_POINTS, RawChunk, ScanIds

BUFFER_BYTES = 1 << 20  # fits the second-level cache


@dataclass(frozen=True)
class RecordLayout:
    """Where the records of a file are and which of their fields we use."""

    dtype: np.dtype[Any]  # packed, structured
    offset: int  # bytes before the first record
    count: int
    xyz: tuple[str, str, str]
    scan_id: str | None = None
    stamp: str | None = None
    colours: ColourColumns = NO_COLOURS

    @property
    def point_dtype(self) -> type[np.float32] | type[np.float64]:
        """float32 where the coordinates are stored so (or in 16 bits and fewer); else float64."""
        kinds = [self.dtype[name] for name in self.xyz]
        small = all(k == np.dtype("f4").newbyteorder(k.byteorder) or k.itemsize <= 2 for k in kinds)
        return np.float32 if small else np.float64


def record_chunks(path: Path, layout: RecordLayout) -> Iterator[RawChunk]:
    """All records, at most ``CHUNK_POINTS`` at a time."""
    with path.open("rb", buffering=0) as handle:
        handle.seek(layout.offset)
        for start in range(0, layout.count, CHUNK_POINTS):
            yield _read_columns(handle, path, layout, min(CHUNK_POINTS, layout.count - start))


def record_sample(path: Path, layout: RecordLayout) -> RawChunk:
    """Up to ``SAMPLE_POINTS`` records in blocks that are spread evenly over the file."""
    length = max(1, SAMPLE_POINTS // SAMPLE_BLOCKS)
    if layout.count <= SAMPLE_POINTS:
        starts, length = np.zeros(1, dtype=np.int64), layout.count
    else:
        starts = np.linspace(0, layout.count - length, SAMPLE_BLOCKS).astype(np.int64)
    with path.open("rb", buffering=0) as handle:
        parts = []
        for start in starts.tolist():
            handle.seek(layout.offset + start * layout.dtype.itemsize)
            parts.append(_read_columns(handle, path, layout, length))
    return join_chunks(parts)


def scan_ids_of(path: Path, layout: RecordLayout) -> ScanIds | None:
    """Range and order of all scan ids: one pass over the file, or None where it has none."""
    if layout.scan_id is None or layout.count == 0:
        return None
    lowest, highest, ordered = np.iinfo(np.int32).max, np.iinfo(np.int32).min, True
    last = lowest
    with path.open("rb", buffering=0) as handle:
        handle.seek(layout.offset)
        for rows in _buffers(handle, path, layout, layout.count):
            ids = as_scan_id(rows[layout.scan_id])
            low, high = int(ids.min()), int(ids.max())
            ordered = ordered and (last == np.iinfo(np.int32).max or last <= ids[0])
            ordered = ordered and bool((ids[1:] >= ids[:-1]).all())
            lowest, highest, last = min(lowest, low), max(highest, high), int(ids[-1])
    return ScanIds(lowest, highest, ordered)


def as_scan_id(values: NDArray[Any]) -> NDArray[np.int32]:
    """(N,) int32 scan ids from any number type; what does not fit becomes -1."""
    if values.dtype.kind in "iu" and values.dtype.itemsize <= 4:
        return values.astype(np.int32)
    limit = np.iinfo(np.int32).max
    with np.errstate(invalid="ignore"):
        fits = (values >= 0) & (values <= limit)
        return np.where(fits, values, -1).astype(np.int32)


def join_chunks(parts: list[RawChunk]) -> RawChunk:
    """One chunk from several of the same file."""
    ids = [p.scan_id for p in parts if p.scan_id is not None]
    stamps = [p.stamps for p in parts if p.stamps is not None]
    rgb = [p.rgb for p in parts if p.rgb is not None]
    intensity = [p.intensity for p in parts if p.intensity is not None]
    return RawChunk(
        np.concatenate([p.points for p in parts]),
        np.concatenate(ids) if ids else None,
        np.concatenate(stamps) if stamps else None,
        rgb=np.concatenate(rgb) if len(rgb) == len(parts) else None,
        intensity=np.concatenate(intensity) if len(intensity) == len(parts) else None,
    )


def _read_columns(handle: FileIO, path: Path, layout: RecordLayout, count: int) -> RawChunk:
    points = np.empty((count, 3), dtype=layout.point_dtype)
    ids = None if layout.scan_id is None else np.empty(count, dtype=np.int32)
    stamps = None if layout.stamp is None else np.empty(count, dtype=np.float64)
    seen = {name: np.empty(count, dtype=layout.dtype[name]) for name in layout.colours.names}
    start = 0
    for rows in _buffers(handle, path, layout, count):
        end = start + len(rows)
        for axis, name in enumerate(layout.xyz):
            points[start:end, axis] = rows[name]
        if ids is not None and layout.scan_id is not None:
            ids[start:end] = as_scan_id(rows[layout.scan_id])
        if stamps is not None and layout.stamp is not None:
            stamps[start:end] = rows[layout.stamp]
        for name, column in seen.items():
            column[start:end] = rows[name]
        start = end
    rgb, intensity = rgb_of(seen, layout.colours), intensity_of(seen, layout.colours)
    return RawChunk(points, ids, stamps, rgb=rgb, intensity=intensity)


def _buffers(handle: FileIO, path: Path, layout: RecordLayout, count: int) -> Iterator[NDArray[Any]]:
    """``count`` records from the present place, in one buffer that is used again: copy what you keep."""
    size = layout.dtype.itemsize
    buffer = np.empty(max(1, min(count, BUFFER_BYTES // size)), dtype=layout.dtype)
    raw = buffer.view(np.uint8).reshape(-1).data
    left = count
    while left:
        rows = min(left, len(buffer))
        if _read_fully(handle, raw[: rows * size]) < rows * size:
            raise InputError(f"{path.name} became shorter while it was read; copy it whole and try again.")
        yield buffer[:rows]
        left -= rows


def _read_fully(handle: FileIO, target: memoryview) -> int:
    done = 0
    while done < len(target):
        read = handle.readinto(target[done:])
        if not read:
            break
        done += read
    return done

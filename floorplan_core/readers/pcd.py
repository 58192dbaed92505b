"""PCD: ASCII, binary and compressed, fields of any type; a viewpoint that is set is the sensor's origin."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.geometry.scratch import disk_array, let_go
from floorplan_core.model import Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.plugins import ReadOptions
from floorplan_core.readers.assemble import assemble
from floorplan_core.readers.colours import NO_COLOURS, ColourColumns, find_colours, intensity_of, rgb_of
from floorplan_core.readers.fields import SCAN_ID_NAMES, STAMP_NAMES, find_name, find_xyz
from floorplan_core.readers.pcd_header import MAX_HEADER_BYTES, PcdHeader, parse_pcd_header
from floorplan_core.readers.records import (
    RecordLayout,
    as_scan_id,
    record_chunks,
    record_sample,
    scan_ids_of,
)
from floorplan_core.readers.source import (
    CHUNK_POINTS,
    SAMPLE_POINTS,
    EmptyInput,
    PointSource,
    RawChunk,
    ScanIds,
)
from floorplan_core.readers.text_rows import (
    TextLayout,
    find_rows,
    text_chunks,
    text_sample,
    text_scan_ids,
)
from floorplan_core.readers.trajectory import rotation_from_quaternion

KEPT_BYTES = 64 << 20  # of unpacked points: more are not in memory but in a temporary file
SIZES_BYTES = 8  # of the two sizes before compressed data


class PcdReader:
    """Point clouds of the Point Cloud Library."""

    name = "PCD"
    suffixes: tuple[str, ...] = (".pcd",)
    description = "Point Cloud Library: ASCII, binary or compressed"

    def sniff(self, path: Path, head: bytes) -> float:
        """1 for the usual first comment; 0.9 for a header without it."""
        start = head.lstrip()[:64].upper()
        if start.startswith(b"# .PCD"):
            return 1.0
        return 0.9 if b"FIELDS" in head and b"\nDATA " in head and b"\nTYPE " in head else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the file; :class:`InputError` where header and contents do not agree."""
        return assemble(pcd_source(path, options.colours), options, observer)


@dataclass(frozen=True)
class _Columns:
    """The fields that we use."""

    xyz: tuple[str, str, str]
    scan_id: str | None
    stamp: str | None
    colours: ColourColumns


def pcd_source(path: Path, colours: bool = True) -> PointSource:
    """The points of a PCD file; without ``colours`` if nobody wants them."""
    with path.open("rb") as handle:
        header = parse_pcd_header(handle.read(MAX_HEADER_BYTES), path.name)
    if header.points == 0:
        raise EmptyInput(f"{path.name} is a PCD file of 0 points.")
    columns = _columns(path, header)
    columns = columns if colours else replace(columns, colours=NO_COLOURS)
    make = {"ascii": _text_source, "binary": _binary_source, "binary_compressed": _compressed_source}
    return _with_viewpoint(make[header.storage](path, header, columns), header)


def _columns(path: Path, header: PcdHeader) -> _Columns:
    single = [n for n, count in zip(header.names, header.counts, strict=True) if count == 1]
    xyz = find_xyz(single)
    if xyz is None:
        raise InputError(
            f"{path.name} has no coordinates: its fields are {', '.join(header.names)}, not x, y, z."
        )
    scan_id, stamp = find_name(single, SCAN_ID_NAMES), find_name(single, STAMP_NAMES)
    return _Columns(xyz, scan_id, stamp, find_colours(single, packed=True))


def _binary_source(path: Path, header: PcdHeader, columns: _Columns) -> PointSource:
    present = (path.stat().st_size - header.size) // header.dtype.itemsize
    _check_count(path, header, present)
    layout = RecordLayout(
        header.dtype,
        header.size,
        header.points,
        columns.xyz,
        columns.scan_id,
        columns.stamp,
        columns.colours,
    )
    return PointSource(
        path,
        "PCD",
        partial(record_chunks, path, layout),
        partial(record_sample, path, layout),
        header.points,
        columns.scan_id is not None,
        scan_ids_of(path, layout),
    )


def _text_source(path: Path, header: PcdHeader, columns: _Columns) -> PointSource:
    present, end = find_rows(path, header.size, header.points)
    _check_count(path, header, present)
    first = dict(zip(header.names, np.cumsum((0, *header.counts[:-1])).tolist(), strict=True))
    x, y, z = (first[name] for name in columns.xyz)
    layout = TextLayout(
        header.size,
        sum(header.counts),
        (x, y, z),
        None if columns.scan_id is None else first[columns.scan_id],
        None if columns.stamp is None else first[columns.stamp],
        end=end,
    )
    return PointSource(
        path,
        "PCD",
        partial(text_chunks, path, layout),
        partial(text_sample, path, layout),
        header.points,
        columns.scan_id is not None,
        text_scan_ids(path, layout),
    )


def _compressed_source(path: Path, header: PcdHeader, columns: _Columns) -> PointSource:
    arrays = _unpack(path, header)
    sample, scan_ids = _inspect(arrays, header, columns)
    kept = [arrays] if header.points * header.dtype.itemsize > KEPT_BYTES else []
    return PointSource(
        path,
        "PCD",
        partial(_compressed_chunks, path, header, columns, kept),
        lambda: sample,
        header.points,
        columns.scan_id is not None,
        scan_ids,
    )


def _compressed_chunks(
    path: Path, header: PcdHeader, columns: _Columns, kept: Sequence[dict[str, NDArray[Any]]]
) -> Iterator[RawChunk]:
    """The format packs all points as one block: a large one was unpacked into a file, once."""
    arrays = kept[0] if kept else _unpack(path, header)
    for start in range(0, header.points, CHUNK_POINTS):
        chunk = _slice(arrays, columns, slice(start, start + CHUNK_POINTS))
        if kept:
            let_go(arrays[columns.xyz[0]])  # and all that is in its file
        yield chunk


def _inspect(
    arrays: dict[str, NDArray[Any]], header: PcdHeader, columns: _Columns
) -> tuple[RawChunk, ScanIds | None]:
    stride = max(1, -(-header.points // SAMPLE_POINTS))
    sample = _slice(arrays, columns, slice(None, None, stride))
    if columns.scan_id is None:
        return sample, None
    lowest, highest, ordered, last = np.iinfo(np.int32).max, np.iinfo(np.int32).min, True, -1
    for start in range(0, header.points, CHUNK_POINTS):
        ids = as_scan_id(arrays[columns.scan_id][start : start + CHUNK_POINTS])
        ordered = ordered and (start == 0 or last <= ids[0]) and bool((ids[1:] >= ids[:-1]).all())
        lowest, highest, last = min(lowest, int(ids.min())), max(highest, int(ids.max())), int(ids[-1])
    return sample, ScanIds(lowest, highest, ordered)


def _slice(arrays: dict[str, NDArray[Any]], columns: _Columns, part: slice) -> RawChunk:
    kinds = [arrays[name] for name in columns.xyz]
    dtype = np.float32 if all(k.dtype == np.float32 for k in kinds) else np.float64
    points = np.column_stack([k[part].astype(dtype) for k in kinds])
    ids = None if columns.scan_id is None else as_scan_id(arrays[columns.scan_id][part])
    stamps = None if columns.stamp is None else arrays[columns.stamp][part].astype(np.float64)
    seen = {name: arrays[name][part] for name in columns.colours.names}
    rgb, intensity = rgb_of(seen, columns.colours), intensity_of(seen, columns.colours)
    return RawChunk(points, ids, stamps, rgb=rgb, intensity=intensity)


def _unpack(path: Path, header: PcdHeader) -> dict[str, NDArray[Any]]:
    """The single-valued fields by name; compressed PCD stores field after field, not point after point."""
    from floorplan_core.readers.lzf import MAX_EXPANSION, decompress

    with path.open("rb") as handle:
        handle.seek(header.size)
        sizes = np.frombuffer(handle.read(SIZES_BYTES), dtype="<u4")
        if len(sizes) < 2:
            _check_count(path, header, 0)
        packed, unpacked = (int(s) for s in sizes)
        there = path.stat().st_size - header.size - SIZES_BYTES
        if there < packed:
            raise InputError(
                f"{path.name} is truncated: {packed:,} bytes of compressed points are promised, "
                f"{there:,} are there; copy it again."
            )
        if unpacked != header.points * header.dtype.itemsize or unpacked > packed * MAX_EXPANSION:
            raise InputError(
                f"{path.name} is damaged: its {header.points:,} points of {header.dtype.itemsize} bytes "
                f"do not agree with {unpacked:,} bytes unpacked from {packed:,}."
            )
        if unpacked > KEPT_BYTES:
            held = np.memmap(handle, np.uint8, "r", header.size + SIZES_BYTES, (packed,))
            raw = decompress(np.asarray(held), unpacked, disk_array((unpacked,), np.uint8))
        else:
            raw = decompress(np.fromfile(handle, np.uint8, packed), unpacked)
    if raw is None:
        raise InputError(f"{path.name} is damaged: its compressed points cannot be unpacked.")
    arrays, start = {}, 0
    for name, count in zip(header.names, header.counts, strict=True):
        size = header.points * header.dtype[name].itemsize
        if count == 1:
            arrays[name] = raw[start : start + size].view(header.dtype[name])
        start += size
    return arrays


def _check_count(path: Path, header: PcdHeader, present: int) -> None:
    if present < header.points:
        raise InputError(
            f"{path.name} is truncated: its header promises {header.points:,} points, "
            f"the file holds {max(0, present):,} of them; copy it again."
        )


def _with_viewpoint(source: PointSource, header: PcdHeader) -> PointSource:
    """A single scan knows its sensor: every point then belongs to row 0 of a one-row trajectory."""
    if header.viewpoint is None or source.has_scan_id:
        return source
    x, y, z, *quaternion = header.viewpoint
    pose = np.eye(4)
    w, i, j, k = np.array(quaternion) / np.linalg.norm(quaternion)
    pose[:3, :3] = rotation_from_quaternion(np.array([[i, j, k, w]]))[0]
    pose[:3, 3] = x, y, z
    chunks, sample = source.chunks, source.sample
    return replace(
        source,
        chunks=lambda: (_first_scan(chunk) for chunk in chunks()),
        sample=lambda: _first_scan(sample()),
        has_scan_id=True,
        scan_ids=ScanIds(0, 0, True),
        poses=Trajectory(np.zeros(1), pose[None]),
        notes=(*source.notes, f"The viewpoint of {source.path.name} is taken as its sensor's origin."),
    )


def _first_scan(chunk: RawChunk) -> RawChunk:
    return replace(chunk, scan_id=np.zeros(len(chunk.points), dtype=np.int32))

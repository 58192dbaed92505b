"""LAS and LAZ 1.0 to 1.4 (laspy, lazrs): scaled integers, GPS time, classes, coordinate reference system."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from floorcast_plugins._las_header import (
    LasHead,
    check_chunks,
    name_of_crs,
    read_las_head,
    reference_system,
)
from floorplan_core.api import (
    CHUNK_POINTS,
    SAMPLE_POINTS,
    SCAN_ID_NAMES,
    InputError,
    Observer,
    PointSource,
    RawChunk,
    Reader,
    ReadOptions,
    Reconstruction,
    as_rgb,
    as_scan_id,
    assemble,
    damaged,
    find_name,
    hookimpl,
    import_library,
    join_chunks,
)

RGB = ("red", "green", "blue")
LAYERS = {
    "classification": "CLASSIFICATION",
    "withheld": "FLAGS",
    "intensity": "INTENSITY",
    "gps_time": "GPS_TIME",
    "red": "RGB",
}
CHUNK_BYTES = 64 << 20  # of records: wide ones come in smaller chunks
SAMPLE_BLOCKS = 128  # of LAS
# points: decoding holds the interpreter lock, 0.3 to 0.7 s for a whole chunk of ours; two of the 50,000 that
# writers pack together, which lazrs unpacks side by side
LAZ_PIECE = 100_000
SAMPLE_CHUNKS = 8  # of LAZ, where each place costs the decoding of a whole chunk of 50,000 points


@hookimpl
def floorcast_readers() -> list[Reader]:
    return [LasReader()]


class LasReader:
    """Airborne and mobile mapping's format."""

    name = "LAS"
    suffixes: tuple[str, ...] = (".las", ".laz")
    description = "LAS and LAZ 1.0 to 1.4, with GPS time, classes and CRS"

    def sniff(self, path: Path, head: bytes) -> float:
        """1 where the file begins with ``LASF``."""
        return 1.0 if head.startswith(b"LASF") else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the file; :class:`InputError` where header and contents do not agree."""
        return assemble(las_source(path, observer, options.colours), options, observer)


def las_source(path: Path, observer: Observer, colours: bool = True) -> PointSource:
    """The points of a LAS or LAZ file; without ``colours``, neither those nor intensities are unpacked."""
    head = read_las_head(path)
    with _opened(path) as file, damaged(path.name, "LAS file"):
        names = tuple(file.header.point_format.dimension_names)
        names = names if colours else tuple(n for n in names if n not in (*RGB, "intensity"))
        crs, unit = reference_system(file.header.vlrs)
        if head.compressed:
            check_chunks(path, head, file.header.vlrs)
    if unit == "deg":
        raise InputError(
            f"The coordinates of {path.name} are degrees ({name_of_crs(crs)}); project them to metres first."
        )
    notes = (f"Coordinates are in {name_of_crs(crs)}; this is kept for export.",) if crs else ()
    sample = _sample(path, head, names)
    if "gps_time" in names and not _tells_time(sample):
        names = tuple(n for n in names if n != "gps_time")
        sample = RawChunk(sample.points, sample.scan_id)
    return PointSource(
        path,
        "LAZ" if head.compressed else "LAS",
        partial(_counted_chunks, path, head, names, observer, []),
        lambda: sample,
        head.count,
        find_name(names, SCAN_ID_NAMES) is not None,
        notes=notes,
        unit=unit,
        up="z",
        crs=crs,
    )


def _opened(path: Path, names: tuple[str, ...] | None = None) -> Any:
    """laspy's reader of those dimensions; what it raises over the header is one sentence."""
    laspy = import_library("laspy", "laspy[lazrs]", "LAS and LAZ")
    with damaged(path.name, "LAS file"):
        return laspy.open(path, read_evlrs=False, decompression_selection=_used(laspy, names))


def _used(laspy: Any, names: tuple[str, ...] | None) -> Any:
    """The layers of the records (LAZ 1.4) that have to be unpacked; other files are read whole anyway."""
    layers = laspy.DecompressionSelection
    if names is None or find_name(names, SCAN_ID_NAMES) is not None:  # a scan id may be in any of them
        return layers.all()
    wanted = layers.base() | layers.Z
    for name in set(LAYERS).intersection(names):
        wanted |= layers[LAYERS[name]]
    return wanted


def _counted_chunks(
    path: Path, head: LasHead, names: tuple[str, ...], observer: Observer, reported: list[bool]
) -> Iterator[RawChunk]:
    """All points but noise; the first whole pass says how much of that there was."""
    noise = 0
    for chunk, dropped in _chunks(path, head, names):
        noise += dropped
        yield chunk
    if noise and not reported:
        reported.append(True)
        observer.warning(
            f"{noise:,} of the {head.count:,} points of {path.name} are classified as noise or withheld; "
            "they were left out."
        )


def _chunks(path: Path, head: LasHead, names: tuple[str, ...]) -> Iterator[tuple[RawChunk, int]]:
    """Points, and how many were noise, a chunk at a time."""
    size, piece = _chunk_size(head)
    with _opened(path, names) as file:
        left = head.count
        while left > 0:
            wanted = min(size, left)
            with damaged(path.name, "LAS file"):
                read, chunk, noise = _gather(_pieces(file, wanted, piece), wanted, names)
            if read < wanted:
                raise InputError(
                    f"{path.name} is truncated: its header promises {head.count:,} points, "
                    f"{head.count - left + read:,} of them exist."
                )
            left -= read
            yield chunk, noise


def _chunk_size(head: LasHead) -> tuple[int, int]:
    """Records of a chunk, and of the pieces in which it is read."""
    size = max(1, min(CHUNK_POINTS, CHUNK_BYTES // head.record))
    if not head.compressed:
        return size, size
    piece = min(LAZ_PIECE, size)
    return size // piece * piece, piece


def _pieces(file: Any, wanted: int, piece: int) -> Iterator[Any]:
    """So many further records; fewer where the file ends."""
    while wanted > 0 and len(records := file.read_points(min(piece, wanted))):
        wanted -= len(records)
        yield records


def _gather(pieces: Iterator[Any], most: int, names: tuple[str, ...]) -> tuple[int, RawChunk, int]:
    """How many records there were, ``most`` or fewer, those that are no noise, and how many were."""
    from floorcast_plugins._las_points import unpack  # a kernel: only for files that need it

    points, columns, read, kept = np.empty((most, 3)), [], 0, 0
    for records in pieces:
        good, bad = unpack(records.array, records.scales, records.offsets, points[kept:])
        columns.append(_columns(records, slice(None) if good == len(bad) else ~bad, names))
        read, kept = read + len(bad), kept + good
    found = join_chunks(columns) if columns else RawChunk(points)
    return read, replace(found, points=points[:kept]), read - kept


def _columns(records: Any, good: Any, names: tuple[str, ...]) -> RawChunk:
    """What the good ones of the records say besides where they are."""
    raw, scan = records.array, find_name(names, SCAN_ID_NAMES)
    ids = None if scan is None else as_scan_id(np.asarray(records[scan])[good])
    stamps = raw["gps_time"][good].astype(np.float64) if "gps_time" in names else None
    rgb = as_rgb(np.column_stack([raw[name][good] for name in RGB])) if set(RGB) <= set(names) else None
    echo = raw["intensity"][good].astype(np.float32) if "intensity" in names else None
    return RawChunk(np.empty((0, 3)), ids, stamps, rgb=rgb, intensity=echo)


def _sample(path: Path, head: LasHead, names: tuple[str, ...]) -> RawChunk:
    """Points of places that are spread over the file."""
    places = SAMPLE_CHUNKS if head.compressed else SAMPLE_BLOCKS
    length = min(head.count, SAMPLE_POINTS if head.count <= SAMPLE_POINTS else SAMPLE_POINTS // places)
    starts = [0] if length == head.count else np.linspace(0, head.count - length, places).astype(int).tolist()
    with _opened(path) as file, damaged(path.name, "LAS file"):
        return _gather(_records_at(file, starts, length), len(starts) * length, names)[1]


def _records_at(file: Any, starts: list[int], length: int) -> Iterator[Any]:
    for start in starts:
        if start:
            file.seek(start)
        yield file.read_points(length)


def _tells_time(sample: RawChunk) -> bool:
    """True where the GPS times differ; many writers leave them at zero."""
    stamps = sample.stamps
    return stamps is not None and len(stamps) > 0 and bool(np.ptp(stamps) > 0)

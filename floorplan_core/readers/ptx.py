"""PTX text: scans of terrestrial scanners, each with its own pose, one after the other.

A scan begins with ten lines: columns, rows, the scanner's position, its three axes, and a matrix of four rows
that moves row vectors (``[x y z 1] M``) from the scan into the common frame. ``columns * rows`` lines of
points follow, in the scan's frame; ``0 0 0`` is a direction in which nothing came back.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from os import SEEK_CUR
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.plugins import ReadOptions
from floorplan_core.readers.assemble import assemble
from floorplan_core.readers.foreign import spread_sample
from floorplan_core.readers.source import SAMPLE_BLOCKS, EmptyInput, PointSource, RawChunk, ScanIds
from floorplan_core.readers.text_rows import TextLayout, text_chunks, text_sample
from floorplan_core.readers.trajectory_check import WrongTrajectory
from floorplan_core.readers.trajectory_forms import is_rigid

Float = NDArray[np.float64]

HEADER = (1, 1, 3, 3, 3, 3, 4, 4, 4, 4)  # numbers on each line of a scan's header
MAX_LINE_BYTES = 1 << 12  # a longer line is none of a header or of a point
BLOCK_BYTES = 4 << 20
MAX_SIDE = 10**7  # columns or rows of one scan: a header with more is none
SAMPLE_SCANS = 32


@dataclass(frozen=True)
class PtxScan:
    """Where the points of one scan are in the file, and how they move into its common frame."""

    offset: int  # of the first line of points, bytes
    end: int  # after the last one
    columns: int  # numbers on a line of points
    lines: int  # that the file holds of it
    announced: int  # lines that its header announces
    T_file_scan: Float  # (4, 4) moves the points
    scanner: Float  # (4, 4) pose of the scanner in the file's common frame


class PtxReader:
    """Leica's text format, which most programs for laser scanners write."""

    name = "PTX"
    suffixes: tuple[str, ...] = (".ptx",)
    description = "PTX text: scans with their poses, directions without an echo left out"

    def sniff(self, path: Path, head: bytes) -> float:
        """0.9 where the first ten lines are the header of a scan: before text with one point a line."""
        lines = head.decode("latin-1").splitlines()
        return 0.9 if _numbers(lines[: len(HEADER)]) is not None else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the file; :class:`InputError` where a header is damaged or no points follow."""
        source = ptx_source(path)
        try:
            return assemble(source, options, observer)
        except WrongTrajectory as error:
            if source.poses is None or options.trajectory is not None:
                raise
            observer.warning(f"{error} The poses of its scans are not taken for the sensor's.")
            return assemble(_without_sensors(source), options, observer)


def ptx_source(path: Path) -> PointSource:
    """The points of all scans."""
    scans = [scan for scan in list_scans(path) if scan.lines]
    if not scans:
        raise EmptyInput(f"{path.name} is a PTX file without points.")
    # A cloud that a program merged says of every scan that it stood at the origin, unturned.
    posed = len(scans) == 1 or any(not np.array_equal(s.scanner, np.eye(4)) for s in scans)
    poses = Trajectory(np.arange(len(scans), dtype=np.float64), np.array([s.scanner for s in scans]))
    source = PointSource(
        path,
        "PTX",
        partial(_chunks, path, scans),
        partial(_sample, path, scans),
        None,
        True,
        ScanIds(0, len(scans) - 1, True),
        poses,
        tuple(_notes(path.name, scans, posed)),
        scans=len(scans),
    )
    return source if posed else _without_sensors(source)


def _notes(name: str, scans: list[PtxScan], posed: bool) -> Iterator[str]:
    count = f"{len(scans)} scan" + "s" * (len(scans) > 1)
    if posed:
        yield f"{name} holds {count}, each with the position of its scanner."
    else:
        yield f"{name} holds {count} without scanner positions: where each point was seen from is not known."
    last = scans[-1]
    if last.lines < last.announced:
        yield (
            f"The last scan of {name} announces {last.announced:,} points and ends after {last.lines:,}; "
            "those are used."
        )


def _without_sensors(source: PointSource) -> PointSource:
    def chunks() -> Iterator[RawChunk]:
        return (replace(chunk, scan_id=None) for chunk in source.chunks())

    return replace(
        source,
        chunks=chunks,
        sample=lambda: replace(source.sample(), scan_id=None),
        has_scan_id=False,
        scan_ids=None,
        poses=None,
    )


def list_scans(path: Path) -> list[PtxScan]:
    """All scans of the file, in one pass that only counts lines. :class:`InputError` for a damaged header."""
    scans: list[PtxScan] = []
    size = path.stat().st_size
    with path.open("rb") as handle:
        while (start := handle.tell()) < size:
            lines = [handle.readline(MAX_LINE_BYTES).decode("latin-1") for _ in HEADER]
            if scans and not "".join(lines).strip():
                break  # empty lines at the end
            values = _numbers(lines)
            if values is None:
                raise InputError(
                    f"{path.name} is damaged: the lines from byte {start:,} are no header of scan "
                    f"{len(scans) + 1}."
                )
            scans.append(_scan(handle, values))
    return scans


def _scan(handle: BinaryIO, values: list[list[float]]) -> PtxScan:
    """The scan whose header holds ``values``; leaves ``handle`` after its last point."""
    offset, announced = handle.tell(), int(values[0][0]) * int(values[1][0])
    columns = len(handle.readline(MAX_LINE_BYTES).split())
    handle.seek(offset)
    lines = _skip_lines(handle, announced)
    T, pose = np.array(values[6:10]).T, _pose(values)
    if not pose[:3, 3].any():  # written by programs that know the matrix only
        pose = T
    return PtxScan(offset, handle.tell(), columns, lines, announced, T, pose)


def _skip_lines(handle: BinaryIO, count: int) -> int:
    """Go ``count`` lines ahead, or to the end of the file; returns how many there were."""
    found, open_line = 0, False
    while found < count and (block := handle.read(BLOCK_BYTES)):
        ends_here = np.frombuffer(block, np.uint8) == ord("\n")
        inside = int(np.count_nonzero(ends_here))
        if found + inside >= count:
            ends = np.flatnonzero(ends_here)
            handle.seek(int(ends[count - found - 1]) + 1 - len(block), SEEK_CUR)
            return count
        found += inside
        open_line = not block.endswith(b"\n")
    return found + open_line


def _numbers(lines: list[str]) -> list[list[float]] | None:
    """The numbers of the ten lines of a header; None where they are no header."""
    if len(lines) < len(HEADER):
        return None
    try:
        values = [[float(word) for word in line.split()] for line in lines]
    except ValueError:
        return None
    if tuple(map(len, values)) != HEADER or not all(np.isfinite(v).all() for v in values):
        return None
    whole = all(float(n).is_integer() and 0 <= n < MAX_SIDE for (n,) in values[:2])
    rigid = is_rigid(np.array([np.array(values[6:10]).T, _pose(values)]), mirrored=None)
    return values if whole and rigid.all() else None


def _pose(values: list[list[float]]) -> Float:
    """(4, 4) of the scanner, from its position and axes."""
    pose = np.eye(4)
    pose[:3, :3] = np.array(values[3:6]).T  # the axes are the rows
    pose[:3, 3] = values[2]
    return pose


def _chunks(path: Path, scans: list[PtxScan]) -> Iterator[RawChunk]:
    for row, scan in enumerate(scans):
        for chunk in text_chunks(path, _layout(scan)):
            yield _placed(chunk, scan, row)


def _sample(path: Path, scans: list[PtxScan]) -> RawChunk:
    """Points of scans that are spread over the file, in file coordinates."""
    rows = np.unique(np.linspace(0, len(scans) - 1, SAMPLE_SCANS).astype(int)).tolist()
    blocks = min(SAMPLE_BLOCKS, 4 * SAMPLE_BLOCKS // len(rows))  # more than enough: many rays have no return
    return spread_sample([_placed(text_sample(path, _layout(scans[r]), blocks), scans[r], r) for r in rows])


def _layout(scan: PtxScan) -> TextLayout:
    return TextLayout(scan.offset, scan.columns, (0, 1, 2), end=scan.end)


def _placed(chunk: RawChunk, scan: PtxScan, row: int) -> RawChunk:
    """What came back, with the scan's number and pose."""
    points = chunk.points[chunk.points.any(axis=1)]
    ids = np.full(len(points), row, dtype=np.int32)
    return RawChunk(points, ids, T_file_sensor=scan.T_file_scan, dropped=chunk.dropped)

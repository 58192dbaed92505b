"""E57 (described by pye57): scans with poses, cartesian or spherical, invalid points left out.

Where scans are in the frame of their scanner, the scan's origin is the sensor's: its poses are the trajectory
and the scan's number the ``scan_id``. A merged cloud has no viewpoint, and gets none.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from floorplan_core.api import (
    EmptyInput,
    Observer,
    PointSource,
    RawChunk,
    Reader,
    ReadOptions,
    Reconstruction,
    ScanIds,
    Trajectory,
    WrongTrajectory,
    assemble,
    hookimpl,
    spread_sample,
)

if TYPE_CHECKING:
    from floorcast_plugins._e57_scans import E57Scan

SAMPLE_SCANS = 32
SAMPLE_READ = 1 << 20  # points of all scans together that are read for the sample: libE57 cannot seek


@hookimpl
def floorcast_readers() -> list[Reader]:
    return [E57Reader()]


class E57Reader:
    """Terrestrial scanners' exchange format."""

    name = "E57"
    suffixes: tuple[str, ...] = (".e57",)
    description = "E57: several scans with poses, cartesian or spherical"

    def sniff(self, path: Path, head: bytes) -> float:
        """1 where the file begins with ``ASTM-E57``."""
        return 1.0 if head.startswith(b"ASTM-E57") else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the file; :class:`InputError` where it is damaged or holds no points."""
        source = e57_source(path, options.trajectory is not None, options.colours)
        try:
            return assemble(source, options, observer)
        except WrongTrajectory as error:
            if source.poses is None:
                raise
            observer.warning(f"{error} The poses of its scans are not taken for the sensor's.")
            return assemble(_without_sensors(source), options, observer)


def e57_source(path: Path, trajectory_given: bool = False, colours: bool = True) -> PointSource:
    """The points of all scans; without ``colours`` and intensities if nobody wants them."""
    from floorcast_plugins._e57_scans import (
        SEEN,
        check_file,
        list_scans,
    )  # kernels: only for files that need them

    scans = list_scans(path, check_file(path))
    if not scans:
        raise EmptyInput(f"{path.name} is an E57 file without points.")
    scans = scans if colours else [replace(scan, fields=scan.fields.difference(SEEN)) for scan in scans]
    by_time = trajectory_given and all("timeStamp" in scan.fields for scan in scans)
    sensors = all(scan.from_sensor for scan in scans) and not by_time
    sample = _sample(path, scans)
    total = sum(scan.count for scan in scans)
    return PointSource(
        path,
        "E57",
        partial(_chunks, path, scans, sensors),
        lambda: sample if sensors else replace(sample, scan_id=None),
        total,
        sensors,
        ScanIds(0, len(scans) - 1, True) if sensors else None,
        _trajectory(scans) if sensors and not trajectory_given else None,
        (_note(path.name, scans, sensors),),
        unit="m",
        scans=len(scans),
    )


def _note(name: str, scans: list[E57Scan], sensors: bool) -> str:
    count = f"{len(scans)} scan" + ("s" if len(scans) > 1 else "")
    if sensors:
        return f"{name} holds {count}; each was seen from the origin of its own frame."
    return f"{name} holds {count} without scanner positions: where each point was seen from is not known."


def _trajectory(scans: list[E57Scan]) -> Trajectory:
    """One row a scan; the times of the scans where they rise, else their numbers."""
    seconds = np.array([scan.seconds for scan in scans])
    if not (np.diff(seconds) > 0).all():
        seconds = np.arange(len(scans), dtype=np.float64)
    return Trajectory(seconds, np.array([scan.pose for scan in scans]))


def _without_sensors(source: PointSource) -> PointSource:
    def chunks() -> Iterator[RawChunk]:
        return (replace(chunk, scan_id=None) for chunk in source.chunks())

    sample = replace(source.sample(), scan_id=None)
    return replace(
        source, chunks=chunks, sample=lambda: sample, has_scan_id=False, scan_ids=None, poses=None, notes=()
    )


def _chunks(path: Path, scans: list[E57Scan], sensors: bool) -> Iterator[RawChunk]:
    from floorcast_plugins._e57_scans import read_scan

    for row, scan in enumerate(scans):
        for read in read_scan(path, scan):
            yield _chunk(read, scan, row if sensors else None)


def _chunk(read: RawChunk, scan: E57Scan, row: int | None) -> RawChunk:
    ids = None if row is None else np.full(len(read.points), row, dtype=np.int32)
    return replace(read, scan_id=ids, T_file_sensor=scan.pose if scan.posed else None)


def _sample(path: Path, scans: list[E57Scan]) -> RawChunk:
    """Points from the beginning of scans that are spread over the file, in file coordinates."""
    from floorcast_plugins._e57_scans import read_scan

    rows = np.unique(np.linspace(0, len(scans) - 1, SAMPLE_SCANS).astype(int)).tolist()
    parts = []
    for row in rows:
        with closing(read_scan(path, scans[row], SAMPLE_READ // len(rows))) as buffers:
            read = next(buffers)
        parts.append(_chunk(read, scans[row], row))
    if not any(len(part.points) for part in parts):
        raise EmptyInput(f"All points of {path.name} that were looked at are marked as invalid.")
    return spread_sample(parts)

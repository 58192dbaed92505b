"""Points with time stamps and a trajectory: each point gets the row that is nearest in time.

Clocks differ: LAS writes GPS time less 10^9 seconds ("adjusted"), or seconds of the GPS week; robots write
Unix time. The clock under which most stamps of the sample lie within the trajectory is taken, and stated.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import Trajectory
from floorplan_core.observer import Observer
from floorplan_core.readers.source import PointSource, RawChunk

Float = NDArray[np.float64]

TOLERANCE = 0.5  # seconds: a walker moves less than a voxel map forgives; rows are 0.1 s to 1 s apart
TOLERANCE_STEPS = 1.0  # times the median step of the rows, where these are farther apart
MIN_MATCHED = 0.5  # share of the sample that must have a row before the times are believed
WEEK = 604_800.0  # seconds
ADJUSTED = 1e9  # LAS: adjusted standard GPS time is GPS time less this
GPS_TO_UNIX = 315_964_800.0 - 18.0  # 1980-01-06 in Unix time, less the leap seconds since 2017
CLOCKS: dict[str, float] = {
    "": 0.0,
    "GPS time": ADJUSTED,
    "Unix time": ADJUSTED + GPS_TO_UNIX,
    "Unix time, from GPS time": GPS_TO_UNIX,
}  # tried in this order; ties go to the first


def join_by_time(source: PointSource, sample: RawChunk, path: Trajectory, observer: Observer) -> PointSource:
    """``source`` with scan ids that are rows of ``path``; unchanged where it has ids or no stamps.

    Points without a row within the tolerance are left out and counted. :class:`InputError` where the times of
    the file and of the trajectory have nothing in common.
    """
    if source.has_scan_id or sample.stamps is None or len(sample.stamps) == 0:
        return source
    rows = np.asarray(path.stamps, dtype=np.float64)
    tolerance = time_tolerance(rows)
    clocks = _clocks(sample.stamps, rows)
    shares = {name: _share(sample.stamps + offset, rows, tolerance) for name, offset in clocks.items()}
    clock = max(shares, key=lambda name: shares[name])
    if shares[clock] < MIN_MATCHED:
        raise InputError(_disjoint(source.path.name, sample.stamps, rows))
    offset = clocks[clock]
    notes = [f"Points are joined to the trajectory by time, at most {tolerance:.3g} s apart."]
    if clock:
        notes.append(f"The trajectory's clock is {clock}, {offset:+,.0f} s from that of {source.path.name}.")
    join = _Join(source, rows, offset, tolerance, observer)
    return replace(
        source,
        chunks=join.chunks,
        sample=lambda: join.chunk(sample)[0],
        has_scan_id=True,
        notes=(*source.notes, *notes),
    )


def time_tolerance(rows: Float) -> float:
    """Seconds up to which a stamp belongs to the nearest of the (M,) stamps ``rows``."""
    steps = np.diff(rows)
    steps = steps[steps > 0]
    return max(TOLERANCE, TOLERANCE_STEPS * float(np.median(steps)) if len(steps) else 0.0)


def nearest_rows(stamps: Float, rows: Float, tolerance: float) -> NDArray[np.int32]:
    """(N,) row of ``rows`` (rising) nearest to each stamp, the earlier of two; -1 beyond the tolerance."""
    from floorplan_core.geometry.nearest_rows import nearest  # a kernel: only for files that need it

    return nearest(
        np.ascontiguousarray(stamps, dtype=np.float64), np.ascontiguousarray(rows), float(tolerance)
    )


class _Join:
    """Chunks of a source with scan ids by time; the first whole pass reports what had no row."""

    def __init__(
        self, source: PointSource, rows: Float, offset: float, tolerance: float, observer: Observer
    ) -> None:
        self._source, self._rows, self._observer = source, rows, observer
        self._offset, self._tolerance = offset, tolerance
        self._reported = False

    def chunks(self) -> Iterator[RawChunk]:
        lost = total = 0
        for raw in self._source.chunks():
            chunk, without = self.chunk(raw)
            lost, total = lost + without, total + len(raw.points)
            yield chunk
        if lost and not self._reported:
            self._observer.warning(
                f"{lost:,} of the {total:,} points of {self._source.path.name} are more than "
                f"{self._tolerance:.3g} s from any row of the trajectory; they were left out."
            )
        self._reported = True

    def chunk(self, raw: RawChunk) -> tuple[RawChunk, int]:
        """``raw`` with scan ids, and how many points had no row."""
        stamps = np.full(len(raw.points), np.nan) if raw.stamps is None else raw.stamps
        ids = nearest_rows(stamps + self._offset, self._rows, self._tolerance)
        keep = ids >= 0
        if keep.all():
            return replace(raw, scan_id=ids), 0
        chunk = replace(
            raw,
            points=raw.points[keep],
            scan_id=ids[keep],
            stamps=stamps[keep],
            rgb=None if raw.rgb is None else raw.rgb[keep],
            intensity=None if raw.intensity is None else raw.intensity[keep],
        )
        return chunk, int(len(keep) - np.count_nonzero(keep))


def _clocks(stamps: Float, rows: Float) -> dict[str, float]:
    """Offsets to try; with that to seconds of the GPS week where the rows may be such."""
    clocks = dict(CLOCKS)
    finite = stamps[np.isfinite(stamps)]
    if len(finite) and rows[0] >= 0 and rows[-1] < 2 * WEEK:
        # 10^9 s are 1653 weeks and 265,600 s; the week is that of the first stamps
        start = np.floor((finite.min() + ADJUSTED) / WEEK) * WEEK
        clocks["seconds of the GPS week"] = float(ADJUSTED - start)
    return clocks


def _share(stamps: Float, rows: Float, tolerance: float) -> float:
    return float((nearest_rows(stamps, rows, tolerance) >= 0).mean())


def _disjoint(name: str, stamps: Float, rows: Float) -> str:
    return (
        f"The times of {name} ({np.nanmin(stamps):.1f} to {np.nanmax(stamps):.1f} s) and of the trajectory "
        f"({rows[0]:.1f} to {rows[-1]:.1f} s) do not meet; give the trajectory of this survey."
    )

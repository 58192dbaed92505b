"""A recorded run, replayed in the order in which the sensor saw it, cut into intervals of run time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from floorplan_core.errors import InputError
from floorplan_core.model import PointChunk, Reconstruction, Trajectory


@dataclass(frozen=True)
class Interval:
    """What the sensor saw in one interval, and where the run stands at its end."""

    end: float  # seconds since the first pose
    path_length: float  # metres from the first pose to the last one of the interval
    chunks: Iterator[PointChunk]  # to be used before the next interval is asked for
    trajectory: Trajectory  # to which the scan ids of the chunks refer, local frame


def intervals(reconstruction: Reconstruction, every: float) -> Iterator[Interval]:
    """The intervals of ``every`` seconds in which at least one point was seen, in order.

    Raises :class:`InputError` where the survey does not say when its points were seen.
    """
    trajectory = _trajectory(reconstruction)
    number = interval_numbers(trajectory.stamps, every)
    duration = float(trajectory.stamps[-1] - trajectory.stamps[0])
    lengths = path_lengths(trajectory)
    for index, group in groupby(_pieces(reconstruction, number), key=lambda piece: piece[0]):
        end = min((index + 1) * every, duration)
        last = int(np.searchsorted(number, index, side="right")) - 1
        yield Interval(end, float(lengths[last]), (chunk for _, chunk in group), trajectory)


def interval_numbers(
    stamps: np.ndarray[tuple[int], np.dtype[np.float64]], every: float
) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    """The interval of each stamp, from 0; a scan on the clock ends its interval."""
    number = np.ceil((stamps - stamps[0]) / every) - 1
    return np.asarray(np.maximum(number, 0), dtype=np.int64)


def path_lengths(trajectory: Trajectory) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """(M,) metres of path from the first pose to each; of several sensors that of the main one so far."""
    path = trajectory.of_main_sensor()
    steps = np.linalg.norm(np.diff(path.origins, axis=0), axis=1)
    lengths = np.concatenate([[0.0], np.cumsum(steps)])
    if trajectory.sensor is None:
        return lengths
    # What came later must not change a length that was told: drift correction cuts a growing path by them.
    so_far = np.cumsum(trajectory.sensor == 0)
    return np.asarray(lengths[np.maximum(so_far - 1, 0)])


def _trajectory(reconstruction: Reconstruction) -> Trajectory:
    if reconstruction.trajectory is None or len(reconstruction.trajectory) == 0:
        raise InputError(
            f"{reconstruction.name} has no trajectory, so nobody knows when its points were seen; "
            "give one with --trajectory, or use 'floorcast plan'."
        )
    return reconstruction.trajectory


def _pieces(
    reconstruction: Reconstruction, number: np.ndarray[tuple[int], np.dtype[np.int64]]
) -> Iterator[tuple[int, PointChunk]]:
    """The points in scan order, cut where a new interval begins: (interval number, chunk)."""
    for chunk in _in_order(reconstruction):
        of_point = number[_scan_ids(chunk, reconstruction)]
        cuts = np.flatnonzero(np.diff(of_point)) + 1
        for start, stop in zip([0, *cuts], [*cuts, len(of_point)], strict=True):
            if stop > start:
                yield int(of_point[start]), _slice(chunk, int(start), int(stop))


def _in_order(reconstruction: Reconstruction) -> Iterator[PointChunk]:
    """The chunks with rising scan_id; a file in another order has to be held in memory once."""
    if reconstruction.scans_ordered:
        yield from reconstruction.chunks()
        return
    chunks = list(reconstruction.chunks())
    if chunks:
        scan_id = np.concatenate([_scan_ids(chunk, reconstruction) for chunk in chunks])
        order = np.argsort(scan_id, kind="stable")
        yield PointChunk(np.concatenate([c.points for c in chunks])[order], scan_id[order].astype(np.int32))


def _scan_ids(
    chunk: PointChunk, reconstruction: Reconstruction
) -> np.ndarray[tuple[int], np.dtype[np.int32]]:
    if chunk.scan_id is None:
        raise InputError(
            f"The points of {reconstruction.name} carry no scan_id, so nobody knows when they were seen; "
            "a PLY with that property or a folder of scans can be replayed."
        )
    return chunk.scan_id


def _slice(chunk: PointChunk, start: int, stop: int) -> PointChunk:
    part = slice(start, stop)
    return PointChunk(
        chunk.points[part],
        None if chunk.scan_id is None else chunk.scan_id[part],
        None if chunk.stamps is None else chunk.stamps[part],
    )

"""From a source in file coordinates to a reconstruction in metres, z up, near the origin."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import LocalFrame, PointChunk, Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.plugins import ReadOptions
from floorplan_core.readers.axes import guess_axes
from floorplan_core.readers.local import (
    LIMIT,
    choose_shift,
    keep_finite,
    local_points,
    local_trajectory,
    world_points,
)
from floorplan_core.readers.source import PointSource, RawChunk
from floorplan_core.readers.trajectory import read_trajectory
from floorplan_core.readers.trajectory_files import (
    belongs,
    check_plausible,
    check_rows,
    find_trajectory,
    fit_unit,
)
from floorplan_core.units import METRES_PER_UNIT, up_rotation

Float = NDArray[np.float64]


def assemble(source: PointSource, options: ReadOptions, observer: Observer) -> Reconstruction:
    """Guess unit, up axis and shift on a sample, find and check the trajectory, wire up the chunks."""
    name = source.path.name
    notes = list(source.notes)
    sample = source.sample()
    points, scan_id = finite_sample(sample, name)
    trajectory = _trajectory(source, options, observer, notes)
    if trajectory is not None and source.has_scan_id and source.scan_ids is not None:
        check_rows(name, source.scan_ids, len(trajectory))
    near = trajectory if trajectory is not None and belongs(points, trajectory) else None
    guess = guess_axes(points, near, options.input.unit, options.input.up)
    notes.extend(guess.sentences)
    scale, rotation = METRES_PER_UNIT[guess.unit], up_rotation(guess.up)
    frame = LocalFrame(scale, guess.unit, guess.up, rotation)
    in_world = world_points(points, frame)
    frame = replace(frame, shift=choose_shift(in_world))
    if frame.shift.any():
        notes.append(_shift_sentence(frame, sample))
    if trajectory is not None:
        in_metres = fit_unit(points, trajectory, frame.scale)
        if in_metres is not None:
            notes.append("The trajectory is in metres, unlike the points.")
        trajectory = local_trajectory(in_metres or trajectory, frame)
        ids = _usable(scan_id, len(trajectory), name)
        check_plausible(name, in_world - frame.shift, ids, trajectory, options.input.max_range)
    rows = None if trajectory is None or not source.has_scan_id else len(trajectory)
    return Reconstruction(
        name=name,
        chunks=chunk_factory(source, frame, rows, observer),
        point_count=source.count,
        trajectory=trajectory,
        local_frame=frame,
        scans_ordered=source.scan_ids is not None and source.scan_ids.ordered and rows is not None,
        assumptions=tuple(notes),
        format=source.format,
    )


def finite_sample(sample: RawChunk, name: str) -> tuple[Float, NDArray[np.int32] | None]:
    """(N, 3) usable points of the sample in file coordinates, and their scan ids."""
    points = np.asarray(sample.points, dtype=np.float64)
    good = np.isfinite(points).all(axis=1) & (np.abs(points) < LIMIT / min(METRES_PER_UNIT.values())).all(
        axis=1
    )
    if not good.any():
        raise InputError(f"{name} holds no point with finite coordinates of a plausible size.")
    points = points[good]
    return points, None if sample.scan_id is None else sample.scan_id[good]


def chunk_factory(
    source: PointSource, frame: LocalFrame, rows: int | None, observer: Observer
) -> Callable[[], Iterator[PointChunk]]:
    """A function that starts a pass; the first whole pass reports what was left out."""
    reported: list[bool] = []

    def chunks() -> Iterator[PointChunk]:
        left_out = unreadable = total = 0
        for raw in source.chunks():
            observer.check_cancelled()
            chunk, lost = _local_chunk(raw, frame)
            if rows is not None and chunk.scan_id is not None:
                _usable(chunk.scan_id, rows, source.path.name)
            total += len(raw.points)
            left_out += lost
            unreadable += raw.dropped
            if len(chunk.points):
                yield chunk
        if not reported:
            reported.append(True)
            _report(source.path.name, left_out, unreadable, total, observer)

    return chunks


def _local_chunk(raw: RawChunk, frame: LocalFrame) -> tuple[PointChunk, int]:
    points = local_points(raw.points, frame, raw.T_file_sensor)
    keep = keep_finite(points)
    if keep is None:
        return PointChunk(points, raw.scan_id, raw.stamps), 0
    chunk = PointChunk(
        points[keep],
        None if raw.scan_id is None else raw.scan_id[keep],
        None if raw.stamps is None else raw.stamps[keep],
    )
    return chunk, int(len(points) - len(chunk.points))


def _report(name: str, left_out: int, unreadable: int, total: int, observer: Observer) -> None:
    if left_out:
        observer.warning(
            f"{left_out:,} of the {total:,} points of {name} are not finite or absurdly far away; "
            "they were left out."
        )
    if unreadable:
        observer.warning(f"{unreadable:,} lines of {name} hold no point; they were left out.")


def _trajectory(
    source: PointSource, options: ReadOptions, observer: Observer, notes: list[str]
) -> Trajectory | None:
    """The trajectory that was asked for, or that lies beside the cloud, or that the file carries."""
    if options.trajectory is not None:
        return read_trajectory(options.trajectory, observer)
    if source.poses is not None:
        return source.poses
    beside = find_trajectory(source.path)
    if beside is not None:
        notes.append(f"The trajectory is {beside.name}, found beside {source.path.name}.")
        return read_trajectory(beside, observer)
    if source.has_scan_id:
        notes.append(f"No trajectory was found beside {source.path.name}: sensor positions are not known.")
    return None


def _usable(scan_id: NDArray[np.int32] | None, rows: int, name: str) -> NDArray[np.int32] | None:
    """``scan_id`` if all of it refers to rows of the trajectory; :class:`InputError` otherwise."""
    if scan_id is None or len(scan_id) == 0:
        return scan_id
    from floorplan_core.readers.source import ScanIds

    check_rows(name, ScanIds(int(scan_id.min()), int(scan_id.max()), False), rows)
    return scan_id


def _shift_sentence(frame: LocalFrame, sample: RawChunk) -> str:
    x, y, z = frame.shift
    text = (
        f"Coordinates are large: ({x:.0f}, {y:.0f}, {z:.0f}) m is subtracted inside "
        "and restored in every export."
    )
    if sample.points.dtype == np.float32:
        spacing = float(np.spacing(np.float32(np.abs(frame.shift).max() / frame.scale))) * frame.scale
        text += f" The file stores them in 32 bits, which resolves only {spacing:.3g} m there."
    return text

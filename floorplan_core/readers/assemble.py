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
from floorplan_core.readers.axes import AxisGuess, guess_axes
from floorplan_core.readers.join_time import join_by_time
from floorplan_core.readers.local import (
    LIMIT,
    choose_shift,
    keep_finite,
    local_points,
    local_trajectory,
    world_points,
)
from floorplan_core.readers.source import PointSource, RawChunk, ScanIds
from floorplan_core.readers.trajectory import read_trajectory
from floorplan_core.readers.trajectory_check import belongs, check_plausible, check_rows, fit_unit
from floorplan_core.readers.trajectory_files import find_trajectory
from floorplan_core.readers.trajectory_forms import are_reflections
from floorplan_core.units import METRES_PER_UNIT, UNIT_NAMES, up_rotation

Float = NDArray[np.float64]


def assemble(source: PointSource, options: ReadOptions, observer: Observer) -> Reconstruction:
    """Guess unit, up axis and shift on a sample, find and check the trajectory, wire up the chunks."""
    sample = source.sample()
    path, notes = _find_path(source, options, observer)
    if path is not None and (joined := join_by_time(source, sample, path, observer)) is not source:
        source, sample = joined, joined.sample()
    points, scan_id = finite_sample(sample, source.path.name)
    if path is not None:
        _check_rows(source, scan_id, len(path))
    near = path if path is not None and belongs(points, path) else None
    guess = _guess(source, points, near, options)
    mirrored, handedness = _handedness(options.input.mirrored, path)
    frame = replace(_local_frame(points, guess, mirrored), crs=source.crs)
    notes += handedness
    if frame.shift.any():
        notes.append(_shift_sentence(frame, sample))
    trajectory = None
    if path is not None:
        trajectory = _trajectory(source, points, scan_id, path, frame, options, observer, notes)
    rows = len(trajectory) if trajectory is not None and source.has_scan_id else None
    return Reconstruction(
        name=source.path.name,
        chunks=chunk_factory(source, frame, rows, observer),
        point_count=source.count,
        trajectory=trajectory,
        local_frame=frame,
        scans_ordered=rows is not None and source.scan_ids is not None and source.scan_ids.ordered,
        assumptions=(*source.notes, *notes, *guess.sentences),
        format=source.format,
        scans=_scan_count(source),
        topics=source.topics,
    )


def _scan_count(source: PointSource) -> int | None:
    """As the file says, else by the scan ids of its points."""
    if source.scans is not None or source.scan_ids is None:
        return source.scans
    return source.scan_ids.highest - source.scan_ids.lowest + 1


def _guess(source: PointSource, points: Float, path: Trajectory | None, options: ReadOptions) -> AxisGuess:
    """What the user asked for, else what the format fixes, else what the points look like."""
    asked = options.input
    up = source.up if asked.up == "auto" else asked.up
    guess = guess_axes(points, path, asked.unit, up, usual=source.unit)
    words = f"as {source.format} files have it"
    up_said, unit_said = guess.sentences
    if asked.up == "auto" and up != "auto":
        up_said = up_said.replace("as asked", words)
    if asked.unit != "auto" or source.unit == "auto":
        return replace(guess, sentences=(up_said, unit_said))
    usual = UNIT_NAMES[source.unit]
    if guess.unit == source.unit:
        return replace(guess, sentences=(up_said, f"Coordinates are in {usual}, {words}."))
    unlike = f"{source.format} files are in {usual}, but then no building is of this size."
    return replace(guess, sentences=(up_said, unlike, unit_said))


def _handedness(asked: str, path: Trajectory | None) -> tuple[bool, list[str]]:
    """Whether the file is left-handed, with a sentence where that is not the usual.

    Only matrices of poses can tell: a sensor's axes are right-handed, so that a pose that reflects them has
    a left-handed world. Quaternions, points, colours and triangles look the same in a mirror.
    """
    reflects = path is not None and are_reflections(path.T_world_sensor)
    if asked == "yes":
        return True, [
            "The file is left-handed, as asked: its mirror image is planned, y of the world reversed."
        ]
    if asked == "auto" and reflects:
        return True, [
            "The file is left-handed, its poses reflect the sensor's axes: its mirror image is planned, y of "
            "the world reversed; --set input.mirrored=no takes it as it is."
        ]
    if reflects:
        return False, ["Its poses reflect the sensor's axes; the file is taken as right-handed, as asked."]
    return False, []


def _local_frame(points: Float, guess: AxisGuess, mirrored: bool) -> LocalFrame:
    turn = up_rotation(guess.up, mirrored)
    frame = LocalFrame(METRES_PER_UNIT[guess.unit], guess.unit, guess.up, turn)
    return replace(frame, shift=choose_shift(world_points(points, frame)))


def _find_path(
    source: PointSource, options: ReadOptions, observer: Observer
) -> tuple[Trajectory | None, list[str]]:
    """The trajectory that was asked for, that the file carries, or that lies beside it; file coordinates."""
    if options.trajectory is not None:
        return read_trajectory(options.trajectory, observer), []
    if source.poses is not None:
        return source.poses, []
    name, beside = source.path.name, find_trajectory(source.path)
    if beside is not None:
        return read_trajectory(beside, observer), [f"The trajectory is {beside.name}, found beside {name}."]
    if source.has_scan_id:
        return None, [f"No trajectory was found beside {name}: sensor positions are not known."]
    return None, []


def _check_rows(source: PointSource, scan_id: NDArray[np.int32] | None, rows: int) -> None:
    """All scan ids where they are known, else those of the sample, refer to rows that exist."""
    if source.scan_ids is not None:
        check_rows(source.path.name, source.scan_ids, rows)
    elif scan_id is not None:
        _check_ids(scan_id, rows, source.path.name)


def _trajectory(
    source: PointSource,
    points: Float,
    scan_id: NDArray[np.int32] | None,
    path: Trajectory,
    frame: LocalFrame,
    options: ReadOptions,
    observer: Observer,
    notes: list[str],
) -> Trajectory | None:
    """``path`` in the local frame, once it proved to be of this survey.

    A path that nobody asked for and no point refers to is left out where it does not fit.
    """
    in_metres = fit_unit(points, path, frame.scale)
    if in_metres is not None:
        notes.append("The trajectory is in metres, unlike the points.")
    trajectory = local_trajectory(in_metres or path, frame)
    local = world_points(points, frame) - frame.shift
    try:
        check_plausible(source.path.name, local, scan_id, trajectory, options.input.max_range)
    except InputError as error:
        if source.has_scan_id or options.trajectory is not None:
            raise
        observer.warning(f"{error} It was left out.")
        return None
    return trajectory


def finite_sample(sample: RawChunk, name: str) -> tuple[Float, NDArray[np.int32] | None]:
    """(N, 3) usable points of the sample in file coordinates, and their scan ids."""
    with np.errstate(invalid="ignore"):  # signalling NaN
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
                _check_ids(chunk.scan_id, rows, source.path.name)
            total += len(raw.points)
            left_out += lost
            unreadable += raw.dropped
            if len(chunk.points) or chunk.free is not None:
                yield chunk
        if not reported:
            reported.append(True)
            _report(source.path.name, left_out, unreadable, total, observer)

    return chunks


def _local_chunk(raw: RawChunk, frame: LocalFrame) -> tuple[PointChunk, int]:
    points = local_points(raw.points, frame, raw.T_file_sensor)
    free = None if raw.free is None else local_points(raw.free, frame, raw.T_file_sensor)
    size = raw.free_size * frame.scale
    keep = keep_finite(points)
    if keep is None:
        return PointChunk(points, raw.scan_id, raw.stamps, free, size, raw.rgb, raw.intensity), 0
    chunk = PointChunk(
        points[keep],
        None if raw.scan_id is None else raw.scan_id[keep],
        None if raw.stamps is None else raw.stamps[keep],
        free,
        size,
        None if raw.rgb is None else raw.rgb[keep],
        None if raw.intensity is None else raw.intensity[keep],
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


def _check_ids(scan_id: NDArray[np.int32], rows: int, name: str) -> None:
    if len(scan_id):
        check_rows(name, ScanIds(int(scan_id.min()), int(scan_id.max()), False), rows)


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

"""Several files as one survey: opened alike, moved into one local frame, their paths one after the other.

Files of one format count in one unit and have one axis up: where the guesses differ, most points decide and
the others are opened again. Coordinates of all files are those of one world; nothing is aligned here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.model import PointChunk, Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.readers.ahead import read_ahead
from floorplan_core.readers.local import SPREAD_LIMIT

Float = NDArray[np.float64]
Open = Callable[[int, InputConfig], Reconstruction]  # the file of that number, read with these settings

PAUSE = 1.0  # seconds between two runs that were recorded by clocks of their own
LISTED = 3  # names in a sentence


@dataclass(frozen=True)
class _Part:
    """One of the files: what takes it into the common frame and the common trajectory."""

    survey: Reconstruction
    move: Float  # (3,) metres to add to its local coordinates
    first_row: int  # of its poses in the common trajectory


def open_alike(count: int, config: InputConfig, open_one: Open) -> list[Reconstruction]:
    """All files; those of one format with one unit and one up axis."""
    opened = [open_one(k, config) for k in range(count)]
    for form in dict.fromkeys(survey.format for survey in opened):
        same = [k for k, survey in enumerate(opened) if survey.format == form]
        unit, up = _most_common([opened[k] for k in same])
        for k in same:
            frame = opened[k].local_frame
            if (frame.unit, frame.up) != (unit, up):
                again = open_one(k, config.model_copy(update={"unit": unit, "up": up}))
                note = f"{again.name} is read like the other {form} files: in {unit}, {up} up."
                opened[k] = replace(again, assumptions=(*again.assumptions, note))
    return opened


def join_surveys(
    surveys: Sequence[Reconstruction], shared_path: bool = False, observer: Observer | None = None
) -> Reconstruction:
    """One survey of several; :class:`InputError` where they cannot be of one place.

    ``shared_path``: all have the same trajectory, whose rows their scan ids refer to. ``observer`` hears what
    the readers of the files warn of, in the order of the files.
    """
    ordered = _chronological(surveys, shared_path)
    first = ordered[0]
    _check_place(ordered)
    frame = replace(first.local_frame, crs=_common_crs(ordered))
    parts, path = _with_paths(ordered, shared_path)
    counts = [s.point_count for s in ordered if s.point_count is not None]
    scans = [s.scans for s in ordered if s.scans is not None]
    return Reconstruction(
        name=_name(surveys),
        chunks=lambda: _chunks(parts, observer),
        point_count=sum(counts) if len(counts) == len(ordered) else None,
        trajectory=path,
        local_frame=frame,
        scans_ordered=not shared_path and all(s.scans_ordered for s in ordered),
        assumptions=(_note(surveys, path), *dict.fromkeys(a for s in ordered for a in s.assumptions)),
        format=" and ".join(dict.fromkeys(s.format for s in surveys)),
        scans=sum(scans) if scans else None,
        topics=tuple(topic for s in ordered for topic in s.topics),
    )


def _most_common(surveys: list[Reconstruction]) -> tuple[str, str]:
    """Unit and up axis of most points; ties go to the first file."""
    votes: Counter[tuple[str, str]] = Counter()
    for survey in surveys:
        votes[survey.local_frame.unit, survey.local_frame.up] += max(1, survey.point_count or 1)
    return max(votes, key=lambda axes: votes[axes])


def _chronological(surveys: Sequence[Reconstruction], shared_path: bool) -> list[Reconstruction]:
    """In the order in which they were recorded, where all say when; else as they were given."""
    starts = [s.trajectory.stamps[0] for s in surveys if s.trajectory is not None and len(s.trajectory)]
    if shared_path or len(starts) < len(surveys):
        return list(surveys)
    return [surveys[k] for k in np.argsort(starts, kind="stable").tolist()]


def _check_place(surveys: list[Reconstruction]) -> None:
    first = surveys[0]
    for other in surveys[1:]:
        apart = float(np.abs(other.local_frame.shift - first.local_frame.shift).max())
        if apart > SPREAD_LIMIT:
            raise InputError(
                f"{first.name} and {other.name} lie {apart / 1000:,.0f} km apart and are not of one survey; "
                "plan them one by one."
            )


def _common_crs(surveys: list[Reconstruction]) -> str:
    known = {s.local_frame.crs: s.name for s in surveys if s.local_frame.crs}
    if len(known) > 1:
        one, two = list(known.values())[:2]
        raise InputError(
            f"{one} and {two} are in different coordinate reference systems; bring them into one first."
        )
    return next(iter(known), "")


def _with_paths(
    surveys: list[Reconstruction], shared_path: bool
) -> tuple[tuple[_Part, ...], Trajectory | None]:
    """The parts, and all poses: one after the other, later ones in time where clocks overlap."""
    origin = surveys[0].local_frame.shift
    moves = [s.local_frame.shift - origin for s in surveys]
    if shared_path:
        return tuple(_Part(s, m, 0) for s, m in zip(surveys, moves, strict=True)), surveys[0].trajectory
    parts, stamps, poses, sensors, rows, end = [], [], [], [], 0, -np.inf
    for survey, move in zip(surveys, moves, strict=True):
        parts.append(_Part(survey, move, rows))
        if survey.trajectory is None or len(survey.trajectory) == 0:
            continue
        moved = survey.trajectory.T_world_sensor.copy()
        moved[:, :3, 3] += move
        seconds = survey.trajectory.stamps
        seconds = seconds if seconds[0] > end else seconds - seconds[0] + end + PAUSE
        end = float(seconds[-1])
        rows += len(seconds)
        stamps.append(seconds)
        poses.append(moved)
        sensors.append(survey.trajectory.sensor)
    path = (
        Trajectory(np.concatenate(stamps), np.concatenate(poses), _sensors(sensors, stamps))
        if stamps
        else None
    )
    return tuple(parts), path


def _sensors(sensors: list[NDArray[np.int32] | None], stamps: list[Float]) -> NDArray[np.int32] | None:
    """(M,) the sensor of each pose of all files; None where each has one only."""
    if all(sensor is None for sensor in sensors):
        return None
    pairs = zip(sensors, stamps, strict=True)
    return np.concatenate([np.zeros(len(t), dtype=np.int32) if s is None else s for s, t in pairs])


def _chunks(parts: tuple[_Part, ...], observer: Observer | None) -> Iterator[PointChunk]:
    """Part by part; the next files are read while one is used."""
    for number, chunk in read_ahead([part.survey.chunks for part in parts], observer):
        yield _moved(chunk, parts[number])


def _moved(chunk: PointChunk, part: _Part) -> PointChunk:
    """``chunk`` in the common frame; scan ids without a path of their own say nothing here."""
    points, free, ids = chunk.points, chunk.free, chunk.scan_id
    if part.move.any():
        points = points + part.move
        free = None if free is None else free + part.move
    if part.survey.trajectory is None:
        ids = None
    elif ids is not None and part.first_row:
        ids = ids + np.int32(part.first_row)
    return replace(chunk, points=points, scan_id=ids, free=free)


def _name(surveys: Sequence[Reconstruction]) -> str:
    more = len(surveys) - 1
    return f"{surveys[0].name} and {more} more" if more else surveys[0].name


def _note(surveys: Sequence[Reconstruction], path: Trajectory | None) -> str:
    names = ", ".join(s.name for s in surveys[:LISTED]) + (", …" if len(surveys) > LISTED else "")
    text = f"{len(surveys)} files are read as one survey: {names}."
    without = sum(s.trajectory is None for s in surveys)
    if path is not None and without:
        text += f" {without} of them have no sensor positions: there free space is told by the others only."
    return text

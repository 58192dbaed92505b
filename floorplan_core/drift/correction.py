"""From a survey whose trajectory drifts to one whose walls meet: keyframes, sightings, model selection."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config, DriftConfig
from floorplan_core.drift.keyframes import Keyframes, cut_path, gather
from floorplan_core.drift.model_selection import STEP_FLOOR, AxisProblem, solve_axis
from floorplan_core.drift.sightings import Sightings, find_sightings, headings, keyframe_patches
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.cell_normals import CellNormals
from floorplan_core.model import PointChunk, Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.replay import path_lengths

Float = NDArray[np.float64]

ROUNDS = (0.1, 0.3, 1.0)  # of ``reach``: near sightings become planes before far ones are compared
HEADING_FLOOR = np.radians(0.02)  # of any step between keyframes


@dataclass(frozen=True)
class Correction:
    """What is done to each keyframe; Manhattan axes."""

    shift: Float  # (K, 3) metres
    turn: Float  # (K,) radians about the vertical
    planes: int  # that explain all sightings
    sightings: int


def as_configured(survey: Reconstruction, config: Config, observer: Observer) -> Reconstruction:
    """The survey as it is, or corrected where the settings ask for that; what was done is reported."""
    if not config.drift.correct:
        return survey
    done = corrected(survey, config, observer)
    observer.warning(done.assumptions[-1])
    return done


def corrected(survey: Reconstruction, config: Config, observer: Observer) -> Reconstruction:
    """The survey with its trajectory, and the points with it, where the walls say that they were.

    Raises :class:`NoPlanError` where it has no trajectory or no points that refer to it.
    """
    trajectory = survey.trajectory
    if trajectory is None or len(trajectory) < 2:
        raise NoPlanError(
            f"{survey.name} has no trajectory that could be corrected; leave drift.correct at false."
        )
    began = time.perf_counter()
    observer.stage_started("drift")
    keyframes = cut_path(trajectory, config.drift.keyframe)
    rotation, points = _frame(survey, keyframes, config, observer)
    patches = []
    for part, origin in zip(points, keyframes.origin, strict=True):
        observer.check_cancelled()
        patches.append(keyframe_patches(part, origin, rotation, config.frame))
    correction = find_correction(patches, keyframes, rotation, config.drift, observer.check_cancelled)
    moves = scan_moves(correction, keyframes, trajectory, rotation)
    observer.stage_finished("drift", time.perf_counter() - began)
    largest = float(np.linalg.norm(correction.shift, axis=1).max())
    note = (
        f"The trajectory was corrected by up to {largest:.2f} m and "
        f"{np.degrees(np.abs(correction.turn).max()):.1f} degrees: {correction.planes} planes explain "
        f"{correction.sightings} sightings of walls, floors and ceilings."
    )
    return replace(
        survey,
        chunks=lambda: _moved_chunks(survey, moves),
        trajectory=replace(trajectory, T_world_sensor=moves @ trajectory.T_world_sensor),
        assumptions=(*survey.assumptions, note),
    )


def _frame(
    survey: Reconstruction, keyframes: Keyframes, config: Config, observer: Observer
) -> tuple[Float, list[Float]]:
    """(3, 3) rotation into the Manhattan frame, and the points of each keyframe."""
    from floorplan_core.geometry.surfel_map import SurfelMap
    from floorplan_core.stages.manhattan_frame import estimate_frame

    points = gather(survey, keyframes, observer)
    surfels = SurfelMap(config.voxels.size / 2)
    for part in points:
        observer.check_cancelled()
        surfels.insert(part, np.full(len(part), -1, dtype=np.int32), np.zeros((0, 3)), (0.0, np.inf))
    if not len(surfels):
        raise NoPlanError(f"No point of {survey.name} refers to its trajectory; drift cannot be corrected.")
    return estimate_frame(surfels.surfels(), config.frame).rotation, points


def find_correction(
    patches: Sequence[CellNormals],
    keyframes: Keyframes,
    rotation: Float,
    config: DriftConfig,
    check: Callable[[], None] = lambda: None,
) -> Correction:
    """Headings from the walls of each keyframe, then the three axes one by one.

    ``check`` is called again and again; it raises where nobody wants the answer any more.
    """
    if len(keyframes) < 2:  # nothing to drift against
        return Correction(np.zeros((len(keyframes), 3)), np.zeros(len(keyframes)), 0, 0)
    length = np.diff(keyframes.path)
    turn = headings(patches, HEADING_FLOOR + np.radians(config.heading) * length, check)
    sightings = find_sightings(patches, turn, check)
    origin = keyframes.origin @ rotation.T
    step = _turned_steps(np.diff(origin, axis=0), turn)
    sigma = STEP_FLOOR + config.odometry * length
    start = np.concatenate([np.zeros((1, 3)), np.cumsum(step, axis=0)])
    shift, planes = np.zeros((len(keyframes), 3)), 0
    for axis in range(3):
        problem = _problem(sightings, axis, start, step[:, axis], sigma)
        positions, plane = solve_axis(problem, tuple(r * config.reach for r in ROUNDS), check)
        moved = positions - origin[:, axis]
        shift[:, axis] = moved - moved[0]  # nothing fixes the whole: it stays where it began
        planes += int(plane.max()) + 1 if len(plane) else 0
    return Correction(shift, turn, planes, len(sightings))


def _turned_steps(step: Float, turn: Float) -> Float:
    """(K-1, 3) steps with each keyframe's heading set right."""
    c, s = np.cos(-turn[:-1]), np.sin(-turn[:-1])
    return np.column_stack([c * step[:, 0] - s * step[:, 1], s * step[:, 0] + c * step[:, 1], step[:, 2]])


def _problem(sightings: Sightings, axis: int, start: Float, step: Float, sigma: Float) -> AxisProblem:
    rows = np.flatnonzero(sightings.axis == axis)
    keyframe = sightings.keyframe[rows]
    others = [k for k in range(3) if k != axis]
    return AxisProblem(
        step,
        sigma,
        keyframe,
        sightings.distance[rows],
        sightings.mass[rows],
        sightings.facing[rows],
        (sightings.low[rows] + start[keyframe])[:, others],
        (sightings.high[rows] + start[keyframe])[:, others],
    )


def scan_moves(
    correction: Correction, keyframes: Keyframes, trajectory: Trajectory, rotation: Float
) -> Float:
    """(M, 4, 4) what moves each scan's pose and points, local frame; between keyframes by the path."""
    path = path_lengths(trajectory)
    turn = np.interp(path, keyframes.path, correction.turn)
    shift = np.column_stack([np.interp(path, keyframes.path, s) for s in correction.shift.T]) @ rotation
    c, s = np.cos(-turn), np.sin(-turn)
    about = np.zeros((len(turn), 3, 3))
    about[:, 0, 0], about[:, 0, 1], about[:, 1, 0], about[:, 1, 1], about[:, 2, 2] = c, -s, s, c, 1.0
    moves = np.tile(np.eye(4), (len(turn), 1, 1))
    moves[:, :3, :3] = rotation.T @ about @ rotation
    origins = trajectory.origins
    moves[:, :3, 3] = origins + shift - np.einsum("mij,mj->mi", moves[:, :3, :3], origins)
    return moves


def _moved_chunks(survey: Reconstruction, moves: Float) -> Iterator[PointChunk]:
    for chunk in survey.chunks():
        if chunk.scan_id is None:
            yield chunk
            continue
        M = moves[chunk.scan_id]
        points = np.einsum("nij,nj->ni", M[:, :3, :3], chunk.points) + M[:, :3, 3]
        yield replace(chunk, points=points)

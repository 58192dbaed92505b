"""Whether a trajectory can have seen the points that it comes with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import Trajectory
from floorplan_core.readers.source import ScanIds

Float = NDArray[np.float64]

MARGIN = 0.5  # sensors may stand outside the cloud's bounds by this share of its extent
MIN_SPREAD = 0.02  # of the cloud's extent: a shorter path is one in another unit, if that fits
MIN_INSIDE = 0.5  # share of the sensor positions that must lie within these bounds
# Measured on seven surveys and all exchanges of their trajectories: with the right one points are at most
# 0.41 times as far from their own sensor as from another, and 47 % of the lines of sight cross wall cells;
# with a wrong one at least 0.83 times, and 76 %. A single room gives 0.9, and few crossings.
NEARER = 0.7
MAX_CROSSING = 0.65
WALL_CELL = 0.3  # metres: coarse enough that a sample of the points closes the walls
WALL_LEVELS = (0.3, 0.85)  # shares of the height at which points count as wall
RAY_ENDS = 0.6  # metres at both ends of a line that do not count
RAY_STEPS = 60
MAX_RAYS = 1000


class WrongTrajectory(InputError):
    """A trajectory that cannot have seen the points; a reader that guessed it may go on without."""


def check_rows(cloud: str, ids: ScanIds, rows: int) -> None:
    """:class:`InputError` where points refer to rows that the trajectory has not."""
    if ids.lowest < 0:
        raise InputError(f"A point of {cloud} refers to scan {ids.lowest}; scan ids count from 0.")
    if ids.highest >= rows:
        raise InputError(
            f"The points of {cloud} refer to scan {ids.highest}, the trajectory has only {rows} rows; "
            "give the trajectory of this survey with --trajectory."
        )


def share_inside(points: Float, origins: Float) -> tuple[float, float]:
    """Share of the sensor positions in or near the bounds of the points, and the margin that "near" means."""
    low, high = np.quantile(points, [0.01, 0.99], axis=0)
    margin = MARGIN * float((high - low).max())
    inside = np.all((origins >= low - margin) & (origins <= high + margin), axis=1)
    return float(inside.mean()), margin


def belongs(points: Float, trajectory: Trajectory) -> bool:
    """True where most sensor positions lie in or near the bounds of the points (one frame, any unit)."""
    return share_inside(points, trajectory.origins)[0] >= MIN_INSIDE


def fit_unit(points: Float, trajectory: Trajectory, scale: float) -> Trajectory | None:
    """The trajectory in the file's unit (of ``scale`` metres) where it was written in metres; else None.

    It was where its positions only fall among the points, or only spread over them, when taken as metres.
    """
    in_metres = trajectory.T_world_sensor.copy()
    in_metres[:, :3, 3] /= scale
    converted = replace(trajectory, T_world_sensor=in_metres)
    if scale == 1.0 or not belongs(points, converted):
        return None
    shrunk = np.ptp(trajectory.origins, axis=0).max() < MIN_SPREAD * np.ptp(points, axis=0).max()
    return converted if shrunk or not belongs(points, trajectory) else None


def check_plausible(
    cloud: str,
    points: Float,
    scan_id: NDArray[np.int32] | None,
    trajectory: Trajectory,
    max_range: float,
) -> None:
    """:class:`WrongTrajectory` where a trajectory cannot have seen the points (all in metres, one frame)."""
    inside, margin = share_inside(points, trajectory.origins)
    if inside < MIN_INSIDE:
        raise WrongTrajectory(
            f"The trajectory is not of the survey {cloud}: {1 - inside:.0%} of its positions lie "
            f"more than {margin:.0f} m outside the points; give the right one with --trajectory."
        )
    if scan_id is None or len(scan_id) == 0:
        return
    origins = trajectory.origins[scan_id]
    distance = float(np.median(np.linalg.norm(points - origins, axis=1)))
    if distance > max_range:
        raise WrongTrajectory(
            f"The trajectory is not of the survey {cloud}: half of the points are more than {distance:.0f} m "
            f"from the sensor that it gives them (the maximum range is {max_range:g} m); give the right one."
        )
    others = trajectory.origins[np.roll(scan_id, len(scan_id) // 2)]
    if distance > NEARER * float(np.median(np.linalg.norm(points - others, axis=1))):
        share = crossing_share(points, origins)
        if share > MAX_CROSSING:
            raise WrongTrajectory(
                f"The trajectory is not of the survey {cloud}: {share:.0%} of the points lie behind walls, "
                "seen from the sensor that it gives them; give the right one with --trajectory."
            )


def crossing_share(points: Float, origins: Float) -> float:
    """Share of the lines from sensor to point that pass through walls, in plan; 0 to 1.

    ``points`` and ``origins`` (N, 3) belong together. Walls are the cells of the points at middle height.
    """
    low, high = np.quantile(points[:, 2], [0.02, 0.98])
    level = (points[:, 2] - low) / max(high - low, WALL_CELL)
    walls = np.unique(_cells(points[(level > WALL_LEVELS[0]) & (level < WALL_LEVELS[1]), :2]))
    chosen = slice(None, None, max(1, len(points) // MAX_RAYS))
    start, way = origins[chosen, None, :2], (points - origins)[chosen, None, :2]
    share = np.linspace(0, 1, RAY_STEPS)[:, None]
    length = np.linalg.norm(way, axis=2, keepdims=True)
    between = (share * length > RAY_ENDS) & ((1 - share) * length > RAY_ENDS)
    crossed = np.isin(_cells(start + way * share), walls) & between[..., 0]
    return float(crossed.any(axis=1).mean())


def _cells(xy: Float) -> NDArray[np.int64]:
    """One number for the plan cell of each (..., 2) position."""
    index = np.floor(xy / WALL_CELL).astype(np.int64)
    return np.asarray(index[..., 0] * (1 << 31) + index[..., 1])

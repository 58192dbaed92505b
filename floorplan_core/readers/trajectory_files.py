"""Which trajectory goes with a cloud, and whether it really does."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import Trajectory
from floorplan_core.readers.source import ScanIds
from floorplan_core.readers.trajectory import looks_like_trajectory

Float = NDArray[np.float64]

SUFFIXES = (".tum", ".txt")
MARGIN = 0.5  # sensors may stand outside the cloud's bounds by this share of its extent
MIN_SPREAD = 0.02  # of the cloud's extent: a shorter path is one in another unit, if that fits
MIN_INSIDE = 0.5  # share of the sensor positions that must lie within these bounds
RANGE_FACTOR = 1.5  # the median point may be this many times the maximum range away before we call it wrong


def find_trajectory(cloud: Path) -> Path | None:
    """The trajectory beside a cloud: of its own stem, trajectory3d for points3d, or the plain one."""
    stems = [cloud.stem]
    kind = re.match(r"points(\w*?)(_.*)?$", cloud.stem)
    if kind and kind.group(1):
        stems.append(f"trajectory{kind.group(1)}")
    stems.append("trajectory")
    for stem in stems:
        for suffix in SUFFIXES:
            beside = cloud.parent / (stem + suffix)
            if beside != cloud and beside.is_file() and (suffix == ".tum" or looks_like_trajectory(beside)):
                return beside
    return None


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
    converted = Trajectory(trajectory.stamps, in_metres)
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
    """:class:`InputError` where a trajectory cannot have seen the points (all in metres, one frame)."""
    inside, margin = share_inside(points, trajectory.origins)
    if inside < MIN_INSIDE:
        raise InputError(
            f"The trajectory is not of the survey {cloud}: {1 - inside:.0%} of its positions lie "
            f"more than {margin:.0f} m outside the points; give the right one with --trajectory."
        )
    if scan_id is None or len(scan_id) == 0:
        return
    distance = float(np.median(np.linalg.norm(points - trajectory.origins[scan_id], axis=1)))
    if distance > RANGE_FACTOR * max_range:
        raise InputError(
            f"The trajectory is not of the survey {cloud}: half of the points are more than {distance:.0f} m "
            f"from the sensor that it gives them (the maximum range is {max_range:g} m); give the right one."
        )

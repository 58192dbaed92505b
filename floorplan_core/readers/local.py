"""File coordinates to local ones: metres, z up, no large offset; float32 where the file has no more."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import LocalFrame, Trajectory

Float = NDArray[np.float64]

LIMIT = 1e7  # metres from the file's origin, and from the survey's middle 1 % of that: farther is no survey
SPREAD_LIMIT = np.float32(1e5)  # metres from the local origin
SHIFT_FROM = 1000.0  # metres: float32 resolves 0.06 mm there


def choose_shift(points: Float) -> Float:
    """(3,) whole metres near the middle of (N, 3) points; zero along axes that are near the origin anyway."""
    middle = np.round(np.median(points, axis=0))
    return np.where(np.abs(middle) > SHIFT_FROM, middle, 0.0) + 0.0


def world_points(points: NDArray[Any], frame: LocalFrame) -> Float:
    """(N, 3) float64 metres, z up, before any shift; column by column as below."""
    columns = [int(np.argmax(np.abs(row))) for row in frame.rotation]
    factors = frame.scale * frame.rotation[range(3), columns]
    return np.asarray(points[:, columns] * factors, dtype=np.float64)


def local_points(points: NDArray[Any], frame: LocalFrame, T_file_sensor: Float | None) -> NDArray[Any]:
    """(N, 3) local coordinates: float64 where the file has doubles, a shift is subtracted or a pose is used.

    Rounded to float32 some points in 340,000 fell into the next voxel, others for each way to turn a survey
    (decision 21). Else float32, column by column (the rotations that readers make only swap axes).
    """
    if T_file_sensor is not None:
        return _moved(points, frame, T_file_sensor)
    if points.dtype != np.float32 or frame.shift.any():
        return _moved(points, frame, np.eye(4))
    if frame.scale == 1.0 and np.array_equal(frame.rotation, np.eye(3)):
        return points
    out = np.empty(points.shape, dtype=np.float32)
    with np.errstate(over="ignore", invalid="ignore"):
        for axis in range(3):
            source = int(np.argmax(np.abs(frame.rotation[axis])))
            factor = frame.scale * frame.rotation[axis, source]
            column = points[:, source]
            out[:, axis] = column if factor == 1.0 else column * np.float32(factor)
    return out


def _moved(points: NDArray[Any], frame: LocalFrame, T: Float) -> Float:
    """One affine map for turn, unit, axes and shift."""
    from floorplan_core.geometry.affine import moved

    matrix = frame.scale * frame.rotation @ T[:3, :3]
    return moved(points, matrix, frame.scale * frame.rotation @ T[:3, 3] - frame.shift)


def keep_finite(points: NDArray[Any]) -> NDArray[np.bool_] | None:
    """(N,) which points are usable; None where all are (the usual case costs two reductions)."""
    if len(points) == 0:
        return None
    with np.errstate(invalid="ignore"):
        if points.min() >= -SPREAD_LIMIT and points.max() <= SPREAD_LIMIT:  # False for NaN
            return None
        return np.asarray((np.abs(points) <= SPREAD_LIMIT).all(axis=1))


def local_trajectory(trajectory: Trajectory, frame: LocalFrame) -> Trajectory:
    """Poses of file coordinates in the local frame; the sensor's own axes stay as they are."""
    poses = trajectory.T_world_sensor.copy()
    poses[:, :3, :3] = frame.rotation @ poses[:, :3, :3]
    poses[:, :3, 3] = frame.to_local(trajectory.origins)
    return replace(trajectory, T_world_sensor=poses)

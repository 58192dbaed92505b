"""What a caller hands over, scan by scan: looked at before it can spoil a map.

Points that lie as ``(N, 4)`` or ``(3, N)``, or a pose that was transposed, would else give a plan of nothing.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import Trajectory
from floorplan_core.readers.trajectory_forms import is_rigid

Float = NDArray[np.float64]
Points = NDArray[np.float64] | NDArray[np.float32]
Scan = tuple[Points, NDArray[np.int32], Float]  # points, the row of the origins that saw each, origins

_LAST_ROW = (0.0, 0.0, 0.0, 1.0)


def checked_points(points: Any) -> Points:
    """(N, 3) float32 or float64 of points in rows of three, also (H, W, 3); :class:`InputError` else."""
    try:
        array = np.asarray(points)
    except ValueError:  # rows of different lengths
        array = np.array(None)
    if array.size == 0 and array.dtype.names is None:
        return np.zeros((0, 3))
    if array.dtype.kind not in "fiu" or array.shape[-1:] != (3,):
        raise InputError(
            "The points of a scan must be numbers in rows of three, (N, 3): x, y and z in metres (given an "
            f"array of shape {array.shape} and type {array.dtype}); select or stack these three columns."
        )
    rows = array.reshape(-1, 3)
    if rows.dtype == np.float32:
        return np.ascontiguousarray(rows, dtype=np.float32)
    return np.ascontiguousarray(rows, dtype=np.float64)


def checked_pose(T_world_sensor: Any) -> Float:
    """The pose (4, 4), a rotation and a translation; :class:`InputError` where it is none."""
    pose = np.asarray(T_world_sensor, dtype=np.float64)
    if pose.shape != (4, 4) or not np.isfinite(pose).all():
        raise InputError(f"A pose must be a 4 x 4 matrix of finite numbers (given {pose.tolist()}).")
    if not is_rigid(pose[None])[0] or tuple(pose[3]) != _LAST_ROW:
        raise InputError(
            "A pose must be a rotation (3 x 3, not scaled or mirrored) with the sensor's position in metres "
            f"in its last column and 0, 0, 0, 1 below (given {pose.tolist()})."
        )
    return pose


def checked_rows(scan_id: NDArray[np.int32], trajectory: Trajectory) -> tuple[int, int]:
    """First and last row that points refer to; :class:`InputError` where the trajectory has no such row."""
    first, last = int(scan_id.min()), int(scan_id.max())
    if first < 0 or last >= len(trajectory):
        raise InputError(
            f"Points refer to the scans {first} to {last}, the trajectory has the rows 0 to "
            f"{len(trajectory) - 1}; give the trajectory of this survey."
        )
    return first, last


def in_world(points: Points, pose: Float) -> Float:
    """(N, 3) points of a sensor where its pose (4, 4) puts them; what is not finite stays so."""
    with np.errstate(invalid="ignore", over="ignore"):
        return np.asarray(points @ pose[:3, :3].T + pose[:3, 3])

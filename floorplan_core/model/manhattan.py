"""The Manhattan frame: the one rotation after which walls lie along x and y and gravity along -z."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


@dataclass(frozen=True)
class ManhattanFrame:
    """Rotation from the local frame to the Manhattan frame, and how well the data supports it."""

    rotation: Float  # (3, 3) local to manhattan, proper orthonormal
    yaw: float  # radians in (-pi/4, pi/4], of the walls in the local frame
    tilt: float  # radians, angle between the local z axis and gravity
    support: float  # 0 to 1, share of the wall area whose normal is within 5 degrees of an axis
    wall_area: float  # m2 of vertical surface that the estimate rests on
    floor_z: float  # metres, manhattan frame
    ceiling_z: float | None  # metres, manhattan frame; None where no ceiling was seen
    askew: float = 0.0  # 0 to 1, of a plan: share of its wall area in long lines at angles of no frame of it

    def from_manhattan(self, points: Float) -> Float:
        """(N, 2) or (N, 3) manhattan coordinates to (N, 3) local ones; 2-D points lie on the floor."""
        pts = np.asarray(points, dtype=np.float64).reshape(-1, np.shape(points)[-1])
        if pts.shape[1] == 2:
            pts = np.column_stack([pts, np.full(len(pts), self.floor_z)])
        return pts @ self.rotation

    def to_manhattan(self, points: Float) -> Float:
        """(N, 3) local coordinates to (N, 3) manhattan ones."""
        return np.asarray(points, dtype=np.float64) @ self.rotation.T

    def plan_from_local(self, xy: Float) -> Float:
        """(N, 2) local positions on the floor to (N, 2) manhattan ones; undoes :meth:`from_manhattan`."""
        flat = np.asarray(xy, dtype=np.float64).reshape(-1, 2)
        z = (self.floor_z - flat @ self.rotation[2, :2]) / self.rotation[2, 2]
        return self.to_manhattan(np.column_stack([flat, z]))[:, :2]

"""What was measured: the observed points from above, and the path of the sensor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.layers.source import PlanSource

DETAIL = 0.03  # metres: finer bends of the path are left out
FEWEST = 3  # points of a path that can be simplified


@dataclass(frozen=True)
class PointsLayer:
    """Observed columns, one dot each."""

    xy: NDArray[np.float32]  # (N, 2) metres, manhattan frame
    facing: NDArray[np.int8]  # (N,) Facing of the plane that explains it; -1 where none


@dataclass(frozen=True)
class TrajectoryLayer:
    """The path of the sensor."""

    xy: NDArray[np.float64]  # (M, 2) metres, manhattan frame


def points_layer(source: PlanSource) -> PointsLayer:
    """The points, unexplained ones first so that walls lie on top."""
    points = source.plan.wall_points
    order = np.argsort(points.facing >= 0, kind="stable")
    return PointsLayer(points.xy[order], points.facing[order])


def trajectory_layer(source: PlanSource) -> TrajectoryLayer:
    """The path without the points that nobody would see: a robot logs ten a second."""
    import shapely

    xy = source.plan.trajectory
    if len(xy) < FEWEST:
        return TrajectoryLayer(xy)
    return TrajectoryLayer(shapely.get_coordinates(shapely.simplify(shapely.LineString(xy), DETAIL)))

"""Layers of a plan that is still being made: planes and free space, as soon as their stages are through."""

from __future__ import annotations

from typing import Any

import numpy as np

from floorcast_app.layers.free_space import FreeSpaceLayer, free_space_of
from floorcast_app.layers.planes import PlanesLayer, plane_shape
from floorplan_core.model import LayoutPlane, ManhattanFrame, OccupancyGrid
from floorplan_core.model.quarter_turns import quarters_to_world, turned_result

Bounds = tuple[float, float, float, float]


class InWorld:
    """Turns what stages tell, which lies in the survey's own quadrant, as the whole plan will be turned."""

    def __init__(self) -> None:
        self._quarters = 0

    def __call__(self, result: object) -> object:
        """``result`` in the axes of the plan to come; a frame says by how much the next ones turn."""
        if isinstance(result, ManhattanFrame):
            self._quarters = quarters_to_world(result)
        return turned_result(result, self._quarters)


def partial_layer(result: object) -> tuple[str, PlanesLayer | FreeSpaceLayer, Bounds] | None:
    """Kind of layer, model and x0, y0, x1, y1 (metres) of a stage's result; None where it cannot be shown."""
    if isinstance(result, OccupancyGrid):
        return "free_space", free_space_of(result, ()), result.extent
    if isinstance(result, tuple) and result and all(isinstance(p, LayoutPlane) for p in result):
        layer = PlanesLayer(tuple(plane_shape(p) for p in result))
        bounds = _bounds(layer)
        return None if bounds is None else ("planes", layer, bounds)
    return None


def _bounds(layer: PlanesLayer) -> Bounds | None:
    """Of what was seen of the planes."""
    lines: list[Any] = [shape.lines().reshape(-1, 2) for shape in layer.shapes]
    points = np.vstack([np.zeros((0, 2)), *lines])
    if not len(points):
        return None
    (x0, y0), (x1, y1) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return x0, y0, x1, y1

"""Outlines of spaces that rectangles of layout planes do not explain: walls at other angles, round rooms.

In: the cells of a space. Out: a region whose boundary is that of the cells, simplified. It is what the map shows,
not what layout planes explain, and its sides name no plane.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.raster import cells_to_polygon, polygon_window
from floorplan_core.geometry.rectilinear import polygons_of
from floorplan_core.model import OCCUPIED, OccupancyGrid, Region, RegionSide

Bool = NDArray[np.bool_]
Float = NDArray[np.float64]

_SIMPLE = 1.5  # cells that a simplified outline may deviate
_WHISKER = 3  # cells: parts of a space narrower than this are noise
_LEAST_HOLE = 0.25  # m2: smaller holes are no walls
_WALL_REACH = 3  # cells beyond a side in which its wall is looked for


def outline(space: Bool, grid: OccupancyGrid) -> Any:
    """Shapely polygon around the cells of a space; None where nothing is left of it."""
    import cv2

    kernel = np.ones((_WHISKER, _WHISKER), dtype=np.uint8)
    opened = cv2.morphologyEx(space.astype(np.uint8), cv2.MORPH_OPEN, kernel).astype(bool)
    parts = polygons_of(cells_to_polygon(opened, grid.origin, grid.cell))
    if not parts:
        return None
    ring = shapely.Polygon(
        parts[0].exterior, [h for h in parts[0].interiors if shapely.Polygon(h).area >= _LEAST_HOLE]
    )
    simple = polygons_of(shapely.make_valid(ring.simplify(_SIMPLE * grid.cell)))
    return simple[0] if simple else None


def outline_region(polygon: Any, grid: OccupancyGrid, rows: NDArray[np.int64]) -> Region:
    """A region inside ``polygon``, without name, label and turning distance."""
    polygon = shapely.orient_polygons(polygon)
    window, inside = polygon_window(polygon, grid.origin, grid.cell, grid.states.shape)
    free, total = int((grid.universe[window] & inside).sum()), int(inside.sum())
    sides = tuple(
        _side(a, b, grid, hole)
        for ring, hole in ((polygon.exterior, False), *((r, True) for r in polygon.interiors))
        for a, b in zip(np.asarray(ring.coords)[:-1], np.asarray(ring.coords)[1:], strict=True)
    )
    length = sum(s.length for s in sides)
    walled = sum(s.length * s.observed for s in sides) / length if length else 0.0
    return Region(
        id="", name="", polygon=polygon, label="", free_cells=free, total_cells=total, turning_distance=0.0,
        sides=sides, confidence=round(0.5 * walled + 0.5 * (free / total if total else 0.0), 3), rectangles=rows,
    )  # fmt: skip


def _side(a: Float, b: Float, grid: OccupancyGrid, hole: bool) -> RegionSide:
    """A side with the share of its length along which an occupied cell lies just outside."""
    length = float(np.hypot(*(b - a)))
    steps = max(1, round(length / grid.cell))
    at = a + ((np.arange(steps) + 0.5) / steps)[:, None] * (b - a)
    outside = np.array([b[1] - a[1], a[0] - b[0]]) / max(length, 1e-9)  # the inside is at the left
    seen = np.zeros(steps, dtype=bool)
    for cells in range(_WALL_REACH + 1):
        index = np.floor((at + cells * grid.cell * outside - grid.origin) / grid.cell).astype(int)
        index = np.clip(index, 0, np.array(grid.states.shape)[::-1] - 1)
        seen |= grid.states[index[:, 1], index[:, 0]] == OCCUPIED
    start, end = (float(a[0]), float(a[1])), (float(b[0]), float(b[1]))
    return RegionSide(start, end, "", round(float(seen.mean()), 4), hole)

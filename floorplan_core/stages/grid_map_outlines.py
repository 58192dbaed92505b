"""Outlines of spaces that rectangles of layout planes do not explain: walls at other angles, round rooms.

In: the cells of a space. Out: a region whose boundary is that of the cells, simplified. It is what the map
shows, not what layout planes explain, and its sides name no plane.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.masks import opened
from floorplan_core.geometry.raster import cells_to_polygon
from floorplan_core.geometry.rectilinear import polygons_of
from floorplan_core.model import OCCUPIED, OccupancyGrid, Region, RegionSide
from floorplan_core.stages.regions import count_cells, region_of

Bool = NDArray[np.bool_]
Float = NDArray[np.float64]

_SIMPLE = 1.5  # cells that a simplified outline may deviate
_LEAST_HOLE = 0.25  # m2: smaller holes are no walls
_WALL_REACH = 3  # cells beyond a side in which its wall is looked for
_LONG = 0.5  # m: the direction of shorter sides says nothing
_ASKEW = math.radians(12)  # off the axes by more is a wall at another angle
_STRAIGHTEN = math.radians(6)  # sides nearer to an axis lie along it
_MOVE = 0.15  # m that a corner may move when its sides are straightened


def outline(space: Bool, grid: OccupancyGrid) -> Any:
    """Shapely polygon around a space, its sides along the axes where they nearly are; None if empty."""
    parts = polygons_of(cells_to_polygon(opened(space), grid.origin, grid.cell))  # narrower parts are noise
    if not parts:
        return None
    holes = [h for h in parts[0].interiors if shapely.Polygon(h).area >= _LEAST_HOLE]
    plain = shapely.Polygon(parts[0].exterior, holes).simplify(_SIMPLE * grid.cell)
    straight = shapely.Polygon(_straighten(plain.exterior), [_straighten(h) for h in plain.interiors])
    simple = polygons_of(straight if straight.is_valid else shapely.make_valid(plain))
    return simple[0] if simple else None


def askew_share(polygon: Any) -> float:
    """0 to 1: the share of an outline's length that runs at another angle than the axes."""
    edges = np.concatenate(
        [np.diff(np.asarray(r.coords), axis=0) for r in (polygon.exterior, *polygon.interiors)]
    )
    length = np.hypot(edges[:, 0], edges[:, 1])
    askew = (_off_axis(edges) > _ASKEW) & (length >= _LONG)
    return float(length[askew].sum() / max(length.sum(), 1e-9))


def _off_axis(edges: Float) -> Float:
    """(N,) radians between each edge and the nearer axis."""
    return np.asarray(np.arctan2(np.abs(edges).min(axis=1), np.abs(edges).max(axis=1)))


def _straighten(ring: Any) -> Float:
    """(N, 2) corners of a ring; both ends of every long side near an axis get the same offset, its mean."""
    points = np.asarray(ring.coords)[:-1].copy()
    following = np.roll(points, -1, axis=0)
    edges = following - points
    near = (_off_axis(edges) < _STRAIGHTEN) & (np.hypot(edges[:, 0], edges[:, 1]) >= _LONG)
    target = np.full(points.shape, np.nan)  # offset across x and across y that each corner should have
    for k in np.flatnonzero(near):
        across = 0 if abs(edges[k, 0]) < abs(edges[k, 1]) else 1
        target[[k, (k + 1) % len(points)], across] = (points[k, across] + following[k, across]) / 2
    moved = np.where(np.isnan(target), points, target)
    return np.where(np.abs(moved - points) <= _MOVE, moved, points)


def outline_region(polygon: Any, grid: OccupancyGrid, rows: NDArray[np.int64]) -> Region:
    """A region inside ``polygon``, without name, label and turning distance."""
    polygon = shapely.orient_polygons(polygon)
    free, total = count_cells(polygon, grid)
    sides = tuple(
        _side(a, b, grid, hole)
        for ring, hole in ((polygon.exterior, False), *((r, True) for r in polygon.interiors))
        for a, b in zip(np.asarray(ring.coords)[:-1], np.asarray(ring.coords)[1:], strict=True)
    )
    return region_of(polygon, rows, sides, free, total)


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
    residual = grid.cell / 2 if seen.any() else None  # a wall in a cell is anywhere in it
    return RegionSide(start, end, "", round(float(seen.mean()), 4), hole, residual)

"""Walls that go on unseen: a region that holds a seen piece of wall is parted along its line.

Through a door often only the near end of the wall between two glimpsed rooms is seen, and the rectangles that
explain what was seen of both meet beyond it. A wall goes straight on until something stops it: another wall
that meets it at its end, or free space seen where it would run. Where neither does, the region is cut along
the wall's line, right through; a part in which nothing was seen free is left out, for nothing asks for it.
In: a polygon, planes, the grid. Out: its parts. Cost: walls within the polygon.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.raster import edges_of, polygon_window
from floorplan_core.geometry.rectilinear import chords, open_polygon, polygons_of
from floorplan_core.model import LayoutPlane, OccupancyGrid

Float = NDArray[np.float64]

_SHORTEST = 0.3  # m of wall that tells where it goes on
_INSIDE = 0.25  # m from the sides of the region, within which a wall is its side
_LED_TO = 0.35  # m from the end of a wall to where a region goes on: the cut along it ends a little later
_TOUCH = 0.3  # m between the end of a wall and another that it meets there
_CROSSED = 0.25  # m of the line that may have been seen free: cells are coarse
_DOORWAY, _GAP = 0.95, 1.9  # the same where free space is a guess, in a gap so wide beyond a longer wall
_STRIP = 1.0  # m: what is no wider is no room that such a guess parts from another
_LEAST = 0.1  # m2 of free cells in each part; less in one of them shows nothing
_EXACT = 1e-6  # m


class WallExtender:
    """Parts regions along seen walls that go on unseen."""

    def __init__(
        self, planes: Sequence[LayoutPlane], grid: OccupancyGrid, thickness: float, inferred: bool = False
    ) -> None:
        seen = [p for p in planes if not p.speculated and not p.recess and p.by_hand != "hidden"]
        self._grid, self._thickness = grid, thickness
        self._doorway = _DOORWAY if inferred else 0.0
        walls = [
            (p.facing.axis, p.offset - p.facing.sign * thickness / 2, s, e)
            for p in seen
            for s, e in p.walls.tolist()
            if e - s > _SHORTEST and _observed(p, s, e) > _SHORTEST
        ]
        self._walls = np.array(walls, dtype=np.float64).reshape(-1, 4)  # axis, middle, start, end
        self._faces = tuple(  # offset, start, end of those across x, and of those across y
            np.array(
                [(p.offset, s, e) for p in seen if p.facing.axis == axis for s, e in p.walls.tolist()]
            ).reshape(-1, 3)
            for axis in (0, 1)
        )

    def split(self, polygon: Any) -> list[Any]:
        """The polygon, or the parts in which anything was seen, each split again."""
        walls = self._within(polygon)
        if not len(walls):
            return [polygon]
        edges, grid = edges_of(polygon), self._grid
        found = _going_on(edges, walls, *self._faces, grid.universe, grid.origin, grid.cell, self._doorway)
        for wall in np.unique(found[:, 0]):
            lines = found[found[:, 0] == wall, 1:]
            parts = polygons_of(shapely.difference(polygon, self._cut(lines[:, :4])))
            if len(parts) > 1 and not (lines[:, 4].any() and any(_is_strip(part) for part in parts)):
                seen = [part for part in parts if self._free(part) >= _LEAST]
                if seen and sum(map(self._free, seen)) >= self._free(polygon) - _LEAST:
                    return [room for part in seen for room in self.split(part)]
        return [polygon]

    def _within(self, polygon: Any) -> Float:
        """The walls that are no sides of the polygon, and not elsewhere in the building."""
        x0, y0, x1, y1 = polygon.bounds
        axis, middle, start, end = self._walls.T
        upright = axis == 0
        low, high = np.where(upright, x0, y0), np.where(upright, x1, y1)
        first, last = np.where(upright, y0, x0), np.where(upright, y1, x1)
        inside = (low + _INSIDE < middle) & (middle < high - _INSIDE)
        return np.asarray(self._walls[inside & (first < end + _INSIDE) & (last > start - _INSIDE)])

    def _cut(self, lines: Float) -> Any:
        """The boxes along lines (axis, middle, from, to) through a polygon."""
        half = self._thickness / 2
        boxes = []
        for axis, middle, low, high in lines.tolist():
            u0, u1, v0, v1 = middle - half, middle + half, low - _INSIDE, high + _INSIDE
            boxes.append(shapely.box(u0, v0, u1, v1) if axis == 0 else shapely.box(v0, u0, v1, u1))
        return shapely.union_all(boxes)

    def _free(self, polygon: Any) -> float:
        """m2 of the polygon that were seen free."""
        window, inside = polygon_window(polygon, self._grid.origin, self._grid.cell, self._grid.states.shape)
        return float(np.count_nonzero(self._grid.universe[window] & inside)) * self._grid.cell**2


def _is_strip(polygon: Any) -> bool:
    """True where no room is."""
    return bool(open_polygon(polygon, _STRIP).is_empty)


def _observed(plane: LayoutPlane, start: float, end: float) -> float:
    """Metres of a run that were really seen."""
    common = np.minimum(plane.observed[:, 1], end) - np.maximum(plane.observed[:, 0], start)
    return float(np.maximum(common, 0).sum())


@njit(cache=True, nogil=True)
def _going_on(edges, walls, upright, level, universe, origin, cell, doorway):  # type: ignore[no-untyped-def]
    """(K, 6) wall, axis, middle, from, to of the chords of the polygon along which a wall goes on.

    The last is 1 where that is a guess: a doorway's width of the chord may be free.
    """
    out = np.empty((len(walls) * len(edges), 6))
    count = 0
    for w in range(len(walls)):
        axis, middle, start, end = int(walls[w, 0]), walls[w, 1], walls[w, 2], walls[w, 3]
        across = level if axis == 0 else upright
        for a, b in chords(edges, axis, middle):
            if not _is_on(a, b, start, end):
                continue
            on, guess = True, 0.0
            for low, high in ((a, min(b, start)), (max(a, end), b)):
                if high - low <= _EXACT:
                    continue
                tip = end if low >= end - _EXACT else start
                free = _free_along(universe, axis, middle, low, high, origin, cell)
                if high - low > _INSIDE and _is_met(across, tip, middle):
                    on = False
                elif free > _CROSSED:
                    on, guess = free <= doorway and high - low <= min(_GAP, end - start), 1.0
                if not on:
                    break
            if on:
                out[count, 0], out[count, 1], out[count, 2] = w, axis, middle
                out[count, 3], out[count, 4], out[count, 5] = a, b, guess
                count += 1
    return out[:count]


@njit(cache=True, nogil=True)
def _is_on(a, b, start, end):  # type: ignore[no-untyped-def]
    """True for a chord of the polygon, from ``a`` to ``b``, on which a wall lies or to which it leads."""
    return b - a > _EXACT and a < end + _LED_TO and b > start - _LED_TO


@njit(cache=True, nogil=True)
def _is_met(others, tip, middle):  # type: ignore[no-untyped-def]
    """True where another wall (offset, start, end) meets the end of this one."""
    for offset, start, end in others:
        if abs(offset - tip) < _TOUCH and start < middle + _TOUCH and end > middle - _TOUCH:
            return True
    return False


@njit(cache=True, nogil=True)
def _free_along(universe, axis, middle, low, high, origin, cell):  # type: ignore[no-untyped-def]
    """Metres of the line at ``middle`` across ``axis`` that were seen free."""
    at, along, count = int((middle - origin[axis]) / cell), 1 - axis, 0
    if not 0 <= at < universe.shape[along]:
        return 0.0
    first = max(int(np.rint((low - origin[along]) / cell)), 0)
    for k in range(first, min(int(np.rint((high - origin[along]) / cell)), universe.shape[axis])):
        count += universe[k, at] if axis == 0 else universe[at, k]
    return count * cell

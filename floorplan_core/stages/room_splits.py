"""Rooms that were seen through different doors, and that nothing seen joins.

The wall between two rooms that were only glimpsed is often unseen, and a rectangle then reaches from one into
the other: it is cheapest where it holds the free space of both. What was seen of them tells them apart: the
free cells inside such a region are several patches, each before a door of its own, and no ray passed between.
The region is cut along the straight line that separates them, best along a wall of the building that runs on.
So are the two sides of one door: where a region reaches around the end of the door's wall, what was seen
before and behind the door is one patch each, and the wall between them is cut where they lie side by side.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.masks import label_patches, widened
from floorplan_core.geometry.raster import edges_of, polygon_window
from floorplan_core.geometry.rectilinear import chords, polygons_of
from floorplan_core.model import Door, LayoutPlane, OccupancyGrid

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

_BEFORE = 0.5  # m from a door's wall, where the patch that was seen through it begins
_JOINED = 1  # cells between two patches that are one
_LEAST = 0.3  # m2 of free cells that make a patch
_CROSSED = 1.3  # m of free cells that the line may cross: a door in that wall
_OVERHANG = 0.3  # m by which a patch may reach over the line that parts it from the other
_JAMBS = 0.2  # m beside a door, where its wall parts what lies before and behind it
_ALL = (-np.inf, np.inf)  # right through
_EXACT = 0.05  # m by which a wall is longer than the room that it parts; less than a wall is thick


class RoomSplitter:
    """Cuts regions along lines between the patches of free space that were seen through different doors."""

    def __init__(
        self, planes: Sequence[LayoutPlane], doors: Sequence[Door], grid: OccupancyGrid, thickness: float
    ) -> None:
        self._planes = [p for p in planes if not p.speculated and not p.recess]
        self._grid, self._thickness = grid, thickness
        boxes = [_boxes(d, thickness) for d in doors]
        self._doors = np.array(boxes, dtype=np.float64).reshape(-1, 3, 4)
        self._low, self._high = self._doors[:, :, :2].min(axis=1), self._doors[:, :, 2:].max(axis=1)

    def split(self, polygon: Any) -> list[Any]:
        """The rooms of a region: itself, or its parts, each split again."""
        doors = self._near(polygon)
        if not len(doors):
            return [polygon]
        window, inside = polygon_window(polygon, self._grid.origin, self._grid.cell, self._grid.states.shape)
        patches = self._patches(self._grid.universe[window] & inside, doors, window)
        for k, one in enumerate(patches):
            for other in patches[k + 1 :]:
                wall = self._wall_between(polygon, one, other, np.logical_or.reduce(patches), window)
                parts = [] if wall is None else polygons_of(shapely.difference(polygon, wall))
                if len(parts) > 1:
                    return [room for part in parts for room in self.split(part)]
        return [polygon]

    def _near(self, polygon: Any) -> Float:
        """(D, 3, 4) the boxes of the doors that a cell of the polygon may lie before."""
        low, high = np.array(polygon.bounds).reshape(2, 2)
        reached = (self._low < high + self._grid.cell) & (self._high > low - self._grid.cell)
        return np.asarray(self._doors[reached.all(axis=1)])

    def _patches(self, free: Mask, doors: Float, window: tuple[slice, slice]) -> list[Mask]:
        """The patches on the sides of doors; those on one side of one door are one."""
        near = free
        for _ in range(_JOINED):
            near = widened(near)
        for *sides, within in doors:
            if all(free[self._cells_of(side, window)].any() for side in sides):
                near[self._cells_of(within, window)] = False
        labels = np.where(free, label_patches(near, 8)[0], 0)
        large = np.bincount(labels.ravel()) * self._grid.cell**2 >= _LEAST
        large[0] = False
        if np.count_nonzero(large) < 2:
            return []  # what is one patch is not parted
        groups: list[set[int]] = []
        for box in doors[:, :2].reshape(-1, 4):
            before = labels[self._cells_of(box, window)]
            group = {int(k) for k in np.unique(before) if large[k]} if before.size else set()
            joined = [g for g in groups if g & group]
            groups = [g for g in groups if not g & group] + ([group.union(*joined)] if group else [])
        return [np.isin(labels, list(group)) for group in sorted(groups, key=min)]

    def _cells_of(self, box: Float, window: tuple[slice, slice]) -> tuple[slice, slice]:
        """The cells of the window that a box x0, y0, x1, y1 touches."""
        first = np.floor((box[:2] - self._grid.origin) / self._grid.cell).astype(int)
        last = np.ceil((box[2:] - self._grid.origin) / self._grid.cell).astype(int)
        rows, columns = window
        return (
            slice(max(first[1] - rows.start, 0), max(last[1] - rows.start, 0)),
            slice(max(first[0] - columns.start, 0), max(last[0] - columns.start, 0)),
        )

    def _wall_between(
        self, polygon: Any, one: Mask, other: Mask, seen: Mask, window: tuple[slice, slice]
    ) -> Any:
        """The box of an unseen wall that parts two patches; None where no straight line does.

        Else of one that parts a patch from what lies beside it, within this part of the polygon.
        """
        walls = [self._wall(axis, one, other, seen, window) for axis in (0, 1)]
        if not any(walls):
            walls = [
                self._wall(axis, a, _beside(b, a, axis), seen, window, polygon)
                for a, b in ((one, other), (other, one))
                for axis in (0, 1)
            ]
        return min((w for w in walls if w), key=lambda w: w[0], default=(0.0, None))[1]

    def _wall(
        self,
        axis: int,
        one: Mask,
        other: Mask,
        seen: Mask,
        window: tuple[slice, slice],
        polygon: Any = None,
    ) -> tuple[float, Any] | None:
        """A wall across ``axis`` between two patches, how good it is (less is better), and its box.

        :param polygon: the wall is as long as the polygon beside ``one``; right through if not given.
        """
        if not other.any():
            return None
        cell = self._grid.cell
        corner = self._grid.origin + cell * np.array([window[1].start, window[0].start])
        a, b = (np.flatnonzero(m.any(axis=axis)) for m in (one, other))
        if a[0] > b[0]:
            a, b = b, a
        low, high = float(corner[axis] + cell * (a[-1] + 1)), float(corner[axis] + cell * b[0])
        if low > high + _OVERHANG:
            return None
        middle, rank = self._line(axis, min(low, high), max(low, high))
        rows = corner[1 - axis] + cell * np.flatnonzero(one.any(axis=1 - axis))[[0, -1]]
        ends = _ALL if polygon is None else _ends(polygon, axis, middle, rows)
        if ends is None:
            return None
        line = np.take(seen, round((middle - float(corner[axis])) / cell - 0.5), axis=1 - axis)
        at = corner[1 - axis] + cell * (np.arange(len(line)) + 0.5)
        crossed = float(line[(at > ends[0]) & (at < ends[1])].sum()) * cell
        return (rank, self._box(axis, middle, *ends)) if crossed <= _CROSSED else None

    def _line(self, axis: int, low: float, high: float) -> tuple[float, float]:
        """The middle of the wall between two coordinates, and how good it is (less is better)."""
        half = self._thickness / 2
        faces = [
            p for p in self._planes if p.facing.axis == axis and low - _OVERHANG < p.offset < high + _OVERHANG
        ]
        if not faces:
            return (low + high) / 2, 1.0 + low - high
        face = max(faces, key=lambda p: (p.support, p.id))
        return face.offset - face.facing.sign * half, -face.support

    def _box(self, axis: int, middle: float, start: float, end: float) -> Any:
        low, high = self._grid.extent[1 - axis], self._grid.extent[3 - axis]
        start, end, half = max(start - _EXACT, low), min(end + _EXACT, high), self._thickness / 2
        u0, u1 = middle - half, middle + half
        return shapely.box(u0, start, u1, end) if axis == 0 else shapely.box(start, u0, end, u1)


def _ends(polygon: Any, axis: int, middle: float, rows: Float) -> tuple[float, float] | None:
    """From where to where a line runs inside a polygon beside ``rows``; None if it leaves it between."""
    on = chords(edges_of(polygon), axis, middle)
    on = on[(on[:, 0] < rows[1]) & (on[:, 1] > rows[0])]
    return (float(on[0, 0]), float(on[0, 1])) if len(on) == 1 else None


def _beside(mask: Mask, other: Mask, axis: int) -> Mask:
    """The cells of a mask that lie straight before or behind some of another along ``axis``."""
    band: Mask = np.asarray(other.any(axis=1 - axis))
    return np.asarray(mask & (band[:, None] if axis == 0 else band[None, :]))


def _boxes(door: Door, thickness: float) -> list[tuple[float, float, float, float]]:
    """x0, y0, x1, y1 of what is within reach before and behind a door, and of the door in its wall."""
    half, first, last = max(door.thickness, thickness) / 2, door.start, door.end
    reach = door.thickness / 2 + _BEFORE
    spans = (
        (door.offset - reach, door.offset, first, last),
        (door.offset, door.offset + reach, first, last),
        (door.offset - half, door.offset + half, first - _JAMBS, last + _JAMBS),
    )
    return [(u0, v0, u1, v1) if door.axis == 0 else (v0, u0, v1, u1) for u0, u1, v0, v1 in spans]

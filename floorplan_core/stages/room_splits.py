"""Rooms that were seen through different doors, and that nothing seen joins.

The wall between two rooms that were only glimpsed is often unseen, and a rectangle then reaches from one into
the other: it is cheapest where it holds the free space of both. What was seen of them tells them apart: the
free cells inside such a region are several patches, each before a door of its own, and no ray passed between.
The region is cut along the straight line that separates them, best along a wall of the building that runs on.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.masks import label_patches, widened
from floorplan_core.geometry.raster import polygon_window
from floorplan_core.geometry.rectilinear import polygons_of
from floorplan_core.model import Door, LayoutPlane, OccupancyGrid

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

_BEFORE = 0.5  # m from a door's wall, where the patch that was seen through it begins
_JOINED = 1  # cells between two patches that are one
_LEAST = 0.3  # m2 of free cells that make a patch
_CROSSED = 1.3  # m of free cells that the line may cross: a door in that wall
_OVERHANG = 0.3  # m by which a patch may reach over the line that parts it from the other


class RoomSplitter:
    """Cuts regions along lines between the patches of free space that were seen through different doors."""

    def __init__(
        self, planes: Sequence[LayoutPlane], doors: Sequence[Door], grid: OccupancyGrid, thickness: float
    ) -> None:
        self._planes = [p for p in planes if not p.speculated and not p.recess]
        self._grid, self._thickness = grid, thickness
        self._doors = np.array([_before(d) for d in doors], dtype=np.float64).reshape(-1, 4)

    def split(self, polygon: Any) -> list[Any]:
        """The rooms of a region: itself, or its parts, each split again."""
        doors = self._near(polygon)
        if len(doors) < 2:  # most rooms
            return [polygon]
        window, inside = polygon_window(polygon, self._grid.origin, self._grid.cell, self._grid.states.shape)
        patches = self._patches(self._grid.universe[window] & inside, doors, window)
        for k, one in enumerate(patches):
            for other in patches[k + 1 :]:
                wall = self._wall_between(one, other, np.logical_or.reduce(patches), window)
                parts = [] if wall is None else polygons_of(shapely.difference(polygon, wall))
                if len(parts) > 1:
                    return [room for part in parts for room in self.split(part)]
        return [polygon]

    def _near(self, polygon: Any) -> Float:
        """(D, 4) what lies before the doors that a cell of the polygon may lie before."""
        low, high = np.array(polygon.bounds).reshape(2, 2)
        reached = (self._doors[:, :2] < high + self._grid.cell) & (self._doors[:, 2:] > low - self._grid.cell)
        return np.asarray(self._doors[reached.all(axis=1)])

    def _patches(self, free: Mask, doors: Float, window: tuple[slice, slice]) -> list[Mask]:
        """The patches before doors; those before one door are one."""
        near = free
        for _ in range(_JOINED):
            near = widened(near)
        labels = np.where(free, label_patches(near, 8)[0], 0)
        large = np.bincount(labels.ravel()) * self._grid.cell**2 >= _LEAST
        large[0] = False
        if np.count_nonzero(large) < 2:
            return []  # what is one patch is not parted
        groups: list[set[int]] = []
        for box in doors:
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

    def _wall_between(self, one: Mask, other: Mask, seen: Mask, window: tuple[slice, slice]) -> Any:
        """The box of an unseen wall that parts two patches; None where no straight line does."""
        corner = self._grid.origin + self._grid.cell * np.array([window[1].start, window[0].start])
        best: tuple[float, Any] | None = None
        for axis in (0, 1):
            a, b = (np.flatnonzero(m.any(axis=axis)) for m in (one, other))
            if a[0] > b[0]:
                a, b = b, a
            low = float(corner[axis] + self._grid.cell * (a[-1] + 1))
            high = float(corner[axis] + self._grid.cell * b[0])
            if low > high + _OVERHANG:
                continue
            middle, rank = self._line(axis, min(low, high), max(low, high))
            column = round((middle - float(corner[axis])) / self._grid.cell - 0.5)
            crossed = np.take(seen, column, axis=1 - axis).sum() * self._grid.cell
            if crossed <= _CROSSED and (best is None or rank < best[0]):
                best = rank, self._box(axis, middle)
        return best[1] if best else None

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

    def _box(self, axis: int, middle: float) -> Any:
        x0, y0, x1, y1 = self._grid.extent
        half = self._thickness / 2
        if axis == 0:
            return shapely.box(middle - half, y0, middle + half, y1)
        return shapely.box(x0, middle - half, x1, middle + half)


def _before(door: Door) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 of what is within reach of a door, on both sides."""
    reach = door.thickness / 2 + _BEFORE
    u0, u1, v0, v1 = door.offset - reach, door.offset + reach, door.start, door.end
    return (u0, v0, u1, v1) if door.axis == 0 else (v0, u0, v1, u1)

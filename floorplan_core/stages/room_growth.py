"""Rooms that were seen in part, completed: their guessed sides go out to where walls must be.

What closes a glimpsed room are speculated planes at the edge of what was seen, so that it ends in steps short
of its true walls. These rules complete it, each only over space that nothing seen contradicts: a notch
between guessed sides is filled; a guessed side goes out to the next wall or region ahead, one wall's
thickness before it where only the other face was seen; where there is none, to the next plane of the building
that faces the same way; where nothing is known, to the usual width of the building's rooms. A side that was
borrowed from a far plane comes back first: to a surface that faces the room behind all that was seen of it,
or to what was seen, where a room would be deeper beyond that than rooms are; one that stops short of a wall
ahead goes on to it where the strip between has no door and is too narrow for a room. In and out: disjoint
polygons. Cost: guessed sides times walls.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.masks import label_patches
from floorplan_core.geometry.raster import polygon_window
from floorplan_core.geometry.rectilinear import as_rectangle, polygons_of
from floorplan_core.geometry.summed_area import first_cells
from floorplan_core.model import FREE, Door, Facing, LayoutPlane, OccupancyGrid, RegionSide
from floorplan_core.stages.region_sides import KnownSides, WallSurfaces
from floorplan_core.stages.walls_ahead import DEEP, ON, WALL, WallsAhead

Float = NDArray[np.float64]
Bool = NDArray[np.bool_]

_REACH = 4.0  # m from a guessed side, within which the next wall ahead closes the room
_BORROWED = 2.5  # m, the same for a plane of the building whose wall was seen elsewhere
_KNOWN = 0.25  # share of the sides around a notch that may have been seen
_OPEN = 0.05  # share of cells in the new part that may have been seen free and yet taken for no room
_CRUMB = 0.5  # m2 of free cells in no room: less is a few stray rays, and no open air
_WHOLE, _ENOUGH = 0.8, 3  # share of the boundary that was seen of a whole room; rooms that tell what is usual
_LONG = 2.0  # times the usual width: a longer side is no room's
_STRIP = 0.4  # of the usual width: a strip without a door that is no wider is no room of its own
_BESIDE = 0.3  # m between a strip of floor and the middle of a wall with a door to it
_FACED = 0.3  # share of a side that a surface behind all that was seen must face to be the wall there
_CABINET = 0.7  # m from the front of furniture, within which the wall is that it stands at
_JUST, _CROSSED = 0.3, 0.3  # m beyond a borrowed side, and share of it that was seen free: it is no wall
_EXACT = 1e-6  # m
_FACING = (Facing.EAST, Facing.NORTH, Facing.WEST, Facing.SOUTH)  # of the sides at x0, y0, x1, y1 of a room


@dataclass(frozen=True)
class Frontier:
    """A guessed side, and the way out of the room."""

    facing: Facing
    at: float  # metres, its offset
    low: float  # metres along it
    high: float
    borrowed: bool = False  # it lies on a plane of the building, of which nothing was seen here

    @property
    def out(self) -> int:
        """+1 or -1: the way out along the facing's axis."""
        return -self.facing.sign

    def ahead(self, depth: float, margin: float = 0.0) -> Any:
        """The box from the side to ``depth`` metres ahead, its ends ``margin`` metres narrower."""
        u0, u1 = sorted((self.at, self.at + self.out * depth))
        v0, v1 = self.low + margin, self.high - margin
        return shapely.box(u0, v0, u1, v1) if self.facing.axis == 0 else shapely.box(v0, u0, v1, u1)


@dataclass(frozen=True)
class Reach:
    """How far a side goes: to ``stop``, where something closes the room; never beyond ``limit``. Metres."""

    stop: float = np.inf
    limit: float = _REACH

    def within(self, stop: float, limit: float) -> Reach:
        """The nearer of both."""
        return Reach(min(self.stop, stop), min(self.limit, limit))


class Neighbours:
    """The regions around one, which it must not touch."""

    def __init__(self, polygons: Sequence[Any]) -> None:
        self._polygons = np.array(polygons, dtype=object)
        self._bounds = shapely.bounds(self._polygons).reshape(-1, 4)

    def leave(self, row: int) -> None:
        """The polygon in a row grows: it is no neighbour of itself."""
        self._bounds[row] = np.nan  # near nothing

    def join(self, row: int, polygon: Any) -> None:
        """The polygon in a row has grown to ``polygon``."""
        self._polygons[row], self._bounds[row] = polygon, shapely.bounds(polygon)

    def within(self, part: Any) -> NDArray[np.object_]:
        """What ``part`` has in common with each of those whose bounds it meets."""
        return np.asarray(shapely.intersection(self._polygons[self._near(part)], part))

    def bounds_within(self, part: Any) -> Float:
        """(N, 4) the bounds of what the box ``part`` has in common with each that it meets."""
        near = self._near(part)
        if not near.any():  # as most often
            return np.empty((0, 4))
        clipped = shapely.clip_by_rect(self._polygons[near], *part.bounds)
        return np.asarray(shapely.bounds(clipped[~shapely.is_empty(clipped)]))

    def _near(self, part: Any) -> Bool:
        x0, y0, x1, y1 = part.bounds
        left, low, right, high = self._bounds.T
        return np.asarray((left <= x1) & (low <= y1) & (right >= x0) & (high >= y0))


class RoomGrower:
    """Completes regions with guessed sides."""

    def __init__(
        self,
        planes: Sequence[LayoutPlane],
        walls: WallSurfaces,
        doors: Sequence[Door],
        grid: OccupancyGrid,
        min_support: float,
    ) -> None:
        self._walls, self._grid = walls, grid
        self._doors = _lines([d.line() for d in doors])
        self.sides = KnownSides(walls, doors)
        self._usual = self._deep = 0.0
        self._outdoors = _large_patches((grid.states == FREE) & ~grid.universe, _CRUMB / grid.cell**2)
        self._ahead = WallsAhead(planes, walls.thickness)
        runs = [(p.facing, p.offset, s, e) for p in planes for s, e in p.walls.tolist()]
        self._lines = _lines([_line(*run) for run in runs])
        self._tree = shapely.STRtree(self._lines)
        seen = [p for p in planes if not p.speculated]
        strong = [p for p in seen if p.support >= min_support and not p.recess]
        self._offsets = {f: np.array([p.offset for p in seen if p.facing == f]) for f in Facing}
        self._borrowed = {f: np.array([p.offset for p in strong if p.facing == f]) for f in Facing}

    def grow_all(self, polygons: Sequence[Any]) -> list[Any]:
        """Each polygon completed, one after the other, beside the others as they are by then."""
        self._usual, self._deep = self._usual_sizes(polygons)
        others, grown = Neighbours(polygons), []
        for row, polygon in enumerate(polygons):
            others.leave(row)
            grown.append(self.grow(polygon, others))
            others.join(row, grown[-1])
        return grown

    def grow(self, polygon: Any, others: Neighbours) -> Any:
        """``polygon`` completed, without touching ``others``."""
        polygon = shapely.orient_polygons(polygon)
        if not self._is_guessed(polygon):
            return polygon
        back, closed = self._pull_back(polygon)
        filled = self._fill_notches(back, others)
        pushed = self._push_sides(filled, others, closed)
        whole = _largest(pushed)
        if filled is back and pushed is filled:
            return whole  # the notches that it has are those that were just left
        return self._fill_notches(whole, others)

    def _sides(self, polygon: Any) -> list[RegionSide]:
        """The outer sides."""
        return [s for s in self.sides.of(polygon) if not s.hole]

    def _is_guessed(self, polygon: Any) -> bool:
        return any(s.speculated for s in self._sides(polygon))

    def _fill_notches(self, polygon: Any, others: Neighbours) -> Any:
        """The polygon with the parts of its bounding box that only guessed sides cut off."""
        if as_rectangle(polygon) is not None:  # most rooms
            return polygon
        notches = polygons_of(shapely.difference(shapely.box(*polygon.bounds), polygon))
        sides = self._sides(polygon)  # a notch that is filled leaves the sides of the others as they are
        lines = _lines([(s.start, s.end) for s in sides])
        for notch in notches:
            contact = shapely.length(shapely.intersection(lines, notch))
            known = float(contact @ np.array([s.observed for s in sides]))
            if known < _KNOWN * contact.sum() and self._unknown(notch, polygon, others):
                polygon = _largest(polygon.union(notch))
        return polygon

    def _pull_back(self, polygon: Any) -> tuple[Any, dict[Facing, float]]:
        """The polygon without what lies behind all that was seen of it and a surface that faces it there, or
        farther beyond it than a room is deep; and where such surfaces are: facing and offset.
        """
        free, own = self._free_bounds(polygon), polygon.bounds
        if free is None:
            return polygon, {}
        seen = self._seen_bounds(polygon, free)
        surfaces = [self._surface(k, own, free[k]) for k in range(4)]
        u0, v0, u1, v1 = (
            at if at is not None and abs(at - own[k]) > ON else self._not_too_deep(own[k], seen[k])
            for k, at in enumerate(surfaces)
        )
        closed = {f: at for f, at in zip(_FACING, surfaces, strict=True) if at is not None}
        rest = polygon.intersection(shapely.box(u0, v0, u1, v1))
        cell = self._grid.cell
        if min(u1 - u0, v1 - v0) < cell or rest.area < cell**2:
            return polygon, {}  # surfaces on both sides of a strip that a few rays passed
        return _largest(rest), closed

    def _not_too_deep(self, own: float, seen: float) -> float:
        """The side of a room where it is, unless that is farther beyond what was seen than a room is deep."""
        return own if not self._deep or abs(own - seen) <= self._deep else seen

    def _surface(self, k: int, own: tuple[float, ...], free: float) -> float | None:
        """Where a surface faces side ``k`` of a room with bounds ``own`` beyond all that was seen ``free``.

        It may be no wall run: above a cabinet, or beside a door's leaf, too little of it shows. Walls come
        before what may be furniture; of the latter the last that was seen past the first.
        """
        axis, out = k % 2, 1.0 if k >= 2 else -1.0
        start, end = own[1 - axis], own[3 - axis]
        for rows, depth in zip(self._walls.ahead(_FACING[k], start, end), (0.0, _CABINET), strict=True):
            offset, faced = rows.T
            beyond, before = (offset - free) * out, (own[k] - offset) * out
            closing = (beyond > -self._grid.cell) & (before > -depth - ON) & (faced > _FACED * (end - start))
            if closing.any():
                first = beyond[closing].min()
                return float(free + out * beyond[closing & (beyond <= first + depth)].max())
        return None

    def _free_bounds(self, polygon: Any) -> tuple[float, float, float, float] | None:
        """x0, y0, x1, y1 of what was seen free in a room."""
        grid = self._grid
        window, inside = polygon_window(polygon, grid.origin, grid.cell, grid.states.shape)
        rows, columns = np.nonzero(grid.universe[window] & inside)
        if len(rows) == 0:
            return None
        corner = grid.origin + grid.cell * np.array([window[1].start, window[0].start])
        low = corner + grid.cell * np.array([columns.min(), rows.min()])
        high = corner + grid.cell * np.array([columns.max() + 1, rows.max() + 1])
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    def _seen_bounds(self, polygon: Any, free: tuple[float, ...]) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 of what was seen of a room: its free cells and the walls along its sides."""
        low, high = np.array(free[:2]), np.array(free[2:])
        for side in self._sides(polygon):
            a, b = np.array(side.start), np.array(side.end)
            along = int(abs(a[0] - b[0]) < abs(a[1] - b[1]))
            for start, end in self._walls.along(a, b):
                low[along], high[along] = min(low[along], start), max(high[along], end)
                low[1 - along] = min(low[1 - along], a[1 - along])
                high[1 - along] = max(high[1 - along], a[1 - along])
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    def _push_sides(self, polygon: Any, others: Neighbours, closed: dict[Facing, float]) -> Any:
        """The polygon with each guessed side pushed out as far as it goes, but past no ``closed`` surface."""
        for front in list(self._frontiers(polygon)):
            to_surface = (closed.get(front.facing, np.inf * front.out) - front.at) * front.out
            depth = min(self._depth(front, polygon, others), to_surface)
            if depth > ON and self._unknown(front.ahead(depth), polygon, others):
                polygon = polygon.union(front.ahead(depth))
        return polygon

    def _frontiers(self, polygon: Any) -> Iterator[Frontier]:
        """The guessed sides; those on a plane of the building where nothing was seen of it are borrowed."""
        for side in (s for s in self._sides(polygon) if s.speculated):
            facing = self._walls.facing(side.start, side.end)
            a = facing.axis
            on_plane = bool((np.abs(self._offsets[facing] - side.start[a]) < ON).any())
            if not (on_plane and side.observed > 0):
                low, high = sorted((side.start[1 - a], side.end[1 - a]))
                yield Frontier(facing, side.start[a], low, high, on_plane)

    def _is_crossed(self, front: Frontier) -> bool:
        """True where much of what lies just beyond a side was seen free: there is no wall."""
        a, grid = front.facing.axis, self._grid
        ends = np.empty((2, 2))  # x and y; from, to
        ends[a] = sorted((front.at, front.at + front.out * _JUST))
        ends[1 - a] = front.low, front.high
        first = [first_cells(ends[k], float(grid.origin[k]), grid.cell) for k in (0, 1)]
        x, y = (slice(*np.maximum(cells, 0).tolist()) for cells in first)
        cells = grid.universe[y, x]
        return bool(np.count_nonzero(cells) > _CROSSED * cells.size > 0)

    def _depth(self, front: Frontier, polygon: Any, others: Neighbours) -> float:
        """Metres by which a side goes out; 0 where it stays."""
        reach = Reach().within(*self._ahead.limits(front.facing, front.at, front.low, front.high))
        if min(reach.stop, reach.limit) <= ON:
            return 0.0
        reach = self._before_regions(front, others, reach)
        reach = reach.within(self._to_own_side(front, polygon), _REACH)
        if front.borrowed and not self._is_crossed(front):
            return self._strip(front, reach.stop) if reach.stop <= reach.limit else 0.0
        if reach.stop <= reach.limit:
            return reach.stop
        planes = (self._borrowed[front.facing] - front.at) * front.out
        planes = planes[(planes > ON) & (planes <= min(reach.limit, _BORROWED))]
        if len(planes):
            return float(planes.min())
        return float(min(self._missing(front, polygon), reach.limit - self._walls.thickness))

    def _strip(self, front: Frontier, depth: float) -> float:
        """``depth`` where a strip lies ahead that has no door and is too narrow for a room; else 0."""
        if not ON < depth <= _STRIP * self._usual:
            return 0.0
        beside = front.ahead(depth).buffer(_BESIDE)
        return 0.0 if shapely.intersects(beside, self._doors).any() else depth

    def _to_own_side(self, front: Frontier, polygon: Any) -> float:
        """Metres to the room's own wall ahead, seen beside the guessed side; infinite where there is none."""
        a = front.facing.axis
        ahead = [
            (side.start[a] - front.at) * front.out
            for side in self._sides(polygon)
            if self._walls.facing(side.start, side.end) == front.facing and side.length * side.observed > WALL
        ]
        return min((u for u in ahead if u > ON), default=np.inf)

    def _missing(self, front: Frontier, polygon: Any) -> float:
        """Metres that a room lacks to the usual width; half of it where its other side is guessed too."""
        a = front.facing.axis
        if front.high - front.low > _LONG * self._usual:
            return 0.0  # the side of a corridor: rooms tell nothing about its width
        lacks = max(self._usual - float(polygon.bounds[a + 2] - polygon.bounds[a]), 0.0)
        both = any(f.facing == front.facing.opposite for f in self._frontiers(polygon))
        known = np.concatenate([self._offsets[f] for f in Facing if f.axis == a])
        to_last_wall = float(((known - front.at) * front.out).max(initial=0.0))
        return min(lacks / 2 if both else lacks, to_last_wall)

    def _usual_sizes(self, polygons: Sequence[Any]) -> tuple[float, float]:
        """The median width and depth (the longer) of the rooms seen whole; 0 where there are too few."""
        sizes = []
        for polygon in polygons:
            x0, y0, x1, y1 = polygon.bounds
            sides = self._sides(shapely.orient_polygons(polygon))
            seen = sum(s.length * s.observed for s in sides) / polygon.exterior.length
            if seen > _WHOLE:
                sizes.append(sorted((x1 - x0, y1 - y0)))
        if len(sizes) < _ENOUGH:
            return 0.0, 0.0
        width, depth = np.median(sizes, axis=0)
        return float(width), float(depth)

    def _before_regions(self, front: Frontier, others: Neighbours, reach: Reach) -> Reach:
        """Between two regions stands a wall."""
        depth = min(_REACH, max(reach.limit, reach.stop + self._walls.thickness))  # beyond it none matters
        strip = front.ahead(depth, min(DEEP, (front.high - front.low) / 3))
        met = others.bounds_within(strip)
        if not len(met):
            return reach
        a = front.facing.axis
        ahead = float(np.abs(met[:, [a, a + 2]] - front.at).min())
        return reach.within(ahead - self._walls.thickness, ahead)

    def _unknown(self, part: Any, polygon: Any, others: Neighbours) -> bool:
        """True where nothing seen contradicts that ``part`` is floor of the room ``polygon``."""
        if shapely.area(others.within(part)).sum() > _EXACT:
            return False
        window, inside = polygon_window(part, self._grid.origin, self._grid.cell, self._grid.states.shape)
        if np.count_nonzero(self._outdoors[window] & inside) > _OPEN * inside.sum():
            return False
        x0, y0, x1, y1 = part.bounds
        near = self._lines[self._tree.query(shapely.box(x0 - DEEP, y0 - DEEP, x1 + DEEP, y1 + DEEP))]
        if not len(near):
            return True
        before, after = (s.buffer(-DEEP, join_style="mitre") for s in (polygon, polygon.union(part)))
        gained = shapely.length(shapely.intersection(near, after.difference(before)))
        return not bool((gained > WALL).any())


def _large_patches(mask: Bool, least: float) -> Bool:
    """The mask without its patches of fewer than ``least`` cells."""
    if not mask.any():
        return mask
    label, count = label_patches(mask)
    large = np.bincount(label.ravel(), minlength=count + 1) >= least
    large[0] = False
    return np.asarray(large[label])


def _lines(ends: Sequence[Any]) -> NDArray[np.object_]:
    """A LineString for each pair of points."""
    return np.asarray(shapely.linestrings(np.array(ends, dtype=np.float64).reshape(-1, 2, 2)))


def _line(facing: Facing, offset: float, start: float, end: float) -> list[tuple[float, float]]:
    ends = [(offset, start), (offset, end)]
    return ends if facing.axis == 0 else [(v, u) for u, v in ends]


def _largest(shape: Any) -> Any:
    return shapely.orient_polygons(polygons_of(shapely.set_precision(shape, _EXACT))[0])

"""Regions of a building and of its wings as one plan: each cut where the walls of the others stand.

In: the regions of every part, in the axes of the plan. Out: disjoint ones. A rectangle of one part does not
know the walls of another that cross it; what lies behind them goes, unless the part saw free floor there. Of
what two regions share, the one that saw more of its own area keeps it. Cost: quadratic in regions that meet.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.raster import polygon_window
from floorplan_core.geometry.rectilinear import polygons_of
from floorplan_core.model import FREE, Door, LayoutPlane, OccupancyGrid, Region, RegionSide
from floorplan_core.model.corrections import Point
from floorplan_core.model.layout import turned
from floorplan_core.stages.region_names import in_reading_order
from floorplan_core.stages.regions import count_cells, region_of

Float = NDArray[np.float64]

_HALF_WALL = 0.01  # m around a wall's face, that is cut away with it
_GAP = 0.6  # m between a region and a wall of another part, up to which the region may end at it
_CRUMB = 0.003  # m2: less between two steps is not looked at
_STRAIGHT = 0.015  # m: corners nearer to the line through their neighbours are none
_EXACT, _NOTHING = 1e-6, 1e-6  # m, m2
_LONGER = 0.3  # m that a cut is longer than its wall at both ends: it meets the next one
_LEAST_WALL = 0.8  # m: a shorter piece of wall cuts nothing
_INSIDE = 0.2  # m into a region, from which a wall of another part crosses it
_LEAST_FLOOR = 0.3  # share of a piece that its part saw free
_SLIVER = 0.15  # m: half the width of what is too narrow to be floor
_ON = 0.05  # m between a side and the line that it lies on
_SAME_DOOR = 0.6  # m between the middles of one door that two parts found


@dataclass(frozen=True)
class PartLayout:
    """What was found in one part."""

    turn: float  # radians from the plan's axes to those of the part
    planes: tuple[LayoutPlane, ...]  # axes of the part
    doors: tuple[Door, ...]
    regions: tuple[Region, ...]
    grid: OccupancyGrid


def join_regions(parts: Sequence[PartLayout], least: float, quarters: int) -> tuple[Region, ...]:
    """The regions of all parts in the axes of the plan, disjoint, in reading order; at least ``least`` m2.

    :param quarters: quarter turns from the axes of the plan to those of the reader.
    """
    found = [
        (turned_region(region, part.turn, k), part, walls_of(other for other in parts if other is not part))
        for k, part in enumerate(parts)
        for region in part.regions
    ]
    pieces = [
        piece
        for region, part, walls in found
        for piece in _cut(region, part, walls, _taken_before(region, []), least)
    ]
    ordered = sorted(pieces, key=lambda piece: (-_seen(piece[0]), -piece[0].area, piece[0].polygon.bounds))
    done: list[Region] = []
    for region, part, walls in ordered:
        done += [r for r, _, _ in _cut(region, part, walls, _taken_before(region, done), least)]
    return in_reading_order(done, quarters)


def join_doors(parts: Sequence[PartLayout], rejected: Sequence[Point] = ()) -> tuple[Door, ...]:
    """The doors of all parts; one that two found is that which is surer.

    :param rejected: places in the plan where a person said that there is none: none that another part found.
    """
    doors = [
        replace(
            d, id=named(d.id, k), planes=tuple(named(p, k) for p in d.planes), turn=part.turn, connects=()
        )
        for k, part in enumerate(parts)
        for d in part.doors
    ]
    doors = [d for d in doors if d.by_hand or not _is_near(d, rejected)]
    kept: list[Door] = []
    for door in sorted(doors, key=lambda d: -d.confidence):
        others = [d.line().mean(axis=0) for d in kept if d.turn != door.turn]
        if not _is_near(door, others):
            kept.append(door)
    chosen = {d.id for d in kept}
    return tuple(d for d in doors if d.id in chosen)


def _is_near(door: Door, places: Sequence[Float | Point]) -> bool:
    middle = door.line().mean(axis=0)
    return any(np.hypot(*(middle - place)) <= _SAME_DOOR for place in places)


def join_grids(whole: OccupancyGrid, parts: Sequence[PartLayout], cells: Sequence[NDArray[np.bool_]]) -> Any:
    """``whole`` with the states and the universe that each wing has where its floor is."""
    states, universe = whole.states.copy(), whole.universe.copy()
    rows, columns = np.nonzero(np.any(cells, axis=0)) if len(cells) else (np.zeros(0, int), np.zeros(0, int))
    centres = (np.column_stack([columns, rows]) + 0.5) * whole.cell + whole.origin
    for part, mask in zip(parts, cells, strict=True):
        own = mask[rows, columns]
        at = turned(centres[own], -part.turn)
        index = np.floor((at - part.grid.origin) / part.grid.cell).astype(np.int64)
        ny, nx = part.grid.states.shape
        inside = (index >= 0).all(axis=1) & (index[:, 0] < nx) & (index[:, 1] < ny)
        r, c, index = rows[own][inside], columns[own][inside], index[inside]
        states[r, c] = part.grid.states[index[:, 1], index[:, 0]]
        universe[r, c] = part.grid.universe[index[:, 1], index[:, 0]]
    return replace(whole, states=states, universe=universe)


def named(ident: str, part: int) -> str:
    """The id of a thing of a part: those of a wing say so."""
    return ident if part == 0 or not ident else f"w{part}{ident}"


def turned_region(region: Region, turn: float, part: int) -> Region:
    """A region of a part in the axes of the plan; its sides name the part's planes as the plan does."""
    if turn == 0.0:
        return region

    def move(xy: Any) -> Any:
        return turned(np.asarray(xy), turn)

    def side(s: RegionSide) -> RegionSide:
        (ax, ay), (bx, by) = move([s.start, s.end]).tolist()
        return replace(s, start=(ax, ay), end=(bx, by), plane=named(s.plane, part))

    polygon = shapely.transform(region.polygon, move)
    return replace(region, polygon=polygon, sides=tuple(map(side, region.sides)), rectangles=None)


def walls_of(parts: Iterable[PartLayout]) -> Any:
    """The faces of the walls of parts, in the axes of the plan, as lines a little longer than they are."""
    lines = []
    for part in parts:
        for plane in part.planes:
            for start, end in plane.walls if not (plane.speculated or plane.recess) else ():
                if end - start >= _LEAST_WALL:
                    along = np.array([start - _LONGER, end + _LONGER])
                    xy = np.column_stack([np.full(2, plane.offset), along])
                    xy = xy if plane.facing.axis == 0 else xy[:, ::-1]
                    lines.append(shapely.LineString(turned(xy, part.turn)))
    return shapely.union_all(np.array(lines, dtype=object))


def _taken_before(region: Region, done: Sequence[Region]) -> Any:
    return shapely.union_all([r.polygon for r in done if r.polygon.intersects(region.polygon)])


def _seen(region: Region) -> float:
    return round(region.free_cells / region.total_cells, 6) if region.total_cells else 0.0


def _cut(
    region: Region, part: PartLayout, walls: Any, taken: Any, least: float
) -> list[tuple[Region, PartLayout, Any]]:
    """What is left of a region behind the walls of other parts and without what is ``taken``."""
    polygon = _up_to(region.polygon, part, walls)
    core = polygon.buffer(-_INSIDE, join_style="mitre")
    crossing = walls.buffer(_HALF_WALL, cap_style="flat") if walls.intersects(core) else shapely.Polygon()
    if crossing.is_empty and polygon is region.polygon and taken.intersection(polygon).area < _NOTHING:
        return [(region, part, walls)]
    rest = shapely.difference(shapely.difference(polygon, crossing), taken)
    rest = rest.buffer(-_SLIVER, join_style="mitre").buffer(_SLIVER, join_style="mitre")
    rest = shapely.difference(rest, taken).intersection(polygon)
    out = []
    for piece in polygons_of(shapely.set_precision(rest, _EXACT)):
        free, total = _cells(piece, part)
        if piece.area >= least and free > _LEAST_FLOOR * total:
            tidy = shapely.orient_polygons(piece.simplify(_STRAIGHT))
            made = region_of(tidy, None, sides_between(tidy, region.sides, walls), free, total)
            out.append((replace(made, height=region.height), part, walls))
    return out


def _up_to(polygon: Any, part: PartLayout, walls: Any) -> Any:
    """The polygon out to the walls of other parts beside it, over floor that its part saw: steps at a slant
    become the wall's line."""
    near = walls.intersection(polygon.buffer(_GAP, join_style="mitre"))
    if near.is_empty:
        return polygon
    band = near.buffer(_HALF_WALL, cap_style="flat")
    closed = (
        shapely.union(polygon, band)
        .buffer(_GAP / 2, join_style="mitre")
        .buffer(-_GAP / 2, join_style="mitre")
    )
    extra = closed.intersection(near.buffer(_GAP)).difference(polygon).difference(band)
    drawn = _drawn_walls(part)  # what lies behind one is seen floor, but another room's
    if not drawn.is_empty:
        extra = extra.difference(drawn.buffer(_HALF_WALL, cap_style="flat"))
        extra = shapely.union_all([p for p in polygons_of(extra) if p.distance(polygon) < _EXACT])
    seen = [piece for piece in polygons_of(extra) if _is_floor(piece, part)]
    if not seen:
        return polygon
    grown = shapely.union_all([polygon, *(p.buffer(_HALF_WALL, join_style="mitre") for p in seen)])
    return max(
        polygons_of(grown.difference(walls.buffer(_HALF_WALL / 2, cap_style="flat"))), key=lambda p: p.area
    )


def _drawn_walls(part: PartLayout) -> Any:
    """The walls that a person drew in a part, in the axes of the plan."""
    return walls_of([replace(part, planes=tuple(p for p in part.planes if p.by_hand == "added"))])


def _is_floor(piece: Any, part: PartLayout) -> bool:
    """True where the part saw enough free floor in a piece of the plan."""
    if piece.area < _CRUMB:
        return False
    grid, around = part.grid, _turned_into(part, piece.buffer(part.grid.cell))
    window, inside = polygon_window(around, grid.origin, grid.cell, grid.states.shape)
    free = int(np.count_nonzero(inside & (grid.states[window] == FREE)))
    return free > _LEAST_FLOOR * int(np.count_nonzero(inside))


def _cells(polygon: Any, part: PartLayout) -> tuple[int, int]:
    """Cells of the part's universe, and all cells, inside a polygon in the axes of the plan."""
    return count_cells(_turned_into(part, polygon), part.grid)


def _turned_into(part: PartLayout, polygon: Any) -> Any:
    """A polygon in the axes of the plan, in those of the part."""
    return shapely.transform(polygon, lambda xy: turned(xy, -part.turn))


def sides_between(polygon: Any, before: Sequence[RegionSide], walls: Any) -> tuple[RegionSide, ...]:
    """The sides of what is left: as they were, or along the wall that cut them."""
    rings = ((polygon.exterior, False), *((ring, True) for ring in polygon.interiors))
    return tuple(
        _side(a, b, hole, before, walls)
        for ring, hole in rings
        for a, b in zip(np.asarray(ring.coords)[:-1], np.asarray(ring.coords)[1:], strict=True)
        if np.hypot(*(b - a)) > _NOTHING
    )


def _side(a: Float, b: Float, hole: bool, before: Sequence[RegionSide], walls: Any) -> RegionSide:
    ends = (float(a[0]), float(a[1])), (float(b[0]), float(b[1]))
    length = float(np.hypot(*(b - a)))
    along = (b - a) / length
    across = np.array([-along[1], along[0]])
    best, seen = None, 0.0
    for side in before:
        p, q = np.array(side.start) - a, np.array(side.end) - a
        if max(abs(p @ across), abs(q @ across)) > _ON:
            continue
        ends_along = sorted((float(p @ along), float(q @ along)))
        common = min(length, ends_along[1]) - max(0.0, ends_along[0])
        if common > 0:
            seen += common * side.observed
            best = side if best is None or side.length > best.length else best
    if best is None:
        on = shapely.intersection(shapely.LineString([a, b]), walls.buffer(_ON, cap_style="flat"))
        return RegionSide(*ends, "", round(min(1.0, float(on.length) / length), 4), hole)
    return RegionSide(*ends, best.plane, round(min(1.0, seen / length), 4), hole, best.residual)

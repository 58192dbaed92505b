"""Regions: connected unions of the chosen rectangles (paper, section "Layout Estimation").

In: the cover, planes, segments, doors and the grid. Out: disjoint regions with their sides. Rectangles that
overlap belong together; every rectangle is free of walls and doors, so their union is too. The sides then
move from the infinite planes to the surfaces that were seen along them, so that dimensions come from points.
What is left of an overlap between two regions goes to the one with more evidence. Cost: quadratic in the
number of rectangles of one neighbourhood, otherwise linear.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.config import RegionsConfig
from floorplan_core.geometry.raster import polygon_window
from floorplan_core.geometry.rectilinear import (
    close_polygon,
    open_polygon,
    polygons_of,
    union_boxes,
    without_slits,
)
from floorplan_core.model import (
    Door,
    LayoutPlane,
    LayoutSegment,
    OccupancyGrid,
    RectangleCover,
    Region,
    RegionSide,
)
from floorplan_core.stages.rectangle_groups import connected_groups, separators
from floorplan_core.stages.region_confidence import measures_of, probability
from floorplan_core.stages.region_sides import WallSurfaces, sides_of
from floorplan_core.stages.room_growth import RoomGrower
from floorplan_core.stages.room_splits import RoomSplitter
from floorplan_core.stages.slanted_walls import StandingCells
from floorplan_core.stages.stairs import Flight, part_flights
from floorplan_core.stages.wall_cuts import cut_walls, standing_walls
from floorplan_core.stages.wall_extensions import WallExtender

Float = NDArray[np.float64]

_DEEP = 0.1  # m around a notch: less of it is the corner of a wall
_SLIT = 0.02  # m: a narrower hole in a region is the jitter of planes that should have met

_PROBES = (0.15, 0.3, 0.5)  # m from the wall's face, where the region behind a door is looked for


def build_regions(
    cover: RectangleCover,
    planes: Sequence[LayoutPlane],
    segments: Sequence[LayoutSegment],
    doors: Sequence[Door],
    grid: OccupancyGrid,
    config: RegionsConfig,
    flights: Sequence[Flight] = (),
    inferred: bool = False,
    tall: StandingCells | None = None,
) -> tuple[Region, ...]:
    """The regions, without name, label or turning distance.

    :param flights: of stairs, each a region of its own.
    :param inferred: True where free space was not seen, but inferred from floor and ceiling.
    :param tall: where something stands as high as a wall: what it hides behind it at a slant is no floor.
    """
    groups = connected_groups(cover.bounds, separators(planes, doors))
    standing = standing_walls(planes, config.wall_support)
    shapes = [
        open_polygon(cut_walls(_union(cover.bounds[rows], bridges), standing), config.sliver)
        for rows, bridges in groups
    ]
    walls = WallSurfaces(planes, segments)
    pieces: list[tuple[Any, NDArray[np.int64]]] = []
    splitter = RoomSplitter(planes, doors, grid, walls.thickness)
    extender = WallExtender(planes, grid, walls.thickness, inferred)
    for shape, (rows, _) in zip(shapes, groups, strict=True):
        halves = [half for part in polygons_of(shape) for half in extender.split(part)]
        rooms = [
            r for half in halves for room in splitter.split(half) for r in part_flights(room, flights, doors)
        ]
        pieces += [(walls.fit(room), rows) for room in rooms]
    apart = _disjoint(pieces, grid, config.sliver)
    grower = RoomGrower(planes, walls, doors, grid, config.wall_support)
    grown = grower.grow_all([shape for shape, _ in apart])
    if any(plane.by_hand for plane in planes):  # both sides of a wall in the open went to where it was put
        grown = [_without_notches(shape) for shape in grown]
    whole = [  # a room that grew may have grown past the end of a wall
        (shapely.orient_polygons(part), rows, steps)
        for shape, (_, rows) in zip(grown, apart, strict=True)
        for bounded, steps in (_bounded(cut_walls(shape, standing), tall, config.sliver),)
        for part in polygons_of(bounded)
    ]
    regions = [
        region_of(polygon, rows, _seen(grower.sides.of(polygon), steps), *count_cells(polygon, grid))
        for polygon, rows, steps in whole
    ]
    kept = [r for r in regions if _acceptable(r, config)]
    return tuple(kept)


def _bounded(shape: Any, tall: StandingCells | None, sliver: float) -> tuple[Any, StandingCells | None]:
    """The shape without what lies behind walls on no plane of the frame, and what tells its new sides.

    The shape itself, and None, where there are no such walls.
    """
    if tall is None:
        return shape, None
    parts = polygons_of(shape)
    cut = [tall.cut(part, sliver) for part in parts]
    if all(a is b for a, b in zip(cut, parts, strict=True)):
        return shape, None
    return shapely.union_all(cut), tall


def _seen(sides: tuple[RegionSide, ...], tall: StandingCells | None) -> tuple[RegionSide, ...]:
    """The sides; those that no plane explains were seen where something stands along them."""
    if tall is None:
        return sides
    return tuple(
        s if s.plane else replace(s, observed=max(s.observed, tall.along(s.start, s.end))) for s in sides
    )


def _without_notches(shape: Any) -> Any:
    """The shape without what goes deep into it and is narrower than a slit; itself where nothing does."""
    closed = close_polygon(shape, _SLIT)
    return closed if shape.length - closed.length > _DEEP else shape


def _union(bounds: Float, bridges: Float) -> Any:
    """The union of one group and of the boxes that join it."""
    return union_boxes(np.concatenate([bounds, bridges]))


def _disjoint(
    pieces: list[tuple[Any, NDArray[np.int64]]], grid: OccupancyGrid, sliver: float
) -> list[tuple[Any, NDArray[np.int64]]]:
    """Cut the overlaps: what two regions share belongs to the one that saw more of its own area."""

    def rank(piece: tuple[Any, NDArray[np.int64]]) -> tuple[float, float, tuple[float, ...]]:
        free, total = count_cells(piece[0], grid)
        return -round(free / total, 6) if total else 0.0, -piece[0].area, piece[0].bounds

    ordered = sorted(pieces, key=rank)
    shapes = np.array([p if p.is_valid else shapely.make_valid(p) for p, _ in ordered], dtype=object)
    later, earlier = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    done: list[Any] = []
    out: list[tuple[Any, NDArray[np.int64]]] = []
    for k, (_, rows) in enumerate(ordered):
        before = [done[j] for j in np.sort(earlier[(later == k) & (earlier < k)])]
        rest = shapes[k]
        if before:
            rest = open_polygon(shapely.difference(rest, shapely.union_all(before)), sliver)
        rest = without_slits(shapely.set_precision(rest, 1e-6), _SLIT)
        done.append(rest)
        out += [(part, rows) for part in polygons_of(rest)]
    return out


def count_cells(polygon: Any, grid: OccupancyGrid) -> tuple[int, int]:
    """Cells of the universe, and all cells, inside a polygon."""
    window, inside = polygon_window(polygon, grid.origin, grid.cell, grid.states.shape)
    return int(np.count_nonzero(grid.universe[window] & inside)), int(np.count_nonzero(inside))


def make_region(
    polygon: Any, rows: NDArray[np.int64], walls: WallSurfaces, doors: Sequence[Door], grid: OccupancyGrid
) -> Region:
    """The region of a polygon and of ``rows`` of the cover, with sides and cells; no id, name or label."""
    polygon = shapely.orient_polygons(polygon)
    sides = sides_of(polygon, walls, doors)
    free, total = count_cells(polygon, grid)
    return region_of(polygon, rows, sides, free, total)


def region_of(
    polygon: Any, rows: NDArray[np.int64] | None, sides: tuple[RegionSide, ...], free: int, total: int
) -> Region:
    """A region without id, name or label, with the probability that it is a room."""
    return Region(
        id="",
        name="",
        polygon=polygon,
        label="",
        free_cells=free,
        total_cells=total,
        turning_distance=0.0,
        sides=sides,
        confidence=probability(measures_of(sides, free, total, polygon.area)),
        rectangles=rows,
    )


def _acceptable(region: Region, config: RegionsConfig) -> bool:
    """Large enough, and below the risk threshold: total cells a free cell."""
    risk = region.total_cells / region.free_cells if region.free_cells else np.inf
    return region.area >= config.min_area and risk <= config.risk


def connect_doors(
    regions: Sequence[Region], doors: Sequence[Door]
) -> tuple[tuple[Region, ...], tuple[Door, ...]]:
    """Which one or two regions each door joins: those just beyond its two faces. Others are dropped.

    So is a gap beside furniture that was taken for a wall, or a window: where doors of the survey show
    lintels, it shows none, nor a passage through both faces of a wall, and leads out of a region into none.
    """
    lintels = any("lintel" in d.evidence for d in doors)
    tree = shapely.STRtree([r.polygon for r in regions])
    linked = []
    for door in doors:
        sides = [_behind(door, sign, regions, tree) for sign in (-1, 1)]
        names = tuple(dict.fromkeys(s for s in sides if s))
        if len(names) == 1 and lintels and _is_bare(door):
            continue
        if names and (sides[0] != sides[1]):  # an opening inside one region separates nothing
            linked.append(replace(door, connects=names))
    mine = {r.id: tuple(d.id for d in linked if r.id in d.connects) for r in regions}
    return tuple(replace(r, doors=mine[r.id]) for r in regions), tuple(linked)


def _is_bare(door: Door) -> bool:
    """True for an aperture without a lintel that one face of what may be no wall shows, or no passage."""
    words = set(door.evidence)
    shown = "lintel" in words or {"passage", "both faces"} <= words
    return "open" in words and not door.by_hand and not shown


def _behind(door: Door, sign: int, regions: Sequence[Region], tree: shapely.STRtree) -> str:
    middle = (door.start + door.end) / 2
    for reach in _PROBES:
        u = door.offset + sign * (door.thickness / 2 + reach)
        at = door.in_plan(np.array([(u, middle) if door.axis == 0 else (middle, u)]))
        hit = tree.query(shapely.Point(at[0]), predicate="within")
        if len(hit):
            return regions[int(min(hit))].id
    return ""

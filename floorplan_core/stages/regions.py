"""Regions: connected unions of the chosen rectangles (paper, section "Layout Estimation").

In: the cover, planes, segments, doors and the grid. Out: disjoint regions with their sides. Rectangles that
overlap belong together; every rectangle is free of walls and doors, so their union is too. The sides then move
from the infinite planes to the surfaces that were seen along them, so that dimensions come from points. What is
left of an overlap between two regions goes to the one with more evidence. Cost: quadratic in the number of
rectangles of one neighbourhood, otherwise linear.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.config import RegionsConfig
from floorplan_core.geometry.raster import polygon_mask
from floorplan_core.geometry.rectilinear import corners, map_polygon, move_sides, open_polygon, polygons_of
from floorplan_core.model import (
    Door,
    Facing,
    LayoutPlane,
    LayoutSegment,
    OccupancyGrid,
    RectangleCover,
    Region,
    RegionSide,
)

Float = NDArray[np.float64]

_OVERLAP = 0.3  # m on both sides: less is a shared border, not an overlap
_PASSAGE = 0.6  # m of a shared border without wall or door, from which two rectangles are one region
_NEAR = 0.2  # m between a border and the wall that stands on it
_PROBES = (0.15, 0.3, 0.5)  # m from the wall's face, where the region behind a door is looked for


def build_regions(
    cover: RectangleCover, planes: Sequence[LayoutPlane], segments: Sequence[LayoutSegment], doors: Sequence[Door],
    grid: OccupancyGrid, config: RegionsConfig,
) -> tuple[Region, ...]:  # fmt: skip
    """The regions in reading order (top to bottom, left to right), without label or turning distance."""
    groups = connected_groups(cover.bounds, separators(planes, doors))
    shapes = [_union(cover.bounds[rows], bridges, config.sliver) for rows, bridges in groups]
    walls = _Surfaces(planes, segments)
    pieces: list[tuple[object, NDArray[np.int64]]] = []
    for shape, (rows, _) in zip(shapes, groups, strict=True):
        pieces += [
            (map_polygon(part, lambda ring: move_sides(ring, walls.target)), rows)
            for part in polygons_of(shape)
        ]
    regions = [
        _region(polygon, rows, walls, doors, grid) for polygon, rows in _disjoint(pieces, grid, config.sliver)
    ]
    kept = [r for r in regions if _acceptable(r, config)]
    kept.sort(
        key=lambda r: (-round(r.polygon.representative_point().y, 1), r.polygon.representative_point().x)
    )
    return tuple(replace(r, id=f"r{k + 1}", name=str(k + 1)) for k, r in enumerate(kept))


def separators(planes: Sequence[LayoutPlane], doors: Sequence[Door]) -> dict[int, Float]:
    """By axis of the normal: (K, 3) offset, start and end of everything that keeps two rectangles apart."""
    out = {}
    for axis in (0, 1):
        rows = [(p.offset, s, e) for p in planes if p.facing.axis == axis for s, e in p.walls]
        rows += [(d.offset, d.start, d.end) for d in doors if d.axis == axis]
        out[axis] = np.array(rows, dtype=np.float64).reshape(-1, 3)
    return out


def connected_groups(bounds: Float, walls: dict[int, Float]) -> list[tuple[NDArray[np.int64], Float]]:
    """Rectangles (C, 4) that belong together: they overlap, or share a border that is not all wall.

    Each group is its rows, and the boxes (K, 4) that join what a border of a few centimetres parts.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    if len(bounds) == 0:
        return []
    x0, y0, x1, y1 = bounds.T
    wide = np.minimum(x1[:, None], x1) - np.maximum(x0[:, None], x0)
    high = np.minimum(y1[:, None], y1) - np.maximum(y0[:, None], y0)
    linked = (wide > _OVERLAP) & (high > _OVERLAP)
    border = (np.minimum(wide, high) > -_OVERLAP) & (np.maximum(wide, high) > _PASSAGE) & ~linked
    bridges: dict[int, list[Float]] = {}
    for i, j in np.argwhere(np.triu(border, 1)):
        axis = 0 if wide[i, j] < high[i, j] else 1
        boxes = _open_border(bounds[i], bounds[j], axis, walls[axis])
        if boxes:
            linked[i, j] = linked[j, i] = True
            bridges.setdefault(int(i), []).extend(boxes)
    count, label = connected_components(csr_array(linked), directed=False)
    groups = [np.flatnonzero(label == k) for k in range(count)]
    return [(g, np.array([b for i in g for b in bridges.get(int(i), [])]).reshape(-1, 4)) for g in groups]


def _open_border(a: Float, b: Float, axis: int, walls: Float) -> list[Float]:
    """Boxes across the parts of the border of two rectangles that are neither wall nor door, if wide enough."""
    near = sorted((max(a[axis], b[axis]), min(a[axis + 2], b[axis + 2])))
    low, high = max(a[1 - axis], b[1 - axis]), min(a[3 - axis], b[3 - axis])
    hit = walls[(walls[:, 0] > near[0] - _NEAR) & (walls[:, 0] < near[1] + _NEAR)]
    at, boxes = low, []
    for start, end in [*sorted((float(s), float(e)) for _, s, e in hit), (high, high)]:
        if min(start, high) - at >= _PASSAGE:
            v0, v1 = at, min(start, high)
            boxes.append(np.array([near[0], v0, near[1], v1] if axis == 0 else [v0, near[0], v1, near[1]]))
        at = max(at, end)
    return boxes


def _union(bounds: Float, bridges: Float, sliver: float) -> object:
    """The union of one group and of the boxes that join it."""
    return open_polygon(shapely.union_all(shapely.box(*np.concatenate([bounds, bridges]).T)), sliver)


class _Surfaces:
    """The segments by facing, to look up what was seen along a side."""

    _REACH = 0.22  # m between a side and a surface that can be its own

    def __init__(self, planes: Sequence[LayoutPlane], segments: Sequence[LayoutSegment]) -> None:
        self._table = {}
        plane_of = {p.id: p for p in planes}
        for facing in Facing:
            mine = [s for s in segments if s.facing == facing and s.plane]
            data = np.array([[s.offset, s.start, s.end, s.area] for s in mine]).reshape(-1, 4)
            self._table[facing] = (data, [s.plane for s in mine])
        self._planes = plane_of

    @staticmethod
    def facing(a: Float, b: Float) -> Facing:
        """The facing of the surface along a side of a ring whose inside is at the left."""
        if abs(a[0] - b[0]) < abs(a[1] - b[1]):
            return Facing.WEST if b[1] > a[1] else Facing.EAST
        return Facing.NORTH if b[0] > a[0] else Facing.SOUTH

    def along(self, a: Float, b: Float) -> tuple[Float, list[str]]:
        """(K, 3) offset, start and end (clipped to the side) of the surfaces seen along it, and their planes."""
        data, planes = self._table[self.facing(a, b)]
        across = 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
        low, high = sorted((a[1 - across], b[1 - across]))
        start, end = np.maximum(data[:, 1], low), np.minimum(data[:, 2], high)
        near = (np.abs(data[:, 0] - a[across]) < self._REACH) & (end > start)
        k = np.flatnonzero(near)
        return np.column_stack([data[k, 0], start[k], end[k]]), [planes[i] for i in k]

    def target(self, a: Float, b: Float) -> float:
        """Where a side belongs: the median of the surfaces seen along it, by length; else where it is."""
        across = 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
        seen, _ = self.along(a, b)
        length = seen[:, 2] - seen[:, 1]
        if length.sum() < min(0.3, 0.3 * abs(a[1 - across] - b[1 - across])):
            return float(a[across])
        order = np.argsort(seen[:, 0], kind="stable")
        middle = np.searchsorted(np.cumsum(length[order]), 0.5 * length.sum())
        near = np.abs(seen[:, 0] - seen[order[middle], 0]) < 0.03
        return float(np.average(seen[near, 0], weights=length[near]))

    def plane(self, names: list[str], lengths: Float) -> str:
        """The plane that explains most of a side."""
        total: dict[str, float] = {}
        for name, length in zip(names, lengths, strict=True):
            total[name] = total.get(name, 0.0) + float(length)
        return max(total, key=lambda n: (total[n], n)) if total else ""


def _disjoint(
    pieces: list[tuple[object, NDArray[np.int64]]], grid: OccupancyGrid, sliver: float
) -> list[tuple[object, NDArray[np.int64]]]:
    """Cut the overlaps: what two regions share belongs to the one that saw more of its own area."""

    def seen(polygon: object) -> float:
        mask = polygon_mask(polygon, grid.origin, grid.cell, grid.states.shape)
        return float(grid.universe[mask].mean()) if mask.any() else 0.0

    out: list[tuple[object, NDArray[np.int64]]] = []
    taken = shapely.MultiPolygon()
    for polygon, rows in sorted(pieces, key=lambda p: (-round(seen(p[0]), 6), -p[0].area, p[0].bounds)):  # type: ignore[attr-defined]
        if not polygon.is_valid:  # type: ignore[attr-defined]
            polygon = shapely.make_valid(polygon)
        rest = (
            open_polygon(shapely.difference(polygon, taken), sliver) if taken.intersects(polygon) else polygon
        )
        rest = shapely.set_precision(rest, 1e-6)
        for part in polygons_of(rest):
            out.append((part, rows))
        taken = taken.union(rest)
    return out


def _region(
    polygon: object, rows: NDArray[np.int64], walls: _Surfaces, doors: Sequence[Door], grid: OccupancyGrid
) -> Region:
    polygon = shapely.orient_polygons(polygon)
    mask = polygon_mask(polygon, grid.origin, grid.cell, grid.states.shape)
    sides = tuple(
        _side(a, b, walls, doors, hole)
        for ring, hole in ((polygon.exterior, False), *((r, True) for r in polygon.interiors))  # type: ignore[attr-defined]
        for a, b in _edges(np.asarray(ring.coords))
    )
    length = sum(s.length for s in sides)
    walled = sum(s.length * s.observed for s in sides) / length if length else 0.0
    free, total = int(grid.universe[mask].sum()), int(mask.sum())
    confidence = round(0.5 * walled + 0.5 * (free / total if total else 0.0), 3)
    return Region(
        id="", name="", polygon=polygon, label="", free_cells=free, total_cells=total, turning_distance=0.0,
        sides=sides, confidence=confidence, rectangles=rows,
    )  # fmt: skip


def _edges(ring: Float) -> list[tuple[Float, Float]]:
    points = corners(ring)
    return [(points[k], points[(k + 1) % len(points)]) for k in range(len(points))]


def _side(a: Float, b: Float, walls: _Surfaces, doors: Sequence[Door], hole: bool) -> RegionSide:
    """A side with the share of its length along which wall, or a door in it, was seen."""
    across = 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
    low, high = sorted((float(a[1 - across]), float(b[1 - across])))
    seen, names = walls.along(a, b)
    spans = [(s, e) for _, s, e in seen]
    for door in doors:
        if door.axis == across and abs(door.offset - a[across]) < door.thickness / 2 + walls._REACH:
            spans.append((door.start, door.end))
    covered, at = 0.0, low
    for s, e in sorted(spans):
        s, e = max(s, at), min(e, high)
        if e > s:
            covered += e - s
            at = e
    plane = walls.plane(names, seen[:, 2] - seen[:, 1])
    start, end = (float(a[0]), float(a[1])), (float(b[0]), float(b[1]))
    return RegionSide(start, end, plane, round(min(1.0, covered / max(high - low, 1e-9)), 4), hole)


def _acceptable(region: Region, config: RegionsConfig) -> bool:
    """Large enough, and below the risk threshold: total cells a free cell."""
    risk = region.total_cells / region.free_cells if region.free_cells else np.inf
    return region.area >= config.min_area and risk <= config.risk


def connect_doors(
    regions: Sequence[Region], doors: Sequence[Door]
) -> tuple[tuple[Region, ...], tuple[Door, ...]]:
    """Which one or two regions each door joins: those just beyond its two faces. Others are dropped."""
    tree = shapely.STRtree([r.polygon for r in regions])
    linked = []
    for door in doors:
        sides = [_behind(door, sign, regions, tree) for sign in (-1, 1)]
        names = tuple(dict.fromkeys(s for s in sides if s))
        if names and (sides[0] != sides[1]):  # an opening inside one region separates nothing
            linked.append(replace(door, connects=names))
    mine = {r.id: tuple(d.id for d in linked if r.id in d.connects) for r in regions}
    return tuple(replace(r, doors=mine[r.id]) for r in regions), tuple(linked)


def _behind(door: Door, sign: int, regions: Sequence[Region], tree: shapely.STRtree) -> str:
    middle = (door.start + door.end) / 2
    for reach in _PROBES:
        u = door.offset + sign * (door.thickness / 2 + reach)
        hit = tree.query(shapely.Point((u, middle) if door.axis == 0 else (middle, u)), predicate="within")
        if len(hit):
            return regions[int(min(hit))].id
    return ""

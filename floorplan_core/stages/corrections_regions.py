"""Corrections of regions: split, merged, relabelled, renamed.

Shapes change between :func:`~floorplan_core.stages.regions.build_regions` and ``connect_doors``; labels and
names after the machine's own. Regions stay disjoint and rectilinear. Regions that are merged take the wall
between them in; it parts nothing any more, and a door in it is none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely

from floorplan_core.config import RegionsConfig
from floorplan_core.geometry.rectilinear import close_polygon, polygons_of, without_slits
from floorplan_core.model import Door, LayoutPlane, LayoutSegment, OccupancyGrid, Region
from floorplan_core.model.corrections import (
    Correction,
    LabelRegion,
    MergeRegions,
    NameRegion,
    Point,
    SplitRegion,
)
from floorplan_core.model.layout import turned
from floorplan_core.stages.corrections import NOTHING, REACH, Placed, Remarks, line_of, place, without
from floorplan_core.stages.region_names import ID_PREFIX, next_number
from floorplan_core.stages.region_sides import WallSurfaces
from floorplan_core.stages.regions import make_region

SHAPED = {"merged", "split"}  # words of a region whose shape is a person's
_THICKEST = 0.6  # m of wall between two regions that are merged
_SLIT = 0.02  # m: a narrower hole in a merged region is the jitter of its sides
_NECK = 2e-4  # m, half the width of what rounding to a tenth of a millimetre may close
_GRID = 1e-6  # m, to which coordinates are rounded after an overlay
_TOUCH = 0.01  # m: regions nearer than this touch
_INSIDE = 0.1  # m inside a merged region, from where a wall would part it

Regions = tuple[Region, ...]
Planes = tuple[LayoutPlane, ...]
Remake = Callable[[Any, Region], Region]  # another polygon for a region: its sides and counts follow
Close = Callable[[Any, float], Any]


@dataclass(frozen=True)
class Surroundings:
    """What a region is measured against."""

    planes: Planes
    segments: Sequence[LayoutSegment]
    doors: Sequence[Door]
    grid: OccupancyGrid


def correct_shapes(
    regions: Regions, corrections: Sequence[Correction], around: Surroundings, config: RegionsConfig
) -> tuple[Regions, Planes, Remarks]:
    """Regions and planes after ``corrections`` (manhattan frame), one after the other."""
    if not corrections:
        return regions, around.planes, NOTHING
    walls, said, planes = WallSurfaces(around.planes, around.segments), NOTHING, around.planes

    def remake(polygon: Any, region: Region) -> Region:
        made = make_region(polygon, _rows(region), walls, around.doors, around.grid)
        return replace(made, id=region.id, name=region.name, by_hand=region.by_hand)

    for correction in corrections:
        if isinstance(correction, MergeRegions):
            regions, taken, remarks = merge(regions, correction, remake)
            planes = planes if taken is None else opened(planes, taken)
        else:
            assert isinstance(correction, SplitRegion)
            regions, remarks = split(regions, correction, config.min_area, remake)
        said += remarks
    return regions, planes, said


def _rows(region: Region) -> np.ndarray[Any, Any]:
    return np.zeros(0, dtype=np.int64) if region.rectangles is None else region.rectangles


def find_region(regions: Sequence[Region], at: Point) -> Region | None:
    """The region that a point lies in, or else the nearest within reach; None where there is none."""
    near = [(r.polygon.distance(shapely.Point(at)), k, r) for k, r in enumerate(regions)]
    best = min(near, key=lambda n: n[:2], default=None)
    return best[2] if best is not None and best[0] <= REACH else None


def merge(
    regions: Regions,
    correction: MergeRegions,
    remake: Remake,
    close: Close = close_polygon,
    tidy: Close = without_slits,
) -> tuple[Regions, Any | None, Remarks]:
    """The regions with some made one, and the polygon of that one.

    :param close: fills the gaps between polygons that are narrower than so many metres.
    :param tidy: the merged one without holes narrower than so many metres.
    """
    found = [find_region(regions, at) for at in correction.at]
    if None in found:
        lost = correction.at[found.index(None)]
        text = f"The region at {place(lost)}, merged with others, is gone."
        return regions, None, Remarks(warnings=(Placed(text, lost),))
    chosen = {r.id: r for r in found if r is not None}
    if len(chosen) < 2:
        return regions, None, NOTHING  # they are one already
    parts = [r for r in regions if r.id in chosen]
    others = [r.polygon for r in regions if r.id not in chosen]
    whole = _union([r.polygon for r in parts], others, close, tidy)
    if whole is None:
        names = " and ".join(r.name for r in parts)
        return regions, None, Remarks(warnings=(f"Regions {names} do not touch: they cannot be merged.",))
    first = max(parts, key=lambda r: r.area)
    rows = np.unique(np.concatenate([_rows(r) for r in parts]))
    merged = remake(whole, replace(first, rectangles=rows, by_hand=_with("merged", *parts)))
    return tuple(merged if r is first else r for r in regions if r is first or r not in parts), whole, NOTHING


def _with(word: str, *regions: Region) -> tuple[str, ...]:
    """The words of the regions and one more."""
    return tuple(dict.fromkeys((*(w for r in regions for w in r.by_hand), word)))


def _union(parts: Sequence[Any], others: Sequence[Any], close: Close, tidy: Close) -> Any | None:
    """One polygon of the parts and the wall between them; None where they do not touch."""
    inside = shapely.union_all([close(p, _THICKEST) for p in parts])
    between = close(shapely.union_all(parts), _THICKEST).difference(
        shapely.union_all([inside, *others], grid_size=_GRID), grid_size=_GRID
    )
    joints = [g for g in polygons_of(between) if sum(g.distance(p) < _TOUCH for p in parts) > 1]
    whole = without_necks(tidy(shapely.union_all([*parts, *joints], grid_size=_GRID), _SLIT))
    taken = [o for o in others if o.intersection(whole).area > _GRID]  # a slit may have been another's edge
    if taken:
        whole = max(polygons_of(whole.difference(shapely.union_all(taken), grid_size=_GRID)), key=_area)
    return whole if whole.geom_type == "Polygon" else None


def without_necks(shape: Any) -> Any:
    """The largest part of a polygon, parted where it is so narrow that rounding would make it touch itself;
    the polygon itself where it is nowhere so narrow."""
    wide = shape.buffer(-_NECK, join_style="mitre").buffer(_NECK, join_style="mitre")
    parts = polygons_of(shapely.set_precision(wide, _GRID))
    if not parts or (len(parts) == 1 and len(parts[0].interiors) == sum(map(_holes, polygons_of(shape)))):
        return shape
    return parts[0]


def _holes(shape: Any) -> int:
    return len(shape.interiors)


def _area(shape: Any) -> float:
    return float(shape.area)


def opened(planes: Planes, merged: Any) -> Planes:
    """The planes without their walls inside a merged region."""
    core = merged.buffer(-_INSIDE, join_style="mitre")
    return tuple(_without_inside(p, core) for p in planes)


def _without_inside(plane: LayoutPlane, core: Any) -> LayoutPlane:
    walls, along = plane.walls, 1 - plane.facing.axis
    for start, end in plane.walls:
        ends = [(plane.offset, start), (plane.offset, end)]
        line = shapely.LineString(ends if along == 1 else [e[::-1] for e in ends])
        for piece in shapely.get_parts(line.intersection(core)):
            if piece.length > 0:
                low, high = piece.bounds[along], piece.bounds[along + 2]
                walls = without(walls, (low - _INSIDE, high + _INSIDE))
    return plane if walls is plane.walls else replace(plane, walls=walls)


def split(
    regions: Regions, correction: SplitRegion, least: float, remake: Remake, turn: float = 0.0
) -> tuple[Regions, Remarks]:
    """The regions with one of them cut along a line, from side to side.

    :param least: m2 of each part.
    :param turn: radians from the plan's axes to those that the line is drawn along.
    """
    where = place(correction.start)
    drawn = shapely.LineString([correction.start, correction.end])
    crossed = [(drawn.intersection(r.polygon).length, -k) for k, r in enumerate(regions)]
    longest, k = max(crossed, default=(0.0, 0))
    if longest <= 0:
        text = f"The line drawn at {where} splits no region."
        return regions, Remarks(warnings=(Placed(text, correction.start),))
    region = regions[-k]
    parts = _cut(region.polygon, correction, turn)
    if len(parts) < 2 or min(p.area for p in parts) < least:
        problem = f"The line drawn at {where} does not part region {region.name} in two of {least:g} m2."
        return regions, Remarks(warnings=(Placed(problem, correction.start),))
    return _parted(regions, region, parts, remake), NOTHING


def _parted(regions: Regions, region: Region, parts: Sequence[Any], remake: Remake) -> Regions:
    """The largest part goes on as the region; the others are new."""
    ordered = sorted(parts, key=lambda p: (-round(p.area, 6), p.bounds))
    number, by_hand = next_number(regions), _with("split", region)
    names = [(region.id, region.name)]
    names += [(f"{ID_PREFIX}{number + k}", str(number + k)) for k in range(len(parts) - 1)]
    new = [
        remake(polygon, replace(region, id=ident, name=name, by_hand=by_hand))
        for polygon, (ident, name) in zip(ordered, names, strict=True)
    ]
    at = regions.index(region)
    return (*regions[:at], *new, *regions[at + 1 :])


def _cut(polygon: Any, line: SplitRegion, turn: float) -> list[Any]:
    """The parts of a polygon on the sides of the chords that a drawn line lies on."""
    from shapely.ops import split as split_by

    pieces = [polygon]
    (x0, y0), (x1, y1) = turned(np.array([line.start, line.end]), -turn).tolist()
    for chord in _chords(polygon if turn == 0.0 else _turned(polygon, -turn), (x0, y0), (x1, y1)):
        a, b = turned(shapely.get_coordinates(chord), turn)
        step = _GRID * 10 * (b - a) / np.linalg.norm(b - a)  # beyond the sides, so that it surely crosses
        cutter = shapely.LineString([a - step, b + step])
        pieces = [q for p in pieces for q in split_by(p, cutter).geoms]
    return [without_necks(shapely.set_precision(p, _GRID)) for p in pieces]


def _turned(shape: Any, turn: float) -> Any:
    return shapely.transform(shape, lambda xy: turned(xy, turn))


def _chords(polygon: Any, start: Point, end: Point) -> list[Any]:
    """From side to side of a polygon, along the axis-parallel line that two clicks mean."""
    axis, offset, (low, high) = line_of(start, end)
    along = 1 - axis
    x0, y0, x1, y1 = polygon.bounds
    ends = [(offset, y0 - 1), (offset, y1 + 1)] if axis == 0 else [(x0 - 1, offset), (x1 + 1, offset)]
    return [
        c
        for c in shapely.get_parts(polygon.intersection(shapely.LineString(ends)))
        if c.length > 0 and min(c.bounds[along + 2], high) - max(c.bounds[along], low) > 0
    ]


def correct_names(regions: Regions, corrections: Sequence[Correction]) -> tuple[Regions, Remarks]:
    """The regions with the labels and names that a person gave, after the machine's own."""
    said = NOTHING
    for correction in corrections:
        assert isinstance(correction, LabelRegion | NameRegion)
        found = find_region(regions, correction.at)
        if found is None:
            where = place(correction.at)
            said += Remarks(warnings=(f"The region at {where}, labelled or named by hand, is gone.",))
        elif isinstance(correction, LabelRegion):
            changed = replace(found, label=correction.label, by_hand=_with("label", found))
            regions = tuple(changed if r is found else r for r in regions)
            said += _machine_said(found, "label", found.label)
        else:
            regions = _renamed(regions, found, correction.name)
            said += _machine_said(found, "name", found.name)
    return regions, said


def _machine_said(region: Region, word: str, text: str) -> Remarks:
    return NOTHING if word in region.by_hand else Remarks(((region.id, f"{word} {text}"),))


def _renamed(regions: Regions, region: Region, name: str) -> Regions:
    """One region with another name; who had that name before gets the next number."""
    free = str(next_number(regions))
    out = []
    for r in regions:
        if r is region:
            out.append(replace(r, name=name, by_hand=_with("name", r)))
        else:
            out.append(replace(r, name=free) if r.name == name else r)
    return tuple(out)

"""plan.geojson: the plan for other programs. The names of features and properties are a contract.

Coordinates are metres of the input's world frame with 0.1 mm resolution; lengths and areas are those of the
plan before rounding. Regions stay disjoint after rounding (see :mod:`floorplan_core.exporters.coverage`).
The same plan always gives the same bytes.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.exporters.coverage import matched, rounded
from floorplan_core.model import (
    Door,
    FloorPlan,
    LayoutPlane,
    LayoutSegment,
    Region,
    RegionSide,
    Wing,
    loa_band,
)

Float = NDArray[np.float64]
Json = dict[str, Any]

DECIMALS = 4  # metres: 0.1 mm
MATRIX_DECIMALS = 12
_ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)
TOGETHER = 100  # regions whose predicted space is written at once
INSET = 2e-4  # metres: predicted space keeps this far inside its region, more than rounding can move it


class GeoJsonExporter:
    """Writes ``plan.geojson``."""

    name = "GeoJSON"
    suffixes: tuple[str, ...] = (".geojson", ".json")
    description = "Regions, doors, planes, segments and predicted space for GIS, scripts and robots."

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write ``plan`` to ``path`` as UTF-8, one feature a line."""
        with path.open("w", encoding="utf-8", newline="\n") as file:
            file.writelines(_text(plan))


def geojson_text(plan: FloorPlan) -> str:
    """The file's text: the head, then one line for each feature, so that versions can be compared by line."""
    return "".join(_text(plan))


def _text(plan: FloorPlan) -> Iterator[str]:
    """The same piece by piece: what is predicted of a large site takes a gigabyte as Python's values."""
    polygons = _outlines(plan)
    yield f'{{"type": "FeatureCollection",\n"floorcast": {_dump(_head(plan))},\n"features": [\n'
    for feature in _seen(plan, polygons):
        yield f"{_dump(feature)},\n"
    first, last = _dump(_feature("speculated", _multipolygon([]), {})).split("[]", 1)
    yield f"{first}["
    area, begun = 0.0, False
    for predicted, own in _speculated(plan, polygons):
        yield (", " if begun and predicted else "") + _dump(_rings(predicted))[1:-1]
        area, begun = area + own, begun or bool(predicted)
    yield f"]{last.replace('{}', _dump(_predicted(area)))}\n]}}\n"


def plan_to_geojson(plan: FloorPlan) -> Json:
    """The plan as a FeatureCollection of plain Python values."""
    polygons = _outlines(plan)
    parts = list(_speculated(plan, polygons))
    rings = [ring for predicted, _ in parts for ring in _rings(predicted)]
    last = _feature("speculated", _multipolygon(rings), _predicted(sum(own for _, own in parts)))
    return {"type": "FeatureCollection", "floorcast": _head(plan), "features": [*_seen(plan, polygons), last]}


def _outlines(plan: FloorPlan) -> list[Any]:
    return matched([r.polygon for r in plan.regions]) if plan.regions else []


def _multipolygon(coordinates: list[Any]) -> Json:
    return {"type": "MultiPolygon", "coordinates": coordinates}


def _seen(plan: FloorPlan, polygons: list[Any]) -> list[Json]:
    """All features but that of what is predicted."""
    features = _regions(plan, polygons)
    features += [_door(plan, door) for door in plan.doors]
    planes = [plane for plane in plan.planes if plane.by_hand != "hidden"]
    extent = plan.bounds
    ends = [_clipped(plane, extent) for plane in planes] + [s.line() for s in plan.segments]
    lines = _lines(plan, ends)
    features += [_plane(plane, line) for plane, line in zip(planes, lines, strict=False)]
    features += [_segment(s, line) for s, line in zip(plan.segments, lines[len(planes) :], strict=True)]
    for number, wing in enumerate(plan.wings, start=1):
        features += _of_wing(plan, wing, number)
    return features


def _dump(value: Any) -> str:
    return _ENCODER.encode(value)


def _head(plan: FloorPlan) -> Json:
    from floorplan_core import __version__

    return {
        "version": __version__,
        "units": "metre",
        "frame": "world",
        "manhattan_from_world": _clean(plan.manhattan_from_world, MATRIX_DECIMALS).tolist(),
        "slice_height_m": _metres(plan.grid.slice_height),
        "storey": plan.storey,
        "source": plan.source,
        "frame_support": _metres(plan.frame.support),
        "askew_share": _metres(plan.frame.askew),
        "floor_z_m": _floor(plan, 0.0),
        **({"wings": [_wing_head(plan, wing) for wing in plan.wings]} if plan.wings else {}),
    }


def _wing_head(plan: FloorPlan, wing: Wing) -> Json:
    """How a wing's own axes lie; its planes count their offsets along them."""
    T = np.eye(4)
    T[:2, :2] = wing.to_plan(np.eye(2))
    return {
        "turn_deg": _metres(math.degrees(wing.turn)),
        "wing_from_world": _clean(T @ plan.manhattan_from_world, MATRIX_DECIMALS).tolist(),
    }


def _floor(plan: FloorPlan, rise: float) -> float:
    return _metres(plan.frame.floor_z + rise + float(plan.local_frame.shift[2]))


def _regions(plan: FloorPlan, polygons: list[Any]) -> list[Json]:
    """The regions with their outlines and sides, all of whose points are placed at once."""
    outlines = _rings(rounded(polygons, plan.to_world, DECIMALS)) if polygons else []
    sides = [side for region in plan.regions for side in region.sides]
    ends = iter(_points(plan, np.array([(side.start, side.end) for side in sides]).reshape(-1, 2)))
    made = [
        _region(region, outline, [_side(side, [next(ends), next(ends)]) for side in region.sides])
        for region, outline in zip(plan.regions, outlines, strict=True)
    ]
    for region, feature in zip(plan.regions, made, strict=True):
        feature["properties"] |= {"floor_z_m": _floor(plan, region.rise)} if region.rise else {}
    return made


def _region(region: Region, outline: list[list[list[float]]], sides: list[Json]) -> Json:
    properties = {
        "kind": "region",
        "name": region.name,
        "label": region.label,
        "area_m2": _metres(region.area),
        "perimeter_m": _metres(region.perimeter),
        "turning_distance": _metres(region.turning_distance),
        "free_cells": int(region.free_cells),
        "total_cells": int(region.total_cells),
        "speculated_fraction": _metres(region.speculated_fraction),
        "speculated_sides": sum(side.speculated for side in region.sides),
        "doors": list(region.doors),
        "confidence": _metres(region.confidence),
        "sides": sides,
    }
    properties |= {} if region.height is None else {"height_m": _metres(region.height)}
    properties |= _corrected(region)
    return _feature(region.id, {"type": "Polygon", "coordinates": outline}, properties)


def _side(side: RegionSide, ends: list[list[float]]) -> Json:
    return {
        "from_to": ends,
        "length_m": _metres(side.length),
        "plane": side.plane,
        "observed": _metres(side.observed),
        "speculated": bool(side.speculated),
        "residual_m": None if side.residual is None else _metres(side.residual),
        "loa": loa_band(side.residual),
    }


def _door(plan: FloorPlan, door: Door) -> Json:
    properties = {
        "kind": "door",
        "door_kind": door.kind,
        "width_m": _metres(door.width),
        "connects": list(door.connects),
        "confidence": _metres(door.confidence),
        "evidence": list(door.evidence),
        "thickness_m": _metres(door.thickness),
        "planes": list(door.planes),
    }
    properties |= {} if door.height is None else {"height_m": _metres(door.height)}
    properties |= {"shut": True} if door.shut else {}
    properties |= _corrected(door)
    return _feature(door.id, _line(plan, door.line()), properties)


def _clipped(plane: LayoutPlane, extent: tuple[float, float, float, float]) -> Float:
    """(2, 2) ends of the plane's line within x0, y0, x1, y1; manhattan frame."""
    (x0, y0, x1, y1), o = extent, plane.offset
    return np.array([[o, y0], [o, y1]] if plane.facing.axis == 0 else [[x0, o], [x1, o]])


def _plane(plane: LayoutPlane, line: Json) -> Json:
    properties = {
        "kind": "layout_plane",
        "facing": plane.facing.name.lower(),
        "offset_m": _metres(plane.offset),
        "support_m2": _metres(plane.support),
        "residual_m": _metres(plane.residual),
        "loa": loa_band(plane.residual if plane.support > 0 else None),
        "segments": list(plane.segments),
        "speculated": bool(plane.speculated),
        **_corrected(plane),
    }
    return _feature(plane.id, line, properties)


def _of_wing(plan: FloorPlan, wing: Wing, number: int) -> list[Json]:
    """Planes and segments of a wing: their ``frame`` is its number; those of the plan's frame have none."""
    if not wing.segments:
        return []
    drawn = np.concatenate([s.line() for s in wing.segments])
    (x0, y0), (x1, y1) = drawn.min(axis=0).tolist(), drawn.max(axis=0).tolist()
    ends = [_clipped(p, (x0, y0, x1, y1)) for p in wing.planes] + [s.line() for s in wing.segments]
    lines = _lines(plan, [wing.to_plan(e) for e in ends])
    count = len(wing.planes)
    features = [_plane(p, line) for p, line in zip(wing.planes, lines[:count], strict=True)]
    features += [_segment(s, line) for s, line in zip(wing.segments, lines[count:], strict=True)]
    for feature in features:
        feature["properties"]["frame"] = number
    return features


def _corrected(thing: Region | Door | LayoutPlane) -> Json:
    """Present only where a person changed the thing."""
    return {"corrected": True} if thing.by_hand else {}


def _segment(segment: LayoutSegment, line: Json) -> Json:
    properties = {
        "kind": "layout_segment",
        "plane": segment.plane,
        "height_range_m": [_metres(segment.z_min), _metres(segment.z_max)],
        "facing": segment.facing.name.lower(),
        "structural": bool(segment.structural),
        "residual_m": _metres(segment.residual),
        "evidence": list(segment.evidence),
    }
    return _feature(segment.id, line, properties)


def _predicted(area: float) -> Json:
    return {"kind": "speculated", "area_m2": _metres(area)}


def _speculated(plan: FloorPlan, polygons: list[Any]) -> Iterator[tuple[list[Any], float]]:
    """Predicted space, clipped to just inside the regions, so that no rounding lets it out: polygons and m2.

    Piece by piece, by region: the intersection of all with all takes the square of how many there are. Some
    regions at a time: there are hundreds of pieces in each.
    """
    inside = shapely.buffer(np.array(polygons, dtype=object), -INSET, join_style="mitre")
    tree = shapely.STRtree(shapely.get_parts(plan.speculated()))
    for first in range(0, len(inside), TOGETHER):
        some = inside[first : first + TOGETHER]
        region, piece = tree.query(some, predicate="intersects")
        order = np.lexsort((piece, region))
        both = shapely.intersection(tree.geometries[piece[order]], some[region[order]])
        clipped = _only_polygons(both)
        area = shapely.area(clipped)
        yield _whole(rounded(clipped[area > INSET], plan.to_world, DECIMALS)), sum(area.tolist())


def _whole(polygons: list[Any]) -> list[Any]:
    """The polygons, valid ones in place of those that rounding has broken."""
    valid = shapely.is_valid(np.array(polygons, dtype=object)).tolist()
    return [
        q
        for p, fine in zip(polygons, valid, strict=True)
        for q in ([p] if fine else _only_polygons(shapely.make_valid(p)).tolist())
    ]


def _only_polygons(geometry: Any) -> NDArray[np.object_]:
    """The polygons of a geometry; points and lines, left over by clipping, are dropped."""
    parts = shapely.get_parts(geometry)
    return np.asarray(parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON])


def _feature(ident: str, geometry: Json, properties: Json) -> Json:
    return {"type": "Feature", "id": ident, "geometry": geometry, "properties": properties}


def _rings(polygons: list[Any]) -> list[list[list[list[float]]]]:
    """GeoJSON rings of polygons that are already rounded: counter-clockwise shells, clockwise holes."""
    oriented = shapely.orient_polygons(np.array(polygons, dtype=object))
    rings, owner = shapely.get_rings(oriented, return_index=True)
    points = _clean(shapely.get_coordinates(rings), DECIMALS).tolist()
    out: list[list[list[list[float]]]] = [[] for _ in polygons]
    ends = np.cumsum(shapely.get_num_coordinates(rings)).tolist()
    for start, end, k in zip([0, *ends], ends, owner.tolist(), strict=False):
        out[k].append(points[start:end])
    return out


def _line(plan: FloorPlan, ends: Float) -> Json:
    return {"type": "LineString", "coordinates": _points(plan, ends)}


def _lines(plan: FloorPlan, ends: list[Float]) -> list[Json]:
    """Many lines at once."""
    points = _points(plan, np.concatenate(ends)) if ends else []
    pairs = zip(points[::2], points[1::2], strict=True)
    return [{"type": "LineString", "coordinates": list(pair)} for pair in pairs]


def _points(plan: FloorPlan, points: Float) -> list[list[float]]:
    moved: list[list[float]] = _clean(plan.to_world(points), DECIMALS).tolist()
    return moved


def _clean(values: Float, decimals: int) -> Float:
    """Rounded, without negative zeros, which would make equal plans differ in bytes."""
    return np.round(values, decimals) + 0.0


def _metres(value: float) -> float:
    return round(float(value), DECIMALS) + 0.0

"""Ground truth from two horizontal sections of a wall model: one at body height, one above the lintels.

Rooms are given as outlines on a 4 cm raster; where the upper section closes around a room its exact face
replaces the outline, elsewhere the outline's sides are moved onto the section lines. A doorway is where the
upper section has both faces of a wall and the lower one has neither; it is as wide as the clear opening,
between the frames that the lower section shows in it, since that is what a laser meter measures there.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from floorplan_core.evaluation.truth import Float, Truth, TruthDoor, TruthRoom, room_dimensions

GRID = 0.001  # m, end points of sections that lie this near to each other are one
RASTER = 0.06  # m, an outline on a 4 cm raster is this far from its wall at most
SAME_FACE = 0.95  # intersection over union of a room's outline and its exact face
WALL_THICKNESS = (0.04, 0.5)  # m, between the two faces of one wall
DOORWAY = (0.55, 2.4)  # m; wider gaps below a lintel are windows or passages
FRAME = 0.1  # m, from an end of the wall to the frame's inner face at most
CORRIDOR_DOORS = 5  # a space onto which so many doorways open is circulation; the source has no labels
AXIS_TOLERANCE = 0.005  # m, a section line is parallel to an axis when its ends differ by less
SAME_LINE = 0.012  # m, lines of the two sections this near to each other are one face
ROOM_REACH = 0.1  # m, a doorway's box lies this near to the rooms that it joins
Gap = tuple[float, float, float]  # coordinate of the face, start, end


def parse_wall_sections(document: dict[str, Any], source: str) -> Truth:
    """Rooms, doorways and derived dimensions of a wall model."""
    high, low = (_segments(document[key]) for key in ("wall_segments_high", "wall_segments_low"))
    faces = section_faces(high)
    outlines = [_outline(r) for r in document["rooms"]]
    polygons = [exact_polygon(o, faces, high) for o in outlines]
    polygons = [_without_others(i, polygons, faces) for i in range(len(polygons))]
    doors = tuple(_joined(d, polygons) for axis in (0, 1) for d in doorways(high, low, axis))
    rooms = tuple(
        _room(i, r, p, doors) for i, (r, p) in enumerate(zip(document["rooms"], polygons, strict=True))
    )
    return Truth(source, rooms, doors, room_dimensions(rooms), wall=WALL_THICKNESS[1])


def _segments(values: Any) -> Float:
    """(N, 2, 2) end points."""
    lines = np.array(values, dtype=np.float64).reshape(-1, 2, 2)
    if not len(lines) or not np.all(np.isfinite(lines)):
        raise ValueError("a wall section is empty or not finite")
    return _met(lines)


def _met(lines: Float) -> Float:
    """The lines with end points that are nearly equal made equal, so that outlines close."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    points = lines.reshape(-1, 2)
    pairs = cKDTree(points).query_pairs(GRID, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(points), len(points)))
    _, place = connected_components(links, directed=False)
    means = [np.bincount(place, points[:, axis]) / np.bincount(place) for axis in (0, 1)]
    return np.asarray(np.stack(means, axis=1)[place].reshape(-1, 2, 2))


def _outline(room: dict[str, Any]) -> Any:
    from floorplan_core.evaluation.truths import polygon

    return polygon(room["polygon"])


def section_faces(lines: Float) -> list[Any]:
    """Every polygon that the section encloses: rooms and the solid of walls alike."""
    import shapely

    noded = shapely.union_all(shapely.set_precision(shapely.linestrings(lines), GRID), grid_size=GRID)
    faces = shapely.get_parts(
        shapely.polygonize([noded] if noded.geom_type == "LineString" else list(noded.geoms))
    )
    return [face for face in faces if face.area > GRID]


def exact_polygon(outline: Any, faces: list[Any], lines: Float) -> Any:
    """The face that the outline stands for; where none closes, the outline moved onto the section."""
    overlap = [f.intersection(outline).area / f.union(outline).area for f in faces]
    if overlap and max(overlap) >= SAME_FACE:
        return faces[int(np.argmax(overlap))]
    return snap_outline(outline.simplify(RASTER), lines)


def snap_outline(outline: Any, lines: Float) -> Any:
    """Move the axis-parallel sides of ``outline`` onto section lines within ``RASTER``; corners follow."""
    import shapely

    points = np.array(outline.exterior.coords[:-1])
    moved = points.copy()
    for i in range(len(points)):
        j = (i + 1) % len(points)
        for axis in (0, 1):
            if (
                abs(points[i, axis] - points[j, axis])
                <= RASTER
                < abs(points[i, 1 - axis] - points[j, 1 - axis])
            ):
                side = np.sort([points[i, 1 - axis], points[j, 1 - axis]])
                middle = 0.5 * (points[i, axis] + points[j, axis])
                moved[[i, j], axis] = _nearest_line(lines, axis, middle, (side[0], side[1]))
    snapped = shapely.Polygon(moved)
    return snapped if snapped.is_valid else outline


def _nearest_line(lines: Float, axis: int, value: float, side: tuple[float, float]) -> float:
    """Coordinate of the nearest parallel section line along ``side``; ``value`` where there is none."""
    parallel = np.abs(lines[:, 0, axis] - lines[:, 1, axis]) < AXIS_TOLERANCE
    start, end = lines[:, :, 1 - axis].min(axis=1), lines[:, :, 1 - axis].max(axis=1)
    along = np.minimum(end, side[1]) - np.maximum(start, side[0]) > 0
    near = np.abs(lines[:, 0, axis] - value) <= RASTER
    found = lines[parallel & along & near, 0, axis]
    return float(found[np.argmin(np.abs(found - value))]) if len(found) else value


def _without_others(index: int, polygons: list[Any], faces: list[Any]) -> Any:
    """An outline that runs around islands loses them: other rooms, and the solid of their walls."""
    import shapely

    own = polygons[index]
    solid = [f for f in faces if f.intersection(own).area < SAME_FACE * own.area and f.intersects(own)]
    inner = [p for i, p in enumerate(polygons) if i != index and p.area < own.area]
    rest = own.difference(shapely.union_all([*solid, *inner]))
    rest = rest.buffer(-RASTER, join_style="mitre").buffer(RASTER, join_style="mitre")
    parts = shapely.get_parts(rest)
    return max(parts, key=lambda part: part.area) if len(parts) else own


def doorways(high: Float, low: Float, axis: int) -> list[TruthDoor]:
    """Openings in walls with their normal along ``axis``: gaps of the lower section under both faces."""
    gaps = sorted(_gaps(high, low, axis))
    used: set[int] = set()
    found = []
    for i, (a, start, end) in enumerate(gaps):
        partner = next(
            (j for j in range(i + 1, len(gaps)) if j not in used and _one_wall(gaps[i], gaps[j])), None
        )
        if i in used or partner is None:
            continue
        used.update((i, partner))
        b, other_start, other_end = gaps[partner]
        span = max(start, other_start), min(end, other_end)
        found.append(_doorway(axis, (a, b), _clear(low, axis, (a, b), span)))
    return [d for d in found if DOORWAY[0] <= d.width]


def _clear(
    low: Float, axis: int, faces: tuple[float, float], span: tuple[float, float]
) -> tuple[float, float]:
    """``span`` less the frames at its ends: lines of the lower section across the wall, between its faces."""
    across = np.abs(low[:, 0, 1 - axis] - low[:, 1, 1 - axis]) < AXIS_TOLERANCE
    start, end = low[:, :, axis].min(axis=1), low[:, :, axis].max(axis=1)
    at = low[across & (start < faces[1]) & (end > faces[0]), :, 1 - axis].mean(axis=1)
    return (
        max([span[0], *at[(at > span[0]) & (at < span[0] + FRAME)].tolist()]),
        min([span[1], *at[(at < span[1]) & (at > span[1] - FRAME)].tolist()]),
    )


def _doorway(axis: int, faces: tuple[float, float], span: tuple[float, float]) -> TruthDoor:
    box = (faces[0], span[0], faces[1], span[1]) if axis == 0 else (span[0], faces[0], span[1], faces[1])
    kind = "door" if span[1] - span[0] <= DOORWAY[1] else "opening"
    return TruthDoor(box, axis, kind, required=False)


def _one_wall(first: Gap, second: Gap) -> bool:
    thick = WALL_THICKNESS[0] <= second[0] - first[0] <= WALL_THICKNESS[1]
    shared = min(first[2], second[2]) - max(first[1], second[1])
    return thick and shared >= 0.8 * max(first[2] - first[1], second[2] - second[1])


def _gaps(high: Float, low: Float, axis: int) -> list[Gap]:
    """Runs along each face line that the upper section has and the lower one has not."""
    lintels, walls = _runs(high, axis), _runs(low, axis)
    found = []
    for at, spans in lintels:
        solid = [s for other, runs in walls if abs(other - at) <= SAME_LINE for s in runs]
        for start, end in _subtract(_union(spans), _union(solid)):
            if end - start >= DOORWAY[0]:
                found.append((at, start, end))
    return found


def _runs(lines: Float, axis: int) -> list[tuple[float, list[tuple[float, float]]]]:
    """Spans of the axis-parallel lines, gathered by coordinate (the model's faces slope by millimetres)."""
    parallel = lines[np.abs(lines[:, 0, axis] - lines[:, 1, axis]) < AXIS_TOLERANCE]
    at = parallel[:, :, axis].mean(axis=1)
    order = np.lexsort((parallel[:, 0, 1 - axis], at))
    groups = np.split(order, np.flatnonzero(np.diff(at[order]) > AXIS_TOLERANCE) + 1)
    return [(float(at[g].mean()), [_span(parallel[i, :, 1 - axis]) for i in g]) for g in groups if len(g)]


def _span(values: Float) -> tuple[float, float]:
    return float(values.min()), float(values.max())


def _union(spans: list[tuple[float, float]]) -> list[tuple[float, float]]:
    merged: list[tuple[float, float]] = []
    for start, end in sorted(spans):
        if merged and start <= merged[-1][1] + GRID:
            merged[-1] = merged[-1][0], max(end, merged[-1][1])
        else:
            merged.append((start, end))
    return merged


def _subtract(
    spans: list[tuple[float, float]], holes: list[tuple[float, float]]
) -> list[tuple[float, float]]:
    left = []
    for start, end in spans:
        for a, b in holes:
            if b <= start or a >= end:
                continue
            if a > start:
                left.append((start, a))
            start = max(start, b)
        if end > start:
            left.append((start, end))
    return left


def _joined(door: TruthDoor, polygons: list[Any]) -> TruthDoor:
    """The doorway with its rooms; only doors between two rooms are required of a plan."""
    import shapely

    box = shapely.box(*door.bounds)
    joins = tuple(i for i, p in enumerate(polygons) if p.distance(box) <= ROOM_REACH)
    required = door.kind == "door" and len(joins) == 2
    return TruthDoor(door.bounds, door.axis, door.kind, required, joins)


def _kind(index: int, doors: tuple[TruthDoor, ...]) -> str:
    onto = sum(index in d.joins for d in doors if d.required)
    return "corridor" if onto >= CORRIDOR_DOORS else "room"


def _room(index: int, entry: dict[str, Any], polygon: Any, doors: tuple[TruthDoor, ...]) -> TruthRoom:
    """A room onto which nothing opens can neither be entered nor seen."""
    reachable = any(index in door.joins for door in doors)
    return TruthRoom(str(entry["id"]), polygon, _kind(index, doors), reachable, None if reachable else 0.0)

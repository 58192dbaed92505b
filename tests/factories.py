"""Synthetic floor plans for tests: rooms and doors by hand, everything else derived from them.

Coordinates are those of the building (the manhattan frame); ``yaw_deg`` and ``shift`` place it in the world.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from floorplan_core.config import Config
from floorplan_core.geometry.raster import polygon_mask
from floorplan_core.model import (
    FREE,
    OCCUPIED,
    UNOBSERVED,
    CandidateSet,
    Door,
    Facing,
    FloorPlan,
    LayoutPlane,
    LayoutSegment,
    LocalFrame,
    ManhattanFrame,
    OccupancyGrid,
    RectangleCover,
    Region,
    RegionSide,
    WallPoints,
)

WALL = 0.15
HEIGHT = 2.6
CELL = 0.1


@dataclass(frozen=True)
class RoomSpec:
    """One region: a box (x0, y0, x1, y1) or a ring of corners, and how much of it was seen."""

    shape: tuple[float, float, float, float] | Sequence[tuple[float, float]]
    label: str = "room"
    seen: float = 1.0  # share of its depth, from its first side, that is known free
    guessed: frozenset[str] = frozenset()  # facings ("east", ...) of the sides that were not seen
    name: str = ""

    @property
    def polygon(self) -> shapely.Polygon:
        """Counter-clockwise polygon, metres."""
        if len(self.shape) == 4 and not isinstance(self.shape[0], tuple):
            return shapely.box(*self.shape, ccw=True)
        return shapely.orient_polygons(shapely.Polygon(self.shape))


@dataclass(frozen=True)
class DoorSpec:
    """A door across the wall at ``offset`` (its middle) between ``start`` and ``end``."""

    axis: int
    offset: float
    start: float
    end: float
    kind: str = "door"
    joins: tuple[int, ...] = ()
    thickness: float = WALL
    confidence: float = 0.9


def manhattan_frame(yaw_deg: float) -> ManhattanFrame:
    """The frame of a building turned by ``yaw_deg`` about z."""
    yaw = np.deg2rad(yaw_deg)
    c, s = np.cos(yaw), np.sin(yaw)
    rotation = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return ManhattanFrame(rotation, float(yaw), 0.0, 0.81, 500.0, 0.0, HEIGHT)


def _side_facing(a: np.ndarray, b: np.ndarray) -> Facing:
    """Facing of the surface along the counter-clockwise edge a -> b (its normal points to the left)."""
    if abs(a[0] - b[0]) < 1e-9:
        return Facing.WEST if b[1] > a[1] else Facing.EAST
    return Facing.NORTH if b[0] > a[0] else Facing.SOUTH


def _edges(polygon: shapely.Polygon) -> list[tuple[np.ndarray, np.ndarray, bool]]:
    rings = [(polygon.exterior, False), *((hole, True) for hole in polygon.interiors)]
    return [
        (a, b, hole)
        for ring, hole in rings
        for a, b in zip(np.array(ring.coords)[:-1], np.array(ring.coords)[1:], strict=True)
    ]


def _seen_part(room: RoomSpec) -> shapely.Polygon:
    """The known part: a share of the room's height, from below."""
    x0, y0, x1, y1 = room.polygon.bounds
    return room.polygon.intersection(shapely.box(x0, y0, x1, y0 + room.seen * (y1 - y0)))


class _Builder:
    """Collects planes, segments and regions while the rooms are walked."""

    def __init__(self) -> None:
        self.planes: dict[tuple[Facing, float], list[LayoutSegment]] = {}
        self.guessed: set[tuple[Facing, float]] = set()

    def side(self, room: RoomSpec, a: np.ndarray, b: np.ndarray, hole: bool) -> RegionSide:
        facing = _side_facing(a, b)
        offset = round(float(a[facing.axis]), 6)
        start, end = sorted((float(a[1 - facing.axis]), float(b[1 - facing.axis])))
        seen = facing.name.lower() not in room.guessed
        segments = self.planes.setdefault((facing, offset), [])
        if seen:
            ident = f"S-{facing.name[0]}{offset:.3f}-{len(segments)}"
            segments.append(
                LayoutSegment(
                    ident, facing, offset, start, end, 0.1, 2.5, 2.4 * (end - start), 400, 0.008, 0.001
                )
            )
        plane, share, residual = f"P-{facing.name[0]}{offset:.3f}", *((0.92, 0.009) if seen else (0.1, None))
        return RegionSide(tuple(a), tuple(b), plane, share, hole, residual)

    def layout(self) -> tuple[tuple[LayoutPlane, ...], tuple[LayoutSegment, ...]]:
        planes, segments = [], []
        for (facing, offset), mine in sorted(self.planes.items()):
            ident = f"P-{facing.name[0]}{offset:.3f}"
            runs = np.array([[s.start, s.end] for s in mine]).reshape(-1, 2)
            planes.append(
                LayoutPlane(
                    ident,
                    facing,
                    offset,
                    tuple(s.id for s in mine),
                    sum(s.area for s in mine),
                    0.009,
                    not mine,
                    None,
                    runs,
                    runs,
                )
            )
            segments += [replace(s, plane=ident) for s in mine]
        return tuple(planes), tuple(segments)


def _grid(rooms: Sequence[RoomSpec], doors: Sequence[Door], cell: float) -> OccupancyGrid:
    everything = shapely.union_all([room.polygon for room in rooms]).bounds
    origin = np.floor(np.array(everything[:2]) / cell) * cell - 10 * cell
    nx, ny = (np.ceil((np.array(everything[2:]) - origin) / cell).astype(int) + 10).tolist()
    states = np.full((ny, nx), UNOBSERVED, dtype=np.uint8)
    seen = shapely.union_all([_seen_part(room) for room in rooms])
    openings = shapely.union_all(
        [shapely.LineString(d.line()).buffer(d.thickness / 2 + cell, cap_style="flat") for d in doors]
    )
    free = polygon_mask(seen, origin, cell, (ny, nx))
    states[polygon_mask(seen.buffer(cell, join_style="mitre"), origin, cell, (ny, nx))] = OCCUPIED
    states[free | polygon_mask(openings, origin, cell, (ny, nx))] = FREE
    return OccupancyGrid(origin, cell, states, free.copy(), 1.5)


def _wall_points(segments: Sequence[LayoutSegment], rng: np.random.Generator) -> WallPoints:
    xy, facing = [np.zeros((0, 2))], [np.zeros(0, dtype=np.int8)]
    for s in segments:
        along = np.arange(s.start, s.end, 0.05)
        across = s.offset + rng.normal(0, 0.01, len(along))
        xy.append(np.column_stack([across, along] if s.facing.axis == 0 else [along, across]))
        facing.append(np.full(len(along), s.facing, dtype=np.int8))
    points, which = np.vstack(xy), np.concatenate(facing)
    clutter = rng.random(len(points)) < 0.05
    points[clutter] += rng.normal(0, 0.5, (int(clutter.sum()), 2))
    which[clutter] = -1
    return WallPoints(points.astype(np.float32), np.full(len(points), 2.4, dtype=np.float32), which)


def _region(
    i: int, room: RoomSpec, sides: list[RegionSide], grid: OccupancyGrid, doors: Sequence[Door]
) -> Region:
    inside = polygon_mask(room.polygon, grid.origin, grid.cell, grid.states.shape)
    return Region(
        f"R{i + 1}",
        room.name or str(i + 1),
        room.polygon,
        room.label,
        int((inside & grid.universe).sum()),
        int(inside.sum()),
        0.2,
        tuple(sides),
        tuple(d.id for d in doors if f"R{i + 1}" in d.connects),
        HEIGHT,
    )


def make_plan(
    rooms: Sequence[RoomSpec],
    doors: Sequence[DoorSpec] = (),
    *,
    yaw_deg: float = 17.0,
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0),
    source: str = "synthetic.ply",
    cell: float = CELL,
    seed: int = 0,
) -> FloorPlan:
    """A complete FloorPlan of ``rooms`` and ``doors`` as a pipeline would hand it over."""
    builder = _Builder()
    sides = [[builder.side(room, *edge) for edge in _edges(room.polygon)] for room in rooms]
    planes, segments = builder.layout()
    made = tuple(_door(i, spec, planes) for i, spec in enumerate(doors))
    grid = _grid(rooms, made, cell)
    regions = tuple(_region(i, room, sides[i], grid, made) for i, room in enumerate(rooms))
    return FloorPlan(
        frame=manhattan_frame(yaw_deg),
        local_frame=LocalFrame(shift=np.asarray(shift, dtype=np.float64)),
        segments=segments,
        planes=planes,
        doors=made,
        grid=grid,
        candidates=_no_candidates(),
        cover=_cover(regions, grid),
        regions=regions,
        wall_points=_wall_points(segments, np.random.default_rng(seed)),
        trajectory=np.array([r.polygon.representative_point().coords[0] for r in regions]).reshape(-1, 2),
        source=source,
        point_count=1000 * len(segments),
        config=Config(),
    )


def _door(i: int, spec: DoorSpec, planes: Sequence[LayoutPlane]) -> Door:
    faces = tuple(
        p.id
        for p in planes
        if p.facing.axis == spec.axis and abs(p.offset - spec.offset) < spec.thickness / 2 + 0.01
    )
    return Door(
        f"D{i + 1}",
        faces,
        spec.axis,
        spec.offset,
        spec.start,
        spec.end,
        spec.thickness,
        2.05 if spec.kind == "door" else None,
        spec.kind,
        spec.confidence,
        ("histogram", "lintel") if spec.kind == "door" else ("free space",),
        tuple(f"R{j + 1}" for j in spec.joins),
    )


def _no_candidates() -> CandidateSet:
    none = np.zeros(0)
    return CandidateSet(none, none, none, none, np.zeros((0, 6), dtype=np.int32))


def _cover(regions: Sequence[Region], grid: OccupancyGrid) -> RectangleCover:
    totals = np.array([r.total_cells for r in regions], dtype=np.int64)
    free = np.array([r.free_cells for r in regions], dtype=np.int64)
    bounds = np.array([r.polygon.bounds for r in regions], dtype=np.float64).reshape(-1, 4)
    return RectangleCover(
        np.arange(len(regions)), bounds, totals, free, free, np.zeros(grid.states.shape, dtype=bool)
    )


def small_flat(**placed: object) -> FloorPlan:
    """Two rooms side by side with one door between them and one to the outside."""
    rooms = [RoomSpec((0, 0, 4.2, 3.4), name="Living & dining"), RoomSpec((4.2 + WALL, 0, 7.6, 3.4))]
    doors = [
        DoorSpec(0, 4.2 + WALL / 2, 1.0, 1.9, joins=(0, 1)),
        DoorSpec(1, 0.0, 0.6, 1.5, joins=(0,), thickness=0.0),
    ]
    return make_plan(rooms, doors, **{"source": "flat.ply", **placed})  # type: ignore[arg-type]


def l_corridor(rooms_below: int = 5, rooms_beside: int = 3, **placed: object) -> FloorPlan:
    """An L-shaped corridor with rooms under its long arm and beside its short arm.

    The last room below is seen by half, with its east side guessed; the one before the last is glimpsed.
    """
    wide, deep, width = 3.5, 4.6, 1.8
    step = wide + WALL
    length = rooms_below * step - WALL
    arm = rooms_beside * step - WALL
    top = deep + WALL + width
    rooms, doors = [], []
    for i in range(rooms_below):
        x0 = i * step
        last = i == rooms_below - 1
        rooms.append(
            RoomSpec(
                (x0, 0, x0 + wide, deep),
                seen=0.5 if last else 1.0,
                guessed=frozenset({"west"} if last else ()),
            )
        )
        doors.append(DoorSpec(1, deep + WALL / 2, x0 + 0.5, x0 + 1.4, joins=(i, rooms_below + rooms_beside)))
    for j in range(rooms_beside):
        y0 = top + WALL + j * step
        seen, guessed = (0.25, frozenset({"south", "west"})) if j == rooms_beside - 1 else (1.0, frozenset())
        rooms.append(RoomSpec((width + WALL, y0, width + WALL + deep, y0 + wide), seen=seen, guessed=guessed))
        kind, wide_open = ("opening", 2.2) if j == 1 else ("door", 0.9)
        i = rooms_below + j
        doors.append(
            DoorSpec(
                0, width + WALL / 2, y0 + 0.4, y0 + 0.4 + wide_open, kind, (i, rooms_below + rooms_beside)
            )
        )
    end = top + WALL + arm
    corridor = [(0, deep + WALL), (length, deep + WALL), (length, top), (width, top), (width, end), (0, end)]
    rooms.append(RoomSpec(corridor, "corridor"))
    return make_plan(rooms, doors, **{"source": "l-corridor.ply", **placed})  # type: ignore[arg-type]


def office(columns: int = 10, **placed: object) -> FloorPlan:
    """About 60 x 25 m: four rows of rooms around two corridors that join at both ends."""
    wide, deep, width = 5.55, 4.8, 2.0
    step = wide + WALL
    rows = [0.0, deep + width + 2 * WALL, 2 * deep + width + 3 * WALL, 3 * deep + 2 * width + 5 * WALL]
    rooms: list[RoomSpec] = []
    doors: list[DoorSpec] = []
    n = 4 * columns
    for r, y0 in enumerate(rows):
        for c in range(columns):
            x0 = c * step + (width + WALL)
            glimpsed = (r * columns + c) % 7 == 3
            rooms.append(
                RoomSpec(
                    (x0, y0, x0 + wide, y0 + deep),
                    seen=0.35 if glimpsed else 1.0,
                    guessed=frozenset({"south"} if glimpsed else ()),
                )
            )
            at = y0 + deep + WALL / 2 if r in (0, 2) else y0 - WALL / 2
            doors.append(DoorSpec(1, at, x0 + 0.6, x0 + 1.5, joins=(len(rooms) - 1, n)))
    lo, hi = deep + WALL, rows[3] - WALL
    right = columns * step + width + WALL + width
    ring = shapely.box(0, lo, right, hi).difference(shapely.box(width, lo + width, right - width, hi - width))
    return make_plan(
        [*rooms, _Shaped(shapely.orient_polygons(ring))],
        doors,
        **{"source": "office.ply", **placed},  # type: ignore[arg-type, list-item]
    )


@dataclass(frozen=True)
class _Shaped(RoomSpec):
    """A room given as a polygon, for shapes with holes."""

    shape: shapely.Polygon = None  # type: ignore[assignment]
    label: str = "corridor"

    @property
    def polygon(self) -> shapely.Polygon:
        return self.shape

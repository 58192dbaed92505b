"""Furniture of many heights, along walls and free-standing; columns. Doors stay clear."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.building import DoorOpening, Furniture, Space, WindowOpening, solid_hulls
from floorplan_core.simulation.circulation import mm
from floorplan_core.simulation.spec import BuildingSpec

Float = NDArray[np.float64]
Range = tuple[float, float]
Builder = Callable[[float, float, float], Float]

DENSITY = {"none": 0.0, "normal": 1.0, "heavy": 2.2}
PASSAGE = 0.06  # m between two pieces at least
DOOR_ZONE = 1.0  # m kept clear on both sides of a door
WALK = 0.75  # m that stays free beside a piece that stands in the open
TRIES = 12


def _box(length: float, depth: float, height: float) -> Float:
    return np.array([[0, 0, 0, length, depth, height, 0.0]])


def _table(length: float, depth: float, height: float) -> Float:
    """A top on two end panels; local x along the wall, y away from it."""
    panel, top = 0.03, 0.03
    return np.array(
        [
            [0, 0, height - top, length, depth, height, 0],
            [0.05, 0.05, 0, 0.05 + panel, depth - 0.05, height - top, 0],
            [length - 0.05 - panel, 0.05, 0, length - 0.05, depth - 0.05, height - top, 0],
        ]
    )


def _sofa(length: float, depth: float, height: float) -> Float:
    return np.array([[0, 0, 0.05, length, depth, 0.42, 0], [0, 0, 0.42, length, 0.22, height, 0.0]])


def _kitchen(length: float, depth: float, height: float) -> Float:
    """Base cabinets and wall cabinets above them."""
    return np.array([[0, 0, 0, length, depth, 0.9, 0], [0, 0, 1.45, length, 0.35, height, 0.0]])


def _board(length: float, depth: float, height: float) -> Float:
    return np.array([[0, 0, 0.9, length, depth, height, 0.0]])


def _basin(length: float, depth: float, height: float) -> Float:
    return np.array([[0, 0, 0.65, length, depth, height, 0.0]])


@dataclass(frozen=True)
class Piece:
    """One kind of furniture: ranges of length (along the wall), depth and height in metres."""

    kind: str
    length: Range
    depth: Range
    height: Range
    build: Builder = _box
    free: bool = False  # stands in the open as well as against a wall
    chairs: int = 0


DESK = Piece("desk", (1.3, 1.8), (0.7, 0.8), (0.72, 0.76), _table, chairs=1)
TABLE = Piece("table", (1.6, 3.2), (0.9, 1.2), (0.72, 0.76), _table, free=True, chairs=6)
CABINET = Piece("cabinet", (0.8, 1.6), (0.4, 0.5), (1.6, 2.0))
LOCKER = Piece("cabinet", (1.2, 2.8), (0.45, 0.6), (1.9, 2.0))
SHELF = Piece("shelf", (0.8, 2.0), (0.28, 0.4), (1.5, 2.2))
DRAWERS = Piece("drawers", (0.4, 1.2), (0.4, 0.55), (0.6, 1.2))
DIVIDER = Piece("divider", (1.2, 2.4), (0.4, 0.5), (1.5, 2.0), free=True)
BOARD = Piece("board", (1.2, 2.4), (0.03, 0.05), (1.9, 2.1), _board)
PLANT = Piece("plant", (0.35, 0.5), (0.35, 0.5), (0.8, 1.6))
SOFA = Piece("sofa", (1.5, 2.3), (0.8, 0.95), (0.75, 0.9), _sofa)
BED = Piece("bed", (0.9, 1.8), (1.95, 2.1), (0.45, 0.6))
KITCHEN = Piece("kitchen", (1.8, 3.6), (0.6, 0.62), (2.1, 2.2), _kitchen)
TOILET = Piece("toilet", (0.36, 0.4), (0.6, 0.7), (0.4, 0.8))
BASIN = Piece("basin", (0.5, 0.7), (0.4, 0.5), (0.82, 0.88), _basin)
BENCH = Piece("bench", (1.0, 1.8), (0.35, 0.42), (0.42, 0.48))

# What a use holds: pieces in order, each with its number per 10 m2 of floor (at least the first).
INVENTORY: dict[str, tuple[tuple[Piece, float], ...]] = {
    "office": (
        (DESK, 1.0), (CABINET, 0.5), (SHELF, 0.5), (DRAWERS, 0.4), (BOARD, 0.3), (PLANT, 0.3), (DIVIDER, 0.15)
    ),
    "meeting room": ((TABLE, 0.3), (BOARD, 0.3), (CABINET, 0.25), (PLANT, 0.2), (LOCKER, 0.15), (DESK, 0.3)),
    "store": ((SHELF, 1.5), (LOCKER, 0.8), (DRAWERS, 0.8)),
    "bathroom": ((TOILET, 2.0), (BASIN, 2.0)),
    "closet": ((SHELF, 2.0),),
    "hall": ((SOFA, 0.4), (PLANT, 0.4), (DRAWERS, 0.3), (LOCKER, 0.15)),
    "corridor": ((BENCH, 0.06), (PLANT, 0.06), (DRAWERS, 0.08), (LOCKER, 0.05)),
    "bedroom": ((BED, 0.7), (LOCKER, 0.7), (DRAWERS, 0.6), (DESK, 0.4)),
    "kitchen": ((KITCHEN, 1.0), (TABLE, 0.4), (CABINET, 0.5)),
    "living room": ((SOFA, 0.5), (TABLE, 0.25), (SHELF, 0.5), (CABINET, 0.3), (PLANT, 0.4), (DRAWERS, 0.3)),
}  # fmt: skip


@dataclass
class _Floor:
    """What is taken on the floor of one space while it is being furnished; hulls are (4,) x0, y0, x1, y1."""

    space: Space
    blocked: list[tuple[float, ...]]  # door zones, columns, pieces
    windows: list[WindowOpening]

    def fits(self, hull: Float) -> bool:
        """True where ``hull`` lies in one rectangle of the space and clear of everything."""
        r = self.space.rects
        inside = (r[:, :2] <= hull[:2] + 1e-9).all(axis=1) & (r[:, 2:] >= hull[2:] - 1e-9).all(axis=1)
        if not inside.any():
            return False
        taken = np.array(self.blocked).reshape(-1, 4)
        return not ((taken[:, :2] < hull[2:]) & (taken[:, 2:] > hull[:2])).all(axis=1).any()

    def backed(self, hull: Float, gap: float) -> bool:
        """True where one whole side of ``hull`` is at most ``gap`` from the boundary of the space.

        A rectangle of the corridor network may end inside another one: there is no wall to stand at.
        """
        corners = np.array([[0, 1], [2, 1], [2, 3], [0, 3]])
        for side, out in enumerate(gap * np.array([[0, -1], [1, 0], [0, 1], [-1, 0]])):
            ends = hull[np.array([corners[side], corners[(side + 1) % 4]])] + out
            r = self.space.rects[:, None]
            inside = (r[..., :2] < ends[None]).all(axis=2) & (r[..., 2:] > ends[None]).all(axis=2)
            if not inside.any():
                return True
        return False

    def shaded(self, hull: Float, height: float) -> bool:
        """True where a piece of this height would stand in front of a window."""
        grown = hull + np.array([-0.1, -0.1, 0.1, 0.1])
        return any(
            height > w.sill and grown[0] < w.bounds[2] and w.bounds[0] < grown[2]
            and grown[1] < w.bounds[3] and w.bounds[1] < grown[3]
            for w in self.windows
        )  # fmt: skip


def furnish(
    spaces: tuple[Space, ...],
    doors: tuple[DoorOpening, ...],
    windows: tuple[WindowOpening, ...],
    columns: Float,
    spec: BuildingSpec,
    rng: np.random.Generator,
) -> tuple[Furniture, ...]:
    """Furniture of all spaces at the spec's density."""
    density = DENSITY[spec.furniture]
    if density == 0:
        return ()
    zones = [zone for door in doors for zone in door_zones(door)] + [tuple(c) for c in columns]
    keep = np.array(zones).reshape(-1, 4)
    made: list[Furniture] = []
    for index, space in enumerate(spaces):
        lo, hi = space.rects[:, :2].min(axis=0), space.rects[:, 2:].max(axis=0)
        near = keep[((keep[:, :2] < hi + 0.01) & (keep[:, 2:] > lo - 0.01)).all(axis=1)]
        mine = [w for w in windows if w.space == index]
        floor = _Floor(space, [tuple(z) for z in near], mine)
        made += _furnish_space(index, floor, density, rng)
    return tuple(made)


def door_zones(door: DoorOpening) -> list[tuple[float, ...]]:
    """(x0, y0, x1, y1) in front of and behind a door, and where its leaves stand."""
    low, high = np.array(door.bounds[:2]), np.array(door.bounds[2:])
    depth = max(DOOR_ZONE, door.width if door.kind == "door" else 0.0)
    low[door.axis] -= depth
    high[door.axis] += depth
    low[1 - door.axis] -= 0.1
    high[1 - door.axis] += 0.1
    hulls = solid_hulls(door.leaves)[:, [0, 1, 3, 4]]
    return [(*low, *high), *(tuple(h) for h in hulls)]


def _furnish_space(index: int, floor: _Floor, density: float, rng: np.random.Generator) -> list[Furniture]:
    made: list[Furniture] = []
    area = floor.space.area
    for order, (piece, rate) in enumerate(INVENTORY.get(floor.space.use, INVENTORY["office"])):
        expected = rate * density * area / 10
        count = int(expected + rng.random())
        if order == 0 and floor.space.use != "corridor":
            count = max(count, 1)
        for _ in range(count):
            made += _place(index, floor, piece, rng)
    return made


def _place(index: int, floor: _Floor, piece: Piece, rng: np.random.Generator) -> list[Furniture]:
    """Try some places for one piece; nothing where none fits."""
    for _ in range(TRIES):
        length, depth, height = (mm(rng.uniform(*r)) for r in (piece.length, piece.depth, piece.height))
        rect = floor.space.rects[rng.integers(len(floor.space.rects))]
        wall = not piece.free or rng.random() < 0.15
        solids, gap = _pose(piece, length, depth, height, rect, wall, rng)
        hull = solid_hulls(solids)
        flat = np.concatenate([hull[:, :2].min(axis=0), hull[:, 3:5].max(axis=0)])
        margin = PASSAGE if wall else WALK
        grown = flat + np.array([-margin, -margin, margin, margin])
        clipped = np.concatenate([np.maximum(grown[:2], rect[:2]), np.minimum(grown[2:], rect[2:])])
        if not wall and (grown != clipped).any():
            continue
        if (flat[:2] < rect[:2] + gap).any() or (flat[2:] > rect[2:] - gap).any() or not floor.fits(clipped):
            continue
        if wall and (floor.shaded(flat, height) or not floor.backed(flat, 2 * PASSAGE)):
            continue
        floor.blocked.append(tuple(flat))
        return [Furniture(piece.kind, index, solids), *_chairs(index, floor, piece, flat, rng)]
    return []


def _pose(
    piece: Piece,
    length: float,
    depth: float,
    height: float,
    rect: Float,
    wall: bool,
    rng: np.random.Generator,
) -> tuple[Float, float]:
    """The piece's solids against a wall of ``rect`` or in the open, and the gap it keeps to the walls."""
    side = int(rng.integers(4))
    if piece.kind == "bed" and rng.random() < 0.5:
        length, depth = depth, length  # along the wall
    solids = piece.build(length, depth, height)
    if side >= 2:  # along y
        solids = solids[:, [1, 0, 2, 4, 3, 5, 6]]
    size = np.array([length, depth] if side < 2 else [depth, length])
    if side % 2:  # its back to the other side
        axis = 1 if side < 2 else 0
        solids = solids.copy()
        solids[:, [axis, axis + 3]] = size[axis] - solids[:, [axis + 3, axis]]
    gap = 0.0 if piece.kind in ("board", "kitchen") else float(rng.choice([0.01, 0.02, 0.05]))
    room = rect[2:] - rect[:2] - size
    at = rect[:2] + rng.uniform(0, 1, 2) * np.maximum(room, 0)
    if wall:
        axis = 1 if side < 2 else 0
        at[axis] = rect[axis] + gap if side % 2 == 0 else rect[axis + 2] - size[axis] - gap
        if rng.random() < 0.35:  # in a corner
            at[1 - axis] = rect[1 - axis] + gap
    at = np.round(at, 3)
    moved = solids + np.array([at[0], at[1], 0, at[0], at[1], 0, 0])
    return moved, 0.0 if wall else PASSAGE


def _chairs(
    index: int, floor: _Floor, piece: Piece, hull: Float, rng: np.random.Generator
) -> list[Furniture]:
    """Chairs around a desk or table, each turned a little, where there is room."""
    made: list[Furniture] = []
    middle, half = (hull[:2] + hull[2:]) / 2, (hull[2:] - hull[:2]) / 2
    for _ in range(piece.chairs * 2):
        if len(made) >= piece.chairs:
            break
        axis, sign = int(rng.integers(2)), int(rng.choice([-1, 1]))
        at = middle + rng.uniform(-0.7, 0.7, 2) * half
        at[axis] = middle[axis] + sign * (half[axis] + rng.uniform(0.3, 0.45))
        solids = _chair(at, rng.uniform(-np.pi, np.pi))
        box = solid_hulls(solids)
        flat = np.concatenate([box[:, :2].min(axis=0), box[:, 3:5].max(axis=0)])
        if floor.fits(flat):
            floor.blocked.append(tuple(flat))
            made.append(Furniture("chair", index, solids))
    return made


def _chair(at: Float, yaw: float) -> Float:
    """Seat, back and stem; the back stands behind the seat whatever the yaw."""
    c, s, half = np.cos(yaw), np.sin(yaw), 0.21
    back = at - 0.2 * np.array([c, s])
    return np.array(
        [
            [at[0] - half, at[1] - half, 0.42, at[0] + half, at[1] + half, 0.47, yaw],
            [back[0] - 0.02, back[1] - half, 0.5, back[0] + 0.02, back[1] + half, 0.92, yaw],
            [at[0] - 0.04, at[1] - 0.04, 0.0, at[0] + 0.04, at[1] + 0.04, 0.42, yaw],
        ]
    )


def make_columns(
    spaces: tuple[Space, ...],
    doors: tuple[DoorOpening, ...],
    spec: BuildingSpec,
    rng: np.random.Generator,
) -> Float:
    """(K, 4) columns: on a line through large rooms, and half out of the walls of others."""
    zones = np.array([z for d in doors for z in door_zones(d)]).reshape(-1, 4)
    found = []
    for space in spaces:
        for rect in space.rects:
            size = mm(rng.uniform(0.3, 0.45))
            for at in _column_places(space, rect, size, rng):
                column = np.array([*at, *(at + size)])
                clear = not ((zones[:, :2] < column[2:]) & (zones[:, 2:] > column[:2])).all(axis=1).any()
                if clear and rng.random() < spec.columns:
                    found.append(column)
    return np.round(np.array(found).reshape(-1, 4), 3)


def _column_places(space: Space, rect: Float, size: float, rng: np.random.Generator) -> list[Float]:
    """Lower left corners: every 4 to 6 m along the middle of a large room, else now and then in a corner."""
    extent = rect[2:] - rect[:2]
    long = int(np.argmax(extent))
    if space.kind == "room" and extent.min() > 4.5 and extent.prod() > 32:
        count = int(extent[long] / rng.uniform(4, 6))
        middles = np.tile((rect[:2] + rect[2:]) / 2 - size / 2, (count, 1))
        middles[:, long] = rect[long] + extent[long] * (np.arange(count) + 0.5) / count - size / 2
        return list(middles)
    if space.kind == "room" and extent.min() > 3.5 and rng.random() < 0.3:
        return [np.array([rect[0], rect[1]])]  # in a corner: its two faces stand out
    return []

"""Furniture of many heights, along walls and free-standing; columns. Doors stay clear."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.building import DoorOpening, Furniture, Space, WindowOpening, solid_hulls
from floorplan_core.simulation.catalogue import INVENTORY, Piece
from floorplan_core.simulation.circulation import mm
from floorplan_core.simulation.spec import BuildingSpec

Float = NDArray[np.float64]
DENSITY = {"none": 0.0, "normal": 1.0, "heavy": 2.2}
PASSAGE = 0.06  # m between two pieces at least
DOOR_ZONE = 1.0  # m kept clear on both sides of a door
WALK = 0.75  # m that stays free beside a piece that stands in the open
ESCAPE = 1.0  # m of a corridor's width that stays free
TRIES = 12
FREE_AT_WALL = 0.15  # share of free-standing pieces that stand at a wall all the same
IN_CORNER = 0.35  # share of pieces that are pushed into a corner
WALL_GAPS = (0.01, 0.02, 0.05)  # m between a piece and its wall
BACKS = ((1, -1), (1, 1), (0, -1), (0, 1))  # axis and sense of a piece's back


@dataclass
class _Floor:
    """What is taken on the floor of one space while it is being furnished; hulls are (4,) x0, y0, x1, y1."""

    space: Space
    blocked: list[tuple[float, ...]]  # door zones, columns, pieces
    windows: list[WindowOpening]

    def fits(self, hull: Float, margin: float = 0.0, whole: bool = False) -> bool:
        """True where ``hull`` lies in one rectangle of the space and ``margin`` clear of everything.

        ``whole``: the margin must lie in the rectangle too, not only away from things.
        """
        grown = hull + margin * np.array([-1, -1, 1, 1])
        inner, r = grown if whole else hull, self.space.rects
        inside = (r[:, :2] <= inner[:2] + 1e-9).all(axis=1) & (r[:, 2:] >= inner[2:] - 1e-9).all(axis=1)
        if not inside.any():
            return False
        taken = np.array(self.blocked).reshape(-1, 4)
        return not ((taken[:, :2] < grown[2:]) & (taken[:, 2:] > grown[:2])).all(axis=1).any()

    def backed(self, hull: Float, back: int, gap: float) -> bool:
        """True where the back of ``hull`` is at most ``gap`` from the boundary of the space.

        A rectangle of the corridor network may end inside another one: there is no wall to stand at.
        """
        axis, sign = BACKS[back]
        behind = hull.copy()
        face = hull[axis] if sign < 0 else hull[axis + 2]
        behind[[axis, axis + 2]] = face + sign * gap
        r = self.space.rects
        touches = (r[:, :2] < behind[2:]) & (r[:, 2:] > behind[:2])
        return not touches.all(axis=1).any()

    def shaded(self, hull: Float, height: float) -> bool:
        """True where a piece of this height would stand in front of a window."""
        grown = hull + np.array([-0.1, -0.1, 0.1, 0.1])
        return any(
            height > w.sill
            and grown[0] < w.bounds[2]
            and w.bounds[0] < grown[2]
            and grown[1] < w.bounds[3]
            and w.bounds[1] < grown[3]
            for w in self.windows
        )


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
        rect = floor.space.rects[rng.integers(len(floor.space.rects))]
        at_wall = not piece.free or rng.random() < FREE_AT_WALL
        back = int(rng.integers(len(BACKS)))
        solids = _turned(piece, back, rng)
        solids = solids + _shift(_flat_hull(solids)[2:], rect, back if at_wall else None, piece, rng)
        hull = _flat_hull(solids)
        if (
            floor.space.kind == "corridor"
            and (rect[2:] - rect[:2]).min() - (hull[2:] - hull[:2]).min() < ESCAPE
        ):
            continue
        if not floor.fits(hull, PASSAGE if at_wall else WALK, whole=not at_wall):
            continue
        if at_wall and (floor.shaded(hull, solids[:, 5].max()) or not floor.backed(hull, back, 2 * PASSAGE)):
            continue
        floor.blocked.append(tuple(hull))
        return [Furniture(piece.kind, index, solids), *_chairs(index, floor, piece, hull, rng)]
    return []


def _flat_hull(solids: Float) -> Float:
    """(4,) x0, y0, x1, y1 of all solids together."""
    hull = solid_hulls(solids)
    return np.concatenate([hull[:, :2].min(axis=0), hull[:, 3:5].max(axis=0)])


def _turned(piece: Piece, back: int, rng: np.random.Generator) -> Float:
    """(K, 7) a piece of random size at the origin, its back to the side ``back``."""
    length, depth, height = (mm(rng.uniform(*r)) for r in (piece.length, piece.depth, piece.height))
    if piece.kind == "bed" and rng.random() < 0.5:
        length, depth = depth, length  # its long side at the wall
    solids = piece.build(length, depth, height)
    axis, sign = BACKS[back]
    if axis == 0:  # along y
        solids = solids[:, [1, 0, 2, 4, 3, 5, 6]]
    if sign > 0:  # its back to the far side
        solids[:, [axis, axis + 3]] = depth - solids[:, [axis + 3, axis]]
    return solids


def _shift(size: Float, rect: Float, back: int | None, piece: Piece, rng: np.random.Generator) -> Float:
    """(7,) to add to solids at the origin: anywhere in ``rect``, at the wall ``back`` where given."""
    gap = 0.0 if piece.flush else float(rng.choice(WALL_GAPS))
    at = rect[:2] + rng.uniform(0, 1, 2) * np.maximum(rect[2:] - rect[:2] - size, 0)
    if back is not None:
        axis, sign = BACKS[back]
        at[axis] = rect[axis] + gap if sign < 0 else rect[axis + 2] - size[axis] - gap
        if rng.random() < IN_CORNER:
            at[1 - axis] = rect[1 - axis] + gap
    x, y = np.round(at, 3)
    return np.array([x, y, 0, x, y, 0, 0])


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

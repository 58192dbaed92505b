"""Generated buildings as the set cover sees them: layout planes, blockers and a partly observed grid.

Blocks of double-loaded corridors between cross corridors: rooms of jittered width and depth on both sides,
each with a door, some furniture, and seen in full, from its door only, or not at all. Planes of one facing
closer than ``MERGE`` are one plane, as the minimum set of layout planes has it; what was not seen gives no
plane and no blocker.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import FREE, OCCUPIED, OccupancyGrid

CELL = 0.1  # m, as in the paper
WALL = 0.15  # m
CORRIDOR = 2.2  # m
BLOCK = 36.0  # m between cross corridors
DOOR = 0.9  # m
MERGE = 0.1  # m: two intervals of +-0.05 m that can be pierced together
DEPTHS, WIDTHS = (4.2, 6.2), (2.8, 6.8)  # m, ranges of room sizes
SEEN, GLIMPSED = 0.65, 0.25  # shares of the rooms; the rest is never seen

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Layout:
    """What candidates and cover take in; metres throughout."""

    x_plus: NDArray[np.float64]
    x_minus: NDArray[np.float64]
    y_plus: NDArray[np.float64]
    y_minus: NDArray[np.float64]
    blockers: NDArray[np.float64]  # (B, 4)
    grid: OccupancyGrid
    area: float  # m2 inside the outer walls
    rooms: int

    @property
    def planes(self) -> tuple[NDArray[np.float64], ...]:
        """The four facings in the order that the stage takes them."""
        return self.x_plus, self.x_minus, self.y_plus, self.y_minus


class _Draft:
    """Collects what is seen of a building while it is drawn."""

    def __init__(self, width: float, height: float) -> None:
        self.states = np.zeros((round(height / CELL), round(width / CELL)), dtype=np.uint8)
        self.planes: tuple[list[float], ...] = ([], [], [], [])
        self.blockers: list[Box] = []
        self.rooms = 0

    def fill(self, box: Box, state: np.uint8) -> None:
        """Set the cells of a box."""
        x0, y0, x1, y1 = (max(round(v / CELL), 0) for v in box)
        self.states[y0:y1, x0:x1] = state

    def face(self, facing: int, offset: float, start: float, end: float) -> None:
        """An observed patch of wall: a plane and a blocker."""
        self.planes[facing].append(offset)
        self.blockers.append((offset, start, offset, end) if facing < 2 else (start, offset, end, offset))


def building(width: float, height: float, rng: np.random.Generator) -> Layout:
    """A building of about ``width`` x ``height`` metres."""
    draft = _Draft(width, height)
    band = CORRIDOR + 2 * (sum(DEPTHS) / 2 + WALL)
    columns = max(1, round(width / (BLOCK + CORRIDOR)))
    bands = max(1, round(height / band))
    pitch_x, pitch_y = width / columns, height / bands
    for row in range(bands):
        corridor = pitch_y * (row + 0.5) + rng.uniform(-0.4, 0.4)
        for column in range(columns):
            x0 = pitch_x * column + (CORRIDOR / 2 if column else WALL)
            x1 = pitch_x * (column + 1) - (CORRIDOR / 2 if column < columns - 1 else WALL)
            _wing(draft, (x0, x1), corridor + CORRIDOR / 2, pitch_y * (row + 1) - WALL, True, rng)
            _wing(draft, (x0, x1), corridor - CORRIDOR / 2, pitch_y * row + WALL, False, rng)
        draft.fill((WALL, corridor - CORRIDOR / 2, width - WALL, corridor + CORRIDOR / 2), FREE)
        draft.face(0, WALL, corridor - CORRIDOR / 2, corridor + CORRIDOR / 2)
        draft.face(1, width - WALL, corridor - CORRIDOR / 2, corridor + CORRIDOR / 2)
    for column in range(1, columns):
        x = pitch_x * column
        draft.fill((x - CORRIDOR / 2, WALL, x + CORRIDOR / 2, height - WALL), FREE)
        draft.face(2, WALL, x - CORRIDOR / 2, x + CORRIDOR / 2)
        draft.face(3, height - WALL, x - CORRIDOR / 2, x + CORRIDOR / 2)
    return _finish(draft, width * height)


def _wing(
    draft: _Draft, span: tuple[float, float], front: float, back: float, up: bool, rng: np.random.Generator
) -> None:
    """A row of rooms along one side of a corridor; ``front`` is the corridor's side of it."""
    x = span[0]
    ends = []
    while span[1] - x > WIDTHS[0]:
        end = min(x + rng.uniform(*WIDTHS), span[1])
        if span[1] - end < WIDTHS[0]:
            end = span[1]
        ends.append((x, end))
        x = end + WALL
    for x0, x1 in ends:
        _room(draft, x0, x1, front, back, up, rng)
    low, high = min(front, back), max(front, back)
    draft.face(1, span[0] - WALL, low, high)  # the wing's ends, seen from the cross corridors
    draft.face(0, span[1] + WALL, low, high)


def _room(
    draft: _Draft, x0: float, x1: float, front: float, back: float, up: bool, rng: np.random.Generator
) -> None:
    """One room: its faces, its door, what is seen of its floor, furniture."""
    draft.rooms += 1
    sign = 1.0 if up else -1.0
    inner, far = front + sign * WALL, back - sign * rng.uniform(0.0, 0.6)
    y0, y1 = min(inner, far), max(inner, far)
    door = rng.uniform(x0 + 0.2, x1 - 0.2 - DOOR)
    draft.blockers.append((door, min(front, inner), door + DOOR, max(front, inner)))
    draft.face(3 if up else 2, front, x0, x1)
    kind = rng.random()
    if kind > SEEN + GLIMPSED:
        return
    deep = y1 - y0 if kind < SEEN else rng.uniform(1.0, y1 - y0)
    draft.face(2 if up else 3, inner, x0, x1)
    glimpse = rng.random() < 0.5
    if kind < SEEN or glimpse:
        draft.face(0, x0, y0, y1)
    if kind < SEEN or not glimpse:
        draft.face(1, x1, y0, y1)
    if kind < SEEN:
        draft.face(3 if up else 2, far, x0, x1)
        draft.fill((x0, y0, x1, y1), FREE)
        _furnish(draft, (x0, y0, x1, y1), rng)
    else:
        left, right = sorted((x0 if glimpse else x1, door + DOOR / 2))
        draft.fill((left, y0, right, y0 + deep) if up else (left, y1 - deep, right, y1), FREE)


def _furnish(draft: _Draft, room: Box, rng: np.random.Generator) -> None:
    """A few occupied boxes."""
    for _ in range(rng.integers(0, 5)):
        w, h = rng.uniform(0.4, 1.6, 2)
        x, y = rng.uniform(room[0], room[2] - w), rng.uniform(room[1], room[3] - h)
        draft.fill((x, y, x + w, y + h), OCCUPIED)


def _finish(draft: _Draft, area: float) -> Layout:
    """Merge the planes and make the grid."""
    free = draft.states == FREE
    grid = OccupancyGrid(np.zeros(2), CELL, draft.states, free, 1.2)
    planes = [merge(np.array(p)) for p in draft.planes]
    return Layout(*planes, np.array(draft.blockers), grid, area, draft.rooms)


def merge(offsets: NDArray[np.float64]) -> NDArray[np.float64]:
    """Fewest planes that explain all offsets within ``MERGE / 2``: the sweep that pierces intervals."""
    found: list[float] = []
    for offset in np.sort(offsets):
        if not found or offset - MERGE / 2 > found[-1]:
            found.append(offset + MERGE / 2)
    return np.array(found) - MERGE / 2


def with_planes(layout: Layout, count: int, rng: np.random.Generator) -> Layout:
    """The same building with exactly ``count`` planes a facing: fewer, or more at random offsets."""
    x0, y0, x1, y1 = layout.grid.extent
    planes = []
    for offsets, (low, high) in zip(layout.planes, [(x0, x1), (x0, x1), (y0, y1), (y0, y1)], strict=True):
        kept = offsets if len(offsets) <= count else rng.choice(offsets, count, replace=False)
        extra = rng.uniform(low, high, count - len(kept))
        planes.append(np.sort(np.concatenate([kept, extra])))
    return Layout(*planes, layout.blockers, layout.grid, layout.area, layout.rooms)

"""Circulation first: the corridor rectangles of each style and the strips beside them that hold rooms.

All lengths in metres, rounded to the millimetre so that shared faces share their coordinate exactly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.spec import BuildingSpec

Float = NDArray[np.float64]
Rect = tuple[float, float, float, float]

ROOMS_A_BLOCK = 4.0  # along one side of a block of a grid
ASPECT = 1.5  # a grid's length over its depth
TWO_ROWS = 7.5  # m: a core deeper than this holds two rows of rooms back to back
JITTER = 0.12  # relative spread of widths and depths


@dataclass(frozen=True)
class Strip:
    """A row of rooms beside a corridor."""

    rect: Rect
    side: str  # where the corridor lies: "s", "n", "w" or "e"


@dataclass(frozen=True)
class Circulation:
    """Corridor rectangles (their union is one polygon) and the strips along them."""

    corridors: tuple[Rect, ...]
    strips: tuple[Strip, ...]


@dataclass(frozen=True)
class Walls:
    """Thicknesses and height that were drawn for this building, metres."""

    interior: float
    exterior: float
    height: float


def mm(value: float) -> float:
    """Rounded to the millimetre."""
    return round(float(value), 3)


def jitter(rng: np.random.Generator, mean: float) -> float:
    """``mean`` with the usual spread, rounded to the millimetre."""
    return mm(mean * (1 + rng.uniform(-JITTER, JITTER)))


def circulation(spec: BuildingSpec, walls: Walls, rng: np.random.Generator) -> Circulation:
    """Corridors and strips of the spec's style."""
    corridors, strips = _STYLES[spec.style](spec, walls.interior, rng)
    return Circulation(
        tuple(_rounded(r) for r in corridors), tuple(Strip(_rounded(s.rect), s.side) for s in strips)
    )


def _rounded(rect: Rect) -> Rect:
    return mm(rect[0]), mm(rect[1]), mm(rect[2]), mm(rect[3])


def _slots(spec: BuildingSpec) -> float:
    """Places along the corridors for the wanted number of rooms: some hold a room within a room."""
    return spec.rooms / (1 + spec.nested_rooms)


def _straight(spec: BuildingSpec, t: float, rng: np.random.Generator) -> tuple[list[Rect], list[Strip]]:
    """A double-loaded corridor; its ends look out of windows."""
    w = jitter(rng, spec.corridor_width)
    south, north = jitter(rng, spec.room_depth), jitter(rng, spec.room_depth)
    length = jitter(rng, max(_slots(spec) / 2, 1) * spec.room_width)
    return [(0.0, 0.0, length, w)], [
        Strip((0, -t - south, length, -t), "n"),
        Strip((0, w + t, length, w + t + north), "s"),
    ]


def _l(spec: BuildingSpec, t: float, rng: np.random.Generator) -> tuple[list[Rect], list[Strip]]:
    """Two wings that meet in a corner."""
    w, v = jitter(rng, spec.corridor_width), jitter(rng, spec.corridor_width)
    south, east, north, west = (jitter(rng, spec.room_depth) for _ in range(4))
    total = max(_slots(spec) / 2, 3.5) * spec.room_width
    x = max(total * rng.uniform(0.5, 0.65), west + v + t + 3)
    y = max(total - x, w + t + north + 4)
    corridors: list[Rect] = [(0, 0, x, w), (x - v, 0, x, y)]
    return corridors, [
        Strip((0, -t - south, x + t + east, -t), "n"),
        Strip((x + t, 0, x + t + east, y), "w"),
        Strip((0, w + t, x - v - t, w + t + north), "s"),
        Strip((x - v - t - west, w + 2 * t + north, x - v - t, y), "e"),
    ]


def _t(spec: BuildingSpec, t: float, rng: np.random.Generator) -> tuple[list[Rect], list[Strip]]:
    """A bar with a wing in its middle."""
    w, v = jitter(rng, spec.corridor_width), jitter(rng, spec.corridor_width)
    south, left, right, west, east = (jitter(rng, spec.room_depth) for _ in range(5))
    total = max(_slots(spec) / 2, 4.5) * spec.room_width
    x = max(total * rng.uniform(0.6, 0.7), west + east + v + 4 * t + 2)
    m = mm(x * rng.uniform(0.4, 0.6))
    y = w + t + max(left, right) + t + max(total - x, 4.0)
    return [(0, 0, x, w), (m, 0, m + v, y)], [
        Strip((0, -t - south, x, -t), "n"),
        Strip((0, w + t, m - t, w + t + left), "s"),
        Strip((m + v + t, w + t, x, w + t + right), "s"),
        Strip((m - t - west, w + 2 * t + left, m - t, y), "e"),
        Strip((m + v + t, w + 2 * t + right, m + v + t + east, y), "w"),
    ]


def _core(rect: Rect, t: float, rng: np.random.Generator) -> list[Strip]:
    """The rooms of a block that corridors surround: one row, or two back to back."""
    x0, y0, x1, y1 = rect
    if y1 - y0 < TWO_ROWS:
        return [Strip(rect, "s" if rng.random() < 0.5 else "n")]
    m = mm(y0 + (y1 - y0 - t) * rng.uniform(0.4, 0.6))
    return [Strip((x0, y0, x1, m), "s"), Strip((x0, m + t, x1, y1), "n")]


def _ring(spec: BuildingSpec, t: float, rng: np.random.Generator) -> tuple[list[Rect], list[Strip]]:
    """A corridor around a core; rooms in the core and along the outside."""
    w, v = jitter(rng, spec.corridor_width), jitter(rng, spec.corridor_width)
    south, north, west, east = (jitter(rng, spec.room_depth) for _ in range(4))
    core_y = jitter(rng, spec.room_depth * rng.choice([1.0, 1.7]))
    y = core_y + 2 * (w + t)
    rows = 2 if core_y >= TWO_ROWS else 1
    wall = _slots(spec) * spec.room_width - 2 * (west + east + y) + 2 * rows * v  # what x has to hold
    x = mm(max(wall / (2 + rows), 1.2 * spec.room_width + 2 * (v + t)))
    corridors = [(0, 0, x, w), (0, y - w, x, y), (0, 0, v, y), (x - v, 0, x, y)]
    strips = [
        Strip((-t - west, -t - south, x + t + east, -t), "n"),
        Strip((-t - west, y + t, x + t + east, y + t + north), "s"),
        Strip((-t - west, 0, -t, y), "e"),
        Strip((x + t, 0, x + t + east, y), "w"),
    ]
    return corridors, strips + _core((v + t, w + t, x - v - t, y - w - t), t, rng)


def _grid(spec: BuildingSpec, t: float, rng: np.random.Generator) -> tuple[list[Rect], list[Strip]]:
    """Streets and avenues of corridors; blocks of rooms between them and a row along two outsides."""
    w, t2 = jitter(rng, spec.corridor_width), 2 * t
    columns, rows, long = _blocks(spec)
    widths = [jitter(rng, long * spec.room_width) for _ in range(columns)]
    depths = [jitter(rng, 1.9 * spec.room_depth) for _ in range(rows)]
    xs = np.cumsum([0.0, *(a + w + t2 for a in widths)])  # west faces of the avenues
    ys = np.cumsum([0.0, *(d + w + t2 for d in depths)])
    corridors: list[Rect] = [(0.0, y, xs[-1] + w, y + w) for y in ys]
    corridors += [(x, 0.0, x + w, ys[-1] + w) for x in xs]
    strips = [
        strip
        for x, a in zip(xs, widths, strict=False)
        for y, d in zip(ys, depths, strict=False)
        for strip in _core((x + w + t, y + w + t, x + w + t + a, y + w + t + d), t, rng)
    ]
    south, north = jitter(rng, spec.room_depth), jitter(rng, spec.room_depth)
    strips.append(Strip((0, -t - south, xs[-1] + w, -t), "n"))
    strips.append(Strip((0, ys[-1] + w + t, xs[-1] + w, ys[-1] + w + t + north), "s"))
    return corridors, strips


def _blocks(spec: BuildingSpec) -> tuple[int, int, float]:
    """Columns and rows of blocks and rooms along a block, for about the wanted number of rooms."""
    return min(
        (
            (columns, rows, min(max(_slots(spec) / (2 * columns * (rows + 1)), 1.5), 9.0))
            for columns in range(2, 60)
            for rows in range(1, 60)
        ),
        key=lambda blocks: _oddness(spec, *blocks),
    )


def _oddness(spec: BuildingSpec, columns: int, rows: int, along: float) -> float:
    """How far a grid is from the wanted rooms, from four rooms along a block, and from 3 : 2 in plan."""
    rooms = 2 * columns * (rows + 1) * along
    x = columns * (along * spec.room_width + spec.corridor_width)
    y = rows * (1.9 * spec.room_depth + spec.corridor_width) + 2 * spec.room_depth
    return (
        3.0 * abs(math.log(rooms / _slots(spec)))
        + abs(math.log(along / ROOMS_A_BLOCK))
        + 0.7 * abs(math.log(x / y / ASPECT))
    )


def _flat(spec: BuildingSpec, t: float, rng: np.random.Generator) -> tuple[list[Rect], list[Strip]]:
    """A hallway with larger rooms on one side, smaller ones on the other, a living room across its end."""
    w = mm(min(jitter(rng, spec.corridor_width), rng.uniform(1.2, 1.6)))
    large, small = jitter(rng, min(spec.room_depth, 4.4)), jitter(rng, min(spec.room_depth, 3.0))
    length = max(jitter(rng, max(spec.rooms - 1, 2) / 2 * min(spec.room_width, 3.5)), 3.2)
    living = jitter(rng, 5.2)
    return [(0, 0, length, w)], [
        Strip((0, -t - small, length, -t), "n"),
        Strip((0, w + t, length, w + t + large), "s"),
        Strip((length + t, -t - small, length + t + living, w + t + large), "w"),
    ]


_Style = Callable[[BuildingSpec, float, np.random.Generator], tuple[list[Rect], list[Strip]]]
_STYLES: dict[str, _Style] = {
    "straight": _straight,
    "l": _l,
    "t": _t,
    "ring": _ring,
    "grid": _grid,
    "flat": _flat,
}

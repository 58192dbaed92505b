"""Where the text of a region goes: the largest variant that fits on free floor, at the best spot.

Free floor is the region without the swing of its doors, on the page. Of the spots where the text fits, the
one nearest to the region's centroid is taken: the middle of a room, the middle of a corridor's nearest arm.
What fits nowhere goes to the pole of inaccessibility. Unit-free: callers use page millimetres.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.exporters.svg_canvas import text_width

Float = NDArray[np.float64]

LEADING = 1.32  # line height over font size
SMALLEST = 0.64  # of the wanted size
LEVEL, TURNED = (1.0, 0.87, 0.76, 0.66), (1.0, 0.82)  # sizes to try: level text shrinks before it turns
BOLD = 1.1  # width of the bold name over that of the regular face
NEAREST = 64  # spots of which those with much room around come first
CENTRED = 2.0  # how much farther from the centroid a spot may lie for its distance from the walls
AT_ONCE = 16  # spots that are tried together: the first that fits is taken
GRID = 13  # candidate spots per side of the region's bounds


@dataclass(frozen=True)
class Line:
    """One line of a label."""

    text: str
    size: float
    style: str  # "name", "area" or "note"; the caller knows what it looks like


@dataclass(frozen=True)
class Placed:
    """A label that found its place; its centre is (x, y)."""

    lines: tuple[Line, ...]
    x: float
    y: float
    turned: bool  # reads upwards
    fits: bool


def block_size(lines: Sequence[Line]) -> tuple[float, float]:
    """Width and height of the lines set one under the other."""
    width = max(text_width(w.text, w.size) * (BOLD if w.style == "name" else 1.0) for w in lines)
    return width, sum(line.size * LEADING for line in lines)


def place(lines: Sequence[Line], free: Any, pad: float, floor: Any = None) -> Placed:
    """Put as many of ``lines`` as fit, from the first on, as large as fits, ``pad`` away from walls.

    ``free`` is a polygon inside ``floor``, whose corners tell where its arms run.
    """
    centre = shapely.get_coordinates(free.centroid)
    shapely.prepare(free)
    at_once = _try(tuple(lines), free, centre, pad, False)
    if at_once is not None:
        return at_once
    spots = _spots(free, free if floor is None else floor, centre)
    for count, turned, shrink in _tries(len(lines)):
        scaled = tuple(Line(w.text, w.size * shrink, w.style) for w in lines[:count])
        found = _try(scaled, free, spots, pad * shrink, turned)
        if found is not None:
            return found
    smallest = tuple(Line(w.text, w.size * SMALLEST, w.style) for w in lines[:1])
    x, y = _pole(free)
    return Placed(smallest, x, y, False, False)


def _tries(lines: int) -> list[tuple[int, bool, float]]:
    """Number of lines, turned or not, size: in the order of what reads best."""
    several = range(lines, min(lines, 2) - 1, -1)
    order = [(n, False, size) for n in several for size in LEVEL]
    order += [(n, True, size) for n in several for size in TURNED]
    return order + [(1, False, size) for size in (*LEVEL, SMALLEST)] + [(1, True, SMALLEST)]


def _try(lines: tuple[Line, ...], free: Any, spots: Float, pad: float, turned: bool) -> Placed | None:
    width, height = block_size(lines)
    half = np.array([height, width] if turned else [width, height]) / 2 + pad
    low, high = spots - half, spots + half
    x0, y0, x1, y1 = free.bounds
    within = (low[:, 0] > x0) & (low[:, 1] > y0) & (high[:, 0] < x1) & (high[:, 1] < y1)
    likely = np.flatnonzero(within)
    for first in range(0, len(likely), AT_ONCE):
        rows = likely[first : first + AT_ONCE]
        (a, b), (c, d) = low[rows].T, high[rows].T
        fits = shapely.contains_properly(free, shapely.box(a, b, c, d))
        if fits.any():
            x, y = spots[rows[int(np.argmax(fits))]].tolist()
            return Placed(lines, x, y, turned, True)
    return None


def _spots(free: Any, floor: Any, home: Float) -> Float:
    """(K, 2) candidate centres, nearest to ``home`` first, of these those with room around; ties by row."""
    corners = shapely.get_coordinates(floor)
    grid = np.stack(np.meshgrid(_ticks(corners[:, 0]), _ticks(corners[:, 1])), axis=-1).reshape(-1, 2)
    inside = grid[shapely.contains_xy(free, grid)]
    far = np.round(np.hypot(*(inside - home).T), 6)
    order = np.argsort(far, kind="stable")
    first = order[:NEAREST]
    room = shapely.distance(shapely.points(inside[first]), free.boundary)
    order[:NEAREST] = first[np.argsort(np.round(far[first] - CENTRED * room, 6), kind="stable")]
    return np.vstack([home, inside[order]])


def _ticks(values: Float) -> Float:
    """Evenly spread values, and those half way between corners: the middle of every arm."""
    edges = np.unique(values)
    spread = edges[0] + (np.arange(GRID) + 0.5) / GRID * (edges[-1] - edges[0])
    return np.unique(np.concatenate([spread, (edges[1:] + edges[:-1]) / 2]))


def _pole(free: Any) -> tuple[float, float]:
    """The pole of inaccessibility: the centre of the largest circle inside."""
    circle = shapely.maximum_inscribed_circle(free, tolerance=max(free.length / 500, 1e-6))
    x, y = circle.coords[0]
    return float(x), float(y)

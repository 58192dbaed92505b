"""Where the text of a region goes at every zoom: the widest free place near its middle.

A drawing on paper has one scale; a pane has all of them. So each region gets one spot with the room around
it in metres, once, and the pane decides while painting how much text fits there at its scale.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

Float = NDArray[np.float64]

ASPECT = 2.4  # width over height of a block of name and area, which then takes what room there is
GRID = 9  # candidate spots per side of the region's bounds
HALVINGS = 7  # of the search for the largest block: 1 % of the region
NEARLY = 0.8  # a spot nearer to the middle is taken if it has this share of the largest one's room
TURN = 2.0  # how much more room text needs to be turned: level text reads better


@dataclass(frozen=True)
class Spot:
    """The centre of a text block and the room that it has."""

    x: float  # metres, manhattan frame
    y: float
    width: float  # metres along the text
    height: float
    turned: bool  # reads upwards


def label_spot(polygon: Any, keep_off: Sequence[Any] = ()) -> Spot:
    """The spot in ``polygon`` (shapely) that lies on no geometry of ``keep_off``."""
    free = _free(polygon, keep_off)
    shapely.prepare(free)
    spots = _candidates(free, polygon)
    level, upright = (_best(free, spots, ratio) for ratio in (ASPECT, 1 / ASPECT))
    if level.width * TURN >= upright.height:
        return level
    return Spot(upright.x, upright.y, upright.height, upright.width, True)


def number_spot(polygon: Any, keep_off: Sequence[Any] = ()) -> Spot:
    """The middle of the widest place: a square of room for a number, never turned."""
    free = _free(polygon, keep_off)
    ends = shapely.get_coordinates(_widest(free))
    side = float(np.hypot(*(ends[1] - ends[0]))) * np.sqrt(2)
    return Spot(float(ends[0, 0]), float(ends[0, 1]), side, side, False)


def _widest(free: Any) -> Any:
    """A radius of the largest circle inside."""
    return shapely.maximum_inscribed_circle(free, tolerance=max(free.length / 500, 1e-6))


def _free(polygon: Any, keep_off: Sequence[Any]) -> Any:
    near = [shape for shape in keep_off if polygon.intersects(shape)]
    if not near:
        return polygon
    parts = shapely.get_parts(polygon.difference(shapely.union_all(near)))
    return max(parts, key=lambda part: part.area)


def _candidates(free: Any, polygon: Any) -> Float:
    """(K, 2) the centroid, the pole of inaccessibility, a grid and the middles of the arms, inside."""
    corners = shapely.get_coordinates(polygon)
    grid = np.stack(np.meshgrid(_ticks(corners[:, 0]), _ticks(corners[:, 1])), axis=-1).reshape(-1, 2)
    circle = shapely.get_coordinates(_widest(free))[:1]
    spots = np.vstack([shapely.get_coordinates(polygon.centroid), circle, grid])
    inside = spots[shapely.contains_xy(free, spots)]
    home = shapely.get_coordinates(polygon.centroid)[0]
    near = np.argsort(np.round(np.hypot(*(inside - home).T), 6), kind="stable")
    return np.asarray(inside[near], dtype=np.float64)


def _ticks(values: Float) -> Float:
    edges = np.unique(values)
    spread = edges[0] + (np.arange(GRID) + 0.5) / GRID * (edges[-1] - edges[0])
    return np.unique(np.concatenate([spread, (edges[1:] + edges[:-1]) / 2]))


def _best(free: Any, spots: Float, ratio: float) -> Spot:
    """The spot nearest to the middle (they are sorted) whose room is nearly the largest."""
    x0, y0, x1, y1 = free.bounds
    low, high = np.zeros(len(spots)), np.full(len(spots), min((x1 - x0) / ratio, y1 - y0))
    for _ in range(HALVINGS):
        height = (low + high) / 2
        half = np.column_stack([height * ratio, height]) / 2
        a, b = spots - half, spots + half
        fits = shapely.contains_properly(free, shapely.box(a[:, 0], a[:, 1], b[:, 0], b[:, 1]))
        low, high = np.where(fits, height, low), np.where(fits, high, height)
    k = int(np.argmax(low >= NEARLY * low.max()))
    x, y = spots[k].tolist()
    size = np.array([low[k] * ratio, low[k]])
    for axis, most in ((0, x1 - x0), (1, y1 - y0)):  # text is seldom as wide for its height as the block
        size[axis] = _grown(free, (x, y), size, axis, most)
    return Spot(x, y, float(size[0]), float(size[1]), False)


def _grown(free: Any, centre: tuple[float, float], size: Float, axis: int, most: float) -> float:
    """How far the block at ``centre`` reaches along one axis before it leaves ``free``."""
    low, high = float(size[axis]), most
    for _ in range(HALVINGS):
        half = size / 2
        half[axis] = (low + high) / 4
        fits = free.contains_properly(shapely.box(*(centre - half), *(centre + half)))
        low, high = ((low + high) / 2, high) if fits else (low, (low + high) / 2)
    return low

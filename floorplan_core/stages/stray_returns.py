"""Stray returns of a planar laser: points that float where its rays passed again and again.

A range that mixes what lies before and behind an edge hangs in the air; people walk by; a door is shut for a
while. In 3D such a return is alone in its column, a wall is not
(:mod:`~floorplan_core.stages.voxel_columns`). A planar scan is lifted to columns, so that a single return
stands from floor to ceiling, and a few in a doorway are a wall. There the rays tell: of the cells of true
walls 1 % were passed eight times as often as hit, of strays in a doorway most fifty times and more.
Cost: a few passes over the columns at one height.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.planar import LEVELS
from floorplan_core.geometry.ray_carving import MissMap
from floorplan_core.geometry.ray_steps import MOST
from floorplan_core.model import ManhattanFrame

Float = NDArray[np.float64]

_PASSED = 19  # rays through a cell for each that ended in it, from which what ended is stray
_HOLE = 2  # cells to a wall on both sides in line: what is passed so often between them is a wall, seen askew


def stray_returns(
    xyz: Float,
    count: NDArray[np.int32],
    misses: MissMap,
    frame: ManhattanFrame,
    grid: tuple[Float, float, tuple[int, int]],
) -> NDArray[np.bool_]:
    """(N,) True for the surfels of a lifted scan that lie where far more rays passed than ended.

    :param xyz: (N, 3) metres, manhattan frame, from the floor.
    :param count: (N,) points in each.
    :param grid: origin (2,), cell (metres) and shape (ny, nx) of the columns.
    """
    origin, cell, (ny, nx) = grid
    column = np.floor((xyz[:, :2] - origin) / cell).astype(np.int64)
    inside = ((column >= 0) & (column < (nx, ny))).all(axis=1)
    flat = np.where(inside, column[:, 1] * nx + column[:, 0], 0)
    hits = np.bincount(flat[inside], weights=count[inside], minlength=ny * nx) / LEVELS
    stray = np.zeros(ny * nx, dtype=bool)
    height = frame.floor_z + float(np.median(xyz[:, 2])) - cell / 2  # every level was passed by the same rays
    for few in range(1, MOST // _PASSED + 1, 2):  # two numbers of hits at a time
        least = few * _PASSED, min((few + 1) * _PASSED, MOST)
        passed = misses.column_bits(frame.rotation, origin, cell, (ny, nx), height, 1, least)
        for number, bits in zip((few, few + 1), passed, strict=True):
            stray |= (bits.ravel() > 0) & (hits > number - 1) & (hits <= number)
    firm = ((hits > 0) & ~stray).reshape(ny, nx)
    stray &= ~(_between(firm) | _between(firm.T).T).ravel()
    return np.asarray(stray[flat] & inside)


def _between(firm: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The cells with a firm one at most ``_HOLE`` cells away on both sides in their row, between them."""
    before, behind = firm.copy(), firm.copy()
    for step in range(1, _HOLE + 1):
        before[:, step:] |= firm[:, :-step]
        behind[:, :-step] |= firm[:, step:]
    return before & behind

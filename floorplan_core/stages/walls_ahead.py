"""How far a side of a room may go out before walls: hundreds of sides, each against all walls.

Runs of walls are sorted by facing. All in metres, manhattan frame; the facings are numbered as in
:class:`~floorplan_core.model.Facing`. Cost: sides times walls.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit

from floorplan_core.model import Facing, LayoutPlane

ON = 0.08  # m between a side and a plane on which it lies
DEEP = 0.15  # m: a wall less deep in the new part is its side
WALL = 0.3  # m of wall that counts
_FACES = 0.3  # share of a side that a wall ahead must face to close it


class WallsAhead:
    """The walls of a building, to look up what stops a side that goes out."""

    def __init__(self, planes: Sequence[LayoutPlane], thickness: float) -> None:
        runs = [(p.facing, p.offset, s, e) for p in planes for s, e in p.walls.tolist()]
        table = np.array(sorted(runs, key=lambda run: run[0]), dtype=np.float64).reshape(-1, 4)
        self._runs = np.ascontiguousarray(table[:, 1:])
        self._first = np.searchsorted(table[:, 0], np.arange(len(Facing) + 1))
        self._thickness = thickness

    def limits(self, facing: Facing, at: float, low: float, high: float) -> tuple[float, float]:
        """Metres to where a wall closes the room, and beyond which no side may go; infinite without any.

        A wall that faces much of the side closes it; any other keeps it from going on.
        """
        found: tuple[float, float] = _limits(
            self._runs, self._first, int(facing), at, low, high, self._thickness
        )
        return found


@njit(cache=True, nogil=True)
def _limits(runs, first, facing, at, low, high, thickness):  # type: ignore[no-untyped-def]
    """``runs`` (R, 3) offset, start, end; ``first`` (5,) where the rows of a facing begin."""
    axis, out, least = facing // 2, 2 * (facing % 2) - 1, min(WALL, (high - low) / 2)
    stop, limit = np.inf, np.inf
    for other in (facing, facing ^ 1):
        gap = 0.0 if other == facing else thickness
        for r in range(first[other], first[other + 1]):
            ahead = (runs[r, 0] - at) * out
            faced = min(runs[r, 2], high) - max(runs[r, 1], low)
            if ahead > ON and faced > least:
                limit = min(limit, ahead)
                if faced > _FACES * (high - low):
                    stop = min(stop, ahead - gap)
    for r in range(first[2 - 2 * axis], first[4 - 2 * axis]):
        near, far = runs[r, 1] - at, runs[r, 2] - at
        if out < 0:
            near, far = -far, -near
        near = max(near, 0.0)
        if low + DEEP < runs[r, 0] < high - DEEP and far - near > WALL:
            limit = min(limit, near)
    return stop, limit

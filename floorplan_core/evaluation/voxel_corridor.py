"""The length and the widths of the longest corridor, as a laser meter would read them, from voxels.

Independent of any plan: a corridor is a long straight line of sight along an axis of the voxels between two
surfaces that stand; of the lines about as long as the longest the median, since some pass a door at its end.
Its widths are read every metre along that line, across to the first surface on each side. A surface lies in
the middle of its voxel, so that each reading is good to about one voxel.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from floorplan_core.evaluation.truth import TruthDimension

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

CORRIDOR_LENGTH, CORRIDOR_WIDTH = "corridor-length", "corridor-width"  # how the dimensions are called
LEAST = 10.0  # m, and so many times its width: a shorter line of sight is no corridor
SLENDER = 4.0
SIMILAR = 0.8  # of the longest line of sight
EVERY = 1.0  # m between two readings of the width
USUAL = 0.25  # share of the median by which a reading may differ: more is a door, or furniture


def corridor_dimensions(free: Mask, standing: Mask, origin: Float, cell: float) -> tuple[TruthDimension, ...]:
    """``corridor-length``, then ``corridor-width-1`` and so on along it; () where there is no corridor.

    :param free: (ny, nx) cells that were seen free at the height of a body.
    :param standing: (ny, nx) cells that are surface over most of that height.
    """
    turned = corridor_sight(free.T, standing.T)
    straight = corridor_sight(free, standing)
    if max(straight[2] - straight[1], turned[2] - turned[1]) * cell < LEAST:
        return ()
    along = 0 if straight[2] - straight[1] >= turned[2] - turned[1] else 1  # ties: along x
    row, first, last = straight if along == 0 else turned
    grid, seen = (standing, free) if along == 0 else (standing.T, free.T)
    widths = _widths(grid, seen, row, first, last, max(1, round(EVERY / cell)))
    if not widths or (last - first) < SLENDER * np.median([b - a for _, a, b in widths]):
        return ()
    spans = [((first, row), (last, row)), *(((c, a), (c, b)) for c, a, b in widths)]
    names = [CORRIDOR_LENGTH, *(f"{CORRIDOR_WIDTH}-{k + 1}" for k in range(len(widths)))]
    return tuple(_dimension(n, *span, along, origin, cell) for n, span in zip(names, spans, strict=True))


def corridor_sight(free: Mask, standing: Mask) -> tuple[int, int, int]:
    """Row, first and last column of the corridor's line of sight.

    Free cells in a row between two standing ones, whose columns are given; (0, 0, 0) where there are none.
    The median of the longest lines; ties: the first row.
    """
    lines = []
    for row in range(len(free)):
        blocked = np.flatnonzero(~free[row] | standing[row])
        gaps = np.flatnonzero(np.diff(blocked) > 1)
        for first, last in zip(blocked[gaps].tolist(), blocked[gaps + 1].tolist(), strict=True):
            if standing[row, first] and standing[row, last]:
                lines.append((last - first, row, first, last))
    longest = max((line[0] for line in lines), default=0)
    similar = sorted(line for line in lines if line[0] >= SIMILAR * longest)
    return similar[(len(similar) - 1) // 2][1:] if similar else (0, 0, 0)


def _widths(
    standing: Mask, free: Mask, row: int, first: int, last: int, step: int
) -> list[tuple[int, int, int]]:
    """Column, lower and upper row of the surfaces on both sides, where they are as far apart as usual."""
    found = []
    for column in range(first + step, last, step):
        a, b = _next(standing[row::-1, column]), _next(standing[row:, column])
        if a and b and free[row - a + 1 : row + b, column].all():
            found.append((column, row - a, row + b))
    usual = float(np.median([b - a for _, a, b in found])) if found else 0.0
    return [(c, a, b) for c, a, b in found if abs(b - a - usual) <= USUAL * usual]


def _next(standing: Mask) -> int:
    """How many cells on the first standing one is; 0 where there is none."""
    at = np.flatnonzero(standing)
    return int(at[0]) if len(at) else 0


def _dimension(
    name: str, start: tuple[int, int], end: tuple[int, int], along: int, origin: Float, cell: float
) -> TruthDimension:
    """Between the middles of two cells (column, row), or (row, column) of a grid whose axes were swapped."""
    ends = [origin + cell * (np.array(at[:: 1 - 2 * along]) + 0.5) for at in (start, end)]
    (x0, y0), (x1, y1) = ends[0].tolist(), ends[1].tolist()
    return TruthDimension(name, (x0, y0), (x1, y1), float(np.hypot(x1 - x0, y1 - y0)))

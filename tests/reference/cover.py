"""The paper's rectangles and cover, word for word: every rectangle built, every ratio computed anew."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, product

import numpy as np

from floorplan_core.config import CandidatesConfig
from floorplan_core.model import CandidateSet, OccupancyGrid


def cells_inside(bounds, grid: OccupancyGrid) -> np.ndarray:
    """(ny, nx) True where the centre of a cell lies in the half-open rectangle."""
    ny, nx = grid.universe.shape
    x = grid.origin[0] + grid.cell * (np.arange(nx) + 0.5)
    y = grid.origin[1] + grid.cell * (np.arange(ny) + 0.5)
    x0, y0, x1, y1 = bounds
    return ((y >= y0) & (y < y1))[:, None] & ((x >= x0) & (x < x1))[None, :]


def all_cells(low: float, high: float, origin: float, cell: float) -> int:
    """Cells of an unbounded row with their centre in [low, high), one by one."""
    first = int(np.floor((low - origin) / cell)) - 2
    last = int(np.ceil((high - origin) / cell)) + 2
    return sum(low <= origin + cell * (i + 0.5) < high for i in range(first, last + 1))


def blocks(blocker, bounds, tol: float) -> bool:
    """True where the blocker lies in the interior of the rectangle, less ``tol`` on every side."""
    bx0, by0, bx1, by1 = blocker
    x0, y0, x1, y1 = bounds
    return bool(bx1 > x0 + tol and bx0 < x1 - tol and by1 > y0 + tol and by0 < y1 - tol)


def valid_rectangles(xp, xm, yp, ym, blockers, grid: OccupancyGrid, config: CandidatesConfig) -> list[tuple]:
    """(index, bounds, total, free, mask) of all valid members of R, in lexicographic order."""
    found = []
    for i0, i1, j0, j1 in product(range(len(xp)), range(len(xm)), range(len(yp)), range(len(ym))):
        bounds = (xp[i0], yp[j0], xm[i1], ym[j1])
        if not (bounds[0] < bounds[2] and bounds[1] < bounds[3]):
            continue
        if bounds[2] - bounds[0] < config.min_side or bounds[3] - bounds[1] < config.min_side:
            continue
        if any(blocks(b, bounds, config.tolerance) for b in blockers):
            continue
        total = all_cells(bounds[0], bounds[2], grid.origin[0], grid.cell) * all_cells(
            bounds[1], bounds[3], grid.origin[1], grid.cell
        )
        mask = cells_inside(bounds, grid) & grid.universe
        free = int(mask.sum())
        if free >= 1 and total <= config.max_ratio * free:
            found.append(((i0, i1, j0, j1), bounds, total, free, mask))
    return found


def plain_greedy(rectangles: list[tuple], universe: np.ndarray) -> list[tuple[int, int]]:
    """(row, newly covered cells) of each choice: least A / |R & D|, then largest A, then first."""
    left = universe & np.any([r[4] for r in rectangles], axis=0) if rectangles else np.zeros_like(universe)
    chosen = []
    while left.any():
        gains = [int((r[4] & left).sum()) for r in rectangles]
        best = min(
            (k for k, gain in enumerate(gains) if gain > 0),
            key=lambda k: (Fraction(rectangles[k][2], gains[k]), -rectangles[k][2], k),
        )
        chosen.append((best, gains[best]))
        left = left & ~rectangles[best][4]
    return chosen


def optimal_weight(rectangles: list[tuple], universe: np.ndarray) -> int:
    """Least total weight of a cover of all coverable cells, by trying all subsets."""
    goal = universe & np.any([r[4] for r in rectangles], axis=0) if rectangles else np.zeros_like(universe)
    weights = []
    for size in range(len(rectangles) + 1):
        for subset in combinations(rectangles, size):
            union = np.any([r[4] for r in subset], axis=0) if subset else np.zeros_like(universe)
            if (union & goal).sum() == goal.sum():
                weights.append(sum(r[2] for r in subset))
    return min(weights)


def array_greedy(candidates: CandidateSet, grid: OccupancyGrid) -> list[tuple[int, int]]:
    """The same choices for thousands of rectangles: every gain counted anew after each, with a table of sums.

    Ratios of whole numbers below 10^7 are equal as floats only where they are equal.
    """
    left = grid.universe.copy()
    index = candidates.index()
    order = np.lexsort(index.T[::-1])
    x0, y0, x1, y1 = candidates.bounds()[order].T
    total = _cells(x0, x1, grid.origin[0], grid.cell) * _cells(y0, y1, grid.origin[1], grid.cell)
    ny, nx = left.shape
    x = grid.origin[0] + grid.cell * (np.arange(nx) + 0.5)
    y = grid.origin[1] + grid.cell * (np.arange(ny) + 0.5)
    c0, c1, r0, r1 = (np.searchsorted(v, b) for v, b in ((x, x0), (x, x1), (y, y0), (y, y1)))
    chosen = []
    while True:
        table = np.pad(left.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
        gains = table[r1, c1] - table[r0, c1] - table[r1, c0] + table[r0, c0]
        if not gains.any():
            return chosen
        ratio = np.where(gains > 0, total / np.maximum(gains, 1), np.inf)
        best = int(np.lexsort([-total, ratio])[0])
        chosen.append((int(order[best]), int(gains[best])))
        left[r0[best] : r1[best], c0[best] : c1[best]] = False


def _cells(low: np.ndarray, high: np.ndarray, origin: float, cell: float) -> np.ndarray:
    """Cells of an unbounded row with their centre in [low, high), for many intervals."""
    first = int(np.floor((low.min(initial=0.0) - origin) / cell)) - 2
    last = int(np.ceil((high.max(initial=0.0) - origin) / cell)) + 2
    centres = origin + cell * (np.arange(first, last + 1) + 0.5)
    return np.searchsorted(centres, high) - np.searchsorted(centres, low)

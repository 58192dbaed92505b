"""Weighted set cover of the free space (section "Layout Estimation"), greedily as in the paper.

Universe: the cells of F_h that at least one candidate holds. Weight of rectangle R_i: A_i, all of its cells. With
D the cells not yet covered, the greedy choice minimises A_i / |R_i & D|; ties go to the larger A_i, then to the
rectangle that comes first by (i0, i1, j0, j1). It ends when D is empty; its weight is within a factor
H(d*) = O(log d*) of the optimum, d* being the free cells of the largest rectangle (Chvatal 1979).

Exactness. Ratios are compared as integers, A_1 d_2 < A_2 d_1. |R_i & D| only ever falls, so a ratio computed
earlier is a lower bound: the first rectangle of a heap whose stale ratio is still true is the greedy choice.

Cost. D is held on coordinate-compressed cells (between neighbouring planes everything is covered together), so
|R_i & D| is a sum over few numbers, and only rectangles that reach the top are ever counted again.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import CoverConfig
from floorplan_core.geometry.summed_area import first_cells, summed_area
from floorplan_core.model import CandidateSet, OccupancyGrid, RectangleCover
from floorplan_core.observer import Observer

Int = NDArray[np.int64]
Index = NDArray[np.int32]
_kernel = njit(cache=True, nogil=True)


def cover(
    candidates: CandidateSet, grid: OccupancyGrid, config: CoverConfig, observer: Observer | None = None
) -> RectangleCover:
    """Cover the free cells by the solver that ``config.solver`` names."""
    if config.solver == "exact":
        from floorplan_core.stages.exact_cover import exact_cover  # scipy.optimize is slow to import

        return exact_cover(candidates, grid, config, observer)
    return greedy_cover(candidates, grid, config, observer)


def greedy_cover(
    candidates: CandidateSet, grid: OccupancyGrid, config: CoverConfig, observer: Observer | None = None
) -> RectangleCover:
    """The paper's greedy cover of every free cell that a candidate holds; the others are ``uncovered``."""
    if observer is not None:
        observer.check_cancelled()
    spans, weights = compress(candidates, grid)
    chosen, gained = _greedy(spans, candidates.total_cells, weights, summed_area_of(weights))
    return make_cover(candidates, grid, chosen, gained)


def compress(candidates: CandidateSet, grid: OccupancyGrid) -> tuple[Index, Int]:
    """Coordinate compression: (K, 4) a, b, c, d and (nx', ny') free cells between neighbouring planes.

    Rectangle ``k`` holds the compressed cells [a, b) x [c, d), first index along x. Parts beyond the grid are cut
    off: they are never free.
    """
    ny, nx = grid.universe.shape
    a, b, columns = _slots(candidates.x_plus, candidates.x_minus, float(grid.origin[0]), grid.cell, nx)
    c, d, rows = _slots(candidates.y_plus, candidates.y_minus, float(grid.origin[1]), grid.cell, ny)
    table = summed_area(grid.universe)[np.ix_(rows, columns)]
    i = candidates.index
    spans = np.column_stack([a[i[:, 0]], b[i[:, 1]], c[i[:, 2]], d[i[:, 3]]]).astype(np.int32)
    return spans, np.ascontiguousarray(np.diff(np.diff(table, axis=0), axis=1).T)


def _slots(
    plus: NDArray[np.float64], minus: NDArray[np.float64], origin: float, cell: float, n: int
) -> tuple[Int, Int, Int]:
    """Compressed index of every plus and minus plane, and the cell that each compressed index stands for."""
    cells = np.clip(first_cells(np.concatenate([plus, minus]), origin, cell), 0, n)
    lines, slot = np.unique(cells, return_inverse=True)
    return slot[: len(plus)], slot[len(plus) :], lines


def summed_area_of(weights: Int) -> Int:
    """(nx' + 1, ny' + 1) summed-area table of compressed cells."""
    return np.pad(weights, ((1, 0), (1, 0))).cumsum(axis=0).cumsum(axis=1)


def make_cover(
    candidates: CandidateSet, grid: OccupancyGrid, chosen: Int, gained: Int | None = None
) -> RectangleCover:
    """The cover by the given rows of the candidate set; ``gained`` is counted in their order where not given."""
    bounds = candidates.bounds()[chosen]
    columns = first_cells(bounds[:, [0, 2]].ravel(), float(grid.origin[0]), grid.cell).reshape(-1, 2)
    rows = first_cells(bounds[:, [1, 3]].ravel(), float(grid.origin[1]), grid.cell).reshape(-1, 2)
    uncovered = grid.universe.copy()
    counted = np.zeros(len(chosen), dtype=np.int64)
    for k, (c, r) in enumerate(zip(np.maximum(columns, 0), np.maximum(rows, 0), strict=True)):
        block = uncovered[r[0] : r[1], c[0] : c[1]]
        counted[k] = np.count_nonzero(block)
        block[...] = False
    return RectangleCover(
        chosen,
        bounds,
        candidates.total_cells[chosen],
        candidates.free_cells[chosen],
        counted if gained is None else gained,
        uncovered,
    )


@_kernel
def _greedy(spans: Index, total: Int, weights: Int, table: Int) -> tuple[Int, Int]:
    """Rows chosen, in order, and the cells that each newly covered."""
    gain = np.empty(len(spans), np.int64)
    for k in range(len(spans)):
        a, b, c, d = spans[k]
        gain[k] = table[b, d] - table[a, d] - table[b, c] + table[a, c]
    left = weights.copy()
    missing = _coverable(spans, weights)
    heap = np.arange(len(spans))
    size = len(heap)
    for at in range(size // 2 - 1, -1, -1):
        _sift_down(heap, size, at, total, gain)
    chosen, gained, n = np.empty(len(spans), np.int64), np.empty(len(spans), np.int64), 0
    while missing > 0:
        k = heap[0]
        now = _remaining(left, spans[k])
        if now == gain[k]:
            chosen[n], gained[n] = k, now
            n += 1
            missing -= now
            a, b, c, d = spans[k]
            left[a:b, c:d] = 0
            now = 0
        gain[k] = now
        if now == 0:
            size -= 1
            heap[0] = heap[size]
        _sift_down(heap, size, 0, total, gain)
    return chosen[:n].copy(), gained[:n].copy()


@_kernel
def _coverable(spans: Index, weights: Int) -> int:
    """Free cells in at least one rectangle, by a difference array over the compressed cells."""
    depth = np.zeros((weights.shape[0] + 1, weights.shape[1] + 1), np.int64)
    for k in range(len(spans)):
        a, b, c, d = spans[k]
        depth[a, c] += 1
        depth[b, d] += 1
        depth[a, d] -= 1
        depth[b, c] -= 1
    height = np.zeros(weights.shape[1], np.int64)
    cells = 0
    for x in range(weights.shape[0]):
        run = 0  # change of the number of rectangles from (x - 1, y) to (x, y)
        for y in range(weights.shape[1]):
            run += depth[x, y]
            height[y] += run
            if height[y] > 0:
                cells += weights[x, y]
    return cells


@_kernel
def _remaining(left: Int, span: Index) -> int:
    """|R & D|."""
    count = 0
    for x in range(span[0], span[1]):
        for y in range(span[2], span[3]):
            count += left[x, y]
    return count


@_kernel
def _precedes(k: int, m: int, total: Int, gain: Int) -> bool:
    """True where the greedy choice prefers rectangle k to m: smaller ratio, larger A, smaller index."""
    left, right = total[k] * gain[m], total[m] * gain[k]
    if left != right:
        return left < right
    if total[k] != total[m]:
        return total[k] > total[m]
    return k < m


@_kernel
def _sift_down(heap: Int, size: int, at: int, total: Int, gain: Int) -> None:
    """Restore the heap below position ``at``."""
    moved = heap[at]
    while True:
        child = 2 * at + 1
        if child >= size:
            break
        if child + 1 < size and _precedes(heap[child + 1], heap[child], total, gain):
            child += 1
        if not _precedes(heap[child], moved, total, gain):
            break
        heap[at] = heap[child]
        at = child
    heap[at] = moved

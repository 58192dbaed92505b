"""Weighted set cover of the free space (section "Layout Estimation"), greedily as in the paper.

Universe: the cells of F_h that at least one candidate holds. Weight of rectangle R_i: A_i, all of its cells.
With D the cells not yet covered, the greedy choice minimises A_i / |R_i & D|; ties go to the larger A_i,
then to the rectangle that comes first by (i0, i1, j0, j1). It ends when D is empty; its weight is within a
factor H(d*) = O(log d*) of the optimum, d* being the free cells of the largest rectangle (Chvatal 1979).

How the choice stays exact and fast is told in :mod:`floorplan_core.stages.lazy_greedy`.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import CoverConfig
from floorplan_core.geometry.summed_area import first_cells, summed_area
from floorplan_core.model import CandidateSet, OccupancyGrid, RectangleCover
from floorplan_core.observer import Observer
from floorplan_core.stages.lazy_greedy import lazy_greedy

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
    chosen, gained = lazy_greedy(spans, *_neighbours(candidates), candidates.total_cells, weights)
    return make_cover(candidates, grid, chosen, gained)


def compress(candidates: CandidateSet, grid: OccupancyGrid) -> tuple[Index, Int]:
    """Coordinate compression: (K, 4) a, b, c, d and (nx', ny') free cells between neighbouring planes.

    Rectangle ``k`` holds the compressed cells [a, b) x [c, d), first index along x. Parts beyond the grid are
    cut off: they are never free.
    """
    ny, nx = grid.universe.shape
    a, b, columns = _slots(candidates.x_plus, candidates.x_minus, float(grid.origin[0]), grid.cell, nx)
    c, d, rows = _slots(candidates.y_plus, candidates.y_minus, float(grid.origin[1]), grid.cell, ny)
    table = summed_area(grid.universe)[np.ix_(rows, columns)]
    weights = np.ascontiguousarray(np.diff(np.diff(table, axis=0), axis=1).T)
    return _gather(candidates.index, a, b, c, d), weights


@_kernel
def _gather(index: Index, a: Int, b: Int, c: Int, d: Int) -> Index:
    """(K, 4) a[i0], b[i1], c[j0], d[j1]."""
    out = np.empty((len(index), 4), np.int32)
    for k in range(len(index)):
        out[k, 0], out[k, 1] = a[index[k, 0]], b[index[k, 1]]
        out[k, 2], out[k, 3] = c[index[k, 2]], d[index[k, 3]]
    return out


def _slots(
    plus: NDArray[np.float64], minus: NDArray[np.float64], origin: float, cell: float, n: int
) -> tuple[Int, Int, Int]:
    """Compressed index of every plus and minus plane, and the cell that each compressed index stands for."""
    cells = np.clip(first_cells(np.concatenate([plus, minus]), origin, cell), 0, n)
    lines, slot = np.unique(cells, return_inverse=True)
    return slot[: len(plus)], slot[len(plus) :], lines


def _neighbours(candidates: CandidateSet) -> tuple[Int, Int]:
    """(K,) one number for each (i0, i1, j0, j1), and what to add to it for one plane further out.

    The digits get a place more than they have values, so that no step can carry into the next digit
    unnoticed.
    """
    planes = (candidates.x_plus, candidates.x_minus, candidates.y_plus, candidates.y_minus)
    place = np.cumprod([1] + [len(p) + 2 for p in planes[:0:-1]])[::-1]
    return (candidates.index + 1) @ place, place * np.array([-1, 1, -1, 1])  # plus: down, minus: up


def make_cover(
    candidates: CandidateSet, grid: OccupancyGrid, chosen: Int, gained: Int | None = None
) -> RectangleCover:
    """The cover by the given rows of the candidate set; ``gained`` is counted in their order if not given."""
    i0, i1, j0, j1 = candidates.index[chosen].T
    sides = (candidates.x_plus[i0], candidates.y_plus[j0], candidates.x_minus[i1], candidates.y_minus[j1])
    bounds = np.column_stack(sides).astype(np.float64).reshape(-1, 4)
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

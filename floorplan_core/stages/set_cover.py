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
from floorplan_core.geometry.summed_area import block_counts, first_cells
from floorplan_core.model import CandidateSet, OccupancyGrid, RectangleCover
from floorplan_core.observer import Observer
from floorplan_core.stages.cover_components import components
from floorplan_core.stages.lazy_greedy import Sides, lazy_greedy

Int = NDArray[np.int64]
Index = NDArray[np.int32]


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
    cells, slots, weights = compress(candidates, grid)
    f = candidates.families
    largest = spans_of(np.column_stack([f[:, 0], f[:, 3] - 1, f[:, 1], f[:, 5] - 1]), slots)
    picks, gained = lazy_greedy(f, cells, slots, weights, *components(largest, weights))
    own = f[picks[:, 4]]
    within = (picks[:, 1] - own[:, 2]) * (own[:, 5] - own[:, 4]) + picks[:, 3] - own[:, 4]
    sizes = candidates.family_sizes()
    chosen = (np.cumsum(sizes) - sizes)[picks[:, 4]] + within
    return make_cover(candidates, grid, chosen, picks[:, :4], gained)


def compress(candidates: CandidateSet, grid: OccupancyGrid) -> tuple[Sides, Sides, Int]:
    """Coordinate compression: what lies between two neighbouring planes is one compressed cell.

    :return: for x+, x-, y+ and y- planes their first cells, which may lie beyond the grid, and their first
        compressed cells; (nx', ny') free cells of each compressed cell, first index along x. Parts beyond the
        grid are cut off: they are never free.
    """
    ny, nx = grid.universe.shape
    x_cells, x_slots, columns = _slots((candidates.x_plus, candidates.x_minus), grid.origin[0], grid.cell, nx)
    y_cells, y_slots, rows = _slots((candidates.y_plus, candidates.y_minus), grid.origin[1], grid.cell, ny)
    weights = np.ascontiguousarray(block_counts(grid.universe, rows, columns).T)
    return (*x_cells, *y_cells), (*x_slots, *y_slots), weights


def _slots(
    planes: tuple[NDArray[np.float64], NDArray[np.float64]], origin: float, cell: float, n: int
) -> tuple[tuple[Int, Int], tuple[Int, Int], Int]:
    """First cells and compressed indices of plus and minus planes, and the cell of each compressed index."""
    cells = first_cells(np.concatenate(planes), float(origin), cell)
    lines, slot = np.unique(np.clip(cells, 0, n), return_inverse=True)
    plus = len(planes[0])
    return (cells[:plus], cells[plus:]), (slot[:plus], slot[plus:]), lines


def spans_of(index: Int | Index, places: Sides) -> Int:
    """(K, 4) places a, b, c, d of the planes of rectangles (K, 4) i0, i1, j0, j1."""
    return np.column_stack([place[index[:, side]] for side, place in enumerate(places)])


def make_cover(
    candidates: CandidateSet,
    grid: OccupancyGrid,
    chosen: Int,
    index: Int | None = None,
    gained: Int | None = None,
) -> RectangleCover:
    """The cover by the given rows of the candidate set.

    :param index: (C, 4) i0, i1, j0, j1 of these rows; listed if not given.
    :param gained: cells that each covers first; counted in the order of the rows if not given.
    """
    i0, i1, j0, j1 = (candidates.index()[chosen] if index is None else index).T
    sides = (candidates.x_plus[i0], candidates.y_plus[j0], candidates.x_minus[i1], candidates.y_minus[j1])
    bounds = np.column_stack(sides).astype(np.float64).reshape(-1, 4)
    columns = first_cells(bounds[:, [0, 2]].ravel(), float(grid.origin[0]), grid.cell).reshape(-1, 2)
    rows = first_cells(bounds[:, [1, 3]].ravel(), float(grid.origin[1]), grid.cell).reshape(-1, 2)
    total = (columns[:, 1] - columns[:, 0]) * (rows[:, 1] - rows[:, 0])
    uncovered = grid.universe.copy()
    free, counted = _take_out(grid.universe, uncovered, np.maximum(rows, 0), np.maximum(columns, 0))
    return RectangleCover(chosen, bounds, total, free, counted if gained is None else gained, uncovered)


@njit(cache=True, nogil=True)
def _take_out(
    universe: NDArray[np.bool_], uncovered: NDArray[np.bool_], rows: Int, columns: Int
) -> tuple[Int, Int]:
    """Free cells of each rectangle, and those that no rectangle before it held; clears these."""
    free, gained = np.zeros(len(rows), np.int64), np.zeros(len(rows), np.int64)
    for k in range(len(rows)):
        for r in range(rows[k, 0], min(rows[k, 1], universe.shape[0])):
            for c in range(columns[k, 0], min(columns[k, 1], universe.shape[1])):
                free[k] += universe[r, c]
                gained[k] += uncovered[r, c]
                uncovered[r, c] = False
    return free, gained

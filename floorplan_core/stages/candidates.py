"""Candidate rectangles (section "Layout Estimation"): the valid members of R = Px x Py, without building R.

Px = X+ x X- pairs every east-facing plane with every west-facing one, Py likewise in y. A rectangle
x0, y0, x1, y1 of two such pairs is *valid* when

1. its pairs face inward (x0 < x1, y0 < y1) and both sides are at least ``min_side`` long;
2. no blocker (a wall that was seen, a door) lies in its interior. Blocker [bx0, bx1] x [by0, by1] does iff
   ``bx1 > x0 + tol and bx0 < x1 - tol`` and the same in y. Both comparisons are strict, so a wall exactly
   ``tol`` from a side is still on it, and a blocker without thickness (a line) blocks like any other;
3. it holds at least one free cell of the universe, and ``total_cells <= max_ratio * free_cells``.
   A cell belongs to the rectangle that holds its centre, half-open: x0 <= centre < x1. Cells beyond the
   grid count as unobserved: they are part of the total and never free.

Cost. Blocking is monotone: of the four comparisons each involves one side only, so that blocker b is four
integers (qx, kx, qy, ky) and blocks (i0, i1, j0, j1) iff ``i0 < qx and i1 >= kx and j0 < qy and j1 >= ky``.
For one i0, let i1 grow: blockers only join, and the number ``limit[j0]`` of the y_minus that j0 may pair with
only falls. Every j0 whose range of j1 is empty, or can hold no free cells any more, leaves the sweep for
good; when none is left the sweep of this i0 ends. What is visited is in essence what is returned.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import CandidatesConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.summed_area import first_cells, summed_area
from floorplan_core.model import CandidateSet, Facing, LayoutPlane, OccupancyGrid
from floorplan_core.observer import Observer

Float = NDArray[np.float64]
Int = NDArray[np.int64]
Index = NDArray[np.int32]
Tables = tuple[Int, Int, Int]  # columns, rows, free cells: see _cell_tables


def enumerate_candidates(
    x_plus: Float,
    x_minus: Float,
    y_plus: Float,
    y_minus: Float,
    blockers: Float,
    grid: OccupancyGrid,
    config: CandidatesConfig,
    observer: Observer | None = None,
) -> CandidateSet:
    """All valid rectangles between the given layout planes, ordered by (i0, i1, j0, j1).

    :param x_plus: (P,) sorted offsets of east-facing planes, metres; x_minus, y_plus, y_minus: of west-,
        north- and south-facing ones.
    :param blockers: (B, 4) x0, y0, x1, y1 of walls and doors, metres, manhattan frame; may be lines.
    :param grid: gives the universe of free cells.
    :return: the valid rectangles; ``enumerated`` is |X+| |X-| |Y+| |Y-|, the size of the paper's R.
    :raises NoPlanError: if more than ``config.max_count`` rectangles are valid.
    """
    planes = [np.asarray(p, dtype=np.float64) for p in (x_plus, x_minus, y_plus, y_minus)]
    observer = observer or Observer()
    observer.check_cancelled()
    first = (
        _first_partner(planes[0], planes[1], config.min_side),
        _first_partner(planes[2], planes[3], config.min_side),
    )
    blocked = _index_blockers(planes, blockers, config.tolerance)
    tables = _cell_tables(planes, grid)
    # Counting first costs less than growing the arrays, and refuses a hopeless case before memory is spent.
    size = _sweep(*first, blocked, tables, config.max_ratio, *_room_for(0))
    if size > config.max_count:
        raise NoPlanError(_too_many(size, planes, config.max_count))
    observer.check_cancelled()
    index, cells = _room_for(size)
    _sweep(*first, blocked, tables, config.max_ratio, index, cells)
    enumerated = int(np.prod([len(p) for p in planes], dtype=object))
    total, free = np.ascontiguousarray(cells[:, 0]), np.ascontiguousarray(cells[:, 1])
    return CandidateSet(planes[0], planes[1], planes[2], planes[3], index, total, free, enumerated)


def pair_planes(
    planes: Sequence[LayoutPlane],
    blockers: Float,
    grid: OccupancyGrid,
    config: CandidatesConfig,
    observer: Observer | None = None,
) -> CandidateSet:
    """All valid rectangles between ``planes``, by facing; see :func:`enumerate_candidates`."""
    east, west, north, south = (
        np.unique([p.offset for p in planes if p.facing == facing]) for facing in Facing
    )
    return enumerate_candidates(east, west, north, south, blockers, grid, config, observer)


def _room_for(size: int) -> tuple[Index, Int]:
    """Empty arrays for ``size`` rectangles: their indices, and their total and free cells."""
    return np.empty((size, 4), np.int32), np.empty((size, 2), np.int64)


def _too_many(size: int, planes: list[Float], allowed: int) -> str:
    """The sentence for a plan with too many valid rectangles."""
    counts = ", ".join(str(len(p)) for p in planes)
    return (
        f"{size} rectangles fit between the {counts} planes that face east, west, north and south, more than "
        f"the {allowed} of candidates.max_count; raise planes.min_support or lower candidates.max_ratio."
    )


def _first_partner(plus: Float, minus: Float, min_side: float) -> Int:
    """(P,) for every plus plane the index of the first minus plane at least ``min_side`` beyond it.

    Searched with the very expression ``minus - plus >= min_side``: rounding is monotone, so that the partners
    are all planes from there on.
    """
    return np.array([np.searchsorted(minus - p, min_side, side="left") for p in plus], dtype=np.int64)


def _index_blockers(planes: list[Float], blockers: Float, tolerance: float) -> Int:
    """(B, 4) qx, kx, qy, ky of the blockers that can block anything, without repetition, sorted by kx."""
    box = np.asarray(blockers, dtype=np.float64).reshape(-1, 4)
    x0, x1 = np.minimum(box[:, 0], box[:, 2]), np.maximum(box[:, 0], box[:, 2])
    y0, y1 = np.minimum(box[:, 1], box[:, 3]), np.maximum(box[:, 1], box[:, 3])
    index = np.column_stack(
        [
            np.searchsorted(planes[0] + tolerance, x1, side="left"),  # i0 < qx: x0 + tol < bx1
            np.searchsorted(planes[1] - tolerance, x0, side="right"),  # i1 >= kx: x1 - tol > bx0
            np.searchsorted(planes[2] + tolerance, y1, side="left"),
            np.searchsorted(planes[3] - tolerance, y0, side="right"),
        ]
    ).astype(np.int64)
    useful = (index[:, 0] > 0) & (index[:, 1] < len(planes[1]))
    useful &= (index[:, 2] > 0) & (index[:, 3] < len(planes[3]))
    index = np.unique(index[useful], axis=0)
    return np.ascontiguousarray(index[np.argsort(index[:, 1], kind="stable")])


def _cell_tables(planes: list[Float], grid: OccupancyGrid) -> Tables:
    """First cells of the x and of the y planes (plus, then minus), and the free cells below each crossing.

    The last is the summed-area table sampled at the planes, [x plane, y plane]: small enough for the cache.
    """
    ny, nx = grid.universe.shape
    columns = first_cells(np.concatenate(planes[:2]), float(grid.origin[0]), grid.cell)
    rows = first_cells(np.concatenate(planes[2:]), float(grid.origin[1]), grid.cell)
    table = summed_area(grid.universe)[np.ix_(np.clip(rows, 0, ny), np.clip(columns, 0, nx))]
    return columns, rows, np.ascontiguousarray(table.T)


_kernel = njit(cache=True, nogil=True)


@_kernel
def _sweep(
    first_i1: Int, first_j1: Int, blockers: Int, tables: Tables, ratio: float, index: Index, cells: Int
) -> int:
    """Number of valid rectangles; they are written to ``index`` and ``cells`` as far as these reach."""
    m_plus, m_minus = len(first_j1), len(tables[1]) - len(first_j1)
    limit, wake, alive = np.empty(m_plus, np.int64), np.empty(m_plus, np.int64), np.empty(m_plus, np.int64)
    blockers = blockers.copy()
    n_blockers, size = len(blockers), 0
    for i0 in range(len(first_i1)):
        n_blockers = _drop_passed(blockers, n_blockers, i0)
        limit[:] = m_minus
        wake[:] = 0
        alive[:] = np.arange(m_plus)
        n_alive, b = m_plus, 0
        for i1 in range(first_i1[i0], len(tables[0]) - len(first_i1)):
            while b < n_blockers and blockers[b, 1] <= i1:
                _lower_limits(limit, blockers[b, 2], blockers[b, 3])
                b += 1
            x_pair = (i0, i1, i0, len(first_i1) + i1)
            n_alive = _keep_alive(x_pair, alive, n_alive, limit, wake, first_j1, tables, ratio)
            size = _emit(x_pair, alive, n_alive, limit, wake, first_j1, tables, ratio, index, cells, size)
            if n_alive == 0:
                break
    return size


@_kernel
def _drop_passed(blockers: Int, n: int, i0: int) -> int:
    """Keep the blockers right of plane i0 (i0 < qx), in order; the others matter to no later i0 either."""
    kept = 0
    for b in range(n):
        if blockers[b, 0] > i0:
            blockers[kept] = blockers[b]
            kept += 1
    return kept


@_kernel
def _lower_limits(limit: Int, q: int, k: int) -> None:
    """Every j0 < q pairs with j1 < k only; ``limit`` never decreases along j0, so the walk may stop."""
    j = q - 1
    while j >= 0 and limit[j] > k:
        limit[j] = k
        j -= 1


@_kernel
def _free(table: Int, a: int, b: int, c: int, d: int) -> int:
    """Free cells between the x planes a, b and the y planes c, d (rows and columns of the sampled table)."""
    return int(table[b, d] - table[a, d] - table[b, c] + table[a, c])


@_kernel
def _first_seen(table: Int, a: int, b: int, c: int, d: int) -> int:
    """First x plane from b on whose rectangle a, ., c, d holds a free cell; len(table) if there is none."""
    end = len(table)
    while b < end:
        middle = (b + end) // 2
        if _free(table, a, middle, c, d) > 0:
            end = middle
        else:
            b = middle + 1
    return b


@_kernel
def _keep_alive(
    x_pair: tuple[int, int, int, int],
    alive: Int,
    n_alive: int,
    limit: Int,
    wake: Int,
    first_j1: Int,
    tables: Tables,
    ratio: float,
) -> int:
    """Take out every j0 without a rectangle from i1 on; others sleep until ``wake`` sees free cells."""
    columns, rows, table = tables
    _, _, a, b = x_pair
    m_plus, kept = len(first_j1), 0
    for n in range(n_alive):
        j0 = alive[n]
        if first_j1[j0] >= limit[j0]:
            continue
        top = m_plus + limit[j0] - 1
        if wake[j0] <= b and _free(table, a, b, j0, top) == 0:
            wake[j0] = _first_seen(table, a, b + 1, j0, top)
        # All that is free here up to the last plane bounds every later count; the area only grows.
        smallest = (columns[b] - columns[a]) * (rows[m_plus + first_j1[j0]] - rows[j0])
        if wake[j0] < len(table) and smallest <= ratio * _free(table, a, len(table) - 1, j0, top):
            alive[kept] = j0
            kept += 1
    return kept


@_kernel
def _emit(
    x_pair: tuple[int, int, int, int],
    alive: Int,
    n_alive: int,
    limit: Int,
    wake: Int,
    first_j1: Int,
    tables: Tables,
    ratio: float,
    index: Index,
    cells: Int,
    size: int,
) -> int:
    """Write the valid rectangles of one x pair; returns how many there are by now."""
    columns, rows, table = tables
    i0, i1, a, b = x_pair
    m_plus, width = len(first_j1), columns[b] - columns[a]
    for n in range(n_alive):
        j0 = alive[n]
        if wake[j0] > b:
            continue
        most = ratio * _free(table, a, b, j0, m_plus + limit[j0] - 1)
        for j1 in range(first_j1[j0], limit[j0]):
            total = width * (rows[m_plus + j1] - rows[j0])
            if total > most:
                break  # the area only grows with j1
            free = _free(table, a, b, j0, m_plus + j1)
            if free == 0 or total > ratio * free:
                continue
            if size < len(index):
                index[size, 0], index[size, 1], index[size, 2], index[size, 3] = i0, i1, j0, j1
                cells[size, 0], cells[size, 1] = total, free
            size += 1
    return size

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

Families. A corridor that n planes cross holds n^2 rectangles, which are not listed one by one either. The
valid rectangles come as *families*: one lower corner (i0, j0) with a range of i1 times a range of j1, all
of them valid (:class:`floorplan_core.model.CandidateSet`). Their number grows with the number of corners,
that is with the area, not with the square of the length of corridors.

Cost. Blocking is monotone: of the four comparisons each involves one side only, so that blocker b is four
integers (qx, kx, qy, ky) and blocks (i0, i1, j0, j1) iff ``i0 < qx and i1 >= kx and j0 < qy and j1 >= ky``.
For one i0, let i1 grow: blockers only join, and the number ``limit[j0]`` of the y_minus that j0 may pair with
only falls. Between two falls the unblocked rectangles of a corner are a block of i1 times j1; blocks that are
not valid throughout are halved until their parts are, or hold nothing valid.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import CandidatesConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.summed_area import block_counts, first_cells
from floorplan_core.model import CandidateSet, Facing, LayoutPlane, OccupancyGrid
from floorplan_core.observer import Observer

Float = NDArray[np.float64]
Int = NDArray[np.int64]
Index = NDArray[np.int32]
Tables = tuple[Int, Int, Int, int, int]  # columns, rows, free cells, |X+|, |Y+|: see _cell_tables
Block = tuple[int, int, int, int, int, int]  # i0, j0, first and end of i1, first and end of j1
ROOM = 3  # families a corner for which there is room at first
SURE = 1e-9  # more than any rounding of a bound: whoever is nearer to it is looked at one by one
STACK = 128  # halvings of two ranges of 32 bits


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
    """All valid rectangles between the given layout planes, in families.

    :param x_plus: (P,) sorted offsets of east-facing planes, metres; x_minus, y_plus, y_minus: of west-,
        north- and south-facing ones.
    :param blockers: (B, 4) x0, y0, x1, y1 of walls and doors, metres, manhattan frame; may be lines.
    :param grid: gives the universe of free cells.
    :return: the valid rectangles; ``enumerated`` is |X+| |X-| |Y+| |Y-|, the size of the paper's R.
    :raises NoPlanError: if more than ``config.max_count`` rectangles are valid.
    """
    planes = [np.asarray(p, dtype=np.float64) for p in (x_plus, x_minus, y_plus, y_minus)]
    if observer is not None:
        observer.check_cancelled()
    first = (
        _first_partner(planes[0], planes[1], config.min_side),
        _first_partner(planes[2], planes[3], config.min_side),
    )
    blocked = _index_blockers(planes, blockers, config.tolerance)
    tables = _cell_tables(planes, grid)
    families = np.empty((ROOM * len(planes[0]) * len(planes[2]), 6), np.int32)
    count, size = _sweep(*first, blocked, tables, config.max_ratio, families)
    if size > config.max_count:
        raise NoPlanError(_too_many(size, planes, config.max_count))
    if count > len(families):
        families = np.empty((count, 6), np.int32)
        _sweep(*first, blocked, tables, config.max_ratio, families)
    enumerated = int(np.prod([len(p) for p in planes], dtype=object))
    return CandidateSet(planes[0], planes[1], planes[2], planes[3], families[:count].copy(), enumerated)


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
    x_lines, x_slot = np.unique(np.clip(columns, 0, nx), return_inverse=True)
    y_lines, y_slot = np.unique(np.clip(rows, 0, ny), return_inverse=True)
    below = np.zeros((len(y_lines), len(x_lines)), dtype=np.int64)
    below[1:, 1:] = block_counts(grid.universe, y_lines, x_lines).cumsum(axis=0).cumsum(axis=1)
    table = np.ascontiguousarray(below[np.ix_(y_slot, x_slot)].T)
    return columns, rows, table, len(planes[0]), len(planes[2])


_kernel = njit(cache=True, nogil=True)


@_kernel
def _sweep(
    first_i1: Int, first_j1: Int, blockers: Int, tables: Tables, ratio: float, out: Index
) -> tuple[int, int]:
    """Number of families and of the rectangles in them; the families go to ``out`` as far as it reaches."""
    n_plus, m_plus = len(first_i1), len(first_j1)
    n_minus, m_minus = len(tables[0]) - n_plus, len(tables[1]) - m_plus
    limit, begun, alive = np.empty(m_plus, np.int64), np.empty(m_plus, np.int64), np.empty(m_plus, np.bool_)
    stack, done = np.empty((STACK, 6), np.int64), np.zeros(2, np.int64)
    blockers, n_blockers = blockers.copy(), len(blockers)
    for i0 in range(n_plus):
        n_blockers = _drop_passed(blockers, n_blockers, i0)
        limit[:] = m_minus
        begun[:] = first_i1[i0]  # of the block of corner (i0, j0) that is open while i1 grows
        n_alive = 0
        for j0 in range(m_plus):
            alive[j0] = _hopeful(i0, j0, first_i1[i0], first_j1[j0], m_minus, tables, ratio)
            n_alive += alive[j0]
        for b in range(n_blockers):
            if n_alive == 0:
                break
            i1, top = blockers[b, 1], blockers[b, 3]
            j0 = blockers[b, 2] - 1
            while j0 >= 0 and limit[j0] > top:  # ``limit`` never decreases along j0
                if alive[j0]:
                    if begun[j0] < i1:
                        block = (i0, j0, begun[j0], i1, first_j1[j0], limit[j0])
                        _emit(block, tables, ratio, stack, out, done)
                        begun[j0] = i1
                    alive[j0] = _hopeful(i0, j0, begun[j0], first_j1[j0], top, tables, ratio)
                    n_alive -= not alive[j0]
                limit[j0] = top
                j0 -= 1
        for j0 in range(m_plus):
            if alive[j0]:
                block = (i0, j0, begun[j0], n_minus, first_j1[j0], limit[j0])
                _emit(block, tables, ratio, stack, out, done)
    return done[0], done[1]


@_kernel
def _drop_passed(blockers: Int, n: int, i0: int) -> int:
    """Keep the blockers right of plane i0 (i0 < qx), in order; the others matter to no later i0 either."""
    kept = 0
    for b in range(n):
        if blockers[b, 0] > i0:
            for k in range(4):
                blockers[kept, k] = blockers[b, k]
            kept += 1
    return kept


@_kernel
def _hopeful(i0: int, j0: int, i1: int, j1: int, limit: int, tables: Tables, ratio: float) -> bool:
    """False where corner (i0, j0) has no valid rectangle from i1 on, and from j1 to below ``limit``.

    All that is free up to the last plane bounds every count; what is not free is at least that of (i1, j1).
    """
    n_minus = len(tables[0]) - tables[3]
    if i1 >= n_minus or j1 >= limit:
        return False
    least, seen = _cells(i0, j0, i1, j1, tables)
    return not _none_valid(least, seen, _cells(i0, j0, n_minus - 1, limit - 1, tables)[1], ratio)


@_kernel
def _cells(i0: int, j0: int, i1: int, j1: int, tables: Tables) -> tuple[int, int]:
    """Total and free cells of a rectangle."""
    columns, rows, table, n_plus, m_plus = tables
    b, d = n_plus + i1, m_plus + j1
    total = (columns[b] - columns[i0]) * (rows[d] - rows[j0])
    return total, table[b, d] - table[i0, d] - table[b, j0] + table[i0, j0]


@_kernel
def _emit(block: Block, tables: Tables, ratio: float, stack: Int, out: Index, done: Int) -> None:
    """Write the families of a block that is not blocked; counts families and rectangles in ``done``."""
    _push(stack, 0, block)
    depth = 1
    while depth > 0:
        depth -= 1
        i0, j0, i1, i2 = stack[depth, 0], stack[depth, 1], stack[depth, 2], stack[depth, 3]
        j1, j2 = stack[depth, 4], stack[depth, 5]
        least, seen = _cells(i0, j0, i1, j1, tables)
        largest, free = _cells(i0, j0, i2 - 1, j2 - 1, tables)
        if _none_valid(least, seen, free, ratio):
            continue
        if not _all_valid(largest, seen, free, ratio):
            depth = _halve(stack, depth, (i0, j0, i1, i2, j1, j2), tables)
            continue
        if done[0] < len(out):
            _push(out, done[0], (i0, j0, i1, i2, j1, j2))
        done[0] += 1
        done[1] += (i2 - i1) * (j2 - j1)


@_kernel
def _none_valid(least: int, seen: int, free: int, ratio: float) -> bool:
    """No member of a block is valid: the smallest has ``least`` cells, ``seen`` free, the largest ``free``.

    From member to larger member the cells that are not free only grow in number, like those that are.
    """
    return free == 0 or least > ratio * free or least - seen > (ratio - 1) * free * (1 + SURE)


@_kernel
def _all_valid(largest: int, seen: int, free: int, ratio: float) -> bool:
    """Every member is: the largest has ``largest`` cells and ``free`` free, the smallest ``seen``."""
    return seen > 0 and (largest <= ratio * seen or largest - free <= (ratio - 1) * seen * (1 - SURE))


@_kernel
def _push(rows: Int | Index, at: int, block: Block) -> None:
    """Write a block to row ``at``; numba takes ten times as long for a row at once."""
    rows[at, 0], rows[at, 1], rows[at, 2], rows[at, 3], rows[at, 4], rows[at, 5] = block


@_kernel
def _halve(stack: Int, depth: int, block: Block, tables: Tables) -> int:
    """Put the halves of a block at ``depth``, cut across the range that adds more area; returns the depth."""
    columns, rows, _, n_plus, m_plus = tables
    i0, j0, i1, i2, j1, j2 = block
    wide = (columns[n_plus + i2 - 1] - columns[n_plus + i1]) * (rows[m_plus + j1] - rows[j0])
    high = (rows[m_plus + j2 - 1] - rows[m_plus + j1]) * (columns[n_plus + i1] - columns[i0])
    if j2 - j1 == 1 or (i2 - i1 > 1 and wide >= high):
        middle = (i1 + i2) // 2
        _push(stack, depth, (i0, j0, middle, i2, j1, j2))
        _push(stack, depth + 1, (i0, j0, i1, middle, j1, j2))
    else:
        middle = (j1 + j2) // 2
        _push(stack, depth, (i0, j0, i1, i2, middle, j2))
        _push(stack, depth + 1, (i0, j0, i1, i2, j1, middle))
    return depth + 2

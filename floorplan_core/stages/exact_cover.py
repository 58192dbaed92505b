"""The true optimum of the paper's set cover: an integer program, solved by HiGHS.

Minimise the sum of A_k z_k over z in {0, 1} such that every free cell that a candidate holds lies in a chosen
one. What can be taken away without losing the optimum is taken away first:

- components that no chain of overlapping rectangles connects are programs of their own;
- of all rectangles with the same free cells only the lightest can be needed (the first of equals);
- cells between neighbouring planes are one cell, cells in the same rectangles are one row, and a row all of
  whose rectangles include those of another row is covered whenever that one is.

The greedy cover (:mod:`floorplan_core.stages.set_cover`) is within a factor H(d*) of this; ``python -m
benchmarks optimum`` measures how far it really is.
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import CoverConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.model import CandidateSet, OccupancyGrid, RectangleCover
from floorplan_core.observer import Observer
from floorplan_core.stages.cover_components import components
from floorplan_core.stages.set_cover import compress, make_cover, spans_of

Int = NDArray[np.int64]


def exact_cover(
    candidates: CandidateSet, grid: OccupancyGrid, config: CoverConfig, observer: Observer | None = None
) -> RectangleCover:
    """Cover of least total weight; its rectangles are in the order of the candidate set.

    :raises NoPlanError: if HiGHS finds no cover of some part within ``config.time_limit`` seconds. If it
        finds covers but cannot prove the best one optimal in time, the observer is warned.
    """
    observer = observer or Observer()
    cells, slots, weights = compress(candidates, grid)
    index = candidates.index()
    spans = tighten(spans_of(index, slots), weights)
    x0, x1, y0, y1 = spans_of(index, cells).T
    total = (x1 - x0) * (y1 - y0)
    deadline = time.monotonic() + config.time_limit
    chosen: list[Int] = []
    unproven = 0
    for rows in _parts(spans, weights, total):
        observer.check_cancelled()
        best, proven = _solve(spans[rows], total[rows], weights, deadline, config.time_limit)
        chosen.append(rows[best])
        unproven += not proven
    if unproven:
        observer.warning(
            f"The exact cover of {unproven} parts of the plan was not proven optimal within "
            f"{config.time_limit:g} s; raise cover.time_limit."
        )
    return make_cover(candidates, grid, np.sort(np.concatenate([np.empty(0, np.int64), *chosen])))


def tighten(spans: Int, weights: Int) -> Int:
    """(K, 4) the smallest span with the same free cells: equal where, and only where, these are the same."""
    table = np.pad(weights, ((1, 0), (1, 0))).cumsum(axis=0).cumsum(axis=1)
    return np.asarray(_tighten(spans, table))


@njit(cache=True, nogil=True)
def _tighten(spans: Int, table: Int) -> Int:
    """Move each side inwards over stretches without free cells; 0, 0, 0, 0 where there are none."""
    tight = np.zeros_like(spans)
    for k in range(len(spans)):
        a, b, c, d = spans[k]
        if _free(table, a, b, c, d) == 0:
            continue
        while _free(table, a, a + 1, c, d) == 0:
            a += 1
        while _free(table, b - 1, b, c, d) == 0:
            b -= 1
        while _free(table, a, b, c, c + 1) == 0:
            c += 1
        while _free(table, a, b, d - 1, d) == 0:
            d -= 1
        tight[k, 0], tight[k, 1], tight[k, 2], tight[k, 3] = a, b, c, d
    return tight


@njit(cache=True, nogil=True)
def _free(table: Int, a: int, b: int, c: int, d: int) -> int:
    """Free cells in [a, b) x [c, d)."""
    return int(table[b, d] - table[a, d] - table[b, c] + table[a, c])


def _parts(spans: Int, weights: Int, total: Int) -> list[Int]:
    """Rows of each component, of every set of free cells the lightest rectangle only."""
    order = np.lexsort([np.arange(len(spans)), total, *spans.T])
    first = np.ones(len(order), dtype=bool)
    first[1:] = (spans[order[1:]] != spans[order[:-1]]).any(axis=1)
    rows = np.sort(order[first])
    labels, _ = components(spans[rows], weights)
    return [rows[labels == n] for n in range(labels.max(initial=-1) + 1)]


def _solve(spans: Int, total: Int, weights: Int, deadline: float, limit: float) -> tuple[Int, bool]:
    """Positions of the chosen rectangles of one component, and whether they are proven optimal."""
    if len(spans) == 1:
        return np.zeros(1, dtype=np.int64), True
    from scipy.optimize import Bounds, LinearConstraint, milp

    matrix = _incidence(spans, weights)
    result = milp(
        total.astype(np.float64),
        integrality=np.ones(len(total)),
        bounds=Bounds(0, 1),
        constraints=LinearConstraint(matrix, lb=1),
        options={"time_limit": max(deadline - time.monotonic(), 0.0), "mip_rel_gap": 0.0},
    )
    if result.x is None:
        raise NoPlanError(
            f"The exact cover of {matrix.shape[0]} groups of free cells by {len(total)} rectangles was not "
            f"found within {limit:g} s; raise cover.time_limit or use cover.solver greedy."
        )
    return np.flatnonzero(result.x > 0.5).astype(np.int64), bool(result.status == 0)


def _incidence(spans: Int, weights: Int) -> Any:
    """Sparse (rows, K) matrix: which rectangle holds which group of free cells; only rows that matter."""
    from scipy.sparse import csr_array

    lines_x, lines_y = np.unique(spans[:, :2]), np.unique(spans[:, 2:])
    a, b = np.searchsorted(lines_x, spans[:, :2]).T
    c, d = np.searchsorted(lines_y, spans[:, 2:]).T
    groups: dict[bytes, Int] = {}
    for x in range(len(lines_x) - 1):
        columns = np.flatnonzero((a <= x) & (x < b))
        for y in range(len(lines_y) - 1):
            if weights[lines_x[x] : lines_x[x + 1], lines_y[y] : lines_y[y + 1]].any():
                members = columns[(c[columns] <= y) & (y < d[columns])]
                groups.setdefault(members.tobytes(), members)
    rows = [members for members in groups.values() if len(members)]
    pointer = np.cumsum([0] + [len(members) for members in rows])
    matrix = csr_array((np.ones(pointer[-1]), np.concatenate(rows), pointer), shape=(len(rows), len(spans)))
    return matrix[_minimal(matrix)]


def _minimal(matrix: Any) -> NDArray[np.bool_]:
    """(rows,) False where a row contains another one (rows differ, so that no two contain each other)."""
    size = matrix.sum(axis=1)
    common = (matrix @ matrix.T).tocoo()
    inside = (common.row != common.col) & (common.data == size[common.row])  # row lies within column
    keep = np.ones(matrix.shape[0], dtype=bool)
    keep[common.col[inside]] = False
    return keep

"""Least-cost paths on a grid (Dijkstra's search, stopped at the nearest goal)."""

from __future__ import annotations

import heapq

import numpy as np
from numba import njit
from numpy.typing import NDArray

DIAGONAL = 2.0**0.5


@njit(cache=True, nogil=True)
def nearest_goal(cost, start, is_goal):  # type: ignore[no-untyped-def]
    """The cheapest way from a cell to any goal cell, 8-connected.

    Args:
        cost: (ny, nx) float64 price of a step into a cell, a cell's side long; infinite where blocked.
        start: flat index of the first cell.
        is_goal: (ny * nx,) bool.

    Returns:
        The flat indices of the path's cells from start to goal; empty where no goal can be reached.
        Equal costs are settled in the order of the flat index.
    """
    ny, nx = cost.shape
    flat = cost.ravel()
    best = np.full(ny * nx, np.inf)
    parent = np.full(ny * nx, -1, np.int64)
    best[start] = 0.0
    queue = [(0.0, start)]
    while len(queue) > 0:
        so_far, cell = heapq.heappop(queue)
        if so_far > best[cell]:
            continue
        if is_goal[cell]:
            return _trace(parent, cell)
        j, i = cell // nx, cell % nx
        for dj in range(-1, 2):
            for di in range(-1, 2):
                a, b = j + dj, i + di
                if a < 0 or b < 0 or a >= ny or b >= nx or (di == 0 and dj == 0):
                    continue
                if di != 0 and dj != 0 and (cost[j, b] == np.inf or cost[a, i] == np.inf):
                    continue  # no cutting of corners
                step = flat[a * nx + b] * (DIAGONAL if di != 0 and dj != 0 else 1.0)
                if so_far + step < best[a * nx + b]:
                    best[a * nx + b] = so_far + step
                    parent[a * nx + b] = cell
                    heapq.heappush(queue, (so_far + step, a * nx + b))
    return np.empty(0, np.int64)


@njit(cache=True, nogil=True)
def _trace(parent, cell):  # type: ignore[no-untyped-def]
    path = [cell]
    while parent[path[-1]] >= 0:
        path.append(parent[path[-1]])
    return np.array(path, np.int64)[::-1]


def reachable(open_cells: NDArray[np.bool_], seed: tuple[int, int]) -> NDArray[np.bool_]:
    """(ny, nx) the cells connected with ``seed`` (row, column) over 4-neighbours."""
    from scipy import ndimage

    labels = ndimage.label(open_cells)[0]
    return np.asarray((labels == labels[seed]) & open_cells)

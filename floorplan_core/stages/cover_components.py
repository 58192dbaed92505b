"""Components of a set cover: rectangles that no chain of overlaps connects do not influence each other.

Rectangles are [a, b) x [c, d) of compressed cells; two cells are linked where one rectangle holds both. Cost
O(K + cells): the links are counted by differences, the components by flooding.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Int = NDArray[np.int64]
_kernel = njit(cache=True, nogil=True)


@_kernel
def components(spans: Int, weights: Int) -> tuple[Int, Int]:
    """(K,) component of each rectangle, -1 where it is empty; (n,) free cells to cover in each component."""
    covered = _depth(spans, weights.shape, 0, 0)
    right, above = _depth(spans, weights.shape, 1, 0), _depth(spans, weights.shape, 0, 1)
    label = np.full(weights.shape, -1, np.int64)
    stack, missing, n = np.empty((weights.size, 2), np.int64), np.empty(weights.size, np.int64), 0
    for x in range(weights.shape[0]):
        for y in range(weights.shape[1]):
            if covered[x, y] > 0 and label[x, y] < 0:
                missing[n] = _flood(x, y, n, label, right, above, weights, stack)
                n += 1
    labels = np.full(len(spans), -1, np.int64)
    for k in range(len(spans)):
        a, b, c, d = spans[k]
        if a < b and c < d:
            labels[k] = label[a, c]
    return labels, missing[:n].copy()


@_kernel
def by_component(labels: Int, n: int) -> tuple[Int, Int]:
    """Rows sorted by component, stable, the empty ones left out; (n + 1,) where each component begins."""
    starts = np.zeros(n + 1, np.int64)
    for label in labels:
        if label >= 0:
            starts[label + 1] += 1
    starts = np.cumsum(starts)
    order, at = np.empty(starts[n], np.int64), starts.copy()
    for k in range(len(labels)):
        if labels[k] >= 0:
            order[at[labels[k]]] = k
            at[labels[k]] += 1
    return order, starts


@_kernel
def _depth(spans: Int, shape: tuple[int, int], less_x: int, less_y: int) -> Int:
    """Rectangles over each cell, by differences; 1 less in x (y): over it and its right (upper) neighbour."""
    depth = np.zeros((shape[0] + 1, shape[1] + 1), np.int64)
    for k in range(len(spans)):
        a, b, c, d = spans[k]
        if a < b - less_x and c < d - less_y:
            depth[a, c] += 1
            depth[b - less_x, d - less_y] += 1
            depth[a, d - less_y] -= 1
            depth[b - less_x, c] -= 1
    for x in range(shape[0] + 1):
        run = 0
        for y in range(shape[1] + 1):
            run += depth[x, y]
            depth[x, y] = run if x == 0 else run + depth[x - 1, y]
    return depth


@_kernel
def _flood(x: int, y: int, n: int, label: Int, right: Int, above: Int, weights: Int, stack: Int) -> int:
    """Label the component of cell (x, y); returns its free cells."""
    label[x, y] = n
    stack[0] = x, y
    size, cells = 1, 0
    while size > 0:
        size -= 1
        x, y = stack[size]
        cells += weights[x, y]
        for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            u, v = x + dx, y + dy
            if u < 0 or v < 0 or u >= label.shape[0] or v >= label.shape[1] or label[u, v] >= 0:
                continue
            link = right[min(x, u), y] if dx != 0 else above[x, min(y, v)]
            if link > 0:
                label[u, v] = n
                stack[size] = u, v
                size += 1
    return cells

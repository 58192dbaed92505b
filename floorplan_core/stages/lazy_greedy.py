"""The greedy choice of the weighted set cover, made lazily (for :mod:`floorplan_core.stages.set_cover`).

Rectangles are [a, b) x [c, d) of compressed cells, ``weights`` the free cells in each. The result is exactly
that of the plain algorithm (least A / |R & D|, then larger A, then smaller index); four observations make it
fast.

1. Ratios are compared as integers, A_1 d_2 < A_2 d_1.
2. |R & D| only ever falls, so a ratio computed earlier is a lower bound: when the first rectangle of a heap
   is counted again and has not changed, it is the greedy choice.
3. A rectangle waits behind a neighbour that must be preferred (:func:`_hide`): most never enter the heap.
4. Rectangles that no chain of overlaps connects do not influence each other. Each such component is covered
   on its own; keys of successive choices only grow, so sorting all choices by key gives the order of the
   whole.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Int = NDArray[np.int64]
Index = NDArray[np.int32]
Sums = tuple[Int, Int]  # running sums of D along y for every x, and along x for every y
_kernel = njit(cache=True, nogil=True)


def lazy_greedy(spans: Index, codes: Int, steps: Int, total: Int, weights: Int) -> tuple[Int, Int]:
    """Rows chosen, in order, and the cells that each newly covered.

    :param spans: (K, 4) a, b, c, d.
    :param codes: (K,) increasing; ``codes + step``: the neighbour one plane further out on a side.
    :param steps: (4,) the step of each side.
    :param total: (K,) weight A of each.
    :param weights: (nx', ny') free cells.
    """
    labels, missing = components(spans, weights)
    order, starts = _by_component(labels, len(missing))
    chosen, gained = _cover_all(spans[order], codes[order], steps, total[order], weights, starts, missing)
    rows, cells = _by_key(order[chosen], gained, total)
    return rows, cells


@_kernel
def components(spans: Index, weights: Int) -> tuple[Int, Int]:
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
def _by_component(labels: Int, n: int) -> tuple[Int, Int]:
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
def _depth(spans: Index, shape: tuple[int, int], less_x: int, less_y: int) -> Int:
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


@_kernel
def _cover_all(
    spans: Index, codes: Int, steps: Int, total: Int, weights: Int, starts: Int, missing: Int
) -> tuple[Int, Int]:
    """Rows chosen and cells gained, component by component (rows ``starts[n]`` to ``starts[n + 1]``)."""
    sums = _running_sums(weights), _running_sums(weights.T)
    chosen, gained, size = np.empty(len(spans), np.int64), np.empty(len(spans), np.int64), 0
    for n in range(len(missing)):
        rows = slice(starts[n], starts[n + 1])
        picks = _cover_component(
            spans[rows], codes[rows], steps, total[rows], sums, missing[n], chosen[size:], gained[size:]
        )
        chosen[size : size + picks] += starts[n]
        size += picks
    return chosen[:size].copy(), gained[:size].copy()


@_kernel
def _cover_component(
    spans: Index, codes: Int, steps: Int, total: Int, sums: Sums, missing: int, chosen: Int, gained: Int
) -> int:
    """Cover one component; writes the choices to ``chosen`` and ``gained`` and returns their number."""
    gain = np.array([_remaining(sums, spans[k]) for k in range(len(spans))])
    first_child, sibling, heap, size = _hide(codes, steps, total, gain)
    n = 0
    while missing > 0:
        k = heap[0]
        now = _remaining(sums, spans[k])
        if now == gain[k]:
            chosen[n], gained[n] = k, now
            n += 1
            missing -= now
            _take_out(sums, spans[k])
            now = 0
        gain[k] = now
        if now == 0:
            size -= 1
            heap[0] = heap[size]
        _sift_down(heap, size, 0, total, gain)
        child = first_child[k] if now > 0 else -1
        while child >= 0:
            _sift_up(heap, size, child, total, gain)
            size += 1
            child = sibling[child]
        first_child[k] = -1
    return n


@_kernel
def _hide(codes: Int, steps: Int, total: Int, gain: Int) -> tuple[Int, Int, Int, int]:
    """Hide every rectangle behind a neighbour that the greedy choice must prefer; heap of those left.

    A neighbour differs by one plane on one side. R hides behind S where S precedes R at the start and holds
    all free cells of R: then while |S & D| is what it was so is |R & D|, and S still precedes; once S is
    chosen, or empty, nothing is left of R. Only when |S & D| is found to have fallen does R have to be
    looked at.
    """
    parent = np.full(len(codes), -1, np.int64)
    for step in steps:
        p = 0
        for k in range(len(codes)):
            larger = codes[k] + step
            while p < len(codes) and codes[p] < larger:
                p += 1
            if p == len(codes):
                break
            if codes[p] != larger or gain[p] < gain[k] or total[p] < total[k]:
                continue
            if _precedes(p, k, total, gain):
                if parent[k] < 0 or _precedes(p, parent[k], total, gain):
                    parent[k] = p
            elif gain[p] == gain[k] and (parent[p] < 0 or _precedes(k, parent[p], total, gain)):
                parent[p] = k
    first_child, sibling = np.full(len(codes), -1, np.int64), np.full(len(codes), -1, np.int64)
    heap, size = np.empty(len(codes), np.int64), 0
    for k in range(len(codes)):
        if parent[k] < 0:
            _sift_up(heap, size, k, total, gain)
            size += 1
        else:
            sibling[k] = first_child[parent[k]]
            first_child[parent[k]] = k
    return first_child, sibling, heap, size


@_kernel
def _running_sums(weights: Int) -> Int:
    """(n, m + 1) sums of ``weights[i, :j]``."""
    sums = np.zeros((weights.shape[0], weights.shape[1] + 1), np.int64)
    for i in range(weights.shape[0]):
        for j in range(weights.shape[1]):
            sums[i, j + 1] = sums[i, j] + weights[i, j]
    return sums


@_kernel
def _remaining(sums: Sums, span: Index) -> int:
    """|R & D|, summed over the side of R that has fewer compressed cells."""
    a, b, c, d = span
    count = 0
    if b - a <= d - c:
        for x in range(a, b):
            count += sums[0][x, d] - sums[0][x, c]
    else:
        for y in range(c, d):
            count += sums[1][y, b] - sums[1][y, a]
    return count


@_kernel
def _take_out(sums: Sums, span: Index) -> None:
    """D - R."""
    _clear(sums[0], span[0], span[1], span[2], span[3])
    _clear(sums[1], span[2], span[3], span[0], span[1])


@_kernel
def _clear(sums: Int, i0: int, i1: int, j0: int, j1: int) -> None:
    """Running sums after the block [i0, i1) x [j0, j1) is set to 0."""
    for i in range(i0, i1):
        taken = sums[i, j1] - sums[i, j0]
        if taken > 0:
            sums[i, j0:j1] = sums[i, j0]
            sums[i, j1:] -= taken


@_kernel
def _by_key(chosen: Int, gained: Int, total: Int) -> tuple[Int, Int]:
    """The choices of all components in the order of the greedy choice over the whole."""
    gain = np.zeros(len(total), np.int64)
    heap, size = np.empty(len(chosen), np.int64), 0
    for n in range(len(chosen)):
        gain[chosen[n]] = gained[n]
        _sift_up(heap, size, chosen[n], total, gain)
        size += 1
    for n in range(len(chosen)):
        chosen[n] = heap[0]
        gained[n] = gain[chosen[n]]
        size -= 1
        heap[0] = heap[size]
        _sift_down(heap, size, 0, total, gain)
    return chosen, gained


@_kernel
def _precedes(k: int, m: int, total: Int, gain: Int) -> bool:
    """True where the greedy choice prefers rectangle k to m: smaller ratio, larger A, smaller index."""
    left, right = total[k] * gain[m], total[m] * gain[k]
    if left != right:
        return bool(left < right)
    if total[k] != total[m]:
        return bool(total[k] > total[m])
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


@_kernel
def _sift_up(heap: Int, at: int, k: int, total: Int, gain: Int) -> None:
    """Add ``k`` to a heap of ``at`` rectangles."""
    while at > 0 and _precedes(k, heap[(at - 1) // 2], total, gain):
        heap[at] = heap[(at - 1) // 2]
        at = (at - 1) // 2
    heap[at] = k

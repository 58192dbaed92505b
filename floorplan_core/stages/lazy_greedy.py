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

from floorplan_core.stages.cover_components import by_component, components

Int = NDArray[np.int64]
Index = NDArray[np.int32]
Keys = tuple[Int, Int, Int]  # numerator and denominator of the ratio, and what larger values of win ties
Tree = tuple[Int, Int]  # first child and next sibling of each rectangle, -1 where there is none
Sums = tuple[Int, Int]  # running sums of D along y for every x, and along x for every y
BEFORE_TIES = 1 << 60  # larger than any A
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
    order, starts = by_component(labels, len(missing))
    chosen, gained = _cover_all(spans[order], codes[order], steps, total[order], weights, starts, missing)
    rows, cells = _by_key(order[chosen], gained, total)
    return rows, cells


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
    tree, heap, size = _hide(codes, steps, (total, gain, total))
    least = _least_weight(tree, heap[:size], total)
    keys, n = (total.copy(), gain.copy(), total.copy()), 0
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
        keys[0][k], keys[1][k], keys[2][k] = total[k], now, total[k]
        if now == 0:
            size -= 1
            heap[0] = heap[size]
        _sift_down(heap, size, 0, keys)
        if now > 0:
            size = _release(k, tree, spans, sums, total, gain, least, heap, size, keys)
    return n


@_kernel
def _release(
    k: int,
    tree: Tree,
    spans: Index,
    sums: Sums,
    total: Int,
    gain: Int,
    least: Int,
    heap: Int,
    size: int,
    keys: Keys,
) -> int:
    """Put the rectangles that waited behind ``k`` into the heap; returns its size.

    A child stands for all that wait behind it. Their ratios were no smaller than its own, A / gain; nor are
    they smaller than the least weight among them over the cells that are left in the child. The better of
    the two bounds is the key; as a mere bound the second comes before all ties.
    """
    child, tree[0][k] = tree[0][k], -1
    while child >= 0:
        left = _remaining(sums, spans[child])
        if left < gain[child] and least[child] * gain[child] > total[child] * left:
            keys[0][child], keys[1][child], keys[2][child] = least[child], left, BEFORE_TIES
        if left > 0:
            _sift_up(heap, size, child, keys)
            size += 1
        child = tree[1][child]
    return size


@_kernel
def _least_weight(tree: Tree, roots: Int, total: Int) -> Int:
    """(K,) least A among each rectangle and all that wait behind it."""
    least, order, size = total.copy(), np.empty(len(total), np.int64), len(roots)
    order[:size] = roots
    parent = np.full(len(total), -1, np.int64)
    for at in range(len(total)):
        child = tree[0][order[at]]
        while child >= 0:
            parent[child] = order[at]
            order[size] = child
            size += 1
            child = tree[1][child]
    for at in range(len(total) - 1, len(roots) - 1, -1):
        k = order[at]
        least[parent[k]] = min(least[parent[k]], least[k])
    return least


@_kernel
def _hide(codes: Int, steps: Int, keys: Keys) -> tuple[Tree, Int, int]:
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
            if codes[p] != larger or keys[1][p] < keys[1][k] or keys[0][p] < keys[0][k]:
                continue
            if _precedes(p, k, keys):
                if parent[k] < 0 or _precedes(p, parent[k], keys):
                    parent[k] = p
            elif keys[1][p] == keys[1][k] and (parent[p] < 0 or _precedes(k, parent[p], keys)):
                parent[p] = k
    first_child, sibling = np.full(len(codes), -1, np.int64), np.full(len(codes), -1, np.int64)
    heap, size = np.empty(len(codes), np.int64), 0
    for k in range(len(codes)):
        if parent[k] < 0:
            _sift_up(heap, size, k, keys)
            size += 1
        else:
            sibling[k] = first_child[parent[k]]
            first_child[parent[k]] = k
    return (first_child, sibling), heap, size


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
    keys = (total, gain, total)
    heap, size = np.empty(len(chosen), np.int64), 0
    for n in range(len(chosen)):
        gain[chosen[n]] = gained[n]
        _sift_up(heap, size, chosen[n], keys)
        size += 1
    for n in range(len(chosen)):
        chosen[n] = heap[0]
        gained[n] = gain[chosen[n]]
        size -= 1
        heap[0] = heap[size]
        _sift_down(heap, size, 0, keys)
    return chosen, gained


@_kernel
def _precedes(k: int, m: int, keys: Keys) -> bool:
    """True where the greedy choice prefers rectangle k to m: smaller ratio, larger A, smaller index."""
    left, right = keys[0][k] * keys[1][m], keys[0][m] * keys[1][k]
    if left != right:
        return bool(left < right)
    if keys[2][k] != keys[2][m]:
        return bool(keys[2][k] > keys[2][m])
    return k < m


@_kernel
def _sift_down(heap: Int, size: int, at: int, keys: Keys) -> None:
    """Restore the heap below position ``at``."""
    moved = heap[at]
    while True:
        child = 2 * at + 1
        if child >= size:
            break
        if child + 1 < size and _precedes(heap[child + 1], heap[child], keys):
            child += 1
        if not _precedes(heap[child], moved, keys):
            break
        heap[at] = heap[child]
        at = child
    heap[at] = moved


@_kernel
def _sift_up(heap: Int, at: int, k: int, keys: Keys) -> None:
    """Add ``k`` to a heap of ``at`` rectangles."""
    while at > 0 and _precedes(k, heap[(at - 1) // 2], keys):
        heap[at] = heap[(at - 1) // 2]
        at = (at - 1) // 2
    heap[at] = k

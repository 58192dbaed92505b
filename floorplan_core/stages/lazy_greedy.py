"""The greedy choice of the weighted set cover, made lazily (for :mod:`floorplan_core.stages.set_cover`).

The result is exactly that of the plain algorithm (least A / |R & D|, then larger A, then smaller index), but
most rectangles are never looked at. They come in families: a corner (i0, j0) with a range of i1 times a range
of j1. The smallest member I lies in every member R, and the largest O holds every one. The *waste* of R, its
cells outside D, is A - |R & D|; like |R & D| it only grows with R. Hence for every member

    A / |R & D|  =  1 + waste(R) / |R & D|  >=  1 + waste(I) / |O & D|,

and where the two are equal, A <= waste(I) + |O & D|. This bound is the key under which a family waits in a
heap, in the order of the choice; for a family of one rectangle it is the ratio itself.

1. D only ever shrinks, so that waste only grows and |R & D| only falls: a key computed earlier is still a
   bound. When the first of the heap is counted again and has not changed, no other is better.
2. If it is a single rectangle, it is the greedy choice. If not, it is cut in two that wait in its place.
3. Once |O & D| is 0, nothing is left of a family.
4. Families that no chain of overlaps connects do not influence each other. Each such component is covered on
   its own; keys of successive choices only grow, so sorting all choices by key gives the order of the whole.

Ratios are compared as integers, n_1 d_2 < n_2 d_1. |R & D| is counted over compressed cells with running sums
along both axes.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.stages.cover_components import by_component

Int = NDArray[np.int64]
Index = NDArray[np.int32]
Sides = tuple[Int, Int, Int, Int]  # for the planes x+, x-, y+, y-
Board = tuple[Int, Int, Int, Int]  # (P, 2) first cell and slot of x and y planes; sums of D along y, along x
_kernel = njit(cache=True, nogil=True)
_inline = njit(inline="always")  # where a call takes longer than what it does

# Columns of a node of the heap, which is a part of a family. Planes are rows of the board: plus, then minus.
I0, J0, I1, I1_END, J1, J1_END, FAMILY = range(7)
RATIO, GAIN = 7, 8  # numerator and denominator of the bound
ORDER = 9  # of its first member, by (i0, i1, j0, j1)
WIDTH = 10
SPARE = 64  # nodes for which there is room beyond twice the families


def lazy_greedy(
    families: Index, cells: Sides, slots: Sides, weights: Int, labels: Int, missing: Int
) -> tuple[Int, Int]:
    """(C, 5) i0, i1, j0, j1 and family of the rectangles chosen, in order; (C,) cells each newly covered.

    :param families: (F, 6) i0, j0, first and end of i1, first and end of j1.
    :param cells: first cell of every plane, beyond the grid too.
    :param slots: first compressed cell of every plane.
    :param weights: (nx', ny') free cells of each compressed cell.
    :param labels: (F,) component of each family, -1 where it has no cells.
    :param missing: (n,) free cells to cover in each component.
    """
    board, plus = _board(cells, slots, weights), (len(cells[0]), len(cells[2]))
    order, starts = by_component(labels, len(missing))
    nodes = _nodes(families, order, plus, board)
    heap = np.empty(len(nodes), np.int64)
    most = min(int(missing.sum()), weights.size)  # a choice covers a compressed cell that none before it did
    picks, state = np.empty((most, WIDTH), np.int64), np.array([len(order), 0, 0, 0, -1])
    while not _cover_all(state, starts, missing, heap, nodes, board, picks):
        heap, nodes = _twice(heap), _twice(nodes)
    picks = picks[_in_order(picks[: state[2]])]
    return picks[:, [I0, I1, J0, J1, FAMILY]] - np.array([0, plus[0], 0, plus[1], 0]), picks[:, GAIN]


def _board(cells: Sides, slots: Sides, weights: Int) -> Board:
    """What rectangles are measured on."""
    x = np.column_stack([np.concatenate(cells[:2]), np.concatenate(slots[:2])])
    y = np.column_stack([np.concatenate(cells[2:]), np.concatenate(slots[2:])])
    along_y = np.pad(weights.cumsum(axis=1), ((0, 0), (1, 0)))
    along_x = np.pad(weights.T.cumsum(axis=1), ((0, 0), (1, 0)))
    return x, y, along_y, along_x


def _nodes(families: Index, order: Int, plus: tuple[int, int], board: Board) -> Int:
    """(N, 10) the families in the given order as nodes, with room for more."""
    nodes = np.empty((2 * len(order) + SPARE, WIDTH), np.int64)
    own = nodes[: len(order)]
    own[:, :6] = families[order] + np.array([0, 0, plus[0], plus[0], plus[1], plus[1]])
    own[:, FAMILY] = order
    x, y = len(board[0]), len(board[1])
    own[:, ORDER] = ((own[:, I0] * x + own[:, I1]) * y + own[:, J0]) * y + own[:, J1]
    return nodes


def _twice(rows: Int) -> Int:
    """``rows`` with room for as many more."""
    return np.concatenate([rows, np.empty_like(rows)])


@_kernel
def _cover_all(
    state: Int, starts: Int, missing: Int, heap: Int, nodes: Int, board: Board, picks: Int
) -> bool:
    """Cover one component after the other (nodes ``starts[n]`` to ``starts[n + 1]``), writing to ``picks``.

    Returns False where there is no more room for nodes; to be called again with more. ``state`` holds the
    number of nodes, of nodes in the heap, of choices, of missing cells, and the component.
    """
    while _cover_component(state, heap, nodes, board, picks):
        state[4] += 1
        n = state[4]
        if n == len(missing):
            return True
        state[0], state[1], state[3] = starts[-1], 0, missing[n]  # parts of the component before are no more
        for k in range(starts[n], starts[n + 1]):
            if _set_bound(k, nodes, board) > 0:
                _sift_up(heap, state[1], k, nodes)
                state[1] += 1
    return False


@_kernel
def _cover_component(state: Int, heap: Int, nodes: Int, board: Board, picks: Int) -> bool:
    """Choose until nothing is missing; False where there is no more room for nodes."""
    size, waiting, n, missing = state[0], state[1], state[2], state[3]
    while missing > 0 and size < len(nodes):
        k = heap[0]
        ratio, gain = nodes[k, RATIO], nodes[k, GAIN]
        left, cut = _set_bound(k, nodes, board), False
        if left > 0 and nodes[k, RATIO] == ratio and left == gain:
            if _is_single(k, nodes):
                for column in range(WIDTH):
                    picks[n, column] = nodes[k, column]
                _take_out(k, nodes, board)
                n, missing, left = n + 1, missing - gain, 0
            else:
                _halve(k, size, nodes, board)
                left, cut = _set_bound(k, nodes, board), True
        if left > 0:
            _sift_down(heap, waiting, nodes)
        else:
            waiting -= 1
            _drop_first(heap, waiting, nodes)
        if cut and _set_bound(size, nodes, board) > 0:
            _sift_up(heap, waiting, size, nodes)
            waiting += 1
        size += cut
    state[0], state[1], state[2], state[3] = size, waiting, n, missing
    return bool(missing == 0)


@_kernel
def _in_order(picks: Int) -> Int:
    """The choices of all components in the order of the greedy choice over the whole."""
    heap, order = np.empty(len(picks), np.int64), np.empty(len(picks), np.int64)
    for k in range(len(picks)):
        _sift_up(heap, k, k, picks)
    for n in range(len(picks)):
        order[n] = heap[0]
        _drop_first(heap, len(picks) - n - 1, picks)
    return order


@_kernel
def _is_single(k: int, nodes: Int) -> bool:
    return bool(nodes[k, I1_END] - nodes[k, I1] == 1 and nodes[k, J1_END] - nodes[k, J1] == 1)


@_inline
def _set_bound(k: int, nodes: Int, board: Board) -> int:
    """Compute the bound of node ``k`` for D as it is; returns |O & D|."""
    x, y, along_y, along_x = board
    a, b, c, d = nodes[k, I0], nodes[k, I1], nodes[k, J0], nodes[k, J1]
    b_last, d_last = nodes[k, I1_END] - 1, nodes[k, J1_END] - 1
    most = _remaining(x[a, 1], x[b_last, 1], y[c, 1], y[d_last, 1], along_y, along_x)
    least = most
    if b < b_last or d < d_last:
        least = _remaining(x[a, 1], x[b, 1], y[c, 1], y[d, 1], along_y, along_x)
    nodes[k, RATIO] = (x[b, 0] - x[a, 0]) * (y[d, 0] - y[c, 0]) - least + most
    nodes[k, GAIN] = most
    return int(most)


@_inline
def _remaining(x0: int, x1: int, y0: int, y1: int, along_y: Int, along_x: Int) -> int:
    """|R & D| of the slots [x0, x1) x [y0, y1), summed over the side that has fewer."""
    count = 0
    if x1 - x0 <= y1 - y0:
        for x in range(x0, x1):
            count += along_y[x, y1] - along_y[x, y0]
    else:
        for y in range(y0, y1):
            count += along_x[y, x1] - along_x[y, x0]
    return count


@_kernel
def _halve(k: int, new: int, nodes: Int, board: Board) -> None:
    """Cut node ``k`` across the range that adds more area; the larger rectangles become node ``new``."""
    x, y = board[0], board[1]
    for column in range(WIDTH):
        nodes[new, column] = nodes[k, column]
    i1, i1_end, j1, j1_end = nodes[k, I1], nodes[k, I1_END], nodes[k, J1], nodes[k, J1_END]
    wide = (x[i1_end - 1, 0] - x[i1, 0]) * (y[j1, 0] - y[nodes[k, J0], 0])
    high = (y[j1_end - 1, 0] - y[j1, 0]) * (x[i1, 0] - x[nodes[k, I0], 0])
    if j1_end - j1 == 1 or (i1_end - i1 > 1 and wide >= high):
        middle = _middle(x, i1, i1_end)
        nodes[k, I1_END] = nodes[new, I1] = middle
        nodes[new, ORDER] += (middle - i1) * len(y) * len(y)
    else:
        middle = _middle(y, j1, j1_end)
        nodes[k, J1_END] = nodes[new, J1] = middle
        nodes[new, ORDER] += middle - j1


@_kernel
def _middle(planes: Int, first: int, end: int) -> int:
    """The plane at which a range is cut: the first beyond the middle between its outer planes."""
    half = (planes[first, 0] + planes[end - 1, 0]) // 2
    middle = first + 1
    while middle < end - 1 and planes[middle, 0] <= half:
        middle += 1
    return middle


@_kernel
def _take_out(k: int, nodes: Int, board: Board) -> None:
    """D - R for the single rectangle ``k``."""
    x, y, along_y, along_x = board
    x0, x1, y0, y1 = x[nodes[k, I0], 1], x[nodes[k, I1], 1], y[nodes[k, J0], 1], y[nodes[k, J1], 1]
    _clear(along_y, x0, x1, y0, y1)
    _clear(along_x, y0, y1, x0, x1)


@_kernel
def _clear(sums: Int, i0: int, i1: int, j0: int, j1: int) -> None:
    """Running sums after the block [i0, i1) x [j0, j1) is set to 0."""
    for i in range(i0, i1):
        taken = sums[i, j1] - sums[i, j0]
        if taken > 0:
            sums[i, j0:j1] = sums[i, j0]
            sums[i, j1:] -= taken


@_inline
def _precedes(k: int, m: int, nodes: Int) -> bool:
    """True where the greedy choice looks at node k before m: smaller ratio, larger A, smaller index.

    The numerator is A itself for a single rectangle, and a bound of A for a family.
    """
    left, right = nodes[k, RATIO] * nodes[m, GAIN], nodes[m, RATIO] * nodes[k, GAIN]
    if left != right:
        return bool(left < right)
    if nodes[k, RATIO] != nodes[m, RATIO]:
        return bool(nodes[k, RATIO] > nodes[m, RATIO])
    return bool(nodes[k, ORDER] < nodes[m, ORDER])


@_kernel
def _sift_down(heap: Int, size: int, nodes: Int) -> None:
    """Let the first node of the heap sink to its place."""
    at, moved = 0, heap[0]
    while 2 * at + 1 < size:
        child = 2 * at + 1
        if child + 1 < size and _precedes(heap[child + 1], heap[child], nodes):
            child += 1
        if not _precedes(heap[child], moved, nodes):
            break
        heap[at] = heap[child]
        at = child
    heap[at] = moved


@_kernel
def _drop_first(heap: Int, size: int, nodes: Int) -> None:
    """Take the first out of a heap of ``size`` + 1: its gap sinks down, the last rises from there."""
    at, child = 0, 1
    while child < size:
        if child + 1 < size and _precedes(heap[child + 1], heap[child], nodes):
            child += 1
        heap[at] = heap[child]
        at, child = child, 2 * child + 1
    _sift_up(heap, at, heap[size], nodes)


@_kernel
def _sift_up(heap: Int, at: int, k: int, nodes: Int) -> None:
    """Let node ``k`` rise from position ``at`` to its place."""
    while at > 0 and _precedes(k, heap[(at - 1) // 2], nodes):
        heap[at] = heap[(at - 1) // 2]
        at = (at - 1) // 2
    heap[at] = k

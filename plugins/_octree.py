"""The tree of an OctoMap (Hornung et al. 2013): its leaves a batch at a time, and the voxels of a leaf.

The file holds the inner nodes depth first; children are numbered with bit 0 along x, bit 1 along y, bit 2
along z. Keys count finest voxels: the voxel with key k has its centre at ``(k - 32768 + 0.5) * resolution``.
"""

import numpy as np
from numba import njit

DEPTH = 16  # levels of every OctoMap
HALF = 1 << (DEPTH - 1)  # key of the voxel whose lower corner is the origin
FREE, OCCUPIED = 0, 1
CUT, BAD = -1, -2  # the file ends inside the tree; a node has children below the finest level
STACK = DEPTH + 1


@njit(cache=True, nogil=True)
def binary_leaves(data, at, stack, top, leaves):
    """Leaves of a ``.bt`` tree: two bits a child (01 free, 10 occupied, 11 inner node) in 16 bits a node.

    ``stack`` (17, 5): x, y, z key, children's bits, next child of each open node; ``top`` the innermost one,
    0 before the first call. Fills ``leaves`` (K, 5) x, y, z key, level (side is 2^level), state; returns the
    place in ``data``, ``top`` (CUT or BAD where damaged, 0 once done) and the number of leaves.
    """
    count = 0
    if top == 0:
        if len(data) < 2:
            return at, CUT, count
        stack[1, 0], stack[1, 1], stack[1, 2] = 0, 0, 0
        stack[1, 3], stack[1, 4] = data[0] | (data[1] << 8), 0
        at, top = 2, 1
    while top > 0 and count < len(leaves):
        child = stack[top, 4]
        if child == 8:
            top -= 1
            continue
        stack[top, 4] = child + 1
        state = (stack[top, 3] >> (2 * child)) & 3
        if state == 0:
            continue
        level = DEPTH - top
        x = stack[top, 0] + ((child & 1) << level)
        y = stack[top, 1] + (((child >> 1) & 1) << level)
        z = stack[top, 2] + ((child >> 2) << level)
        if state == 3:
            if level == 0:
                return at, BAD, count
            if at + 2 > len(data):
                return at, CUT, count
            top += 1
            stack[top, 0], stack[top, 1], stack[top, 2] = x, y, z
            stack[top, 3], stack[top, 4] = data[at] | (data[at + 1] << 8), 0
            at += 2
        else:
            leaves[count, 0], leaves[count, 1], leaves[count, 2] = x, y, z
            leaves[count, 3], leaves[count, 4] = level, FREE if state == 1 else OCCUPIED
            count += 1
    return at, top, count


@njit(cache=True, nogil=True)
def full_leaves(data, record, at, stack, top, leaves):
    """Leaves of a ``.ot`` tree: a node is ``record`` bytes, float32 log odds first, and a byte of children.

    A leaf is occupied where its log odds are not negative. Else as :func:`binary_leaves`.
    """
    count = 0
    if top == 0:
        if len(data) < record + 1:
            return at, CUT, count
        stack[1, 0], stack[1, 1], stack[1, 2] = 0, 0, 0
        stack[1, 3], stack[1, 4] = data[record], 0
        at, top = record + 1, 1
    while top > 0 and count < len(leaves):
        child = stack[top, 4]
        if child == 8:
            top -= 1
            continue
        stack[top, 4] = child + 1
        if not (stack[top, 3] >> child) & 1:
            continue
        if at + record + 1 > len(data):
            return at, CUT, count
        level = DEPTH - top
        x = stack[top, 0] + ((child & 1) << level)
        y = stack[top, 1] + (((child >> 1) & 1) << level)
        z = stack[top, 2] + ((child >> 2) << level)
        occupied, bits = not (data[at + 3] & 0x80), data[at + record]  # the sign of a little-endian float32
        at += record + 1
        if bits:
            if level == 0:
                return at, BAD, count
            top += 1
            stack[top, 0], stack[top, 1], stack[top, 2] = x, y, z
            stack[top, 3], stack[top, 4] = bits, 0
        else:
            leaves[count, 0], leaves[count, 1], leaves[count, 2] = x, y, z
            leaves[count, 3], leaves[count, 4] = level, OCCUPIED if occupied else FREE
            count += 1
    return at, top, count


def voxels(leaves, number, resolution):
    """(N, 3) float64 centres of the finest voxels with the (N,) numbers ``number`` within (K, 5) leaves."""
    ends = np.cumsum(8 ** leaves[:, 3])
    leaf = np.searchsorted(ends, number, side="right")
    level = leaves[leaf, 3]
    rank = number - (ends[leaf] - 8**level)
    within = np.column_stack(
        [rank & ((1 << level) - 1), (rank >> level) & ((1 << level) - 1), rank >> (2 * level)]
    )
    return (leaves[leaf, :3] + within - (HALF - 0.5)) * resolution

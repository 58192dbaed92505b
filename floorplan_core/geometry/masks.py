"""Masks of a regular grid (row = y, column = x): patches, distances, widening, lines.

Written here because nothing else of OpenCV was needed, which is 150 MB of program
(docs/decisions/0024-without-opencv.md). Cost of each: linear in the cells.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bool = NDArray[np.bool_]
Float = NDArray[np.float64]
Labels = NDArray[np.int32]

# Lengths of a step along an axis, of a diagonal one and of a knight's move that keep the error of a 5 x 5
# chamfer distance smallest (Borgefors 1986, Distance transformations in digital images); error below 2 %.
_AXIS, _DIAGONAL, _KNIGHT = 1.0, 1.4, 2.1969


def label_patches(mask: Bool, connectivity: int = 4) -> tuple[Labels, int]:
    """The connected patches of ``mask``.

    :param connectivity: 4 or 8: do cells that touch at a corner only belong together.
    :return: (ny, nx) numbers from 1 in row order of the first cell, 0 outside; the number of patches.
    """
    labels, count = _label(np.ascontiguousarray(mask, dtype=np.bool_), connectivity == 8)
    return labels, int(count)


@njit(cache=True, nogil=True)
def _label(mask: Bool, corners: bool) -> tuple[Labels, int]:
    """Two passes with a union-find: the smaller number is the root, so that numbers keep row order."""
    ny, nx = mask.shape
    labels = np.zeros((ny, nx), np.int32)
    parent = np.zeros((ny * nx) // 2 + 2, np.int32)
    used = 0
    for y in range(ny):
        for x in range(nx):
            if not mask[y, x]:
                continue
            best = 0
            if x > 0 and mask[y, x - 1]:
                best = _root(parent, labels[y, x - 1])
            if y > 0:
                first, last = (max(x - 1, 0), min(x + 1, nx - 1)) if corners else (x, x)
                for k in range(first, last + 1):
                    if mask[y - 1, k]:
                        best = _join(parent, best, labels[y - 1, k])
            if best == 0:
                used += 1
                parent[used] = used
                best = used
            labels[y, x] = best
    count = 0
    for k in range(1, used + 1):
        if parent[k] == k:
            count += 1
            parent[k] = -count  # negative: final numbers, which no root can be mistaken for
        else:
            parent[k] = parent[parent[k]]
    for y in range(ny):
        for x in range(nx):
            if labels[y, x] > 0:
                labels[y, x] = -parent[labels[y, x]]
    return labels, count


@njit(cache=True, nogil=True)
def _root(parent: Labels, k: int) -> int:
    while parent[k] != k:
        parent[k] = parent[parent[k]]
        k = parent[k]
    return k


@njit(cache=True, nogil=True)
def _join(parent: Labels, a: int, b: int) -> int:
    """The root of both; ``a`` is a root, or 0 for none."""
    b = _root(parent, b)
    if a == 0 or a == b:
        return b
    low, high = min(a, b), max(a, b)
    parent[high] = low
    return low


def patch_boxes(labels: Labels, count: int) -> NDArray[np.int64]:
    """(count, 4) x, y, width, height of the patches 1 ... count, cells."""
    iy, ix = np.nonzero(labels)
    of = labels[iy, ix] - 1
    low = np.full((count, 2), max(labels.shape), dtype=np.int64)
    high = np.full((count, 2), -1, dtype=np.int64)
    for axis, at in ((0, ix), (1, iy)):
        np.minimum.at(low[:, axis], of, at)
        np.maximum.at(high[:, axis], of, at)
    return np.hstack([low, high - low + 1])


def widened(mask: Bool) -> Bool:
    """``mask`` and the eight neighbours of its cells."""
    wide = np.array(mask, dtype=np.bool_)
    wide[:, 1:] |= mask[:, :-1]
    wide[:, :-1] |= mask[:, 1:]
    out = wide.copy()
    out[1:] |= wide[:-1]
    out[:-1] |= wide[1:]
    return out


def opened(mask: Bool) -> Bool:
    """``mask`` without its parts narrower than three cells; beyond the grid counts as filled."""
    return widened(~widened(~mask))


def distance_to_gap(mask: Bool) -> Float:
    """(ny, nx) cells from the middle of each cell to that of the nearest False one, within 2 %.

    Beyond the grid there is no gap; a mask without any has the size of the grid everywhere.
    """
    far = float(mask.shape[0] + mask.shape[1])
    return np.asarray(_chamfer(np.ascontiguousarray(mask, dtype=np.bool_), far))


@njit(cache=True, nogil=True)
def _chamfer(mask: Bool, far: float) -> Float:
    """A pass from above and one from below."""
    ny, nx = mask.shape
    out = np.full((ny + 4, nx + 4), far)
    for y in range(2, ny + 2):
        for x in range(2, nx + 2):
            if not mask[y - 2, x - 2]:
                out[y, x] = 0.0
                continue
            out[y, x] = min(_before(out, y, x, -1), far)
    for y in range(ny + 1, 1, -1):
        for x in range(nx + 1, 1, -1):
            if out[y, x] > 0.0:
                out[y, x] = min(out[y, x], _before(out, y, x, 1))
    return out[2:-2, 2:-2].copy()


@njit(cache=True, nogil=True, inline="always")
def _before(out: Float, y: int, x: int, s: int) -> float:
    """The shortest way over a cell that the pass has been at; ``s``: -1 from above, 1 from below."""
    axis = min(out[y, x + s], out[y + s, x]) + _AXIS
    diagonal = min(out[y + s, x - 1], out[y + s, x + 1]) + _DIAGONAL
    flat = min(out[y + s, x - 2], out[y + s, x + 2])
    steep = min(out[y + 2 * s, x - 1], out[y + 2 * s, x + 1])
    return float(min(axis, diagonal, min(flat, steep) + _KNIGHT))


def line_cells(x0: int, y0: int, x1: int, y1: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Rows and columns of a line of cells of which each shares an edge with the next, both ends included."""
    dx, dy = abs(x1 - x0), abs(y1 - y0)
    # The line crosses the edges between columns and those between rows at these shares of its length.
    columns = (np.arange(dx) + 0.5) / max(dx, 1)
    rows = (np.arange(dy) + 0.5) / max(dy, 1)
    order = np.argsort(np.concatenate([columns, rows]), kind="stable")  # at a corner: sideways first
    sideways = np.concatenate([[False], (order < dx)])
    upright = np.concatenate([[False], (order >= dx)])
    x = x0 + (1 if x1 >= x0 else -1) * np.cumsum(sideways)
    y = y0 + (1 if y1 >= y0 else -1) * np.cumsum(upright)
    return y.astype(np.int64), x.astype(np.int64)

"""What lies beside and beyond a chord of the free space of a map: the kernels of :mod:`grid_map_passages`.

All lengths and coordinates are in cells; ``free[iy, ix]``. Cost: linear in the cells that are walked.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]
Bool = NDArray[np.bool_]
Int = NDArray[np.int64]

_kernel = njit(cache=True, nogil=True)
_STEP = 0.5  # cells: no cell along a line is jumped over unnoticed
_WIDENED = 1.15  # a passage through a thick wall ends where it is this much wider than the chord
_FEWEST = 3  # widths, below which nothing is known about a side
_FAN = (-1.0, -0.5, 0.0, 0.5, 1.0)  # radians from the normal, directions in which a hall is looked for


@_kernel
def march(free: Bool, x: float, y: float, dx: float, dy: float, limit: float) -> float:
    """How far the line from x, y stays in free cells, at most ``limit``."""
    n = 0.0
    while n < limit:
        i, j = round(x + dx * n), round(y + dy * n)
        if i < 0 or j < 0 or i >= free.shape[1] or j >= free.shape[0] or not free[j, i]:
            break
        n += _STEP
    return n


@_kernel
def in_sight(free: Bool, points: Float, pairs: Int, least: float) -> Bool:
    """(K,) pairs of points at least so far apart whose line stays in free cells.

    :param points: (N, 2) x, y; ``pairs``: (K, 2) rows of them.
    """
    out = np.zeros(len(pairs), np.bool_)
    for k in range(len(pairs)):
        x, y = points[pairs[k, 0]]
        dx, dy = points[pairs[k, 1], 0] - x, points[pairs[k, 1], 1] - y
        length = np.hypot(dx, dy)
        if length >= least:
            out[k] = march(free, x, y, dx / length, dy / length, length) >= length - _STEP
    return out


@_kernel
def wall_ahead(gap: Float, depth: Float, x: float, y: float, dx: float, dy: float, reach: Float) -> float:
    """Cells of wall in line beyond the end of a chord.

    :param gap: (ny, nx) distance to the next cell that is not free; ``depth``: to the next that is.
    :param reach: (3,) how far to look; how far from a wall's face, on either side, is still on the wall.
    """
    n = 1.0
    while n < reach[0]:
        i, j = round(x + dx * n), round(y + dy * n)
        if i < 0 or j < 0 or i >= gap.shape[1] or j >= gap.shape[0]:
            break
        if gap[j, i] > reach[1] or depth[j, i] > reach[2]:
            break
        n += _STEP
    return n


@_kernel
def opening(
    free: Bool, x: float, y: float, nx: float, ny: float, length: float, tunnel: float, span: float
) -> tuple[float, float]:
    """Width of a chord over the free width beyond it (median), and how far one can go straight ahead.

    Widths are taken parallel to the chord x, y at each step along its normal; up to ``tunnel`` cells in which
    it gets no wider are the thickness of the wall.
    """
    width = np.empty(int(tunnel + span))
    k = 0
    while k < len(width):
        px, py = x + nx * (k + 1), y + ny * (k + 1)
        i, j = round(px), round(py)
        if i < 0 or j < 0 or i >= free.shape[1] or j >= free.shape[0] or not free[j, i]:
            break
        width[k] = march(free, px, py, -ny, nx, 2 * length) + march(free, px, py, ny, -nx, 2 * length)
        k += 1
    a = 0
    while a < k and a < tunnel and width[a] < _WIDENED * length:
        a += 1
    b = min(k, a + int(span))
    if b - a < _FEWEST:
        return np.inf, float(k)
    return length / float(np.median(width[a:b])), float(k)


@_kernel
def hall_ahead(
    free: Bool, gap: Float, x: float, y: float, nx: float, ny: float, limit: float
) -> tuple[float, float]:
    """Radius of the largest free circle that is met beyond a chord, and how far one can go straight ahead."""
    best, ahead = 0.0, 0.0
    for turn in _FAN:
        c, s = np.cos(turn), np.sin(turn)
        dx, dy, n = c * nx - s * ny, s * nx + c * ny, 2.0
        while n < limit:
            i, j = round(x + dx * n), round(y + dy * n)
            if i < 0 or j < 0 or i >= free.shape[1] or j >= free.shape[0] or not free[j, i]:
                break
            best = max(best, gap[j, i])
            n += 1.0
        if turn == 0.0:
            ahead = n
    return best, ahead

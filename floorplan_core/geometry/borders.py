"""Borders of the patches of a mask as rings of cells, and rings with fewer corners.

Border following after Suzuki and Abe (1985, Topological structural analysis of digitized binary images by
border following): the cells of a patch along its outside and along each of its holes, in order. Cells that
touch at a corner belong together. Rings are simplified after Douglas and Peucker (1973).
Cost: linear in the cells; border cells times the depth of the subdivision.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numba import njit
from numpy.typing import NDArray

Bool = NDArray[np.bool_]
Float = NDArray[np.float64]
Int = NDArray[np.int32]

_STARTS = 3  # times that the farthest cell is looked for: both ends of a long ring
_FLAT = 0.5  # of the tolerance, squared: corners nearer to the line of their neighbours go


@dataclass(frozen=True)
class Border:
    """One closed walk along border cells."""

    cells: Int  # (N, 2) x, y; the last is followed by the first
    hole: bool  # runs around a hole of its patch


def find_borders(mask: Bool) -> list[Border]:
    """All borders of ``mask`` (ny, nx), in row order of their first cells."""
    padded = np.pad(np.asarray(mask, dtype=np.int8), 1)
    cells, starts, holes = _follow_all(padded)
    rings = np.split(cells, starts)[1:]  # before the first there is nothing
    return [Border(ring, bool(hole)) for ring, hole in zip(rings, holes, strict=True)]


@njit(cache=True, nogil=True)
def _follow_all(f: NDArray[np.int8]) -> tuple[Int, NDArray[np.int64], Bool]:
    """``f``: 1 in the patches, with a margin of 0; becomes 2 where a border passed, -2 with a gap at east."""
    cells = np.empty((1024, 2), np.int32)
    starts = np.empty(64, np.int64)
    holes = np.empty(64, np.bool_)
    used = count = 0
    for y in range(1, f.shape[0] - 1):
        for x in range(1, f.shape[1] - 1):
            outside = f[y, x] == 1 and f[y, x - 1] == 0
            if not outside and not (f[y, x] >= 1 and f[y, x + 1] == 0):
                continue
            if count == len(starts):
                starts, holes = np.append(starts, starts), np.append(holes, holes)
            starts[count], holes[count] = used, not outside
            count += 1
            cells, used = _follow(f, y, x, 4 if outside else 0, cells, used)
    return cells[:used].copy(), starts[:count].copy(), holes[:count].copy()


@njit(cache=True, nogil=True)
def _follow(f: NDArray[np.int8], y: int, x: int, back: int, cells: Int, used: int) -> tuple[Int, int]:
    """Append one border that begins at (x, y); ``back``: direction of a gap beside its first cell.

    Directions count from east, a quarter turn from +x to -y in two steps.
    """
    dx = (1, 1, 0, -1, -1, -1, 0, 1)
    dy = (0, -1, -1, -1, 0, 1, 1, 1)
    first = -1
    for k in range(1, 8):
        d = (back - k) % 8
        if f[y + dy[d], x + dx[d]] != 0:
            first = d
            break
    if first < 0:
        f[y, x] = -2
        return _append(cells, used, x - 1, y - 1), used + 1
    py, px, towards = y, x, first
    while True:
        east_is_gap = False
        for k in range(1, 9):
            d = (towards + k) % 8
            if f[py + dy[d], px + dx[d]] != 0:
                break
            if d == 0:
                east_is_gap = True
        if east_is_gap:
            f[py, px] = -2
        elif f[py, px] == 1:
            f[py, px] = 2
        cells = _append(cells, used, px - 1, py - 1)
        used += 1
        ny, nx = py + dy[d], px + dx[d]
        if ny == y and nx == x and py == y + dy[first] and px == x + dx[first]:
            return cells, used
        towards = (d + 4) % 8
        py, px = ny, nx


@njit(cache=True, nogil=True, inline="always")
def _append(cells: Int, used: int, x: int, y: int) -> Int:
    if used == len(cells):
        cells = np.concatenate((cells, cells))
    cells[used, 0], cells[used, 1] = x, y
    return cells


def simplified(ring: NDArray[np.generic], tolerance: float) -> Float:
    """(M, 2) corners of a ring such that none of its points deviates more than about ``tolerance``."""
    points: Float = np.ascontiguousarray(ring, dtype=np.float64)
    if len(points) < 2:
        return points
    kept = np.flatnonzero(_corners(points, tolerance))
    return np.asarray(points[kept[_not_flat(points[kept], tolerance)]])


@njit(cache=True, nogil=True)
def _corners(points: Float, tolerance: float) -> Bool:
    """(N,) True at the corners that the subdivision keeps; it begins at two points far from each other."""
    n = len(points)
    keep = np.zeros(n, np.bool_)
    a = b = 0
    for _ in range(_STARTS):
        a = b
        square = (points[:, 0] - points[a, 0]) ** 2 + (points[:, 1] - points[a, 1]) ** 2
        b = (a + int(np.argmax(np.roll(square, -a)))) % n  # of equally far ones the next along the ring
    if (points[a, 0] - points[b, 0]) ** 2 + (points[a, 1] - points[b, 1]) ** 2 <= tolerance**2:
        keep[a] = True
        return keep
    keep[a] = keep[b] = True
    stack = [(a, b if b > a else b + n), (b, a if a > b else a + n)]
    while len(stack) > 0:
        low, high = stack.pop()
        most, at = tolerance**2, -1
        for k in range(low + 1, high):
            off = _square_off(points[k % n], points[low % n], points[high % n])
            if off > most:
                most, at = off, k
        if at >= 0:
            keep[at % n] = True
            stack.append((low, at))
            stack.append((at, high))
    return keep


@njit(cache=True, nogil=True)
def _square_off(point: Float, a: Float, b: Float) -> float:
    """Square of the distance between a point and the segment from ``a`` to ``b``."""
    ex, ey = b[0] - a[0], b[1] - a[1]
    px, py = point[0] - a[0], point[1] - a[1]
    along = px * ex + py * ey
    if along <= 0:
        return float(px**2 + py**2)
    length = ex**2 + ey**2
    if along >= length:
        return float((px - ex) ** 2 + (py - ey) ** 2)
    return float((py * ex - px * ey) ** 2 / length)


@njit(cache=True, nogil=True)
def _not_flat(points: Float, tolerance: float) -> Bool:
    """(M,) False at corners that hardly leave the line between their neighbours; never two in a row."""
    n = len(points)
    keep = np.ones(n, np.bool_)
    left, last, k = n, n - 1, 0
    while k < n and left > 2:
        after = (k + 1) % n
        ex, ey = points[after, 0] - points[last, 0], points[after, 1] - points[last, 1]
        mx, my = points[k, 0] - points[last, 0], points[k, 1] - points[last, 1]
        ahead = mx * (points[after, 0] - points[k, 0]) + my * (points[after, 1] - points[k, 1])
        slanting = ex != 0 and ey != 0  # along an axis the subdivision leaves nothing of this kind
        if slanting and ahead >= 0 and (mx * ey - my * ex) ** 2 <= _FLAT * tolerance**2 * (ex**2 + ey**2):
            keep[k] = False
            left, last, k = left - 1, after, k + 2
        else:
            last, k = k, k + 1
    return keep


def smallest_box(points: Float) -> tuple[float, float]:
    """The shorter and the longer side of the rectangle of least area, in any direction, around (N, 2) points.

    One of its sides lies along an edge of the convex hull (Freeman and Shapira 1975).
    """
    hull = shapely.get_coordinates(shapely.MultiPoint(points).convex_hull)
    edges = np.diff(hull, axis=0)
    if len(edges) == 0:
        return 0.0, 0.0
    along = edges / np.hypot(edges[:, 0], edges[:, 1])[:, None]
    spans = np.stack([np.ptp(hull @ along.T, axis=0), np.ptp(hull @ (along[:, ::-1] * [-1, 1]).T, axis=0)])
    short, long = np.sort(spans[:, int(np.argmin(spans[0] * spans[1]))])
    return float(short), float(long)

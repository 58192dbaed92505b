"""Which points lie in which of many upright boxes: a grid of cells knows the boxes that touch each cell."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.halves import in_halves

Float = NDArray[np.float64]
Int = NDArray[np.int64]

_WORTH = 200_000  # points from which two threads are faster than one


@dataclass(frozen=True)
class BoxIndex:
    """Boxes over the plan, and for each cell of a grid those that touch it."""

    boxes: Float  # (K, 4) metres: x0, y0, x1, y1
    origin: Float  # (2,) metres, lower left corner of the grid
    cell: float  # metres, side of a cell
    shape: tuple[int, int]  # ny, nx
    first: NDArray[np.int32]  # (ny * nx + 1,) where the boxes of a cell begin in ``touching``
    touching: NDArray[np.int32]  # rows of ``boxes``, cell by cell, each cell's in rising order


def index_boxes(boxes: Float, origin: Float, cell: float, shape: tuple[int, int]) -> BoxIndex:
    """The index of (K, 4) boxes x0, y0, x1, y1 (metres) over a grid of ``shape`` ny, nx."""
    first, touching = _touching(boxes, origin, cell, *shape)
    return BoxIndex(boxes, origin, cell, shape, first, touching)


def points_in_boxes(points: Float, index: BoxIndex) -> list[Int]:
    """For each box the rows of the (N, 2 or 3) ``points`` in it (its edges included), in order.

    Points that lie more than a cell outside the grid are in none.
    Cost: one pass over the points, and one over those near a box.
    """
    count = len(index.boxes)
    if not count:
        return []
    parts: dict[int, tuple[Int, Int]] = {}

    def collect(start: int, stop: int) -> None:
        parts[start] = _rows(points, index.boxes, *_grid_of(index), start, stop)

    in_halves(collect, len(points), _WORTH)
    halves = [
        [rows[a:b] for a, b in pairwise(ends.tolist())] for rows, ends in (parts[k] for k in sorted(parts))
    ]
    return [np.concatenate(found) for found in zip(*halves, strict=True)]


def _grid_of(index: BoxIndex) -> tuple[Float, float, int, int, NDArray[np.int32], NDArray[np.int32]]:
    return index.origin, index.cell, *index.shape, index.first, index.touching


@njit(cache=True, nogil=True)
def _touching(boxes, origin, cell, ny, nx):  # type: ignore[no-untyped-def]
    """For each cell the boxes that touch it: where they begin, and their numbers."""
    per_metre = (
        1.0 / cell
    )  # a factor rounds otherwise than a quotient, but here as where points are looked up
    spans = np.empty((len(boxes), 4), dtype=np.int64)
    first = np.zeros(ny * nx + 1, dtype=np.int32)
    for b in range(len(boxes)):
        spans[b, 0] = max(0, int((boxes[b, 0] - origin[0]) * per_metre))
        spans[b, 1] = max(0, int((boxes[b, 1] - origin[1]) * per_metre))
        spans[b, 2] = min(nx, int((boxes[b, 2] - origin[0]) * per_metre) + 1)
        spans[b, 3] = min(ny, int((boxes[b, 3] - origin[1]) * per_metre) + 1)
        for iy in range(spans[b, 1], spans[b, 3]):
            for ix in range(spans[b, 0], spans[b, 2]):
                first[iy * nx + ix + 1] += 1
    for c in range(ny * nx):
        first[c + 1] += first[c]
    touching, used = np.empty(first[-1], dtype=np.int32), first.copy()
    for b in range(len(boxes)):
        for iy in range(spans[b, 1], spans[b, 3]):
            for ix in range(spans[b, 0], spans[b, 2]):
                touching[used[iy * nx + ix]] = b
                used[iy * nx + ix] += 1
    return first, touching


@njit(cache=True, nogil=True)
def _rows(points, boxes, origin, cell, ny, nx, first, touching, start, stop):  # type: ignore[no-untyped-def]
    """Rows from ``start`` to ``stop`` of the points in each box, and where those of each box begin."""
    per_metre = 1.0 / cell
    near = np.empty(stop - start, dtype=np.int64)  # pages that are never written are never taken
    ends, many = np.zeros(len(boxes) + 1, dtype=np.int64), 0
    for i in range(start, stop):
        x, y = points[i, 0], points[i, 1]
        ix, iy = int((x - origin[0]) * per_metre), int((y - origin[1]) * per_metre)
        if not (0 <= ix < nx and 0 <= iy < ny):
            continue
        hit = False
        for k in range(first[iy * nx + ix], first[iy * nx + ix + 1]):
            b = touching[k]
            if boxes[b, 0] <= x <= boxes[b, 2] and boxes[b, 1] <= y <= boxes[b, 3]:
                ends[b + 1] += 1
                hit = True
        near[many] = i
        many += hit
    ends = np.cumsum(ends)
    rows, used = np.empty(ends[-1], dtype=np.int64), ends.copy()
    for n in range(many):
        i = near[n]
        x, y = points[i, 0], points[i, 1]
        ix, iy = int((x - origin[0]) * per_metre), int((y - origin[1]) * per_metre)
        for k in range(first[iy * nx + ix], first[iy * nx + ix + 1]):
            b = touching[k]
            if boxes[b, 0] <= x <= boxes[b, 2] and boxes[b, 1] <= y <= boxes[b, 3]:
                rows[used[b]] = i
                used[b] += 1
    return rows, ends

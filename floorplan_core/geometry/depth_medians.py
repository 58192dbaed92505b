"""How deep behind upright faces the surfaces lie: medians of points in bins along each face.

Many faces at once, and several bands of height. Cost: one pass over the points, and a selection (no sorting)
among those near a face.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.boxes import BoxIndex
from floorplan_core.geometry.halves import in_halves

Float = NDArray[np.float64]
Int = NDArray[np.int64]

_WORTH = 200_000  # points from which two threads are faster than one
_START = 1 << 16  # hits for which there is room at first


@dataclass(frozen=True)
class Faces:
    """Upright faces along the axes of the plan, each divided into bins; all (K,)."""

    axis: Int  # 0: the face lies at one x, 1: at one y
    sign: Int  # 1: it looks along its axis, -1: against it
    offset: Float  # metres along the axis
    start: Float  # metres along the face, where the first bin begins
    bins: Int  # how many there are


def median_depths(
    faces: Faces,
    near: BoxIndex,
    points: Float,
    view: Float,
    bands: Float,
    step: float,
    sideways: float,
    least: int,
) -> list[Float]:
    """For each face (M, bins) metres behind it: the upper median of the points in each bin; else NaN.

    :param near: the box of each face; points outside it do not count.
    :param points: (N, 3) metres; ``view``: (N, 2) mean unit direction to the sensor.
    :param bands: (M, 2) metres of height that do not meet; their ends are not in them.
    :param step: metres, length of a bin.
    :param sideways: cosine of the steepest view from the front that counts.
    :param least: points whose median is believed.
    """
    bounds = np.concatenate([[0], np.cumsum(faces.bins)])
    parts: dict[int, tuple[NDArray[np.int32], Float]] = {}
    grid = (near.boxes, near.origin, near.cell, *near.shape, near.first, near.touching)
    about = (faces.axis, faces.sign, faces.offset, faces.start, bounds, bands, step, sideways)
    most = int(np.diff(near.first).max())  # faces that one point may lie behind

    def collect(start: int, stop: int) -> None:
        group, depth, used = np.empty(_START, dtype=np.int32), np.empty(_START), 0
        while True:
            start, used = _depths(points, view, *grid, *about, start, stop, group, depth, used, most)
            if start == stop:
                break
            group, depth = _twice(group), _twice(depth)
        parts[stop] = group[:used], depth[:used]

    in_halves(collect, len(points), _WORTH)
    group, depth = (np.concatenate(p) for p in zip(*(parts[k] for k in sorted(parts)), strict=True))
    medians = _medians(group, depth, len(bands) * int(bounds[-1]), least).reshape(len(bands), -1)
    return np.split(medians, bounds[1:-1], axis=1)


def _twice(values: NDArray[Any]) -> NDArray[Any]:
    """The values with as much room again."""
    out = np.empty(2 * len(values), dtype=values.dtype)
    out[: len(values)] = values
    return out


@njit(cache=True, nogil=True)
def _depths(  # type: ignore[no-untyped-def]
    points, view, boxes, origin, cell, ny, nx, first, touching,
    axis, sign, offset, start, bounds, bands, step, sideways, begin, end, group, depth, used, most,
):  # fmt: skip
    """Bin and depth of each hit from point ``begin`` on; the bins of the second band come after the first's.

    Ends before the point for whose up to ``most`` hits there may be no room, with the hits so far.
    """
    per_metre, all_bins, lowest, highest = 1.0 / cell, bounds[-1], bands.min(), bands.max()
    for i in range(begin, end):
        z = points[i, 2]
        if not lowest < z < highest:
            continue
        ix = int((points[i, 0] - origin[0]) * per_metre)
        iy = int((points[i, 1] - origin[1]) * per_metre)
        if not (0 <= ix < nx and 0 <= iy < ny):
            continue
        k0, k1 = first[iy * nx + ix], first[iy * nx + ix + 1]
        if k0 == k1:
            continue
        band = 0
        while band < len(bands) and not bands[band, 0] < z < bands[band, 1]:
            band += 1
        if band == len(bands):
            continue
        if used + most > len(group):
            return i, used
        for k in range(k0, k1):
            b = touching[k]
            if not (
                boxes[b, 0] <= points[i, 0] <= boxes[b, 2] and boxes[b, 1] <= points[i, 1] <= boxes[b, 3]
            ):
                continue
            a = axis[b]
            if view[i, a] * sign[b] <= sideways:
                continue
            along = int((points[i, 1 - a] - start[b]) / step)
            group[used] = band * all_bins + bounds[b] + min(max(along, 0), bounds[b + 1] - bounds[b] - 1)
            depth[used] = (offset[b] - points[i, a]) * sign[b]
            used += 1
    return end, used


@njit(cache=True, nogil=True)
def _medians(group, value, groups, least):  # type: ignore[no-untyped-def]
    """(groups,) the upper median of the values of each group; NaN where there are fewer than ``least``."""
    first = np.zeros(groups + 1, dtype=np.int64)
    for g in group:
        first[g + 1] += 1
    first = np.cumsum(first)
    ordered, used = np.empty(len(value)), first.copy()
    for i in range(len(group)):
        ordered[used[group[i]]] = value[i]
        used[group[i]] += 1
    out = np.full(groups, np.nan)
    for g in range(groups):
        count = first[g + 1] - first[g]
        if count >= least:
            out[g] = _select(ordered, first[g], first[g + 1] - 1, first[g] + count // 2)
    return out


@njit(cache=True, nogil=True)
def _select(values, low, high, k):  # type: ignore[no-untyped-def]
    """What would stand at ``k`` were ``values`` from ``low`` to ``high`` sorted; reorders them (Hoare)."""
    while low < high:
        pivot = values[(low + high) // 2]
        i, j = low, high
        while i <= j:
            while values[i] < pivot:
                i += 1
            while values[j] > pivot:
                j -= 1
            if i <= j:
                values[i], values[j] = values[j], values[i]
                i += 1
                j -= 1
        if k <= j:
            high = j
        elif k >= i:
            low = i
        else:
            break
    return values[k]

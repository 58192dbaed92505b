"""Which rectangles of the cover make one region: those that overlap, or meet where there is no wall.

Planes of opposite facing rarely coincide, so two rectangles of one room may meet in a border a few
centimetres wide; an open border is bridged. Cost: pairs of rectangles by sorting out with arrays, then walls
near a border.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.model import Door, LayoutPlane

Float = NDArray[np.float64]

_OVERLAP = 0.3  # m on both sides: less is a shared border, not an overlap
_PASSAGE = 0.6  # m of a shared border without wall or door, from which two rectangles are one region
_NEAR = 0.2  # m between a border and the wall that stands on it


def separators(planes: Sequence[LayoutPlane], doors: Sequence[Door]) -> dict[int, Float]:
    """By axis of the normal: (K, 3) offset, start and end of everything that keeps two rectangles apart."""
    out = {}
    for axis in (0, 1):
        rows = [(p.offset, s, e) for p in planes if p.facing.axis == axis for s, e in p.walls]
        rows += [(d.offset, d.start, d.end) for d in doors if d.axis == axis]
        out[axis] = np.array(rows, dtype=np.float64).reshape(-1, 3)
    return out


def connected_groups(bounds: Float, walls: dict[int, Float]) -> list[tuple[NDArray[np.int64], Float]]:
    """Rectangles (C, 4) that belong together: they overlap, or share a border that is not all wall.

    Each group is its rows, and the boxes (K, 4) that join what a border of a few centimetres parts.
    """
    if len(bounds) == 0:
        return []
    x0, y0, x1, y1 = bounds.T
    wide = np.minimum(x1[:, None], x1) - np.maximum(x0[:, None], x0)
    high = np.minimum(y1[:, None], y1) - np.maximum(y0[:, None], y0)
    linked = (wide > _OVERLAP) & (high > _OVERLAP)
    label = _components(linked)
    parted = (np.minimum(wide, high) < 0) | (
        label[:, None] != label
    )  # others touch and are one region anyway
    border = parted & (np.minimum(wide, high) > -_OVERLAP) & (np.maximum(wide, high) > _PASSAGE) & ~linked
    pairs = np.argwhere(np.triu(border, 1))
    axes = np.where(wide[pairs[:, 0], pairs[:, 1]] < high[pairs[:, 0], pairs[:, 1]], 0, 1)
    pair, boxes = _open_borders(bounds, pairs, axes, *(_by_offset(walls[axis]) for axis in (0, 1)))
    first, second = pairs[pair].T
    linked[first, second] = linked[second, first] = True
    label = _components(linked)
    groups = [np.flatnonzero(label == k) for k in range(int(label.max()) + 1)]
    return [(g, boxes[label[first] == k]) for k, g in enumerate(groups)]  # by row, as they were found


@njit(cache=True, nogil=True)
def _components(linked):  # type: ignore[no-untyped-def]
    """(C,) the component of each node of a symmetric adjacency matrix, numbered by their first nodes.

    A few lines, where the module of SciPy that has it takes a quarter of a second to import.
    """
    label = np.full(len(linked), -1, dtype=np.int64)
    open_, number = np.empty(len(linked), dtype=np.int64), 0
    for node in range(len(linked)):
        if label[node] >= 0:
            continue
        label[node], open_[0], many = number, node, 1
        while many > 0:
            many -= 1
            at = open_[many]
            for other in range(len(linked)):
                if linked[at, other] and label[other] < 0:
                    label[other], open_[many] = number, other
                    many += 1
        number += 1
    return label


def _by_offset(walls: Float) -> Float:
    """The walls in the order of their offsets; of equal ones in that of their starts and ends."""
    return walls[np.lexsort((walls[:, 2], walls[:, 1], walls[:, 0]))]


def _open_borders(
    bounds: Float, pairs: NDArray[np.int64], axes: NDArray[np.int64], upright: Float, level: Float
) -> tuple[NDArray[np.int64], Float]:
    """Boxes across the parts of the borders of pairs of rectangles that are not wall, and the pair of each.

    :param axes: (P,) across which each border lies; ``upright`` and ``level`` walls are by offset.
    """
    counted = _fill_borders(bounds, pairs, axes, upright, level, np.empty(0, np.int64), np.empty((0, 4)))
    pair, boxes = np.empty(counted, dtype=np.int64), np.empty((counted, 4))
    _fill_borders(bounds, pairs, axes, upright, level, pair, boxes)
    return pair, boxes


@njit(cache=True, nogil=True)
def _fill_borders(bounds, pairs, axes, upright, level, pair, boxes):  # type: ignore[no-untyped-def]
    """Fill ``pair`` and ``boxes`` as far as there is room; returns how many there are."""
    count = 0
    runs = np.empty((max(len(upright), len(level)) + 1, 2))
    for p in range(len(pairs)):
        a, b, axis = bounds[pairs[p, 0]], bounds[pairs[p, 1]], axes[p]
        walls = upright if axis == 0 else level
        u0, u1 = max(a[axis], b[axis]), min(a[axis + 2], b[axis + 2])
        u0, u1 = min(u0, u1), max(u0, u1)
        at, high = max(a[1 - axis], b[1 - axis]), min(a[3 - axis], b[3 - axis])
        many = _runs_near(walls, u0 - _NEAR, u1 + _NEAR, runs)
        runs[many, 0] = runs[many, 1] = high
        for r in range(many + 1):
            end = min(runs[r, 0], high)
            if end - at >= _PASSAGE:
                if count < len(boxes):
                    pair[count] = p
                    boxes[count, axis], boxes[count, axis + 2] = u0, u1
                    boxes[count, 1 - axis], boxes[count, 3 - axis] = at, end
                count += 1
            at = max(at, runs[r, 1])
    return count


@njit(cache=True, nogil=True)
def _runs_near(walls, low, high, runs):  # type: ignore[no-untyped-def]
    """Put start and end of the walls between two offsets, neither included, into ``runs``, in order."""
    many = 0
    for w in range(np.searchsorted(walls[:, 0], low, side="right"), len(walls)):
        if walls[w, 0] >= high:
            break
        k = many
        while k > 0 and runs[k - 1, 0] > walls[w, 1]:
            runs[k, 0], runs[k, 1] = runs[k - 1, 0], runs[k - 1, 1]
            k -= 1
        runs[k, 0], runs[k, 1] = walls[w, 1], walls[w, 2]
        many += 1
    return many

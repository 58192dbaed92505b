"""Which rectangles of the cover make one region: those that overlap, or meet where there is no wall.

Planes of opposite facing rarely coincide, so two rectangles of one room may meet in a border a few
centimetres wide; an open border is bridged. Cost: pairs of rectangles that meet, then walls near a border.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
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
    a, b = _neighbours(bounds)
    wide, high = (  # metres in common along x and along y; negative: between them
        np.minimum(bounds[a, k + 2], bounds[b, k + 2]) - np.maximum(bounds[a, k], bounds[b, k])
        for k in (0, 1)
    )
    over = (wide > _OVERLAP) & (high > _OVERLAP)
    label = _components(len(bounds), a[over], b[over])
    least, most = np.minimum(wide, high), np.maximum(wide, high)
    parted = (least < 0) | (label[a] != label[b])  # of two that touch and belong together none is asked for
    shared = parted & (least > -_OVERLAP) & (least <= _OVERLAP) & (most > _PASSAGE)
    borders = np.column_stack([a, b, np.where(wide < high, 0, 1)])[shared]
    border, boxes = _open_borders(bounds, borders, *(_by_offset(walls[axis]) for axis in (0, 1)))
    first, second, _ = borders[border].T
    label = _components(len(bounds), np.append(a[over], first), np.append(b[over], second))
    groups = [np.flatnonzero(label == k) for k in range(int(label.max()) + 1)]
    return [(g, boxes[label[first] == k]) for k, g in enumerate(groups)]  # by row, as they were found


def _neighbours(bounds: Float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The pairs of rectangles that overlap or lie close to each other, in order; each pair once."""
    low, high = bounds[:, :2] - _OVERLAP, bounds[:, 2:] + _OVERLAP
    around = shapely.box(*low.T, *high.T)
    a, b = shapely.STRtree(around).query(around)
    once = a < b
    order = np.lexsort((b[once], a[once]))
    return a[once][order], b[once][order]


def _components(count: int, first: NDArray[np.int64], second: NDArray[np.int64]) -> NDArray[np.int64]:
    """(C,) the component of each of ``count`` nodes of which pairs are linked, numbered by their first nodes.

    A few lines, where the module of SciPy that has it takes a quarter of a second to import.
    """
    return np.asarray(np.unique(_roots(count, first, second), return_inverse=True)[1])


@njit(cache=True, nogil=True)
def _roots(count, first, second):  # type: ignore[no-untyped-def]
    """(C,) the first node of the component of each node."""
    root = np.arange(count)
    for k in range(len(first)):
        a, b = first[k], second[k]
        while root[a] != a:
            root[a] = root[root[a]]
            a = root[a]
        while root[b] != b:
            root[b] = root[root[b]]
            b = root[b]
        root[max(a, b)] = min(a, b)
    for node in range(count):
        root[node] = root[root[node]]  # that of a lower node is known
    return root


def _by_offset(walls: Float) -> Float:
    """The walls in the order of their offsets; of equal ones in that of their starts and ends."""
    return walls[np.lexsort((walls[:, 2], walls[:, 1], walls[:, 0]))]


def _open_borders(
    bounds: Float, borders: NDArray[np.int64], upright: Float, level: Float
) -> tuple[NDArray[np.int64], Float]:
    """Boxes across the parts of the borders that are not wall, and the border of each.

    :param borders: (P, 3) the two rectangles, and the axis across which it lies.
    :param upright: walls across x by offset; ``level``: across y.
    """
    counted = _fill_borders(bounds, borders, upright, level, np.empty(0, np.int64), np.empty((0, 4)))
    border, boxes = np.empty(counted, dtype=np.int64), np.empty((counted, 4))
    _fill_borders(bounds, borders, upright, level, border, boxes)
    return border, boxes


@njit(cache=True, nogil=True)
def _fill_borders(bounds, borders, upright, level, border, boxes):  # type: ignore[no-untyped-def]
    """Fill ``border`` and ``boxes`` as far as there is room; returns how many there are."""
    count = 0
    runs = np.empty((max(len(upright), len(level)) + 1, 2))
    for p in range(len(borders)):
        a, b, axis = bounds[borders[p, 0]], bounds[borders[p, 1]], borders[p, 2]
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
                    border[count] = p
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

"""Which rectangles of the cover make one region: those that overlap, or meet where there is no wall.

Planes of opposite facing rarely coincide, so two rectangles of one room may meet in a border a few
centimetres wide; an open border is bridged. Cost: pairs of rectangles by sorting out with arrays, then walls
near a border.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import Door, LayoutPlane

Float = NDArray[np.float64]
Box = tuple[float, float, float, float]  # x0, y0, x1, y1

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
    bridges: dict[int, list[Box]] = {}
    boxes, by_offset = bounds.tolist(), {axis: _by_offset(rows) for axis, rows in walls.items()}
    for i, j in np.argwhere(np.triu(border, 1)).tolist():
        axis = 0 if wide[i, j] < high[i, j] else 1
        joints = _open_border(boxes[i], boxes[j], axis, *by_offset[axis])
        if joints:
            linked[i, j] = linked[j, i] = True
            bridges.setdefault(i, []).extend(joints)
    label = _components(linked)
    groups = [np.flatnonzero(label == k) for k in range(int(label.max()) + 1)]
    return [(g, np.array([b for i in g for b in bridges.get(int(i), [])]).reshape(-1, 4)) for g in groups]


def _components(linked: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(C,) the component of each node of a symmetric adjacency matrix, numbered by their first nodes.

    A few lines, where the module of SciPy that has it takes a quarter of a second to import.
    """
    label = np.full(len(linked), -1, dtype=np.int64)
    for first in range(len(linked)):
        if label[first] < 0:
            number = int(label.max()) + 1
            label[first], open_ = number, [first]
            while open_:
                new = np.flatnonzero(linked[open_.pop()] & (label < 0))
                label[new] = number
                open_ += new.tolist()
    return label


def _by_offset(walls: Float) -> tuple[list[float], list[tuple[float, float]]]:
    """The offsets in order, and start and end of each."""
    ordered = walls[np.argsort(walls[:, 0], kind="stable")]
    return ordered[:, 0].tolist(), [(s, e) for s, e in ordered[:, 1:].tolist()]


def _open_border(
    a: list[float], b: list[float], axis: int, offsets: list[float], runs: list[tuple[float, float]]
) -> list[Box]:
    """Boxes across the parts of the border of two rectangles that are not wall or door, if wide enough."""
    near = sorted((max(a[axis], b[axis]), min(a[axis + 2], b[axis + 2])))
    low, high = max(a[1 - axis], b[1 - axis]), min(a[3 - axis], b[3 - axis])
    hit = runs[bisect_right(offsets, near[0] - _NEAR) : bisect_left(offsets, near[1] + _NEAR)]
    at, boxes = low, []
    for start, end in [*sorted(hit), (high, high)]:
        v0, v1 = at, min(start, high)
        if v1 - v0 >= _PASSAGE:
            boxes.append((near[0], v0, near[1], v1) if axis == 0 else (v0, near[0], v1, near[1]))
        at = max(at, end)
    return boxes

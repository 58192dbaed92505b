"""Steps in a side: where the wall along it stands farther back, or nearer, than the rest of it.

A rectangle has straight sides, and each goes to the median of the surfaces along it. A long wall may step all
the same, by less than two planes are told apart by: along a corridor the fronts of some offices stand twenty
centimetres behind those of others. Where only surfaces of another offset stand along a part of a side, and
enough was seen of them, that part is moved to them. In: a polygon, the table of surfaces. Out: the polygon
with steps. Cost: long sides times the surfaces beside each.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.rectilinear import corners

Float = NDArray[np.float64]

_REACH = 0.3  # m between a side and a surface that its wall steps back, or forward, to
_STEP = 0.12  # m: a smaller step is within the voxels
_STANDS = 0.7  # m of its height seen on average: less is a beam or the rail of a panel
_PILLAR = 0.6  # m: a shorter surface before a wall is a pillar
_LEAST = 2.0  # m of wall that must have been seen, and share of the step
_SHARE = 0.5


def add_steps(polygon: Any, seen: Float, first: NDArray[np.int64], placed: Float) -> Any:
    """``polygon`` with steps in its long sides, but for those on walls that were placed by hand.

    :param seen: (K, 6) offset, start, end, residual, plane, mean height; by facing, then offset.
    :param first: (5,) where the rows of a facing begin.
    :param placed: (H, 5) facing, offset, start, end, plane of the walls moved or added by hand.
    """
    polygon = shapely.orient_polygons(polygon)
    points = corners(shapely.get_coordinates(polygon.exterior))
    for a, b in zip(points, np.roll(points, -1, axis=0), strict=True):
        if np.abs(b - a).max() < 2 * _LEAST:
            continue
        axis = int(abs(b[1] - a[1]) < abs(b[0] - a[0]))
        out = 1.0 if (b[1 - axis] > a[1 - axis]) == (axis == 0) else -1.0  # the inside is at the left
        facing = 2 * axis + int(out > 0)
        low, high = sorted((a[1 - axis], b[1 - axis]))
        by_hand = (placed[:, 0] == facing) & (np.abs(placed[:, 1] - a[axis]) < _STEP)
        if (by_hand & (placed[:, 2] < high) & (placed[:, 3] > low)).any():
            continue
        rows = seen[first[facing] : first[facing + 1]]
        for start, end, offset in _steps(_beside(rows, float(a[axis]), low, high), low, high):
            u0, u1 = sorted((float(a[axis]), offset))
            box = shapely.box(u0, start, u1, end) if axis == 0 else shapely.box(start, u0, end, u1)
            backwards = (offset - a[axis]) * out > 0
            stepped = polygon.union(box) if backwards else polygon.difference(box)
            polygon = stepped if stepped.geom_type == "Polygon" else polygon
    return polygon


def _beside(rows: Float, at: float, low: float, high: float) -> Float:
    """(M, 5) deviation, start, end, offset, m2 of the surfaces that stand along a side, by start."""
    first, last = np.searchsorted(rows[:, 0], [at - _REACH, at + _REACH])
    near = rows[first:last]
    near = near[(near[:, 5] >= _STANDS) & (near[:, 1] < high) & (near[:, 2] > low)]
    start, end = np.maximum(near[:, 1], low), np.minimum(near[:, 2], high)
    table = np.column_stack([near[:, 0] - at, start, end, near[:, 0], (end - start) * near[:, 5]])
    return np.asarray(table[np.lexsort((end, start))])


def _steps(surfaces: Float, low: float, high: float) -> Iterator[tuple[float, float, float]]:
    """From where to where a side steps, and to which offset."""
    aside = np.where(np.abs(surfaces[:, 0]) < _STEP, 0, np.sign(surfaces[:, 0]))
    for sign in (-1, 1):
        others = surfaces[(aside != sign) & (surfaces[:, 2] - surfaces[:, 1] > _PILLAR)]
        edges = [low, *others[:, 1:3].ravel().tolist(), high]
        for start, end in zip(edges[::2], edges[1::2], strict=True):
            mine = surfaces[(aside == sign) & (surfaces[:, 1] >= start) & (surfaces[:, 2] <= end)]
            length = float((mine[:, 2] - mine[:, 1]).sum())
            if length >= max(_LEAST, _SHARE * (end - start)):
                mine = mine[np.argsort(mine[:, 3], kind="stable")]
                half = np.searchsorted(np.cumsum(mine[:, 4]), mine[:, 4].sum() / 2)
                yield start, end, float(mine[half, 3])

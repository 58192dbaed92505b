"""Walls that end in the open: the rectangles beside one join past its end, and the union would swallow it.

A region must hold no seen wall in its interior (trap 5): what lies deeper in it than a tolerance is cut out,
as thick as a wall is.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.model import LayoutPlane

Float = NDArray[np.float64]

_DEEP = 0.2  # m from the sides of a region, from which a wall lies in its interior
_SHORTEST = 0.3 - 1e-6  # m of wall that is worth a cut; runs are made of tenths
_STANDS = 0.35  # of the height below 2 m that must have been seen for a wall that stands
_HALF = 0.05  # m on each side of a seen face


def cut_walls(polygon: Any, walls: Float) -> Any:
    """``polygon`` less the walls (W, 4: lines x0, y0, x1, y1 with the lower ends first) in its interior."""
    if len(walls) == 0:
        return polygon
    x0, y0, x1, y1 = polygon.bounds
    across, along = (  # by column: there are as many walls as a site has, for each of its rooms
        np.minimum(walls[:, k + 2], high - _DEEP) - np.maximum(walls[:, k], low + _DEEP)
        for k, (low, high) in enumerate(((x0, x1), (y0, y1)))
    )
    near = (across >= 0) & (along >= 0) & (np.maximum(across, along) > _SHORTEST)
    if not near.any():  # most rooms, and cheaper than their interior
        return polygon
    inner = polygon.buffer(-_DEEP, join_style="mitre")
    lines = shapely.linestrings(walls[near].reshape(-1, 2, 2))
    inside = shapely.intersection(lines, inner)
    rows = np.flatnonzero(shapely.length(inside) > _SHORTEST)
    if len(rows) == 0:
        return polygon
    x0, y0, x1, y1 = shapely.bounds(inside[rows]).T
    along_x = x1 - x0 > y1 - y0
    # Back to where the walk from the sides began.
    more = np.where(along_x, [[_DEEP], [_HALF]], [[_HALF], [_DEEP]])
    whole = shapely.bounds(lines[rows]).T
    x0, x1 = np.maximum(x0 - more[0], whole[0] - _HALF), np.minimum(x1 + more[0], whole[2] + _HALF)
    y0, y1 = np.maximum(y0 - more[1], whole[1] - _HALF), np.minimum(y1 + more[1], whole[3] + _HALF)
    return polygon.difference(shapely.union_all(shapely.box(x0, y0, x1, y1)))


def standing_walls(planes: Sequence[LayoutPlane], min_support: float) -> Float:
    """(W, 4) lines of the wall runs where the wall was seen to stand on the floor, or was added by hand."""
    lines = []
    for plane in planes:
        if plane.by_hand != "added" and (plane.profile is None or plane.support < min_support):
            continue
        for start, end in plane.walls if plane.by_hand == "added" else _standing(plane):
            a, b = (plane.offset, start), (plane.offset, end)
            lines.append((*a, *b) if plane.facing.axis == 0 else (*a[::-1], *b[::-1]))
    return np.array(lines, dtype=np.float64).reshape(-1, 4)


def _standing(plane: LayoutPlane) -> list[tuple[float, float]]:
    """Where the plane itself was seen, low and well.

    Also where its wall went to a parallel plane close by: what was seen stands there all the same. Of a plane
    that a person switched off or cut, only what they left.
    """
    profile = plane.profile
    assert profile is not None
    mask = np.concatenate([[False], profile.low >= _STANDS, [False]]).astype(np.int8)
    runs = (profile.start + profile.step * np.flatnonzero(np.diff(mask)).reshape(-1, 2)).tolist()
    if plane.by_hand:
        runs = [(max(s, a), min(e, b)) for s, e in runs for a, b in plane.walls.tolist()]
    return [(s, e) for s, e in runs if e - s > _SHORTEST]

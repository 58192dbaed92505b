"""What no rectangle may hold in its interior: wall runs and doors, closed at the corners (prunings 3 and 4)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import Door, LayoutPlane

Float = NDArray[np.float64]

_CORNER = 1.2  # m of unseen wall between the end of a run and the wall that it must meet
_TOUCH = 0.3  # m beyond the end of the other wall


def crossing_walls(planes: Sequence[LayoutPlane], axis: int) -> Float:
    """(K, 3) offset, start and end of every wall run of the planes across ``axis``."""
    runs = [(p.offset, s, e) for p in planes if p.facing.axis == axis for s, e in p.walls]
    return np.array(runs, dtype=np.float64).reshape(-1, 3)


def crossing_offsets(plane: LayoutPlane, others: Float) -> Float:
    """(M,) where along ``plane`` the wall runs ``others`` (K, 3), of the other axis, cross or nearly touch it."""
    return others[(others[:, 1] - _TOUCH <= plane.offset) & (others[:, 2] + _TOUCH >= plane.offset), 0]


def close_corners(planes: Sequence[LayoutPlane]) -> tuple[LayoutPlane, ...]:
    """Extend each wall run to the crossing wall near its end, where nothing was seen to pass between."""
    crossing = {axis: crossing_walls(planes, axis) for axis in (0, 1)}
    out = []
    for plane in planes:
        meets = crossing_offsets(plane, crossing[1 - plane.facing.axis])
        runs = [(_reach(plane, s, -1, meets), _reach(plane, e, 1, meets)) for s, e in plane.walls]
        out.append(replace(plane, walls=np.array(runs, dtype=np.float64).reshape(-1, 2)))
    return tuple(out)


def _reach(plane: LayoutPlane, end: float, sign: int, meets: Float) -> float:
    """The end of a run, moved to the nearest crossing wall ahead unless free space passes between."""
    ahead = (meets - end) * sign
    ahead = ahead[(ahead > 0) & (ahead <= _CORNER)]
    if len(ahead) == 0 or plane.profile is None:
        return end
    target = end + sign * float(ahead.min())
    a, b = sorted(round((v - plane.profile.start) / plane.profile.step) for v in (end, target))
    through = plane.profile.through[max(a, 0) : b]
    return end if len(through) and float((through > 0.15).mean()) > 0.3 else target


def blockers(planes: Sequence[LayoutPlane], doors: Sequence[Door]) -> Float:
    """(B, 4) x0, y0, x1, y1: wall runs as lines, doors as boxes between the faces of their wall. Metres."""
    rows = [(p.facing.axis, p.offset, p.offset, s, e) for p in planes for s, e in p.walls]
    rows += [(d.axis, d.offset - d.thickness / 2, d.offset + d.thickness / 2, d.start, d.end) for d in doors]
    return np.array([(u0, v0, u1, v1) if a == 0 else (v0, u0, v1, u1) for a, u0, u1, v0, v1 in rows]).reshape(
        -1, 4
    )

"""Where a click snaps to: corners, jambs, walls; and the offsets at which there is evidence of a wall."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.layers.hit_index import segment_distance
from floorcast_app.layers.source import PlanSource
from floorplan_core.model import LayoutPlane

Float = NDArray[np.float64]

_STRAIGHT = 1e-6  # metres between the ends of a wall across it: it is as good as parallel to an axis


@dataclass(frozen=True)
class Snap:
    """A snapped point."""

    kind: str  # "corner", "jamb", "wall" or "" where nothing is near
    x: float  # metres, manhattan frame
    y: float
    along: tuple[float, float] | None = None  # unit vector along the wall, where it lies on one

    @property
    def xy(self) -> tuple[float, float]:
        """The point."""
        return self.x, self.y


class SnapIndex:
    """Corners and jambs win over walls, so that a corner is easy to hit."""

    def __init__(self, source: PlanSource) -> None:
        import shapely

        self.source = source
        regions, openings = source.plan.regions, source.walls.openings
        self._corners = shapely.get_coordinates([r.polygon for r in regions]).reshape(-1, 2)
        self._jambs = np.vstack([np.zeros((0, 2)), *(o.faces.reshape(4, 2) for o in openings)])
        sides = np.array([(*s.start, *s.end) for r in regions for s in r.sides]).reshape(-1, 4)
        self._walls = np.vstack([sides, *(p.reshape(-1, 4) for p in _plane_lines(source.plan.all_planes))])

    def at(self, x: float, y: float, reach: float) -> Snap:
        """The nearest corner, jamb or wall within ``reach`` metres; else the point itself."""
        for kind, points in (("corner", self._corners), ("jamb", self._jambs)):
            found = _nearest_point(points, x, y, reach)
            if found is not None:
                return Snap(kind, *found)
        return self.wall(x, y, reach) or Snap("", x, y)

    def wall(self, x: float, y: float, reach: float) -> Snap | None:
        """The foot on the nearest wall within ``reach`` metres; None where none is."""
        if not len(self._walls):
            return None
        away = segment_distance(self._walls, x, y)
        k = int(np.argmin(away))
        return _on_wall(self._walls[k], x, y) if away[k] <= reach else None


def _plane_lines(planes: tuple[LayoutPlane, ...]) -> list[Float]:
    from floorcast_app.layers.planes import plane_shape

    return [plane_shape(p).lines() for p in planes]


def _nearest_point(points: Float, x: float, y: float, reach: float) -> tuple[float, float] | None:
    if not len(points):
        return None
    away = np.hypot(points[:, 0] - x, points[:, 1] - y)
    k = int(np.argmin(away))
    return (float(points[k, 0]), float(points[k, 1])) if away[k] <= reach else None


def _on_wall(line: Float, x: float, y: float) -> Snap:
    """The foot of the perpendicular on a wall."""
    x0, y0, x1, y1 = line.tolist()
    if abs(x1 - x0) <= _STRAIGHT:
        return Snap("wall", x0, min(max(y, min(y0, y1)), max(y0, y1)), along=(0.0, 1.0))
    if abs(y1 - y0) <= _STRAIGHT:
        return Snap("wall", min(max(x, min(x0, x1)), max(x0, x1)), y0, along=(1.0, 0.0))
    dx, dy = x1 - x0, y1 - y0
    t = min(max(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    length = math.hypot(dx, dy)
    return Snap("wall", x0 + t * dx, y0 + t * dy, along=(dx / length, dy / length))


def snap_offset(source: PlanSource, plane: LayoutPlane, offset: float, reach: float) -> tuple[float, str]:
    """The offset of the nearest observed segment of the same facing within ``reach``, and the segment's id.

    Furniture counts too: a person may know better. Without evidence the offset itself and "".
    """
    near = [
        (round(abs(s.offset - offset), 6), s.id, s.offset)
        for s in source.plan.all_segments
        if (s.facing, s.turn) == (plane.facing, plane.turn) and abs(s.offset - offset) <= reach
    ]
    if not near:
        return offset, ""
    _, id, found = min(near)
    return found, id

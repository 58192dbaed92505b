"""Where a click snaps to: corners, jambs, walls; and the offsets at which there is evidence of a wall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.layers.hit_index import segment_distance
from floorcast_app.layers.source import PlanSource
from floorplan_core.model import LayoutPlane

Float = NDArray[np.float64]

_STRAIGHT = 1e-6  # metres between the ends of a wall across it, beyond which it is at a slant


@dataclass(frozen=True)
class Snap:
    """A snapped point."""

    kind: str  # "corner", "jamb", "wall" or "" where nothing is near
    x: float  # metres, manhattan frame
    y: float
    axis: int | None = None  # of the wall's normal, on walls; None where it is at a slant

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
        boxes = np.array([o.bounds for o in openings]).reshape(-1, 4)
        self._jambs = np.vstack([boxes[:, [i, j]] for i in (0, 2) for j in (1, 3)])
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
        return Snap("wall", x0, min(max(y, min(y0, y1)), max(y0, y1)), axis=0)
    if abs(y1 - y0) <= _STRAIGHT:
        return Snap("wall", min(max(x, min(x0, x1)), max(x0, x1)), y0, axis=1)
    dx, dy = x1 - x0, y1 - y0
    t = min(max(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    return Snap("wall", x0 + t * dx, y0 + t * dy)


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

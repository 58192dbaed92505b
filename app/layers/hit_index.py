"""What lies under the pointer: the nearest line within a few pixels, else the region that holds it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from floorcast_app.layers.planes import plane_shape
from floorcast_app.layers.source import PlanSource, own_polygon
from floorcast_app.selection import Item
from floorcast_app.view_state import Look

Float = NDArray[np.float64]
Finder = Callable[[float, float, float, Look, bool], Item | None]
ORDER = ("door", "plane", "region")  # what wins where several lie under the pointer


class HitIndex:
    """Lines and areas of a plan as arrays: one look over all of them takes microseconds."""

    def __init__(self, source: PlanSource) -> None:
        import shapely

        self._boxes = np.array([o.own for o in source.walls.openings]).reshape(-1, 4)
        turn = np.array([o.door.turn for o in source.walls.openings])
        self._axes = np.stack([np.cos(turn), np.sin(turn)], axis=1).reshape(-1, 2)  # x axis of each box
        self._doors = [Item("door", o.door.id) for o in source.walls.openings]
        shapes = [plane_shape(p) for p in source.plan.all_planes]
        self._planes = [s.item for s in shapes]
        self._facing = np.array([int(s.facing) for s in shapes], dtype=np.int64)
        self._offset = np.array([s.offset for s in shapes])
        angle = np.array([s.turn + (0.0, np.pi / 2)[s.facing.axis] for s in shapes])
        self._across = np.column_stack([np.cos(angle), np.sin(angle)])  # along which the offset is
        lines = [s.lines().reshape(-1, 4) for s in shapes]
        self._lines = np.vstack([np.zeros((0, 4)), *lines])
        self._line_plane = np.repeat(np.arange(len(shapes)), [len(line) for line in lines])
        self._polygons = np.array([own_polygon(r.polygon) for r in source.plan.regions], dtype=object)
        shapely.prepare(self._polygons)
        self._regions = [Item("region", r.id) for r in source.plan.regions]

    def at(
        self,
        x: float,
        y: float,
        reach: float,
        look: Look,
        kinds: tuple[str, ...] = ORDER,
        dotted: bool = False,
    ) -> Item | None:
        """The item at (x, y), metres, manhattan frame; what the look hides cannot be hit.

        :param reach: metres that a line may be away.
        :param dotted: planes are hit all along, not only where they were seen.
        """
        finders: dict[str, Finder] = {"door": self._door, "plane": self._plane, "region": self._region}
        found = (finders[kind](x, y, reach, look, dotted) for kind in ORDER if kind in kinds)
        return next((item for item in found if item is not None), None)

    def _door(self, x: float, y: float, reach: float, look: Look, dotted: bool) -> Item | None:
        if "doors" not in look.layers or not len(self._boxes):
            return None
        b = self._boxes
        c, s = self._axes.T
        own = np.stack([c * x + s * y, c * y - s * x], axis=1)  # the place in the axes of each door's wall
        away = np.hypot(*(np.maximum(0, np.maximum(b[:, :2] - own, own - b[:, 2:])).T))
        return _nearest(away, reach, self._doors, look)

    def _plane(self, x: float, y: float, reach: float, look: Look, dotted: bool) -> Item | None:
        if "planes" not in look.layers or not self._planes:
            return None
        shown = np.isin(self._facing, list(look.facings))
        away = np.full(len(self._planes), np.inf)
        if len(self._lines):
            np.minimum.at(away, self._line_plane, segment_distance(self._lines, x, y))
        seen = _nearest(np.where(shown, away, np.inf), reach, self._planes, look)
        if seen is not None or not dotted:
            return seen
        away = np.abs(self._across @ (x, y) - self._offset)
        return _nearest(np.where(shown, away, np.inf), reach, self._planes, look)

    def _region(self, x: float, y: float, reach: float, look: Look, dotted: bool) -> Item | None:
        import shapely

        if "regions" not in look.layers or not len(self._polygons):
            return None
        inside = np.flatnonzero(shapely.contains_xy(self._polygons, x, y))
        return next((self._regions[k] for k in inside.tolist() if _shown(self._regions[k], look)), None)


def segment_distance(lines: Float, x: float, y: float) -> Float:
    """(K,) metres from a point to (K, 4) segments x0, y0, x1, y1."""
    a, d = lines[:, :2], lines[:, 2:] - lines[:, :2]
    square = np.maximum((d**2).sum(axis=1), 1e-18)
    t = np.clip((((x, y) - a) * d).sum(axis=1) / square, 0.0, 1.0)
    return np.asarray(np.hypot(*(a + t[:, None] * d - (x, y)).T))


def _shown(item: Item, look: Look) -> bool:
    return (item.kind, item.id) not in look.hidden


def _nearest(away: Float, reach: float, items: list[Item], look: Look) -> Item | None:
    """The nearest shown item within ``reach``; ties to the first in the plan."""
    for k in np.argsort(away, kind="stable").tolist():
        if away[k] > reach:
            return None
        if _shown(items[k], look):
            return items[k]
    return None

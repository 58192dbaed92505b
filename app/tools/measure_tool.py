"""Measure: two clicks for a distance, from wall to wall where both are walls; corners for an area."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

from floorcast_app import format
from floorcast_app.layers.snap_index import Snap
from floorcast_app.layers.source import PlanSource
from floorcast_app.tools.draw_tools import TwoPointTool
from floorcast_app.tools.gestures import SNAP, At, Mark, Point, distance, on_line, straight
from floorcast_app.view_state import Look
from floorplan_core.model import Region

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

FEWEST_CORNERS = 3
AREA_KEY = "a"
PARALLEL = 1e-3  # sine of the angle between two walls, up to which they are measured square


class MeasureTool(TwoPointTool):
    """A distance becomes a row of the ground-truth table; an area is shown until the next click."""

    name = "measure"
    role = "selection"
    hint = "Click two points; walls, corners and jambs snap, Shift measures square. A measures an area."
    area_hint = "Click corners and press Enter, or double-click a region. A measures distances again."

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._wall: Point | None = None  # along the wall that the first click lies on
        self._corners: list[Point] | None = None  # of an area; None: distances are measured
        self._closed = False
        self._region: Region | None = None  # whose whole floor is measured

    @property
    def busy(self) -> bool:
        return bool(self._corners) or super().busy

    def snap(self, at: At) -> Snap:
        source = self.source
        return source.snaps.at(at.x, at.y, at.reach(SNAP)) if source is not None else Snap("", at.x, at.y)

    def aim(self, first: Point, at: At) -> Snap:
        snap = self.snap(at)
        if self._wall is not None and snap.along is not None and _parallel(snap.along, self._wall):
            return Snap("wall", *on_line(first, (-self._wall[1], self._wall[0]), snap.xy), self._wall)
        turn = self.source.turn_at(*first) if self.source is not None else 0.0
        return Snap(snap.kind, *straight(first, snap.xy, turn), snap.along) if at.shift else snap

    def release(self, at: At, moved: bool) -> None:
        if moved:
            return
        if self._corners is not None:
            self._add_corner(at)
            return
        first = not self.busy
        super().release(at, moved)
        if first and self._here is not None:
            self._wall = self._here.along if self._here.kind == "wall" else None

    def double(self, at: At) -> bool:
        if self._corners is None:
            return self.busy
        if len(self._corners) < FEWEST_CORNERS:
            self._take_region(at)
        self._close()
        return True

    def key(self, key: str) -> bool:
        if key.lower() == AREA_KEY and not super().busy:
            self._corners, self._closed = ([], False) if self._corners is None else (None, False)
            self.hint = self.area_hint if self._corners is not None else type(self).hint
            return True
        if self._corners is not None:
            if key == "Enter":
                self._close()
            return key == "Enter"
        return key == "Enter" and super().key(key)

    def cancel(self) -> bool:
        if self._corners:
            self._corners, self._closed, self._region = [], False, None
            return True
        self._wall = None
        return super().cancel()

    def finish(self, start: Point, end: Point) -> None:
        self.workbench.try_run("measure.add", start=start, end=end)

    def label(self, start: Point, end: Point) -> str:
        shown = format.length(distance(start, end), self.workbench.view.look.units)
        return f"⊥ {shown}" if self._wall is not None and self._here and self._here.kind == "wall" else shown

    def marks(self) -> tuple[Mark, ...]:
        if not self._corners:
            return super().marks()
        corners = (*self._corners,) if self._closed or self._here is None else (*self._corners, self._here.xy)
        return Mark("area", corners, self.role), *self._area_text(corners)

    # ---- areas ------------------------------------------------------------------------------------------

    def _add_corner(self, at: At) -> None:
        if self._closed:
            self._corners, self._closed, self._region = [], False, None
        corners = self._corners
        assert corners is not None
        snap = self.snap(at)
        self._here = snap
        if len(corners) >= FEWEST_CORNERS and distance(corners[0], at.xy) <= at.reach(SNAP):
            self._close()
        elif not corners or distance(corners[-1], snap.xy) > at.reach(1.0):
            corners.append(snap.xy)

    def move(self, at: At) -> None:
        if self._corners is None:
            super().move(at)
        else:
            self._here = self.snap(at)

    def _take_region(self, at: At) -> None:
        """All of the region under the pointer."""
        self._region = region_at(self.source, at.xy)
        if self._region is not None:
            ring = self._region.polygon.exterior.coords[:-1]
            self._corners = [(float(x), float(y)) for x, y in ring]

    def _close(self) -> None:
        self._closed = self._corners is not None and len(self._corners) >= FEWEST_CORNERS

    def _area_text(self, corners: tuple[Point, ...]) -> tuple[Mark, ...]:
        if len(corners) < FEWEST_CORNERS:
            return ()
        units = self.workbench.view.look.units
        ring = (*corners, corners[0])
        around = sum(distance(a, b) for a, b in itertools.pairwise(ring))
        middle = (sum(x for x, _ in corners) / len(corners), sum(y for _, y in corners) / len(corners))
        region = self._region or region_at(self.source, middle)
        inside = self._region.area if self._region is not None else polygon_area(corners)
        parts = [format.area(inside, units), format.length(around, units)]
        if region is not None and region.height is not None:
            parts.append(f"↕ {format.length(region.height, units)}")
        return (Mark("text", (middle,), text="  ·  ".join(parts)),)


def region_at(source: PlanSource | None, at: Point) -> Region | None:
    """The region that holds a place; None where none does."""
    item = source.hits.at(*at, 0.0, Look(), ("region",)) if source is not None else None
    return source.regions[item.id] if source is not None and item is not None else None


def polygon_area(corners: tuple[Point, ...]) -> float:
    """m2 inside a simple polygon (Gauss's shoelace).

    >>> polygon_area(((0.0, 0.0), (2.0, 0.0), (2.0, 3.0), (0.0, 3.0)))
    6.0
    """
    ring = (*corners, corners[0])
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in itertools.pairwise(ring))) / 2


def _parallel(u: Point, v: Point) -> bool:
    """True for unit vectors of one line, either way."""
    return abs(u[0] * v[1] - u[1] * v[0]) < PARALLEL

"""A plan with what several layers draw from it; each part is made once, when it is first asked for."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from floorplan_core.exporters.door_symbols import Leaf, swings
from floorplan_core.exporters.walls import Poche, poche, predicted_floor
from floorplan_core.model import Door, FloorPlan, LayoutPlane, Region

if TYPE_CHECKING:
    from floorcast_app.layers.hit_index import HitIndex
    from floorcast_app.layers.snap_index import SnapIndex

Rings = tuple[NDArray[np.float64], ...]  # each (N, 2) metres, manhattan frame, closed


def rings(geometry: Any) -> Rings:
    """All rings of a shapely Polygon or MultiPolygon, holes included (to be filled by the odd-even rule)."""
    import shapely

    polygons = [p for p in shapely.get_parts(geometry) if p.geom_type == "Polygon" and not p.is_empty]
    return tuple(shapely.get_coordinates(ring) for p in polygons for ring in (p.exterior, *p.interiors))


def with_own_polygons(plan: FloorPlan) -> FloorPlan:
    """``plan`` with copies of its polygons: GEOS prepares a geometry in place, unseen by other threads."""
    return replace(plan, regions=tuple(replace(r, polygon=own_polygon(r.polygon)) for r in plan.regions))


def own_polygon(polygon: Any) -> Any:
    """A copy that shares nothing."""
    import shapely

    return shapely.from_wkb(shapely.to_wkb(polygon))


class PlanSource:
    """A plan, and its walls, door swings and predicted floor."""

    def __init__(self, plan: FloorPlan) -> None:
        self.plan = plan
        self.drawn = with_own_polygons(plan)  # what the layers are made from, by one thread at a time
        self.regions: dict[str, Region] = {r.id: r for r in plan.regions}
        self.planes: dict[str, LayoutPlane] = {p.id: p for p in plan.all_planes}
        self.doors: dict[str, Door] = {d.id: d for d in plan.doors}

    @cached_property
    def walls(self) -> Poche:
        """The solid between the regions, with openings cut."""
        return poche(self.drawn)

    @cached_property
    def swings(self) -> tuple[tuple[Leaf, ...], ...]:
        """The leaves of each opening of :attr:`walls`."""
        return tuple(swings(self.walls.openings, self.drawn.regions))

    @cached_property
    def predicted(self) -> Any:
        """Shapely geometry of the floor that nobody saw."""
        return predicted_floor(self.drawn)

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 of the regions, metres; of the grid where there are none."""
        import shapely

        if not self.plan.regions:
            return self.plan.grid.extent
        x0, y0, x1, y1 = shapely.total_bounds([r.polygon for r in self.drawn.regions]).tolist()
        return x0, y0, x1, y1

    @cached_property
    def extent(self) -> tuple[float, float, float, float]:
        """The bounds with the walls around them."""
        x0, y0, x1, y1 = self.bounds
        thick = self.walls.thickness
        return x0 - thick, y0 - thick, x1 + thick, y1 + thick

    def turn_at(self, x: float, y: float) -> float:
        """Radians from the plan's axes to those of most walls of the region at, or nearest to, a place."""
        import shapely

        if not self.plan.wings or not self.plan.regions:
            return 0.0
        away = shapely.distance([r.polygon for r in self.drawn.regions], shapely.Point(x, y))
        metres: dict[float, float] = {0.0: 0.0}
        for side in self.plan.regions[int(away.argmin())].sides:
            if side.plane in self.planes:
                turn = self.planes[side.plane].turn
                metres[turn] = metres.get(turn, 0.0) + side.length
        return max(metres, key=lambda turn: metres[turn])

    @cached_property
    def hits(self) -> HitIndex:
        """What lies under the pointer."""
        from floorcast_app.layers.hit_index import HitIndex

        return HitIndex(self)

    @cached_property
    def snaps(self) -> SnapIndex:
        """Where clicks snap to."""
        from floorcast_app.layers.snap_index import SnapIndex

        return SnapIndex(self)


_sources: WeakValueDictionary[int, PlanSource] = WeakValueDictionary()


def source_of(plan: FloorPlan) -> PlanSource:
    """The one source of ``plan`` that all panes share, for as long as one of them holds it."""
    source = _sources.get(id(plan))
    if source is None:
        source = _sources.setdefault(id(plan), PlanSource(plan))
    return source

"""The geometry of a single thing: to light it up, to zoom to it, to hang a menu on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.layers.planes import plane_shape
from floorcast_app.layers.source import PlanSource, Rings, rings
from floorcast_app.selection import Item
from floorplan_core.model.layout import turned

Float = NDArray[np.float64]
NO_LINES = np.zeros((0, 2, 2))


@dataclass(frozen=True)
class ItemShape:
    """What is lit up; all in metres, manhattan frame."""

    areas: Rings = ()
    lines: Float = None  # type: ignore[assignment]  # (K, 2, 2); empty where left out
    infinite: tuple[int, float, float] | None = None  # axis, offset and turn of a plane

    def __post_init__(self) -> None:
        if self.lines is None:
            object.__setattr__(self, "lines", NO_LINES)

    @property
    def empty(self) -> bool:
        """True where there is nothing to light up."""
        return not self.areas and not len(self.lines) and self.infinite is None

    @property
    def bounds(self) -> tuple[float, float, float, float] | None:
        """x0, y0, x1, y1; None where it has no extent."""
        points = [*self.areas, *self.lines]
        if not points:
            return None
        stacked = np.vstack(points)
        (x0, y0), (x1, y1) = stacked.min(axis=0).tolist(), stacked.max(axis=0).tolist()
        return x0, y0, x1, y1


def item_shape(source: PlanSource, item: Item) -> ItemShape:
    """The shape of ``item``; an empty one where the plan has no such thing."""
    if item.kind == "region" and item.id in source.regions:
        return ItemShape(areas=rings(source.regions[item.id].polygon))
    if item.kind == "door" and item.id in source.doors:
        return ItemShape(areas=_door_ring(source, item.id), lines=source.doors[item.id].line()[None])
    if item.kind == "plane" and item.id in source.planes:
        shape = plane_shape(source.planes[item.id])
        return ItemShape(lines=shape.lines(), infinite=(shape.facing.axis, shape.offset, shape.turn))
    segment = next((s for s in source.plan.all_segments if item == Item("segment", s.id)), None)
    return ItemShape(lines=turned(segment.line(), segment.turn)[None]) if segment is not None else ItemShape()


def _door_ring(source: PlanSource, id: str) -> Rings:
    """The opening, from face to face of its wall."""
    (a, b), (d, c) = next(o.faces for o in source.walls.openings if o.door.id == id)
    return (np.array([a, b, c, d, a]),)


def anchor(source: PlanSource, item: Item) -> tuple[float, float] | None:
    """A point on the thing (a wall, a door) or in it (a region): where its pin goes."""
    import shapely

    if item.kind == "region" and item.id in source.regions:
        point = source.regions[item.id].polygon.representative_point()
        return float(shapely.get_x(point)), float(shapely.get_y(point))
    bounds = item_shape(source, item).bounds
    return None if bounds is None else ((bounds[0] + bounds[2]) / 2, (bounds[1] + bounds[3]) / 2)

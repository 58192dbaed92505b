"""Floors of a plan as triangles: what takes long, kept while the same plan is looked at. No Qt."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_app.rendering.shapes import outline, parts, triangles_of
from floorplan_core.model import FloorPlan, Region

Float = NDArray[np.float64]
Section = tuple[float, float, float, float]

LIFT = 0.015  # metres: floors lie above the points of the floor


@dataclass(frozen=True)
class FloorShape:
    """The floor of one region, inside the section box."""

    triangles: Float  # (T, 3, 3) metres, scene frame
    edges: Float  # (K, 2, 3) its outline
    spot: tuple[float, float, float]  # where its name goes


@dataclass(frozen=True)
class Floors:
    """All floors of a plan."""

    regions: dict[str, FloorShape]  # by region id; without those outside of the section box
    predicted: Float  # (T, 3, 3) what was predicted, not seen


NO_FLOORS = Floors({}, np.zeros((0, 3, 3)))


def make_floors(plan: FloorPlan, section: Section | None = None) -> Floors:
    """Triangles of every region and of what was predicted; ``section`` x0, y0, x1, y1 cuts them."""
    from shapely import Polygon

    from floorplan_core.exporters.walls import predicted_floor

    shapes = {region.id: _shape(region, section) for region in plan.regions}
    area = predicted_floor(plan) if plan.regions else Polygon()
    predicted = [triangles_of(part, LIFT) for part in parts(_inside(area, section))]
    return Floors(
        {id: shape for id, shape in shapes.items() if shape is not None},
        np.concatenate(predicted) if predicted else np.zeros((0, 3, 3)),
    )


def _shape(region: Region, section: Section | None) -> FloorShape | None:
    polygon = _inside(region.polygon, section)
    if not parts(polygon):
        return None
    middle = polygon.centroid
    spot = middle if polygon.contains(middle) else polygon.representative_point()
    return FloorShape(triangles_of(polygon, LIFT), outline(polygon, LIFT), (spot.x, spot.y, LIFT))


def _inside(area: Any, section: Section | None) -> Any:
    if section is None:
        return area
    from shapely import box

    return area.intersection(box(*section))

"""Wall poché: the solid between the regions, with openings cut and guessed walls told apart.

Regions end at wall faces. What lies between two faces nearer than the thickest wall is wall; where nothing
lies behind a face, the wall is drawn with a nominal thickness. Geometry is shapely, metres, manhattan frame.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.model import FREE, Door, FloorPlan, Region, RegionSide
from floorplan_core.model.floor_plan import regions_mask

NOMINAL = 0.15  # metres: thickness of a wall of which only one face is known
PROBE = 0.02  # metres: how far beside a side we look for its inside
MIN_PREDICTED = 0.3  # m2: smaller predicted patches are clutter in a drawing (they stay in plan.geojson)


@dataclass(frozen=True)
class Opening:
    """A door as it cuts the wall."""

    door: Door
    bounds: tuple[float, float, float, float]  # x0, y0, x1, y1 of the cut, from face to face


@dataclass(frozen=True)
class Poche:
    """What is drawn as wall."""

    observed: Any  # walls of which a face was seen
    guessed: Any  # walls that only close a region
    openings: tuple[Opening, ...]
    thickness: float  # metres, nominal


def poche(plan: FloorPlan) -> Poche:
    """The walls of ``plan``."""
    thickness = nominal_thickness(plan.doors)
    solid = _solid(plan.regions, thickness, plan.config.doors.max_thickness)
    openings = tuple(_cut(solid, door, thickness, plan.config.doors.max_thickness) for door in plan.doors)
    solid = solid.difference(shapely.union_all([shapely.box(*o.bounds) for o in openings]))
    guessed = _guessed(solid, plan.regions, thickness, plan.config.doors.max_thickness)
    return Poche(solid.difference(guessed), guessed, openings, thickness)


def nominal_thickness(doors: Sequence[Door]) -> float:
    """Metres: the median thickness measured at doors, else a usual one."""
    known = [d.thickness for d in doors if d.thickness > PROBE]
    return float(np.median(known)) if known else NOMINAL


def _solid(regions: Sequence[Region], thickness: float, thickest: float) -> Any:
    floor = shapely.union_all([r.polygon for r in regions])
    closed = shapely.buffer(
        shapely.buffer(floor, thickest / 2, join_style="mitre"), -thickest / 2, join_style="mitre"
    )
    ring = shapely.buffer(floor, thickness, join_style="mitre")
    return shapely.union(closed, ring).difference(floor)


def _cut(solid: Any, door: Door, thickness: float, thickest: float) -> Opening:
    """The part of the wall that a door takes away: as deep as the wall is there."""
    reach = _box(door.axis, door.offset - thickest, door.offset + thickest, door.start, door.end)
    parts = shapely.get_parts(solid.intersection(reach))
    line = shapely.LineString(door.line())
    near = [p for p in parts if p.distance(line) <= door.thickness / 2 + PROBE and p.area > 0]
    half = max(door.thickness, thickness) / 2
    low, high = door.offset - half, door.offset + half
    if near:
        bounds = shapely.total_bounds(near)
        low, high = float(bounds[door.axis]), float(bounds[door.axis + 2])
    return Opening(door, _box(door.axis, low, high, door.start, door.end).bounds)


def _box(axis: int, low: float, high: float, start: float, end: float) -> Any:
    """A box from ``low`` to ``high`` along ``axis`` and from ``start`` to ``end`` along the other."""
    return shapely.box(low, start, high, end) if axis == 0 else shapely.box(start, low, end, high)


def _guessed(solid: Any, regions: Sequence[Region], thickness: float, thickest: float) -> Any:
    """Wall behind guessed sides, unless its other face was seen."""
    sides = [(region, side) for region in regions for side in region.sides]
    guessed = shapely.union_all(
        [p for r, s in sides if s.speculated for p in _strips(r, s, thickness, thickest)]
    )
    guessed = guessed.intersection(solid)
    if guessed.is_empty:
        return guessed
    shapely.prepare(guessed)
    seen = [p for r, s in sides if not s.speculated for p in _strips(r, s, thickness, thickest)]
    return guessed.difference(shapely.union_all([p for p in seen if guessed.intersects(p)])).buffer(0)


def _strips(region: Region, side: RegionSide, thickness: float, thickest: float) -> list[Any]:
    """The ground behind a side: deep along its length, and one thickness deep around its corners."""
    a, b = np.array(side.start), np.array(side.end)
    if side.length == 0:
        return []
    along = (b - a) / side.length
    out = np.array([along[1], -along[0]])
    if shapely.contains_xy(region.polygon, *((a + b) / 2 + PROBE * out)):
        out = -out
    corner = thickness * along
    deep = shapely.Polygon([a, b, b + thickest * out, a + thickest * out])
    return [
        deep,
        shapely.Polygon([a - corner, b + corner, b + corner + thickness * out, a - corner + thickness * out]),
    ]


def predicted_cells(plan: FloorPlan) -> NDArray[np.bool_]:
    """(ny, nx) cells of predicted floor, without the specks along walls and under furniture."""
    from scipy.ndimage import binary_dilation, binary_opening, label

    unseen = regions_mask(plan.regions, plan.grid) & (plan.grid.states != FREE)
    block = np.ones((3, 3), dtype=bool)
    patches, _ = label(binary_dilation(binary_opening(unseen, block), block, mask=unseen))
    sizes = np.bincount(patches.ravel()) * plan.grid.cell**2
    sizes[0] = 0.0
    large: NDArray[np.bool_] = sizes[patches] >= MIN_PREDICTED
    return large


def predicted_floor(plan: FloorPlan) -> Any:
    """The same as a shapely geometry with smoothed edges, clipped to the regions."""
    from floorplan_core.geometry.raster import cells_to_polygon

    cell = plan.grid.cell
    area = cells_to_polygon(predicted_cells(plan), plan.grid.origin, cell)
    floor = shapely.union_all([r.polygon for r in plan.regions])
    return area.simplify(cell).buffer(0.6 * cell, join_style="mitre").intersection(floor)

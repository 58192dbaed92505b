"""Wall poché: the solid between the regions, with openings cut and guessed walls told apart.

Regions end at wall faces. What lies between two faces nearer than the thickest wall is wall; where nothing
lies behind a face, the wall is drawn with a nominal thickness. Geometry is shapely, metres, manhattan frame.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.model import FREE, Door, FloorPlan, Region, RegionSide
from floorplan_core.model.floor_plan import regions_mask

Float = NDArray[np.float64]

NOMINAL = 0.15  # metres: thickness of a wall of which only one face is known
TOUCHING = 0.05  # metres: regions nearer than this leave no room for a wall
ENDS = 0.2  # of a door's width at either end, where a wall across may reach into its line
PARTY = 0.1  # metres: drawn thickness of a wall between regions that touch
NEAR = 0.12  # metres: a door this far from the wall that it was found in still cuts it
PROBE = 0.02  # metres: how far beside a side we look for its inside
MIN_PREDICTED = 0.3  # m2: smaller predicted patches are clutter in a drawing (they stay in plan.geojson)


@dataclass(frozen=True)
class Opening:
    """A door as it cuts the wall."""

    door: Door
    own: tuple[float, float, float, float]  # x0, y0, x1, y1 of the cut, face to face, axes of the door's wall

    @property
    def faces(self) -> Float:
        """(2, 2, 2) ends of the wall's two faces across the opening, manhattan frame."""
        x0, y0, x1, y1 = self.own
        across = [[x0, y0], [x0, y1], [x1, y0], [x1, y1]]
        along = [[x0, y0], [x1, y0], [x0, y1], [x1, y1]]
        return self.door.in_plan(np.array(across if self.door.axis == 0 else along)).reshape(2, 2, 2)

    @property
    def polygon(self) -> Any:
        """The cut, manhattan frame."""
        if self.door.turn == 0.0:
            return shapely.box(*self.own)
        return shapely.transform(shapely.box(*self.own), self.door.in_plan)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 of the box around the cut, manhattan frame."""
        x0, y0, x1, y1 = shapely.bounds(self.polygon).tolist()
        return x0, y0, x1, y1


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
    parts = shapely.STRtree(shapely.get_parts(solid))
    openings = tuple(_cut(parts, door, thickness, plan.config.doors.max_thickness) for door in plan.doors)
    solid = solid.difference(shapely.union_all([o.polygon for o in openings]))
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
    between = shapely.union(closed, ring).difference(floor)
    return shapely.union_all([between, *_party_walls([r.polygon for r in regions])])


def _party_walls(polygons: Sequence[Any]) -> list[Any]:
    """A band along the edges at which two regions touch: the drawing needs a thickness there."""
    tree = shapely.STRtree(list(polygons))
    bands = []
    for i, j in tree.query(
        np.array(polygons, dtype=object), predicate="dwithin", distance=TOUCHING
    ).T.tolist():
        if i < j:
            other = shapely.buffer(polygons[j], TOUCHING, join_style="mitre")
            edge = shapely.line_merge(shapely.intersection(polygons[i].boundary, other))
            bands.append(shapely.buffer(edge, PARTY / 2, cap_style="square", join_style="mitre"))
    return bands


def _cut(solid: shapely.STRtree, door: Door, thickness: float, thickest: float) -> Opening:
    """The part of the wall that a door takes away: as deep as the wall is there.

    :param solid: the parts of all walls.
    """
    start, end = door.start + ENDS * door.width, door.end - ENDS * door.width
    own = replace(door, turn=0.0)  # all in the axes of the door's wall
    reach = _box(door.axis, door.offset - thickest, door.offset + thickest, start, end)
    line = shapely.LineString(own.line())
    around = solid.geometries[solid.query(shapely.transform(reach, door.in_plan) if door.turn else reach)]
    if door.turn:
        around = shapely.transform(around, door.in_own)
    parts = [p for p in shapely.get_parts(shapely.clip_by_rect(around, *reach.bounds)) if p.area > 0]
    parts.sort(key=lambda p: (round(p.distance(line), 3), p.bounds))
    beside = [p for p in parts if p.distance(line) <= door.thickness / 2 + PROBE]
    near = beside or [p for p in parts[:1] if p.distance(line) <= door.thickness / 2 + NEAR]
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
    sides = [(region, side) for region in regions for side in region.sides if side.length > 0]
    speculated = np.array([side.speculated for _, side in sides], dtype=bool)
    if not speculated.any():
        return shapely.MultiPolygon()
    strips = _strips(sides, thickness, thickest)
    guessed = shapely.union_all(strips[:, speculated]).intersection(solid)
    seen = strips[:, ~speculated].ravel()
    meets = shapely.STRtree(shapely.get_parts(guessed)).query(seen, predicate="intersects")[0]
    near = seen[np.unique(meets)]
    return guessed.difference(shapely.union_all(near)).buffer(0)


def _strips(sides: Sequence[tuple[Region, RegionSide]], thickness: float, thickest: float) -> NDArray[Any]:
    """(2, N) the ground behind each side: deep along its length, one thickness deep around its corners."""
    a, b = (np.array([getattr(side, end) for _, side in sides], dtype=np.float64) for end in ("start", "end"))
    along = (b - a) / np.hypot(*(b - a).T)[:, None]
    out = np.column_stack([along[:, 1], -along[:, 0]])
    probe = (a + b) / 2 + PROBE * out
    polygons = np.array([region.polygon for region, _ in sides], dtype=object)
    out[shapely.contains_xy(polygons, probe[:, 0], probe[:, 1])] *= -1
    corner = thickness * along
    inside = PARTY * out  # party walls reach a little into the floor
    deep = np.stack([a - inside, b - inside, b + thickest * out, a + thickest * out], axis=1)
    a, b = a - corner, b + corner
    around = np.stack([a, b, b + thickness * out, a + thickness * out], axis=1)
    return np.stack([shapely.polygons(deep), shapely.polygons(around)])


def predicted_cells(plan: FloorPlan) -> NDArray[np.bool_]:
    """(ny, nx) cells of predicted floor, without the specks along walls and under furniture."""
    from floorplan_core.geometry.masks import label_patches, widened  # numba is slow to import

    unseen = regions_mask(plan.regions, plan.grid) & (plan.grid.states != FREE)
    core = ~widened(widened(~unseen))  # what is at least five cells wide: no wall, no table edge
    patches, _ = label_patches(widened(widened(widened(core))) & unseen)
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

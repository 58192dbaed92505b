"""The points as the 3D pane draws them: in the scene's frame, with a colour each. No Qt."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.colours import THEMES
from floorcast_app.point_store import Points
from floorcast_app.rendering import ramps
from floorplan_core.model import Facing, FloorPlan, LayoutPlane, LocalFrame
from floorplan_core.model.layout import turned

Float = NDArray[np.float64]
Floats = NDArray[np.float32]
Colours = NDArray[np.uint32]

BLOCK = 1 << 20  # points at a time: no step holds the interpreter long
PLANE_CELL = 0.04  # metres: raster in which points find their plane
PLANE_REACH = 0.10  # metres from a plane up to which a point belongs to it
FLOOR_SKIN, CEILING_SKIN = 0.08, 0.08  # metres: what lies so near to floor or ceiling belongs to no wall
TYPICAL_HEIGHT = 2.6  # metres, where no ceiling was seen
_SAMPLE = 20_000  # points from which spacing and heights are told


@dataclass(frozen=True)
class Cloud:
    """Points in shuffled order: any prefix is a fair picture. All arrays share their first axis."""

    xyz: Floats  # (N, 3) metres, scene frame
    rgb: NDArray[np.uint8] | None = None  # (N, 3)
    intensity: Floats | None = None  # (N,) in the file's own scale
    density: float = 1.0  # points for each m2 of surface
    low: float = 0.0  # metres: between these lie nearly all points
    high: float = 2.6

    def __len__(self) -> int:
        return len(self.xyz)

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 of nearly all points, metres."""
        low, high = np.quantile(self.xyz[:_SAMPLE, :2], (0.005, 0.995), axis=0)
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    def spacing(self, count: int) -> float:
        """Metres between neighbours when only the first ``count`` points are drawn."""
        return 1.0 / math.sqrt(max(self.density * count / max(len(self), 1), 1e-6))


@dataclass(frozen=True)
class Paint:
    """A colour for each point, and what the pane says about it."""

    colours: Colours  # (N,) 0xRRGGBB
    note: str = ""  # "rgb" or "intensity" where the survey has none and height is shown instead
    heights: tuple[float, float] | None = None  # metres at both ends of the ramp, where heights are shown


def scene_matrix(
    plan: FloorPlan | None, floor: float = 0.0, origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> Float:
    """(3, 4) local frame of the points to the scene.

    :param floor: metres, local: what is subtracted from heights before there is a plan.
    :param origin: metres, the origin of the plan's own local frame in that of the points.
    """
    if plan is None:
        return np.column_stack([np.eye(3), [0.0, 0.0, -floor]])
    moved = plan.frame.rotation @ np.array(origin)
    return np.column_stack([plan.frame.rotation, -moved - [0.0, 0.0, plan.frame.floor_z]])


def plan_origin(plan: FloorPlan | None, points: LocalFrame | None) -> tuple[float, float, float]:
    """Metres: where the plan's local frame has its origin in the local frame ``points``."""
    if plan is None or points is None:
        return 0.0, 0.0, 0.0
    x, y, z = (plan.local_frame.shift - points.shift).tolist()
    return x, y, z


def make_cloud(points: Points, matrix: Float) -> Cloud:
    """Move the points into the scene and find out how dense they are."""
    from floorcast_app.rendering import kernels  # numba takes a second to load: not before the window

    xyz = np.empty_like(points.xyz, dtype=np.float32)
    kernels.move(points.xyz, matrix.astype(np.float32), xyz)
    if not len(xyz):
        return Cloud(xyz)
    low, high = np.quantile(xyz[:_SAMPLE, 2], (0.01, 0.99))
    return Cloud(xyz, points.rgb, points.intensity, _density(xyz), float(low), float(max(high, low + 0.1)))


def lowest_level(xyz: Floats) -> float:
    """Metres: the height of the floor, guessed before any plan: nearly all points lie above it."""
    return float(np.quantile(xyz[:_SAMPLE, 2], 0.02)) if len(xyz) else 0.0


def paint(cloud: Cloud, by: str, plan: FloorPlan | None, theme: str) -> Paint:
    """Colour the points by one of ``POINT_COLOURS``; by height where the survey does not hold it."""
    if by == "rgb" and cloud.rgb is not None:
        return Paint(_in_blocks(cloud, lambda rows: ramps.pack(cloud.rgb[rows])))
    if by == "intensity" and cloud.intensity is not None:
        low, high = _usual(cloud.intensity)
        ramp = ramps.grey_ramp(theme)
        if high > low:
            return Paint(_in_blocks(cloud, lambda rows: ramp[ramps.steps(cloud.intensity[rows], low, high)]))
    if by in ("facing", "plane") and plan is not None:
        return Paint(_by_plane(cloud, by, plan, theme))
    return _by_height(cloud, plan, theme, by if by != "height" else "")


def _usual(intensity: Floats) -> tuple[float, float]:
    """Between which echoes nearly all lie: every scanner has its own scale, and mirrors outshine all."""
    known = intensity[:_SAMPLE][np.isfinite(intensity[:_SAMPLE])]
    if not len(known):
        return 0.0, 0.0
    low, high = np.quantile(known, (0.02, 0.98))
    return float(low), float(high)


def _by_height(cloud: Cloud, plan: FloorPlan | None, theme: str, note: str) -> Paint:
    low, high = (cloud.low, cloud.high) if plan is None else (0.0, storey_height(plan))
    ramp = ramps.height_ramp(theme)
    colours = _in_blocks(cloud, lambda rows: ramp[ramps.steps(cloud.xyz[rows, 2], low, high)])
    return Paint(colours, note, (low, high))


def _by_plane(cloud: Cloud, by: str, plan: FloorPlan, theme: str) -> Colours:
    """Points near a plane have its colour; the others stay grey."""
    holds = THEMES[theme]
    table = facing_colours(theme) if by == "facing" else ramps.plane_colours(len(plan.all_planes), theme)
    planes = plan.all_planes
    rows = [p.facing for p in planes] if by == "facing" else list(range(len(planes)))
    grey = ramps.packed(holds.predicted)
    table = np.append(table[np.array(rows, dtype=np.int64)], np.uint32(grey))  # row -1: no plane
    cells, origin = plane_raster(plan)
    from floorcast_app.rendering import kernels

    number = np.empty(len(cloud), dtype=np.int16)
    high = storey_height(plan) - CEILING_SKIN
    kernels.nearest_planes(cloud.xyz, cells, origin, PLANE_CELL, FLOOR_SKIN, high, number)
    return _in_blocks(cloud, lambda rows: table[number[rows]])


def facing_colours(theme: str) -> Colours:
    """(4,) a colour for each :class:`Facing`: the paper's red and green, each light and dark."""
    holds = THEMES[theme]
    made = {
        Facing.EAST: ramps.shifted(holds.plane_ew, 0.06),
        Facing.WEST: ramps.shifted(holds.plane_ew, -0.10),
        Facing.NORTH: ramps.shifted(holds.plane_ns, 0.08),
        Facing.SOUTH: ramps.shifted(holds.plane_ns, -0.10),
    }
    return np.array([made[facing] for facing in Facing], dtype=np.uint32)


def storey_height(plan: FloorPlan) -> float:
    """Metres from floor to ceiling."""
    ceiling = plan.frame.ceiling_z
    return TYPICAL_HEIGHT if ceiling is None else float(ceiling - plan.frame.floor_z)


def plane_raster(plan: FloorPlan) -> tuple[NDArray[np.int16], Float]:
    """((ny, nx) number of the nearest plane within reach of each cell, -1 where none; origin (2,) metres).

    Ties go to the plane that comes first.
    """
    boxes = [(n, p, run) for n, p in enumerate(plan.all_planes) for run in _runs(p)]
    if not boxes:
        return np.full((1, 1), -1, dtype=np.int16), np.zeros(2)
    rects = np.array([_strip(p, run) if p.turn == 0.0 else _around(p, run) for _, p, run in boxes])
    origin = rects[:, :2].min(axis=0) - PLANE_CELL
    nx, ny = (np.ceil((rects[:, 2:].max(axis=0) - origin) / PLANE_CELL).astype(int) + 1).tolist()
    cells = np.full((ny, nx), -1, dtype=np.int16)
    nearest = np.full((ny, nx), np.inf, dtype=np.float32)
    index = np.clip(np.round((rects - np.tile(origin, 2)) / PLANE_CELL).astype(int), 0, None)
    for (number, plane, run), (x0, y0, x1, y1) in zip(boxes, index.tolist(), strict=True):
        x = origin[0] + (np.arange(x0, x1) + 0.5) * PLANE_CELL
        y = origin[1] + (np.arange(y0, y1) + 0.5) * PLANE_CELL
        away = _away(plane, run, x[None, :], y[:, None])
        window = (slice(y0, y1), slice(x0, x1))
        closer = away < nearest[window]
        nearest[window] = np.where(closer, away, nearest[window])
        cells[window] = np.where(closer, number, cells[window])
    return cells, origin


def _away(plane: LayoutPlane, run: Float, x: Float, y: Float) -> Float:
    """Metres from places to a plane; infinitely far beside a run of a wing's, whose strip is no box here."""
    if plane.turn == 0.0:
        return np.abs((x if plane.facing.axis == 0 else y) - plane.offset)
    c, s = np.cos(plane.turn), np.sin(plane.turn)
    across, along = (c * x + s * y, c * y - s * x)[:: 1 - 2 * plane.facing.axis]
    away = np.abs(across - plane.offset)
    return np.where((along >= run[0]) & (along <= run[1]) & (away <= PLANE_REACH), away, np.inf)


def _around(plane: LayoutPlane, run: Float) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 around a run of a plane of a wing."""
    x0, y0, x1, y1 = _strip(plane, run)
    corners = turned(np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]), plane.turn)
    (x0, y0), (x1, y1) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return x0, y0, x1, y1


def _runs(plane: object) -> Float:
    """(K, 2) metres along the plane where it is wall."""
    walls = plane.walls if len(plane.walls) else plane.observed  # type: ignore[attr-defined]
    return np.asarray(walls, dtype=np.float64)


def _strip(plane: object, run: Float) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 within reach of a run of a plane."""
    near, far = plane.offset - PLANE_REACH, plane.offset + PLANE_REACH  # type: ignore[attr-defined]
    along = (near, run[0], far, run[1])
    return along if plane.facing.axis == 0 else (run[0], near, run[1], far)  # type: ignore[attr-defined]


def _in_blocks(cloud: Cloud, colour: object) -> Colours:
    out = np.empty(len(cloud), dtype=np.uint32)
    for at in range(0, len(cloud), BLOCK):
        out[at : at + BLOCK] = colour(slice(at, at + BLOCK))  # type: ignore[operator]
    return out


def _density(xyz: Floats) -> float:
    """Points for each m2 of surface, told from the median distance of neighbours in a random pattern."""
    from scipy.spatial import cKDTree

    sample = xyz[:_SAMPLE]
    if len(sample) < 2:
        return 1.0
    apart = float(np.median(cKDTree(sample).query(sample, k=2)[0][:, 1]))
    return math.log(2) / math.pi / max(apart, 1e-3) ** 2 * len(xyz) / len(sample)

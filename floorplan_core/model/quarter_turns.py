"""Results in axes that are turned by quarter turns, exactly: coordinates change places and signs.

A survey is planned in the quadrant that it has by itself (:mod:`floorplan_core.geometry.own_frame`), so that
nothing depends on how it is turned in its world, and the plan is shown along the axes of the world that are
nearest. ``quarters`` is how often a result turns by 90 degrees, counter-clockwise about the plan's origin;
things of a wing turn about the same origin in the wing's own axes, so that their ``turn`` stays.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model.cover import CandidateSet, RectangleCover
from floorplan_core.model.layout import Door, Facing, LayoutPlane, LayoutSegment, WallProfile
from floorplan_core.model.manhattan import ManhattanFrame
from floorplan_core.model.occupancy import OccupancyGrid
from floorplan_core.model.region import Region
from floorplan_core.model.wing import Wing

if TYPE_CHECKING:
    from floorplan_core.model.floor_plan import FloorPlan, WallPoints

Float = NDArray[np.float64]

_COS, _SIN = (1, 0, -1, 0), (0, 1, 0, -1)
_AFTER_ONE = (Facing.NORTH, Facing.SOUTH, Facing.WEST, Facing.EAST)  # of EAST, WEST, NORTH, SOUTH


def quarters_to_world(frame: ManhattanFrame) -> int:
    """How often what lies in ``frame`` turns until its x is within 45 degrees of the local x: 0 to 3."""
    heading = math.atan2(frame.rotation[0, 1], frame.rotation[0, 0])
    return round((heading - frame.yaw) / (math.pi / 2)) % 4


def turned_places(xy: NDArray[Any], quarters: int) -> NDArray[Any]:
    """(..., 2) places."""
    c, s = _COS[quarters % 4], _SIN[quarters % 4]
    out = np.stack([c * xy[..., 0] - s * xy[..., 1], s * xy[..., 0] + c * xy[..., 1]], axis=-1)
    return np.asarray(out + 0.0, dtype=xy.dtype)  # no negative zeros


def turned_place(point: tuple[float, float], quarters: int) -> tuple[float, float]:
    """One place."""
    x, y = turned_places(np.array(point, dtype=np.float64), quarters).tolist()
    return x, y


def turned_facing(facing: Facing, quarters: int) -> Facing:
    """The way that a surface looks after the turn."""
    for _ in range(quarters % 4):
        facing = _AFTER_ONE[facing]
    return facing


def turned_frame(frame: ManhattanFrame, quarters: int) -> ManhattanFrame:
    """The frame in which results lie after the turn."""
    rotation = frame.rotation.copy()
    rotation[:2] = turned_places(frame.rotation[:2].T, quarters).T
    return replace(frame, rotation=rotation)


def turned_boxes(bounds: Float, quarters: int) -> Float:
    """(N, 4) x0, y0, x1, y1."""
    a, b = turned_places(bounds[:, :2], quarters), turned_places(bounds[:, 2:], quarters)
    return np.hstack([np.minimum(a, b), np.maximum(a, b)])


def turned_cells(cells: NDArray[Any], quarters: int) -> NDArray[Any]:
    """(ny, nx) a raster whose rows go up; (nx, ny) after an odd number of turns."""
    return np.ascontiguousarray(np.rot90(cells, -quarters))  # numpy takes rows to go down


def turned_grid(grid: OccupancyGrid, quarters: int) -> OccupancyGrid:
    """The cells, where they lie after the turn."""
    corners = turned_boxes(np.array([grid.extent]), quarters)[0]
    states, universe = (turned_cells(cells, quarters) for cells in (grid.states, grid.universe))
    return replace(grid, origin=corners[:2], states=states, universe=universe)


def turned_segment(segment: LayoutSegment, quarters: int) -> LayoutSegment:
    """The segment with its facing after the turn."""
    offset, back = _axis_turn(segment.facing.axis, quarters)
    start, end = _span(segment.start, segment.end, back)
    facing = turned_facing(segment.facing, quarters)
    return replace(segment, facing=facing, offset=offset * segment.offset + 0.0, start=start, end=end)


def turned_plane(plane: LayoutPlane, quarters: int) -> LayoutPlane:
    """The plane with all that is known along it."""
    offset, back = _axis_turn(plane.facing.axis, quarters)
    return replace(
        plane,
        facing=turned_facing(plane.facing, quarters),
        offset=offset * plane.offset + 0.0,
        profile=None if plane.profile is None else _profile(plane.profile, back),
        walls=_runs(plane.walls, back),
        observed=_runs(plane.observed, back),
    )


def turned_door(door: Door, quarters: int) -> Door:
    """The door in its turned wall."""
    offset, back = _axis_turn(door.axis, quarters)
    start, end = _span(door.start, door.end, back)
    axis = (door.axis + quarters) % 2
    return replace(door, axis=axis, offset=offset * door.offset + 0.0, start=start, end=end)


def turned_region(region: Region, quarters: int) -> Region:
    """The region and its sides."""
    import shapely

    sides = tuple(
        replace(s, start=turned_place(s.start, quarters), end=turned_place(s.end, quarters))
        for s in region.sides
    )
    return replace(
        region, polygon=shapely.transform(region.polygon, lambda xy: turned_places(xy, quarters)), sides=sides
    )


def turned_wing(wing: Wing, quarters: int) -> Wing:
    """The planes and segments of a wing, which turn in its own axes."""
    planes = tuple(turned_plane(plane, quarters) for plane in wing.planes)
    return replace(wing, planes=planes, segments=tuple(turned_segment(s, quarters) for s in wing.segments))


def turned_cover(cover: RectangleCover, quarters: int) -> RectangleCover:
    """The chosen rectangles, in the order in which they were chosen."""
    uncovered = turned_cells(cover.uncovered, quarters)
    return replace(cover, bounds=turned_boxes(cover.bounds, quarters), uncovered=uncovered)


def turned_candidates(candidates: CandidateSet, quarters: int) -> CandidateSet:
    """The same rows; only their bounds say that they are turned."""
    return replace(candidates, quarters=(candidates.quarters + quarters) % 4)


def turned_plan(plan: FloorPlan, quarters: int) -> FloorPlan:
    """The plan in axes turned by ``quarters``; nothing in the world moves."""
    if quarters % 4 == 0:
        return plan
    return replace(
        plan,
        frame=turned_frame(plan.frame, quarters),
        segments=tuple(turned_segment(s, quarters) for s in plan.segments),
        planes=tuple(turned_plane(p, quarters) for p in plan.planes),
        doors=tuple(turned_door(d, quarters) for d in plan.doors),
        grid=turned_grid(plan.grid, quarters),
        candidates=turned_candidates(plan.candidates, quarters),
        cover=turned_cover(plan.cover, quarters),
        regions=tuple(turned_region(r, quarters) for r in plan.regions),
        wall_points=_wall_points(plan.wall_points, quarters),
        trajectory=turned_places(plan.trajectory, quarters),
        wings=tuple(turned_wing(w, quarters) for w in plan.wings),
    )


def turned_result(result: object, quarters: int) -> object:
    """What the panes show of a plan that is being made, turned; anything else as it is."""
    if isinstance(result, OccupancyGrid):
        return turned_grid(result, quarters)
    if isinstance(result, tuple) and all(isinstance(part, LayoutPlane) for part in result):
        return tuple(turned_plane(plane, quarters) for plane in result)
    return result


def _axis_turn(axis: int, quarters: int) -> tuple[int, bool]:
    """The sign of an offset along ``axis`` after the turn, and whether runs across it go backwards."""
    across = turned_place((1.0, 0.0) if axis == 0 else (0.0, 1.0), quarters)
    along = turned_place((0.0, 1.0) if axis == 0 else (1.0, 0.0), quarters)
    return int(sum(across)), sum(along) < 0


def _span(start: float, end: float, back: bool) -> tuple[float, float]:
    return (-end + 0.0, -start + 0.0) if back else (start, end)


def _runs(runs: Float, back: bool) -> Float:
    """(K, 2) runs, in rising order."""
    return np.ascontiguousarray(-runs[::-1, ::-1]) + 0.0 if back else runs


def _profile(profile: WallProfile, back: bool) -> WallProfile:
    if not back:
        return profile
    low, high, through = (np.ascontiguousarray(v[::-1]) for v in (profile.low, profile.high, profile.through))
    start = -(profile.start + len(profile.low) * profile.step)
    return replace(profile, start=start, low=low, high=high, through=through)


def _wall_points(points: WallPoints, quarters: int) -> WallPoints:
    facing = np.array([*(turned_facing(f, quarters) for f in Facing), -1], dtype=np.int8)
    return replace(points, xy=turned_places(points.xy, quarters), facing=facing[points.facing])

"""From a grid map to a floor in the Manhattan frame: yaw, resampling, furniture.

In: a :class:`GridMap`. Out: the frame, the occupancy grid with its universe, and the floor: all cells on
which one could stand if the furniture were taken out. The yaw is the strongest direction of the boundaries of
the free space, refined until they are sharpest, as for points. A map has one height only; what it can tell of
furniture is size, shape and whether it touches a wall: small isolated objects (legs, bins, columns) are
furniture, isolated objects that are long and thin are pieces of wall, and what touches a wall counts as wall.
Cost: a few passes over the cells.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config, FrameConfig, MapsConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.borders import find_borders, simplified, smallest_box
from floorplan_core.geometry.masks import measure_patches
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, GridMap, ManhattanFrame, OccupancyGrid
from floorplan_core.stages import manhattan_frame as frames
from floorplan_core.stages.sharpest_yaw import scores, wrap

Float = NDArray[np.float64]
Bool = NDArray[np.bool_]

_SMOOTH = 1.5  # cells a boundary may deviate from its straight line
_LEAST_EDGE = 6.0  # cells: the direction of shorter edges is a matter of rounding
_EXACT = math.radians(0.1)  # a yaw below this is none: the map is taken as it is
_SEARCH = math.radians(2)  # the directions of edges are right to this
_NEAR_AXIS = math.radians(10)  # boundaries within this of an axis make the search
_BESIDE = 5  # cells along the boundary, to either side, that give its direction at a cell
_MARGIN = 2  # cells around a resampled map


@dataclass(frozen=True)
class MapFloor:
    """A map in the Manhattan frame."""

    frame: ManhattanFrame
    grid: OccupancyGrid  # universe: free cells of the spaces that are large enough
    floor: Bool  # (ny, nx) free, or furniture with free cells around it
    furniture: Bool  # (ny, nx) isolated objects that are no walls


def find_floor(grid_map: GridMap, config: Config) -> MapFloor:
    """The map in its Manhattan frame, without furniture.

    :raises NoPlanError: if the map holds no free space that is large enough.
    """
    free = grid_map.states == FREE
    least = config.maps.min_space
    if np.count_nonzero(free) * grid_map.resolution**2 < least:
        raise NoPlanError(
            f"{grid_map.name} holds less than {least:g} m2 of free cells ({np.count_nonzero(free)} cells of "
            f"{grid_map.resolution:g} m); check the resolution, and negate and free_thresh of the map's YAML."
        )
    yaw, support, length = _yaw(free, grid_map.resolution, config.frame)
    if support < config.frame.min_support and config.frame.yaw_deg is None:
        yaw = 0.0  # no two directions to speak of: the map stays as it was drawn
    frame = ManhattanFrame(
        frames.turned_by(-grid_map.yaw - yaw), grid_map.yaw + yaw, 0.0, support, length, 0.0, None
    )
    grid = _turned(grid_map, yaw)
    shift = frame.rotation[:2, :2] @ np.array(grid_map.origin)
    grid = replace(grid, origin=grid.origin + shift)
    furniture = find_furniture(grid.states, grid.cell, config.maps)
    floor = (grid.states == FREE) | furniture
    return MapFloor(frame, grid, floor, furniture)


def _yaw(free: Bool, cell: float, config: FrameConfig) -> tuple[float, float, float]:
    """Yaw of the walls in the map's axes, radians; the share of boundary behind it; metres of boundary."""
    rings = [border.cells for border in find_borders(free)]
    edges = np.concatenate([np.zeros((0, 2)), *(_straight_edges(ring) for ring in rings)])
    length = np.hypot(edges[:, 0], edges[:, 1])
    angle = np.arctan2(edges[:, 1], edges[:, 0])
    metres = float(length.sum() * cell)
    if len(edges) == 0:
        return 0.0, 0.0, metres
    if config.yaw_deg is not None:
        yaw = float(wrap(math.radians(config.yaw_deg)))
    else:
        yaw = _sharpened(rings, frames.strongest_direction(angle, length), config)
    near = np.abs(wrap(angle - yaw)) < math.radians(config.tolerance_deg)
    return (0.0 if abs(yaw) < _EXACT else yaw), float(length[near].sum() / length.sum()), metres


def _straight_edges(cells: NDArray[np.int32]) -> Float:
    """(N, 2) vectors of the straight stretches of one boundary, cells."""
    ring = simplified(cells, _SMOOTH)
    edges = np.roll(ring, -1, axis=0) - ring
    return np.asarray(edges[np.hypot(edges[:, 0], edges[:, 1]) >= _LEAST_EDGE])


def _sharpened(borders: Sequence[NDArray[np.int32]], coarse: float, config: FrameConfig) -> float:
    """The yaw around ``coarse`` under which the boundary cells, projected along their walls, are sharpest."""
    rings = [b.astype(np.float64) for b in borders if len(b) > 4 * _BESIDE]
    if not rings:
        return coarse
    xy = np.concatenate(rings)
    # The direction of a boundary at a cell: from some cells before it to some after.
    along = np.concatenate([np.roll(r, -_BESIDE, axis=0) - np.roll(r, _BESIDE, axis=0) for r in rings])
    angle = np.arctan2(along[:, 1], along[:, 0]) - coarse
    off = wrap(angle)
    normal = 1 - np.round((angle - off) / (math.pi / 2)).astype(np.int64) % 2
    near = np.abs(off) < _NEAR_AXIS
    xy, normal = xy[near] - xy.mean(axis=0), normal[near]
    if len(xy) == 0:
        return coarse
    yaw, fine = coarse, math.radians(config.yaw_step_deg)
    for span, pace in ((_SEARCH, 2 * fine), (4 * fine, fine / 2)):
        trial = yaw + np.arange(-round(span / pace), round(span / pace) + 1) * pace
        # bins of one cell: finer ones would only see the raster
        yaw = float(trial[int(np.argmax(scores(xy, normal, trial, 1.0)))])
    return float(wrap(yaw))


def _turned(grid_map: GridMap, yaw: float) -> OccupancyGrid:
    """The map resampled into axes turned by ``yaw``; walls keep no holes. Exactly the map where yaw is 0."""
    states, cell = grid_map.states, grid_map.resolution
    if yaw == 0.0:
        return OccupancyGrid(np.zeros(2), cell, states, states == FREE, 0.0)
    turn = frames.turned_by(-yaw)[:2, :2]
    ny, nx = states.shape
    corners = np.array([[0, 0], [nx, 0], [0, ny], [nx, ny]], dtype=np.float64) @ turn.T
    low = np.floor(corners.min(axis=0)) - _MARGIN
    size = (np.ceil(corners.max(axis=0)) + _MARGIN - low).astype(int)
    at = np.stack(np.meshgrid(np.arange(size[0]), np.arange(size[1])), axis=-1) + 0.5 + low
    source = np.floor(at @ turn).astype(int)
    inside = ((source >= 0) & (source < [nx, ny])).all(axis=-1)
    out = np.full((size[1], size[0]), UNOBSERVED, dtype=np.uint8)
    out[inside] = states[source[inside, 1], source[inside, 0]]
    _paint_walls(out, states == OCCUPIED, turn, low)
    return OccupancyGrid(low * cell, cell, out, out == FREE, 0.0)


def _paint_walls(out: NDArray[np.uint8], walls: Bool, turn: Float, low: Float) -> None:
    """Forward: every occupied cell reaches the new raster, so that walls one cell thick keep no holes."""
    iy, ix = np.nonzero(walls)
    at = np.floor(np.column_stack([ix + 0.5, iy + 0.5]) @ turn.T - low).astype(int)
    out[at[:, 1], at[:, 0]] = OCCUPIED


def find_furniture(states: NDArray[np.uint8], cell: float, config: MapsConfig) -> Bool:
    """(ny, nx) isolated objects that are too small or too compact to be walls."""
    labels, patches = measure_patches(states != FREE, connectivity=8)
    out = np.zeros(states.shape, dtype=bool)
    ny, nx = states.shape
    for k, (x, y, w, h) in enumerate(patches[:, :4].tolist(), start=1):
        if max(w, h) * cell > config.furniture_size * 1.2 or x == 0 or y == 0 or x + w == nx or y + h == ny:
            continue
        mine = labels[y : y + h, x : x + w] == k
        if _is_furniture(mine, cell, config):
            out[y : y + h, x : x + w] |= mine
    return out


def _is_furniture(mask: Bool, cell: float, config: MapsConfig) -> bool:
    """By the sides of the smallest box around an object, in any direction."""
    short, long = ((side + 1) * cell for side in smallest_box(np.argwhere(mask).astype(np.float64)))
    if long < config.leg_size:
        return True
    return long < config.furniture_size and long < config.furniture_ratio * short

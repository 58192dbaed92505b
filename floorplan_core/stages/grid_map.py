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
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config, FrameConfig, MapsConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, GridMap, ManhattanFrame, OccupancyGrid
from floorplan_core.stages import manhattan_frame as frames

Float = NDArray[np.float64]
Bool = NDArray[np.bool_]

_SMOOTH = 1.5  # cells a boundary may deviate from its straight line
_LEAST_EDGE = 6.0  # cells: the direction of shorter edges is a matter of rounding
_EXACT = math.radians(0.1)  # a yaw below this is none: the map is taken as it is
_SEARCH = math.radians(2)  # the directions of edges are right to this
_NEAR_AXIS = math.radians(10)  # boundaries within this of an axis make the search
_SUBSAMPLES = 3  # points of an occupied cell a side, so that a turned wall keeps no holes
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
        frames._rotation_about_z(-grid_map.yaw - yaw), grid_map.yaw + yaw, 0.0, support, length, 0.0, None
    )
    grid = _turned(grid_map, yaw)
    shift = frame.rotation[:2, :2] @ np.array(grid_map.origin)
    grid = replace(grid, origin=grid.origin + shift)
    furniture = find_furniture(grid.states, grid.cell, config.maps)
    floor = (grid.states == FREE) | furniture
    return MapFloor(frame, grid, floor, furniture)


def _yaw(free: Bool, cell: float, config: FrameConfig) -> tuple[float, float, float]:
    """Yaw of the walls in the map's axes, radians; the share of boundary behind it; metres of boundary."""
    edges = _straight_edges(free)
    vector = edges[:, 2:] - edges[:, :2]
    length = np.hypot(vector[:, 0], vector[:, 1])
    angle = np.arctan2(vector[:, 1], vector[:, 0])
    metres = float(length.sum() * cell)
    if len(edges) == 0:
        return 0.0, 0.0, metres
    if config.yaw_deg is not None:
        yaw = float(frames._wrap(math.radians(config.yaw_deg)))
    else:
        yaw = _sharpened(edges, frames._strongest_direction(angle, length), config)
    near = np.abs(frames._wrap(angle - yaw)) < math.radians(config.tolerance_deg)
    return (0.0 if abs(yaw) < _EXACT else yaw), float(length[near].sum() / length.sum()), metres


def _straight_edges(free: Bool) -> Float:
    """(N, 4) x0, y0, x1, y1 of the straight boundaries of the free space, cells."""
    import cv2

    contours, _ = cv2.findContours(free.astype(np.uint8), cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
    rows = []
    for contour in contours:
        ring = cv2.approxPolyDP(contour, _SMOOTH, True)[:, 0].astype(np.float64)
        rows.append(np.hstack([ring, np.roll(ring, -1, axis=0)]))
    edges = np.concatenate([np.zeros((0, 4)), *rows])
    return np.asarray(edges[np.hypot(edges[:, 2] - edges[:, 0], edges[:, 3] - edges[:, 1]) >= _LEAST_EDGE])


def _sharpened(edges: Float, coarse: float, config: FrameConfig) -> float:
    """The yaw around ``coarse`` under which the boundaries, projected along themselves, are sharpest."""
    vector = edges[:, 2:] - edges[:, :2]
    angle = np.arctan2(vector[:, 1], vector[:, 0]) - coarse
    off = frames._wrap(angle)
    near = np.abs(off) < _NEAR_AXIS
    along = np.round((angle - off) / (math.pi / 2)).astype(int) % 2  # 0: the edge runs along x
    points, axis = [np.zeros((0, 2))], [np.zeros(0, dtype=np.int64)]
    for a, v, k in zip(edges[near, :2], vector[near], along[near], strict=True):
        steps = np.arange(0.5, np.hypot(*v)) / np.hypot(*v)
        points.append(a + steps[:, None] * v)
        axis.append(np.full(len(steps), 1 - k))
    xy, normal = np.concatenate(points), np.concatenate(axis)
    if len(xy) == 0:
        return coarse
    xy = xy - xy.mean(axis=0)
    yaw, fine = coarse, math.radians(config.yaw_step_deg)
    for span, pace in ((_SEARCH, 2 * fine), (4 * fine, fine / 2)):
        trial = yaw + np.arange(-round(span / pace), round(span / pace) + 1) * pace
        # bins of one cell: finer ones would only see the raster
        yaw = float(trial[int(np.argmax(frames._sharpness(xy, normal, trial, 1.0)))])
    return float(frames._wrap(yaw))


def _turned(grid_map: GridMap, yaw: float) -> OccupancyGrid:
    """The map resampled into axes turned by ``yaw``; walls keep no holes. Exactly the map where yaw is 0."""
    states, cell = grid_map.states, grid_map.resolution
    if yaw == 0.0:
        return OccupancyGrid(np.zeros(2), cell, states, states == FREE, 0.0)
    turn = frames._rotation_about_z(-yaw)[:2, :2]
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
    """Forward: every occupied cell reaches the new raster, whatever the rounding."""
    iy, ix = np.nonzero(walls)
    for dx in (np.arange(_SUBSAMPLES) + 0.5) / _SUBSAMPLES:
        for dy in (np.arange(_SUBSAMPLES) + 0.5) / _SUBSAMPLES:
            at = np.floor(np.column_stack([ix + dx, iy + dy]) @ turn.T - low).astype(int)
            out[at[:, 1], at[:, 0]] = OCCUPIED


def find_furniture(states: NDArray[np.uint8], cell: float, config: MapsConfig) -> Bool:
    """(ny, nx) isolated objects that are too small or too compact to be walls."""
    import cv2

    count, labels, stats, _ = cv2.connectedComponentsWithStats(
        (states != FREE).astype(np.uint8), connectivity=8
    )
    out = np.zeros(states.shape, dtype=bool)
    ny, nx = states.shape
    for k in range(1, count):
        x, y, w, h = (int(v) for v in stats[k, :4])
        if max(w, h) * cell > config.furniture_size * 1.2 or x == 0 or y == 0 or x + w == nx or y + h == ny:
            continue
        mine = labels[y : y + h, x : x + w] == k
        if _is_furniture(mine, cell, config):
            out[y : y + h, x : x + w] |= mine
    return out


def _is_furniture(mask: Bool, cell: float, config: MapsConfig) -> bool:
    """By the sides of the smallest box around an object, in any direction."""
    import cv2

    points = np.argwhere(mask)[:, ::-1].astype(np.float32)
    short, long = sorted((float(v) + 1) * cell for v in cv2.minAreaRect(points)[1])
    if long < config.leg_size:
        return True
    return long < config.furniture_size and long < config.furniture_ratio * short

"""The exploring path: the circulation and a chosen share of the rooms, never through furniture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import UsageError
from floorplan_core.simulation.building import Building, solid_hulls
from floorplan_core.simulation.search import nearest_goal, reachable
from floorplan_core.simulation.solids import building_solids

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

CELL = 0.1  # m
RADIUS = 0.22  # m, half the carrier's width and a little
COMFORT = 0.6  # m from obstacles that the carrier likes to keep
BODY = (0.05, 1.9)  # m above the floor between which things are in the way
CORRIDOR_STEP = 6.0  # m between waypoints of the circulation
LOBBY = 1.5  # m from obstacles in the middle of a lobby, at least
BIG_ROOM = 22.0  # m2: gets a second waypoint


@dataclass(frozen=True)
class FloorGrid:
    """Where the carrier can be. Cell ``[iy, ix]`` is centred at ``origin + CELL * ([ix, iy] + 0.5)``."""

    origin: Float  # (2,) metres, building axes
    clearance: Float  # (ny, nx) metres to the nearest obstacle
    space: NDArray[np.int32]  # (ny, nx) index of the space; -1 outside all
    open: Mask  # (ny, nx) reachable cells with enough clearance

    def centre(self, flat: NDArray[np.int64]) -> Float:
        """(N, 2) metres of flat cell indices."""
        nx = self.open.shape[1]
        return self.origin + CELL * (np.column_stack([flat % nx, flat // nx]) + 0.5)


@dataclass(frozen=True)
class Walk:
    """A continuous path with the places where the explorer stops to look around."""

    path: Float  # (N, 2) metres, building axes, steps of about half a cell to one cell
    stops: NDArray[np.int64]  # (S,) rows of ``path`` that are waypoints
    stop_space: NDArray[np.int64]  # (S,) the space of each waypoint
    look: Mask  # (S,) there is much to see around: a room, or a lobby
    entered: tuple[int, ...]  # indices of the spaces that the path enters, the corridor included


def cells_in(rects: Float, origin: Float, shape: tuple[int, ...]) -> list[tuple[slice, slice]]:
    """For each rectangle the rows and columns of the cells whose centre it holds."""
    low = np.ceil((rects[:, :2] - origin) / CELL - 0.5).astype(int)
    high = np.ceil((rects[:, 2:] - origin) / CELL - 0.5).astype(int)
    low, high = np.maximum(low, 0), np.minimum(high, np.array(shape)[::-1])
    return [(slice(a[1], b[1]), slice(a[0], b[0])) for a, b in zip(low, high, strict=True)]


def floor_grid(building: Building) -> FloorGrid:
    """Rasterise the floor and what stands in the way."""
    from scipy import ndimage

    x0, y0, x1, y1 = building.extent
    origin, shape = np.array([x0, y0]), (int((y1 - y0) / CELL) + 1, int((x1 - x0) / CELL) + 1)
    space = space_map(building, origin, shape)
    free = space >= 0
    passages = np.array([d.bounds for d in building.doors]).reshape(-1, 4)
    for cut in cells_in(passages, origin, shape):
        free[cut] = True
    hulls = solid_hulls(building_solids(building))
    low = hulls[(hulls[:, 2] < BODY[1]) & (hulls[:, 5] > BODY[0])][:, [0, 1, 3, 4]]
    for cut in cells_in(low + 0.01 * np.array([-1, -1, 1, 1]), origin, shape):
        free[cut] = False
    clearance = CELL * (ndimage.distance_transform_edt(free) - 0.5)
    wide = clearance >= RADIUS
    corridor = np.where(wide & (space == 0), clearance, 0)
    seed = np.unravel_index(int(np.argmax(corridor)), shape)
    if corridor[seed] <= 0:
        raise UsageError("The corridor of this building is too narrow to walk; widen corridor_width.")
    return FloorGrid(origin, clearance, space, reachable(wide, (int(seed[0]), int(seed[1]))))


def space_map(building: Building, origin: Float, shape: tuple[int, int]) -> NDArray[np.int32]:
    """(ny, nx) index of the space that holds each cell's centre; -1 in walls and outside."""
    space = np.full(shape, -1, dtype=np.int32)
    for index, item in enumerate(building.spaces):
        for cut in cells_in(item.rects, origin, shape):
            space[cut] = index
    return space


def explore(building: Building, grid: FloorGrid, share: float, rng: np.random.Generator) -> Walk:
    """Walk the whole circulation and enter ``share`` of the rooms that can be reached.

    A room behind another room brings the rooms on the way with it. Next is always the nearest waypoint.
    """
    chosen = choose_rooms(building, grid, share, rng)
    goals = np.array(_waypoints(building, grid, chosen), dtype=np.int64)
    banned = np.isin(grid.space, [i for i in range(len(building.spaces)) if i not in chosen and i != 0])
    near = np.minimum(grid.clearance, COMFORT)
    cost = np.where(grid.open & ~banned, 1 + 4 * (1 - near / COMFORT) ** 2, np.inf)
    waiting = np.zeros(grid.open.size, dtype=bool)
    waiting[goals] = True
    here = int(goals[np.argmin(grid.centre(goals).sum(axis=1))])
    legs, stops, seen = [np.array([here])], [0], 1
    waiting[here] = False
    while waiting.any():
        leg = nearest_goal(cost, here, waiting)
        if len(leg) == 0:
            break
        here = int(leg[-1])
        waiting[here] = False
        legs.append(leg[1:])
        seen += len(leg) - 1
        stops.append(seen - 1)
    cells = np.concatenate(legs)
    entered = tuple(sorted({int(i) for i in np.unique(grid.space.ravel()[cells]) if i >= 0}))
    spaces = grid.space.ravel()[cells[stops]].astype(np.int64)
    look = (spaces > 0) | (grid.clearance.ravel()[cells[stops]] > LOBBY)
    return Walk(_smooth(grid.centre(cells), grid), np.array(stops), spaces, look, entered)


def choose_rooms(building: Building, grid: FloorGrid, share: float, rng: np.random.Generator) -> set[int]:
    """Indices of the rooms to enter, with the rooms that lead to them."""
    leads = _leads(building)
    there = np.unique(grid.space[grid.open])
    rooms = [int(i) for i in there if i > 0 and i in leads]
    wanted = round(share * len(rooms))
    chosen: set[int] = set()
    for room in rng.permutation(np.array(rooms, dtype=np.int64)):
        way = {int(room), *_rooms_before(int(room), leads)}
        if len(chosen | way) <= wanted:
            chosen |= way
    return chosen


def _leads(building: Building) -> dict[int, int]:
    """For each room that open doors connect with the corridor: the space that leads to it."""
    leads: dict[int, int] = {}
    front = [0]
    while front:
        reached = {0, *leads}
        found = [
            (b, a)
            for door in building.doors
            if door.open
            for a, b in (door.joins, door.joins[::-1])
            if a in front and b not in reached
        ]
        front = []
        for room, by in found:
            if room not in leads:
                leads[room] = by
                front.append(room)
    return leads


def _rooms_before(room: int, leads: dict[int, int]) -> list[int]:
    """The rooms between ``room`` and the corridor."""
    way = []
    while leads[room] != 0:
        room = leads[room]
        way.append(room)
    return way


def _waypoints(building: Building, grid: FloorGrid, rooms: set[int]) -> list[int]:
    """Flat cells to visit: along the corridors, and one or two in each room."""
    found = []
    flat = np.arange(grid.open.size).reshape(grid.open.shape)
    for rect in building.spaces[0].rects:
        found += _along(rect, grid, flat)
    for room in sorted(rooms):
        cells = flat[grid.open & (grid.space == room)]
        first = cells[np.argmax(np.minimum(grid.clearance.ravel()[cells], 1.0) - _off_middle(cells, grid))]
        found.append(int(first))
        if building.spaces[room].area > BIG_ROOM:
            away = np.hypot(*(grid.centre(cells) - grid.centre(np.array([first]))).T)
            roomy = grid.clearance.ravel()[cells] > COMFORT / 2 + CELL
            found.append(int(cells[np.argmax(away * (0.1 + roomy))]))
    return found


def _off_middle(cells: NDArray[np.int64], grid: FloorGrid) -> Float:
    """Small penalty for being away from the middle of the cells (breaks ties sensibly)."""
    at = grid.centre(cells)
    return np.asarray(0.05 * np.hypot(*(at - at.mean(axis=0)).T))


def _along(rect: Float, grid: FloorGrid, flat: NDArray[np.int64]) -> list[int]:
    """Roomiest reachable cells at both ends of a corridor rectangle and every few metres between."""
    axis = int(rect[3] - rect[1] > rect[2] - rect[0])
    length = rect[axis + 2] - rect[axis]
    count = max(2, round(length / CORRIDOR_STEP) + 1)
    found = []
    for at in (
        np.linspace(rect[axis] + 0.8, rect[axis + 2] - 0.8, count)
        if length > 2.4
        else [rect[[axis, axis + 2]].mean()]
    ):
        box = rect.copy()
        box[[axis, axis + 2]] = at - 0.4, at + 0.4
        cut = cells_in(box[None], grid.origin, grid.open.shape)[0]
        roomy = np.where(grid.open[cut], grid.clearance[cut], 0)
        if roomy.size and roomy.max() > 0:
            found.append(int(flat[cut].ravel()[np.argmax(roomy)]))
    return found


def _smooth(path: Float, grid: FloorGrid, rounds: int = 12) -> Float:
    """Average each point with its neighbours where that keeps the clearance; ends stay."""
    path = path.copy()
    nx, ny = grid.open.shape[1], grid.open.shape[0]
    for _ in range(rounds):
        moved = path.copy()
        moved[1:-1] = (path[:-2] + 2 * path[1:-1] + path[2:]) / 4
        i = np.clip(((moved - grid.origin) / CELL).astype(int), 0, [nx - 1, ny - 1])
        fine = grid.open[i[:, 1], i[:, 0]]
        path = np.where(fine[:, None], moved, path)
    return path

"""Corrections of walls on a grid map: its spaces are its cells, so what a person says changes cells.

In: the map in the Manhattan frame, its planes as the machine found them, and as a person corrected them
(:func:`~floorplan_core.stages.corrections_walls.correct_walls`). Out: the map as it would look if they were
right: a wall that is none becomes free, through to what lies behind; a face that moved leaves free or
occupied cells; an added wall is occupied. Passages, spaces and planes are then found on that map, and the
planes of the corrected places carry the exact offset and the mark of the hand.
Cost: the cells of the corrected walls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import FREE, OCCUPIED, LayoutPlane, OccupancyGrid
from floorplan_core.stages.corrections_walls import ADDED
from floorplan_core.stages.grid_map import MapFloor

States = NDArray[np.uint8]
Planes = Sequence[LayoutPlane]

THICKEST = 0.6  # m of wall that is taken out behind a face that is none
_SAME_PLACE = 1.5  # cells between a corrected plane and the one found there on the corrected map


def correct_map(ground: MapFloor, machine: Planes, corrected: Planes) -> MapFloor:
    """The map with the cells that ``corrected`` asks for; the same object where it asks for none."""
    states, before = ground.grid.states.copy(), {p.id: p for p in machine}
    for plane in corrected:
        first = before.get(plane.id)
        if first is None or not plane.by_hand:
            continue
        if plane.by_hand == "hidden":
            _open(states, ground.grid, first)
        elif plane.offset != first.offset:
            _move(states, ground.grid, first, plane.offset)
    for name in dict.fromkeys(p.id[:-1] for p in corrected if p.id.startswith(ADDED)):
        _build(states, ground.grid, [p for p in corrected if p.id[:-1] == name])
    if np.array_equal(states, ground.grid.states):
        return ground
    changed = states != ground.grid.states
    floor = np.where(changed, states == FREE, ground.floor)
    grid = replace(ground.grid, states=states, universe=states == FREE)
    return replace(ground, grid=grid, floor=floor, furniture=ground.furniture & ~changed)


def mark_planes(found: Planes, corrected: Planes, cell: float) -> tuple[LayoutPlane, ...]:
    """The planes of the corrected map: by hand where they were corrected, the hidden ones at the end."""
    if not corrected:
        return tuple(found)
    by_hand = [p for p in corrected if p.by_hand and p.by_hand != "hidden"]
    out = tuple(_marked(plane, by_hand, cell) for plane in found)
    hidden = [p for p in corrected if p.by_hand == "hidden" and not p.id.startswith(ADDED)]
    names = {p.id for p in out}
    kept = [p if p.id not in names else replace(p, id=f"hx-{p.id}") for p in hidden]
    return (*out, *(replace(p, segments=()) for p in kept))


def _marked(plane: LayoutPlane, by_hand: list[LayoutPlane], cell: float) -> LayoutPlane:
    near = [
        (abs(h.offset - plane.offset), k, h)
        for k, h in enumerate(by_hand)
        if h.facing == plane.facing and abs(h.offset - plane.offset) <= _SAME_PLACE * cell and _meet(h, plane)
    ]
    if not near:
        return plane
    hand = min(near, key=lambda n: n[:2])[2]
    return replace(plane, offset=hand.offset, by_hand=hand.by_hand)


def _meet(a: LayoutPlane, b: LayoutPlane) -> bool:
    return any(s < v and u < e for s, e in a.walls for u, v in b.walls)


def _open(states: States, grid: OccupancyGrid, plane: LayoutPlane) -> None:
    """Free the wall behind a face: to the free cells beyond, else what is occupied of it."""
    view, sign = _across_columns(states, plane), plane.facing.sign
    deep = round(THICKEST / grid.cell)
    line = _index(plane.offset, grid, plane.facing.axis)
    behind = line - 1 - np.arange(deep) if sign > 0 else line + np.arange(deep)
    behind = behind[(behind >= 0) & (behind < view.shape[1])]
    for start, end in plane.walls:
        rows = _rows(start, end, grid, plane)
        wall = view[rows][:, behind]
        free = wall == FREE
        through = np.where(free.any(axis=1), free.argmax(axis=1), (wall == OCCUPIED).argmin(axis=1))
        through = np.where(~free.any(axis=1) & (wall == OCCUPIED).all(axis=1), len(behind), through)
        wall[np.arange(len(behind)) < through[:, None]] = FREE
        block = view[rows]
        block[:, behind] = wall
        view[rows] = block


def _move(states: States, grid: OccupancyGrid, plane: LayoutPlane, offset: float) -> None:
    """What lies between the old and the new place of a face becomes free, or wall."""
    view = _across_columns(states, plane)
    a, b = (_index(v, grid, plane.facing.axis) for v in (plane.offset, offset))
    state = OCCUPIED if (b - a) * plane.facing.sign > 0 else FREE
    for start, end in plane.walls:
        view[_rows(start, end, grid, plane), min(a, b) : max(a, b)] = state
        if state == FREE:  # the wall goes on where it moved to
            wall = b - 1 if plane.facing.sign > 0 else b
            if 0 <= wall < view.shape[1]:
                view[_rows(start, end, grid, plane), wall] = OCCUPIED


def _build(states: States, grid: OccupancyGrid, faces: list[LayoutPlane]) -> None:
    """Occupy what lies between the faces of an added wall, one cell at least."""
    low, high = min(p.offset for p in faces), max(p.offset for p in faces)
    first = _index(low, grid, faces[0].facing.axis)
    last = max(first + 1, _index(high, grid, faces[0].facing.axis))
    for face in faces:
        if face.by_hand != "hidden":
            view = _across_columns(states, face)
            for start, end in face.walls:
                view[_rows(start, end, grid, face), first:last] = OCCUPIED


def _across_columns(states: States, plane: LayoutPlane) -> States:
    """The cells with the plane's axis along the columns: a view, not a copy."""
    return states if plane.facing.axis == 0 else states.T


def _index(value: float, grid: OccupancyGrid, axis: int) -> int:
    """The line between cells that is nearest to a coordinate."""
    return max(round((value - float(grid.origin[axis])) / grid.cell), 0)


def _rows(start: float, end: float, grid: OccupancyGrid, plane: LayoutPlane) -> slice:
    along = 1 - plane.facing.axis
    return slice(_index(start, grid, along), _index(end, grid, along))

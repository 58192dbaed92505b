"""Two rooms behind two doors, and a region that holds both."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from floorplan_core.model import FREE, Door, Facing, LayoutPlane, OccupancyGrid
from floorplan_core.stages.room_splits import RoomSplitter

CELL, THICK = 0.1, 0.12


def grid(*seen: tuple[float, float, float, float]) -> OccupancyGrid:
    """12 x 6 m, free in the boxes ``seen``."""
    states = np.zeros((60, 120), dtype=np.uint8)
    for x0, y0, x1, y1 in seen:
        states[round(y0 / CELL) : round(y1 / CELL), round(x0 / CELL) : round(x1 / CELL)] = FREE
    return OccupancyGrid(np.zeros(2), CELL, states, states == FREE, 1.2)


def door(name: str, start: float) -> Door:
    """In the wall below y = 1."""
    return Door(name, (), 1, 0.95, start, start + 0.9, thickness=0.1)


def split(cells: OccupancyGrid, doors: list[Door], planes: tuple[LayoutPlane, ...] = ()) -> list[Any]:
    rooms = RoomSplitter(planes, doors, cells, THICK).split(shapely.box(1, 1, 10, 5))
    return sorted(rooms, key=lambda r: r.bounds)


LEFT, RIGHT = (2.0, 1.0, 4.0, 4.0), (6.0, 1.0, 9.0, 4.0)
DOORS = [door("d1", 2.5), door("d2", 7.0)]


def test_two_patches_before_two_doors_are_two_rooms() -> None:
    left, right = split(grid(LEFT, RIGHT), DOORS)
    assert left.bounds == pytest.approx((1, 1, 5 - THICK / 2, 5))
    assert right.bounds == pytest.approx((5 + THICK / 2, 1, 10, 5))


def test_the_cut_follows_a_wall_of_the_building() -> None:
    plane = LayoutPlane("p1", Facing.WEST, 4.6, support=3.0)
    left, right = split(grid(LEFT, RIGHT), DOORS, (plane,))
    assert left.bounds[2] == pytest.approx(4.6)  # the face that looks west closes the room in the west
    assert right.bounds[0] == pytest.approx(4.6 + THICK)


def test_a_room_is_not_cut_where_rays_passed() -> None:
    assert len(split(grid(LEFT, RIGHT, (4.0, 2.0, 6.0, 2.5)), DOORS)) == 1


def test_shadows_of_furniture_part_no_room_with_one_door() -> None:
    assert len(split(grid(LEFT, RIGHT), DOORS[:1])) == 1


def test_two_patches_behind_one_door_are_one_room() -> None:
    both = Door("d1", (), 1, 0.95, 2.5, 7.5, thickness=0.1, kind="opening")
    assert len(split(grid(LEFT, RIGHT), [both, *DOORS])) == 1


def test_three_rooms_come_apart() -> None:
    cells = grid((1.2, 1.0, 3.0, 4.0), (4.5, 1.0, 6.0, 4.0), (7.5, 1.0, 9.5, 3.0))
    rooms = split(cells, [door("d1", 1.5), door("d2", 4.8), door("d3", 8.0)])
    assert len(rooms) == 3
    assert shapely.union_all(rooms).area == pytest.approx(sum(r.area for r in rooms))


CORRIDOR = (1.0, 1.0, 3.0, 5.0)  # runs past the wall below y = 3, around whose end the region reaches
HALL, BEHIND = (3.0, 1.0, 9.0, 2.9), (5.5, 3.2, 8.0, 4.5)
INNER = Door("d1", (), 1, 3.0, 6.0, 6.9, thickness=0.1)


def test_the_room_behind_a_door_is_cut_off_where_the_region_reaches_around_its_wall() -> None:
    face = LayoutPlane("p1", Facing.WEST, 3.1, support=3.0)
    shape = shapely.difference(shapely.box(1, 1, 10, 5), shapely.box(3.1, 2.95, 10, 3.15))
    cells = grid(CORRIDOR, HALL, BEHIND, (6.0, 2.9, 6.9, 3.2))
    corner, room = sorted(RoomSplitter((face,), [INNER], cells, THICK).split(shape), key=lambda r: r.bounds)
    assert corner.bounds == pytest.approx((1, 1, 10, 5))
    assert room.bounds == pytest.approx((3.1 + THICK, 3.15, 10, 5))
    assert shape.area - corner.area - room.area == pytest.approx(THICK * 1.85, abs=0.02)


def test_a_door_parts_nothing_where_free_space_leads_around_its_wall() -> None:
    shape = shapely.difference(shapely.box(1, 1, 10, 5), shapely.box(3.1, 2.95, 10, 3.15))
    cells = grid(CORRIDOR, HALL, (3.0, 3.2, 8.0, 4.5), (6.0, 2.9, 6.9, 3.2))
    assert len(RoomSplitter((), [INNER], cells, THICK).split(shape)) == 1

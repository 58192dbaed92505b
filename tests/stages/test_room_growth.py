"""A room of which a part was seen, between walls that were seen from its other side or not at all."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from floorplan_core.model import FREE, Facing, LayoutPlane, LayoutSegment, OccupancyGrid
from floorplan_core.stages.region_sides import WallSurfaces
from floorplan_core.stages.room_growth import RoomGrower

THICK = 0.12  # what WallSurfaces takes where no wall was seen from both sides
NOTHING = shapely.Polygon()


def wall(name: str, facing: Facing, offset: float, start: float, end: float) -> LayoutPlane:
    run = np.array([[start, end]])
    return LayoutPlane(name, facing, offset, (f"s-{name}",), 5.0, walls=run, observed=run)


def grow(seen: Any, planes: list[LayoutPlane], others: Any = NOTHING, outdoors: Any = None) -> Any:
    return grower(planes, outdoors).grow(seen, others)


def grower(planes: list[LayoutPlane], outdoors: Any = None) -> RoomGrower:
    segments = [
        LayoutSegment(s, p.facing, p.offset, *p.walls[0], 0.0, 2.5, 5.0, 100, 0.01, 0.001, plane=p.id)
        for p in planes
        for s in p.segments
    ]
    states = np.zeros((100, 220), dtype=np.uint8)
    cells = OccupancyGrid(np.array([-1.0, -1.0]), 0.1, states, states == FREE, 1.2)
    if outdoors is not None:
        x0, y0, x1, y1 = (round((v + 1.0) / 0.1) for v in outdoors)
        states[y0:y1, x0:x1] = FREE
    return RoomGrower(planes, WallSurfaces(planes, segments), (), cells, 0.4)


# The room is 0 .. 5 by 0 .. 4; its west, south and north sides were seen.
ROUND = [
    wall("west", Facing.EAST, 0.0, 0.0, 4.0),
    wall("south", Facing.NORTH, 0.0, 0.0, 2.5),
    wall("north", Facing.SOUTH, 4.0, 0.0, 2.5),
]
PART = shapely.box(0, 0, 3, 4)


def test_a_guessed_side_stops_a_wall_before_the_next_room() -> None:
    neighbour = wall("beyond", Facing.EAST, 5.0 + THICK, 0.0, 4.0)
    assert grow(PART, [*ROUND, neighbour]).bounds == pytest.approx((0, 0, 5, 4))


def test_a_guessed_side_goes_to_the_face_that_was_seen() -> None:
    assert grow(PART, [*ROUND, wall("east", Facing.WEST, 5.0, 0.0, 2.0)]).bounds[2] == pytest.approx(5.0)


def test_between_two_regions_stands_a_wall() -> None:
    assert grow(PART, ROUND, shapely.box(4.5, -1, 8, 5)).bounds[2] == pytest.approx(4.5 - THICK)


def test_where_nothing_closes_the_room_a_plane_of_the_building_does() -> None:
    far = wall("far", Facing.WEST, 5.0, 20.0, 24.0)  # the same line, elsewhere in the building
    assert grow(PART, [*ROUND, far]).bounds[2] == pytest.approx(5.0)


def test_where_nothing_is_known_the_side_stays() -> None:
    assert grow(PART, ROUND).equals(PART)


def test_a_room_seen_whole_stays() -> None:
    closed = [*ROUND, wall("east", Facing.WEST, 3.0, 0.0, 4.0), wall("far", Facing.WEST, 5.0, 0.0, 4.0)]
    assert grow(PART, closed).equals(PART)


def test_no_room_grows_into_the_open() -> None:
    beyond = wall("beyond", Facing.EAST, 5.0 + THICK, 0.0, 4.0)
    assert grow(PART, [*ROUND, beyond], outdoors=(3.5, 1.0, 4.5, 3.0)).equals(PART)


def test_a_wall_across_keeps_a_side_from_going_on() -> None:
    across = wall("across", Facing.NORTH, 2.0, 3.8, 4.8)
    beyond = wall("beyond", Facing.EAST, 5.0 + THICK, 0.0, 4.0)
    assert grow(PART, [*ROUND, beyond, across]).equals(PART)


def test_steps_between_guessed_sides_are_filled() -> None:
    steps = shapely.union_all([shapely.box(0, 0, 3, 2), shapely.box(0, 0, 2, 4)])
    assert grow(steps, ROUND).equals(PART)


def test_a_corner_between_walls_that_were_seen_stays() -> None:
    inner = [wall("step", Facing.WEST, 2.0, 2.0, 4.0), wall("ledge", Facing.SOUTH, 2.0, 2.0, 3.0)]
    steps = shapely.union_all([shapely.box(0, 0, 3, 2), shapely.box(0, 0, 2, 4)])
    assert grow(steps, [*ROUND, *inner]).equals(steps)


def test_many_rooms_stay_disjoint() -> None:
    rooms = [shapely.box(3 * k, 0, 3 * k + 1.5, 4) for k in range(4)]
    planes = [wall("south", Facing.NORTH, 0.0, 0.0, 12.0), wall("north", Facing.SOUTH, 4.0, 0.0, 12.0)]
    cells = np.zeros((100, 150), dtype=np.uint8)
    empty = OccupancyGrid(np.array([-1.0, -1.0]), 0.1, cells, cells == FREE, 1.2)
    grown = RoomGrower(planes, WallSurfaces(planes, ()), (), empty, 0.4).grow_all(rooms)
    assert shapely.union_all(grown).area == pytest.approx(sum(r.area for r in grown))
    assert all(g.contains(r) for g, r in zip(grown, rooms, strict=True))
    assert sum(g.area for g in grown) > 1.5 * sum(r.area for r in rooms)


def test_where_nothing_is_known_a_room_gets_the_usual_width() -> None:
    """Three rooms 3 m wide were seen whole; of a fourth, at the corridor's end, a strip."""
    planes = [wall(f"w{k}", Facing.EAST, 4.0 * k, 0.0, 4.0) for k in range(3)]
    planes += [wall(f"e{k}", Facing.WEST, 4.0 * k + 3.0, 0.0, 4.0) for k in range(3)]
    planes += [wall("south", Facing.NORTH, 0.0, 0.0, 14.0), wall("north", Facing.SOUTH, 4.0, 0.0, 14.0)]
    planes += [wall("last", Facing.EAST, 16.5, 20.0, 24.0)]  # the building goes on
    whole = [shapely.box(4 * k, 0, 4 * k + 3, 4) for k in range(3)]
    *same, strip = grower(planes).grow_all([*whole, shapely.box(12, 0, 13.4, 4)])
    assert all(a.equals(b) for a, b in zip(same, whole, strict=True))
    x0, _, x1, _ = strip.bounds
    assert x1 - x0 == pytest.approx(3.0, abs=0.3)
    assert x0 >= 11.0 + THICK - 1e-6


def test_no_room_is_widened_beyond_the_last_wall_of_the_building() -> None:
    planes = [wall(f"w{k}", Facing.EAST, 4.0 * k, 0.0, 4.0) for k in range(4)]
    planes += [wall(f"e{k}", Facing.WEST, 4.0 * k + 3.0, 0.0, 4.0) for k in range(3)]
    planes += [wall("south", Facing.NORTH, 0.0, 0.0, 14.0), wall("north", Facing.SOUTH, 4.0, 0.0, 14.0)]
    whole = [shapely.box(4 * k, 0, 4 * k + 3, 4) for k in range(3)]
    *_, strip = grower(planes).grow_all([*whole, shapely.box(12, 0, 13.4, 4)])
    assert strip.bounds[2] == pytest.approx(13.4)

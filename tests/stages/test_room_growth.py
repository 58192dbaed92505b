"""A room of which a part was seen, between walls that were seen from its other side or not at all."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from floorplan_core.model import FREE, Door, Facing, LayoutPlane, LayoutSegment, OccupancyGrid
from floorplan_core.stages.region_sides import WallSurfaces
from floorplan_core.stages.room_growth import Neighbours, RoomGrower

THICK = 0.12  # what WallSurfaces takes where no wall was seen from both sides
NOTHING = shapely.Polygon()


def wall(name: str, facing: Facing, offset: float, start: float, end: float) -> LayoutPlane:
    run = np.array([[start, end]])
    return LayoutPlane(name, facing, offset, (f"s-{name}",), 5.0, walls=run, observed=run)


def grow(seen: Any, planes: list[LayoutPlane], others: Any = NOTHING, outdoors: Any = None) -> Any:
    return grower(planes, outdoors).grow(seen, Neighbours([others]))


def grower(
    planes: list[LayoutPlane],
    outdoors: Any = None,
    doors: tuple[Door, ...] = (),
    seen: Any = None,
    loose: tuple[LayoutSegment, ...] = (),
) -> RoomGrower:
    segments = [
        LayoutSegment(s, p.facing, p.offset, *p.walls[0], 0.0, 2.5, 5.0, 100, 0.01, 0.001, plane=p.id)
        for p in planes
        for s in p.segments
    ]
    states, low = np.zeros((200, 220), dtype=np.uint8), -10.0
    universe = np.zeros_like(states, dtype=bool)
    for box, inside in ((outdoors, False), (seen, True)):
        if box is not None:
            x0, y0, x1, y1 = (round((v - o) / 0.1) for v, o in zip(box, (-1, low, -1, low), strict=True))
            states[y0:y1, x0:x1], universe[y0:y1, x0:x1] = FREE, inside
    cells = OccupancyGrid(np.array([-1.0, low]), 0.1, states, universe, 1.2)
    return RoomGrower(planes, WallSurfaces(planes, [*segments, *loose]), doors, cells, 0.4)


def piece(offset: float, start: float, end: float, why: str = "low") -> LayoutSegment:
    """A low surface that looks into the room from the east, which made no plane."""
    return LayoutSegment(
        f"low{offset}",
        Facing.WEST,
        offset,
        start,
        end,
        *(0.2, 1.8, 1.0, 100, 0.01, 0.001),
        structural=False,
        evidence=(why,),
    )


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


def rooms_seen_whole() -> tuple[list[LayoutPlane], list[Any]]:
    """Three rooms of 4 x 5 m in a row from x = 6, all of their walls seen."""
    planes, rooms = [], []
    for k in range(3):
        x = 6 + 4.12 * k
        rooms.append(shapely.box(x, 0, x + 4, 5))
        planes += [wall(f"e{k}", Facing.EAST, x, 0, 5), wall(f"w{k}", Facing.WEST, x + 4, 0, 5)]
        planes += [wall(f"n{k}", Facing.NORTH, 0, x, x + 4), wall(f"s{k}", Facing.SOUTH, 5, x, x + 4)]
    return planes, rooms


def test_a_room_is_no_deeper_beyond_what_was_seen_than_rooms_are() -> None:
    planes, rooms = rooms_seen_whole()
    far = wall("far", Facing.NORTH, -9, 18, 19)  # borrowed: nothing of it was seen before the room below
    made = grower([*planes, wall("n", Facing.SOUTH, -1, 6, 10), far], seen=(6, -3, 7, -1))
    grown = made.grow_all([*rooms, shapely.box(6, -9, 10, -1)])
    assert grown[3].bounds[1] == pytest.approx(-5)
    assert grown[3].bounds[3] == pytest.approx(-1)
    near = made.grow_all([*rooms, shapely.box(6, -7, 10, -1)])
    assert near[3].bounds[1] <= -7  # as far as a room reaches


def test_a_narrow_strip_without_a_door_belongs_to_the_room_beside_it() -> None:
    planes, rooms = rooms_seen_whole()
    planes += [
        wall("n", Facing.NORTH, 0, 1, 5),
        wall("s", Facing.SOUTH, 5, 1, 5),
        wall("e", Facing.EAST, 1, 0, 5),
    ]
    planes.append(
        wall("b", Facing.WEST, 4.5, 8, 9)
    )  # a plane of the building, of which nothing was seen here
    short = shapely.box(1, 0, 4.5, 5)
    grown = grower(planes).grow_all([*rooms, short])
    assert grown[3].bounds[2] == pytest.approx(6 - THICK)
    door = Door("d", (), 1, -0.06, 4.6, 5.4, thickness=0.12)
    assert grower(planes, doors=(door,)).grow_all([*rooms, short])[3].equals(short)


def test_stray_rays_are_no_open_air() -> None:
    planes = [wall("w", Facing.WEST, 6, 0, 4)]
    grown = grow(shapely.box(1, 0, 4, 4), planes, outdoors=(4.2, 1.0, 4.8, 1.6))
    assert grown.bounds[2] == pytest.approx(6)


def test_a_guessed_side_comes_back_to_what_was_seen_to_close_the_room() -> None:
    """The side was borrowed from a wall 2 m beyond the last free cell; there stands something low."""
    borrowed, beyond = shapely.box(0, 0, 5, 4), [*ROUND, wall("far", Facing.WEST, 5.0, 20.0, 24.0)]
    seen, behind = (0.0, 0.0, 3.0, 4.0), piece(3.5, 2.0, 3.5)

    def east(*loose: LayoutSegment) -> float:
        grown = grower(beyond, seen=seen, loose=loose).grow(borrowed, Neighbours([NOTHING]))
        return float(grown.bounds[2])

    assert east() == pytest.approx(5.0)
    assert east(piece(3.05, 0.5, 2.0)) == pytest.approx(3.05)
    assert east(piece(3.05, 0.5, 2.0), behind) == pytest.approx(3.5)  # what it stands at
    assert east(piece(3.05, 0.5, 1.5)) == pytest.approx(5.0)  # too short for the side
    assert east(piece(3.05, 0.5, 2.0, "looked over")) == pytest.approx(5.0)  # air behind it
    assert east(piece(2.0, 0.5, 2.0)) == pytest.approx(5.0)  # the room goes on behind it


def test_surfaces_that_leave_nothing_of_a_room_do_not_close_it() -> None:
    """A few rays passed along the wall in the west, and something stands there."""
    beyond = [*ROUND, wall("far", Facing.WEST, 5.0, 20.0, 24.0)]
    grower_of_it = grower(beyond, seen=(0.0, 0.0, 0.1, 4.0), loose=(piece(0.02, 0.5, 2.0),))
    grown = grower_of_it.grow(shapely.box(0, 0, 5, 4), Neighbours([NOTHING]))
    assert grown.bounds == pytest.approx((0, 0, 5, 4))


def test_a_guessed_side_is_pushed_past_no_surface_that_faces_the_room() -> None:
    beyond = [*ROUND, wall("beyond", Facing.EAST, 5.0 + THICK, 0.0, 4.0)]
    free = grower(beyond, seen=(0.0, 0.0, 3.0, 4.0), loose=(piece(3.4, 0.5, 2.0),))
    assert free.grow(PART, Neighbours([NOTHING])).bounds[2] == pytest.approx(3.4)


def test_a_borrowed_side_that_free_space_crosses_goes_on_to_the_wall_ahead() -> None:
    """The plane at x = 3 is a wall elsewhere; here the room was seen to go on, to the next wall."""
    planes = [
        *(wall("w", Facing.EAST, 0.0, 0.0, 3.0), wall("s", Facing.NORTH, 0.0, 0.0, 3.0)),
        *(wall("n", Facing.SOUTH, 3.0, 0.0, 3.0), wall("far", Facing.EAST, 6.0, -1.0, 4.0)),
        wall("borrowed", Facing.WEST, 3.0, -4.0, -2.0),
    ]
    part = shapely.box(0, 0, 3, 3)
    whole = grower(planes, seen=(0.5, 0.5, 5.5, 2.5)).grow(part, Neighbours([NOTHING]))
    assert whole.bounds == pytest.approx((0, 0, 6.0 - THICK, 3), abs=1e-6)
    assert grower(planes, seen=(0.5, 0.5, 2.9, 2.5)).grow(part, Neighbours([NOTHING])).bounds[2] == 3

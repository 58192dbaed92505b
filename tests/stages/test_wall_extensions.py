"""A region of two glimpsed rooms, and the near end of the wall between them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from floorplan_core.model import FREE, Facing, LayoutPlane, OccupancyGrid
from floorplan_core.stages.wall_extensions import WallExtender

CELL, THICK = 0.1, 0.12
WHOLE = shapely.box(1, 1, 10, 5)
LEFT, RIGHT = (2.0, 1.0, 4.0, 4.0), (6.0, 1.0, 9.0, 4.0)


def grid(*seen: tuple[float, float, float, float]) -> OccupancyGrid:
    """12 x 6 m, free in the boxes ``seen``."""
    states = np.zeros((60, 120), dtype=np.uint8)
    for x0, y0, x1, y1 in seen:
        states[round(y0 / CELL) : round(y1 / CELL), round(x0 / CELL) : round(x1 / CELL)] = FREE
    return OccupancyGrid(np.zeros(2), CELL, states, states == FREE, 1.2)


def wall(facing: Facing, offset: float, start: float, end: float) -> LayoutPlane:
    runs = np.array([[start, end]])
    return LayoutPlane("p", facing, offset, support=1.0, walls=runs, observed=runs)


def split(cells: OccupancyGrid, *planes: LayoutPlane) -> list[Any]:
    return sorted(WallExtender(planes, cells, THICK).split(WHOLE), key=lambda r: r.bounds)


STUB = wall(Facing.WEST, 5.0, 1.0, 1.8)


def test_a_wall_of_which_the_near_end_was_seen_parts_the_rooms_beside_it() -> None:
    left, right = split(grid(LEFT, RIGHT), STUB)
    assert left.bounds == pytest.approx((1, 1, 5.0, 5))
    assert right.bounds == pytest.approx((5.0 + THICK, 1, 10, 5))


def test_a_part_that_nothing_asks_for_is_left_out() -> None:
    (only,) = split(grid(LEFT), STUB)
    assert only.bounds == pytest.approx((1, 1, 5.0, 5))


def test_what_was_seen_to_pass_beyond_its_end_stops_it() -> None:
    assert split(grid(LEFT, RIGHT, (4.0, 3.0, 6.0, 3.5)), STUB) == [WHOLE]


def test_a_wall_ends_where_another_meets_it() -> None:
    corner = wall(Facing.NORTH, 1.8, 5.0, 8.0)
    assert split(grid(LEFT, RIGHT), STUB, corner) == [WHOLE]


def test_short_hidden_and_guessed_pieces_tell_nothing() -> None:
    runs = np.array([[1.0, 1.8]])
    guess = LayoutPlane("q", Facing.WEST, 5.0, walls=runs, observed=runs, speculated=True)
    hidden = LayoutPlane("h", Facing.WEST, 5.0, walls=runs, observed=runs, by_hand="hidden")
    assert split(grid(LEFT, RIGHT), guess, hidden, wall(Facing.WEST, 5.0, 1.0, 1.2)) == [WHOLE]


def test_a_wall_beside_the_region_is_its_side() -> None:
    assert split(grid(LEFT, RIGHT), wall(Facing.EAST, 1.05, 1.0, 2.0)) == [WHOLE]


def test_a_wall_goes_on_from_where_the_cut_along_it_ends() -> None:
    """What stands in a room was cut out of it, and some centimetres more."""
    slit = WHOLE.difference(shapely.box(5.0, 1.0, 5.0 + THICK, 2.1))
    parts = WallExtender([STUB], grid(LEFT, RIGHT), THICK).split(slit)
    assert sorted(round(p.bounds[0], 2) for p in parts) == [1.0, 5.12]


def test_of_a_wall_in_two_places_one_may_go_on_and_the_other_not() -> None:
    """Beyond its far end the region is a bay, in which another wall meets it."""
    bay = shapely.union_all([WHOLE, shapely.box(4.5, 5.2, 5.5, 7.0)]).union(shapely.box(4.5, 4.9, 4.8, 5.3))
    wall_to_bay = wall(Facing.WEST, 5.0, 3.5, 5.3)
    across = wall(Facing.NORTH, 5.3, 5.1, 5.4)
    parts = WallExtender([wall_to_bay, across], grid(LEFT, RIGHT), THICK).split(bay)
    assert len(parts) == 2


@pytest.mark.parametrize(
    ("start", "inferred", "parts"),
    [
        (1.0, True, 2),  # 2.9 m of wall, and a doorway beyond it
        (1.0, False, 1),  # seen to be free: what parts rooms there is a door, or nothing
        (2.6, True, 1),  # as much gap as wall
    ],
)
def test_where_free_space_is_a_guess_a_doorway_beyond_a_long_wall_may_be_one(start, inferred, parts):
    passed = (2.0, 4.2, 9.0, 4.9)  # 0.7 m of the line, between the wall's end and the far side
    stub = wall(Facing.WEST, 5.0, start, 3.6)
    cells = grid(LEFT, RIGHT, passed)
    near = shapely.box(1, 1, 10, 5) if start == 1.0 else shapely.box(1, 2.6, 10, 5)
    assert len(WallExtender([stub], cells, THICK, inferred).split(near)) == parts


def test_such_a_guess_parts_no_strip_from_a_room() -> None:
    """0.9 m beside a wall is a cabinet's place, and no room."""
    beside = shapely.box(4.04, 1, 10, 5)
    cells = grid((4.1, 1.0, 4.9, 4.0), RIGHT, (4.1, 4.2, 9.0, 4.9))
    assert WallExtender([wall(Facing.WEST, 5.0, 1.0, 3.6)], cells, THICK, True).split(beside) == [beside]

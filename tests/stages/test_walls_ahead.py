"""What stops a side of a room that goes out."""

import numpy as np
import pytest

from floorplan_core.model import Facing, LayoutPlane
from floorplan_core.stages.walls_ahead import WallsAhead

THICKNESS = 0.12  # m


def wall(facing: Facing, offset: float, start: float, end: float) -> LayoutPlane:
    run = np.array([[start, end]])
    return LayoutPlane(f"{facing.name}{offset}", facing, offset, walls=run, observed=run)


def limits(planes: list[LayoutPlane], *side: float) -> tuple[float, float]:
    """Of a side that looks west, and so goes out along +x."""
    return WallsAhead(planes, THICKNESS).limits(Facing.WEST, *side)


def test_without_walls_nothing_stops_a_side() -> None:
    assert limits([], 0.0, 0.0, 3.0) == (np.inf, np.inf)


def test_a_wall_that_faces_much_of_the_side_closes_it() -> None:
    assert limits([wall(Facing.WEST, 2.0, 0.5, 2.5)], 0.0, 0.0, 3.0) == (2.0, 2.0)


def test_of_a_wall_whose_other_face_was_seen_the_side_keeps_its_thickness() -> None:
    assert limits([wall(Facing.EAST, 2.0, 0.5, 2.5)], 0.0, 0.0, 3.0) == (2.0 - THICKNESS, 2.0)


def test_a_wall_that_faces_little_of_it_and_one_across_only_keep_it_from_going_on() -> None:
    assert limits([wall(Facing.WEST, 2.0, 2.6, 9.0)], 0.0, 0.0, 3.0) == (np.inf, 2.0)
    assert limits([wall(Facing.NORTH, 1.5, 1.2, 4.0)], 0.0, 0.0, 3.0) == (np.inf, 1.2)


def test_what_lies_behind_the_side_or_beside_it_stops_nothing() -> None:
    behind, beside = wall(Facing.WEST, -1.0, 0.0, 3.0), wall(Facing.WEST, 1.0, 3.1, 9.0)
    corner = wall(Facing.NORTH, 2.9, 0.0, 4.0)  # less deep in the new part than a wall that is its side
    assert limits([behind, beside, corner], 0.0, 0.0, 3.0) == (np.inf, np.inf)


@pytest.mark.parametrize("facing", Facing)
def test_every_facing_sees_the_same_of_a_building_turned_with_it(facing: Facing) -> None:
    """A building is turned by swapping and flipping its axes; the limits stay."""
    rng = np.random.default_rng(3)
    turned = facing.sign < 0  # as WEST
    for _ in range(50):
        rows = [
            (Facing(rng.integers(4)), rng.uniform(-3, 3), *np.sort(rng.uniform(-3, 3, 2))) for _ in range(6)
        ]
        planes, images = [wall(*row) for row in rows], []
        for seen, offset, start, end in rows:
            axis, sign = seen.axis, seen.sign
            if axis == 0:  # along the way out
                image = (offset, start, end) if turned else (-offset, start, end)
                sign = sign if turned else -sign
            else:
                image = (offset, start, end) if turned else (offset, -end, -start)
            axis = axis if facing.axis == 0 else 1 - axis
            images.append(wall(Facing(2 * axis + (sign < 0)), *image))
        at, low, high = 0.1, -1.0, 1.5
        expected = limits(planes, at, low, high)
        mine = WallsAhead(images, THICKNESS).limits(facing, at if turned else -at, low, high)
        assert mine == pytest.approx(expected)

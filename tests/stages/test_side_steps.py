"""A long side along which the wall steps back, or forward."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from floorplan_core.model import Facing, LayoutPlane, LayoutSegment
from floorplan_core.stages.region_sides import WallSurfaces

CORRIDOR = shapely.box(0, 0, 20, 2.5)
TALL, BEAM = 2.0, 0.4  # m of the height that was seen


def front(k: int, offset: float, start: float, end: float, height: float = TALL) -> LayoutSegment:
    """A surface along the lower side."""
    area = height * (end - start)
    return LayoutSegment(
        f"s{k}", Facing.NORTH, offset, start, end, 0.2, 2.5, area, 300, 0.01, 0.001, plane="p1"
    )


def fitted(*fronts: tuple[float, ...], by_hand: str = "") -> shapely.Polygon:
    planes = [LayoutPlane("p1", Facing.NORTH, 0.0, walls=np.array([[0.0, 20.0]]), by_hand=by_hand)]
    return WallSurfaces(planes, [front(k, *f) for k, f in enumerate(fronts)]).fit(CORRIDOR)


def test_a_wall_that_steps_back_is_followed() -> None:
    found = fitted((0.0, 0.0, 11.0), (-0.2, 11.5, 15.0), (-0.2, 16.0, 20.0))
    assert found.symmetric_difference(CORRIDOR.union(shapely.box(11, -0.2, 20, 0))).area < 1e-6


def test_a_wall_that_steps_forward_is_followed() -> None:
    found = fitted((0.0, 0.0, 11.0), (0.2, 11.5, 15.0), (0.2, 16.0, 20.0))
    assert found.symmetric_difference(CORRIDOR.difference(shapely.box(11, 0, 20, 0.2))).area < 1e-6


@pytest.mark.parametrize(
    "other",
    [
        (-0.2, 12.0, 13.5),  # too short
        (-0.1, 12.0, 19.0),  # within the voxels
        (-0.2, 12.0, 19.0, BEAM),
        (-0.4, 12.0, 19.0),  # another wall
    ],
)
def test_what_is_no_wall_of_its_own_makes_no_step(other) -> None:
    assert len(fitted((0.0, 0.0, 11.0), other).exterior.coords) == 5


def test_pillars_do_not_end_a_step_and_walls_do() -> None:
    rest = (-0.2, 10.0, 13.0), (-0.2, 13.5, 17.0)
    assert fitted((0.0, 0.0, 9.0), (0.0, 13.1, 13.4), *rest).area == pytest.approx(50 + 0.2 * 11)
    assert fitted((0.0, 0.0, 9.0), (0.0, 17.0, 20.0), *rest).area == pytest.approx(50 + 0.2 * 8)


def test_a_wall_placed_by_hand_stays_straight() -> None:
    found = fitted((0.0, 0.0, 11.0), (-0.2, 11.5, 15.0), (-0.2, 16.0, 20.0), by_hand="moved")
    assert found.equals(CORRIDOR)

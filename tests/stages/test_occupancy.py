"""What is free of two rooms of 3 x 3 m beside each other, of which the sensor was in the left one."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import OccupancyConfig
from floorplan_core.geometry.columns import height_mask
from floorplan_core.model import FREE, Door, Facing, LayoutPlane, OccupancyGrid
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.occupancy import slice_map
from tests.drawn_cells import seen_free

CELL, SIZE = 0.1, 62
LEFT = (slice(0, 30), slice(0, 30))
WALL = LayoutPlane("w", Facing.WEST, 3.05, support=5.0, walls=np.array([[0.0, 1.0], [2.0, 3.0]]))
LEAF = LayoutPlane("l", Facing.WEST, 3.05, support=5.0, walls=np.array([[0.0, 3.0]]))
DOOR = Door("d", ("w",), 0, 3.05, 1.0, 2.0, thickness=0.1)
FLOOR = height_mask(0, 0.2)


def evidence(
    rows: slice, columns: slice, low: float, high: float, floor: bool, inferred: bool = False
) -> Evidence:
    """The left room seen whole; of the right one a box of cells, free between two heights."""
    free = np.zeros((30, SIZE), dtype=np.uint64)
    hits = np.zeros((60, 2 * SIZE), dtype=np.uint64)
    free[LEFT] = height_mask(0.2, 2.5)
    hits[:60, :60] = FLOOR
    free[rows, columns] = height_mask(low, high)
    if floor:
        hits[2 * rows.start : 2 * rows.stop, 2 * columns.start : 2 * columns.stop] = FLOOR
    return seen_free(free, hits=hits, cell=CELL, path=np.array([[1.5, 1.5]]), inferred=inferred)


def sliced(found: Evidence, plane: LayoutPlane, *doors: Door) -> OccupancyGrid:
    return slice_map(found, (plane,), doors, OccupancyConfig(slice_height=1.2))


GLIMPSE = (slice(10, 20), slice(32, 45))  # rows, columns: 1.3 m2 behind the door


def test_floor_seen_below_free_space_is_free_where_no_ray_passed_the_slice() -> None:
    grid = sliced(evidence(*GLIMPSE, 0.3, 0.7, floor=True), WALL, DOOR)
    assert (grid.states[GLIMPSE] == FREE).all()
    assert grid.universe[GLIMPSE].all()


@pytest.mark.parametrize(
    ("low", "floor", "inferred"), [(0.3, False, False), (2.2, True, False), (0.3, True, True)]
)
def test_free_space_without_floor_over_heads_or_guessed_is_not(
    low: float, floor: bool, inferred: bool
) -> None:
    grid = sliced(evidence(*GLIMPSE, low, low + 0.4, floor, inferred), WALL, DOOR)
    assert not grid.universe[GLIMPSE].any()


def test_a_small_patch_just_behind_a_door_is_a_room_and_elsewhere_none() -> None:
    small = (slice(12, 16), slice(32, 37))  # 0.2 m2
    found = evidence(*small, 0.2, 2.5, floor=True)
    assert sliced(found, WALL, DOOR).universe[small].all()
    assert not sliced(found, LEAF).universe[small].any()

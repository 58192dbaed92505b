"""A corridor whose floor was seen, and a room behind a door of which only the walls were seen."""

from __future__ import annotations

import numpy as np

from floorplan_core.geometry.columns import height_mask
from floorplan_core.stages.guessed_viewpoints import seen_from_the_middle, standing_places

CELL = 0.1
WALL, BODY = height_mask(0.0, 2.6), height_mask(0.3, 2.4)


def building(door: bool) -> tuple[np.ndarray, np.ndarray]:
    """Corridor x 1 .. 59, y 1 .. 19; room y 21 .. 49 behind a wall with a door at x 27 .. 35. Voxels."""
    occupied = np.zeros((51, 61), dtype=np.uint64)
    occupied[[0, 20, 50], :] = occupied[:, [0, 60]] = WALL
    if door:
        occupied[20, 27:35] = 0
    free = np.zeros_like(occupied)
    free[1:20, 1:60] = BODY
    return free, occupied


def share_free(free: np.ndarray) -> float:
    """Of the room, at eye level."""
    return float(((free[21:50, 1:60] & height_mask(1.2, 1.3)) != 0).mean())


def test_what_is_seen_through_the_door_is_free() -> None:
    free, occupied = building(door=True)
    assert share_free(free) == 0.0
    assert share_free(seen_from_the_middle(free, occupied, CELL)) > 0.6


def test_nothing_is_seen_through_a_wall() -> None:
    free, occupied = building(door=False)
    assert share_free(seen_from_the_middle(free, occupied, CELL)) == 0.0


def test_what_was_free_stays_free_and_walls_stay_walls() -> None:
    free, occupied = building(door=True)
    seen = seen_from_the_middle(free, occupied, CELL)
    assert ((seen & free) == free).all()
    assert not (seen & occupied).any()


def test_nobody_stands_in_a_gap() -> None:
    free, occupied = building(door=True)
    free[1:14, :] = 0  # 0.6 m of free space are left
    assert len(standing_places(free, CELL)) == 0
    assert (seen_from_the_middle(free, occupied, CELL) == free).all()


def test_places_are_thinned_out_where_there_are_many() -> None:
    free = np.full((600, 600), BODY)
    places = standing_places(free, CELL)
    assert 50 < len(places) <= 150

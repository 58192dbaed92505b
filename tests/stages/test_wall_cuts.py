"""Walls that stand in a region's interior are cut out of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from floorplan_core.model import Facing, LayoutPlane, WallProfile
from floorplan_core.stages.wall_cuts import cut_walls, standing_walls

ROOM = shapely.box(0, 0, 6, 4)
# A cut is as thick as a wall is, 0.1 m, and goes 0.05 m past the ends of what was seen.


def _plane(walls: list[tuple[float, float]], by_hand: str = "") -> LayoutPlane:
    """x = 3, seen to stand from y = 1 to y = 2.5."""
    low = np.zeros(40)
    low[10:25] = 0.9
    profile = WallProfile(0.0, 0.1, low, np.zeros(40), np.zeros(40))
    runs = np.array(walls, dtype=np.float64).reshape(-1, 2)
    return LayoutPlane("p1", Facing(0), 3.0, support=3.0, profile=profile, walls=runs, by_hand=by_hand)


@pytest.mark.parametrize("walls", [[(1.0, 2.5)], [(0.9, 2.6)], []])
def test_a_standing_wall_is_cut_out_whichever_plane_its_run_went_to(walls: list[tuple[float, float]]) -> None:
    left = cut_walls(ROOM, standing_walls([_plane(walls)], 0.4))
    assert left.area == pytest.approx(ROOM.area - 1.6 * 0.1, abs=1e-6)


def test_what_a_person_removed_is_not_cut() -> None:
    assert cut_walls(ROOM, standing_walls([_plane([], "hidden")], 0.4)).equals(ROOM)
    half = cut_walls(ROOM, standing_walls([_plane([(2.0, 2.5)], "kept")], 0.4))
    assert half.area == pytest.approx(ROOM.area - 0.6 * 0.1, abs=1e-6)


def test_a_weak_plane_cuts_nothing() -> None:
    assert cut_walls(ROOM, standing_walls([replace(_plane([]), support=0.1)], 0.4)).equals(ROOM)

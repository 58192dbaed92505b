"""Walls and regions of real runs of planar lasers, whose walls are short and many."""

from __future__ import annotations

import pytest

import floorplan_core as fc
from floorplan_core.stages.wall_cuts import cut_walls, standing_walls
from tests.plan_invariants import assert_coverage, assert_no_wall_inside
from tests.plugins.plugin_files import shared


@pytest.mark.parametrize("name", ["carmen_aces/points2d.ply", "carmen_intel/points2d.ply"])
def test_no_room_grows_past_the_end_of_a_wall(name: str) -> None:
    plan = fc.process(fc.open_survey(shared(name)))
    assert_coverage(plan.regions)
    assert_no_wall_inside(plan)
    standing = standing_walls(plan.planes, plan.config.regions.wall_support)
    assert len(standing) > 50
    for region in plan.regions:
        assert cut_walls(region.polygon, standing).area > region.area - 0.01, region.name

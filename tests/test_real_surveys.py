"""The invariants of plans on real runs of planar lasers, whose walls are short and many."""

from __future__ import annotations

import pytest

import floorplan_core as fc
from floorplan_core.plugins import default_registry
from tests.plan_invariants import assert_valid
from tests.plugins.plugin_files import shared


@pytest.mark.parametrize("name", ["carmen_aces/points2d.ply", "carmen_intel/points2d.ply"])
def test_no_room_grows_past_the_end_of_a_wall(name: str) -> None:
    assert_valid(fc.process(fc.open_survey(shared(name), registry=default_registry())))

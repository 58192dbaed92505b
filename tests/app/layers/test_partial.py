"""What stages tell of a first plan is shown along the axes of the plan to come."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from floorcast_app.layers.partial import InWorld, partial_layer
from floorplan_core.model.quarter_turns import turned_frame, turned_plan
from tests.factories import l_corridor


def test_results_turn_as_the_frame_before_them_says():
    plan = l_corridor(yaw_deg=12.0)
    own = turned_plan(plan, 3)  # as the stages make it, in another quadrant
    in_world = InWorld()
    assert in_world(own.planes) is not own.planes  # nothing is known of the frame yet: as it is
    assert [p.offset for p in in_world(own.planes)] == [p.offset for p in own.planes]
    in_world(turned_frame(plan.frame, 3))
    assert [(p.facing, p.offset) for p in in_world(own.planes)] == [(p.facing, p.offset) for p in plan.planes]
    kind, _, bounds = partial_layer(in_world(own.grid))
    assert kind == "free_space"
    assert np.allclose(bounds, plan.grid.extent)


def test_a_plan_of_another_survey_turns_anew():
    plan = l_corridor()
    in_world = InWorld()
    in_world(turned_frame(plan.frame, 1))
    in_world(replace(plan.frame))
    assert in_world(plan.grid).extent == plan.grid.extent

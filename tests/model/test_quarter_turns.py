"""A plan in turned axes is the same plan of the same world."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.model import CandidateSet, Facing, FloorPlan, LayoutPlane, WallProfile, Wing
from floorplan_core.model.quarter_turns import (
    quarters_to_world,
    turned_facing,
    turned_plan,
    turned_plane,
    turned_result,
)
from floorplan_core.stages.corrections import Placed, Remarks, place, wall_place
from tests.factories import l_corridor, manhattan_frame
from tests.plan_invariants import (
    assert_coverage,
    assert_doors,
    assert_exported_coverage,
    assert_no_wall_inside,
)

QUARTERS = (1, 2, 3)


@pytest.fixture(scope="module")
def plan() -> FloorPlan:
    made = l_corridor(yaw_deg=12.0, shift=(300.0, -20.0, 5.0))
    wing = Wing(np.radians(30.0), made.planes[:2], made.segments[:2])
    return replace(made, wings=(wing,), trajectory=np.array([[1.0, 2.0], [3.0, 0.5]]))


def in_world(plan: FloorPlan) -> dict[str, np.ndarray]:
    """Everything that lies somewhere, in coordinates of the world, in the order of the plan."""
    ny, nx = plan.grid.states.shape
    iy, ix = np.mgrid[0:ny, 0:nx]
    centres = (np.column_stack([ix.ravel(), iy.ravel()]) + 0.5) * plan.grid.cell + plan.grid.origin
    cells = np.column_stack(
        [plan.to_world(centres).round(6), plan.grid.states.ravel(), plan.grid.universe.ravel()]
    )
    boxes = plan.cover.bounds
    return {
        "regions": np.concatenate([plan.to_world(np.array(r.polygon.exterior.coords)) for r in plan.regions]),
        "sides": np.concatenate(
            [plan.to_world(np.array([s.start, s.end])) for r in plan.regions for s in r.sides]
        ),
        "doors": np.concatenate([sorted(plan.to_world(d.line()).tolist()) for d in plan.doors]),
        "segments": np.concatenate([sorted(plan.to_world(s.line()).tolist()) for s in plan.segments]),
        "points": plan.to_world(plan.wall_points.xy),
        "path": plan.to_world(plan.trajectory),
        "cover": plan.to_world((boxes[:, :2] + boxes[:, 2:]) / 2),
        "cells": cells[np.lexsort(cells.T[:2])],
        "wings": np.concatenate(
            [sorted(plan.to_world(w.to_plan(s.line())).tolist()) for w in plan.wings for s in w.segments]
        ),
    }


@pytest.mark.parametrize("quarters", QUARTERS)
def test_nothing_in_the_world_moves(plan, quarters):
    before, after = in_world(plan), in_world(turned_plan(plan, quarters))
    for name, places in before.items():
        assert after[name] == pytest.approx(places, abs=1e-5), name


@pytest.mark.parametrize("quarters", QUARTERS)
def test_a_turned_plan_is_a_valid_plan(plan, quarters):
    there = turned_plan(replace(plan, wings=()), quarters)
    assert_coverage(there.regions)
    for holds in (assert_exported_coverage, assert_doors, assert_no_wall_inside):
        holds(there)


@pytest.mark.parametrize("quarters", QUARTERS)
def test_there_and_back_is_the_same_to_the_byte(plan, quarters):
    assert geojson_text(turned_plan(turned_plan(plan, quarters), -quarters)) == geojson_text(plan)


@pytest.mark.parametrize("quarters", QUARTERS)
@pytest.mark.parametrize("facing", Facing, ids=str)
def test_surfaces_look_the_same_way(plan, facing, quarters):
    def normal(facing: Facing, frame_of: FloorPlan) -> np.ndarray:
        own = np.zeros((1, 2))
        own[0, facing.axis] = facing.sign
        return frame_of.to_world(own) - frame_of.to_world(np.zeros((1, 2)))

    there = normal(turned_facing(facing, quarters), turned_plan(plan, quarters))
    assert there == pytest.approx(normal(facing, plan))


@pytest.mark.parametrize("quarters", QUARTERS)
@pytest.mark.parametrize("facing", Facing, ids=str)
def test_what_was_seen_along_a_plane_stays_where_it_was(plan, facing, quarters):
    profile = WallProfile(1.0, 0.5, np.array([0.1, 0.2, 0.9]), np.zeros(3), np.array([0.0, 0.3, 0.0]))
    runs = np.array([[1.0, 1.5], [2.0, 2.5]])
    plane = LayoutPlane("p1", facing, 4.0, profile=profile, walls=runs, observed=runs[:1])
    moved, there = turned_plane(plane, quarters), turned_plan(plan, quarters)
    assert moved.profile is not None and (np.diff(moved.walls.ravel()) > 0).all()
    for k, low in enumerate(profile.low):
        at = plan.to_world(np.array([plane.point(profile.start + (k + 0.5) * profile.step)]))
        own = there.manhattan_from_world @ [*at[0], plan.local_frame.shift[2] + plan.frame.floor_z, 1.0]
        offset, along = own[moved.facing.axis], own[1 - moved.facing.axis]
        assert offset == pytest.approx(moved.offset)
        assert moved.profile.low[int((along - moved.profile.start) / moved.profile.step)] == low
        inside = any(a < along < b for a, b in moved.walls)
        assert inside == any(a < profile.start + (k + 0.5) * profile.step < b for a, b in runs)


def test_candidates_say_their_bounds_in_the_plan_s_axes():
    offsets = [np.array(v) for v in ([0.0, 4.0], [3.0, 7.0], [1.0], [6.0])]
    families = np.array([[0, 0, 0, 2, 0, 1], [1, 0, 1, 2, 0, 1]], dtype=np.int32)
    given = CandidateSet(*offsets, families)
    assert given.bounds().tolist() == [[0, 1, 3, 6], [0, 1, 7, 6], [4, 1, 7, 6]]
    assert replace(given, quarters=1).bounds().tolist() == [[-6, 0, -1, 3], [-6, 0, -1, 7], [-6, 4, -1, 7]]


@pytest.mark.parametrize("yaw", [0, 40, 50, 100, 179, -91, -46])
def test_a_plan_is_shown_along_the_nearest_axes_of_the_world(yaw):
    frame = manhattan_frame(float(yaw))
    small = (yaw + 45) % 90 - 45
    frame = replace(frame, yaw=np.radians(small))
    turns = quarters_to_world(frame)
    assert (turns * 90 - (yaw - small)) % 360 == 0


def test_stages_results_turn_with_the_plan(plan):
    assert turned_result("words", 1) == "words"
    there = turned_plan(plan, 1)
    grid = turned_result(plan.grid, 1)
    assert grid.extent == there.grid.extent
    assert [p.offset for p in turned_result(plan.planes, 1)] == [p.offset for p in there.planes]


def test_sentences_name_places_in_the_axes_of_the_reader():
    at, wall = (3.0, -1.5), (0.0, -2.25)
    lost = Placed(f"The door at {place(at)} is gone.", at)
    stood = Placed(f"wall at {wall_place(wall)}", wall, form=wall_place)
    said = Remarks((("p1", stood),), (lost.within(f"In the wing: {lost}"), "Nothing else.")).turned(1)
    assert said.warnings == ("In the wing: The door at (1.50, 3.00) is gone.", "Nothing else.")
    assert said.machine == (("p1", "wall at 2.250 m"),)

"""Metrics stay in their bounds and do not depend on where the building stands."""

from __future__ import annotations

import copy

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.evaluation import compare, parse_plan
from floorplan_core.evaluation.truths import parse_truth
from tests.evaluation.evaluation_cases import YAW, door, perfect_plan, region, truth, turned

LENGTH = st.floats(-6, 12).map(lambda v: round(v, 2))
BOX = st.tuples(LENGTH, LENGTH, st.floats(0.5, 8), st.floats(0.5, 8))


@st.composite
def plans(draw):
    """Some of the true regions, some strange ones, some doors anywhere."""
    plan = perfect_plan()
    plan["features"] = [f for f in plan["features"] if draw(st.booleans())]
    for i, (x, y, w, h) in enumerate(draw(st.lists(BOX, max_size=3))):
        label = draw(st.sampled_from(["room", "corridor", "hall"]))
        plan["features"].append(region(20 + i, [[x, y], [x + w, y], [x + w, y + h], [x, y + h]], label))
    for i, (x, y, w, _) in enumerate(draw(st.lists(BOX, max_size=3))):
        kind = draw(st.sampled_from(["door", "opening"]))
        plan["features"].append(door(20 + i, [[x, y], [x + w, y]], kind))
    return plan


def shares(report):
    found = [report.label_accuracy]
    for scores in (report.rooms, report.rooms_entered, report.rooms_glimpsed):
        found += [getattr(scores, n) for n in ("precision", "recall", "f1", "f1_75", "mean_iou", "min_iou")]
    found += [getattr(report.doors, n) for n in ("precision", "recall", "f1")]
    found += [report.free_space.precision, report.free_space.recall, report.free_space.predicted_right]
    return [*found, report.dimensions_all.share]


@settings(max_examples=60, deadline=None)
@given(plans())
def test_shares_lie_between_zero_and_one(plan):
    report = compare(parse_plan(plan, "plan"), parse_truth(truth(), "truth"))
    assert all(value is None or 0 <= value <= 1 for value in shares(report))
    assert report.free_space.outside_m2 <= report.free_space.plan_m2 + 1e-9
    assert report.doors.found <= min(report.doors.required, report.doors.judged)
    assert report.rows()


def moved(plan, degrees, shift):
    """The whole plan turned and shifted in the world."""
    plan = copy.deepcopy(plan)
    for feature in plan["features"]:
        geometry = feature["geometry"]
        rings = geometry["coordinates"]
        geometry["coordinates"] = (
            [turned(r, degrees, shift) for r in rings]
            if geometry["type"] == "Polygon"
            else turned(rings, degrees, shift)
        )
    return plan


@settings(max_examples=40, deadline=None)
@given(plans(), st.floats(-180, 180), st.floats(-1000, 1000), st.floats(-1000, 1000))
def test_scores_do_not_change_when_plan_and_truth_move_together(plan, degrees, x, y):
    here = compare(parse_plan(plan, "plan"), parse_truth(truth(), "truth"))
    pose = [[0.0] * 4 for _ in range(4)]
    for axis, unit in enumerate(((1.0, 0.0), (0.0, 1.0))):
        pose[0][axis], pose[1][axis] = turned([unit], YAW + degrees)[0]
    pose[0][3], pose[1][3], pose[2][2], pose[3][3] = x, y, 1.0, 1.0
    document = {**truth(), "T_world_building": pose}
    there = compare(parse_plan(moved(plan, degrees, (x, y)), "plan"), parse_truth(document, "truth"))
    for a, b in zip(shares(here), shares(there), strict=True):
        assert a == pytest.approx(b, abs=1e-6)
    for a, b in zip(here.measured, there.measured, strict=True):
        assert (a.plan is None) == (b.plan is None)
        assert a.plan is None or a.plan == pytest.approx(b.plan, abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(plans(), st.randoms(use_true_random=False))
def test_scores_do_not_depend_on_the_order_of_features(plan, random):
    shuffled = copy.deepcopy(plan)
    random.shuffle(shuffled["features"])
    reports = [compare(parse_plan(p, "plan"), parse_truth(truth(), "truth")) for p in (plan, shuffled)]
    assert reports[0].rooms.found == reports[1].rooms.found
    assert reports[0].doors.found == reports[1].doors.found
    assert reports[0].rooms.mean_iou == pytest.approx(reports[1].rooms.mean_iou)

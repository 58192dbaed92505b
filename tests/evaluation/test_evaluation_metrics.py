"""Known plans give known scores."""

from __future__ import annotations

import json
import math

import pytest
import shapely

from floorplan_core.evaluation import EvaluationReport, compare, evaluate, parse_plan
from floorplan_core.evaluation.truths import parse_truth
from tests.evaluation.evaluation_cases import YAW, door, frame, perfect_plan, region, truth, turned


def scored(plan=None, document=None) -> EvaluationReport:
    return compare(parse_plan(plan or perfect_plan(), "plan"), parse_truth(document or truth(), "truth"))


def replace_region(plan, index, polygon, label="room"):
    plan["features"][index] = region(index + 1, polygon, label)
    return plan


def test_a_perfect_plan_has_no_error():
    report = scored()
    assert report.dimensions_all.measured == 5
    assert report.dimensions_all.max_m == pytest.approx(0, abs=1e-9)
    for scores in (report.rooms, report.rooms_entered, report.rooms_glimpsed):
        assert (scores.precision, scores.recall, scores.f1, scores.f1_75) == (1, 1, 1, 1)
        assert scores.min_iou == pytest.approx(1)
    assert report.label_accuracy == 1
    assert (report.merged, report.split) == (0, 0)
    assert (report.doors.precision, report.doors.recall, report.doors.f1) == (1, 1, 1)
    assert report.doors.max_width_error_m == pytest.approx(0, abs=1e-9)
    assert report.free_space.precision == pytest.approx(1)
    assert report.free_space.recall == pytest.approx(1)
    assert report.free_space.outside_m2 == pytest.approx(0, abs=1e-9)
    assert report.yaw_error_deg == pytest.approx(0, abs=1e-9)


def test_glimpsed_rooms_do_not_enter_the_headline_dimensions():
    report = scored()
    assert (report.dimensions.total, report.dimensions_all.total) == (4, 5)


def test_a_wall_moved_by_a_decimetre_changes_exactly_its_dimension():
    plan = replace_region(perfect_plan(), 1, [[0, 2.2], [3.9, 2.2], [3.9, 6], [0, 6]])
    report = scored(plan)
    errors = {m.id: m.error for m in report.measured}
    assert errors["room-1-width"] == pytest.approx(-0.1)
    assert all(e == pytest.approx(0, abs=1e-9) for name, e in errors.items() if name != "room-1-width")
    assert report.dimensions.max_m == pytest.approx(0.1)
    assert report.dimensions.max_percent == pytest.approx(2.5)
    assert report.dimensions.mean_m == pytest.approx(0.025)
    assert report.dimensions.worst == "room-1-width"


def test_merged_rooms_are_one_found_one_missed_and_their_dimension_is_missing():
    plan = perfect_plan()
    merged = shapely.union_all([shapely.box(0, 0, 10, 2), shapely.box(0, 1.9, 4, 6)])
    plan["features"][0] = region(1, list(merged.exterior.coords)[:-1], "corridor")
    del plan["features"][1]
    report = scored(plan)
    assert report.merged == 1
    assert (report.rooms_entered.found, report.rooms_entered.rooms) == (2, 3)
    assert report.rooms_entered.recall == pytest.approx(2 / 3)
    depth = next(m for m in report.measured if m.id == "room-1-depth")
    assert depth.plan is None


def test_a_room_cut_in_two_is_split_and_costs_precision():
    plan = replace_region(perfect_plan(), 1, [[0, 2.2], [2.5, 2.2], [2.5, 6], [0, 6]])
    plan["features"].append(region(9, [[2.5, 2.2], [4, 2.2], [4, 6], [2.5, 6]], "room"))
    report = scored(plan)
    assert report.split == 1
    assert report.rooms_entered.recall == 1
    assert report.rooms_entered.precision == pytest.approx(3 / 4)
    assert report.rooms_entered.recall_75 == pytest.approx(2 / 3)


def test_a_missing_room_is_named_as_the_worst():
    plan = perfect_plan()
    del plan["features"][1]
    report = scored(plan)
    assert (report.rooms.worst, report.rooms.min_iou) == ("1", 0)
    assert report.rooms_entered.mean_iou == pytest.approx(2 / 3)
    assert report.free_space.recall < 0.85


def test_hidden_rooms_are_neither_expected_nor_forbidden():
    document = truth()
    document["rooms"][3]["seen"] = 0.05
    with_it, without = perfect_plan(), perfect_plan()
    del without["features"][3]
    for plan in (with_it, without):
        report = scored(plan, document)
        assert report.rooms_glimpsed is None
        assert (report.rooms.precision, report.rooms.recall) == (1, 1)
        assert report.dimensions_all.total == 4  # not the hidden room's


def test_a_region_outside_the_building_costs_precision_and_area():
    plan = perfect_plan()
    plan["features"].append(region(9, [[14, 0], [16, 0], [16, 3], [14, 3]], "room"))
    report = scored(plan)
    assert report.free_space.outside_m2 == pytest.approx(6)
    assert report.rooms_entered.precision == pytest.approx(3 / 4)
    assert report.free_space.precision < 0.95


def test_a_wrong_label_counts_once():
    plan = perfect_plan()
    plan["features"][1]["properties"]["label"] = "corridor"
    report = scored(plan)
    assert (report.labels_right, report.labels_judged) == (3, 4)


def test_a_missing_and_an_invented_door():
    plan = perfect_plan()
    missing = [f for f in plan["features"] if f["id"] != "door-2"]
    assert scored({**plan, "features": missing}).doors.recall == pytest.approx(2 / 3)
    plan["features"].append(door(9, [[8, 2.1], [9, 2.1]]))
    doors = scored(plan).doors
    assert doors.recall == 1
    assert doors.precision == pytest.approx(3 / 4)


def test_a_shut_door_is_no_error_and_a_window_is():
    plan = perfect_plan()
    plan["features"].append(door(8, [[4.1, 3], [4.1, 4]]))
    assert (scored(plan).doors.precision, scored(plan).doors.optional_found) == (1, 1)
    plan["features"].append(door(9, [[1, 6.1], [3, 6.1]]))
    doors = scored(plan).doors
    assert doors.windows_as_doors == 1
    assert doors.precision == pytest.approx(3 / 4)


def test_door_width_error_and_wall():
    plan = perfect_plan()
    plan["features"][4] = door(1, [[1.05, 2.1], [1.9, 2.1]])
    doors = scored(plan).doors
    assert doors.max_width_error_m == pytest.approx(0.05)
    assert doors.mean_width_error_m == pytest.approx(0.05 / 3)
    plan["features"][4] = door(1, [[1, 2.75], [1.9, 2.75]])  # 0.65 m from the wall: another wall's
    assert scored(plan).doors.found == 2
    plan["features"][4] = door(1, [[1.45, 1.65], [1.45, 2.55]])  # right place, across the wall
    assert scored(plan).doors.found == 2


def test_an_opening_that_cuts_a_room_is_no_false_door():
    plan = perfect_plan()
    plan["features"].append(door(9, [[7, 0], [7, 2]], kind="opening"))
    doors = scored(plan).doors
    assert (doors.precision, doors.openings_unmatched) == (1, 1)


def test_yaw_error_is_modulo_a_quarter_turn():
    plan = perfect_plan()
    plan["floorcast"]["manhattan_from_world"] = frame(YAW + 90.4)
    assert scored(plan).yaw_error_deg == pytest.approx(0.4)
    plan["floorcast"]["manhattan_from_world"] = frame(YAW - 0.3)
    assert scored(plan).yaw_error_deg == pytest.approx(0.3)
    del plan["floorcast"]
    assert scored(plan).yaw_error_deg is None


def test_predicted_area_is_judged():
    plan = perfect_plan()
    right = [[0, 2.2], [2, 2.2], [2, 6], [0, 6]]
    wrong = [[10, 0], [13, 0], [13, 2], [10, 2]]
    plan["features"][0] = region(1, [[0, 0], [13, 0], [13, 2], [0, 2]], "corridor")
    rings = [[[*turned(p), turned(p)[0]]] for p in (right, wrong)]
    plan["features"].append(
        {
            "type": "Feature",
            "id": "speculated",
            "geometry": {"type": "MultiPolygon", "coordinates": rings},
            "properties": {"kind": "speculated"},
        }
    )
    free = scored(plan).free_space
    assert free.predicted_m2 == pytest.approx(2 * 3.8 + 3 * 2)
    assert free.predicted_right == pytest.approx(7.6 / 13.6)
    assert free.predicted_outside_m2 == pytest.approx(2 * (3 - 0.25))


def test_an_empty_plan_scores_nothing_and_does_not_fail():
    report = scored({"type": "FeatureCollection", "features": []})
    assert report.rooms.recall == 0
    assert report.rooms.precision == 0
    assert report.dimensions.mean_m is None
    assert report.free_space.precision is None
    assert "not measured" not in report.summary()
    assert report.rows()


def test_rows_dictionary_and_summary_are_complete(tmp_path):
    (tmp_path / "plan.geojson").write_text(json.dumps(perfect_plan()))
    (tmp_path / "truth.json").write_text(json.dumps(truth()))
    report = evaluate(tmp_path, tmp_path)
    assert json.loads(json.dumps(report.as_dict()))["rooms"]["f1"] == 1
    titles = [row[0] for row in report.rows()]
    for word in ("Dimensions", "Rooms", "Labels", "Doors", "Free space", "Outside", "Yaw"):
        assert any(t.startswith(word) for t in titles), word
    assert "\n" not in report.summary()
    assert "rooms F1 1.00" in report.summary()


def test_truth_without_dimensions_gets_two_for_each_room():
    document = truth()
    del document["dimensions"]
    report = scored(document=document)
    assert report.dimensions_all.total == 8
    assert report.dimensions_all.max_m == pytest.approx(0, abs=1e-9)
    lengths = {m.id: m.truth for m in report.measured}
    assert lengths["0-x"] == pytest.approx(10)
    assert math.isclose(lengths["1-y"], 3.8)

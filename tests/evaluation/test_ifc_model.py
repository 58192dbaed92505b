"""An IFC model written by ifcopenshell is a ground truth, at any yaw and in any unit."""

from __future__ import annotations

import json
import sys

import numpy as np
import pytest

from floorplan_core.cli.main import run
from floorplan_core.errors import InputError
from floorplan_core.evaluation import load_truth
from floorplan_core.evaluation.truth_file import truth_document
from floorplan_core.evaluation.truths import parse_truth
from tests.evaluation.ifc_cases import DOOR, ROOMS, write_house

pytest.importorskip("ifcopenshell", reason="ifcopenshell is optional")


@pytest.mark.parametrize(("yaw", "prefix"), [(0.0, None), (31.0, "MILLI"), (-12.5, None)])
def test_spaces_doors_and_windows_are_those_of_the_model(tmp_path, yaw, prefix):
    truth = load_truth(write_house(tmp_path / "house.ifc", yaw, prefix))
    assert np.degrees(truth.yaw) == pytest.approx(yaw, abs=1e-3)
    assert {r.name: r.kind for r in truth.rooms} == {"A": "room", "B": "corridor"}
    for room in truth.rooms:
        assert room.polygon.bounds == pytest.approx(ROOMS[room.name], abs=1e-5)
        assert room.polygon.area == pytest.approx(3.8 * 2.8, abs=1e-4)
    (door,) = [d for d in truth.doors if d.kind == "door"]
    assert door.across == pytest.approx(DOOR[0], abs=1e-5)
    assert door.width == pytest.approx(DOOR[2], abs=1e-5)  # that of the model, not of the frame
    assert door.joins == (0, 1) and door.required
    assert [d.kind for d in truth.doors].count("window") == 1


@pytest.mark.parametrize(
    ("frozen", "says"), [(False, "ifcopenshell"), (True, "the Python version of Floorcast")]
)
def test_without_the_package_a_sentence_says_how_to_get_it(tmp_path, monkeypatch, frozen, says):
    path = write_house(tmp_path / "house.ifc")
    monkeypatch.setitem(sys.modules, "ifcopenshell", None)
    monkeypatch.setattr(sys, "frozen", frozen, raising=False)
    with pytest.raises(InputError, match=rf"house\.ifc.*{says}.*pip install 'floorcast\[ifc\]'"):
        load_truth(path)


def test_another_storey_can_be_chosen_and_one_too_many_is_said(tmp_path):
    path = write_house(tmp_path / "house.ifc")
    assert [r.name for r in load_truth(path, 1).rooms] == ["C"]
    with pytest.raises(InputError, match=r"2 storeys with spaces \(Ground, Upper\), none of number 2"):
        load_truth(path, 2)


@pytest.mark.parametrize("content", [b"", b"hello", b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=IFCWALL("])
def test_what_is_no_model_gives_one_sentence(tmp_path, content):
    path = tmp_path / "bad.ifc"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        load_truth(path)
    assert "bad.ifc" in str(caught.value) and "\n" not in str(caught.value)


def test_a_model_that_names_what_is_not_there(tmp_path):
    path = write_house(tmp_path / "house.ifc")
    path.write_bytes(path.read_bytes().replace(b".METRE.", b".ME\xff\xff\xff\x7f", 1))
    with pytest.raises(InputError, match=r"is damaged: something that it refers to is missing"):
        load_truth(path)


def test_a_truth_is_written_and_read_back(tmp_path):
    truth = load_truth(write_house(tmp_path / "house.ifc", 31.0))
    again = parse_truth(json.loads(json.dumps(truth_document(truth))), truth.source)
    assert again.rooms == truth.rooms
    assert [(d.bounds, d.kind, d.joins, d.required) for d in again.doors] == [
        (pytest.approx(d.bounds, abs=1e-6), d.kind, d.joins, d.required) for d in truth.doors
    ]
    assert again.world_from_building == pytest.approx(truth.world_from_building)
    assert [d.metres for d in again.dimensions] == pytest.approx(
        [d.metres for d in truth.dimensions], abs=1e-6
    )


def test_evaluate_takes_a_model_and_saves_its_truth(tmp_path, capsys):
    from tests.evaluation.evaluation_cases import perfect_plan

    house = write_house(tmp_path / "house.ifc")
    plan = tmp_path / "plan.geojson"
    plan.write_text(json.dumps(perfect_plan()))
    saved = tmp_path / "truth.json"
    assert run(["evaluate", str(plan), str(house), "--save-truth", str(saved), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["ok"]
    assert load_truth(saved).rooms == load_truth(house).rooms

"""Several storeys of one survey, and several files as one survey, through the real command."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from floorplan_core import intermediates
from floorplan_core.cli import main
from floorplan_core.model import FloorPlan
from tests.cli.small_survey import HEIGHT, write_survey

UP = HEIGHT + 0.3  # m from floor to floor
Z_UP = ("--set", "input.up=z")  # so small a tower is as high as it is wide
RECORD = np.dtype([("xyz", "<f4", 3), ("scan_id", "<i4")])


def _split(path: Path) -> tuple[bytes, np.ndarray]:
    raw = path.read_bytes()
    end = raw.index(b"end_header\n") + len(b"end_header\n")
    return raw[:end], np.frombuffer(raw[end:], dtype=RECORD)


@pytest.fixture(scope="module")
def tower(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The two rooms, and the same two rooms above them, walked later."""
    folder = write_survey(tmp_path_factory.mktemp("tower") / "tower")
    head, low = _split(folder / "points.ply")
    high = low.copy()
    high["xyz"][:, 2] += UP
    high["scan_id"] += 4
    both = np.concatenate([low, high])
    count = head.replace(b"vertex %d" % len(low), b"vertex %d" % len(both))
    (folder / "points.ply").write_bytes(count + both.tobytes())
    rows = np.loadtxt(folder / "trajectory.tum")
    above = rows + np.array([100, 0, 0, UP, 0, 0, 0, 0])
    np.savetxt(folder / "trajectory.tum", np.concatenate([rows, above]), fmt="%.6f")
    return folder


def result(capsys: pytest.CaptureFixture[str], *arguments: object) -> dict:
    assert main.run([*map(str, arguments), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def storey_of(folder: Path) -> int:
    return json.loads((folder / "plan.geojson").read_text())["floorcast"]["storey"]


def floor_of(folder: Path) -> float:
    return json.loads((folder / "plan.geojson").read_text())["floorcast"]["floor_z_m"]


def test_every_storey_has_its_folder_and_the_lowest_lies_above(tower, tmp_path, capsys):
    data = result(capsys, "plan", tower, *Z_UP, "--out", tmp_path / "out", "--no-pictures")
    assert [s["storey"] for s in data["storeys"]] == [0, 1]
    assert [s["regions"] for s in data["storeys"]] == [2, 2]
    assert data["storeys"][0]["points"] == data["points"]
    out = tmp_path / "out"
    assert {p.name for p in out.iterdir() if p.is_dir()} == {"storey-0", "storey-1"}
    assert [storey_of(out), storey_of(out / "storey-0"), storey_of(out / "storey-1")] == [0, 0, 1]
    for name in ("plan.geojson", "plan.svg", "report.json", "plan.floorplan"):
        assert (out / name).read_bytes() == (out / "storey-0" / name).read_bytes()
        assert (out / "storey-1" / name).is_file()
    upper = intermediates.load(out / "storey-1" / "plan.floorplan", FloorPlan)
    assert floor_of(out / "storey-1") == pytest.approx(UP, abs=0.02)
    assert len(upper.trajectory) == 4


def test_one_storey_by_its_number(tower, tmp_path, capsys):
    data = result(capsys, "plan", tower, *Z_UP, "--out", tmp_path / "out", "--no-pictures", "--storey", 1)
    assert [s["storey"] for s in data["storeys"]] == [1]
    assert not any(p.is_dir() for p in (tmp_path / "out").iterdir())
    assert storey_of(tmp_path / "out") == 1


def test_a_storey_that_is_not_there(tower, tmp_path, capsys):
    assert (
        main.run(["plan", str(tower), *Z_UP, "--out", str(tmp_path / "out"), "--storey", "2", "--quiet"]) == 2
    )
    assert "its storeys are 0 to 1" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_stages_of_a_storey_start_again(tower, tmp_path, capsys):
    out, again = tmp_path / "out", tmp_path / "again"
    result(capsys, "plan", tower, *Z_UP, "--out", out, "--no-pictures", "--save-stages")
    assert (out / "stages" / "run.stage").is_file()
    result(capsys, "plan", out / "storey-1", "--from", "doors", "--out", again, "--no-pictures")
    assert storey_of(again) == 1
    assert (again / "plan.geojson").read_text() == (out / "storey-1" / "plan.geojson").read_text()


def test_info_lists_the_storeys(tower, capsys):
    storeys = result(capsys, "info", tower, *Z_UP)["storeys"]
    assert [s["floor_m"] for s in storeys] == pytest.approx([0.0, UP], abs=0.02)
    assert [s["ceiling_m"] for s in storeys] == pytest.approx([HEIGHT, UP + HEIGHT], abs=0.02)


def test_watch_follows_one_storey(tower, tmp_path, capsys):
    out = tmp_path / "run"
    data = result(capsys, "watch", tower, *Z_UP, "--every", "60", "--out", out, "--storey", "1")
    assert data["timeline"][0]["note"] == "Storey 1 was not reached yet."
    assert data["timeline"][-1]["regions"] == 2
    assert json.loads((out / "plan-0003.geojson").read_text())["floorcast"]["storey"] == 1


@pytest.fixture(scope="module")
def parts(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The two rooms in two files."""
    folder = write_survey(tmp_path_factory.mktemp("parts") / "whole")
    head, points = _split(folder / "points.ply")
    for k, half in enumerate((points["scan_id"] < 2, points["scan_id"] >= 2)):
        count = head.replace(b"vertex %d" % len(points), b"vertex %d" % int(half.sum()))
        (folder.parent / f"part{k}.ply").write_bytes(count + points[half].tobytes())
    return folder.parent


@pytest.mark.parametrize("pattern", [False, True], ids=["names", "pattern"])
def test_two_files_are_one_survey(parts, tmp_path, capsys, pattern):
    given = [parts / "part*.ply"] if pattern else [parts / "part0.ply", parts / "part1.ply"]
    path = ("--trajectory", parts / "whole" / "trajectory.tum")
    data = result(capsys, "plan", *given, *path, "--out", tmp_path / "out", "--no-pictures")
    assert (data["regions"], data["doors"]) == (2, 1)
    head = json.loads((tmp_path / "out" / "plan.geojson").read_text())["floorcast"]
    assert head["source"] == "part0.ply and 1 more"


def test_what_several_inputs_cannot_be(parts, tmp_path, capsys):
    (tmp_path / "map.yaml").write_text("image: map.png\nresolution: 0.05\norigin: [0, 0, 0]\n")
    out = ["--out", str(tmp_path / "out")]
    assert main.run(["plan", str(parts / "part0.ply"), str(tmp_path / "map.yaml"), *out]) == 2
    assert "name one input" in capsys.readouterr().err
    assert main.run(["plan", str(parts), str(parts), "--from", "doors", *out]) == 2
    assert "--from takes the folder of one run" in capsys.readouterr().err
    assert main.run(["plan", str(parts / "nothing*.ply"), *out]) == 3
    assert "No file fits the pattern" in capsys.readouterr().err

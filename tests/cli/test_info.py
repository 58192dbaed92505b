"""``floorcast info``: the facts of a survey through the real command."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from floorplan_core.cli.main import run
from tests.cli.small_survey import DEPTH, HEIGHT, WALL, WIDTH, write_survey

SHARED = Path(__file__).resolve().parents[2].parent / "shared" / "data"


def facts(capsys, *arguments: object) -> dict:
    """The JSON line of ``floorcast info``."""
    assert run(["info", *map(str, arguments), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.fixture(scope="module")
def survey(tmp_path_factory) -> Path:
    return write_survey(tmp_path_factory.mktemp("info") / "two rooms")


def test_extent_scans_path_frame_and_storey(survey, capsys):
    found = facts(capsys, survey)
    assert found["kind"] == "survey"
    assert (found["format"], found["unit"], found["up"], found["scans"]) == ("PLY", "m", "z", 4)
    assert found["extent"]["size"] == pytest.approx([2 * WIDTH + WALL, DEPTH, HEIGHT], abs=0.05)
    assert found["trajectory"] == {"poses": 4, "length_m": pytest.approx(WIDTH + WALL), "seconds": 30.0}
    assert found["manhattan"]["support"] > 0.95
    assert abs(found["manhattan"]["yaw_deg"]) < 0.1
    assert found["other_direction"] is None
    (storey,) = found["storeys"]
    assert storey["floor_m"] == pytest.approx(0.0, abs=0.01)
    assert storey["ceiling_m"] == pytest.approx(HEIGHT, abs=0.01)
    assert any("trajectory.tum" in sentence for sentence in found["assumptions"])


def test_the_table_says_the_same(survey, capsys):
    assert run(["info", str(survey)]) == 0
    text = capsys.readouterr().out
    for words in ("PLY survey", "8.2 x 5.0 m", "4 poses", "of wall within 5 degrees", "2.60 m high"):
        assert words in text


def test_a_forced_unit_is_used_and_stated(survey, capsys):
    found = facts(capsys, survey, "--set", "input.unit=cm")
    assert found["unit"] == "cm"
    extent = found["extent"]
    assert extent["high"][0] - extent["low"][0] == pytest.approx((2 * WIDTH + WALL) / 100, abs=0.002)
    assert any("as asked" in sentence for sentence in found["assumptions"])


def test_quick_looks_at_the_first_points_only(survey, capsys, monkeypatch):
    from floorplan_core.cli import info

    assert facts(capsys, survey, "--quick")["whole"]
    monkeypatch.setattr(info, "QUICK_POINTS", 0)
    assert not facts(capsys, survey, "--quick")["whole"]


def test_a_cloud_without_walls_is_described_too(tmp_path, capsys):
    rng = np.random.default_rng(0)
    np.save(tmp_path / "floor.npy", rng.uniform(0, 8, (20_000, 3)) * (1, 1, 0))
    found = facts(capsys, tmp_path / "floor.npy", "--set", "input.unit=m")
    assert found["manhattan"] is None
    assert "No walls" in found["no_manhattan"]


def test_a_wing_at_another_angle_is_reported(tmp_path, capsys):
    survey = write_survey(tmp_path / "straight", spacing=0.06)
    raw = (survey / "points.ply").read_bytes()
    record = np.dtype([("xyz", "<f4", 3), ("scan_id", "<i4")])
    points = np.frombuffer(raw[raw.index(b"end_header\n") + 11 :], dtype=record)["xyz"]
    c = np.cos(np.radians(30))
    wing = points[::2] @ np.array([[c, 0.5, 0], [-0.5, c, 0], [0, 0, 1]]) + [20, 0, 0]
    np.save(tmp_path / "both.npy", np.concatenate([points, wing]).astype("f4"))
    found = facts(capsys, tmp_path / "both.npy", "--set", "input.unit=m", "--set", "input.up=z")
    assert abs(found["other_direction"]["from_frame_deg"]) == pytest.approx(30, abs=0.5)
    assert 0.2 < found["other_direction"]["share"] < 0.5
    assert found["manhattan"]["support"] < 0.8


def test_a_grid_map_is_described(tmp_path, capsys):
    from PIL import Image

    cells = np.full((40, 60), 254, dtype=np.uint8)
    cells[0] = cells[-1] = cells[:, 0] = cells[:, -1] = 0
    Image.fromarray(cells).save(tmp_path / "map.png")
    found = facts(capsys, tmp_path / "map.png", "--resolution", "0.1")
    assert found["kind"] == "grid map"
    assert found["cells"] == [60, 40]
    assert found["free_m2"] == pytest.approx(58 * 38 * 0.01)


def test_what_is_no_survey_is_one_sentence(tmp_path, capsys):
    (tmp_path / "letter.txt").write_text("Dear surveyor")
    assert run(["info", str(tmp_path / "letter.txt")]) == 3
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


@pytest.mark.shared_data
@pytest.mark.skipif(not SHARED.is_dir(), reason=f"the shared surveys are not there ({SHARED})")
def test_a_planar_run_has_no_heights(capsys):
    found = facts(capsys, SHARED / "carmen_seattle" / "points2d.ply")
    assert found["planar"]
    assert found["storeys"] == []
    assert found["extent"]["size"][2] == 0.0
    assert found["manhattan"]["support"] > 0.5

"""Bad files give one sentence; foreign truths are recognised by what they hold."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from floorplan_core.errors import InputError
from floorplan_core.evaluation import evaluate, load_truth, read_plan
from floorplan_core.evaluation.truth import Truth
from floorplan_core.evaluation.truths import parse_truth
from floorplan_core.evaluation.wall_section_truth import doorways
from tests.evaluation.evaluation_cases import perfect_plan, truth

DATA = Path(__file__).resolve().parents[2].parent / "shared" / "data"


def survey(name: str) -> Truth:
    folder = DATA / name
    if not folder.is_dir():
        pytest.skip(f"the survey {name} is not beside this checkout (../shared/data)")
    return load_truth(folder)


def write(path: Path, content) -> Path:
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


@pytest.mark.parametrize(
    ("content", "word"),
    [
        ("{", "not valid JSON"),
        ("[]", "FeatureCollection"),
        ({"type": "FeatureCollection"}, "'features' is missing"),
        ({"type": "FeatureCollection", "features": [1]}, "not a plan of Floorcast"),
        ({"type": "FeatureCollection", "features": [{"properties": {"kind": "region"}, "id": "r"}]}, "'r'"),
        (
            {"type": "FeatureCollection", "features": [], "floorcast": {"manhattan_from_world": [1]}},
            "not a plan",
        ),
    ],
)
def test_a_bad_plan_is_an_input_error_of_one_sentence(tmp_path, content, word):
    with pytest.raises(InputError) as caught:
        read_plan(write(tmp_path / "plan.geojson", content))
    assert word in str(caught.value)
    assert "\n" not in str(caught.value)
    assert caught.value.exit_status == 3


@pytest.mark.parametrize(
    ("change", "word"),
    [
        (lambda d: d.pop("yaw_deg"), "yaw_deg"),
        (lambda d: d["rooms"][0].pop("polygon"), "polygon"),
        (lambda d: d["rooms"][0].update(polygon=[[0, 0], [1, 1]]), "malformed"),
        (lambda d: d["rooms"][0].update(polygon=[[0, 0], [1, 1], [2, 2]]), "area"),
        (lambda d: d["doors"][0].update(bounds=[0, 1]), "malformed"),
        (lambda d: d["doors"][0].update(joins=[77]), "malformed"),
        (lambda d: d.pop("rooms"), "no rooms"),
    ],
)
def test_a_bad_truth_is_an_input_error_of_one_sentence(tmp_path, change, word):
    document = truth()
    change(document)
    with pytest.raises(InputError) as caught:
        load_truth(write(tmp_path / "truth.json", document))
    assert word in str(caught.value)
    assert "\n" not in str(caught.value)


def test_missing_files_and_folders_are_named(tmp_path):
    with pytest.raises(InputError, match=r"plan\.geojson"):
        evaluate(tmp_path, tmp_path)
    write(tmp_path / "plan.geojson", perfect_plan())
    with pytest.raises(InputError, match="holds no ground truth"):
        evaluate(tmp_path, tmp_path)
    np.savez(tmp_path / "free_voxels.npz", something=np.zeros(3))
    with pytest.raises(InputError, match="free voxels"):
        load_truth(tmp_path)


def test_binary_rubbish_is_no_plan_and_no_truth(tmp_path):
    rubbish = tmp_path / "plan.geojson"
    rubbish.write_bytes(bytes(range(256)) * 8)
    with pytest.raises(InputError):
        read_plan(rubbish)
    with pytest.raises(InputError):
        load_truth(rubbish)
    (tmp_path / "free_voxels.npz").write_bytes(b"PK\x03\x04 rubbish")
    with pytest.raises(InputError):
        load_truth(tmp_path / "free_voxels.npz")


def test_wall_sections_become_rooms_and_a_doorway():
    """Two 4 x 3 m rooms with a 0.2 m wall between them, a 0.9 m doorway in it below the upper section."""

    def box(x0, y0, x1, y1):
        return [[[x0, y0], [x1, y0]], [[x1, y0], [x1, y1]], [[x1, y1], [x0, y1]], [[x0, y1], [x0, y0]]]

    rooms = box(0, 0, 4, 3) + box(4.2, 0, 8.2, 3)
    low = [s for s in rooms if s not in ([[4, 0], [4, 3]], [[4.2, 3], [4.2, 0]])]
    low += [[[x, a], [x, b]] for x in (4, 4.2) for a, b in ((0, 1), (1.9, 3))]
    outline = [[0.01, 0.02], [3.98, 0.02], [3.98, 2.97], [0.01, 2.97]]
    other = [[x + 4.2, y] for x, y in outline]
    document = {
        "wall_segments_high": rooms,
        "wall_segments_low": low,
        "rooms": [{"id": 1, "polygon": outline}, {"id": 2, "polygon": other}],
    }
    result = parse_truth(document, "gt_plan.json")
    assert [r.polygon.area for r in result.rooms] == pytest.approx([12, 12])
    (door,) = result.doors
    assert door.bounds == pytest.approx((4, 1, 4.2, 1.9))
    assert (door.required, door.joins, door.axis) == (True, (0, 1), 0)
    high = np.array(rooms, dtype=float)
    assert doorways(high, high, 0) == []


def test_a_doorway_is_as_wide_as_the_opening_between_its_frames():
    faces = np.array([[[x, 0], [x, 3]] for x in (4, 4.2)], dtype=float)
    walls = [[[x, a], [x, b]] for x in (4, 4.2) for a, b in ((0, 1), (1.9, 3))]
    frames = [[[4.05, y], [4.15, y]] for y in (1.035, 1.865)]
    beyond = [[[5, 1.05], [6, 1.05]], [[4.0, 1.4], [4.2, 1.4]]]  # another room's wall, a shut leaf half-way
    (door,) = doorways(faces, np.array(walls + frames + beyond, dtype=float), 0)
    assert door.bounds == pytest.approx((4, 1.035, 4.2, 1.865))


def test_ends_of_a_section_that_nearly_meet_close_a_room():
    """0.2 mm apart, on both sides of where millimetres are rounded."""
    top = [[[10, 8], [4.0006, 8]], [[4.0004, 8], [0, 8]]]
    ring = [[[0, 0], [10, 0]], [[10, 0], [10, 8]], *top, [[0, 8], [0, 0]]]
    outline = [[0.08, 0.08], [9.92, 0.08], [9.92, 7.92], [0.08, 7.92]]
    rooms = [{"id": 1, "polygon": outline}]
    document = {"wall_segments_high": ring, "wall_segments_low": ring, "rooms": rooms}
    (room,) = parse_truth(document, "gt_plan.json").rooms
    assert room.polygon.bounds == pytest.approx((0, 0, 10, 8), abs=0.001)


def test_hospital_truth():
    result = survey("sim_aws_hospital")
    assert len(result.rooms) == 27
    lobby = result.rooms[0]
    assert lobby.kind == "corridor"
    assert lobby.polygon.area == pytest.approx(559, rel=0.01)
    assert len(lobby.polygon.interiors) == 3
    assert [r.name for r in result.rooms if r.exposure == "hidden"] == ["26", "27"]  # closed stair wells
    required = [d for d in result.doors if d.required]
    assert len(required) == 26
    assert all(0.9 < d.width < 1.7 for d in required)
    for i, a in enumerate(result.rooms):
        assert all(a.polygon.intersection(b.polygon).area < 0.01 for b in result.rooms[i + 1 :]), a.name


def test_duplex_truth():
    result = survey("sim_ifc_duplex_L1")
    assert len(result.rooms) == 10
    assert sum(r.polygon.area for r in result.rooms) == pytest.approx(
        2 * (27.66 + 12.954 + 3.161 + 15.593 + 3.802), rel=0.001
    )
    required = [d for d in result.doors if d.required]
    assert [round(d.width, 3) for d in required] == [0.762, 0.762]
    assert sum(d.kind == "window" for d in result.doors) == 4
    assert sum(r.kind == "corridor" for r in result.rooms) == 2


def test_small_house_truth():
    result = survey("sim_aws_small_house")
    assert [r.polygon.area for r in result.rooms] == pytest.approx([56.76, 101.48], abs=0.02)
    assert len(result.dimensions) == 4


def test_octomap_truth():
    result = survey("octomap_fr079_3d")
    observed = result.observed
    assert observed.cell == pytest.approx(0.08)
    assert observed.free.sum() * 0.08**2 > 150
    assert observed.wall.sum() > 1000
    assert not (observed.wall & observed.free).any()
    length, *widths = result.dimensions
    assert length.id == "corridor-length"
    assert length.metres == pytest.approx(34.3, abs=0.1)
    assert np.median([w.metres for w in widths]) == pytest.approx(2.56, abs=0.09)

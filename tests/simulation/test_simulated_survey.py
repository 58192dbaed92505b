"""Surveys with ray casting: small buildings, few rays."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from floorplan_core.cli.main import run
from floorplan_core.errors import Cancelled, OutputError, UsageError
from floorplan_core.observer import CancelToken, Observer
from floorplan_core.simulation import (
    SENSORS,
    STYLES,
    BuildingSpec,
    SimulatedSurvey,
    SurveySpec,
    sensor_preset,
    simulate,
    simulate_survey,
)
from floorplan_core.simulation.poses import rotation
from floorplan_core.simulation.solids import building_solids, glass_solids, triangles
from floorplan_core.simulation.survey import thin

CLEAN = {"noise": 0.0, "dropout": 0.0, "mixed_pixels": 0.0, "glass_return": 0.0}
COARSE = {
    "lidar": {"columns": 90, "rows": 10, "interval": 1.5},
    "camera": {"columns": 24, "rows": 18, "interval": 1.0},
    "station": {"columns": 120, "rows": 40},
    "tilted": {"columns": 120, "rows": 8, "interval": 1.5},
    "planar": {"interval": 1.0},
}


def small(style: str = "straight", kind: str = "lidar", **changes: object) -> SurveySpec:
    of_sensor = {*CLEAN, "tilt"}
    sensor = {**COARSE[kind], **CLEAN, **{k: changes.pop(k) for k in list(changes) if k in of_sensor}}
    spec = SurveySpec(BuildingSpec(style=style, rooms=4), sensor_preset(kind, **sensor), seed=1, thin=0.0)
    return replace(spec, **changes)


@lru_cache(maxsize=4)
def survey_of(spec: SurveySpec) -> SimulatedSurvey:
    return simulate_survey(spec)


def in_building(survey: SimulatedSurvey) -> np.ndarray:
    T = np.linalg.inv(np.array(survey.truth["T_world_building"]))
    return survey.points @ T[:3, :3].T + T[:3, 3]


def distance_to_surfaces(survey: SimulatedSurvey, glass: bool = False) -> np.ndarray:
    import open3d

    solids = building_solids(survey.building)
    if glass:
        solids = np.vstack([solids, glass_solids(survey.building)])
    vertices, faces = triangles(solids)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.core.Tensor(vertices), open3d.core.Tensor(faces))
    points = open3d.core.Tensor(in_building(survey).astype(np.float32))
    return scene.compute_distance(points).numpy()


@pytest.mark.parametrize("kind", SENSORS)
@pytest.mark.parametrize("style", STYLES)
def test_every_sensor_in_every_style_hits_only_surfaces(style: str, kind: str) -> None:
    survey = simulate_survey(small(style, kind, roll_deg=2.0, pitch_deg=-1.0, offset_x=50.0))
    assert len(survey.points) > 1000
    assert distance_to_surfaces(survey).max() < 2e-3
    assert (np.diff(survey.scan_id) >= 0).all()
    assert survey.scan_id.max() < len(survey.trajectory)
    ranges = np.linalg.norm(survey.points - survey.trajectory[survey.scan_id, :3, 3], axis=1)
    sensor = sensor_preset(kind)
    assert ranges.min() > sensor.min_range - 1e-3 and ranges.max() < sensor.max_range + 1e-3


def test_without_errors_the_estimate_is_the_truth() -> None:
    survey = survey_of(small())
    np.testing.assert_allclose(survey.trajectory, survey.trajectory_gt, atol=1e-12)


def test_drift_is_as_large_as_wanted_and_moves_the_points() -> None:
    survey = simulate_survey(small(drift=0.2, drift_yaw_deg=0.5))
    error = survey.trajectory[:, :3, 3] - survey.trajectory_gt[:, :3, 3]
    assert np.hypot(error[:, 0], error[:, 1]).max() == pytest.approx(0.2, abs=1e-6)
    assert np.abs(error[0]).max() < 1e-9
    assert np.hypot(*np.diff(error[:, :2], axis=0).T).max() < 0.1, "drift is slow"
    turn = np.einsum("mji,mjk->mik", survey.trajectory_gt[:, :3, :3], survey.trajectory[:, :3, :3])
    assert np.degrees(np.arccos((np.trace(turn, axis1=1, axis2=2) - 1) / 2).max()) == pytest.approx(
        0.5, abs=0.01
    )
    # seen from the true poses the same rays end on the surfaces again
    back = survey.trajectory_gt @ np.linalg.inv(survey.trajectory)
    T = back[survey.scan_id]
    fixed = np.einsum("nij,nj->ni", T[:, :3, :3], survey.points) + T[:, :3, 3]
    assert distance_to_surfaces(survey).max() > 0.05
    assert distance_to_surfaces(replace(survey, points=fixed)).max() < 2e-3


def test_range_noise_has_its_standard_deviation() -> None:
    clean, noisy = survey_of(small()), simulate_survey(small(noise=0.03))
    origin = noisy.trajectory[noisy.scan_id, :3, 3]
    ranges = np.linalg.norm(noisy.points - origin, axis=1)
    exact = np.linalg.norm(clean.points - clean.trajectory[clean.scan_id, :3, 3], axis=1)
    both = len(ranges) == len(exact)
    residual = ranges - exact if both else distance_to_surfaces(noisy)
    assert 0.6 * 0.03 < np.abs(residual).mean() * np.sqrt(np.pi / 2) < 1.1 * 0.03


def test_dropout_drops_its_share() -> None:
    kept = len(simulate_survey(small(dropout=0.4)).points) / len(survey_of(small()).points)
    assert kept == pytest.approx(0.6, abs=0.02)


def test_mixed_pixels_hang_in_the_air_between_surfaces() -> None:
    off = distance_to_surfaces(simulate_survey(small(mixed_pixels=1.0)))
    assert 0.002 < (off > 0.05).mean() < 0.25


def test_glass_returns_lie_on_window_panes() -> None:
    survey = simulate_survey(small(glass_return=1.0))
    off = distance_to_surfaces(survey)
    assert (off > 0.02).sum() > 20, "no pane was hit"
    assert distance_to_surfaces(survey, glass=True).max() < 2e-3


def test_a_tilted_lidar_sees_more_of_the_ceiling_than_a_level_one() -> None:
    high = {
        tilt: (
            in_building(survey := simulate_survey(small(kind="tilted", tilt=tilt)))[:, 2]
            > survey.building.height - 0.01
        ).mean()
        for tilt in (0.0, 30.0)
    }
    assert high[30.0] > 2 * high[0.0]


def test_a_planar_laser_stays_at_its_height() -> None:
    survey = survey_of(small(kind="planar"))
    assert np.ptp(survey.points[:, 2]) < 1e-6
    assert survey.points[0, 2] == pytest.approx(sensor_preset("planar").height, abs=1e-6)


@pytest.mark.parametrize("yaw", [-30.0, 72.5])
def test_world_is_the_building_turned_by_yaw(yaw: float) -> None:
    survey = simulate_survey(small(yaw_deg=yaw))
    T = np.array(survey.truth["T_world_building"])
    np.testing.assert_allclose(T[:3, :3], rotation(2, np.deg2rad(yaw)), atol=1e-12)
    assert survey.truth["yaw_deg"] == yaw


def test_the_truth_holds_what_is_documented() -> None:
    survey = survey_of(small())
    truth = json.loads(json.dumps(survey.truth))
    assert {"yaw_deg", "height", "wall", "rooms", "doors", "dimensions"} <= set(truth)
    assert {room["kind"] for room in truth["rooms"]} == {"room", "corridor"}
    assert all(isinstance(room["entered"], bool) and 0 <= room["seen"] <= 1 for room in truth["rooms"])
    assert all(room["seen"] > 0.3 for room in truth["rooms"] if room["entered"])
    assert all(len(d["bounds"]) == 4 and len(d["joins"]) == 2 for d in truth["doors"])
    for dimension in truth["dimensions"]:
        assert np.hypot(*np.subtract(dimension["from"], dimension["to"])) == pytest.approx(
            dimension["metres"]
        )


def test_what_no_ray_reached_was_not_seen() -> None:
    building = BuildingSpec(rooms=4, shut_doors=1.0, halls=0, windows=0)
    truth = simulate_survey(replace(small(), building=building)).truth
    assert [room["seen"] > 0 for room in truth["rooms"]] == [True] + [False] * (len(truth["rooms"]) - 1)


def test_a_ring_corridor_is_one_polygon_with_a_hole() -> None:
    truth = simulate_survey(small("ring")).truth
    assert len(truth["rooms"][0]["holes"]) >= 1


def test_files_are_byte_identical_for_the_same_seed(tmp_path: Path) -> None:
    spec = small(noise=0.02, dropout=0.1, mixed_pixels=0.3, drift=0.05, thin=0.03)
    first, second = simulate(spec, tmp_path / "a"), simulate(spec, tmp_path / "b")
    other = simulate(replace(spec, seed=2), tmp_path / "c")
    for name in ("points", "trajectory", "trajectory_gt", "truth"):
        assert getattr(first, name).read_bytes() == getattr(second, name).read_bytes()
    assert first.points.read_bytes() != other.points.read_bytes()
    assert sorted(p.name for p in (tmp_path / "a").iterdir()) == sorted(
        ["points.ply", "trajectory.tum", "trajectory_gt.tum", "truth.json"]
    )


def test_another_sensor_does_not_change_the_building() -> None:
    first, second = simulate_survey(small(kind="camera")), survey_of(small())
    assert repr(first.building) == repr(second.building)


def test_far_coordinates_keep_millimetres(tmp_path: Path) -> None:
    import open3d

    spec = small(offset_x=4_500_000.0, offset_y=500_000.0)
    paths = simulate(spec, tmp_path)
    assert b"property double x" in paths.points.read_bytes()[:200]
    cloud = open3d.t.io.read_point_cloud(str(paths.points))
    survey = simulate_survey(spec)
    np.testing.assert_allclose(cloud.point.positions.numpy(), survey.points, atol=1e-4)
    assert (cloud.point.scan_id.numpy().ravel() == survey.scan_id).all()
    assert distance_to_surfaces(survey).max() < 2e-3


def test_trajectory_files_hold_the_poses(tmp_path: Path) -> None:
    paths = simulate(small(drift=0.1), tmp_path)
    rows = np.loadtxt(paths.trajectory)
    survey = simulate_survey(small(drift=0.1))
    np.testing.assert_allclose(rows[:, 1:4], survey.trajectory[:, :3, 3], atol=1e-8)
    np.testing.assert_allclose(np.linalg.norm(rows[:, 4:], axis=1), 1, atol=1e-8)
    assert (np.diff(rows[:, 0]) > 0).all()
    assert paths.trajectory.read_bytes() != paths.trajectory_gt.read_bytes()


def test_the_number_of_points_is_bounded() -> None:
    survey = simulate_survey(small(max_points=2000))
    assert len(survey.points) == 2000 and (np.diff(survey.scan_id) >= 0).all()


def test_thinning_keeps_one_point_a_voxel_and_window() -> None:
    rng = np.random.default_rng(0)
    points, window = rng.uniform(0, 1, (5000, 3)), rng.integers(0, 3, 5000).astype(np.int32)
    kept = thin(points, window, 0.2)
    cells = np.column_stack([np.floor(points / 0.2).astype(int), window])
    assert len(kept) == len(np.unique(cells, axis=0)) == len(np.unique(cells[kept], axis=0))
    assert len(thin(points, window, 0.0)) == 5000


def test_a_stop_is_heeded() -> None:
    token = CancelToken()
    token.cancel()
    with pytest.raises(Cancelled):
        simulate_survey(small(), Observer(token))


def test_a_file_in_the_way_is_one_sentence(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(OutputError, match="Cannot write"):
        simulate(small(), tmp_path / "out")


def test_command_writes_a_survey(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    coarse = ["--sensor-set", "columns=60", "--sensor-set", "rows=8", "--sensor-set", "interval=2"]
    status = run(["simulate", "--out", str(tmp_path), "--seed", "4", "--rooms", "3", "--json", *coarse])
    said = json.loads(capsys.readouterr().out)
    assert status == 0 and said["ok"]
    assert all(Path(name).is_file() for name in said["files"].values())
    assert json.loads((tmp_path / "truth.json").read_text())["spec"]["sensor"]["columns"] == 60


@pytest.mark.parametrize(
    "words",
    [
        ["--style", "star"],
        ["--sensor", "sonar"],
        ["--explore", "3"],
        ["--sensor-set", "rows=many"],
        ["--building-set", "towers=2"],
        ["--sensor-set", "rows"],
    ],
)
def test_command_refuses_wrong_values(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["simulate", "--out", str(tmp_path / "out"), *words]) == 2
    assert capsys.readouterr().err.startswith("floorcast: ")
    assert not (tmp_path / "out").exists()


def test_without_open3d_one_sentence_says_so(monkeypatch):
    from floorplan_core.open3d_import import load_open3d

    monkeypatch.setitem(sys.modules, "open3d", None)
    with pytest.raises(UsageError, match="needs Open3D, which is not installed"):
        load_open3d()

"""Unit, up axis and shift: right on rooms and shared surveys, turned and scaled; forced by settings."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from floorplan_core.config import Config, InputConfig
from floorplan_core.errors import InputError
from floorplan_core.model import Trajectory
from floorplan_core.readers import open_survey
from floorplan_core.readers.axes import PRIOR, guess_axes
from floorplan_core.readers.layers import find_layers
from floorplan_core.readers.ply import ply_source
from floorplan_core.readers.trajectory import read_trajectory
from floorplan_core.readers.trajectory_files import find_trajectory
from floorplan_core.units import METRES_PER_UNIT, UP_AXES, up_rotation
from tests.readers.reader_clouds import all_points, path_in_room, room, write_ply, write_tum, xyz_columns

SHARED = Path(__file__).resolve().parents[2].parent / "shared" / "data"
SURVEYS_3D = (
    "carmen_aces/points3d_extruded.ply",
    "carmen_intel/points3d_extruded.ply",
    "carmen_seattle/points3d_extruded.ply",
    "octomap_fr079_3d/points.ply",
    "sim_aws_hospital/points.ply",
    "sim_aws_small_house/points.ply",
    "sim_ifc_duplex_L1/points.ply",
)


def turned(points, trajectory, up, unit, yaw=0.0):
    """The survey as another program would export it."""
    c, s = np.cos(yaw), np.sin(yaw)
    R = up_rotation(up).T @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    size = 1 / METRES_PER_UNIT[unit]
    moved = points @ R.T * size
    if trajectory is None:
        return moved, None
    poses = trajectory.T_world_sensor.copy()
    poses[:, :3, :3] = R @ poses[:, :3, :3]
    poses[:, :3, 3] = trajectory.origins @ R.T * size
    return moved, Trajectory(trajectory.stamps, poses)


@pytest.mark.parametrize("up", UP_AXES)
def test_up_rotations_are_proper_and_lift_their_axis(up):
    R = up_rotation(up)
    np.testing.assert_allclose(R @ R.T, np.eye(3))
    assert np.linalg.det(R) == pytest.approx(1)
    axis = np.zeros(3)
    axis["xyz".index(up[-1])] = -1 if up[0] == "-" else 1
    np.testing.assert_allclose(R @ axis, [0, 0, 1])


@pytest.mark.parametrize("unit", PRIOR)
@pytest.mark.parametrize("up", ["x", "y", "z"])
@pytest.mark.parametrize("size", [(8, 5, 2.6), (30, 14, 3.2), (4.2, 3.4, 2.4), (60, 2.8, 2.7)])
def test_rooms(size, up, unit):
    cloud = room(np.random.default_rng(11), size, density=60)
    moved, _ = turned(cloud, None, up, unit, yaw=0.3)
    guess = guess_axes(moved, None, "auto", "auto")
    assert (guess.up, guess.unit) == (up, unit)


@pytest.mark.parametrize("unit", PRIOR)
@pytest.mark.parametrize("up", UP_AXES)
def test_a_sensor_that_turns_tells_every_axis(tmp_path, up, unit):
    trajectory = read_trajectory(write_tum(tmp_path / "t.tum", path_in_room()))
    moved, path = turned(room(np.random.default_rng(12)), trajectory, up, unit)
    guess = guess_axes(moved, path, "auto", "auto")
    assert (guess.up, guess.unit) == (up, unit)


@pytest.mark.parametrize("name", SURVEYS_3D)
def test_shared_surveys_turned_and_scaled(name):
    path = SHARED / name
    if not path.exists():
        pytest.skip("the surveys of ../shared/data are not beside this checkout")
    points = ply_source(path).sample().points.astype(np.float64)
    beside = find_trajectory(path)
    trajectory = read_trajectory(beside) if beside else None
    for given in (trajectory, None):
        for up in ("x", "y", "z"):
            for unit in PRIOR:
                guess = guess_axes(*turned(points, given, up, unit), "auto", "auto")
                assert (guess.up, guess.unit) == (up, unit)


def test_outliers_do_not_count(tmp_path):
    cloud = room(np.random.default_rng(13))
    cloud[:20] = 1e30
    cloud[20:40] = -1e12
    cloud[40:60] = np.nan
    path = write_ply(tmp_path / "a.ply", "binary_little_endian", xyz_columns(cloud))
    survey = open_survey(path)
    assert (survey.local_frame.up, survey.local_frame.unit) == ("z", "m")
    assert not survey.local_frame.shift.any()
    assert len(all_points(survey)[0]) == len(cloud) - 60


def test_settings_force_what_would_be_guessed(tmp_path):
    cloud = room(np.random.default_rng(14))
    path = write_ply(tmp_path / "a.ply", "binary_little_endian", xyz_columns(cloud))
    survey = open_survey(path, config=InputConfig(unit="ft", up="-y"))
    frame = survey.local_frame
    assert (frame.unit, frame.up, frame.scale) == ("ft", "-y", 0.3048)
    points, _ = all_points(survey)
    np.testing.assert_allclose(points, frame.to_local(cloud), atol=1e-5)
    assert any("as asked" in text for text in survey.assumptions)


@pytest.mark.parametrize("up", UP_AXES)
@pytest.mark.parametrize("shift", [(0, 0, 0), (4.5e6, 5.1e6, 0), (-2e5, 3e3, 900.0), (500.0, -20.0, 3.0)])
def test_local_and_world_agree(tmp_path, up, shift):
    cloud = (room(np.random.default_rng(15), density=20) + shift) @ up_rotation(up)
    path = write_ply(tmp_path / "a.ply", "binary_little_endian", xyz_columns(cloud, "f8"))
    survey = open_survey(path, config=InputConfig(up=up, unit="m"))
    points, _ = all_points(survey)
    np.testing.assert_allclose(points, survey.local_frame.to_local(cloud), atol=1e-3)
    np.testing.assert_array_equal(survey.local_frame.shift, np.round(survey.local_frame.shift))
    assert np.abs(points).max() < 1100


def test_precision_that_the_file_has_lost_is_said(tmp_path):
    cloud = room(np.random.default_rng(16)) + np.array([4.5e6, 5.1e6, 0])
    path = write_ply(tmp_path / "a.ply", "binary_little_endian", xyz_columns(cloud, "f4"))
    assert any("resolves only 0.5 m" in text for text in open_survey(path).assumptions)


@pytest.mark.parametrize("up", ["y", "z"])
def test_slabs_of_closed_solids_have_two_faces(up):
    """The outer ones are not beyond floor and ceiling: they are of them."""
    rng = np.random.default_rng(4)
    low, high, t = np.zeros(3), np.array([8.1, 5.0, 2.6]), 0.2
    slabs = [((-t, -t, z), (8.3, 5.2, z + t)) for z in (-t, 2.6)]
    sides = [((-t, -t, 0), (0, 5.2, 2.6)), ((8.1, -t, 0), (8.3, 5.2, 2.6))]
    sides += [((0, -t, 0), (8.1, 0, 2.6)), ((0, 5.0, 0), (8.1, 5.2, 2.6)), ((4.0, 0, 0), (4.1, 5.0, 2.6))]
    points = np.concatenate([on_box(np.array(a), np.array(b), rng) for a, b in slabs + sides])
    assert ((points.min(axis=0) < low) & (points.max(axis=0) > high)).all()
    guess = guess_axes(points @ up_rotation(up), None, "auto", "auto")
    assert (guess.up, guess.unit) == (up, "m")


def on_box(low, high, rng):
    """(N, 3) points spread evenly over the surface of a box, 100 a square metre."""
    size = high - low
    faces = []
    for axis in range(3):
        area = np.prod(np.delete(size, axis))
        for side in (low, high):
            face = rng.uniform(low, high, (int(100 * area), 3))
            face[:, axis] = side[axis]
            faces.append(face)
    return np.concatenate(faces)


def test_layers_of_two_storeys():
    rng = np.random.default_rng(17)
    heights = np.repeat([0.0, 2.6, 2.9, 5.5], 4000) + rng.normal(0, 0.01, 16000)
    layers = find_layers(np.concatenate([heights, rng.uniform(0, 5.5, 4000)]))
    assert layers.positions[0] == pytest.approx(0, abs=0.05)
    assert layers.positions[-1] == pytest.approx(5.5, abs=0.05)


@pytest.mark.parametrize(
    "points", [np.zeros((1, 3)), np.ones((50, 3)), np.linspace(0, 1, 300).reshape(100, 3) * [1, 1, 0]]
)
def test_degenerate_clouds_get_some_answer(points):
    guess = guess_axes(points, None, "auto", "auto")
    assert guess.up in UP_AXES
    assert guess.unit in METRES_PER_UNIT


def _survey_with_matrices(folder: Path, mirror: bool, mixed: bool = False) -> Path:
    """A cloud beside a trajectory of 3 x 4 matrices, as a left-handed engine writes them where ``mirror``."""
    rng = np.random.default_rng(5)
    points = rng.uniform(0, 1, (4000, 3)) * (9, 6, 2.6)
    points[:2000, 2] = np.where(rng.uniform(0, 1, 2000) < 0.5, 0.0, 2.6)
    poses = np.tile(np.eye(4), (12, 1, 1))
    poses[:, :3, 3] = np.column_stack([np.linspace(1, 8, 12), np.full(12, 3.0), np.full(12, 1.2)])
    flip = np.diag([1.0, -1.0, 1.0, 1.0]) if mirror else np.eye(4)
    poses = flip @ poses
    if mixed:
        poses[7, :3, 1] *= -1
    text = "\n".join(" ".join(f"{v:.6f}" for v in p) for p in points @ flip[:3, :3])
    (folder / "points.txt").write_text("x y z\n" + text + "\n")
    rows = "\n".join(" ".join(f"{v:.9f}" for v in pose[:3].ravel()) for pose in poses)
    (folder / "trajectory.txt").write_text(rows + "\n")
    return folder / "points.txt"


@pytest.mark.parametrize("mirror", [False, True])
def test_poses_that_reflect_the_sensor_say_that_a_file_is_left_handed(tmp_path, mirror):
    survey = open_survey(_survey_with_matrices(tmp_path, mirror))
    assert (np.linalg.det(survey.local_frame.rotation) < 0) == mirror
    assert any("left-handed" in s and "input.mirrored=no" in s for s in survey.assumptions) == mirror
    assert np.linalg.det(survey.trajectory.T_world_sensor[:, :3, :3]) == pytest.approx(np.ones(12))
    y = np.concatenate([c.points for c in survey.chunks()])[:, 1]
    assert y.min() > -0.01 and y.max() < 6.01  # the building, in front of its mirror


def test_what_the_user_says_of_the_hand_goes_before(tmp_path):
    cloud = _survey_with_matrices(tmp_path, True)
    survey = open_survey(cloud, config=Config().with_values({"input.mirrored": "no"}).input)
    assert np.linalg.det(survey.local_frame.rotation) > 0
    assert any("right-handed, as asked" in s for s in survey.assumptions)


def test_poses_that_disagree_on_the_hand_are_damaged(tmp_path):
    with pytest.raises(InputError, match="Line 8 of the trajectory"):
        open_survey(_survey_with_matrices(tmp_path, True, mixed=True))


@pytest.mark.parametrize(
    ("said", "meant"), [("yes", "yes"), ("true", "yes"), ("false", "no"), ("auto", "auto")]
)
def test_yes_and_true_are_the_same_word(said, meant):
    assert Config().with_values({"input.mirrored": said}).input.mirrored == meant


@pytest.mark.parametrize("yaw", [0.0, 2.0, 35.0, 90.0])
def test_a_single_wall_stands(yaw):
    """Flat and low across itself as a floor is: only what is usual can tell."""
    rng = np.random.default_rng(1)
    wall = np.column_stack(
        [rng.uniform(0, 7, 40_000), rng.normal(0, 0.01, 40_000), rng.uniform(0, 2.6, 40_000)]
    )
    c, s = np.cos(np.radians(yaw)), np.sin(np.radians(yaw))
    guess = guess_axes(wall @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), None, "auto", "auto")
    assert (guess.up, guess.unit) == ("z", "m")


def test_a_planar_scan_of_a_level_path_lies():
    """y up, as cameras and graphics programs have it: the path tells, where the points cannot."""
    angle = np.linspace(0, 2 * np.pi, 5000)
    scan = np.column_stack([4 * np.cos(angle), np.zeros(5000), 3 * np.sin(angle)])
    poses = np.tile(np.eye(4), (50, 1, 1))
    poses[:, 0, 3] = np.linspace(-2, 2, 50)
    poses[:, 2, 3] = 1.5 * np.sin(np.linspace(0, 6, 50))
    assert guess_axes(scan, Trajectory(np.arange(50.0), poses), "m", "auto").up in ("y", "-y")

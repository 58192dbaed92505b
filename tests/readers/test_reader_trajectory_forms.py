"""KITTI and EuRoC trajectories: the poses of the TUM file of the same run; wrong lines are named."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.readers import open_survey
from floorplan_core.readers.join_time import nearest_rows
from floorplan_core.readers.trajectory import looks_like_trajectory, read_trajectory
from tests.readers.reader_clouds import all_points, path_in_room, room, write_ply, write_tum, xyz_columns

START = 1_403_636_579.5  # seconds: a run of EuRoC


def write_kitti(path, trajectory, columns=12):
    rows = trajectory.T_world_sensor.reshape(-1, 16)[:, :columns]
    path.write_text("\n".join(" ".join(f"{v:.9e}" for v in row) for row in rows) + "\n")
    return path


def write_euroc(path, rows, columns=17):
    names = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []"
    lines = []
    for t, x, y, z, qx, qy, qz, qw in rows:
        values = [x, y, z, qw, qx, qy, qz] + [0.0] * (columns - 8)
        lines.append(",".join([str(round((t + START) * 1e9)), *(f"{v:.12g}" for v in values)]))
    path.write_text(names + "\r\n" + "\r\n".join(lines) + "\r\n")
    return path


@pytest.fixture
def run(tmp_path):
    return read_trajectory(write_tum(tmp_path / "run.tum", path_in_room()))


@pytest.mark.parametrize("columns", [12, 16])
def test_kitti(tmp_path, run, columns):
    path = write_kitti(tmp_path / "poses.txt", run, columns)
    assert looks_like_trajectory(path)
    found = read_trajectory(path)
    np.testing.assert_allclose(found.T_world_sensor, run.T_world_sensor, atol=1e-8)
    np.testing.assert_array_equal(found.stamps, np.arange(len(run)))


@pytest.mark.parametrize("columns", [8, 17])
def test_euroc(tmp_path, run, columns):
    path = write_euroc(tmp_path / "data.csv", path_in_room(), columns)
    assert looks_like_trajectory(path)
    found = read_trajectory(path)
    np.testing.assert_allclose(found.T_world_sensor, run.T_world_sensor, atol=1e-7)
    np.testing.assert_allclose(found.stamps, run.stamps + START, atol=1e-6)


def test_rounded_rotations_become_rotations(tmp_path, run):
    path = tmp_path / "poses.txt"
    rows = run.T_world_sensor.reshape(-1, 16)[:, :12]
    path.write_text("\n".join(" ".join(f"{v:.2f}" for v in row) for row in rows))
    R = read_trajectory(path).T_world_sensor[:, :3, :3]
    np.testing.assert_allclose(R @ np.swapaxes(R, 1, 2), np.tile(np.eye(3), (len(R), 1, 1)), atol=1e-12)


GOOD = "1 0 0 0 0 1 0 0 0 0 1 0\n"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (GOOD + "1 0 0 0 0 1 0 0 0 0 2 0\n", "Line 2 .* no rotation"),
        (GOOD + "1 0 0 0 0 1 0 0 0 0 -1 0\n", "Line 2 .* no rotation"),
        (GOOD + "1 0 0 nan 0 1 0 0 0 0 1 0\n", "Line 2 .* no rotation"),
        (GOOD + "\n1 0 0 0 0 1 0 0 0 0 1\n", "Line 3 .* 11 columns, those before 12"),
        (GOOD + "what is this\n", "Line 2 .* not a row of numbers"),
        ("1403636579000000000,0,0,0,1,0,0,0\n1403636580000000000,0,0,0,0,0,0,0\n", "Line 2 .* no pose"),
        ("1403636579000000000,0,0,0,1,0,0,0\n1403636580000000000,0,inf,0,1,0,0,0\n", "Line 2 .* no pose"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(tmp_path, text, says):
    path = tmp_path / "bad.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=says):
        read_trajectory(path)


def test_clouds_of_twelve_columns_are_clouds(tmp_path):
    rows = np.random.default_rng(3).uniform(0, 9, (50, 12))
    path = tmp_path / "cloud.xyz"
    np.savetxt(path, rows)
    assert not looks_like_trajectory(path)


def test_points_with_times_find_their_rows(tmp_path):
    cloud = room(np.random.default_rng(8), density=15)
    rows = path_in_room()
    truth = np.sort(np.arange(len(cloud)) % 40)
    stamps = rows[truth, 0] + START + np.random.default_rng(9).uniform(-0.2, 0.2, len(cloud))
    path = write_ply(tmp_path / "points.ply", "binary_little_endian", xyz_columns(cloud, timestamp=stamps))
    file = write_euroc(tmp_path / "trajectory.csv", rows)
    survey = open_survey(path, config=InputConfig(unit="m", up="z"))
    assert survey.trajectory is not None, file
    np.testing.assert_array_equal(all_points(survey)[1], truth)


def test_nearest_rows():
    rows = np.array([0.0, 1.0, 1.0, 4.0])
    stamps = np.array([-0.4, -0.6, 0.5, 0.51, 1.2, 3.6, 4.5, 4.6, np.nan])
    found = nearest_rows(stamps, rows, 0.5)
    np.testing.assert_array_equal(found, [0, -1, 0, 1, 2, 3, 3, -1, -1])
    np.testing.assert_array_equal(nearest_rows(np.array([5.0, 9.0]), np.array([5.2]), 0.5), [0, -1])

"""Trajectories: parsing, finding them, and telling when they belong to something else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.readers import open_survey
from floorplan_core.readers.trajectory import read_trajectory
from tests.readers.reader_clouds import (
    Remembering,
    all_points,
    path_in_room,
    room,
    write_ply,
    write_tum,
    xyz_columns,
)

AS_IT_IS = InputConfig(unit="m", up="z")


@pytest.fixture
def survey_files(tmp_path):
    cloud = room(np.random.default_rng(8), density=15)
    ids = np.sort(np.arange(len(cloud)) % 40).astype("i4")
    path = write_ply(tmp_path / "points.ply", "binary_little_endian", xyz_columns(cloud, scan_id=ids))
    return path, write_tum(tmp_path / "trajectory.tum", path_in_room())


def test_poses(tmp_path):
    path = tmp_path / "t.tum"
    path.write_text("# a comment\n0 1 2 3 0 0 0 2\n\n1.5, 4, 5, 6, 0, 0, 1, 1  # commas\n")
    trajectory = read_trajectory(path)
    np.testing.assert_allclose(trajectory.stamps, [0, 1.5])
    np.testing.assert_allclose(trajectory.origins, [[1, 2, 3], [4, 5, 6]])
    np.testing.assert_allclose(trajectory.T_world_sensor[0, :3, :3], np.eye(3))
    turned = trajectory.T_world_sensor[1, :3, :3]  # a quarter turn about z
    np.testing.assert_allclose(turned, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-12)


def test_rotations_agree_with_scipy(tmp_path):
    from scipy.spatial.transform import Rotation

    q = np.random.default_rng(9).normal(size=(50, 4))
    path = write_tum(tmp_path / "t.tum", np.column_stack([np.zeros((50, 4)), q]))
    found = read_trajectory(path).T_world_sensor[:, :3, :3]
    np.testing.assert_allclose(found, Rotation.from_quat(q).as_matrix(), atol=1e-6)


def test_a_header_line(tmp_path):
    path = tmp_path / "t.txt"
    path.write_text("timestamp,tx,ty,tz,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n")
    assert len(read_trajectory(path)) == 1


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "no poses"),
        ("# only a comment\n", "no poses"),
        ("0 0 0 0 0 0 0 1\n1 0 0 nan 0 0 0 1\n", "Line 2 .* not a finite number"),
        ("0 0 0 inf 0 0 0 1\n", "Line 1 .* not a finite number"),
        ("0 0 0 0 0 0 0 1\n\n1 0 0 0 0 0 0\n", "Line 3 .* has 7 columns"),
        ("0 0 0 0 0 0 0 0\n", "Line 1 .* length zero"),
        ("0 0 0 0 0 0 0 1\n1 a b c 0 0 0 1\n", "Line 2 .* not a row of numbers"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(tmp_path, text, says):
    path = tmp_path / "bad.tum"
    path.write_text(text)
    with pytest.raises(InputError, match=says):
        read_trajectory(path)


def test_not_even_text(tmp_path):
    path = tmp_path / "bad.tum"
    path.write_bytes(b"\xff\xfe\x00\x80" * 10)
    with pytest.raises(InputError, match="not text"):
        read_trajectory(path)


def test_stamps_that_go_back_are_reported(tmp_path):
    path = tmp_path / "t.tum"
    path.write_text("0 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n3 3 0 0 0 0 0 1\n")
    seen = Remembering()
    trajectory = read_trajectory(path, seen)
    assert "go back 1 times, first after row 1" in seen.warnings[0]
    np.testing.assert_allclose(trajectory.origins[:, 0], [0, 1, 2, 3])
    assert np.all(np.diff(trajectory.stamps) >= 0)


@pytest.mark.parametrize(
    ("cloud", "files", "found"),
    [
        ("points.ply", ["trajectory.tum"], "trajectory.tum"),
        ("points3d_extruded.ply", ["trajectory.tum", "trajectory3d.tum"], "trajectory3d.tum"),
        ("points2d.ply", ["trajectory.tum", "trajectory3d.tum"], "trajectory.tum"),
        ("flat.ply", ["trajectory.tum", "flat.tum"], "flat.tum"),
        ("flat.ply", ["flat.txt"], "flat.txt"),
        ("flat.ply", ["trajectory.txt"], "trajectory.txt"),
        ("flat.ply", ["other.tum"], None),
    ],
)
def test_finding_it(tmp_path, cloud, files, found):
    points = room(np.random.default_rng(8), density=5)
    path = write_ply(tmp_path / cloud, "binary_little_endian", xyz_columns(points))
    for name in files:
        write_tum(tmp_path / name, path_in_room())
    survey = open_survey(path)
    assert (survey.trajectory is not None) == (found is not None)
    if found:
        assert f"The trajectory is {found}, found beside {cloud}." in survey.assumptions


def test_text_that_is_no_trajectory_is_left_alone(tmp_path):
    points = room(np.random.default_rng(8), density=5)
    path = write_ply(tmp_path / "flat.ply", "binary_little_endian", xyz_columns(points))
    (tmp_path / "flat.txt").write_text("measured on a rainy day\n")
    assert open_survey(path).trajectory is None


def test_too_few_rows(survey_files, tmp_path):
    short = write_tum(tmp_path / "short.tum", path_in_room(25))
    with pytest.raises(InputError, match="refer to scan 39, the trajectory has only 25 rows"):
        open_survey(survey_files[0], short)


def test_far_away(survey_files, tmp_path):
    rows = path_in_room()
    rows[:, 1] += 300
    with pytest.raises(InputError, match=r"not of the survey points\.ply: 100% of its positions"):
        open_survey(survey_files[0], write_tum(tmp_path / "other.tum", rows))


def test_within_the_bounds_but_not_near_its_points(tmp_path):
    rng = np.random.default_rng(10)
    hall = rng.uniform(0, 1, (4000, 3)) * (400.0, 300.0, 6.0)
    path = write_ply(
        tmp_path / "points.ply",
        "binary_little_endian",
        xyz_columns(hall, scan_id=np.arange(4000, dtype="i4")),
    )
    places = rng.uniform(0, 1, (4000, 3)) * (400.0, 300.0, 0.1) + (0, 0, 1)
    rows = np.column_stack([np.arange(4000.0), places, np.tile([0, 0, 0, 1.0], (4000, 1))])
    with pytest.raises(InputError, match="half of the points are more than"):
        open_survey(path, write_tum(tmp_path / "other.tum", rows))


def test_of_another_building_within_the_same_bounds(tmp_path):
    """A row of small rooms, each seen from within; the other path visits them the other way round."""
    rng = np.random.default_rng(21)
    rooms = [room(rng, (4.0, 5.0, 2.6), density=40) + np.array([4.2 * k, 0, 0]) for k in range(12)]
    ids = np.repeat(np.arange(12), [len(r) for r in rooms]).astype("i4")
    path = write_ply(
        tmp_path / "points.ply", "binary_little_endian", xyz_columns(np.concatenate(rooms), scan_id=ids)
    )
    rows = np.zeros((12, 8))
    rows[:, 0], rows[:, 1], rows[:, 2:4], rows[:, 7] = np.arange(12), 4.2 * np.arange(12) + 2, (2.5, 1.2), 1
    assert open_survey(path, write_tum(tmp_path / "right.tum", rows)).trajectory is not None
    rows[:, 1:4] = rows[::-1, 1:4]
    with pytest.raises(InputError, match="of the points lie behind walls"):
        open_survey(path, write_tum(tmp_path / "wrong.tum", rows))


def test_of_another_shared_survey():
    shared = Path(__file__).resolve().parents[2].parent / "shared" / "data"
    if not shared.exists():
        pytest.skip("the surveys of ../shared/data are not beside this checkout")
    clouds = ("carmen_seattle/points3d_extruded.ply", "sim_aws_small_house/points.ply")
    for cloud in clouds:
        for other in ("carmen_intel", "sim_aws_hospital"):
            with pytest.raises(InputError, match="not of the survey"):
                open_survey(shared / cloud, shared / other / "trajectory.tum")


def test_a_path_that_nobody_asked_for_is_left_out_where_it_does_not_fit(tmp_path):
    path = write_ply(
        tmp_path / "a.ply", "binary_little_endian", xyz_columns(room(np.random.default_rng(8), density=15))
    )
    rows = path_in_room()
    rows[:, 1] += 300
    write_tum(tmp_path / "trajectory.tum", rows)
    seen = Remembering()
    assert open_survey(path, observer=seen).trajectory is None
    assert "It was left out." in seen.warnings[0]
    with pytest.raises(InputError):
        open_survey(path, tmp_path / "trajectory.tum")


def test_negative_scan_ids(tmp_path):
    points = room(np.random.default_rng(8), density=5)
    ids = np.full(len(points), -3, dtype="i4")
    path = write_ply(tmp_path / "points.ply", "binary_little_endian", xyz_columns(points, scan_id=ids))
    write_tum(tmp_path / "trajectory.tum", path_in_room())
    with pytest.raises(InputError, match="refers to scan -3"):
        open_survey(path)


def test_order_of_the_scans(survey_files, tmp_path):
    assert open_survey(survey_files[0]).scans_ordered
    points = room(np.random.default_rng(8), density=15)
    ids = (np.arange(len(points)) % 40).astype("i4")
    path = write_ply(tmp_path / "points.ply", "ascii", xyz_columns(points, scan_id=ids))
    assert not open_survey(path).scans_ordered


def test_the_trajectory_moves_with_the_points(tmp_path):
    shift = np.array([4_500_000.0, 5_100_000.0, 0.0])
    cloud = room(np.random.default_rng(8), density=15) + shift
    rows = path_in_room()
    rows[:, 1:4] += shift
    ids = (np.arange(len(cloud)) % 40).astype("i4")
    path = write_ply(tmp_path / "points.ply", "binary_little_endian", xyz_columns(cloud, "f8", scan_id=ids))
    survey = open_survey(path, write_tum(tmp_path / "a.tum", rows))
    np.testing.assert_allclose(survey.trajectory.origins + survey.local_frame.shift, rows[:, 1:4], atol=1e-2)
    points, _ = all_points(survey)
    np.testing.assert_allclose(points + survey.local_frame.shift, cloud, atol=1e-8)


def test_metres_beside_millimetres(tmp_path):
    cloud = room(np.random.default_rng(8)) * 1000
    ids = (np.arange(len(cloud)) % 40).astype("i4")
    path = write_ply(tmp_path / "points.ply", "binary_little_endian", xyz_columns(cloud, scan_id=ids))
    survey = open_survey(path, write_tum(tmp_path / "a.tum", path_in_room()))
    assert survey.local_frame.unit == "mm"
    np.testing.assert_allclose(survey.trajectory.origins, path_in_room()[:, 1:4], atol=1e-6)

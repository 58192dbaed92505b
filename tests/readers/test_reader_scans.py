"""Folders of scans: formats, rows of the trajectory, gaps, empty scans, and other folders."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.readers import open_survey
from floorplan_core.readers.trajectory import read_trajectory
from tests.readers.reader_clouds import (
    all_points,
    path_in_room,
    room,
    write_pcd,
    write_ply,
    write_tum,
    xyz_columns,
)

AS_IT_IS = InputConfig(unit="m", up="z")
COUNT = 12


def write_scan(path, points):
    if path.suffix == ".ply":
        write_ply(path, "binary_little_endian", xyz_columns(points))
    elif path.suffix == ".pcd":
        write_pcd(path, "binary_compressed", xyz_columns(points))
    elif path.suffix == ".npz":
        np.savez(path, points=points.astype("f4"))
    elif path.suffix == ".bin":
        np.column_stack([points, points[:, 0]]).astype("<f4").tofile(path)
    else:
        np.savetxt(path, points)


@pytest.fixture
def run(tmp_path):
    """A folder of scans in ``suffix``: (folder, points in the world, their rows)."""

    def make(suffix=".ply", name="{:06d}", shift=(0.0, 0.0, 0.0)):
        rows = path_in_room(COUNT)
        rows[:, 1:4] += shift
        cloud = room(np.random.default_rng(6), density=10) + shift
        ids = np.arange(len(cloud)) % COUNT
        folder = tmp_path / "run"
        folder.mkdir()
        poses = read_trajectory(write_tum(folder / "trajectory.tum", rows)).T_world_sensor
        for k in range(COUNT):
            T = poses[k]
            write_scan(folder / (name.format(k) + suffix), (cloud[ids == k] - T[:3, 3]) @ T[:3, :3])
        return folder, cloud, ids

    return make


@pytest.mark.parametrize("suffix", [".ply", ".pcd", ".bin", ".npz", ".xyz"])
def test_scans_are_placed_in_the_world(run, suffix):
    folder, cloud, ids = run(suffix)
    survey = open_survey(folder, config=AS_IT_IS)
    assert survey.scans_ordered
    points, found = all_points(survey)
    order = np.argsort(ids, kind="stable")
    np.testing.assert_allclose(points, cloud[order], atol=1e-4)
    np.testing.assert_array_equal(found, ids[order])


def test_large_offsets_keep_millimetres(run):
    shift = np.array([452_000.0, 5_411_000.0, 312.0])
    folder, cloud, ids = run(".bin", shift=shift)
    survey = open_survey(folder, config=AS_IT_IS)
    points, _ = all_points(survey)
    world = points + survey.local_frame.shift
    np.testing.assert_allclose(world, cloud[np.argsort(ids, kind="stable")], atol=1e-3)
    assert np.abs(survey.trajectory.origins).max() < 1000


def test_names_sort_by_number(run):
    folder, _, _ = run(".ply", name="scan_{:d}")
    _, found = all_points(open_survey(folder, config=AS_IT_IS))
    assert np.all(np.diff(found) >= 0)
    assert found.max() == COUNT - 1


def test_missing_scans_keep_their_rows(run):
    folder, cloud, ids = run()
    (folder / "000003.ply").unlink()
    points, found = all_points(open_survey(folder, config=AS_IT_IS))
    assert set(found.tolist()) == set(range(COUNT)) - {3}
    np.testing.assert_allclose(points[found == 7], cloud[ids == 7], atol=1e-4)


def test_an_empty_scan_is_passed_over(run):
    folder, _, _ = run(".bin")
    (folder / "000004.bin").write_bytes(b"")
    _, found = all_points(open_survey(folder, config=AS_IT_IS))
    assert set(found.tolist()) == set(range(COUNT)) - {4}


def test_trajectory_beside_the_folder(run, tmp_path):
    folder, cloud, _ = run()
    (folder / "trajectory.tum").rename(tmp_path / "run.tum")
    assert len(all_points(open_survey(folder, config=AS_IT_IS))[0]) == len(cloud)


def test_no_trajectory(run):
    folder, _, _ = run()
    (folder / "trajectory.tum").unlink()
    with pytest.raises(InputError, match="12 scans but no trajectory"):
        open_survey(folder)


def test_fewer_rows_than_scans(run, tmp_path):
    folder, _, _ = run()
    short = write_tum(tmp_path / "short.tum", path_in_room(5))
    with pytest.raises(InputError, match=r"12 scans .*the trajectory has 5 rows"):
        open_survey(folder, short)


def test_a_damaged_scan_is_named(run):
    folder, _, _ = run()
    path = folder / "000005.ply"
    path.write_bytes(path.read_bytes()[:-100])
    with pytest.raises(InputError, match=r"000005\.ply is truncated"):
        all_points(open_survey(folder, config=AS_IT_IS))


def test_a_folder_with_one_cloud_is_that_cloud(tmp_path):
    cloud = room(np.random.default_rng(7), density=10)
    write_ply(tmp_path / "points.ply", "ascii", xyz_columns(cloud))
    (tmp_path / "README.txt").write_text("about this survey\n")
    write_tum(tmp_path / "trajectory.tum", path_in_room())
    survey = open_survey(tmp_path)
    assert survey.name == tmp_path.name
    assert len(survey.trajectory) == 40


def test_a_folder_with_a_choice(tmp_path):
    cloud = room(np.random.default_rng(7), density=10)
    for name in ("points2d.ply", "points3d.ply"):
        write_ply(tmp_path / name, "ascii", xyz_columns(cloud))
    with pytest.raises(InputError, match=r"2 versions of a point cloud \(points2d.ply, points3d.ply\)"):
        open_survey(tmp_path)


def test_a_folder_without_scans(tmp_path):
    (tmp_path / "letter.txt").write_text("Dear Sir\n")
    with pytest.raises(InputError, match="holds no scans"):
        open_survey(tmp_path)

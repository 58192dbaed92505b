"""Several files as one survey: one frame, one unit, one path."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.pipeline import process
from floorplan_core.readers import open_survey
from tests.cli.small_survey import write_survey
from tests.readers.reader_clouds import all_points, path_in_room, room, write_ply, write_tum, xyz_columns

FAR = np.array([500_000.0, 5_400_000.0, 300.0])  # m, as UTM coordinates are


def cloud(seed: int = 1) -> np.ndarray:
    return room(np.random.default_rng(seed), density=40)


def write(folder: Path, name: str, points: np.ndarray, **columns) -> Path:
    return write_ply(folder / name, "binary_little_endian", xyz_columns(points, "f8", **columns))


def world(survey) -> np.ndarray:
    """(N, 3) all points in the world frame."""
    return all_points(survey)[0] + survey.local_frame.shift


@pytest.mark.parametrize("offset", [np.zeros(3), FAR], ids=["near", "UTM"])
def test_a_cloud_in_three_files_is_the_cloud(tmp_path, offset):
    points = cloud() + offset
    whole = open_survey(write(tmp_path, "whole.ply", points))
    folder = tmp_path / "parts"
    folder.mkdir()
    parts = [
        write(folder, f"{name}.ply", part)
        for name, part in zip("abc", np.array_split(points, 3), strict=True)
    ]
    for given in (parts, [folder], [folder / "*.ply"], [str(folder / "[ab].ply"), parts[2]]):
        joined = open_survey(given)
        assert joined.point_count == len(points)
        np.testing.assert_allclose(world(joined), points, atol=1e-4)
        assert joined.local_frame.unit == whole.local_frame.unit
        assert any(
            a.startswith("3 files are read as one survey: a.ply, b.ply, c.ply") for a in joined.assumptions
        )
    assert open_survey(folder).name == "parts"
    assert open_survey(parts).name == "a.ply and 2 more"


def test_files_with_paths_of_their_own(tmp_path):
    """Scan ids and stamps go on where the file before ended; the earlier run comes first."""
    for name, start in (("late", 500.0), ("early", 100.0)):
        points = cloud()
        write(tmp_path, f"{name}.ply", points, scan_id=np.arange(len(points), dtype="i4") * 40 // len(points))
        rows = path_in_room()
        rows[:, 0] += start - rows[0, 0]
        write_tum(tmp_path / f"{name}.tum", rows)
    joined = open_survey([tmp_path / "late.ply", tmp_path / "early.ply"])
    assert len(joined.trajectory) == 80
    assert joined.trajectory.stamps[0] == 100.0
    assert (np.diff(joined.trajectory.stamps) >= 0).all()
    assert joined.scans_ordered
    ids = np.concatenate([c.scan_id for c in joined.chunks()])
    assert (ids.min(), ids.max()) == (0, 79)
    assert (np.diff(ids) >= 0).all()


def test_clocks_that_overlap_are_put_one_after_the_other(tmp_path):
    for name in "ab":
        write(tmp_path, f"{name}.ply", cloud(), scan_id=np.zeros(len(cloud()), dtype="i4"))
        write_tum(tmp_path / f"{name}.tum", path_in_room())
    stamps = open_survey([tmp_path / "a.ply", tmp_path / "b.ply"]).trajectory.stamps
    assert (np.diff(stamps) > 0).all()


def test_one_trajectory_for_all_files(tmp_path):
    points = cloud()
    ids = np.arange(len(points), dtype="i4") * 40 // len(points)
    tum = write_tum(tmp_path / "path.txt", path_in_room())
    half = len(points) // 2
    files = [write(tmp_path, "a.ply", points[:half], scan_id=ids[:half])]
    files += [write(tmp_path, "b.ply", points[half:], scan_id=ids[half:])]
    joined = open_survey(files, trajectory=tum)
    assert len(joined.trajectory) == 40
    assert sorted(np.concatenate([c.scan_id for c in joined.chunks()])) == sorted(ids)


def test_a_file_without_path_beside_one_with(tmp_path):
    write(tmp_path, "a.ply", cloud(), scan_id=np.zeros(len(cloud()), dtype="i4"))
    write_tum(tmp_path / "a.tum", path_in_room())
    write(tmp_path, "b.ply", cloud(), scan_id=np.zeros(len(cloud()), dtype="i4"))
    joined = open_survey([tmp_path / "a.ply", tmp_path / "b.ply"])
    assert [c.scan_id is None for c in joined.chunks()] == [False, True]
    assert "1 of them have no sensor positions" in joined.assumptions[0]


def test_an_odd_guess_follows_the_other_files(tmp_path):
    """A hall 9 m high looks like a room in feet; the rooms beside it say metres."""
    hall = cloud() * 3.3
    files = [write(tmp_path, "a.ply", cloud()), write(tmp_path, "b.ply", cloud(2))]
    alone = open_survey(write(tmp_path, "hall.ply", hall)).local_frame.unit
    assert alone != "m"
    joined = open_survey([*files, tmp_path / "hall.ply"])
    assert joined.local_frame.unit == "m"
    assert any(a == "hall.ply is read like the other PLY files: in m, z up." for a in joined.assumptions)
    np.testing.assert_allclose(world(joined)[-len(hall) :], hall, atol=1e-4)


def test_files_of_different_places_are_refused(tmp_path):
    files = [write(tmp_path, "a.ply", cloud()), write(tmp_path, "b.ply", cloud() + FAR)]
    with pytest.raises(InputError, match=r"a.ply and b.ply lie 5,400 km apart"):
        open_survey(files, config=InputConfig(unit="m"))


def test_what_cannot_be_joined(tmp_path):
    with pytest.raises(InputError, match="No file fits the pattern"):
        open_survey([tmp_path / "*.laz"])
    with pytest.raises(InputError, match="No input"):
        open_survey([])
    write(tmp_path, "a.ply", cloud())
    with pytest.raises(InputError, match="does not exist"):
        open_survey([tmp_path / "a.ply", tmp_path / "b.ply"])


def test_one_cloud_in_two_formats_is_a_choice(tmp_path):
    write(tmp_path, "scan.ply", cloud())
    np.save(tmp_path / "scan.npy", cloud())
    with pytest.raises(InputError, match="2 versions of a point cloud"):
        open_survey(tmp_path)


def test_the_plan_of_the_parts_is_the_plan_of_the_whole(tmp_path):
    survey = write_survey(tmp_path / "whole")
    whole = open_survey(survey)
    (chunk,) = list(whole.chunks())
    for k in range(2):
        part = np.isin(chunk.scan_id, (2 * k, 2 * k + 1))
        write(tmp_path, f"part{k}.ply", chunk.points[part], scan_id=chunk.scan_id[part])
    joined = open_survey(tmp_path / "part?.ply", trajectory=survey / "trajectory.tum")
    one, two = process(whole), process(joined)
    assert [r.polygon.wkb for r in one.regions] == [r.polygon.wkb for r in two.regions]
    assert [d.width for d in one.doors] == [d.width for d in two.doors]

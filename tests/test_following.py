"""A run that is being recorded gives the same intervals and plans as its replay afterwards."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from floorplan_core.cli import main
from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.following import GrowingFolder, follow
from floorplan_core.observer import Observer
from floorplan_core.readers import open_survey
from floorplan_core.replay import Interval, intervals
from tests.cli.small_survey import write_survey
from tests.readers.reader_clouds import Remembering


def scan_files(folder: Path) -> tuple[dict[str, bytes], list[str]]:
    """Content of each scan's file, in the sensor's frame, and the lines of the trajectory."""
    whole = open_survey(write_survey(folder))
    points = np.concatenate([c.points for c in whole.chunks()]) + whole.local_frame.shift
    ids = np.concatenate([c.scan_id for c in whole.chunks()])
    lines = (folder / "trajectory.tum").read_text().splitlines()
    files = {}
    for row, line in enumerate(lines):
        local = points[ids == row] - np.array(line.split()[1:4], dtype=float)
        header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(local)}\n"
        header += "property float x\nproperty float y\nproperty float z\nend_header\n"
        files[f"{row:06d}.ply"] = header.encode() + local.astype("<f4").tobytes()
    return files, lines


class Robot:
    """Writes a run piece by piece, one piece each time that somebody waits for it."""

    def __init__(self, folder: Path, files: dict[str, bytes], lines: list[str]) -> None:
        folder.mkdir()
        self.steps: list[tuple[Path, bytes]] = []
        for (name, content), line in zip(files.items(), lines, strict=True):
            row = (line + "\n").encode()
            self.steps += [(folder / name, content[:4000]), (folder / "trajectory.tum", row[:9])]
            self.steps += [(folder / name, content[4000:]), (folder / "trajectory.tum", row[9:])]

    def wait(self, seconds: float) -> None:
        if self.steps:
            path, piece = self.steps.pop(0)
            with path.open("ab") as handle:
                handle.write(piece)


def contents(interval: Interval) -> tuple[float, float, list[tuple[int, bytes]]]:
    chunks = [
        (int(c.scan_id[0]), np.round(c.points, 3).tobytes())  # type: ignore[index]
        for c in interval.chunks
    ]
    return interval.end, interval.path_length, chunks


@pytest.mark.parametrize("every", [5.0, 10.0, 15.0])
def test_a_growing_folder_gives_the_intervals_of_its_replay(tmp_path: Path, every: float) -> None:
    robot = Robot(tmp_path / "scans", *scan_files(tmp_path / "survey"))
    growing = GrowingFolder(tmp_path / "scans", None, 2.0, Observer(), robot.wait)
    run, following = follow(growing, every, InputConfig(), Observer())
    followed = [contents(i) for i in following]
    assert not robot.steps
    replay = open_survey(tmp_path / "scans")
    assert run.local_frame.shift == pytest.approx(replay.local_frame.shift)
    assert followed == [contents(i) for i in intervals(replay, every)]
    assert sum(len(chunks) for _, _, chunks in followed) == 4


def test_scans_come_as_soon_as_file_and_pose_are_whole(tmp_path: Path) -> None:
    files, lines = scan_files(tmp_path / "survey")
    robot = Robot(tmp_path / "scans", files, lines)
    seen = []
    growing = GrowingFolder(tmp_path / "scans", None, 2.0, Observer(), robot.wait)
    for scan, poses in growing.scans():
        assert scan.path.read_bytes() == files[scan.path.name]
        assert len(poses) > scan.row
        seen.append(len(robot.steps))
    assert seen == [12, 8, 4, 0]  # of 16 pieces: as soon as the line of its pose is whole


def test_scans_that_are_deleted_or_damaged_end_no_run(tmp_path: Path) -> None:
    """A robot that keeps the last scans only; the others keep their rows of the trajectory."""
    files, lines = scan_files(tmp_path / "survey")
    robot = Robot(tmp_path / "scans", files, lines)
    names, seen = sorted(files), Remembering()

    def wait(seconds: float) -> None:
        robot.wait(seconds)
        if len(robot.steps) == 8:  # the first two are whole
            (tmp_path / "scans" / names[0]).unlink(missing_ok=True)
        if not robot.steps:
            (tmp_path / "scans" / names[2]).write_bytes(b"")

    growing = GrowingFolder(tmp_path / "scans", None, 2.0, seen, wait)
    _, following = follow(growing, 1e4, InputConfig(), seen)
    (interval,) = following
    assert [int(c.scan_id[0]) for c in interval.chunks] == [1, 3]
    assert len(seen.warnings) == 2
    assert seen.warnings[0] == f"The scan {names[0]} was left out: No such file or directory."
    assert seen.warnings[1].startswith(f"The scan {names[2]} was left out: {names[2]} claims to be PLY")


@pytest.mark.parametrize(
    ("numbered_from", "deleted", "rows"), [(0, 2, [2, 3]), (1, 0, [0, 1, 2, 3]), (70, 1, [0, 1, 2])]
)
def test_the_row_of_a_scan_is_its_number(
    tmp_path: Path, numbered_from: int, deleted: int, rows: list[int]
) -> None:
    """Also where the first ones are gone already; numbers beyond the path count from the first."""
    files, lines = scan_files(tmp_path / "survey")
    folder = tmp_path / "scans"
    folder.mkdir()
    for row, content in list(enumerate(files.values()))[deleted:]:
        (folder / f"{row + numbered_from:06d}.ply").write_bytes(content)
    (folder / "trajectory.tum").write_text("\n".join(lines) + "\n")
    growing = GrowingFolder(folder, None, 1.0, Observer(), lambda _: None)
    assert [scan.row for scan, _ in growing.scans()] == rows


def test_nothing_in_time_is_one_sentence(tmp_path: Path) -> None:
    growing = GrowingFolder(tmp_path / "absent", None, 1.0, Observer(), lambda _: None)
    with pytest.raises(InputError, match="No whole scan with a pose came into"):
        follow(growing, 10.0, InputConfig(), Observer())


def test_watch_follows_a_folder_and_refuses_a_file(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    robot = Robot(tmp_path / "scans", *scan_files(tmp_path / "survey"))
    while robot.steps:
        robot.wait(0.0)
    scans, out = str(tmp_path / "scans"), tmp_path / "out"
    assert main.run(["watch", scans, "--every", "10", "--follow", "1", "--out", str(out), "--quiet"]) == 0
    assert main.run(["watch", scans, "--every", "10", "--out", str(tmp_path / "replay"), "--quiet"]) == 0
    plans = sorted(p.name for p in out.glob("plan-*.geojson"))
    assert len(plans) == 3
    for name in plans:
        assert (out / name).read_bytes() == (tmp_path / "replay" / name).read_bytes()
    cloud = str(tmp_path / "survey" / "points.ply")
    assert main.run(["watch", cloud, "--follow", "1", "--out", str(tmp_path / "no")]) == 2
    assert "--follow is for a folder" in capfd.readouterr().err
    assert not (tmp_path / "no").exists()

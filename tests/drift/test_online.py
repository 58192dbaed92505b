"""Drift corrected online: scan by scan and interval by interval, each plan from the whole path so far."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floorplan_core.cli import main
from floorplan_core.drift.online import CorrectingPlanner
from floorplan_core.errors import InputError, NoPlanError
from floorplan_core.model import LocalFrame, PointChunk, Reconstruction, Trajectory
from floorplan_core.readers import open_survey
from floorplan_core.replay import intervals
from tests.box_world import room, stations
from tests.box_world import survey as box_survey
from tests.drift.test_correction import CONFIG, SAMPLE, bent, error


@pytest.fixture(scope="module")
def survey() -> Reconstruction:
    return open_survey(SAMPLE)


@pytest.fixture(scope="module")
def half_and_whole(survey: Reconstruction) -> list[tuple[Trajectory, np.ndarray, set[str]]]:
    """The corrected path, what places the robot in it, and the names of the regions, after each half."""
    run = bent(survey, 0.5)
    planner = CorrectingPlanner(CONFIG, local_frame=run.local_frame)
    stands = []
    for interval in intervals(run, np.ptp(run.trajectory.stamps) / 2):
        for chunk in interval.chunks:
            planner.integrate_chunk(chunk, interval.trajectory)
        names = {region.name for region in planner.plan().regions}
        stands.append((planner.path, planner.map_from_odom, names))
    return stands


def test_the_path_comes_back_while_it_is_walked(survey, half_and_whole):
    truth, given = survey.trajectory.origins, bent(survey, 0.5).trajectory.origins
    errors = [
        (error(path.origins, truth[: len(path)]).mean(), error(given[: len(path)], truth[: len(path)]).mean())
        for path, _, _ in half_and_whole
    ]
    assert all(corrected < 0.6 * before for corrected, before in errors), errors  # no loop is closed yet
    assert errors[-1][0] < 0.04
    for path, _, _ in half_and_whole:
        np.testing.assert_allclose(path.origins[0], given[0], atol=1e-9)  # the run stays where it began


def test_a_robot_finds_itself_in_the_plan(survey, half_and_whole):
    given = bent(survey, 0.5).trajectory
    shift = np.eye(4)
    shift[:3, 3] = survey.local_frame.shift
    for path, map_from_odom, _ in half_and_whole:
        last = np.linalg.inv(shift) @ map_from_odom @ shift @ given.T_world_sensor[len(path) - 1]
        np.testing.assert_allclose(last, path.T_world_sensor[-1], atol=1e-9)


def test_rooms_keep_their_names_while_the_path_is_moved(half_and_whole):
    (_, _, early), (_, _, late) = half_and_whole
    assert len(early & late) >= 0.7 * len(early)


def test_scan_by_scan_is_the_same_as_by_chunks(survey):
    run = bent(survey, 0.3)
    chunk = next(iter(run.chunks()))
    some = chunk.scan_id < 40
    chunk = PointChunk(chunk.points[some], chunk.scan_id[some])
    whole, single = CorrectingPlanner(CONFIG), CorrectingPlanner(CONFIG)
    whole.integrate_chunk(chunk, run.trajectory)
    for row, pose in enumerate(run.trajectory.T_world_sensor[:40]):
        mine = chunk.points[chunk.scan_id == row]
        single.integrate((mine - pose[:3, 3]) @ pose[:3, :3], pose)
    rows = (len(whole.plan().regions), len(single.plan().regions))
    assert rows[0] == rows[1] > 0
    np.testing.assert_allclose(whole.path.origins, single.path.origins, atol=5e-3)


def test_the_first_scan_is_a_plan_already():
    """One keyframe has nothing to drift against."""
    scans = box_survey(room(4.0, 5.0), stations(4.0, 5.0)[:1])
    planner = CorrectingPlanner()
    planner.integrate((scans.points - scans.poses[0, :3, 3]) @ scans.poses[0, :3, :3], scans.poses[0])
    assert len(planner.plan().regions) == 1
    np.testing.assert_allclose(planner.map_from_odom, np.eye(4), atol=1e-12)


def test_what_cannot_be_corrected_is_one_sentence(survey):
    planner = CorrectingPlanner(CONFIG, source="run.ply")
    with pytest.raises(NoPlanError, match=r"points of run\.ply do not refer to a trajectory"):
        planner.integrate_chunk(PointChunk(np.zeros((5, 3))), survey.trajectory)
    with pytest.raises(InputError, match="Points refer to the scans 0 to 99"):
        planner.integrate_chunk(
            PointChunk(np.zeros((2, 3)), np.array([0, 99], dtype=np.int32)),
            Trajectory(np.zeros(1), np.eye(4)[None]),
        )
    with pytest.raises(InputError, match="A pose must be a 4 x 4 matrix"):
        planner.integrate(np.zeros((5, 3)), np.eye(3))
    with pytest.raises(NoPlanError, match="Too little to make a plan of"):
        planner.plan()


def test_what_a_robot_needs_is_in_world_coordinates(survey):
    far = replace(bent(survey, 0.5), local_frame=LocalFrame(shift=np.array([4e5, 5e6, 100.0])))
    planner = CorrectingPlanner(CONFIG, local_frame=far.local_frame)
    assert np.array_equal(planner.map_from_odom, np.eye(4))
    for chunk in far.chunks():
        planner.integrate_chunk(chunk, far.trajectory)
    planner.plan()
    world = far.trajectory.origins[-1] + far.local_frame.shift
    moved = planner.map_from_odom[:3, :3] @ world + planner.map_from_odom[:3, 3]
    np.testing.assert_allclose(moved, planner.path.origins[-1] + far.local_frame.shift, atol=1e-6)


@pytest.mark.parametrize("shift", [0.0, 4e5])
def test_other_poses_take_the_points_with_them(shift):
    """A loop was closed elsewhere: the second half of the scans had been 0.4 m off."""
    scans = box_survey(room(4.0, 5.0), stations(4.0, 5.0))
    world = np.eye(4)
    world[0, 3] = shift
    right = world @ scans.poses
    wrong = right.copy()
    wrong[2:, 0, 3] += 0.4
    planner = CorrectingPlanner(correct=False)
    for row, pose in enumerate(scans.poses):
        mine = scans.points[scans.scan_id == row]
        planner.integrate((mine - pose[:3, 3]) @ pose[:3, :3], wrong[row])
    before = planner.plan()
    planner.replace_path(right)
    (found,) = (after := planner.plan()).regions
    assert found.area == pytest.approx(20.0, abs=0.02)
    assert abs(sum(region.area for region in before.regions) - 20.0) > 0.5
    corners = after.to_world(np.array(found.polygon.exterior.coords))
    np.testing.assert_allclose(corners.min(axis=0), [shift, 0.0], atol=0.02)
    np.testing.assert_array_equal(planner.map_from_odom, np.eye(4))  # nothing is corrected here
    planner.integrate(np.zeros((0, 3)), right[0])  # and the run goes on in the new world
    with pytest.raises(InputError, match="One pose for each of the 4 scans so far is needed"):
        planner.replace_path(right[:3])


def test_the_command_corrects_while_it_watches(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "run"
    arguments = ["watch", str(SAMPLE), "--out", str(out), "--every", "40", "--set", "drift.correct=true"]
    assert main.run([*arguments, "--quiet"]) == 0
    timeline = json.loads((out / "timeline.json").read_text())
    assert timeline[-1]["plan"] is not None
    assert np.shape(timeline[-1]["map_from_odom"]) == (4, 4)

"""A planar laser in two rooms, with points that float in the doorway between them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from floorplan_core.stages import voxel_columns
from tests.box_world import EYE, Survey, cast, run, stations, two_rooms

DOOR = (1.5, 2.4, 2.6)  # from, to and height: to the ceiling, as a planar laser sees it
STRAYS = 14


def planar_survey(seed: int = 0) -> Survey:
    """Level scans of two rooms; of the rays through the door some end in it, spread over its width."""
    rng = np.random.default_rng(seed)
    boxes, places = two_rooms(DOOR), [*stations(4.0, 5.0), *stations(4.0, 5.0, x0=4.1)]
    points, poses = [], np.tile(np.eye(4), (20 * len(places), 1, 1))
    for row in range(len(poses)):
        at = np.array(places[row % len(places)]) + np.append(rng.uniform(-0.3, 0.3, 2), 0.0)
        angle = (np.arange(720) + rng.uniform()) * 2 * np.pi / 720
        rays = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(720)])
        distance = cast(boxes, at, rays) + rng.normal(0, 0.01, 720)
        points.append(at + rays * distance[:, None])
        poses[row, :3, 3] = at
    for k in range(STRAYS):
        y = DOOR[0] + (DOOR[1] - DOOR[0]) * (k + 0.5) / STRAYS
        points[7 * k] = np.vstack([points[7 * k], [(4.02, y, EYE)]])
    ids = np.repeat(np.arange(len(poses), dtype=np.int32), [len(p) for p in points])
    return Survey(np.concatenate(points), ids, poses, np.eye(3))


@pytest.fixture(scope="module")
def given() -> Survey:
    return planar_survey()


def test_a_doorway_in_which_points_float_is_a_door(given: Survey) -> None:
    plan = run(given).plan
    assert plan is not None
    assert len(plan.regions) == 2
    (door,) = plan.doors
    assert len(door.connects) == 2
    assert (door.start, door.end) == pytest.approx(DOOR[:2], abs=0.12)


def test_what_is_left_out_are_the_strays_and_no_wall(given: Survey, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = run(given)["occupancy"]
    monkeypatch.setattr(voxel_columns, "stray_returns", lambda xyz, *_: np.zeros(len(xyz), dtype=bool))
    all_of_it = run(given)["occupancy"]

    def near_the_door(xyz: np.ndarray) -> np.ndarray:
        inside = (xyz[:, 1] > DOOR[0] + 0.1) & (xyz[:, 1] < DOOR[1] - 0.1)
        return (np.abs(xyz[:, 0] - 4.05) < 0.1) & inside

    assert near_the_door(all_of_it.xyz).any()
    assert not near_the_door(seen.xyz).any()
    lost = len(all_of_it.xyz) - len(seen.xyz)
    assert lost <= (STRAYS + 2) * 24, "a return becomes 24 points; at each jamb one more may go"


def test_a_return_that_few_rays_passed_stays(given: Survey) -> None:
    """One scan a room: nothing is known well enough to be called stray."""
    few = given.scan_id < 8
    short = replace(given, points=given.points[few], scan_id=given.scan_id[few], poses=given.poses[:8])
    evidence = run(short)["occupancy"]
    assert evidence.count.sum() >= 0.99 * 24 * few.sum()

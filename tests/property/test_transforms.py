"""plan(transform(x)) equals transform(plan(x)): wherever a survey lies, however turned, in whatever unit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.config import Config
from floorplan_core.model import FloorPlan
from floorplan_core.pipeline import process
from floorplan_core.readers import open_survey
from floorplan_core.simulation.files import tum_bytes
from floorplan_core.units import METRES_PER_UNIT, up_rotation
from tests.box_world import LINTEL, Survey, rotation, stations, survey, two_rooms

MILLIMETRE = 1e-3


@pytest.fixture(scope="module")
def flat() -> Survey:
    places = [*stations(4, 5), *stations(4, 5, x0=4.1), (3.9, 2.4, 1.4), (4.3, 2.4, 1.4)]
    return survey(two_rooms((2, 2.9, LINTEL)), places, rays=(200, 60))


def plan_of(
    folder: Path, points: np.ndarray, ids: np.ndarray, poses: np.ndarray, size: float = 1.0, **forced: str
) -> FloorPlan:
    """Through files: metres in any frame are written in units of ``size`` metres, then read and planned."""
    record = np.empty(len(points), dtype=[("xyz", "<f8", 3), ("scan_id", "<i4")])
    record["xyz"], record["scan_id"] = points / size, ids
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    head += [f"property double {axis}" for axis in "xyz"] + ["property int scan_id", "end_header", ""]
    (folder / "points.ply").write_bytes("\n".join(head).encode() + record.tobytes())
    scaled = poses.copy()
    scaled[:, :3, 3] /= size
    (folder / "trajectory.tum").write_bytes(tum_bytes(np.arange(len(poses), dtype=float), scaled))
    values = {f"input.{name}": value for name, value in forced.items()}
    config = Config().with_values(values)
    return process(open_survey(folder, config=config.input), config)


def moved(flat: Survey, turn: np.ndarray, shift: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    poses = flat.poses.copy()
    poses[:, :3, :3] = turn @ poses[:, :3, :3]
    poses[:, :3, 3] = poses[:, :3, 3] @ turn.T + shift
    return flat.points @ turn.T + shift, flat.scan_id, poses


def world(plan: FloorPlan, turn: np.ndarray, shift: np.ndarray) -> list[shapely.Polygon]:
    """The regions on the floor of the plan, in the frame of the survey as it was made, by their middles."""

    def back(xy: np.ndarray) -> np.ndarray:
        there = plan.frame.from_manhattan(xy) + plan.local_frame.shift
        return ((there - shift) @ turn)[:, :2]

    found = [shapely.transform(r.polygon, back) for r in plan.regions]
    return sorted(found, key=lambda p: (round(p.centroid.x), round(p.centroid.y)))


def assert_same(one: list[shapely.Polygon], two: list[shapely.Polygon], within: float = MILLIMETRE) -> None:
    assert len(one) == len(two)
    for a, b in zip(one, two, strict=True):
        assert a.hausdorff_distance(b) < within


@pytest.fixture(scope="module")
def straight(flat, tmp_path_factory) -> list[shapely.Polygon]:
    plan = plan_of(tmp_path_factory.mktemp("straight"), flat.points, flat.scan_id, flat.poses)
    assert len(plan.regions) == 2
    return world(plan, np.eye(3), np.zeros(3))


@pytest.fixture(scope="module")
def bundled() -> Survey:
    """Twelve rooms, some of which were hardly seen."""
    read = open_survey(Path(__file__).parents[2] / "resources" / "sample_survey")
    chunks = list(read.chunks())
    points = np.concatenate([c.points for c in chunks]).astype(np.float64)
    return Survey(
        points, np.concatenate([c.scan_id for c in chunks]), read.trajectory.T_world_sensor, np.eye(3)
    )


@pytest.fixture(scope="module")
def bundled_plan(bundled, tmp_path_factory) -> list[shapely.Polygon]:
    plan = plan_of(tmp_path_factory.mktemp("bundled"), bundled.points, bundled.scan_id, bundled.poses)
    return world(plan, np.eye(3), np.zeros(3))


@pytest.mark.parametrize(
    ("turn", "shift", "unit"),
    [
        (rotation(90), (0, 0, 0), "m"),
        (rotation(180), (-9e6, 7e6, 0), "mm"),
        (rotation(-61, 1.5, -1.0), (4e5, 5.3e6, 512), "m"),
        (rotation(133, 0.4, 2.0), (0, 0, 3000), "ft"),
    ],
    ids=["90 degrees", "180 degrees", "tilted, land survey", "tilted, feet"],
)
def test_a_survey_of_half_seen_rooms_in_any_quadrant(bundled, bundled_plan, tmp_path, turn, shift, unit):
    """What is predicted follows from choices, each of which may fall otherwise when a point does."""
    shift = np.array(shift, dtype=np.float64)
    plan = plan_of(tmp_path, *moved(bundled, turn, shift), METRES_PER_UNIT[unit], unit=unit, up="z")
    assert_same(world(plan, turn, shift), bundled_plan, 1e-4)
    assert abs(np.degrees(plan.frame.yaw)) <= 45
    x, y = plan.frame.rotation[:2, :2].diagonal()
    assert min(x, y) > 0.7  # the plan's axes are those of the walls that are nearest to the world's


OFFSETS = st.floats(-1e7, 1e7).map(lambda v: round(v, 3))


@settings(max_examples=15, deadline=None)
@given(
    yaw=st.floats(-180, 180),
    x=OFFSETS,
    y=OFFSETS,
    z=st.floats(-3000, 8000),
    unit=st.sampled_from(sorted(METRES_PER_UNIT)),
)
def test_any_turn_offset_and_unit(flat, straight, tmp_path_factory, yaw, x, y, z, unit):
    turn, shift = rotation(yaw), np.array([x, y, z])
    plan = plan_of(
        tmp_path_factory.mktemp("moved"), *moved(flat, turn, shift), METRES_PER_UNIT[unit], unit=unit, up="z"
    )
    assert_same(world(plan, turn, shift), straight)


@pytest.mark.parametrize("up", ["y", "-y", "x"])
def test_any_axis_up(flat, straight, tmp_path, up):
    """Files whose up axis is another: the world has z up."""
    points, ids, poses = moved(flat, up_rotation(up).T, np.zeros(3))
    plan = plan_of(tmp_path, points, ids, poses, up=up, unit="m")
    assert plan.local_frame.up == up
    assert_same(world(plan, np.eye(3), np.zeros(3)), straight)


def test_a_left_handed_file_gives_the_building_and_not_its_mirror_image(flat, straight, tmp_path):
    mirror = np.diag([1.0, -1.0, 1.0])
    points, ids, poses = moved(flat, mirror, np.zeros(3))
    poses[:, :3, :3] = poses[:, :3, :3] @ mirror  # TUM knows no mirrored poses
    (tmp_path / "asked").mkdir()
    asked = plan_of(tmp_path / "asked", points, ids, poses, mirrored="true", up="z", unit="m")
    assert_same(world(asked, np.eye(3), np.zeros(3)), straight)
    plain = plan_of(tmp_path, points, ids, poses, up="z", unit="m")
    image = [shapely.transform(p, lambda xy: xy * [1, -1]) for p in world(plain, np.eye(3), np.zeros(3))]
    assert_same(sorted(image, key=lambda p: (round(p.centroid.x), round(p.centroid.y))), straight, 0.02)


@pytest.mark.parametrize(("form", "places"), [("<f8", None), ("<f4", None), ("<f8", 4)], ids=str)
def test_numbers_of_usual_precision(flat, straight, tmp_path, form, places):
    """Doubles, floats and numbers that were rounded to a tenth of a millimetre, of a tilted building."""
    turn, shift = rotation(-61, 1.5, 2), np.array([240.0, -35.0, 12.0])
    points, ids, poses = moved(flat, turn, shift)
    points = points.astype(form) if places is None else points.round(places)
    plan = plan_of(tmp_path, points.astype(np.float64), ids, poses, up="z", unit="m")
    assert_same(world(plan, turn, shift), straight)


@pytest.mark.parametrize("tilt", [(3, 0), (0, -3), (2, 2)], ids=str)
def test_a_tilt_of_three_degrees(flat, straight, tmp_path, tilt):
    """The map is levelled by the floor itself, and the voxels lie as in a level building."""
    turn, shift = rotation(20, *tilt), np.array([500.0, -20.0, 3.0])
    plan = plan_of(tmp_path, *moved(flat, turn, shift), up="z", unit="m")
    assert np.degrees(plan.frame.tilt) == pytest.approx(np.hypot(*tilt), abs=0.1)
    assert_same(world(plan, turn, shift), straight)

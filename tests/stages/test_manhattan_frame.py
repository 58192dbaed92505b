"""Gravity and yaw: right whatever the pose of the building, refused where there is none."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.config import FrameConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.surfel_map import SurfelMap
from floorplan_core.model import ManhattanFrame
from floorplan_core.stages.manhattan_frame import estimate_frame, misfit
from tests.box_world import EYE, HEIGHT, LINTEL, room, rotation, stations, survey, two_rooms

YAW_TOLERANCE = 0.05  # degrees
TILT_TOLERANCE = 0.3  # measured on 80 poses: 0.25 at worst, 0.14 on average


def _frame(points: np.ndarray, config: FrameConfig | None = None) -> ManhattanFrame:
    table = SurfelMap(0.05)
    table.insert(points, np.full(len(points), -1, dtype=np.int32), np.zeros((0, 3)), (0.05, 30.0))
    return estimate_frame(table.surfels(), config or FrameConfig())


@pytest.fixture(scope="module")
def building() -> np.ndarray:
    """(N, 3) points of two rooms of 4 x 5 m with a wall of 10 cm between them, 1 cm of noise."""
    places = [*stations(4, 5), *stations(4, 5, 4.1)]
    return survey(two_rooms((2.0, 2.9, LINTEL)), places, rays=(200, 60)).points


def _error(frame: ManhattanFrame, turned: np.ndarray) -> tuple[float, float]:
    """Degrees of yaw and of tilt by which a frame misses, modulo quarter turns."""
    rest = frame.rotation @ turned  # building to manhattan: a quarter turn about z, if all is right
    yaw = math.degrees(math.atan2(rest[1, 0], rest[0, 0]))
    tilt = math.degrees(math.acos(np.clip(rest[2, 2], -1, 1)))
    return abs((yaw + 45) % 90 - 45), tilt


def test_a_frame_that_many_walls_do_not_follow_is_told(building):
    frame = _frame(building)
    assert misfit(frame) == ()
    (said,) = misfit(replace(frame, support=0.41))
    assert said.startswith("Only 41% of the wall surface")


@settings(max_examples=15)
@given(yaw=st.floats(-180, 180), roll=st.floats(-10, 10), pitch=st.floats(-10, 10))
def test_any_yaw_and_tilt_is_found(building, yaw, roll, pitch):
    turned = rotation(yaw, roll, pitch)
    frame = _frame(building @ turned.T)
    off_yaw, off_tilt = _error(frame, turned)
    assert off_yaw <= YAW_TOLERANCE
    assert off_tilt <= TILT_TOLERANCE
    assert frame.floor_z == pytest.approx(0, abs=0.02)
    assert frame.ceiling_z == pytest.approx(HEIGHT, abs=0.02)


@pytest.mark.parametrize("yaw", [-45, -44.99, -20.03, 0, 0.02, 44.99, 45, 90])
def test_yaws_at_the_ends_of_the_range(building, yaw):
    turned = rotation(yaw)
    frame = _frame(building @ turned.T)
    assert _error(frame, turned)[0] <= YAW_TOLERANCE
    assert -math.pi / 4 - 1e-9 <= frame.yaw <= math.pi / 4 + 1e-9


@pytest.mark.parametrize("noise", [0.03, 0.04, 0.06])
@pytest.mark.parametrize("yaw", [-20, -7, 10, 20, 30])
def test_noise_as_thick_as_a_patch_is_wide(building, noise, yaw):
    """Hardly a patch of the usual width is planar then, but those that the cells cut askew."""
    noisy = building + np.random.default_rng(6).normal(0, noise, building.shape)
    turned = rotation(yaw)
    frame = _frame(noisy @ turned.T)
    assert _error(frame, turned)[0] <= 0.1
    assert frame.support > 0.7


@pytest.mark.parametrize(("roll", "pitch"), [(15, 0), (0, -15), (10.6, 10.6)])
def test_a_tilt_of_fifteen_degrees(building, roll, pitch):
    turned = rotation(31, roll, pitch)
    frame = _frame(building @ turned.T)
    off_yaw, off_tilt = _error(frame, turned)
    assert off_yaw <= YAW_TOLERANCE
    assert off_tilt <= TILT_TOLERANCE
    assert math.degrees(frame.tilt) == pytest.approx(15, abs=0.3)


@settings(max_examples=10)
@given(yaw=st.floats(-45, 45), roll=st.floats(-15, 15))
def test_the_rotation_is_proper_and_orthonormal(building, yaw, roll):
    frame = _frame(building[::3] @ rotation(yaw, roll).T)
    assert frame.rotation @ frame.rotation.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(frame.rotation) == pytest.approx(1.0)


def test_there_and_back(building):
    frame = _frame(building @ rotation(12, 3, 2).T)
    points = np.random.default_rng(1).normal(0, 10, (50, 3))
    assert frame.from_manhattan(frame.to_manhattan(points)) == pytest.approx(points)


def test_a_shift_of_the_world_changes_nothing_but_heights(building):
    here, there = _frame(building), _frame(building + np.array([300.0, -200.0, 50.0]))
    assert _error(there, np.eye(3))[0] <= YAW_TOLERANCE
    assert there.floor_z == pytest.approx(here.floor_z + 50, abs=1.5)  # a quarter of a degree over 360 m
    assert there.ceiling_z - there.floor_z == pytest.approx(HEIGHT, abs=0.01)


def test_support_says_how_much_wall_is_manhattan(building):
    """A round wall among straight ones lowers the support, not the accuracy."""
    rng = np.random.default_rng(2)
    n = len(building) // 3
    angle, z = rng.uniform(0, 2 * np.pi, n), rng.uniform(0, HEIGHT, n)
    tower = np.column_stack([14 + 2.5 * np.cos(angle), 3 + 2.5 * np.sin(angle), z])
    turned = rotation(-17)
    alone, mixed = _frame(building @ turned.T), _frame(np.concatenate([building, tower]) @ turned.T)
    assert alone.support > 0.95
    assert 0.3 < mixed.support < 0.9
    assert _error(mixed, turned)[0] <= YAW_TOLERANCE


def test_tables_are_no_floor_and_shelves_no_ceiling():
    """Horizontal surfaces between floor and ceiling, 3 m2 of them, at 0.75 m and 2 m."""
    boxes = [*room(5, 6), (0.5, 1, 0, 2.5, 2, 0.75), (0.0, 4, 1.7, 1.0, 5, 2.0)]
    frame = _frame(survey(boxes, stations(5, 6), rays=(200, 80)).points)
    assert frame.floor_z == pytest.approx(0, abs=0.02)
    assert frame.ceiling_z == pytest.approx(HEIGHT, abs=0.02)


def test_points_below_the_floor_do_not_lower_it(building):
    rng = np.random.default_rng(3)
    ghosts = rng.uniform([0, 0, -2.5], [8, 5, -0.3], (400, 3))  # reflections in a shiny floor
    assert _frame(np.concatenate([building, ghosts])).floor_z == pytest.approx(0, abs=0.02)


def test_no_ceiling_seen_is_none():
    frame = _frame(survey(room(5, 6, ceiling=False), stations(5, 6), rays=(200, 80)).points)
    assert frame.ceiling_z is None
    assert frame.floor_z == pytest.approx(0, abs=0.02)


def test_a_ceiling_alone_is_no_floor(building):
    frame = _frame(building[building[:, 2] > 0.5])
    assert frame.ceiling_z == pytest.approx(HEIGHT, abs=0.02)
    assert frame.floor_z == pytest.approx(0.5, abs=0.1)


def test_a_forced_yaw_is_taken_as_it_is(building):
    frame = _frame(building @ rotation(10).T, FrameConfig(yaw_deg=12.5, min_support=0.0))
    assert math.degrees(frame.yaw) == pytest.approx(12.5)


def _cylinders(rng: np.random.Generator, count: int) -> np.ndarray:
    parts = []
    for x, y in rng.uniform(-15, 15, (count, 2)):
        angle, radius = rng.uniform(0, 2 * np.pi, 2000), rng.uniform(0.2, 0.6)
        parts.append(
            np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle), rng.uniform(0, 6, 2000)])
        )
    return np.concatenate(parts)


@pytest.mark.parametrize("seed", range(3))
def test_a_sphere_and_a_forest_are_no_manhattan_world(seed):
    rng = np.random.default_rng(seed)
    sphere = rng.normal(size=(60_000, 3))
    sphere *= rng.uniform(2, 5) / np.linalg.norm(sphere, axis=1, keepdims=True)
    ground = np.column_stack([rng.uniform(-15, 15, (60_000, 2)), rng.normal(0, 0.02, 60_000)])
    for cloud in (sphere, np.concatenate([_cylinders(rng, 40), ground])):
        with pytest.raises(NoPlanError, match=r"no Manhattan world: only \d+% of the wall surface.*\.$"):
            _frame(cloud)


@pytest.mark.parametrize("seed", range(3))
def test_walls_at_all_angles_are_no_manhattan_world(seed):
    """Straight walls, but each turned at random."""
    rng = np.random.default_rng(seed)
    walls = []
    for k in range(30):
        a, b = rng.uniform(0, 4, 2000), rng.uniform(0, 2.5, 2000)
        at, angle = rng.uniform(-20, 20, 2), math.radians(3.0 * k + rng.uniform(-1, 1))
        walls.append(np.column_stack([at[0] + a * math.cos(angle), at[1] + a * math.sin(angle), b]))
    with pytest.raises(NoPlanError, match="no Manhattan world"):
        _frame(np.concatenate(walls))


def test_one_horizontal_plane_has_no_walls():
    rng = np.random.default_rng(4)
    plane = np.column_stack([rng.uniform(-5, 5, (60_000, 2)), rng.normal(EYE, 0.01, 60_000)])
    with pytest.raises(NoPlanError, match=r"No walls were found.*2-D scan.*\.$"):
        _frame(plane)


def test_furniture_height_noise_is_no_wall():
    """A pile of points without any surface."""
    with pytest.raises(NoPlanError, match="No walls were found"):
        _frame(np.random.default_rng(5).uniform(-4, 4, (60_000, 3)))

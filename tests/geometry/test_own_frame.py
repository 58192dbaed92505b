"""The own frame turns, moves and tilts with the cloud; a poor cloud has one, too."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.geometry.level_frame import level_rotation
from floorplan_core.geometry.own_frame import own_frame
from tests.box_world import rotation


@pytest.fixture(scope="module")
def office() -> np.ndarray:
    """Floor, ceiling, two walls and a desk of a room of 8 x 5 x 2.7 m, with a centimetre of noise."""
    rng = np.random.default_rng(3)
    u, v = rng.uniform(0, 1, (2, 30_000))
    parts = (
        np.column_stack([8 * u, 5 * v, 0 * u])[:9000],
        np.column_stack([8 * u, 5 * v, 0 * u + 2.7])[9000:16_000],
        np.column_stack([8 * u, 0 * u, 2.7 * v])[16_000:23_000],
        np.column_stack([0 * u, 5 * u, 2.7 * v])[23_000:28_000],
        np.column_stack([5 + 1.6 * u, 2 + 0.8 * v, 0 * u + 0.75])[28_000:],
    )
    return rng.permutation(np.concatenate(parts) + rng.normal(0, 0.01, (30_000, 3)))


@pytest.mark.parametrize("tilt", [(0, 0), (3, 0), (-2, 4), (0, -6)], ids=str)
@pytest.mark.parametrize("yaw", [0.0, 77.0, -160.0])
def test_points_have_the_same_place_in_it_wherever_they_lie(office, yaw, tilt):
    turn, shift = rotation(yaw, *tilt), np.array([4e5, 5.2e6, 300.0])
    one, two = own_frame(office), own_frame(office @ turn.T + shift)
    there = two.move_exactly(office @ turn.T + shift)
    assert np.allclose(one.move_exactly(office), there, atol=1e-6)


def test_it_is_level_where_the_floor_is(office):
    turn = rotation(30, 2, -3)
    up = level_rotation(office @ turn.T - 1.0)[2]
    assert np.degrees(np.arccos(up @ turn[:, 2])) < 0.05


@pytest.mark.parametrize("degrees", [20, 40])
def test_a_slope_is_no_tilted_floor(degrees):
    """Steeper than any instrument stands: heights stay heights."""
    rng = np.random.default_rng(1)
    ramp = np.column_stack([rng.uniform(0, 4, (5000, 2)), rng.normal(0, 0.01, 5000)])
    assert np.array_equal(level_rotation(ramp @ rotation(0, degrees).T), np.eye(3))


def test_where_nothing_is_level_heights_stay_heights():
    rng = np.random.default_rng(1)
    wall = np.column_stack([rng.uniform(0, 4, 5000), rng.normal(0, 0.01, 5000), rng.uniform(0, 2.5, 5000)])
    frame = own_frame(wall)
    assert np.array_equal(frame.rotation[2], [0, 0, 1])


def test_float32_points_are_moved_like_float64(office):
    frame = own_frame(office)
    many = np.tile(office, (5, 1))  # enough for two threads
    assert np.allclose(frame.move(many.astype(np.float32)), frame.move_exactly(many), atol=1e-5)


def test_points_that_are_no_numbers_do_not_count(office):
    frame = own_frame(office)
    holed = np.where(np.arange(len(office))[:, None] % 977 == 3, np.nan, office)
    assert np.allclose(own_frame(holed).rotation, frame.rotation, atol=0.01)

"""Turning distance: analytic cases, invariances, brute force."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.geometry.turning import (
    SQUARE,
    turning_distance,
    turning_distance_between,
    turning_function,
)
from tests.reference.turning import brute_force

L_SHAPE = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2.0]])


def rectangle(ratio: float) -> np.ndarray:
    return np.array([[0, 0], [ratio, 0], [ratio, 1], [0, 1.0]])


def regular(n: int) -> np.ndarray:
    angle = 2 * np.pi * np.arange(n) / n
    return np.column_stack([np.cos(angle), np.sin(angle)])


def star_shaped(rng: np.random.Generator, n: int) -> np.ndarray:
    """A simple polygon around the origin; gaps between corners stay below half a turn."""
    angle = 2 * np.pi * (np.arange(n) + rng.uniform(0, 0.9, n)) / n
    return (rng.uniform(0.3, 2, n) * np.array([np.cos(angle), np.sin(angle)])).T


@pytest.mark.parametrize("scale", [1e-3, 1.0, 37.0])
def test_squares_have_distance_zero(scale):
    assert turning_distance(SQUARE * scale + 5) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("ratio", [1, 1.01, 1.5, 2, 3, 5, 10, 100])
def test_rectangles(ratio):
    """Aligned at a corner, f and g differ by pi/2 along a share w of the boundary."""
    share = ratio / (ratio + 1) - 0.5
    expected = np.pi / 2 * np.sqrt(share * (1 - share))
    assert turning_distance(rectangle(ratio)) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("k", [1, 2, 3, 6])
def test_regular_polygons_of_4k_corners(k):
    """k steps against one in every quarter: the residual takes k values, pi / 2k apart, equally often."""
    expected = np.pi / (2 * k) * np.sqrt((k * k - 1) / 12)
    assert turning_distance(regular(4 * k)) == pytest.approx(expected, abs=1e-9)


def test_a_circle():
    """The residual is uniform on an interval of pi/2 in the limit: its deviation is pi / (2 sqrt 12)."""
    assert turning_distance(regular(400)) == pytest.approx(np.pi / (2 * np.sqrt(12)), rel=1e-4)


def test_l_shape():
    """From the outer corner: 1/4 of 0, 1/8 of 90, 1/8 of 180, 1/8 of 90, 1/8 of 180, 1/4 of 270 degrees.

    The square has 0, 90, 180 and 270 in the quarters: the residual is 0 but for +90 over one eighth and -90
    over another, so that its mean is 0 and its mean square (pi/2)^2 / 4.
    """
    assert turning_distance(L_SHAPE) == pytest.approx(np.pi / 4, abs=1e-9)


@pytest.mark.parametrize("seed", range(12))
def test_brute_force_agrees(seed):
    rng = np.random.default_rng(seed)
    a, b = star_shaped(rng, rng.integers(4, 10)), star_shaped(rng, rng.integers(4, 8))
    assert turning_distance_between(a, b) == pytest.approx(brute_force(a, b, 160), abs=1e-6)


@pytest.mark.parametrize("vertices", [L_SHAPE, regular(3), regular(5), rectangle(2.7)])
def test_brute_force_agrees_on_plain_shapes(vertices):
    assert turning_distance(vertices) == pytest.approx(brute_force(vertices, SQUARE, 120), abs=1e-6)


@given(st.integers(0, 2**32))
@settings(max_examples=60, deadline=None)
def test_invariances(seed):
    rng = np.random.default_rng(seed)
    a, b = star_shaped(rng, rng.integers(4, 12)), star_shaped(rng, rng.integers(4, 12))
    distance = turning_distance_between(a, b)
    turn = rng.uniform(0, 2 * np.pi)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    moved = np.roll(a, rng.integers(len(a)), axis=0) @ rotation.T * rng.uniform(0.1, 50)
    moved += rng.normal(0, 100, 2)
    assert turning_distance_between(moved, b) == pytest.approx(distance, abs=1e-6)
    assert turning_distance_between(moved[::-1], b) == pytest.approx(distance, abs=1e-6)
    assert turning_distance_between(b, a) == pytest.approx(distance, abs=1e-6)
    assert turning_distance_between(a, moved) == pytest.approx(0, abs=1e-6)


@given(st.integers(0, 2**32))
@settings(max_examples=40, deadline=None)
def test_duplicate_and_collinear_vertices_change_nothing(seed):
    rng = np.random.default_rng(seed)
    polygon = star_shaped(rng, rng.integers(4, 9))
    after = np.roll(polygon, -1, axis=0)
    between = polygon + rng.uniform(0.1, 0.9, (len(polygon), 1)) * (after - polygon)
    fuller = np.stack([polygon, between, between, after], axis=1).reshape(-1, 2)
    assert turning_distance(fuller) == pytest.approx(turning_distance(polygon), abs=1e-6)


def test_a_turning_function_gains_one_turn():
    places, angles = turning_function(L_SHAPE)
    assert places == pytest.approx(np.array([0, 2, 3, 4, 5, 6]) / 8)
    assert angles == pytest.approx(np.array([0, 1, 2, 1, 2, 3]) * np.pi / 2)


@pytest.mark.parametrize("vertices", [np.empty((0, 2)), [[1, 1]], [[0, 0], [1, 0]], [[0, 0], [1, 0], [2, 0]]])
def test_what_is_no_polygon_is_refused(vertices):
    with pytest.raises(ValueError, match="has no turning function"):
        turning_distance(np.array(vertices, dtype=float))

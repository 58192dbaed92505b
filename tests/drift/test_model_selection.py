"""One axis: a run along a corridor of rooms, whose path drifts and comes back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.drift.model_selection import AxisProblem, least_squares, part_misfits, solve_axis

REACHES = (0.1, 0.3, 1.0)


def corridor(
    seed: int, drift: float, noise: float = 0.01, walls: int = 8
) -> tuple[AxisProblem, np.ndarray, np.ndarray]:
    """There and back past ``walls`` walls 3 m apart; each is seen from within 4 m. (problem, path, walls)."""
    rng = np.random.default_rng(seed)
    length = 3.0 * (walls - 1)
    path = np.concatenate([np.arange(0, length), np.arange(length, 0, -1)])
    offsets = 3.0 * np.arange(walls) + rng.uniform(-0.4, 0.4, walls)
    error = drift * np.sin(np.linspace(0, np.pi / 2, len(path))) ** 2
    seen = np.abs(offsets[None] - path[:, None]) < 4.0
    keyframe, wall = np.nonzero(seen)
    distance = offsets[wall] - path[keyframe] + rng.normal(0, noise, len(wall))
    step = np.diff(path + error)
    facing = np.where(distance > 0, -1, 1)
    extent = np.tile([0.0, 0.0], (len(wall), 1))
    problem = AxisProblem(
        step,
        np.full(len(step), 0.05),
        keyframe,
        distance,
        np.full(len(wall), 50.0),
        facing,
        extent,
        extent + 2.0,
    )
    return problem, path, 2 * wall + (facing > 0)


@pytest.mark.parametrize("drift", [0.0, 0.2, 0.6, 0.9])
def test_the_path_comes_back_to_the_walls_that_it_saw_before(drift: float) -> None:
    problem, path, truth = corridor(3, drift)
    positions, plane = solve_axis(problem, REACHES)
    assert np.abs(positions - (path - path[0])).max() < 0.03
    pairs = {(int(a), int(b)) for a, b in zip(plane, truth, strict=True)}
    assert len(pairs) == len(set(truth.tolist())) == plane.max() + 1  # one plane a face, and no other


def test_without_model_selection_the_drift_stays() -> None:
    problem, path, _ = corridor(3, 0.6)
    positions, _ = least_squares(problem, np.arange(len(problem.distance)))
    assert np.abs(positions - path).max() > 0.5


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 1000), st.floats(0.0, 0.8))
def test_no_two_walls_become_one_and_no_wall_two(seed: int, drift: float) -> None:
    problem, path, truth = corridor(seed, drift)
    positions, plane = solve_axis(problem, REACHES)
    for number in range(int(plane.max()) + 1):
        assert len(set(truth[plane == number].tolist())) == 1
    assert np.abs(positions - (path - path[0])).max() < 0.05


def test_a_sighting_off_its_plane_becomes_its_own() -> None:
    problem, _, truth = corridor(1, 0.0)
    wrong = problem.distance.copy()
    wrong[5] += 0.3
    bent = AxisProblem(**{**problem.__dict__, "distance": wrong})
    plane = np.unique(truth, return_inverse=True)[1]
    positions, offsets = least_squares(problem, plane)
    parted = part_misfits(bent, plane, positions, offsets)
    assert parted.max() == plane.max() + 1
    assert np.sum(parted == parted[5]) == 1

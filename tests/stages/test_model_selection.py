"""The fewest planes: a sweep against all ways of piercing."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.stages.model_selection import pierce_intervals

INTERVALS = st.lists(st.tuples(st.integers(0, 20), st.integers(0, 7)), min_size=1, max_size=9)


def _fewest(low: np.ndarray, high: np.ndarray) -> int:
    """Try every set of points; right ends suffice, since any point can move right to the next one."""
    for size in range(1, len(low) + 1):
        for points in combinations(np.unique(high), size):
            at = np.array(points)[:, None]
            if ((low <= at) & (at <= high)).any(axis=0).all():
                return size
    raise AssertionError("unreachable: each interval's own right end pierces it")


@settings(max_examples=300)
@given(INTERVALS)
def test_the_number_of_groups_is_the_smallest_possible(intervals):
    low = np.array([a for a, _ in intervals], dtype=float) / 4
    high = low + np.array([n for _, n in intervals]) / 4
    group = pierce_intervals(low, high)
    assert group.max() + 1 == _fewest(low, high)
    for k in range(group.max() + 1):
        assert low[group == k].max() <= high[group == k].min()  # they share a point


@given(INTERVALS)
def test_groups_are_numbered_by_offset_and_do_not_depend_on_order(intervals):
    low = np.array([a for a, _ in intervals], dtype=float)
    high = low + np.array([n for _, n in intervals])
    group = pierce_intervals(low, high)
    ends = [high[group == k].min() for k in range(group.max() + 1)]
    assert ends == sorted(ends)
    order = np.random.default_rng(len(intervals)).permutation(len(low))
    assert np.array_equal(pierce_intervals(low[order], high[order]), group[order])


def test_touching_intervals_are_one_group():
    assert pierce_intervals(np.array([0.0, 1.0]), np.array([1.0, 2.0])).tolist() == [0, 0]


def test_no_intervals_no_groups():
    assert len(pierce_intervals(np.zeros(0), np.zeros(0))) == 0


def test_planes_farther_apart_than_the_tolerance_stay_two():
    """Offsets of one facing, 12 cm apart with a tolerance of 5 cm, stay two planes; 8 cm apart become one."""
    for gap, groups in ((0.12, 2), (0.08, 1)):
        offset = np.array([1.0, 1.0 + gap])
        assert pierce_intervals(offset - 0.05, offset + 0.05).max() + 1 == groups

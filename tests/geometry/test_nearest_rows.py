"""Nearest rows against a plain search."""

import numpy as np

from floorplan_core.geometry.nearest_rows import nearest


def plainly(values, rows, tolerance):
    away = np.abs(rows[None] - values[:, None])
    best = away.argmin(axis=1)  # the first of equal ones
    return np.where(away[np.arange(len(values)), best] <= tolerance, best, -1)


def test_rows_as_by_a_plain_search():
    rng = np.random.default_rng(3)
    rows = np.unique(rng.integers(0, 400, 60) / 4.0)
    for values in (np.sort(rng.uniform(-5, 105, 500)), rng.integers(-20, 420, 500) / 4.0, rows, rows[::-1]):
        np.testing.assert_array_equal(nearest(values.copy(), rows, 0.6), plainly(values, rows, 0.6))


def test_what_is_no_number_and_no_rows():
    values = np.array([1.0, np.nan, 2.0, np.inf, -np.inf, 1.4])
    assert nearest(values, np.array([1.0, 2.0]), 0.5).tolist() == [0, -1, 1, -1, -1, 0]
    assert nearest(values, np.empty(0), 0.5).tolist() == [-1] * 6
    assert nearest(values, np.array([2.0]), 0.5).tolist() == [-1, -1, 0, -1, -1, -1]

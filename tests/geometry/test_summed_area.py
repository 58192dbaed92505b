"""Summed-area tables and the rule which cells an interval holds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.geometry.summed_area import count, first_cells, summed_area


@given(st.integers(0, 2**32))
def test_counts_equal_slices(seed):
    rng = np.random.default_rng(seed)
    mask = rng.random(rng.integers(0, 9, 2)) < 0.5
    r0, c0 = rng.integers(-3, 12, 2)
    r1, c1 = r0 + rng.integers(-2, 9), c0 + rng.integers(-2, 9)
    expected = mask[max(r0, 0) : max(r1, 0), max(c0, 0) : max(c1, 0)].sum()
    assert count(summed_area(mask), (r0, r1), (c0, c1)) == expected


@pytest.mark.parametrize("cell", [0.1, 0.05, 0.25, 1 / 3])
@pytest.mark.parametrize("origin", [0.0, -7.3, 1234.567])
def test_a_centre_belongs_to_the_interval_that_begins_at_it(cell, origin):
    cells = np.arange(-50, 50)
    centres = origin + cell * (cells + 0.5)
    assert (first_cells(centres, origin, cell) == cells).all()
    assert (first_cells(np.nextafter(centres, np.inf), origin, cell) == cells + 1).all()
    assert (first_cells(np.nextafter(centres, -np.inf), origin, cell) == cells).all()


def test_adjacent_intervals_share_no_cell():
    lines = np.sort(np.random.default_rng(0).uniform(-3, 3, 50))
    first = first_cells(lines, 0.0, 0.1)
    centres = 0.1 * (np.arange(-40, 40) + 0.5)
    for k in range(len(lines) - 1):
        inside = np.count_nonzero((centres >= lines[k]) & (centres < lines[k + 1]))
        assert first[k + 1] - first[k] == inside

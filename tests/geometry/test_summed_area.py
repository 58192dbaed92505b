"""Counts between lines and the rule which cells an interval holds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.geometry.summed_area import block_counts, first_cells


@given(st.integers(0, 2**32))
def test_blocks_equal_slices(seed):
    rng = np.random.default_rng(seed)
    mask = rng.random(rng.integers(0, 9, 2)) < 0.5
    rows, columns = (np.sort(rng.integers(0, n + 1, rng.integers(0, 6))) for n in mask.shape)
    found = block_counts(mask, rows, columns)
    assert found.shape == (max(len(rows) - 1, 0), max(len(columns) - 1, 0))
    for i in range(found.shape[0]):
        for j in range(found.shape[1]):
            assert found[i, j] == mask[rows[i] : rows[i + 1], columns[j] : columns[j + 1]].sum()


def test_blocks_of_a_view():
    mask = np.random.default_rng(0).random((12, 12)) < 0.5
    lines = np.array([0, 2, 6])
    assert (
        block_counts(mask[::2, ::2].T, lines, lines) == block_counts(mask[::2, ::2], lines, lines).T
    ).all()


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

"""Columns of height bits, and chains of surface columns."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.geometry.columns import (
    LEVEL,
    LEVELS,
    count_bits,
    facing_columns,
    height_mask,
    hit_columns,
    link_chains,
    popcount,
    surface_cells,
    surface_offsets,
)

CELL = 0.05


@given(a=st.integers(-5, 70), b=st.integers(-5, 70))
def test_height_mask_holds_the_levels_between_two_heights(a, b):
    bits = int(height_mask(a * LEVEL, b * LEVEL))
    assert [k for k in range(64) if bits >> k & 1] == list(range(max(a, 0), min(b, LEVELS)))


def test_height_mask_leaves_out_levels_that_are_cut():
    assert int(height_mask(0.05, 0.35)) == 0b110
    assert int(height_mask(0.31, 0.39)) == 0


@given(st.lists(st.integers(0, 2**64 - 1), min_size=1, max_size=50))
def test_bits_are_counted(words):
    expected = [w.bit_count() for w in words]
    assert count_bits(np.array(words, dtype=np.uint64)).tolist() == expected
    assert [int(popcount(np.uint64(w))) for w in words] == expected


def test_hit_columns_against_plain_python():
    rng = np.random.default_rng(1)
    xyz = rng.uniform([-1, -1, -0.5], [3, 2, 7], (3000, 3))
    origin = np.array([-0.5, -0.4])
    expected = np.zeros((40, 60), dtype=np.uint64)
    for x, y, z in xyz:
        ix, iy, k = (int(np.floor(v)) for v in ((x + 0.5) / CELL, (y + 0.4) / CELL, z / LEVEL))
        if 0 <= ix < 60 and 0 <= iy < 40 and 0 <= k < LEVELS:
            expected[iy, ix] |= np.uint64(1 << k)
    found = np.zeros((40, 60), dtype=np.uint64)
    hit_columns(xyz, origin, CELL, found)
    assert np.array_equal(found, expected)


def test_what_lies_just_below_the_floor_is_of_its_level():
    xyz = np.array([(0.5 * CELL, 0.01, -0.001), (1.5 * CELL, 0.01, -0.02), (2.5 * CELL, 0.01, 0.15)])
    for below, expected in ((0.0, [0, 0, 2]), (0.01, [1, 0, 2])):
        found = np.zeros((1, 3), dtype=np.uint64)
        hit_columns(xyz, np.zeros(2), CELL, found, below)
        assert found[0].tolist() == expected


def _wall(offset: float, facing: float, slope: float = 0.0, rows: int = 40, seed: int = 0):
    """Points of a wall across u, at ``offset`` and turned by ``slope``, seen from the side of ``facing``."""
    rng = np.random.default_rng(seed)
    v, z = np.meshgrid(np.arange(0.01, rows * CELL, 0.02), np.arange(0.05, 2.5, 0.05))
    v, z = v.ravel(), z.ravel()
    u = offset + slope * v + rng.normal(0, 0.004, len(v))
    return u, v, z, np.full(len(v), facing)


def _offsets(*walls, nv=40, nu=60):
    u, v, z, toward = (np.concatenate(parts) for parts in zip(*walls, strict=True))
    xyz, row = np.column_stack([u, v, z]), np.arange(len(u), dtype=np.int32)
    column = np.floor(xyz[:, :2] / CELL).astype(np.int32)
    level = np.floor(z / LEVEL).astype(np.uint8)
    bits, sums = facing_columns(xyz, row, column, level, toward > 0.03, 0, np.zeros(2), CELL, 0, nv, nu)
    return bits, surface_offsets(bits, sums, height_mask(0.2, 2.4), CELL, 3, np.tan(np.radians(15)), 8.0)


def test_only_points_seen_from_the_facings_side_count():
    bits, _ = _offsets(_wall(1.02, 0.8), _wall(1.12, -0.8))
    columns = np.flatnonzero(bits.any(axis=0)) * CELL
    assert columns.min() > 0.95
    assert columns.max() < 1.06


def test_surface_offsets_are_finer_than_the_grid():
    _, offsets = _offsets(_wall(1.0312, 0.8))
    found = offsets[5:-5][~np.isnan(offsets[5:-5])] * CELL
    assert len(found) >= 30
    assert found == pytest.approx(1.0312, abs=0.004)


@pytest.mark.parametrize("slope", [np.tan(np.radians(30)), np.tan(np.radians(45))])
def test_slanted_surfaces_have_no_offset(slope):
    _, offsets = _offsets(_wall(0.5, 0.8, slope), nu=80)
    assert np.isnan(offsets[5:-5]).all()


def test_a_post_is_no_surface():
    u, v, z, toward = _wall(1.0, 0.8, rows=3)
    _, offsets = _offsets((u, v, z, toward))
    assert np.isnan(offsets).all()


def _chains(offsets, gap=8, tolerance=1.2):
    bits = np.where(np.isnan(offsets), np.uint64(0), np.uint64(0b1110)).astype(np.uint64)
    cells = surface_cells(offsets.astype(np.float32), bits, 0, 0, len(offsets))
    return link_chains(*cells, len(offsets), tolerance, gap)


def _rows(*runs, nv=60, nu=40):
    out = np.full((nv, nu), np.nan)
    for start, end, offset in runs:
        out[start:end, int(offset)] = offset
    return out


def test_two_walls_are_two_chains_whose_nodes_run_along_them():
    node, offset, bits, chains = _chains(_rows((0, 60, 10.2), (5, 30, 14.6)))
    assert chains == 2
    for chain, rows, at in ((0, range(60), 10.2), (1, range(5, 30), 14.6)):
        mine = node[:, 0] == chain
        assert node[mine, 1].tolist() == list(rows)
        assert offset[mine] == pytest.approx(at, abs=1e-5)
    assert (bits == 0b1110).all()


@pytest.mark.parametrize(("missing", "chains"), [(7, 1), (9, 2)])
def test_gaps_up_to_the_limit_are_bridged(missing, chains):
    assert _chains(_rows((0, 20, 10.2), (20 + missing, 50, 10.2)), gap=8)[3] == chains


@pytest.mark.parametrize(("step", "chains"), [(0.9, 1), (1.5, 2)])
def test_a_step_beyond_the_tolerance_starts_another_chain(step, chains):
    assert _chains(_rows((0, 30, 10.2), (30, 60, 10.2 + step)))[3] == chains


def test_a_slow_drift_does_not_run_away():
    """A curved wall must not become one segment: the chain's own mean holds it."""
    runs = [(k, k + 1, 5 + 0.2 * k) for k in range(60)]
    assert _chains(_rows(*runs))[3] > 3


def test_more_nodes_than_the_table_starts_with():
    nv = 1500
    runs = [(0, nv, u + 0.5) for u in (3, 9, 15, 21)]
    node, _, _, chains = _chains(_rows(*runs, nv=nv))
    assert chains == 4
    assert len(node) == 4 * nv
    assert np.bincount(node[:, 0]).tolist() == [nv] * 4

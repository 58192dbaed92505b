"""Sums of the points of each voxel: exact, whatever the chunks, whatever the points."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.geometry.surfel_map import MOST_POINTS, STEPS, SurfelMap

SIZE = 0.05
LIMITS = (0.05, 30.0)
NO_ORIGIN = np.zeros((0, 3))


def _filled(points: np.ndarray, pieces: int = 1, scan: np.ndarray | None = None, origins=NO_ORIGIN):
    scan = np.full(len(points), -1, dtype=np.int32) if scan is None else scan
    table = SurfelMap(SIZE)
    for part, ids in zip(np.array_split(points, pieces), np.array_split(scan, pieces), strict=True):
        table.insert(part, ids, origins, LIMITS)
    return table


def _reference(points: np.ndarray) -> dict[tuple[int, ...], np.ndarray]:
    """Points of each voxel, quantised as the map does: to the middle of one of STEPS parts a side."""
    cells = np.floor(points * (1 / SIZE)).astype(int)
    parts = ((points * (1 / SIZE) - cells) * STEPS).astype(int)
    out: dict[tuple[int, ...], list[np.ndarray]] = {}
    for cell, part in zip(cells, parts, strict=True):
        out.setdefault(tuple(cell), []).append((cell + (part + 0.5) / STEPS) * SIZE)
    return {cell: np.array(mine) for cell, mine in out.items()}


def test_sums_equal_those_of_numpy():
    points = np.random.default_rng(1).normal(0, 0.3, (6_000, 3))
    surfels = _filled(points).surfels()
    expected = _reference(points)
    assert len(surfels) == len(expected)
    for k, cell in enumerate(map(tuple, np.floor(surfels.centroid / SIZE).astype(int))):
        mine = expected[cell]
        assert surfels.count[k] == len(mine)
        assert surfels.centroid[k] == pytest.approx(mine.mean(axis=0), abs=1e-9)
        cov = np.cov(mine[:, :2].T, bias=True).reshape(2, 2)
        assert surfels.variance[k] == pytest.approx([cov[0, 0], cov[0, 1], cov[1, 1]], abs=1e-12)


def test_quantisation_moves_a_centroid_by_less_than_half_a_step():
    points = np.random.default_rng(2).uniform(-40, 40, (3000, 3))
    surfels = _filled(points).surfels()
    alone = surfels.count == 1
    nearest = np.abs(points[:, None, 0] - surfels.centroid[alone][None, :50, 0]).min(axis=0)
    assert nearest.max() <= 0.5 * SIZE / STEPS + 1e-9


@given(pieces=st.integers(1, 40), seed=st.integers(0, 2**16), spread=st.sampled_from([0.1, 2.0, 50.0]))
def test_chunks_do_not_change_a_bit(pieces, seed, spread):
    rng = np.random.default_rng(seed)
    points = rng.normal(0, spread, (2000, 3))
    scan = rng.integers(-1, 3, 2000).astype(np.int32)
    origins = rng.normal(0, 1, (3, 3))
    whole, parts = (_filled(points, n, scan, origins).surfels() for n in (1, pieces))
    for name in ("centroid", "count", "variance", "view"):
        assert getattr(whole, name).tobytes() == getattr(parts, name).tobytes(), name


def test_order_of_points_changes_only_the_order_of_rows():
    rng = np.random.default_rng(3)
    points = rng.normal(0, 0.2, (5000, 3))
    a, b = _filled(points).surfels(), _filled(rng.permutation(points)).surfels()
    rows = [np.lexsort(s.centroid.T) for s in (a, b)]
    assert np.array_equal(a.centroid[rows[0]], b.centroid[rows[1]])
    assert np.array_equal(a.variance[rows[0]], b.variance[rows[1]])


def test_growth_keeps_every_voxel():
    points = np.stack(np.meshgrid(*[np.arange(55) * SIZE + 0.01] * 3, indexing="ij"), -1).reshape(-1, 3)
    assert len(points) > 2 * (1 << 16)  # the table starts with 65,536 rows: it grows twice
    table = _filled(points, 7)
    assert len(table) == table.points == len(points)
    table.insert(points, np.full(len(points), -1, dtype=np.int32), NO_ORIGIN, LIMITS)  # found again
    assert len(table) == len(points)
    assert (table.surfels().count == 2).all()


def test_what_is_no_point_is_left_out():
    good = np.array([[1.0, 2.0, 3.0]])
    bad = np.array(
        [[np.nan, 0, 0], [0, np.inf, 0], [0, 0, -np.inf], [1e9, 0, 0], [0, -1e30, 0], [0, 0, 60_000.0]]
    )
    table = _filled(np.concatenate([bad, good, bad]))
    assert len(table) == table.points == 1
    assert table.surfels().centroid[0] == pytest.approx(good[0], abs=SIZE / STEPS)


def test_points_out_of_range_of_their_sensor_are_left_out():
    points = np.array([[0.01, 0, 0], [1.0, 0, 0], [29.9, 0, 0], [30.1, 0, 0]])
    table = _filled(points, scan=np.zeros(4, dtype=np.int32), origins=np.zeros((1, 3)))
    assert table.points == 2


def test_view_is_the_mean_direction_to_the_sensor():
    points = np.full((3, 3), 0.01)
    origins = np.array([[5.01, 0.01, 0.01], [0.01, 5.01, 0.01]])
    scan = np.array([0, 1, -1], dtype=np.int32)  # the last one has no sensor: it looks nowhere
    view = _filled(points, scan=scan, origins=origins).surfels().view[0]
    assert view == pytest.approx([1 / 3, 1 / 3], abs=0.01)


def test_a_voxel_that_is_hit_without_end_does_not_overflow():
    points = np.full((MOST_POINTS + 5000, 3), SIZE * 0.999)
    surfels = _filled(points, 3).surfels()
    assert surfels.count[0] == MOST_POINTS
    assert surfels.centroid[0] == pytest.approx([SIZE * 0.995] * 3, abs=1e-9)
    assert surfels.variance[0] == pytest.approx([0, 0, 0], abs=1e-9)


def test_no_points_no_surfels():
    assert len(_filled(np.zeros((0, 3))).surfels()) == 0

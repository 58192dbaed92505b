"""Voxel centres are recognised and made dense; measured points are left alone."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.geometry.lattice import lattice_spacing, subdivide


def _shell(spacing: float, origin=(0.0, 0.0, 0.0)) -> np.ndarray:
    """Centres of the voxels of a room's surfaces."""
    x, y, z = (np.arange(n) for n in (50, 40, 30))
    grid = np.stack(np.meshgrid(x, y, z, indexing="ij"), -1).reshape(-1, 3)
    edge = ((grid == 0) | (grid == [49, 39, 29])).any(axis=1)
    return (grid[edge] + 0.5) * spacing + origin


@pytest.mark.parametrize("spacing", [0.03, 0.05, 0.08, 0.1, 0.2])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_the_spacing_of_voxel_centres_is_found(spacing, dtype):
    points = _shell(spacing, (12.3, -4.56, 1.0)).astype(dtype)
    assert lattice_spacing(points) == pytest.approx(spacing, abs=2e-4)


def test_measured_points_lie_on_no_lattice():
    rng = np.random.default_rng(1)
    for points in (_shell(0.1) + rng.normal(0, 0.02, (len(_shell(0.1)), 3)), rng.uniform(0, 9, (5000, 3))):
        assert lattice_spacing(points) == 0.0


def test_too_few_points_tell_nothing():
    assert lattice_spacing(_shell(0.1)[:400]) == 0.0
    assert lattice_spacing(np.full((5000, 3), np.nan)) == 0.0
    assert lattice_spacing(np.zeros((5000, 3))) == 0.0


def test_points_that_are_not_finite_do_not_hide_the_lattice():
    points = np.concatenate([[[np.nan, 0, 0], [np.inf, 1, 2]], _shell(0.08)])
    assert lattice_spacing(points) == pytest.approx(0.08, abs=2e-4)


@pytest.mark.parametrize(
    ("spacing", "finest", "parts"), [(0.08, 0.05, 2), (0.1, 0.05, 2), (0.2, 0.05, 4), (0.05, 0.05, 1)]
)
def test_parts_fill_their_voxel_and_nothing_else(spacing, finest, parts):
    points = np.array([[1.0, 2.0, 3.0], [-1.0, 0.0, 0.5]])
    dense = subdivide(points, spacing, finest)
    assert dense.shape == (2 * parts**3, 3)
    for point, mine in zip(points, dense.reshape(2, -1, 3), strict=True):
        assert mine.mean(axis=0) == pytest.approx(point)
        assert np.abs(mine - point).max() <= spacing / 2 - spacing / parts / 2 + 1e-12
        for axis in range(3):
            steps = np.diff(np.unique(np.round(mine[:, axis], 9)))
            assert (steps <= finest + 1e-9).all()
    assert len(np.unique(np.round(dense, 9), axis=0)) == len(dense)

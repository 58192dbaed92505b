"""Normals from moments: planes give theirs, clutter gives none."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.geometry.cell_normals import fit_cell_normals

CELL, PLANARITY = 0.25, 0.15


def _patch(normal: np.ndarray, rng: np.random.Generator, noise: float = 0.004) -> np.ndarray:
    """(N, 3) points of a 3 x 3 m plane through (1, 1, 1)."""
    normal = normal / np.linalg.norm(normal)
    a = np.cross(normal, [0.31, 0.5, 0.8])
    a /= np.linalg.norm(a)
    uv = rng.uniform(-1.5, 1.5, (6000, 2))
    return 1.0 + uv[:, :1] * a + uv[:, 1:] * np.cross(normal, a) + rng.normal(0, noise, (6000, 1)) * normal


@pytest.mark.parametrize("normal", [(1, 0, 0), (0, 0, 1), (1, 1, 0), (1, 2, 3), (0.1, -1, 0.2)])
def test_cells_of_a_plane_have_its_normal(normal):
    normal = np.array(normal, dtype=float)
    points = _patch(normal, np.random.default_rng(1))
    cells = fit_cell_normals(points, CELL, PLANARITY)
    assert len(cells.normal) > 50
    assert np.linalg.norm(cells.normal, axis=1) == pytest.approx(1.0)
    cosine = np.abs(cells.normal @ (normal / np.linalg.norm(normal)))
    big = cells.weight > 30
    assert np.degrees(np.arccos(np.minimum(cosine[big], 1))).max() < 5
    assert np.abs((cells.centre - 1) @ normal / np.linalg.norm(normal)).max() < 0.01


def test_weights_count_the_surfels_of_each_cell():
    points = _patch(np.array([0.0, 1.0, 0.2]), np.random.default_rng(2))
    cells = fit_cell_normals(points, CELL, PLANARITY)
    counted = np.bincount(cells.cell_of[cells.cell_of >= 0], minlength=len(cells.weight))
    assert np.array_equal(counted, cells.weight)
    k = int(np.argmax(cells.weight))
    assert cells.centre[k] == pytest.approx(points[cells.cell_of == k].mean(axis=0))


def test_a_cloud_without_surfaces_has_no_planar_cells():
    points = np.random.default_rng(3).uniform(0, 3, (60_000, 3))
    assert len(fit_cell_normals(points, CELL, PLANARITY).normal) == 0


def test_scattered_points_do_not_fix_a_plane():
    points = np.random.default_rng(4).uniform(0, 30, (500, 3))
    cells = fit_cell_normals(points, CELL, PLANARITY)
    assert len(cells.normal) == 0
    assert (cells.cell_of == -1).all()


def test_thinning_takes_whole_cells():
    points = _patch(np.array([0.0, 0.0, 1.0]), np.random.default_rng(5))
    everything = fit_cell_normals(points, CELL, PLANARITY)
    few = fit_cell_normals(points, CELL, PLANARITY, most=60)
    assert 0 < len(few.normal) < len(everything.normal)
    known = {tuple(c) for c in everything.centre}
    assert all(tuple(c) in known for c in few.centre)

"""Cells and polygons are each other's exact inverse."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from floorplan_core.geometry.raster import cells_to_polygon, polygon_mask

ORIGIN = np.array([-1.3, 2.7])
CELL = 0.1


@pytest.mark.parametrize("seed", range(25))
@pytest.mark.parametrize("density", [0.2, 0.5, 0.8])
def test_random_masks_come_back_and_are_valid(seed: int, density: float) -> None:
    mask = np.random.default_rng(seed).random((13, 17)) < density
    polygon = cells_to_polygon(mask, ORIGIN, CELL)
    assert polygon.is_valid
    assert polygon.area == pytest.approx(mask.sum() * CELL**2)
    assert np.array_equal(polygon_mask(polygon, ORIGIN, CELL, mask.shape), mask)


def test_empty_and_full() -> None:
    assert cells_to_polygon(np.zeros((3, 4), dtype=bool), ORIGIN, CELL).is_empty
    full = cells_to_polygon(np.ones((3, 4), dtype=bool), ORIGIN, CELL)
    assert full.bounds == pytest.approx((-1.3, 2.7, -0.9, 3.0))
    assert len(full.geoms) == 1
    assert len(full.geoms[0].exterior.coords) == 5


def test_mask_agrees_with_point_in_polygon_off_the_boundary() -> None:
    polygon = shapely.Polygon(
        [(0, 0), (4.03, 0.51), (3.1, 3.33), (0.7, 2.9)], [[(1, 1), (2, 1.1), (1.7, 2.03)]]
    )
    origin, shape = np.array([-0.5, -0.5]), (40, 50)
    gx, gy = np.meshgrid(
        origin[0] + CELL * (np.arange(shape[1]) + 0.5), origin[1] + CELL * (np.arange(shape[0]) + 0.5)
    )
    expected = shapely.contains_xy(polygon, gx, gy)
    near = shapely.distance(polygon.boundary, shapely.points(gx, gy)) < 1e-9
    got = polygon_mask(polygon, origin, CELL, shape)
    assert np.array_equal(got | near, expected | near)


def test_polygon_beyond_the_grid_is_cropped() -> None:
    mask = polygon_mask(shapely.box(-10, -10, 10, 10), np.zeros(2), 1.0, (3, 3))
    assert mask.all()
    assert not polygon_mask(shapely.box(5, 5, 6, 6), np.zeros(2), 1.0, (3, 3)).any()


def test_adjacent_polygons_never_share_a_cell() -> None:
    left, right = shapely.box(0, 0, 0.55, 1), shapely.box(0.55, 0, 1, 1)
    masks = [polygon_mask(p, np.zeros(2), CELL, (10, 10)) for p in (left, right)]
    assert not (masks[0] & masks[1]).any()
    assert (masks[0] | masks[1]).all()

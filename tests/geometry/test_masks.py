"""Patches, distances, widening and lines against plain references."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from floorplan_core.geometry.masks import (
    distance_to_gap,
    label_patches,
    line_cells,
    opened,
    patch_boxes,
    widened,
)

RNG = np.random.default_rng(7)
MASKS = [RNG.random((23, 31)) < share for share in (0.0, 0.2, 0.5, 0.6, 0.9, 1.0)]
MASKS.append(ndimage.gaussian_filter(RNG.normal(size=(60, 50)), 2) > 0)


@pytest.mark.parametrize("connectivity", [4, 8])
@pytest.mark.parametrize("mask", MASKS)
def test_patches_are_numbered_in_row_order(mask, connectivity):
    structure = np.ones((3, 3)) if connectivity == 8 else None
    wanted, many = ndimage.label(mask, structure)
    labels, count = label_patches(mask, connectivity)
    assert count == many
    assert np.array_equal(labels, wanted)


@pytest.mark.parametrize("mask", MASKS)
def test_boxes_hold_their_patches(mask):
    labels, count = label_patches(mask)
    boxes = [
        [s[1].start, s[0].start, s[1].stop - s[1].start, s[0].stop - s[0].start]
        for s in ndimage.find_objects(labels)
    ]
    assert patch_boxes(labels, count).tolist() == boxes


@pytest.mark.parametrize("mask", MASKS)
def test_widening_and_opening(mask):
    square = np.ones((3, 3), dtype=bool)
    assert np.array_equal(widened(mask), ndimage.binary_dilation(mask, square))
    narrow = ndimage.binary_erosion(mask, square, border_value=1)
    assert np.array_equal(opened(mask), ndimage.binary_dilation(narrow, square))


@pytest.mark.parametrize("mask", MASKS[:-2] + MASKS[-1:])
def test_distances_are_within_two_percent(mask):
    wanted = ndimage.distance_transform_edt(mask)
    assert np.allclose(distance_to_gap(mask), wanted, rtol=0.02, atol=1e-9)


def test_a_mask_without_gap_is_far_from_any():
    assert (distance_to_gap(np.ones((4, 6), dtype=bool)) == 10).all()


@pytest.mark.parametrize("ends", [(0, 0, 9, 3), (9, 3, 0, 0), (2, 8, 2, 1), (5, 5, 5, 5), (1, 7, 6, 2)])
def test_lines_stop_every_ray(ends):
    y, x = line_cells(*ends)
    assert (x[0], y[0], x[-1], y[-1]) == ends
    assert (np.abs(np.diff(x)) + np.abs(np.diff(y)) == 1).all()
    a, b = np.array(ends[:2]), np.array(ends[2:])
    across = np.array([b[1] - a[1], a[0] - b[0]]) / max(np.hypot(*(b - a)), 1)
    assert np.abs((np.column_stack([x, y]) - a) @ across).max() <= 1

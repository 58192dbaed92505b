"""Patches, distances and widening against plain references."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from floorplan_core.geometry.masks import (
    distance_to_gap,
    label_patches,
    measure_patches,
    opened,
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


@pytest.mark.parametrize("connectivity", [4, 8])
@pytest.mark.parametrize("mask", MASKS)
def test_boxes_hold_their_patches(mask, connectivity):
    labels, patches = measure_patches(mask, connectivity)
    assert np.array_equal(labels, label_patches(mask, connectivity)[0])
    boxes = [
        [s[1].start, s[0].start, s[1].stop - s[1].start, s[0].stop - s[0].start]
        for s in ndimage.find_objects(labels)
    ]
    assert patches[:, :4].tolist() == boxes
    assert patches[:, 4].tolist() == np.bincount(labels.ravel())[1:].tolist()


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


def test_a_grid_without_cells_has_nothing():
    empty = np.zeros((0, 4), dtype=bool)
    assert label_patches(empty)[1] == len(measure_patches(empty)[1]) == 0
    for function in (widened, opened, distance_to_gap):
        assert function(empty).shape == (0, 4)


def test_neither_threads_nor_memory_layout_change_a_result():
    import cv2

    mask = ndimage.gaussian_filter(RNG.normal(size=(400, 300)), 2) > 0
    threads = cv2.getNumThreads()
    try:
        for count in (1, 2, 4):
            cv2.setNumThreads(count)
            for connectivity in (4, 8):
                wanted = ndimage.label(mask, np.ones((3, 3)) if connectivity == 8 else None)[0]
                assert np.array_equal(label_patches(mask, connectivity)[0], wanted)
                assert np.array_equal(label_patches(mask[::2].T, connectivity)[0] > 0, mask[::2].T)
            assert np.array_equal(distance_to_gap(mask.T).T, distance_to_gap(mask))
    finally:
        cv2.setNumThreads(threads)

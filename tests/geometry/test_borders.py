"""Border following, simplified rings and smallest boxes."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from floorplan_core.geometry.borders import find_borders, simplified, smallest_box
from floorplan_core.geometry.masks import label_patches, widened


def test_a_block_with_a_hole_has_two_borders():
    mask = np.zeros((6, 7), dtype=bool)
    mask[1:5, 1:6] = True
    mask[2:4, 3] = False
    outer, hole = find_borders(mask)
    assert (outer.hole, hole.hole) == (False, True)
    assert len(outer.cells) == 14
    assert {tuple(c) for c in hole.cells.tolist()} == {(2, 2), (2, 3), (3, 1), (3, 4), (4, 2), (4, 3)}


def test_a_line_is_walked_there_and_back():
    mask = np.zeros((3, 5), dtype=bool)
    mask[1, 1:4] = True
    (border,) = find_borders(mask)
    assert border.cells.tolist() == [[1, 1], [2, 1], [3, 1], [2, 1]]


def test_nothing_has_no_border_and_a_cell_has_itself():
    assert find_borders(np.zeros((3, 3), dtype=bool)) == []
    (border,) = find_borders(np.ones((1, 1), dtype=bool))
    assert border.cells.tolist() == [[0, 0]]


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_borders_are_the_cells_beside_gaps_each_once_a_patch_or_hole(share):
    mask = np.random.default_rng(int(share * 10)).random((40, 60)) < share
    borders = find_borders(mask)
    beside = np.zeros_like(mask)
    for border in borders:
        x, y = border.cells.T
        beside[y, x] = True
        steps = np.abs(border.cells - np.roll(border.cells, 1, axis=0))
        assert len(x) == 1 or (steps.max(axis=1) == 1).all()
    gap = np.pad(~mask, 1, constant_values=True)
    near_gap = gap[:-2, 1:-1] | gap[2:, 1:-1] | gap[1:-1, :-2] | gap[1:-1, 2:]
    assert np.array_equal(beside, mask & near_gap)
    assert sum(not b.hole for b in borders) == label_patches(mask, 8)[1]
    # holes: gaps that touch by an edge, less the one that reaches the margin
    assert sum(b.hole for b in borders) == label_patches(gap)[1] - 1


def test_a_rectangle_keeps_its_four_corners():
    mask = np.zeros((30, 50), dtype=bool)
    mask[4:25, 6:44] = True
    (border,) = find_borders(mask)
    corners = simplified(border.cells, 1.5)
    assert {tuple(c) for c in corners.tolist()} == {(6, 4), (43, 4), (43, 24), (6, 24)}


def test_a_simplified_ring_stays_within_the_tolerance():
    angle = np.linspace(0, 2 * math.pi, 400, endpoint=False)
    ring = np.column_stack([40 * np.cos(angle), 25 * np.sin(angle) + 6 * np.sin(5 * angle)])
    corners = simplified(ring, 1.5)
    assert 8 < len(corners) < 60
    off = shapely.distance(shapely.points(ring), shapely.LinearRing(corners))
    assert off.max() <= 1.5 * 1.5  # the subdivision keeps 1.5, dropping flat corners adds a little


def test_short_rings_stay():
    assert len(simplified(np.array([[1, 2], [3, 4]]), 1.5)) == 2
    assert simplified(np.array([[1, 2]]), 1.5).tolist() == [[1, 2]]
    assert len(simplified(np.array([[1, 1], [2, 1], [2, 2], [1, 2]]), 3.0)) == 1


def test_the_smallest_box_is_turned_as_the_object():
    turn = math.radians(33)
    x, y = np.meshgrid(np.linspace(0, 7, 15), np.linspace(0, 2, 5))
    points = np.column_stack([x.ravel(), y.ravel()]) @ np.array(
        [[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]]
    )
    assert smallest_box(points) == pytest.approx((2, 7))
    assert smallest_box(np.array([[3.0, 4.0]])) == (0.0, 0.0)
    assert smallest_box(np.array([[0.0, 0.0], [3.0, 4.0]])) == pytest.approx((0, 5))


def test_widening_moves_the_outer_border_out_by_one():
    mask = np.zeros((12, 12), dtype=bool)
    mask[4:8, 4:8] = True
    (border,) = find_borders(widened(mask))
    assert border.cells.min() == 3 and border.cells.max() == 8

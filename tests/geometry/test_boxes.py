"""Points in boxes, against looking at every point for every box."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.geometry import boxes
from floorplan_core.geometry.boxes import index_boxes, points_in_boxes

ORIGIN, CELL, SHAPE = np.array([-1.0, -2.0]), 0.1, (40, 30)


def plain(points: np.ndarray, box: np.ndarray) -> list[int]:
    """Rows of the points in a box."""
    x, y = points[:, 0], points[:, 1]
    return np.flatnonzero((x >= box[0]) & (x <= box[2]) & (y >= box[1]) & (y <= box[3])).tolist()


def random_boxes(rng: np.random.Generator, count: int) -> np.ndarray:
    corner = rng.uniform(-1.5, 2.5, (count, 2)) - [0.0, 1.0]
    return np.hstack([corner, corner + rng.uniform(0.0, 1.5, (count, 2))])


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 8))
def test_as_every_point_against_every_box(seed, count):
    rng = np.random.default_rng(seed)
    points, many = rng.uniform([-1.0, -2.0], 2.0, (300, 2)), random_boxes(rng, count)
    found = points_in_boxes(points, index_boxes(many, ORIGIN, CELL, SHAPE))
    assert [rows.tolist() for rows in found] == [plain(points, box) for box in many]


def test_two_threads_find_the_same_in_the_same_order(monkeypatch):
    rng = np.random.default_rng(1)
    points, many = rng.uniform(-2.5, 3.0, (500, 3)), random_boxes(rng, 5)
    index = index_boxes(many, ORIGIN, CELL, SHAPE)
    one = points_in_boxes(points, index)
    monkeypatch.setattr(boxes, "_WORTH", 10)
    two = points_in_boxes(points, index)
    assert sum(map(len, one)) > 0
    assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))


@pytest.mark.parametrize("points", [np.zeros((0, 3)), np.full((4, 3), 50.0)], ids=["none", "far away"])
def test_no_points_in_a_box_are_an_empty_row(points):
    index = index_boxes(np.array([[0.0, 0.0, 1.0, 1.0]]), ORIGIN, CELL, SHAPE)
    assert [len(rows) for rows in points_in_boxes(points, index)] == [0]


def test_no_boxes_hold_nothing():
    assert points_in_boxes(np.zeros((3, 3)), index_boxes(np.zeros((0, 4)), ORIGIN, CELL, SHAPE)) == []

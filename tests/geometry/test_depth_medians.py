"""Median depths behind faces, against sorting each bin by itself."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.geometry import depth_medians
from floorplan_core.geometry.boxes import index_boxes
from floorplan_core.geometry.depth_medians import Faces, _medians, median_depths

ORIGIN, CELL, SHAPE = np.array([-1.0, -1.0]), 0.1, (60, 60)
BANDS = np.array([(0.3, 1.8), (0.08, 0.3), (2.2, 2.6)])
STEP, SIDEWAYS, LEAST = 0.05, 0.2, 3
FACES = Faces(
    axis=np.array([0, 0, 1]),
    sign=np.array([1, -1, 1]),
    offset=np.array([2.0, 1.86, 1.0]),
    start=np.array([0.5, 0.5, 0.2]),
    bins=np.array([41, 41, 61]),
)
BOXES = np.array([[1.8, 0.5, 2.1, 2.5], [1.8, 0.5, 2.1, 2.5], [0.2, 0.8, 3.2, 1.1]])


def survey(seed: int, count: int = 4000) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1.2, 5.2, (count, 3))
    points[: count // 2] = rng.uniform([1.75, 0.4, 0.0], [2.15, 2.6, 2.7], (count // 2, 3))
    return points, rng.uniform(-1.0, 1.0, (count, 2))


def plain(points: np.ndarray, view: np.ndarray, face: int, band: int) -> np.ndarray:
    """The medians of one face, with a mask and a sort for every bin."""
    a, sign, box = FACES.axis[face], FACES.sign[face], BOXES[face]
    inside = (points[:, :2] >= box[:2]).all(axis=1) & (points[:, :2] <= box[2:]).all(axis=1)
    inside &= view[:, a] * sign > SIDEWAYS
    inside &= (points[:, 2] > BANDS[band, 0]) & (points[:, 2] < BANDS[band, 1])
    along = ((points[:, 1 - a] - FACES.start[face]) / STEP).astype(int)
    out = np.full(FACES.bins[face], np.nan)
    for k in range(len(out)):
        depth = np.sort((FACES.offset[face] - points[inside & (along == k), a]) * sign)
        out[k] = depth[len(depth) // 2] if len(depth) >= LEAST else np.nan
    return out


def measured(points: np.ndarray, view: np.ndarray) -> list[np.ndarray]:
    near = index_boxes(BOXES, ORIGIN, CELL, SHAPE)
    return median_depths(FACES, near, points, view, BANDS, STEP, SIDEWAYS, LEAST)


@pytest.mark.parametrize("seed", range(4))
def test_as_a_sort_of_every_bin(seed):
    points, view = survey(seed)
    found = measured(points, view)
    assert np.isfinite(found[0][0]).any()
    for face, bands in enumerate(found):
        for band, medians in enumerate(bands):
            np.testing.assert_array_equal(medians, plain(points, view, face, band))


def test_neither_threads_nor_room_change_anything(monkeypatch):
    points, view = survey(7)
    one = measured(points, view)
    monkeypatch.setattr(depth_medians, "_WORTH", 100)
    monkeypatch.setattr(depth_medians, "_START", 2)
    for a, b in zip(one, measured(points, view), strict=True):
        np.testing.assert_array_equal(a, b)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 4), st.integers(-3, 3)), min_size=1, max_size=60))
def test_medians_of_groups_with_equal_values(pairs):
    group = np.array([g for g, _ in pairs], dtype=np.int32)
    value = np.array([v for _, v in pairs], dtype=np.float64)
    found = _medians(group, value, 6, 2)
    for g in range(6):
        mine = np.sort(value[group == g])
        np.testing.assert_equal(found[g], mine[len(mine) // 2] if len(mine) >= 2 else np.nan)

"""Which rectangles are one region: overlaps and open borders join, walls and doors part."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.stages.rectangle_groups import _components, connected_groups

WEST, EAST = (0.0, 0.0, 4.0, 3.0), (4.05, 0.0, 8.0, 3.0)
NO_WALLS = {0: np.zeros((0, 3)), 1: np.zeros((0, 3))}


def groups(*boxes: tuple[float, ...], walls: list[tuple[float, ...]] = ()) -> list[tuple[list[int], list]]:
    """The groups of ``boxes``, with upright ``walls`` (offset, start, end)."""
    upright = {**NO_WALLS, 0: np.array(walls, dtype=float).reshape(-1, 3)}
    return [(rows.tolist(), joints.tolist()) for rows, joints in connected_groups(np.array(boxes), upright)]


def test_what_overlaps_is_one_region_without_a_bridge():
    assert groups((0, 0, 4, 3), (3, 1, 8, 2)) == [([0, 1], [])]


def test_a_narrow_open_border_is_bridged():
    assert groups(WEST, EAST) == [([0, 1], [[4.0, 0.0, 4.05, 3.0]])]


def test_a_wall_on_the_border_parts_and_a_gap_in_it_joins():
    assert groups(WEST, EAST, walls=[(4.02, 0.0, 3.0)]) == [([0], []), ([1], [])]
    walls = [(4.1, 2.0, 3.0), (3.9, -1.0, 0.5)]
    assert groups(WEST, EAST, walls=walls) == [([0, 1], [[4.0, 0.5, 4.05, 2.0]])]


def test_a_gap_too_narrow_to_pass_joins_nothing():
    assert groups(WEST, EAST, walls=[(4.0, 0.0, 1.3), (4.0, 1.8, 3.0)]) == [([0], []), ([1], [])]


def test_what_lies_apart_stays_apart():
    assert groups(WEST, (5.0, 0.0, 8.0, 3.0)) == [([0], []), ([1], [])]


@pytest.mark.parametrize("seed", range(5))
def test_components_are_those_of_a_walk(seed):
    rng = np.random.default_rng(seed)
    linked = rng.random((40, 40)) < 0.03
    linked |= linked.T
    label = _components(40, *np.nonzero(linked))
    reach = np.linalg.matrix_power((linked | np.eye(40, dtype=bool)).astype(float), 40) > 0
    assert (reach == (label[:, None] == label)).all()
    assert np.unique(label, return_index=True)[1].tolist() == sorted(np.unique(label, return_index=True)[1])

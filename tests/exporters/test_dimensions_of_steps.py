"""Dimensions along curved and slanted walls: not of their steps, but of what these span."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import shapely

from floorplan_core.exporters.dimensions import chain
from floorplan_core.model import Region

SIDES = [(0, -1), (0, 1), (1, -1), (1, 1)]
STEP = 0.3  # m


def region(polygon: shapely.Polygon, name: str = "1") -> Region:
    return Region(f"r{name}", name, polygon, "room", 100, 100, 0.1)


def stepped(inside: Callable[[np.ndarray], np.ndarray], size: float) -> shapely.Polygon:
    """The squares of :data:`STEP` of a square plan whose middles are ``inside`` (x, y from its middle)."""
    corners = [(i * STEP, j * STEP) for i in range(round(size / STEP)) for j in range(round(size / STEP))]
    middles = np.array(corners) + (STEP - size) / 2
    chosen = [
        shapely.box(x, y, x + STEP, y + STEP) for (x, y), m in zip(corners, middles, strict=True) if inside(m)
    ]
    return shapely.union_all(chosen, grid_size=1e-6)


def lengths(*regions: Region) -> list[list[float]]:
    return [[round(s.length, 2) for s in chain(regions, *side)] for side in SIDES]


@pytest.mark.parametrize(
    "inside",
    [lambda m: np.hypot(*m) < 5.3, lambda m: max(*np.abs(m), np.abs(m).sum() / np.sqrt(2)) < 5.39],
    ids=["round", "octagon"],
)
def test_a_round_room_has_one_length_on_each_side(inside):
    polygon = stepped(inside, 10.8)
    x0, y0, x1, y1 = polygon.bounds
    assert lengths(region(polygon)) == [[round(y1 - y0, 2)]] * 2 + [[round(x1 - x0, 2)]] * 2


def test_a_corner_at_45_degrees_belongs_to_the_side_that_it_cuts():
    hall = stepped(lambda m: m.sum() < 4.0, 9.0)
    assert lengths(region(hall)) == [[9.0], [9.0], [9.0], [9.0]]
    beside = shapely.box(9.2, 0, 12.2, 9.0)
    assert lengths(region(hall), region(beside, "2"))[3] == [9.0, 3.0]


def test_where_the_steps_go_on_behind_another_room_they_have_no_length():
    hall = stepped(lambda m: m.sum() < 0.0, 9.0)
    before = shapely.box(4.0, 9.2, 12.0, 12.0)
    assert lengths(region(hall), region(before, "2"))[3] == [8.0]


def test_a_niche_and_a_single_step_keep_their_lengths():
    niche = shapely.box(0, 0, 6, 4).union(shapely.box(2, 4, 3, 4.4))
    assert lengths(region(niche))[3] == [2.0, 1.0, 3.0]
    step = shapely.box(0, 0, 6, 4).difference(shapely.box(4.5, 3.4, 6, 4))
    assert lengths(region(step))[3] == [4.5, 1.5]

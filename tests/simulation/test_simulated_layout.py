"""Layouts straight from the building: planes, blockers, free cells."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.simulation import STYLES, BuildingSpec, building_layout, layout_only, make_building

layouts = st.tuples(st.sampled_from(STYLES), st.integers(2, 20), st.integers(0, 1000))


@settings(max_examples=15, deadline=None)
@given(layouts)
def test_every_room_side_is_a_plane_of_its_facing(case: tuple[str, int, int]) -> None:
    style, rooms, seed = case
    building = make_building(BuildingSpec(style=style, rooms=rooms), np.random.default_rng(seed))
    layout = building_layout(building)
    for offsets in (layout.x_plus, layout.x_minus, layout.y_plus, layout.y_minus):
        assert (np.diff(offsets) > 0).all()
    for space in building.spaces[1:]:
        x0, y0, x1, y1 = space.polygon.bounds
        assert np.isclose(layout.x_plus, x0).any() and np.isclose(layout.x_minus, x1).any()
        assert np.isclose(layout.y_plus, y0).any() and np.isclose(layout.y_minus, y1).any()


@settings(max_examples=15, deadline=None)
@given(layouts)
def test_blockers_follow_the_walls_and_leave_the_doors_open(case: tuple[str, int, int]) -> None:
    style, rooms, seed = case
    building = make_building(BuildingSpec(style=style, rooms=rooms), np.random.default_rng(seed))
    layout = building_layout(building)
    walls = layout.blockers[: len(layout.blockers) - layout.doors]
    assert layout.doors == len(building.doors)
    assert (np.minimum(walls[:, 2] - walls[:, 0], walls[:, 3] - walls[:, 1]) == 0).all()
    length = (walls[:, 2] - walls[:, 0] + walls[:, 3] - walls[:, 1]).sum()
    boundary = sum(space.polygon.length for space in building.spaces)
    assert length == pytest.approx(boundary - 2 * sum(d.width for d in building.doors), abs=1e-6)
    floors = [space.polygon.buffer(-1e-6) for space in building.spaces]
    lines = [shapely.LineString(w.reshape(2, 2)) for w in walls]
    assert shapely.STRtree(floors).query(lines, predicate="crosses").size == 0


def test_free_cells_are_the_floor() -> None:
    spec = BuildingSpec(style="t", rooms=12, furniture="none", columns=0)
    building = make_building(spec, np.random.default_rng(2))
    grid = building_layout(building).grid
    area = sum(space.area for space in building.spaces)
    assert grid.universe.sum() * grid.cell**2 == pytest.approx(area, rel=0.02)
    assert ((grid.states == 1) == grid.universe).all()


def test_unseen_rooms_have_no_free_cells() -> None:
    spec = BuildingSpec(style="grid", rooms=30, furniture="none")
    full = layout_only(spec, np.random.default_rng(0))
    none = layout_only(spec, np.random.default_rng(0), seen=0.0)
    assert 0 < none.grid.universe.sum() < 0.7 * full.grid.universe.sum()
    assert (none.blockers == full.blockers).all()


def test_a_large_building_is_laid_out() -> None:
    spec = BuildingSpec(style="grid", rooms=900, furniture="none")
    layout = layout_only(spec, np.random.default_rng(0))
    assert layout.grid.universe.sum() * 0.01 > 15_000
    assert layout.planes > 1000
    assert layout.doors > 800

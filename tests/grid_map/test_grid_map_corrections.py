"""Corrections of walls on a grid map: cells follow, and rooms with them."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.grid_pipeline import plan_grid_map
from floorplan_core.model import FREE, OCCUPIED, FloorPlan
from floorplan_core.model.corrections import AddWall, HidePlane, KeepPlane, MovePlane, PlaneAt
from floorplan_core.steps import StepMemory
from tests.grid_map.map_drawings import CELL, ROOMS, office

EAST, WEST = (1.0, 0.0), (-1.0, 0.0)
WALL = PlaneAt((7.2, 1.5), EAST)  # the west face of the south east room


@pytest.fixture(scope="module")
def plan() -> FloorPlan:
    return plan_grid_map(office())


def room_at(plan: FloorPlan, x: float, y: float):
    import shapely

    (found,) = [r for r in plan.regions if shapely.contains_xy(r.polygon, x, y)]
    return found


def area_of(name: str) -> float:
    x0, y0, x1, y1 = ROOMS[name]
    return (x1 - x0) * (y1 - y0)


def disjoint(plan: FloorPlan) -> bool:
    import shapely

    shapes = [r.polygon for r in plan.regions]
    return sum(s.area for s in shapes) == pytest.approx(shapely.union_all(shapes).area)


def test_an_added_wall_parts_a_room(plan: FloorPlan) -> None:
    wall = AddWall((9.0, 5.4), (9.0, 8.8), 0.1)
    parted = plan_grid_map(office(), corrections=(wall,))
    assert len(parted.regions) == len(plan.regions) + 1
    west, east = room_at(parted, 7.0, 7.0), room_at(parted, 11.0, 7.0)
    assert west.polygon.bounds[2] == pytest.approx(8.95, abs=1e-6)
    assert east.polygon.bounds[0] == pytest.approx(9.05, abs=1e-6)
    assert sum(p.by_hand == "added" for p in parted.planes) == 2
    assert disjoint(parted)


def test_a_wall_that_is_none_joins_two_rooms(plan: FloorPlan) -> None:
    joined = plan_grid_map(office(), corrections=(HidePlane(WALL),))
    assert len(joined.regions) == len(plan.regions) - 1
    both = room_at(joined, 9.0, 1.5)
    assert both is room_at(joined, 5.0, 1.5)
    assert both.area == pytest.approx(area_of("south middle") + area_of("south east") + 0.2 * 3.2, abs=0.1)
    (hidden,) = [p for p in joined.planes if p.by_hand == "hidden"]
    assert hidden.offset == pytest.approx(7.2, abs=CELL)
    assert disjoint(joined)


@pytest.mark.parametrize("to", [7.5, 7.123])
def test_a_moved_face_moves_its_room_exactly(plan: FloorPlan, to: float) -> None:
    moved = plan_grid_map(office(), corrections=(MovePlane(WALL, (to, 1.5)),))
    assert len(moved.regions) == len(plan.regions)
    assert room_at(moved, 9.0, 1.5).polygon.bounds[0] == pytest.approx(to, abs=1e-6)
    assert room_at(moved, 5.0, 1.5).polygon.bounds[2] == pytest.approx(7.0, abs=1e-6)
    assert [p.by_hand for p in moved.planes if p.by_hand] == ["moved"]
    assert disjoint(moved)


def test_a_kept_wall_changes_nothing_but_its_mark(plan: FloorPlan) -> None:
    kept = plan_grid_map(office(), corrections=(KeepPlane(WALL),))
    assert [r.polygon.wkb for r in kept.regions] == [r.polygon.wkb for r in plan.regions]
    assert sum(p.by_hand == "kept" for p in kept.planes) == 1


def test_what_is_not_there_is_said_and_taking_back_restores(plan: FloorPlan) -> None:
    memory = StepMemory()
    source = office()
    first = plan_grid_map(source, memory=memory)
    gone = plan_grid_map(
        source, corrections=(MovePlane(PlaneAt((9.0, 7.0), WEST), (9.5, 7.0)),), memory=memory
    )
    assert any("not there any more" in text for text in gone.warnings)
    plan_grid_map(source, corrections=(HidePlane(WALL),), memory=memory)
    back = plan_grid_map(source, memory=memory)
    assert [r.polygon.wkb for r in back.regions] == [r.polygon.wkb for r in first.regions]
    assert np.array_equal(back.grid.states, first.grid.states)


def test_the_map_itself_is_left_alone(plan: FloorPlan) -> None:
    source = office()
    before = source.states.copy()
    changed = plan_grid_map(source, corrections=(HidePlane(WALL), AddWall((9.0, 5.4), (9.0, 8.8))))
    assert np.array_equal(source.states, before)
    assert np.count_nonzero((changed.grid.states == FREE) & (plan.grid.states == OCCUPIED)) > 0
    assert np.count_nonzero((changed.grid.states == OCCUPIED) & (plan.grid.states == FREE)) > 0

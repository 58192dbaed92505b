"""From the mouse to the new plan and back: one gesture, planned anew, undone."""

from __future__ import annotations

import pytest
import shapely

from floorcast_app.viewports.floor_plan_view import FloorPlanView
from tests.app.plan_panes import click, opened
from tests.app.pump import settle


@pytest.fixture
def pane(qtbot, sample_workbench) -> FloorPlanView:
    """The floor plan of a workbench that plans."""
    sample_workbench.run("view.fit")
    made = opened(qtbot, FloorPlanView(sample_workbench))
    yield made
    sample_workbench.document.go_to(0)
    settle(sample_workbench)
    sample_workbench.set_tool("select")


def neighbours(plan):
    """Two rooms that share a wall."""
    rooms = [r for r in plan.regions if r.label == "room"]
    for k, one in enumerate(rooms):
        for other in rooms[k + 1 :]:
            near = shapely.intersection(one.polygon.buffer(0.3), other.polygon.buffer(0.3))
            if max(near.bounds[2] - near.bounds[0], near.bounds[3] - near.bounds[1]) > 2.0:
                return one, other
    raise AssertionError("no two rooms share a wall")


def test_merging_makes_one_region_of_two_and_undo_brings_them_back(qtbot, pane, sample_workbench):
    workbench = sample_workbench
    before = workbench.plan
    one, other = neighbours(before)
    workbench.set_tool("merge")
    for region in (one, other):
        click(pane, region.polygon.representative_point().coords[0])
    settle(workbench)
    qtbot.waitUntil(lambda: pane.ready)
    assert len(workbench.plan.regions) == len(before.regions) - 1
    assert any(kind == "region" for kind, _ in workbench.plan.corrected)
    assert pane._drawing.source.plan is workbench.plan
    workbench.run("edit.undo")
    settle(workbench)
    again = [r.polygon.wkt for r in workbench.plan.regions]
    assert again == [r.polygon.wkt for r in before.regions]


def test_splitting_makes_two_regions_of_one(qtbot, pane, sample_workbench):
    workbench = sample_workbench
    before = workbench.plan
    room = max((r for r in before.regions if len(r.polygon.exterior.coords) == 5), key=lambda r: r.area)
    x0, y0, x1, y1 = room.polygon.bounds
    workbench.set_tool("split")
    click(pane, ((x0 + x1) / 2, y0))
    click(pane, ((x0 + x1) / 2 + 0.05, y1))
    settle(workbench)
    assert len(workbench.plan.regions) == len(before.regions) + 1
    halves = [r for r in workbench.plan.regions if room.polygon.buffer(0.01).contains(r.polygon)]
    assert sum(r.area for r in halves) == pytest.approx(room.area, rel=0.02)

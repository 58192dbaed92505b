"""The tools that correct the plan, with real events. Nothing is planned anew: the corrections count."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from floorcast_app.layers.planes import plane_shape
from floorcast_app.selection import Item
from floorcast_app.viewports.floor_plan_view import FloorPlanView
from floorcast_app.viewports.planes_view import PlanesView
from floorplan_core.model.corrections import (
    AddDoor,
    AddWall,
    MergeRegions,
    MovePlane,
    ResizeDoor,
    SplitRegion,
)
from tests.app.plan_panes import LEFT, NO_KEYS, click, drag, metres, move, opened, pixel


@pytest.fixture
def pane(qtbot, drawn) -> FloorPlanView:
    """The floor plan."""
    return opened(qtbot, FloorPlanView(drawn))


@pytest.fixture
def planes(qtbot, drawn) -> PlanesView:
    """The layout planes, with the best supported one selected and large."""
    made = opened(qtbot, PlanesView(drawn))
    plane = max(drawn.plan.planes, key=lambda p: p.support)
    drawn.selection.select(Item("plane", plane.id))
    drawn.view.set(centre=grip(plane), span=3.0)
    return made


def grip(plane) -> tuple[float, float]:
    """The middle of the longest run of a plane."""
    return tuple(max(plane_shape(plane).lines(), key=np.ptp).mean(axis=0).tolist())


def moved(at, axis, by) -> tuple[float, float]:
    """A place moved along an axis."""
    out = list(at)
    out[axis] += by
    return out[0], out[1]


def only(drawn):
    """The one correction, after exactly one step."""
    assert len(drawn.document.history) == 2
    (correction,) = drawn.state.corrections
    return correction


@pytest.mark.parametrize("tool", ["select", "plane"])
def test_dragging_a_selected_plane_moves_it(planes, drawn, tool):
    drawn.set_tool(tool)
    plane = drawn.find(drawn.selection.item)
    axis = plane.facing.axis
    start = metres(planes, grip(plane))
    end = metres(planes, moved(start, axis, 1.02))
    drag(planes, start, end)
    correction = only(drawn)
    assert isinstance(correction, MovePlane)
    wanted = plane.offset + end[axis] - start[axis]
    near = [s.offset for s in drawn.plan.segments if s.facing == plane.facing]
    reach = 10 / planes.camera.scale
    snapped = min(near, key=lambda o: abs(o - wanted))
    expected = snapped if abs(snapped - wanted) <= reach else wanted
    assert drawn.to_plan(correction.to)[axis] == pytest.approx(expected, abs=1e-6)


def test_a_plane_snaps_to_evidence_on_its_way(planes, drawn):
    plane = drawn.find(drawn.selection.item)
    axis = plane.facing.axis
    others = [s for s in drawn.plan.segments if s.facing == plane.facing]
    target = min((s for s in others if abs(s.offset - plane.offset) > 0.3), key=lambda s: s.offset)
    drawn.view.set(span=3 * abs(target.offset - plane.offset))
    start = metres(planes, grip(plane))
    away = target.offset - plane.offset + 4 / planes.camera.scale
    drag(planes, start, metres(planes, moved(start, axis, away)))
    offsets = [s.offset for s in others]
    assert min(abs(drawn.to_plan(only(drawn).to)[axis] - o) for o in offsets) < 1e-6


def test_a_drag_shows_a_preview_and_escape_gives_it_up(planes, drawn):
    plane = drawn.find(drawn.selection.item)
    start = pixel(planes, grip(plane))
    QTest.mousePress(planes, LEFT, NO_KEYS, start)
    end = pixel(planes, moved(grip(plane), plane.facing.axis, 0.5))
    move(planes, end, LEFT)
    kinds = {m.kind for m in drawn.toolbox.marks()}
    assert {"plane", "text"} <= kinds
    QTest.keyClick(planes, Qt.Key.Key_Escape)
    assert drawn.toolbox.marks() == ()
    QTest.mouseRelease(planes, LEFT, NO_KEYS, end)
    assert drawn.state.corrections == ()
    assert drawn.selection.item == Item("plane", plane.id)


@pytest.mark.parametrize(("typed", "relative"), [("1.25", False), ("@-0.05", True)])
def test_a_typed_offset_is_exact(planes, drawn, typed, relative):
    plane = drawn.find(drawn.selection.item)
    QTest.keyClicks(planes, typed)
    assert any(m.kind == "plane" for m in drawn.toolbox.marks())
    QTest.keyClick(planes, Qt.Key.Key_Return)
    wanted = plane.offset - 0.05 if relative else 1.25
    assert drawn.to_plan(only(drawn).to)[plane.facing.axis] == pytest.approx(wanted, abs=1e-9)
    assert not drawn.toolbox.busy


def test_typing_can_be_corrected_and_given_up(planes, drawn):
    QTest.keyClicks(planes, "12.9")
    QTest.keyClick(planes, Qt.Key.Key_Backspace)
    text = next(m.text for m in drawn.toolbox.marks() if m.kind == "text")
    assert text.startswith(("x 12.▏", "y 12.▏"))
    QTest.keyClick(planes, Qt.Key.Key_Escape)
    QTest.keyClick(planes, Qt.Key.Key_Return)
    assert drawn.state.corrections == ()


def test_two_clicks_draw_a_wall_along_an_axis(pane, drawn):
    drawn.set_tool("wall")
    x, y = drawn.plan.regions[0].polygon.representative_point().coords[0]
    start, end = metres(pane, (x - 1.0, y)), metres(pane, (x + 1.0, y + 0.2))
    click(pane, start)
    click(pane, end)
    wall = only(drawn)
    assert isinstance(wall, AddWall)
    a, b = drawn.to_plan(wall.start), drawn.to_plan(wall.end)
    assert a[1] == pytest.approx(b[1], abs=1e-9)
    assert wall.thickness > 0.05


def test_a_typed_length_is_exact(pane, drawn):
    drawn.set_tool("wall")
    x, y = drawn.plan.regions[0].polygon.representative_point().coords[0]
    click(pane, (x - 1.0, y))
    move(pane, pixel(pane, (x + 0.5, y)))
    QTest.keyClicks(pane, "1.234")
    QTest.keyClick(pane, Qt.Key.Key_Return)
    wall = only(drawn)
    assert np.hypot(*np.subtract(wall.end, wall.start)) == pytest.approx(1.234)


def test_two_clicks_add_a_plane_that_bounds_both_sides(planes, drawn):
    drawn.set_tool("plane")
    drawn.selection.select(None)
    region = max(drawn.plan.regions, key=lambda r: r.area)
    x, y = region.polygon.representative_point().coords[0]
    drawn.view.set(centre=(x, y), span=6.0)
    click(planes, (x, y - 0.4))
    click(planes, (x + 0.05, y + 0.4))
    assert only(drawn).thickness == 0.0


def test_a_door_needs_a_wall(pane, drawn):
    drawn.set_tool("door")
    region = max(drawn.plan.regions, key=lambda r: r.area)
    click(pane, region.polygon.representative_point().coords[0])
    assert drawn.state.corrections == ()
    assert not drawn.toolbox.busy
    assert drawn.ui.told[-1][1].startswith("Click on a wall")


def test_two_clicks_on_a_wall_add_a_door(pane, drawn):
    drawn.set_tool("door")
    start, axis = free_wall(drawn)
    drawn.view.set(centre=start, span=5.0)
    click(pane, start)
    click(pane, moved(moved(start, 1 - axis, 0.9), axis, 0.2))
    door = only(drawn)
    assert isinstance(door, AddDoor)
    a, b = drawn.to_plan(door.start), drawn.to_plan(door.end)
    assert a[axis] == pytest.approx(b[axis], abs=1e-9)
    assert abs(b[1 - axis] - a[1 - axis]) == pytest.approx(0.9, abs=0.03)


def free_wall(drawn) -> tuple[tuple[float, float], int]:
    """A place on a long side with a metre and a half of wall beside it, and the axis of its normal."""
    for region in drawn.plan.regions:
        for side in region.sides:
            (x0, y0), (x1, y1) = side.start, side.end
            axis = 0 if abs(x1 - x0) < abs(y1 - y0) else 1
            low = min((x0, y0)[1 - axis], (x1, y1)[1 - axis])
            at = moved((x0, y0), 1 - axis, low + 0.8 - (x0, y0)[1 - axis])
            doors = [d for d in drawn.plan.doors if np.hypot(*(d.line().mean(axis=0) - at)) < 3.0]
            if side.length > 3.0 and not doors and side.observed > 0.9:
                return at, axis
    raise AssertionError("the survey has no free wall")


@pytest.mark.parametrize("tool", ["select", "door"])
def test_dragging_the_end_of_a_selected_door_resizes_it(pane, drawn, tool):
    drawn.set_tool(tool)
    door = next(d for d in drawn.plan.doors if d.kind == "door")
    drawn.selection.select(Item("door", door.id))
    (start, end) = (tuple(p) for p in door.line().tolist())
    drawn.view.set(centre=end, span=4.0)
    drag(pane, end, metres(pane, moved(end, 1 - door.axis, -0.2)))
    resized = only(drawn)
    assert isinstance(resized, ResizeDoor)
    assert drawn.to_plan(resized.start) == pytest.approx(start, abs=1e-6)
    width = np.hypot(*np.subtract(resized.end, resized.start))
    assert width == pytest.approx(door.width - 0.2, abs=0.08)
    assert width < door.width


def test_a_typed_width_resizes_the_selected_door(pane, drawn):
    door = drawn.plan.doors[0]
    drawn.selection.select(Item("door", door.id))
    QTest.keyClicks(pane, "0.885")
    QTest.keyClick(pane, Qt.Key.Key_Return)
    resized = only(drawn)
    assert np.hypot(*np.subtract(resized.end, resized.start)) == pytest.approx(0.885)


def test_splitting_across_a_region(pane, drawn):
    drawn.set_tool("split")
    x0, y0, x1, y1 = max(
        drawn.plan.regions, key=lambda r: r.polygon.bounds[2] - r.polygon.bounds[0]
    ).polygon.bounds
    middle = (x0 + x1) / 2
    click(pane, (middle, y0))
    click(pane, (middle + 0.1, y1))
    split = only(drawn)
    assert isinstance(split, SplitRegion)
    assert drawn.to_plan(split.start)[0] == pytest.approx(drawn.to_plan(split.end)[0], abs=1e-9)


def test_merging_two_regions(pane, drawn):
    drawn.set_tool("merge")
    one, two = drawn.plan.regions[:2]
    for region in (one, two):
        click(pane, region.polygon.representative_point().coords[0])
    merge = only(drawn)
    assert isinstance(merge, MergeRegions)
    places = [drawn.to_plan(p) for p in merge.at]
    from shapely import Point

    assert [r.polygon.contains(Point(p)) for r, p in zip((one, two), places, strict=True)] == [True, True]


def test_a_second_escape_reaches_the_window(pane, drawn):
    """The first gives up the gesture; the next one is not taken, so that the window puts the tool down."""
    drawn.set_tool("wall")
    click(pane, drawn.plan.regions[0].polygon.representative_point().coords[0])
    assert drawn.toolbox.busy
    QTest.keyClick(pane, Qt.Key.Key_Escape)
    assert not drawn.toolbox.busy
    assert drawn.tool == "wall"
    assert drawn.toolbox.cancel() is False


def test_another_tool_and_another_plan_give_up_the_gesture(pane, drawn):
    drawn.set_tool("wall")
    click(pane, drawn.plan.regions[0].polygon.representative_point().coords[0])
    drawn.set_tool("split")
    assert not drawn.toolbox.busy
    click(pane, drawn.plan.regions[0].polygon.representative_point().coords[0])
    drawn.plan_changed.emit(drawn.plan)
    assert not drawn.toolbox.busy
    assert drawn.state.corrections == ()


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("select", "V"),
        ("measure", "M"),
        ("plane", "P"),
        ("door", "D"),
        ("wall", "W"),
        ("split", "S"),
        ("merge", "G"),
    ],
)
def test_every_tool_has_an_action_with_its_key(drawn, name, key):
    action = drawn.actions[f"tool.{name}"]
    assert action.shortcut == key
    drawn.run(action.id)
    assert drawn.tool == drawn.toolbox.tool.name == name
    assert action.checked(drawn)


def test_the_cursor_shows_which_way_a_wall_goes(planes, drawn):
    plane = drawn.find(drawn.selection.item)
    move(planes, pixel(planes, grip(plane)))
    wanted = (Qt.CursorShape.SizeHorCursor, Qt.CursorShape.SizeVerCursor)[plane.facing.axis]
    assert planes.cursor().shape() == wanted
    assert "type its offset" in drawn.toolbox.tool.hint
    move(planes, pixel(planes, moved(grip(plane), plane.facing.axis, 1.0)))
    assert planes.cursor().shape() == Qt.CursorShape.ArrowCursor
    drawn.selection.select(None)
    assert drawn.toolbox.tool.hint == ""


def test_the_cursor_shows_which_way_the_end_of_a_door_goes(pane, drawn):
    door = drawn.plan.doors[0]
    drawn.selection.select(Item("door", door.id))
    drawn.view.set(centre=tuple(door.line().mean(axis=0).tolist()), span=4.0)
    move(pane, pixel(pane, tuple(door.line()[1].tolist())))
    wanted = (Qt.CursorShape.SizeVerCursor, Qt.CursorShape.SizeHorCursor)[door.axis]
    assert pane.cursor().shape() == wanted


def test_a_split_shows_all_of_the_cut_before_it_is_made(pane, drawn):
    region = max(drawn.plan.regions, key=lambda r: r.area)
    middle = region.polygon.representative_point()
    drawn.set_tool("split")
    click(pane, (middle.x, middle.y))
    move(pane, pixel(pane, (middle.x + 0.6, middle.y + 0.02)))
    line = next(m for m in drawn.toolbox.marks() if m.kind == "dashes")
    (ax, ay), (bx, by) = line.points
    assert abs(bx - ax) > 1.0 and ay == pytest.approx(by)
    boundary = region.polygon.boundary
    assert boundary.distance(shapely.Point(ax, ay)) < 1e-6 > boundary.distance(shapely.Point(bx, by))

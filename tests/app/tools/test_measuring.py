"""The measure tool, with real mouse and key events."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from floorcast_app.layers.source import source_of
from floorcast_app.selection import Item
from floorcast_app.viewports.floor_plan_view import FloorPlanView
from tests.app.plan_panes import click, metres, move, opened, pixel

SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def pane(qtbot, drawn) -> FloorPlanView:
    """The floor plan with the measure tool in hand."""
    made = opened(qtbot, FloorPlanView(drawn))
    drawn.set_tool("measure")
    return made


def room(drawn):
    """A rectangular region."""
    return next(r for r in drawn.plan.regions if len(r.polygon.exterior.coords) == 5)


def ends(drawn, check):
    """The ends of a check in the plan."""
    return drawn.to_plan(check.start), drawn.to_plan(check.end)


def test_corners_snap_and_the_length_is_exact(pane, drawn):
    a, b = room(drawn).polygon.exterior.coords[:2]
    click(pane, (a[0] + 0.02, a[1] - 0.02))
    assert drawn.toolbox.busy
    click(pane, (b[0] - 0.02, b[1] + 0.02))
    (check,) = drawn.state.checks
    assert math.dist(check.start, check.end) == pytest.approx(math.dist(a, b), abs=1e-5)
    assert np.array(ends(drawn, check)) == pytest.approx(np.array([a, b]), abs=1e-9)
    assert drawn.selection.item == Item("check", check.id)
    assert not drawn.toolbox.busy
    drawn.run("edit.undo")
    assert drawn.state.checks == ()


def test_from_wall_to_wall_is_square_to_them(pane, drawn):
    x0, y0, x1, y1 = room(drawn).polygon.bounds
    reach = 12 / pane.camera.scale
    snaps = source_of(drawn.plan).snaps
    rows = [y for y in np.linspace(y0, y1, 40) if snaps.at(x0, y, reach).kind == "wall"]
    other = [y for y in np.linspace(y0, y1, 40) if snaps.at(x1, y, reach).kind == "wall"]
    click(pane, (x0, rows[0]))
    click(pane, (x1, other[-1]))
    assert abs(other[-1] - rows[0]) > 1.0
    (check,) = drawn.state.checks
    (ax, ay), (bx, by) = ends(drawn, check)
    assert ay == pytest.approx(by, abs=1e-9)
    assert bx - ax == pytest.approx(x1 - x0, abs=0.06)


def test_free_points_measure_what_was_clicked(pane, drawn):
    x0, y0, x1, y1 = room(drawn).polygon.bounds
    a = metres(pane, (x0 + 0.4 * (x1 - x0), y0 + 0.4 * (y1 - y0)))
    b = metres(pane, (x0 + 0.6 * (x1 - x0), y0 + 0.7 * (y1 - y0)))
    click(pane, a)
    click(pane, b)
    assert np.array(ends(drawn, drawn.state.checks[0])) == pytest.approx(np.array([a, b]), abs=1e-6)


def test_shift_measures_along_an_axis(pane, drawn):
    x0, y0, x1, y1 = room(drawn).polygon.bounds
    a = metres(pane, (x0 + 0.3 * (x1 - x0), y0 + 0.4 * (y1 - y0)))
    b = metres(pane, (x0 + 0.7 * (x1 - x0), y0 + 0.5 * (y1 - y0)))
    click(pane, a)
    click(pane, b, SHIFT)
    (_, ay), (_, by) = ends(drawn, drawn.state.checks[0])
    assert ay == pytest.approx(by, abs=1e-9)


def test_the_preview_says_the_length_and_escape_gives_up(pane, drawn):
    a, b = room(drawn).polygon.exterior.coords[:2]
    click(pane, a)
    move(pane, pixel(pane, b))
    texts = [m.text for m in drawn.toolbox.marks() if m.kind == "text"]
    assert texts == [f"{math.dist(a, b):.3f} m"]
    QTest.keyClick(pane, Qt.Key.Key_Escape)
    assert not drawn.toolbox.busy
    assert drawn.tool == "measure"
    assert drawn.state.checks == ()


def test_an_area_by_its_corners(pane, drawn):
    region = room(drawn)
    QTest.keyClick(pane, Qt.Key.Key_A)
    for corner in region.polygon.exterior.coords[:4]:
        click(pane, corner)
    QTest.keyClick(pane, Qt.Key.Key_Return)
    (text,) = [m.text for m in drawn.toolbox.marks() if m.kind == "text"]
    assert text.startswith(f"{region.area:.2f} m²")
    assert f"{region.perimeter:.3f} m" in text
    assert drawn.state.checks == ()
    QTest.keyClick(pane, Qt.Key.Key_Escape)
    assert not drawn.toolbox.busy


@pytest.mark.parametrize("height", [None, 2.71])
def test_a_double_click_measures_a_whole_region_with_its_height(qtbot, drawn, height):
    regions = tuple(replace(r, height=height) for r in drawn.plan.regions)
    drawn.plan = replace(drawn.plan, regions=regions)
    pane = opened(qtbot, FloorPlanView(drawn))
    drawn.set_tool("measure")
    region = max(regions, key=lambda r: len(r.polygon.exterior.coords))
    QTest.keyClick(pane, Qt.Key.Key_A)
    at = pixel(pane, region.polygon.representative_point().coords[0])
    QTest.mouseDClick(pane, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at)
    (text,) = [m.text for m in drawn.toolbox.marks() if m.kind == "text"]
    assert text.startswith(f"{region.area:.2f} m²")
    assert ("↕ 2.710 m" in text) == (height is not None)


def test_a_gesture_may_end_in_another_pane(qtbot, pane, drawn):
    from floorcast_app.viewports.planes_view import PlanesView

    other = opened(qtbot, PlanesView(drawn))
    a, b = room(drawn).polygon.exterior.coords[1:3]
    click(pane, a)
    click(other, b)
    assert math.dist(*ends(drawn, drawn.state.checks[0])) == pytest.approx(math.dist(a, b), abs=1e-9)


def test_a_measurement_is_selected_and_removed(pane, drawn):
    drawn.run("measure.add", start=(0.0, 0.0), end=(3.0, 0.0))
    drawn.run("measure.add", start=(0.0, 1.0), end=(3.0, 1.0))
    drawn.set_tool("select")
    drawn.view.set(centre=(1.5, 0.5), span=6.0)
    click(pane, (1.0, 1.0))
    assert drawn.selection.item == Item("check", "c2")
    drawn.run("measure.remove")
    assert [c.id for c in drawn.state.checks] == ["c1"]
    assert drawn.selection.items == ()

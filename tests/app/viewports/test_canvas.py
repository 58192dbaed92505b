"""The plan panes with real mouse and key events."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QImage, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from floorcast_app import theme
from floorcast_app.actions.view_actions import fit, pictured
from floorcast_app.layers.planes import plane_shape
from floorcast_app.selection import Item
from floorcast_app.view_state import Look, turned_only
from floorcast_app.viewports.floor_plan_view import FloorPlanView
from floorcast_app.viewports.free_space_view import FreeSpaceView
from floorcast_app.viewports.plan_camera import Camera
from floorcast_app.viewports.planes_view import PlanesView
from tests.app.plan_panes import NO_KEYS, click, drag, metres, move, opened, pixel

PANES = (PlanesView, FreeSpaceView, FloorPlanView)
CONTROL = Qt.KeyboardModifier.ControlModifier


def inside(region) -> tuple[float, float]:
    """A place in a region, off its walls."""
    return region.polygon.representative_point().coords[0]


def array(image: QImage) -> np.ndarray:
    """(height, width, 4) bytes of a picture."""
    made = image.convertToFormat(QImage.Format.Format_ARGB32)
    return np.frombuffer(made.constBits(), np.uint8).reshape(made.height(), made.width(), 4).copy()


def wheel(pane, at: QPoint, notches: int) -> None:
    """Turn the wheel over a pixel."""
    event = QWheelEvent(
        QPointF(at),
        QPointF(pane.mapToGlobal(at)),
        QPoint(),
        QPoint(0, 120 * notches),
        Qt.MouseButton.NoButton,
        NO_KEYS,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(pane, event)


def test_a_click_selects_and_control_adds(qtbot, drawn):
    pane = opened(qtbot, FloorPlanView(drawn))
    one, two = drawn.plan.regions[:2]
    click(pane, inside(one))
    assert drawn.selection.items == (Item("region", one.id),)
    click(pane, inside(two), CONTROL)
    assert drawn.selection.items == (Item("region", one.id), Item("region", two.id))
    click(pane, inside(two), CONTROL)
    assert drawn.selection.items == (Item("region", one.id),)
    click(pane, (drawn.view.look.centre[0], drawn.view.look.centre[1] + 0.55 * drawn.view.look.span))
    assert drawn.selection.items == ()


def test_doors_and_planes_are_clicked_within_pixels(qtbot, drawn):
    plan_pane, planes_pane = opened(qtbot, FloorPlanView(drawn)), opened(qtbot, PlanesView(drawn))
    door = drawn.plan.doors[0]
    click(plan_pane, tuple(door.line().mean(axis=0)))
    assert drawn.selection.item == Item("door", door.id)
    plane = max(drawn.plan.planes, key=lambda p: p.support)
    line = max(plane_shape(plane).lines(), key=np.ptp)
    drawn.view.set(centre=tuple(line.mean(axis=0).tolist()), span=2.0)
    shift = (4, 0) if plane.facing.axis == 0 else (0, 4)
    QTest.mouseClick(planes_pane, Qt.MouseButton.LeftButton, NO_KEYS, QPoint(400, 300) + QPoint(*shift))
    assert drawn.selection.item == Item("plane", plane.id)
    QTest.mouseClick(planes_pane, Qt.MouseButton.LeftButton, NO_KEYS, QPoint(400, 300) + 3 * QPoint(*shift))
    assert drawn.selection.item is None


def test_hovering_lights_up_in_all_panes(qtbot, drawn):
    first, second = opened(qtbot, FloorPlanView(drawn)), opened(qtbot, PlanesView(drawn))
    before = array(second.grab().toImage())
    region = drawn.plan.regions[0]
    move(first, pixel(first, inside(region)))
    assert drawn.selection.hovered == Item("region", region.id)
    after = array(second.grab().toImage())
    at = pixel(second, inside(region))
    assert (before != after).any()
    assert (array(first.grab().toImage())[at.y(), at.x()] != 0).any()


def test_the_pointer_is_told_and_shown_in_the_other_panes(qtbot, drawn):
    first, second = opened(qtbot, FloorPlanView(drawn)), opened(qtbot, FreeSpaceView(drawn))
    told = []
    drawn.pointer_moved.connect(lambda x, y: told.append((x, y)))
    at = inside(drawn.plan.regions[3])
    move(first, pixel(first, at))
    assert told[-1] == pytest.approx(metres(first, at))
    assert second._pointer == pytest.approx(metres(first, at))
    assert first._pointer is None
    QApplication.sendEvent(first, _leave())
    assert told[-1] == (None, None)
    assert drawn.selection.hovered is None


def _leave():
    from PySide6.QtCore import QEvent

    return QEvent(QEvent.Type.Leave)


def test_the_wheel_zooms_to_the_pointer(qtbot, drawn):
    pane = opened(qtbot, FloorPlanView(drawn))
    at = QPoint(200, 150)
    before, span = pane.camera.to_plan(200, 150), drawn.view.look.span
    wheel(pane, at, 2)
    assert drawn.view.look.span == pytest.approx(span / 1.2**2)
    assert pane.camera.to_plan(200, 150) == pytest.approx(before)
    wheel(pane, at, -2)
    assert drawn.view.look.span == pytest.approx(span)


@pytest.mark.parametrize("how", ["middle", "right", "left", "space"])
def test_dragging_pans_every_pane(qtbot, drawn, how):
    pane = opened(qtbot, FloorPlanView(drawn))
    other = opened(qtbot, PlanesView(drawn))
    centre = drawn.view.look.centre
    x, y = inside(drawn.plan.regions[0])
    button = {"middle": Qt.MouseButton.MiddleButton, "right": Qt.MouseButton.RightButton}.get(
        how, Qt.MouseButton.LeftButton
    )
    if how == "space":
        drawn.set_tool("measure")
        QTest.keyPress(pane, Qt.Key.Key_Space)
    start, end = metres(pane, (x, y)), metres(pane, (x + 1.0, y - 0.5))
    drag(pane, start, end, button)
    moved = np.subtract(centre, drawn.view.look.centre)
    assert moved == pytest.approx(np.subtract(end, start), abs=1e-6)
    assert other.camera.centre == drawn.view.look.centre
    assert drawn.selection.items == ()
    assert drawn.state.checks == ()


def test_a_double_click_brings_the_thing_into_view(qtbot, drawn):
    pane = opened(qtbot, FloorPlanView(drawn))
    region = drawn.plan.regions[0]
    QTest.mouseDClick(pane, Qt.MouseButton.LeftButton, NO_KEYS, pixel(pane, inside(region)))
    x0, y0, x1, y1 = region.polygon.bounds
    assert drawn.view.look.centre == pytest.approx(((x0 + x1) / 2, (y0 + y1) / 2))
    left, low, right, high = pane.camera.visible
    assert left < x0 and low < y0 and right > x1 and high > y1


def test_a_right_click_offers_what_fits(qtbot, drawn):
    pane = opened(qtbot, FloorPlanView(drawn))
    door = drawn.plan.doors[0]
    at = pixel(pane, tuple(door.line().mean(axis=0)))
    QTest.mouseClick(pane, Qt.MouseButton.RightButton, NO_KEYS, at)
    assert drawn.selection.item == Item("door", door.id)
    menu = next(m for m in pane.findChildren(QMenu) if m.isVisible())
    texts = {action.text() for action in menu.actions()}
    menu.close()
    assert drawn.actions["correct.reject_door"].text in texts


def test_eyes_and_layers_are_respected(qtbot, drawn):
    pane = opened(qtbot, FloorPlanView(drawn))
    region = next(r for r in drawn.plan.regions if len(r.polygon.exterior.coords) == 5)
    x0, y0, x1, y1 = region.polygon.bounds
    drawn.view.set(centre=((x0 + x1) / 2, (y0 + y1) / 2), span=2.0 * max(x1 - x0, y1 - y0))
    corners = [(x0 + u * (x1 - x0), y0 + v * (y1 - y0)) for u in (0.2, 0.8) for v in (0.2, 0.8)]

    def tone() -> str:
        """The most frequent colour in the corners of the region."""
        image = array(pane.picture(800, 600))
        found = [_rgb(image[pixel(pane, c).y(), pixel(pane, c).x()]) for c in corners]
        return max(found, key=found.count)

    assert tone() == theme.colours().region(region.label)
    drawn.view.set(hidden=frozenset({("region", region.id)}))
    assert tone() == theme.colours().canvas
    click(pane, inside(region))
    assert drawn.selection.item is None
    drawn.view.set(layers=frozenset())
    bare = array(pane.picture(800, 600))
    drawn.view.set(hidden=frozenset())
    assert (array(pane.picture(800, 600)) == bare).all()


def _rgb(pixel_bytes: np.ndarray) -> str:
    b, g, r, _ = pixel_bytes.tolist()
    return f"#{r:02x}{g:02x}{b:02x}"


@pytest.mark.parametrize("pane_class", PANES)
def test_pictures_have_the_size_asked_for_and_are_deterministic(qtbot, drawn, pane_class):
    pane = opened(qtbot, pane_class(drawn))
    one, two = pane.picture(640, 360), pane.picture(640, 360)
    assert (one.width(), one.height()) == (640, 360)
    assert (array(one) == array(two)).all()
    assert len(np.unique(array(one).reshape(-1, 4), axis=0)) > 20


@pytest.mark.parametrize("pane_class", PANES)
def test_a_pane_without_a_plan_says_so_and_takes_one_later(qtbot, workbench, drawn, pane_class):
    pane = opened(qtbot, pane_class(workbench))
    assert pane.picture(300, 200).width() == 300
    click(pane, (0.0, 0.0))
    workbench.plan = drawn.plan
    workbench.plan_changed.emit(drawn.plan)
    qtbot.waitUntil(lambda: pane.ready)
    assert pane._drawing.source.plan is drawn.plan
    workbench.plan = None
    workbench.plan_changed.emit(None)
    assert pane.ready
    assert pane._drawing is None


@pytest.mark.parametrize(("pane_class", "part"), [(PlanesView, "planes"), (FreeSpaceView, "grid")])
def test_what_the_stages_found_is_shown_before_the_plan_is_whole(qtbot, workbench, drawn, pane_class, part):
    pane = opened(qtbot, pane_class(workbench))
    empty = array(pane.picture(400, 300))
    workbench.partial.emit("frame", drawn.plan.frame)
    assert (array(pane.picture(400, 300)) == empty).all()
    workbench.partial.emit("some stage", getattr(drawn.plan, part))
    x0, y0, x1, y1 = pane.camera.visible
    bounds = shapely.total_bounds([r.polygon for r in drawn.plan.regions])
    assert (x0, y0) < tuple(bounds[:2]) and (x1, y1) > tuple(bounds[2:])
    assert (array(pane.picture(400, 300)) != empty).mean() > 0.05
    workbench.plan = drawn.plan
    workbench.plan_changed.emit(drawn.plan)
    qtbot.waitUntil(lambda: pane.ready)
    assert pane._partial == {}


def test_a_picture_is_of_the_present_plan_even_before_it_is_built(qtbot, workbench, drawn):
    again = opened(qtbot, FloorPlanView(drawn))
    qtbot.waitUntil(lambda: again.ready)  # fitted to its size
    pane = FloorPlanView(workbench)
    qtbot.addWidget(pane)
    workbench.plan = drawn.plan
    workbench.view.put(drawn.view.look)
    workbench.view.fitted = drawn.view.fitted
    workbench.plan_changed.emit(drawn.plan)
    late = array(pane.picture(400, 300))
    assert (late == array(again.picture(400, 300))).all()


@pytest.mark.parametrize("size", [(1600, 500), (400, 900)])
def test_a_plan_that_fills_its_pane_fills_a_picture_of_another_shape(drawn, size):
    fit(drawn)
    shown = Camera.of(pictured(drawn, drawn.view.look, size, None), *size).visible
    x0, y0, x1, y1 = drawn.plan.bounds
    assert shown[0] < x0 and shown[1] < y0 and shown[2] > x1 and shown[3] > y1
    drawn.view.set(span=2.0)  # looked at closely: so is the picture
    assert pictured(drawn, drawn.view.look, size, None) == drawn.view.look
    fit(drawn)


def test_dark_is_darker(qtbot, drawn):
    app = QApplication.instance()
    theme.apply_theme(app, "light")  # whatever a test before has left
    pane = opened(qtbot, FloorPlanView(drawn))
    light = array(pane.picture(400, 300))[..., :3].mean()
    theme.apply_theme(app, "dark")
    try:
        assert array(pane.picture(400, 300))[..., :3].mean() < 0.5 * light
    finally:
        theme.apply_theme(app, "light")


def test_closing_a_pane_lets_go_of_the_workbench(qtbot, drawn):
    pane = opened(qtbot, FreeSpaceView(drawn))
    pane.shut_down()
    before = pane._drawing
    drawn.plan_changed.emit(drawn.plan)
    drawn.view.set(span=5.0)
    assert pane._drawing is before


@pytest.mark.parametrize("kind", PANES)
def test_turning_the_3d_camera_paints_no_plan_anew(qtbot, drawn, kind):
    pane = opened(qtbot, kind(drawn))
    pane.grab()
    painted = pane._base
    assert painted is not None
    drawn.view.set(azimuth=drawn.view.look.azimuth + 10.0, elevation=30.0)
    assert pane._base is painted
    drawn.view.set(layers=drawn.view.look.layers - {"doors"})
    assert pane._base is not painted
    drawn.view.set(layers=drawn.view.look.layers | {"doors"})


def test_what_turns_only_the_camera():
    look = Look()
    assert turned_only(look, replace(look, azimuth=1.0))
    assert not turned_only(look, replace(look, azimuth=1.0, span=3.0))
    assert not turned_only("light") and not turned_only() and not turned_only(None, look)

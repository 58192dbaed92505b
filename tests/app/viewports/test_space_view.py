"""The 3D pane under real mouse and key events, offscreen."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from floorcast_app import theme
from floorcast_app.jobs import immediately
from floorcast_app.rendering.camera import camera_of
from floorcast_app.selection import Item
from floorcast_app.viewports.space_overlay import shown_grid_step
from floorcast_app.viewports.space_view import SpaceView
from floorcast_app.workbench import Workbench
from floorplan_core.model import PointChunk
from tests.app.plan_panes import drawn_workbench
from tests.factories import small_flat

LEFT, RIGHT, MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton, Qt.MouseButton.MiddleButton
NO_KEYS = Qt.KeyboardModifier.NoModifier
SHIFT, CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
WIDTH, HEIGHT = 640, 480
PATIENCE = 60_000  # ms: kernels may have to be compiled on a loaded machine
POINTS = 20_000


@pytest.fixture
def workbench(qapp: QApplication) -> Workbench:
    theme.apply_theme(qapp, "light")
    made = drawn_workbench(small_flat())
    made.view.set(azimuth=-90.0, elevation=90.0, layers=made.view.look.layers - {"planes", "trajectory"})
    return made


@pytest.fixture
def pane(qtbot, workbench: Workbench) -> Iterator[SpaceView]:
    view = SpaceView(workbench)
    qtbot.addWidget(view)
    view.resize(WIDTH, HEIGHT)
    view.show()
    settled(qtbot, view)
    yield view
    view.shut_down()


def settled(qtbot, view: SpaceView) -> None:
    """Until the frame shows the look and the plan of now."""
    w = view.workbench

    def shown() -> bool:
        frame = view.frame
        if frame is None or frame.request.look != w.view.look:
            return False
        return w.plan is None or bool(frame.request.scene.items)

    qtbot.waitUntil(shown, timeout=PATIENCE)


def fill(workbench: Workbench, count: int = POINTS) -> None:
    """Points of the plan's floor and of a ceiling."""
    x0, y0, x1, y1 = workbench.plan.regions[0].polygon.bounds if workbench.plan else (0, 0, 5, 4)
    rng = np.random.default_rng(0)
    xyz = np.column_stack([rng.uniform((x0, y0), (x1, y1), (count, 2)), rng.choice((0.0, 2.5), count)])
    local = xyz @ workbench.plan.frame.rotation if workbench.plan else xyz
    workbench.points.add(PointChunk(local.astype(np.float32)))
    workbench.points_changed.emit()


def pixel(view: SpaceView, x: float, y: float, z: float = 0.0) -> QPoint:
    """Where the pane shows a place."""
    camera = camera_of(view.workbench.view.look, view.width(), view.height())
    px, py, _ = camera.project(np.array([[x, y, z]]))[0]
    return QPoint(round(px), round(py))


def room_pixel(view: SpaceView, number: int = 0) -> QPoint:
    spot = view.workbench.plan.regions[number].polygon.representative_point()
    return pixel(view, spot.x, spot.y)


def drag(view: SpaceView, start: QPoint, by: QPoint, button=LEFT, keys=NO_KEYS) -> None:
    QTest.mousePress(view, button, keys, start)
    for share in (0.3, 0.7, 1.0):
        at = start + QPoint(round(by.x() * share), round(by.y() * share))
        _move(view, at, button, keys)
    QTest.mouseRelease(view, button, keys, start + by)


def _move(view: SpaceView, at: QPoint, button, keys) -> None:
    """QTest.mouseMove holds no button down."""
    from PySide6.QtCore import QEvent
    from PySide6.QtGui import QMouseEvent

    where = QPointF(at)
    event = QMouseEvent(
        QEvent.Type.MouseMove, where, view.mapToGlobal(where), Qt.MouseButton.NoButton, button, keys
    )
    QApplication.sendEvent(view, event)


def wheel(view: SpaceView, at: QPoint, notches: int) -> None:
    event = QWheelEvent(
        QPointF(at),
        view.mapToGlobal(QPointF(at)),
        QPoint(),
        QPoint(0, 120 * notches),
        Qt.MouseButton.NoButton,
        NO_KEYS,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(view, event)


def test_a_click_selects_and_a_click_beside_clears(qtbot, pane: SpaceView) -> None:
    workbench = pane.workbench
    regions = workbench.plan.regions
    QTest.mouseClick(pane, LEFT, NO_KEYS, room_pixel(pane, 0))
    assert workbench.selection.items == (Item("region", regions[0].id),)
    QTest.mouseClick(pane, LEFT, CTRL, room_pixel(pane, 1))
    assert workbench.selection.items == (Item("region", regions[0].id), Item("region", regions[1].id))
    QTest.mouseClick(pane, LEFT, NO_KEYS, QPoint(3, HEIGHT - 3))
    assert workbench.selection.items == ()


def test_the_pointer_lights_up_what_is_under_it(qtbot, pane: SpaceView) -> None:
    told: list[tuple[float, float]] = []
    pane.workbench.pointer_moved.connect(lambda x, y: told.append((x, y)))
    spot = pane.workbench.plan.regions[1].polygon.representative_point()
    QTest.mouseMove(pane, room_pixel(pane, 1))
    assert pane.workbench.selection.hovered == Item("region", pane.workbench.plan.regions[1].id)
    assert told[-1] == pytest.approx((spot.x, spot.y), abs=0.05)
    QTest.mouseMove(pane, QPoint(3, HEIGHT - 3))
    assert pane.workbench.selection.hovered is None


def test_a_selection_from_elsewhere_lights_up(qtbot, pane: SpaceView) -> None:
    before = pane.frame.image.copy()
    pane.workbench.selection.select(Item("region", pane.workbench.plan.regions[0].id))
    qtbot.waitUntil(lambda: (pane.frame.image != before).any(), timeout=PATIENCE)


def test_a_drag_orbits_and_selects_nothing(qtbot, pane: SpaceView) -> None:
    look = pane.workbench.view.look
    drag(pane, room_pixel(pane), QPoint(40, -60))
    turned = pane.workbench.view.look
    assert turned.azimuth != look.azimuth and turned.elevation < look.elevation
    assert turned.centre == look.centre and pane.workbench.selection.items == ()


@pytest.mark.parametrize(("button", "keys"), [(MIDDLE, NO_KEYS), (LEFT, SHIFT), (RIGHT, NO_KEYS)])
def test_a_drag_with_the_middle_button_or_shift_pans(qtbot, pane: SpaceView, button, keys) -> None:
    look = pane.workbench.view.look
    drag(pane, QPoint(300, 200), QPoint(60, 30), button, keys)
    moved = pane.workbench.view.look
    assert (moved.azimuth, moved.elevation, moved.span) == (look.azimuth, look.elevation, look.span)
    metres = look.span / HEIGHT  # seen from above: the plan follows the hand
    expected = (look.centre[0] - 60 * metres, look.centre[1] + 30 * metres)
    assert moved.centre == pytest.approx(expected, abs=1e-9)


def test_the_wheel_zooms_to_the_pointer(qtbot, pane: SpaceView) -> None:
    at = room_pixel(pane, 1)
    spot = pane.workbench.plan.regions[1].polygon.representative_point()
    span = pane.workbench.view.look.span
    wheel(pane, at, 3)
    assert pane.workbench.view.look.span == pytest.approx(span / 1.2**3)
    after = pixel(pane, spot.x, spot.y)
    assert (after - at).manhattanLength() <= 2
    wheel(pane, at, -3)
    assert pane.workbench.view.look.span == pytest.approx(span)


def test_a_double_click_brings_the_room_into_view(qtbot, pane: SpaceView) -> None:
    region = pane.workbench.plan.regions[1]
    at = room_pixel(pane, 1)
    QTest.mouseClick(pane, LEFT, NO_KEYS, at)
    QTest.mouseDClick(pane, LEFT, NO_KEYS, at)
    look = pane.workbench.view.look
    x0, y0, x1, y1 = region.polygon.bounds
    assert look.centre == pytest.approx(((x0 + x1) / 2, (y0 + y1) / 2))
    assert max(x1 - x0, y1 - y0) < look.span


def test_keys_choose_the_view(qtbot, pane: SpaceView) -> None:
    view = pane.workbench.view
    for key, expected in (("1", (-90.0, 0.0)), ("3", (0.0, 0.0)), ("7", (-90.0, 90.0))):
        QTest.keyClick(pane, key)
        assert (view.look.azimuth, view.look.elevation) == expected
    span = view.look.span
    QTest.keyClick(pane, "+")
    assert view.look.span < span
    centre = view.look.centre
    QTest.keyClick(pane, Qt.Key.Key_Right, SHIFT)
    assert view.look.centre != centre
    QTest.keyClick(pane, Qt.Key.Key_Down)
    assert view.look.elevation == 90.0  # farther up than from above there is nothing


def test_buttons_choose_the_view(qtbot, pane: SpaceView) -> None:
    from PySide6.QtWidgets import QToolButton

    front = next(b for b in pane.buttons.findChildren(QToolButton) if b.text() == "Front")
    QTest.mouseClick(front, LEFT)
    assert (pane.workbench.view.look.azimuth, pane.workbench.view.look.elevation) == (-90.0, 0.0)


def test_the_right_button_opens_the_menu_of_a_thing(qtbot, pane: SpaceView) -> None:
    QTest.mouseClick(pane, RIGHT, NO_KEYS, room_pixel(pane))
    qtbot.waitUntil(lambda: bool(pane.findChildren(QMenu)))
    assert pane.workbench.selection.item == Item("region", pane.workbench.plan.regions[0].id)
    pane.findChildren(QMenu)[0].close()


def test_points_arrive_and_the_cut_takes_the_ceiling_away(qtbot, pane: SpaceView) -> None:
    fill(pane.workbench)
    qtbot.waitUntil(lambda: pane.frame.points == POINTS, timeout=PATIENCE)
    pane.workbench.view.set(ceiling_cut=None)
    settled(qtbot, pane)
    nearest = float(pane.frame.inverse.max())
    pane.workbench.view.set(ceiling_cut=1.0)
    settled(qtbot, pane)
    eye = pane.frame.camera.eye[2]
    assert 1 / nearest == pytest.approx(eye - 2.5, abs=0.05)
    assert 1 / float(pane.frame.inverse.max()) == pytest.approx(eye, abs=0.05)


def test_points_are_shown_before_there_is_a_plan(qtbot, qapp) -> None:
    workbench = Workbench(immediately)
    view = SpaceView(workbench)
    qtbot.addWidget(view)
    view.resize(WIDTH, HEIGHT)
    view.show()
    fill(workbench)
    qtbot.waitUntil(lambda: view.frame is not None and view.frame.points == POINTS, timeout=PATIENCE)
    assert workbench.view.look.centre == pytest.approx((2.5, 2.0), abs=0.2)  # brought into view
    view.shut_down()


def test_a_new_plan_takes_the_place_of_the_old(qtbot, pane: SpaceView) -> None:
    """Also while points are still on their way for the old one."""
    fill(pane.workbench)
    plans = [small_flat(), small_flat(), small_flat()]
    for plan in plans:
        pane.workbench.plan = plan
        pane.workbench.plan_changed.emit(plan)
        QTest.qWait(5)
    qtbot.waitUntil(
        lambda: pane._loaded is not None and pane._loaded.wanted.plan is plans[-1], timeout=PATIENCE
    )
    assert pane.picture(200, 150).width() == 200
    pane.workbench.plan = None
    pane.workbench.plan_changed.emit(None)
    qtbot.waitUntil(lambda: pane.frame.request.scene.items == (), timeout=PATIENCE)


def test_a_picture_has_any_size_and_is_always_the_same(pane: SpaceView) -> None:
    fill(pane.workbench)
    one, two = pane.picture(500, 350), pane.picture(500, 350)
    assert (one.width(), one.height(), one.devicePixelRatio()) == (500, 350, 1.0)
    assert one == two
    assert pane.picture(1000, 700).width() == 1000
    ground = QColor(theme.colours("light").window)
    seen = {one.pixelColor(x, y).name() for x in range(0, 500, 7) for y in range(0, 350, 7)}
    assert len(seen) > 20 and ground.isValid()


def test_a_picture_without_a_survey_says_what_to_do(qtbot, qapp) -> None:
    view = SpaceView(Workbench(immediately))
    qtbot.addWidget(view)
    image = view.picture(400, 300)
    middle = {image.pixelColor(x, y).name() for x in range(80, 320) for y in range(135, 165)}
    assert len(middle) > 5  # text is there
    view.shut_down()


def test_dark_is_dark(qtbot, pane: SpaceView) -> None:
    pane.workbench.view.set(theme="dark")
    assert pane.picture(300, 200).pixelColor(2, 100).lightness() < 60
    pane.workbench.view.set(theme="light")
    assert pane.picture(300, 200).pixelColor(2, 100).lightness() > 200


def test_the_grid_counts_in_feet_where_lengths_do(pane: SpaceView) -> None:
    pane.workbench.view.set(span=20.0, units="m")
    assert shown_grid_step(pane.workbench.view.look) == 1.0
    pane.workbench.view.set(units="ft-in")
    assert shown_grid_step(pane.workbench.view.look) / 0.3048 == pytest.approx(5.0)


def test_nothing_is_left_listening(qtbot, pane: SpaceView) -> None:
    pane.shut_down()
    pane.workbench.view.set(azimuth=12.0)
    assert pane._worker.join(PATIENCE / 1000)
    QTest.qWait(50)  # what was on its way arrives
    assert pane.frame.request.look.azimuth == -90.0

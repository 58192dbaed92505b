"""What the tests of the plan panes share: a planned workbench without jobs, and real events."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from floorcast_app.jobs import immediately
from floorcast_app.viewports.canvas import PlanCanvas
from floorcast_app.workbench import Workbench
from floorplan_core.model import FloorPlan

LEFT = Qt.MouseButton.LeftButton
NO_KEYS = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def drawn(sample_workbench: Workbench) -> Workbench:
    """A fresh workbench that shows the plan of the bundled survey and reruns nothing."""
    return drawn_workbench(sample_workbench.plan)


def drawn_workbench(plan: FloorPlan) -> Workbench:
    """A workbench that shows ``plan``. It has no survey, so nothing is planned anew when it is edited."""
    workbench = Workbench(immediately)
    workbench.plan = plan
    workbench.run("view.fit")
    return workbench


def opened(qtbot, pane: QWidget, width: int = 800, height: int = 600) -> QWidget:
    """The pane on the screen, with the plan in it."""
    pane.resize(width, height)
    qtbot.addWidget(pane)
    pane.show()
    if isinstance(pane, PlanCanvas):
        qtbot.waitUntil(lambda: pane.ready)
    return pane


def pixel(pane: PlanCanvas, at: tuple[float, float]) -> QPoint:
    """The pixel of a place in the plan, metres."""
    x, y = pane.camera.point(*at)
    return QPoint(round(x), round(y))


def metres(pane: PlanCanvas, at: tuple[float, float]) -> tuple[float, float]:
    """The place of that pixel: where an event really lands."""
    there = pixel(pane, at)
    return pane.camera.to_plan(there.x(), there.y())


def click(pane: PlanCanvas, at: tuple[float, float], keys: Qt.KeyboardModifier = NO_KEYS) -> None:
    """The pointer comes and clicks."""
    move(pane, pixel(pane, at))
    QTest.mouseClick(pane, LEFT, keys, pixel(pane, at))


def drag(
    pane: PlanCanvas, start: tuple[float, float], end: tuple[float, float], button: Qt.MouseButton = LEFT
) -> None:
    """A drag in four moves."""
    a, b = pixel(pane, start), pixel(pane, end)
    move(pane, a)
    QTest.mousePress(pane, button, NO_KEYS, a)
    for k in range(1, 5):
        move(pane, a + (b - a) * k / 4, button)
    QTest.mouseRelease(pane, button, NO_KEYS, b)


def move(pane: QWidget, to: QPoint, button: Qt.MouseButton = Qt.MouseButton.NoButton) -> None:
    """A move with a button held: QTest's own moves know no buttons."""
    event = QMouseEvent(
        QEvent.Type.MouseMove,
        QPointF(to),
        QPointF(pane.mapToGlobal(to)),
        Qt.MouseButton.NoButton,
        button,
        NO_KEYS,
    )
    QApplication.sendEvent(pane, event)

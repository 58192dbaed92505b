"""The pane of door evidence."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from floorcast_app.selection import Item
from floorcast_app.viewports.evidence_view import EvidenceView
from tests.app.plan_panes import NO_KEYS, move, opened


@pytest.fixture
def pane(qtbot, drawn) -> EvidenceView:
    """The pane with the plane that has most doors."""
    made = opened(qtbot, EvidenceView(drawn), 500, 400)
    plane = max(drawn.plan.planes, key=lambda p: sum(p.id in d.planes for d in drawn.plan.doors))
    drawn.selection.select(Item("plane", plane.id))
    return made


def test_nothing_selected_says_what_to_do(qtbot, drawn):
    pane = opened(qtbot, EvidenceView(drawn), 500, 400)
    assert pane.evidence is None
    assert pane.picture(300, 200).width() == 300


def test_clicking_a_detection_selects_the_door(pane, drawn):
    door = pane.evidence.doors[0]
    at = QPoint(round(pane.pixel_of((door.start + door.end) / 2)), 200)
    move(pane, at)
    assert drawn.selection.hovered == Item("door", door.id)
    QTest.mouseClick(pane, Qt.MouseButton.LeftButton, NO_KEYS, at)
    assert drawn.selection.item == Item("door", door.id)
    low, high = pane._shown
    assert low < door.start < door.end < high


def test_the_pointer_is_told_on_the_plane(pane, drawn):
    told = []
    drawn.pointer_moved.connect(lambda x, y: told.append((x, y)))
    along = sum(pane._shown) / 2
    move(pane, QPoint(round(pane.pixel_of(along)), 150))
    assert told[-1] == pytest.approx(pane.evidence.point(along), abs=0.05)


def test_a_pointer_near_the_plane_is_shown(pane, drawn):
    before = pane.grab().toImage()
    x, y = pane.evidence.point(sum(pane._shown) / 2)
    drawn.pointer_moved.emit(x, y)
    assert pane.grab().toImage() != before
    drawn.pointer_moved.emit(x + 50, y + 50)
    assert pane.grab().toImage() == before


def test_other_things_leave_what_is_shown(pane, drawn):
    shown = pane.evidence.plane
    drawn.selection.select(Item("region", drawn.plan.regions[0].id))
    assert pane.evidence.plane == shown


def test_the_other_face(pane, drawn):
    door = next(d for d in drawn.plan.doors if len(d.planes) > 1)
    drawn.selection.select(Item("door", door.id))
    assert pane.other.isVisible()
    first = pane.evidence.plane
    QTest.mouseClick(pane.other, Qt.MouseButton.LeftButton)
    assert {first, pane.evidence.plane} == set(door.planes[:2])


def test_dragging_moves_the_axis_and_a_double_click_brings_all_back(pane, drawn):
    whole = pane._shown
    QTest.mousePress(pane, Qt.MouseButton.LeftButton, NO_KEYS, QPoint(200, 350))
    for x in (220, 240, 260):
        move(pane, QPoint(x, 350), Qt.MouseButton.LeftButton)
    QTest.mouseRelease(pane, Qt.MouseButton.LeftButton, NO_KEYS, QPoint(260, 350))
    assert pane._shown[0] < whole[0]
    empty = QPoint(round(pane.width() / 2), 10)
    QTest.mouseDClick(pane, Qt.MouseButton.LeftButton, NO_KEYS, empty)
    assert pane._shown == pytest.approx(whole)

"""Eyes, facings, cut and section box, with a real mouse."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from pytestqt.qtbot import QtBot

from floorcast_app.panels.layers_panel import LayersPanel
from floorcast_app.view_state import LAYERS
from floorcast_app.workbench import Workbench

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def panel(workbench: Workbench, qtbot: QtBot) -> LayersPanel:
    made = LayersPanel(workbench)
    qtbot.addWidget(made)
    made.resize(220, 600)
    made.show()
    return made


@pytest.mark.parametrize("layer", LAYERS)
def test_an_eye_shows_and_hides_its_layer(panel: LayersPanel, qtbot: QtBot, layer: str) -> None:
    qtbot.mouseClick(panel.eyes[layer], LEFT)
    assert panel.workbench.view.look.layers == frozenset(LAYERS) - {layer}
    qtbot.mouseClick(panel.eyes[layer], LEFT)
    assert panel.workbench.view.look.layers == frozenset(LAYERS)


def test_eyes_follow_what_others_do(panel: LayersPanel, qtbot: QtBot) -> None:
    panel.workbench.run("view.layer_doors")
    qtbot.waitUntil(lambda: not panel.eyes["doors"].isChecked())


def test_facings_are_switched_one_by_one(panel: LayersPanel, qtbot: QtBot) -> None:
    qtbot.mouseClick(panel.facings[2], LEFT)
    qtbot.mouseClick(panel.facings[1], LEFT)
    assert panel.workbench.view.look.facings == {0, 3}


def test_points_are_coloured_by_what_is_chosen_with_keys(panel: LayersPanel, qtbot: QtBot) -> None:
    panel.colour.setFocus()
    qtbot.keyClick(panel.colour, Qt.Key.Key_Down)
    assert panel.workbench.view.look.point_colour == "facing"


def test_the_ceiling_cut_moves_and_goes(panel: LayersPanel, qtbot: QtBot) -> None:
    panel.cut.setFocus()
    qtbot.keyClick(panel.cut, Qt.Key.Key_Home)
    assert panel.workbench.view.look.ceiling_cut == pytest.approx(0.2)
    qtbot.mouseClick(panel.cut_on, LEFT, pos=QPoint(8, panel.cut_on.height() // 2))
    assert panel.workbench.view.look.ceiling_cut is None
    qtbot.waitUntil(lambda: not panel.cut.isEnabled())
    qtbot.mouseClick(panel.cut_on, LEFT, pos=QPoint(8, panel.cut_on.height() // 2))
    assert panel.workbench.view.look.ceiling_cut is not None


def test_a_section_box_begins_in_the_view_and_is_typed(panel: LayersPanel, qtbot: QtBot) -> None:
    qtbot.mouseClick(panel.section_on, LEFT, pos=QPoint(8, panel.section_on.height() // 2))
    assert panel.workbench.view.look.section == (-5.0, -5.0, 5.0, 5.0)
    qtbot.waitUntil(lambda: panel.section[0].isVisible())
    spin = panel.section[0]
    spin.setFocus()
    spin.selectAll()
    qtbot.keyClicks(spin, "7")
    qtbot.keyClick(spin, Qt.Key.Key_Return)
    assert panel.workbench.view.look.section == (5.0, -5.0, 7.0, 5.0)
    qtbot.mouseClick(panel.section_on, LEFT, pos=QPoint(8, panel.section_on.height() // 2))
    assert panel.workbench.view.look.section is None


def test_a_deleted_panel_no_longer_listens(workbench: Workbench, qtbot: QtBot) -> None:
    import shiboken6

    panel = LayersPanel(workbench)
    shiboken6.delete(panel)
    workbench.run("view.layer_doors")
    workbench.run("view.layer_doors")

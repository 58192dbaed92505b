"""The form made from the configuration: every setting, its bounds, presets, and one step for each change."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QPushButton
from pytestqt.qtbot import QtBot

from floorcast_app.actions.plan_actions import with_settings
from floorcast_app.panels.setting_editors import ChoiceControl, NumberControl, SettingEditor
from floorcast_app.panels.setting_fields import (
    SLIDER_STEPS,
    changed_fields,
    setting_field,
    setting_stages,
    value_of,
)
from floorcast_app.panels.settings_panel import SettingsPanel
from floorcast_app.presets import presets
from floorcast_app.workbench import Workbench
from floorplan_core.config import Config
from tests.app.pump import settle

LEFT = Qt.MouseButton.LeftButton
FIELDS = [f for stage in setting_stages() for f in stage.fields]
NUMBERS = [f for f in FIELDS if f.kind in ("int", "float")]


@pytest.fixture
def panel(workbench: Workbench, qtbot: QtBot) -> SettingsPanel:
    made = SettingsPanel(workbench)
    qtbot.addWidget(made)
    made.resize(300, 800)
    made.show()
    return made


def _number(panel: SettingsPanel, name: str) -> NumberControl:
    control = panel.editor(name).control
    assert isinstance(control, NumberControl)
    return control


def test_the_form_has_every_setting_of_the_configuration() -> None:
    names = {f"{s}.{f}" for s in Config.model_fields for f in type(getattr(Config(), s)).model_fields}
    assert {f.name for f in FIELDS} == names
    assert all(f.help and f.title for f in FIELDS)


@pytest.mark.parametrize("field", NUMBERS, ids=lambda f: f.name)
def test_every_place_of_a_slider_is_a_value_that_the_configuration_takes(field) -> None:  # type: ignore[no-untyped-def]
    values = [field.value(p) for p in range(0, SLIDER_STEPS + 1, 50)]
    assert values == sorted(values)
    assert values[0] < values[-1]
    for value in values:
        with_settings(Config(), {field.name: value})
    if field.default is not None:
        assert field.low <= field.default <= field.soft
        assert field.value(field.position(field.default)) == pytest.approx(
            field.default, rel=0.05, abs=field.step
        )


def test_typing_a_number_is_one_step_that_can_be_undone(panel: SettingsPanel, qtbot: QtBot) -> None:
    spin = _number(panel, "doors.max_width").spin
    spin.setFocus()
    spin.selectAll()
    qtbot.keyClicks(spin, "1.6")
    qtbot.keyClick(spin, Qt.Key.Key_Return)
    state = panel.workbench.document
    qtbot.waitUntil(lambda: panel.workbench.state.config.doors.max_width == 1.6)
    assert state.undo_text == "Set doors.max_width to 1.6"
    state.undo()
    qtbot.waitUntil(lambda: spin.value() == pytest.approx(1.3))


def test_a_dragged_slider_is_one_step(panel: SettingsPanel, qtbot: QtBot) -> None:
    slider = _number(panel, "planes.tolerance").slider
    at = QPoint(slider.width() * slider.value() // SLIDER_STEPS, slider.height() // 2)
    qtbot.mousePress(slider, LEFT, pos=at)
    assert slider.isSliderDown()
    for share in (0.5, 0.7, 0.9):
        qtbot.mouseMove(slider, QPoint(round(slider.width() * share), slider.height() // 2))
        before = panel.workbench.state.config.planes.tolerance
        qtbot.waitUntil(lambda b=before: panel.workbench.state.config.planes.tolerance != b)  # type: ignore[misc]
    qtbot.mouseRelease(slider, LEFT)
    assert len(panel.workbench.document.history) == 2
    panel.workbench.document.undo()
    assert panel.workbench.state.config == Config()


def test_changed_settings_come_first_and_bold_with_a_way_back(panel: SettingsPanel, qtbot: QtBot) -> None:
    panel.workbench.run("plan.set", name="regions.sliver", value=0.6)
    qtbot.waitUntil(lambda: panel._changed.isVisible())
    editor = panel._changed.findChild(SettingEditor)
    assert editor.field.name == "regions.sliver"
    assert editor.title.property("role") == "changed"
    assert "0.3 m" in editor.reset.toolTip()
    qtbot.mouseClick(editor.reset, LEFT)
    qtbot.waitUntil(lambda: panel.workbench.state.config == Config())
    qtbot.waitUntil(lambda: not panel._changed.isVisible())


def test_what_the_machine_decides_can_be_decided_by_hand(panel: SettingsPanel, qtbot: QtBot) -> None:
    editor = panel.editor("occupancy.slice_height")
    assert editor.automatic.isChecked() and not editor.control.isEnabled()
    qtbot.mouseClick(editor.automatic, LEFT, pos=QPoint(8, editor.automatic.height() // 2))
    qtbot.waitUntil(lambda: panel.workbench.state.config.occupancy.slice_height == 1.0)
    qtbot.waitUntil(lambda: editor.control.isEnabled())
    qtbot.mouseClick(editor.automatic, LEFT, pos=QPoint(8, editor.automatic.height() // 2))
    qtbot.waitUntil(lambda: panel.workbench.state.config.occupancy.slice_height is None)


def test_words_are_chosen_with_keys(panel: SettingsPanel, qtbot: QtBot) -> None:
    control = panel.editor("cover.solver").control
    assert isinstance(control, ChoiceControl)
    control.box.setFocus()
    qtbot.keyClick(control.box, Qt.Key.Key_Down)
    qtbot.waitUntil(lambda: panel.workbench.state.config.cover.solver == "exact")


def test_the_search_finds_by_name_and_by_meaning(panel: SettingsPanel, qtbot: QtBot) -> None:
    qtbot.keyClicks(panel.search, "doors max width")
    found = [e.field.name for e in panel._found.findChildren(SettingEditor)]
    assert "doors.max_width" in found
    assert "regions.sliver" not in found
    panel.search.clear()
    qtbot.keyClicks(panel.search, "zzzz")
    assert panel._found.isVisible() and not panel._tree.isVisible()
    panel.search.clear()
    assert panel._tree.isVisible()


def test_a_setting_that_is_asked_for_is_unfolded(panel: SettingsPanel, qtbot: QtBot) -> None:
    panel.workbench.setting_asked.emit("labels.max_room_perimeter")
    editor = panel.editor("labels.max_room_perimeter")
    qtbot.waitUntil(lambda: editor.isVisible() and not editor.visibleRegion().isEmpty())


@pytest.mark.parametrize("preset", presets(), ids=lambda p: p.id)
def test_every_preset_is_valid_and_says_why(preset) -> None:  # type: ignore[no-untyped-def]
    config = with_settings(Config(), dict(preset.settings))
    assert preset.holds(config)
    assert len(preset.reason) > 30 and preset.reason.endswith(".")
    assert {f.name for f in changed_fields(config)} <= {name for name, _ in preset.settings}


def test_a_preset_is_one_step(panel: SettingsPanel, qtbot: QtBot) -> None:
    preset = next(p for p in presets() if p.id == "noisy")
    panel._tree.layout().itemAt(0).widget().unfold()
    button = panel.findChild(QPushButton, "preset-noisy")
    panel._area.ensureWidgetVisible(button)
    qtbot.mouseClick(button, LEFT)
    assert preset.holds(panel.workbench.state.config)
    assert panel.workbench.document.undo_text == "Use Depth camera, noisy"
    qtbot.waitUntil(lambda: button.text() == "In use" and not button.isEnabled())
    qtbot.mouseClick(panel.reset, LEFT)
    assert panel.workbench.state.config == Config()


def test_a_change_is_planned_again(planned: Workbench, qtbot: QtBot) -> None:
    panel = SettingsPanel(planned)
    qtbot.addWidget(panel)
    panel.show()
    before = planned.plan
    assert before is not None
    spin = _number(panel, "labels.max_room_perimeter").spin
    spin.setFocus()
    spin.selectAll()
    qtbot.keyClicks(spin, "10")
    qtbot.keyClick(spin, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: value_of(planned.state.config, "labels.max_room_perimeter") == 10.0)
    settle(planned)
    assert planned.plan is not before
    assert planned.plan is not None
    labels = {r.label for r in planned.plan.regions if r.perimeter > 10}
    assert labels == {"corridor"}


def test_titles_are_words() -> None:
    assert setting_field("frame.yaw_step_deg").title == "Yaw step"
    assert setting_field("segments.min_area").unit == "m²"

"""The selected thing explains itself, and leads on."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QToolButton
from pytestqt.qtbot import QtBot

from floorcast_app.panels.evidence_words import EVIDENCE
from floorcast_app.panels.facts import Fact, _regions, portrait
from floorcast_app.panels.properties_panel import Link, PropertiesPanel
from floorcast_app.selection import Item
from floorcast_app.workbench import Workbench
from floorplan_core.model import loa_band
from tests.app.pump import settle

LEFT = Qt.MouseButton.LeftButton


def _same(text: str) -> str:
    return text


@pytest.fixture
def panel(planned: Workbench, qtbot: QtBot) -> PropertiesPanel:
    made = PropertiesPanel(planned)
    qtbot.addWidget(made)
    made.resize(260, 700)
    made.show()
    return made


def _values(workbench: Workbench, item: Item | None) -> dict[str, str]:
    shown = portrait(workbench, item, _same)
    assert shown is not None
    return {f.name: f.value for s in shown.sections for f in s.facts}


def _fact(panel: PropertiesPanel, qtbot: QtBot, name: str) -> Fact:
    """The line of that name, once it is shown."""

    def lines() -> list[Fact]:
        sections = panel.shown.sections if panel.shown is not None else ()
        return [f for s in sections for f in s.facts if f.name == name]

    qtbot.waitUntil(lambda: bool(lines()))
    return lines()[0]


def _link(panel: PropertiesPanel, qtbot: QtBot, text: str) -> Link:
    """What can be clicked, once it is seen."""

    def links() -> list[Link]:
        said = [(lk, lk.text().replace("\N{NO-BREAK SPACE}", " ")) for lk in panel.findChildren(Link)]
        return [lk for lk, words in said if words == text and lk.isVisible()]

    qtbot.waitUntil(lambda: bool(links()))
    return links()[-1]


def test_without_a_plan_nothing_is_claimed(workbench: Workbench, qtbot: QtBot) -> None:
    panel = PropertiesPanel(workbench)
    qtbot.addWidget(panel)
    assert panel.shown is None
    assert "no plan yet" in panel.findChild(QLabel).text()


def test_nothing_selected_shows_the_whole_plan(planned: Workbench) -> None:
    plan = planned.plan
    assert plan is not None
    values = _values(planned, None)
    assert values["Area"] == f"{sum(r.area for r in plan.regions):.2f} m²"
    assert values["Doors"] == str(len(plan.doors))


def test_a_wall_names_its_residual_its_band_and_its_points(planned: Workbench) -> None:
    plan = planned.plan
    assert plan is not None
    wall = max(plan.planes, key=lambda p: p.support)
    values = _values(planned, Item("plane", wall.id))
    assert f"{wall.residual * 1000:.0f} mm" in values["Residual"]
    assert loa_band(wall.residual) in values["Residual"]
    points = sum(s.points for s in plan.segments if s.id in wall.segments)
    assert values["Points"] == f"{points:,}"


def test_every_thing_of_the_plan_has_a_portrait(planned: Workbench) -> None:
    plan = planned.plan
    assert plan is not None
    kinds = {"region": plan.regions, "door": plan.doors, "plane": plan.planes, "segment": plan.segments}
    for kind, things in kinds.items():
        for thing in things:
            for units in ("m", "ft-in"):
                planned.view.set(units=units)
                shown = portrait(planned, Item(kind, thing.id), _same)
                assert shown is not None and shown.sections, (kind, thing.id)


def test_every_word_of_evidence_of_the_survey_is_a_sentence(planned: Workbench) -> None:
    plan = planned.plan
    assert plan is not None
    words = {w for t in (*plan.doors, *plan.segments) for w in t.evidence}
    assert words <= set(EVIDENCE)


def test_a_door_leads_to_its_room_by_a_click(panel: PropertiesPanel, qtbot: QtBot) -> None:
    plan = panel.workbench.plan
    assert plan is not None
    door = next(d for d in plan.doors if d.connects)
    panel.workbench.selection.select(Item("door", door.id))
    fact = _fact(panel, qtbot, "Joins")
    qtbot.mouseClick(_link(panel, qtbot, fact.value), LEFT)
    assert panel.workbench.selection.item == fact.item
    qtbot.waitUntil(lambda: panel.shown is not None and panel.shown.title.startswith("Region"))


def test_a_value_leads_to_the_setting_that_decides_it(panel: PropertiesPanel, qtbot: QtBot) -> None:
    asked: list[str] = []
    panel.workbench.setting_asked.connect(asked.append)
    plan = panel.workbench.plan
    assert plan is not None
    panel.workbench.selection.select(Item("door", plan.doors[0].id))
    width = _fact(panel, qtbot, "Width")
    qtbot.mouseClick(_link(panel, qtbot, width.value), LEFT)
    panel.workbench.setting_asked.disconnect(asked.append)
    assert asked == ["doors.min_width"]


def test_a_correction_is_one_click_and_says_what_the_machine_said(
    panel: PropertiesPanel, qtbot: QtBot
) -> None:
    workbench = panel.workbench
    assert workbench.plan is not None
    door = workbench.plan.doors[0]
    workbench.selection.select(Item("door", door.id))
    qtbot.waitUntil(lambda: panel.findChild(QToolButton, "correct.accept_door") is not None)
    qtbot.mouseClick(panel.findChild(QToolButton, "correct.accept_door"), LEFT)
    settle(workbench)
    qtbot.waitUntil(lambda: panel.shown is not None and ("Corrected", "chip-good") in panel.shown.chips)
    values = _values(workbench, workbench.selection.item)
    assert values["By hand"] == "Accepted by hand"
    assert f"{door.width:.3f} m wide" in values["Machine had said"]


def test_rooms_are_counted_in_words_that_fit() -> None:
    said = [_regions(count, rooms, str) for count, rooms in ((1, 1), (2, 1), (12, 11))]
    assert said == ["1", "2, of them 1 room", "12, of them 11 rooms"]

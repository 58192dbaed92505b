"""The toolbar: words as the width allows, formats below the arrow; menus in groups."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu, QToolButton
from pytestqt.qtbot import QtBot

from floorcast_app.main_window import MainWindow
from floorcast_app.menus import MENU_GROUPS, SUBMENUS
from floorcast_app.panels.storey_chooser import StoreyChooser
from floorcast_app.toolbar import SPELT, MainToolbar
from floorplan_core.plugins import default_registry
from tests.app.windows import open_window

WORDS = Qt.ToolButtonStyle.ToolButtonTextBesideIcon


@pytest.fixture
def window(qtbot: QtBot) -> Iterator[MainWindow]:
    with open_window() as made:
        yield made


def _toolbar(window: MainWindow) -> MainToolbar:
    bar = window.findChild(MainToolbar)
    assert isinstance(bar, MainToolbar)
    return bar


def _spelt(window: MainWindow) -> list[str]:
    bar = _toolbar(window)
    buttons = {id: bar.widgetForAction(window.actions_by_id[id]) for id in SPELT}
    return [id for id, b in buttons.items() if isinstance(b, QToolButton) and b.toolButtonStyle() == WORDS]


def test_words_come_and_go_with_the_width(window: MainWindow, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: _spelt(window) == list(SPELT))
    window.resize(1150, 800)
    qtbot.waitUntil(lambda: len(_spelt(window)) < len(SPELT))
    assert _spelt(window) == list(SPELT)[: len(_spelt(window))]
    assert _toolbar(window).sizeHint().width() <= 1150


def test_the_formats_are_those_of_the_exporters(window: MainWindow, monkeypatch: pytest.MonkeyPatch) -> None:
    button = _toolbar(window).widgetForAction(window.actions_by_id["file.export"])
    assert isinstance(button, QToolButton)
    menu = button.menu()
    assert isinstance(menu, QMenu)
    menu.aboutToShow.emit()
    assert [a.text().split("\t")[0] for a in menu.actions()] == [e.name for e in default_registry().exporters]
    asked: list[str] = []
    monkeypatch.setattr(window.workbench, "try_run", lambda id, **values: asked.append(values["suffix"]))
    for action in menu.actions():
        action.trigger()
    assert asked == [e.suffixes[0] for e in default_registry().exporters]


def test_groups_and_submenus_name_actions_that_exist(window: MainWindow) -> None:
    ids = {action.id for action in window.workbench.actions}
    assert set(MENU_GROUPS) <= ids
    assert all(any(id.startswith(prefix) for id in ids) for prefix in SUBMENUS)


def test_a_larger_window_gives_its_room_to_the_panes(window: MainWindow, qtbot: QtBot) -> None:
    qtbot.wait(300)  # until Qt has laid out the docks
    tables, side = window.docks["region_list"], window.docks["layers"].width()
    share = tables.height() / window.height()
    window.resize(1900, 1300)
    qtbot.waitUntil(lambda: abs(tables.height() / window.height() - share) < 0.08)
    assert window.docks["layers"].width() < 1.25 * side


def test_an_export_offers_the_chosen_format(
    window: MainWindow, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from floorcast_app.actions.file_actions import export
    from tests.factories import small_flat

    offered: list[str] = []
    monkeypatch.setattr(window.workbench.ui, "ask_save", lambda title, kind, name: offered.append(name))
    monkeypatch.setattr(window, "unattended", False)
    window.workbench.plan = small_flat()
    export(window.workbench, suffix=".geojson")
    assert [Path(name).suffix for name in offered] == [".geojson"]


def test_words_make_room_for_the_storeys(
    window: MainWindow, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    window.resize(1280, 800)
    bar = _toolbar(window)
    qtbot.waitUntil(lambda: bar.width() == 1280 and len(_spelt(window)) > 4)
    before = len(_spelt(window))
    chooser = bar.findChild(StoreyChooser)
    assert isinstance(chooser, StoreyChooser)
    monkeypatch.setattr(StoreyChooser, "wanted", True)
    chooser.addItem("Storey 12, 43.200 m above the lowest one", 12)
    window.workbench.plan_changed.emit(None)
    qtbot.waitUntil(lambda: chooser.isVisible() and len(_spelt(window)) < before)
    assert bar.sizeHint().width() <= bar.width()  # nothing has fallen off its end

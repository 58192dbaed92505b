"""The German window says nothing in English, and changes its language while one works."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QAbstractItemModel, QAbstractTableModel, QModelIndex, QSortFilterProxyModel, Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QComboBox,
    QMenu,
    QTabBar,
    QWidget,
)

from floorcast_app import translation
from floorcast_app.main_window import MainWindow
from floorcast_app.script import ScriptedApplication
from floorplan_core.errors import UsageError
from tests.app.pump import SAMPLE
from tests.app.windows import open_window
from tools import translate

SAID = (
    "text",
    "toolTip",
    "placeholderText",
    "windowTitle",
    "title",
    "statusTip",
    "suffix",
    "specialValueText",
)
ENGLISH = re.compile(  # words that German has not
    r"\b(the|of|and|is|are|not|with|from|to|by|all|no|for|which|that|this|seen|door|doors|room|plane|planes|guessed|"
    r"predicted|sure|share|height|length|width|points|found|open|both|side|above|below|wide|survey|storey)\b"
)


def texts(root: QWidget) -> Iterator[str]:
    """All that the widgets of a window say, in order."""
    for widget in (root, *root.findChildren(QWidget)):
        values = (getattr(widget, name, None) for name in SAID)
        yield from (v for v in (_value(v) for v in values) if v)
        if isinstance(widget, QComboBox):
            yield from (widget.itemText(k) for k in range(widget.count()))
        if isinstance(widget, QTabBar):
            yield from (widget.tabText(k) for k in range(widget.count()))
        shown = (
            isinstance(widget, QAbstractItemView) and not widget.visibleRegion().isEmpty()
        )  # else not filled
        if shown and widget.model() is not None:
            yield from _of_model(widget.model(), QModelIndex())
        if isinstance(widget, QMenu):
            for action in widget.actions():
                yield from (action.text(), action.toolTip())


def _value(read: object) -> str:
    try:
        said = read() if callable(read) else ""
    except TypeError:  # it asks for an argument: no property
        return ""
    return said if isinstance(said, str) else ""


def _of_model(model: QAbstractItemModel, parent: QModelIndex) -> Iterator[str]:
    is_list = not isinstance(model, QAbstractTableModel | QSortFilterProxyModel)  # its counts are private
    for column in range(1 if is_list else model.columnCount(parent)):
        for role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
            yield str(model.headerData(column, Qt.Orientation.Horizontal, role) or "")
            for row in range(model.rowCount(parent)):
                yield str(model.index(row, column, parent).data(role) or "")


@pytest.fixture(scope="module")
def script() -> Iterator[ScriptedApplication]:
    with open_window() as window:
        scripted = ScriptedApplication(window)
        scripted.run("file.open", path=SAMPLE)
        yield scripted
        window.workbench.preferences.set("language", "en")
        QApplication.processEvents()


@pytest.fixture
def german(script: ScriptedApplication) -> ScriptedApplication:
    script.run("help.german")
    QApplication.processEvents()
    return script


def heights(window: MainWindow) -> dict[str, int]:
    """Of the docks that are in front: their widths are as their words are."""
    return {id: d.height() for id, d in window.docks.items() if not d.visibleRegion().isEmpty()}


def settle(window: MainWindow) -> None:
    """Let the docks come to rest."""
    window.picture("window", window.width(), window.height())


def test_the_german_window_says_nothing_in_english(german: ScriptedApplication) -> None:
    words = translate.read("de")
    german_too = set(words.values())
    plan = german.workbench.plan
    assert plan is not None
    for kind, things in (("door", plan.doors), ("region", plan.regions), ("plane", plan.planes)):
        german.window.show_pane(f"{kind}_list")
        for thing in things[:3]:
            german.run("edit.select", kind=kind, ids=[thing.id])
            for said in set(texts(german.window)):
                plain = re.sub(r"<[^>]*>|\w+\.\w+", " ", said)  # without marks, settings and files
                assert said in german_too or words.get(said, said) == said, said
                assert not ENGLISH.search(plain), said


def test_the_language_changes_at_once_and_all_else_stays(script: ScriptedApplication) -> None:
    window, workbench = script.window, script.workbench
    script.run("help.english")
    script.run("plan.set", name="doors.max_width", value=1.6)
    plan = workbench.plan
    assert plan is not None
    script.run("edit.select", kind="door", ids=[plan.doors[0].id])
    settle(window)
    said, before = set(texts(window)), (workbench.state, workbench.view.look, heights(window))
    script.run("help.german")
    QApplication.processEvents()
    assert window.docks["floor_plan"].windowTitle() == "Grundriss"
    assert window.actions_by_id["file.open"].text() == "Öffnen…"
    settle(window)
    assert heights(window) == before[2]
    assert (workbench.state, workbench.view.look) == before[:2]
    script.run("help.english")
    settle(window)
    assert said - set(texts(window)) == set()
    script.run("edit.undo")
    script.run("edit.redo")
    assert workbench.state == before[0]


def test_a_language_that_is_not_there_is_refused(script: ScriptedApplication) -> None:
    with pytest.raises(UsageError, match="Language is one of"):
        script.workbench.preferences.set("language", "fr")
    assert set(translation.LANGUAGES) == {"en", "de"}

"""The export dialog begins with the window's units and language, and hands on what is chosen."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from PySide6.QtCore import QLocale, Qt
from pytestqt.qtbot import QtBot

from floorcast_app.dialogs.export import ExportDialog
from floorcast_app.main_window import MainWindow
from floorplan_core.errors import UsageError
from tests.app.windows import open_window
from tests.factories import small_flat

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def window(monkeypatch: pytest.MonkeyPatch):  # type: ignore[no-untyped-def]
    with open_window() as made:
        made.workbench.plan = small_flat()
        monkeypatch.setattr(made, "unattended", False)
        yield made
        made.workbench.plan = None


def dialog_of(window: MainWindow) -> ExportDialog:
    found = window.findChild(ExportDialog)
    assert found is not None
    return found


@pytest.mark.parametrize(("units", "expected"), [("m", "metric"), ("ft-in", "imperial")])
def test_it_begins_with_the_units_and_the_language_of_the_window(
    window: MainWindow, units: str, expected: str
) -> None:
    before = QLocale()
    QLocale.setDefault(QLocale("de_DE"))
    try:
        window.workbench.view.set(units=units)
        window.workbench.run("file.export")
        dialog = dialog_of(window)
        assert dialog.isVisible()
        assert (dialog.units.currentData(), dialog.language.currentData()) == (expected, "de")
        dialog.close()
    finally:
        QLocale.setDefault(before)


def test_what_is_chosen_is_written(
    window: MainWindow, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(window.workbench.ui, "ask_save", lambda *a: tmp_path / "plan.svg")
    window.workbench.run("file.export")
    dialog = dialog_of(window)
    qtbot.keyClicks(dialog.title, "Rosenhof")
    dialog.units.setCurrentIndex(dialog.units.findData("imperial"))
    dialog.language.setCurrentIndex(dialog.language.findData("de"))
    qtbot.mouseClick(dialog.save, LEFT)
    qtbot.waitUntil(lambda: not window.workbench.jobs.running)
    text = (tmp_path / "plan.svg").read_text(encoding="utf-8")
    assert "Grundriss von Rosenhof" in text
    assert re.search(r"\d+' \d", text)


def test_a_format_without_words_has_nothing_to_choose(window: MainWindow) -> None:
    window.workbench.run("file.export")
    dialog = dialog_of(window)
    dialog.format.setCurrentIndex(dialog.format.findData(".geojson"))
    assert not dialog.units.isEnabled()
    assert not dialog.language.isEnabled()
    dialog.format.setCurrentIndex(dialog.format.findData(".svg"))
    assert dialog.units.isEnabled()
    dialog.close()


def test_a_script_gives_the_path(window: MainWindow, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(window, "unattended", True)
    with pytest.raises(UsageError, match="give the path"):
        window.workbench.run("file.export")

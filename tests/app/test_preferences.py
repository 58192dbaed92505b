"""Preferences: a table of them, kept in the user's settings, in effect at once, by the same action as all."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QSettings, Qt
from PySide6.QtWidgets import QComboBox, QSpinBox
from pytestqt.qtbot import QtBot

from floorcast_app import theme
from floorcast_app.dialogs.preferences import PreferencesDialog
from floorcast_app.main import make_application
from floorcast_app.main_window import MainWindow
from floorcast_app.preferences import PREFERENCES, Preferences
from floorcast_app.qt_post import QtPost
from floorcast_app.recent import RecentFiles
from floorcast_app.workbench import Workbench
from floorplan_core.errors import UsageError
from tests.app.pump import SAMPLE, make_workbench

LEFT = Qt.MouseButton.LeftButton


def settings_in(folder: Path) -> QSettings:
    return QSettings(str(folder / "settings.ini"), QSettings.Format.IniFormat)


def window_with(settings: QSettings) -> MainWindow:
    make_application()
    post = QtPost()
    made = MainWindow(Workbench(post), settings, unattended=True)
    post.setParent(made)
    return made


@pytest.fixture
def window(qtbot: QtBot, tmp_path: Path) -> Iterator[MainWindow]:
    made = window_with(settings_in(tmp_path))
    qtbot.addWidget(made)
    made.show()
    yield made
    made.workbench.preferences.reset()
    made.dresser.finish()
    made.close()


def dialog_of(window: MainWindow) -> PreferencesDialog:
    window.workbench.run("edit.preferences")
    dialog = window.findChild(PreferencesDialog)
    assert dialog is not None and dialog.isVisible() and not dialog.isModal()
    return dialog


@pytest.mark.parametrize("name", [p.name for p in PREFERENCES])
def test_each_refuses_what_it_cannot_be_in_one_sentence(name: str) -> None:
    preferences = Preferences()
    before = preferences[name]
    for wrong in ("purple", -3, 10**9, 1.5, None):
        with pytest.raises(UsageError, match=r"^[A-Z].*given|^[A-Z].* is one of "):
            preferences.set(name, wrong)
    assert preferences[name] == before
    with pytest.raises(UsageError, match="There is no preference 'colour'; there are: language"):
        preferences.set("colour", 1)


def test_what_was_kept_comes_back_and_nonsense_does_not() -> None:
    kept: dict[str, object] = {"look/units": "ft-in", "recent/most": "12", "look/theme": "purple"}
    preferences = Preferences()
    preferences.attach(kept.get, kept.__setitem__)
    assert (preferences["units"], preferences["recent"], preferences["theme"]) == ("ft-in", 12, "light")
    told: list[tuple[str, object]] = []
    preferences.changed.connect(lambda name, value: told.append((name, value)))
    preferences.set("autosave", 60)
    preferences.set("autosave", 60)
    assert told == [("autosave", 60)] and kept["recovery/interval"] == 60


def test_memory_is_that_of_surveys_opened_from_then_on() -> None:
    workbench = make_workbench()
    workbench.read_and_plan = lambda: None  # type: ignore[method-assign]
    workbench.open_survey(SAMPLE)
    assert workbench.state.config.voxels.memory is None
    workbench.run("edit.preferences", name="memory", value=512)
    assert workbench.state.config.voxels.memory is None
    workbench.open_survey(SAMPLE)
    assert workbench.state.config.voxels.memory == 512
    assert workbench.document.undo_text == ""


def test_fewer_recent_files_are_offered(tmp_path: Path) -> None:
    many = 5
    recent = RecentFiles(settings_in(tmp_path), lambda: many)
    for k in range(7):
        (tmp_path / f"{k}.ply").touch()
        recent.put(tmp_path / f"{k}.ply")
    assert [p.stem for p in recent.paths()] == ["6", "5", "4", "3", "2"]
    many = 2
    assert [p.stem for p in recent.paths()] == ["6", "5"]


def test_the_dialog_changes_the_window_at_once(window: MainWindow, qtbot: QtBot) -> None:
    dialog, view = dialog_of(window), window.workbench.view
    choice = dialog.fields["theme"]
    assert isinstance(choice, QComboBox)
    choice.setFocus()
    qtbot.keyClick(choice, Qt.Key.Key_Down)
    qtbot.waitUntil(lambda: view.look.theme == "dark")
    window.dresser.finish()
    assert theme.name() == "dark"
    units = dialog.fields["units"]
    assert isinstance(units, QComboBox)
    qtbot.keyClick(units, Qt.Key.Key_End)
    qtbot.waitUntil(lambda: view.look.units == "ft-in")
    number = dialog.fields["recent"]
    assert isinstance(number, QSpinBox)
    number.selectAll()
    qtbot.keyClicks(number, "3")
    qtbot.keyClick(number, Qt.Key.Key_Return)
    assert window.workbench.preferences["recent"] == 3
    qtbot.mouseClick(dialog.reset, LEFT)
    assert view.look.units == "m" and number.value() == 8 and choice.currentData() == "light"
    assert window.workbench.document.undo_text == ""
    dialog.close()


def test_what_is_switched_elsewhere_shows_in_the_dialog(window: MainWindow) -> None:
    dialog = dialog_of(window)
    window.workbench.run("view.units")
    units = dialog.fields["units"]
    assert isinstance(units, QComboBox) and units.currentData() == "ft-in"
    assert dialog_of(window) is dialog  # one is enough
    dialog.close()


def test_memory_steps_over_what_is_too_little(window: MainWindow, qtbot: QtBot) -> None:
    dialog = dialog_of(window)
    box = dialog.fields["memory"]
    assert isinstance(box, QSpinBox)
    assert box.text() == "Half of what is free"
    box.stepUp()
    assert window.workbench.preferences["memory"] == box.value() == 256
    box.stepDown()
    assert window.workbench.preferences["memory"] == 0
    box.setValue(10)  # refused: told, and shown as it was
    assert window.workbench.preferences["memory"] == 0 == box.value()
    dialog.close()


def test_the_next_window_has_them(qtbot: QtBot, tmp_path: Path) -> None:
    first = window_with(settings_in(tmp_path))
    qtbot.addWidget(first)
    for name, value in (("units", "ft-in"), ("recent", 4), ("language", "en"), ("autosave", 45)):
        first.workbench.run("edit.preferences", name=name, value=value)
    first.close()
    second = window_with(settings_in(tmp_path))
    qtbot.addWidget(second)
    kept = second.workbench.preferences
    assert (kept["units"], kept["recent"], kept["language"], kept["autosave"]) == ("ft-in", 4, "en", 45)
    assert second.workbench.view.look.units == "ft-in"
    second.close()

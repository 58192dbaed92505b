"""A theme change is spread over turns of the event loop, and ends as one made at once."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtGui import QColor, QImage
from PySide6.QtWidgets import QApplication, QDialog, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from floorcast_app import theme
from floorcast_app.main import make_application, make_window
from floorcast_app.main_window import MainWindow


@pytest.fixture
def window() -> Iterator[MainWindow]:
    app = make_application()
    theme.apply_theme(app, "light")
    made = make_window(unattended=True)
    made.resize(1200, 800)
    made.show()
    QApplication.processEvents()
    yield made
    made.close()
    theme.apply_theme(app, "light")


def _picture(window: QWidget) -> QImage:
    QApplication.processEvents()
    return window.grab().toImage()


def _ground(widget: QWidget) -> str:
    return QColor(_picture(widget).pixel(QPoint(3, 3))).name()


def test_it_takes_several_turns_and_is_whole_at_the_end(window: MainWindow, qtbot: QtBot) -> None:
    window.workbench.run("view.theme")
    assert window.dresser.busy and not window.updatesEnabled()
    qtbot.waitUntil(lambda: not window.dresser.busy, timeout=30_000)
    assert window.updatesEnabled() and theme.name() == "dark"
    assert _ground(window.menuBar()) == theme.colours("dark").panel


def test_it_looks_as_if_it_had_been_made_at_once(window: MainWindow) -> None:
    light = _picture(window)
    window.workbench.run("view.theme")
    window.dresser.finish()
    stepwise = _picture(window)
    fresh = make_window(unattended=True)
    fresh.workbench.view.set(theme="dark")  # nobody sees it yet: at once
    assert not fresh.dresser.busy
    fresh.resize(window.size())
    fresh.show()
    assert _picture(fresh) == stepwise != light
    fresh.close()


def test_there_and_back_is_the_first_picture(window: MainWindow) -> None:
    light = _picture(window)
    for _ in range(2):
        window.workbench.run("view.theme")  # the second interrupts the first
    window.dresser.finish()
    assert _picture(window) == light


def test_a_dialog_that_opens_later_wears_the_theme(window: MainWindow) -> None:
    window.workbench.run("view.theme")
    window.dresser.finish()
    dialog = QDialog(window)
    QVBoxLayout(dialog)
    dialog.show()
    assert _ground(dialog) == theme.colours("dark").panel
    dialog.close()


def test_a_picture_asked_for_meanwhile_is_of_the_new_theme(window: MainWindow) -> None:
    window.workbench.run("view.theme")
    image = window.picture("window", 1200, 800)
    assert QColor(image.pixel(3, 3)).name() == theme.colours("dark").panel

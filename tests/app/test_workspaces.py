"""Switching between workspaces leaves nothing behind."""

from __future__ import annotations

from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from floorcast_app.dock_layout import tab_bars
from floorcast_app.main_window import MainWindow
from floorcast_app.script import ScriptedApplication
from tests.app.pump import SAMPLE
from tests.app.windows import open_window


def _seen_tabs(window: MainWindow) -> list[list[str]]:
    QApplication.processEvents()
    inside = [b for b in tab_bars(window) if b.isVisible() and window.rect().intersects(b.geometry())]
    return sorted([b.tabText(i) for i in range(b.count())] for b in inside)


def test_every_workspace_comes_back_as_it_was(qtbot: QtBot) -> None:
    with open_window() as window:
        first = {}
        for name in ("inspect", "plan", "run"):
            window.workbench.run(f"view.{name}")
            qtbot.waitUntil(lambda: _seen_tabs(window) != [])
            qtbot.wait(100)  # until Qt has laid out the docks
            first[name] = _seen_tabs(window)
        for name in ("inspect", "plan", "run", "inspect", "run", "plan"):
            window.workbench.run(f"view.{name}")
            qtbot.waitUntil(lambda n=name: _seen_tabs(window) == first[n])  # type: ignore[misc]


def test_the_tables_do_not_take_what_a_larger_window_gives(qtbot: QtBot) -> None:
    with open_window(1280, 720) as window:
        qtbot.wait(200)
        window.workbench.run("view.run")
        qtbot.wait(100)
        window.resize(1920, 1200)
        qtbot.wait(200)
        window.workbench.run("view.inspect")
        qtbot.waitUntil(lambda: window.docks["region_list"].height() < 0.3 * window.height())


def test_a_workspace_chosen_right_after_a_picture_is_its_own(qtbot: QtBot) -> None:
    """For its picture the window has another size for a moment, which the docks of before were to follow."""
    with open_window(1440, 900) as window:
        app = ScriptedApplication(window)
        app.run("file.open", path=SAMPLE)
        window.picture("window", 1280, 800)
        app.run("view.plan")
        qtbot.wait(100)
        qtbot.waitUntil(lambda: not window._proportions.busy)
        assert window.docks["floor_plan"].height() > 2 * window.docks["region_list"].height()


def test_panes_keep_their_shares_in_a_larger_window_and_come_back_exactly(qtbot: QtBot) -> None:
    def rested() -> bool:
        QApplication.processEvents()
        return not window._proportions.busy

    def heights() -> list[int]:
        qtbot.wait(100)
        qtbot.waitUntil(rested)
        return [window.docks[id].height() for id in ("space", "free_space", "region_list")]

    with open_window(1440, 900) as window:
        first = heights()
        window.resize(1900, 1200)
        larger = heights()
        share = sum(larger) / sum(first)
        assert all(abs(now - share * was) < 3 for now, was in zip(larger, first, strict=True))
        window.resize(1440, 900)
        assert all(abs(now - was) < 3 for now, was in zip(heights(), first, strict=True))


def test_a_plan_that_was_whole_stays_whole_in_a_pane_of_another_size(qtbot: QtBot) -> None:
    with open_window(1440, 900) as window:
        w = window.workbench
        ScriptedApplication(window).run("file.open", path=SAMPLE)
        w.run("view.plan")
        w.run("view.fit")
        pane = window.pane("floor_plan")
        before, room = w.view.look.span, w.view.room
        window.resize(1000, 640)
        qtbot.waitUntil(lambda: w.view.room != room and pane.ready)
        smaller, room = w.view.look.span, w.view.room
        assert smaller > before  # the dimensions need more of a smaller pane
        w.view.set(span=smaller / 2)  # somebody has zoomed in: that stays
        window.resize(1440, 900)
        qtbot.waitUntil(lambda: w.view.room != room and pane.ready)
        assert w.view.look.span == smaller / 2

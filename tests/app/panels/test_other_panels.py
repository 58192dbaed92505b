"""History, warnings, ground truth, timeline, status, progress, messages and the empty state."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, QSettings, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDockWidget,
    QLineEdit,
    QMainWindow,
    QPushButton,
    QToolButton,
    QWidget,
)
from pytestqt.qtbot import QtBot

from floorcast_app.jobs import Progress
from floorcast_app.panels.assumptions_banner import AssumptionsBanner
from floorcast_app.panels.check_model import DIFFERENCE, LASER, NOTE
from floorcast_app.panels.empty_state import EmptyState
from floorcast_app.panels.ground_truth_panel import GroundTruthPanel
from floorcast_app.panels.history_panel import HistoryPanel
from floorcast_app.panels.missing_banner import MissingBanner
from floorcast_app.panels.status import StatusBar
from floorcast_app.panels.timeline_panel import TimelinePanel
from floorcast_app.panels.toast import Toast
from floorcast_app.panels.warnings_panel import WarningsPanel
from floorcast_app.recent import RecentFiles
from floorcast_app.run_replay import Snapshot
from floorcast_app.selection import Item
from floorcast_app.workbench import Workbench

LEFT = Qt.MouseButton.LeftButton


def _shown(qtbot: QtBot, widget: QWidget, width: int = 700, height: int = 240) -> None:
    qtbot.addWidget(widget)
    widget.resize(width, height)
    widget.show()


# ---- history and warnings -----------------------------------------------------------------------------


def test_a_click_in_the_history_goes_there_and_back(workbench: Workbench, qtbot: QtBot) -> None:
    panel = HistoryPanel(workbench)
    _shown(qtbot, panel)
    for value in (1.4, 1.5, 1.6):
        workbench.run("plan.set", name="doors.max_width", value=value)
    qtbot.waitUntil(lambda: panel.list.count() == 4)
    place = panel.list.visualItemRect(panel.list.item(1)).center()
    qtbot.mouseClick(panel.list.viewport(), LEFT, pos=place)
    assert workbench.state.config.doors.max_width == 1.4
    qtbot.waitUntil(lambda: panel.list.currentRow() == 1)
    place = panel.list.visualItemRect(panel.list.item(3)).center()
    qtbot.mouseClick(panel.list.viewport(), LEFT, pos=place)
    assert workbench.state.config.doors.max_width == 1.6


def test_warnings_are_counted_in_the_title(planned: Workbench, qtbot: QtBot) -> None:
    dock = QDockWidget("Warnings")
    panel = WarningsPanel(planned)
    dock.setWidget(panel)
    _shown(qtbot, dock)
    before = planned.warnings
    planned.jobs.warned.emit("The wall moved at (1.00, 2.00) is not there any more.")
    qtbot.waitUntil(lambda: dock.windowTitle() == f"Warnings ({len(before) + 1})")
    texts = [panel.list.item(i).text() for i in range(panel.list.count())]
    assert any("is not there any more" in t for t in texts)
    assert any("z axis is taken as up" in t for t in texts)  # the assumption of the bundled survey
    planned.warnings = before


# ---- ground truth -------------------------------------------------------------------------------------


@pytest.fixture
def table(planned: Workbench, qtbot: QtBot) -> GroundTruthPanel:
    panel = GroundTruthPanel(planned)
    _shown(qtbot, panel)
    planned.run("measure.add", start=(0.0, 0.0), end=(3.2, 0.0))
    planned.run("measure.add", start=(0.0, 0.0), end=(0.0, 5.0), measured=5.1)
    qtbot.waitUntil(lambda: panel.model.rowCount() == 2)
    return panel


def _type_into(qtbot: QtBot, panel: GroundTruthPanel, row: int, column: int, text: str) -> None:
    place = panel.table.visualRect(panel.model.index(row, column)).center()
    qtbot.mouseClick(panel.table.viewport(), LEFT, pos=place)
    qtbot.mouseDClick(panel.table.viewport(), LEFT, pos=place)
    line = panel.table.viewport().findChild(QLineEdit)
    assert line is not None
    line.selectAll()
    qtbot.keyClicks(line, text)
    qtbot.keyClick(line, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: panel.table.state() != QAbstractItemView.State.EditingState)


@pytest.mark.parametrize("typed", ["3.18", "3,18 m", "318 cm", "3180mm"])
def test_what_the_laser_meter_said_is_typed_in(table: GroundTruthPanel, qtbot: QtBot, typed: str) -> None:
    _type_into(qtbot, table, 0, LASER, typed)
    assert table.workbench.state.checks[0].measured == pytest.approx(3.18)
    qtbot.waitUntil(lambda: table.model.index(0, DIFFERENCE).data() == "20 mm")
    qtbot.waitUntil(lambda: table.means.text().startswith("Mean of 2: 60 mm · 1.29 %"))


def test_what_is_no_length_is_refused_with_a_sentence(table: GroundTruthPanel, qtbot: QtBot) -> None:
    _type_into(qtbot, table, 0, LASER, "wide")
    assert table.workbench.state.checks[0].measured is None
    assert "wide is no length" in table.workbench.ui.told[-1][1]  # type: ignore[attr-defined]


def test_a_note_is_kept_with_its_row(table: GroundTruthPanel, qtbot: QtBot) -> None:
    _type_into(qtbot, table, 1, NOTE, "by the window")
    check = table.workbench.state.checks[1]
    assert (check.note, check.measured) == ("by the window", 5.1)


def test_a_row_is_selected_both_ways_and_deleted(table: GroundTruthPanel, qtbot: QtBot) -> None:
    selection = table.workbench.selection
    first, second = (Item("check", c.id) for c in table.workbench.state.checks)
    selection.select(second)
    chosen = [i.row() for i in table.table.selectionModel().selectedRows()]
    assert chosen == [1]
    qtbot.mouseClick(
        table.table.viewport(), LEFT, pos=table.table.visualRect(table.model.index(0, 0)).center()
    )
    assert selection.item == first
    qtbot.keyClick(table.table, Qt.Key.Key_Delete)
    assert [c.id for c in table.workbench.state.checks] == [second.id]


# ---- timeline -----------------------------------------------------------------------------------------


def test_a_run_is_picked_and_played_and_left(planned: Workbench, qtbot: QtBot) -> None:
    plan = planned.plan
    panel = TimelinePanel(planned)
    _shown(qtbot, panel, 1000, 140)
    assert panel.replay.isVisible() and panel.replay.isEnabled()
    planned.timeline = [Snapshot(20.0 * i, 5.0 * i, plan if i else None, 10.0 * i, 5.0) for i in range(6)]
    planned.timeline_changed.emit()
    qtbot.waitUntil(lambda: panel.slider.isVisible() and panel.slider.maximum() == 5)
    panel.slider.setFocus()
    qtbot.keyClick(panel.slider, Qt.Key.Key_Home)
    assert panel.clock.text() == "00:00:00" and "no plan yet" in panel.facts.text()
    qtbot.mouseClick(panel.spark, LEFT, pos=QPoint(round(panel.spark.x_of(3)), 10))
    assert panel.at == 3 and panel.clock.text() == "00:01:00"
    assert "path 15.000 m" in panel.facts.text() and "seen 30.00 m²" in panel.facts.text()
    qtbot.mouseClick(panel.play, LEFT)
    qtbot.waitUntil(lambda: panel.at == 4)
    qtbot.mouseClick(panel.whole, LEFT)
    assert not panel.play.isChecked() and planned.plan is plan
    planned.timeline = []


# ---- status, progress, messages -----------------------------------------------------------------------


def test_the_status_bar_follows_the_pointer_and_the_plan(planned: Workbench, qtbot: QtBot) -> None:
    bar = StatusBar(planned)
    _shown(qtbot, bar, 1200, 30)
    planned.pointer_moved.emit(12.4312, -3.9)
    assert bar.pointer.text() == "x 12.431  y -3.900 m"
    planned.pointer_moved.emit(None, None)
    assert bar.pointer.text() == ""
    assert planned.plan is not None
    assert f"{len(planned.plan.planes)} planes" in bar.counts.text()
    assert "support" in bar.frame.text()


def test_progress_names_the_stage_and_the_time_left_and_cancels(workbench: Workbench, qtbot: QtBot) -> None:
    bar = StatusBar(workbench)
    _shown(qtbot, bar, 1200, 30)
    assert not bar.progress.isVisible()
    workbench.jobs.started.emit("Reading a.ply")
    assert bar.progress.isVisible()
    workbench.jobs.progressed.emit(Progress("read", 25, 100, 12.0))
    assert bar.progress.text.text() == "Reading points"
    assert bar.progress.left.text() == "12.0 s left"
    assert bar.progress.bar.value() == bar.progress.bar.maximum() // 4
    workbench.jobs.progressed.emit(Progress("cover"))
    assert bar.progress.bar.maximum() == 0  # nobody knows how long
    workbench.jobs.ended.emit(None)
    assert not bar.progress.isVisible()


def test_cancel_stops_the_job(workbench: Workbench, qtbot: QtBot) -> None:
    from threading import Event as Flag

    bar = StatusBar(workbench)
    _shown(qtbot, bar, 1200, 30)
    go = Flag()
    workbench.jobs.start("Waiting", lambda observer: go.wait(30), lambda _: None)
    qtbot.mouseClick(bar.progress.cancel, LEFT)
    assert not workbench.jobs.running
    go.set()


def test_errors_stay_until_they_are_clicked(qtbot: QtBot) -> None:
    window = QWidget()
    _shown(qtbot, window, 800, 400)
    toast = Toast(window)
    toast.tell("Cannot read a.ply.", "error")
    assert toast.isVisible() and not toast._gone.isActive()
    assert window.rect().contains(toast.geometry())
    window.resize(500, 300)
    assert window.rect().contains(toast.geometry())
    qtbot.mouseClick(toast.findChild(QToolButton), LEFT)
    assert not toast.isVisible()
    toast.tell("Saved.")
    assert toast._gone.isActive()


# ---- the first things a person sees -------------------------------------------------------------------


class _Recent:
    def __init__(self, *paths: Path) -> None:
        self._paths = list(paths)

    def paths(self) -> list[Path]:
        return self._paths


def test_the_empty_state_opens_what_is_dropped_and_what_was_recent(
    workbench: Workbench, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[tuple[str, object]] = []
    monkeypatch.setattr(workbench, "try_run", lambda id, **a: opened.append((id, a.get("path"))))
    survey = tmp_path / "survey.ply"
    survey.touch()
    window = QMainWindow()
    empty = EmptyState(workbench, _Recent(survey), window)  # type: ignore[arg-type]
    _shown(qtbot, window, 1000, 800)
    empty.cover(window)
    empty.show()
    qtbot.mouseClick(empty.drop.sample, LEFT)
    qtbot.mouseClick(empty.drop.open, LEFT)

    def cards() -> list[QToolButton]:
        return [c for c in empty.findChildren(QToolButton, "recent") if c.isVisible()]

    qtbot.waitUntil(lambda: bool(cards()))
    qtbot.mouseClick(cards()[0], LEFT)
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(survey))])
    no, copy = Qt.KeyboardModifier.NoModifier, Qt.DropAction.CopyAction
    empty.drop.dropEvent(QDropEvent(QPointF(5, 5), copy, data, LEFT, no))
    assert [id for id, _ in opened] == ["file.open_sample", "file.open", "file.open", "file.open"]
    assert Path(str(opened[2][1])) == survey == Path(str(opened[3][1]))


def test_guesses_are_shown_once_and_can_be_changed(planned: Workbench, qtbot: QtBot, monkeypatch) -> None:  # type: ignore[no-untyped-def]
    window = QMainWindow()
    _shown(qtbot, window, 1000, 600)
    banner = AssumptionsBanner(planned, window)
    planned.plan_changed.emit(planned.plan)
    assert banner.isVisible()
    dock = QDockWidget(window)
    window.addDockWidget(Qt.DockWidgetArea.LeftDockWidgetArea, dock)
    qtbot.waitUntil(lambda: dock.y() >= banner.geometry().bottom() > 20)  # it covers nothing
    for width in (1000, 800):  # its words are never cut
        window.resize(width, 600)
        qtbot.waitUntil(lambda w=width: banner.width() == w)  # type: ignore[misc]
        assert banner.text.height() >= banner.text.heightForWidth(banner.text.width())
    assert "metres" in banner.text.text() and "input.unit" not in banner.text.text()
    said: list[dict[str, object]] = []
    monkeypatch.setattr(planned, "try_run", lambda id, **a: said.append(a))
    banner.unit.setFocus()
    qtbot.keyClick(banner.unit, Qt.Key.Key_End)
    assert said == [{"name": "input.unit", "value": "ft"}]
    banner.hide()
    planned.plan_changed.emit(planned.plan)
    assert not banner.isVisible()


def test_a_survey_that_moved_is_asked_for_beside_the_work(workbench: Workbench, qtbot: QtBot) -> None:
    window = QMainWindow()
    _shown(qtbot, window, 1000, 600)
    banner = MissingBanner(workbench, window)
    assert not banner.isVisible()
    workbench.input_missing.emit(Path("/surveys/old/tower.e57"))
    qtbot.waitUntil(banner.isVisible)
    assert "tower.e57" in banner.text.text() and "old" in banner.text.text()
    asked: list[str] = []
    workbench.try_run = lambda id, **_: asked.append(id)  # type: ignore[method-assign, assignment]
    for button in banner.findChildren(QPushButton):
        qtbot.mouseClick(button, LEFT)
    assert asked == ["file.relocate", "file.close"]
    workbench.survey_changed.emit()
    assert not banner.isVisible()


def test_the_names_of_recent_files_are_never_cut_off(
    workbench: Workbench, qtbot: QtBot, tmp_path: Path
) -> None:
    recent = RecentFiles(QSettings(str(tmp_path / "s.ini"), QSettings.Format.IniFormat))
    for k in range(5):
        (tmp_path / f"wing-{k}").mkdir()
        (tmp_path / f"wing-{k}" / "points.ply").touch()
        recent.put(tmp_path / f"wing-{k}" / "points.ply")
    for height, shown in ((640, 3), (900, 5)):
        window = QMainWindow()
        empty = EmptyState(workbench, recent, window)
        _shown(qtbot, window, 1200, height)
        empty.cover(window)
        empty.show()
        qtbot.waitUntil(lambda e=empty, n=shown: len(_live(e)) == n)  # type: ignore[misc]
        cards = _live(empty)
        assert all(card.height() >= card.sizeHint().height() for card in cards)
        assert {card.text().split("/")[0] for card in cards} <= {f"wing-{k}" for k in range(5)}


def _live(empty: EmptyState) -> list[QToolButton]:
    return [card for card in empty.findChildren(QToolButton, "recent") if card.isVisible()]

"""The window as a whole: actions, docks, dropping, cancelling, closing, pictures."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPoint, Qt, QUrl
from PySide6.QtGui import QDropEvent, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from floorcast_app.main import make_window
from floorcast_app.main_window import MainWindow
from floorcast_app.panes import PANES
from floorcast_app.script import ScriptedApplication
from floorplan_core.errors import UsageError
from tests.app.pump import SAMPLE
from tests.app.windows import open_window


@pytest.fixture(scope="module")
def script() -> Iterator[ScriptedApplication]:
    """A window with the bundled survey planned, driven by actions."""
    with open_window() as window:
        scripted = ScriptedApplication(window)
        scripted.run("file.open", path=SAMPLE)
        yield scripted


@pytest.fixture
def window(script: ScriptedApplication) -> MainWindow:
    return script.window


def test_every_action_has_a_place_and_a_tip(window: MainWindow) -> None:
    keys: dict[str, str] = {}
    for action in window.workbench.actions:
        qt = window.actions_by_id[action.id]
        assert qt.text() and action.tip.endswith((".", "?")), action.id
        for key in (k.strip() for k in action.shortcut.split(" | ") if action.shortcut):
            assert not QKeySequence(key).isEmpty(), key
            assert key not in keys, f"{key}: {keys.get(key)} and {action.id}"
            keys[key] = action.id


def test_the_window_names_its_survey(window: MainWindow) -> None:
    assert window.windowTitle().startswith("sample_survey") and not window.empty.isVisible()


@pytest.mark.parametrize("pane", [p.id for p in PANES] + ["window"])
def test_every_pane_gives_a_picture_of_any_size(window: MainWindow, pane: str) -> None:
    image = window.picture(pane, 640, 480)
    assert (image.width(), image.height()) == (640, 480)
    colours = {image.pixel(x, y) for x in range(0, 640, 16) for y in range(0, 480, 16)}
    assert len(colours) > 1, "an empty picture"


def test_a_picture_of_no_pane_or_no_size_is_refused(window: MainWindow, tmp_path: Path) -> None:
    for pane, width, said in (("kitchen", 640, "no pane"), ("space", 3, "16 to 16384")):
        with pytest.raises(UsageError, match=said):
            window.save_picture(tmp_path / "a.png", pane, width, 480)
    with pytest.raises(UsageError, match=r"\.png"):
        window.save_picture(tmp_path / "a.doc", "space", 640, 480)
    assert list(tmp_path.iterdir()) == []


def test_workspaces_show_other_panes(script: ScriptedApplication) -> None:
    window = script.window
    script.run("view.plan")
    assert not window.docks["space"].isVisible() and window.docks["floor_plan"].isVisible()
    script.run("view.run")
    assert window.docks["timeline"].isVisible()
    script.run("view.inspect")
    assert all(window.docks[p].isVisible() for p in ("space", "planes", "free_space", "floor_plan"))


def test_escape_puts_the_tool_down_then_the_selection(script: ScriptedApplication) -> None:
    from floorcast_app.selection import Item

    workbench = script.workbench
    workbench.selection.select(Item("region", workbench.plan.regions[0].id))
    script.run("tool.measure")
    QTest.keyClick(script.window, Qt.Key.Key_Escape)
    assert workbench.tool == "select" and workbench.selection.item is not None
    QTest.keyClick(script.window, Qt.Key.Key_Escape)
    assert workbench.selection.item is None


def test_escape_cancels_what_runs_and_the_last_plan_stays(script: ScriptedApplication) -> None:
    workbench, before = script.workbench, script.workbench.plan
    script.run("plan.again", wait=False)
    assert workbench.jobs.running
    QTest.keyClick(script.window, Qt.Key.Key_Escape)
    assert not workbench.jobs.running and workbench.plan is before
    script.run("plan.again")
    assert len(workbench.plan.regions) == len(before.regions)


def test_a_run_is_replayed(script: ScriptedApplication) -> None:
    workbench, whole = script.workbench, script.workbench.plan
    script.run("plan.replay", every=50.0)
    timeline = workbench.timeline
    assert len(timeline) >= 3 and timeline[-1].plan is not None
    assert [s.time for s in timeline] == sorted(s.time for s in timeline)
    assert timeline[-1].seen > timeline[0].seen
    place = workbench.to_local(workbench.view.look.centre)
    workbench.show_snapshot(0)
    assert workbench.to_local(workbench.view.look.centre) == pytest.approx(place, abs=1e-6)
    space = script.window.pane("space")
    assert space._wanted_now().scans == len(workbench.plan.trajectory)
    workbench.show_snapshot(len(timeline) - 1)
    assert workbench.plan is timeline[-1].plan
    workbench.show_snapshot(None)
    assert space._wanted_now().scans is None
    assert workbench.plan is whole


def test_undo_brings_back_a_setting(script: ScriptedApplication) -> None:
    before = script.workbench.state
    script.run("plan.set", name="doors.max_width", value=1.1)
    assert script.workbench.plan.config.doors.max_width == 1.1
    script.run("edit.undo")
    assert script.workbench.state == before
    assert script.workbench.plan.config == before.config


def test_a_setting_out_of_bounds_is_refused_in_one_sentence(script: ScriptedApplication) -> None:
    before = script.workbench.state
    with pytest.raises(UsageError, match="max_width"):
        script.run("plan.set", name="doors.max_width", value=99)
    with pytest.raises(UsageError, match="no setting"):
        script.run("plan.set", name="doors.colour", value="red")
    assert script.workbench.state == before


def test_a_dropped_file_is_opened(qapp: QApplication) -> None:
    window = make_window(unattended=True)
    window.show()
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(SAMPLE))])
    copy, left, none = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    window.dropEvent(QDropEvent(QPoint(5, 5), copy, data, left, none))
    assert window.workbench.state.survey.path == SAMPLE and window.workbench.jobs.running
    window.close()  # in the middle of the job
    assert window.workbench.jobs.wait(60)
    assert not window.workbench.jobs.running


def test_a_file_that_is_no_survey_is_one_sentence(qapp: QApplication, tmp_path: Path) -> None:
    from floorplan_core.errors import InputError

    nonsense = tmp_path / "a.ply"
    nonsense.write_bytes(b"ply nonsense")
    window = make_window(unattended=True)
    script = ScriptedApplication(window)
    with pytest.raises(InputError, match=r"a\.ply"):
        script.run("file.open", path=nonsense)
    window.close()


def test_closing_leaves_no_thread_of_ours(qapp: QApplication) -> None:
    before = set(threading.enumerate())
    window = make_window(unattended=True)
    window.show()
    script = ScriptedApplication(window)
    script.run("file.open", wait=False, path=SAMPLE)
    window.close()
    assert window.workbench.jobs.wait(60)
    left = [t for t in threading.enumerate() if t not in before and not t.daemon]
    for thread in left:  # pools end when their owner does
        thread.join(10)
    assert not [t for t in left if t.is_alive() and "ThreadPoolExecutor" not in t.name]

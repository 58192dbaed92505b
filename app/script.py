"""Scripts: a Python file that says ``app.run("file.open", path=...)``, or a recorded list of actions as JSON.

The same actions as the menus, by the same ids. After each one the script waits until the work that it started
is done, so that a script reads like what a person does. Pictures of panes need no display and no GPU.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QApplication

from floorcast_app.main_window import MainWindow
from floorcast_app.panels.base import catch_up
from floorcast_app.workbench import Workbench
from floorplan_core.errors import FloorPlanError, InputError, UsageError


class ScriptedApplication:
    """What a script sees as ``app``."""

    def __init__(self, window: MainWindow) -> None:
        self.window = window
        self.workbench: Workbench = window.workbench
        self._error: Exception | None = None
        self.workbench.jobs.ended.connect(self._ended)

    def run(self, action: str, wait: bool = True, **arguments: Any) -> Any:
        """Run an action by id, then wait for the work that it started; its failure is raised here."""
        self._error = None
        result = self.workbench.run(action, **arguments)
        if wait:
            self.wait()
        return result

    def wait(self) -> None:
        """Let events happen until no job runs; a job that failed raises its error here."""
        while self.workbench.jobs.running:
            loop = QEventLoop()
            QTimer.singleShot(20, loop.quit)
            loop.exec()
        _settle()
        if self._error is not None:
            error, self._error = self._error, None
            raise error

    def picture(self, path: str | Path, pane: str = "window", width: int = 1440, height: int = 900) -> None:
        """Write a picture of a pane, or of the whole window."""
        _settle()
        self.window.save_picture(Path(path), pane, width, height)

    def click(self, pane: str, x: float, y: float) -> None:
        """Click at plan coordinates (metres, manhattan frame) in a 2D pane, with the tool that is on."""
        from PySide6.QtCore import QPointF, Qt
        from PySide6.QtTest import QTest

        from floorcast_app.viewports.canvas import PlanCanvas

        canvas = self.window.pane(pane)
        if not isinstance(canvas, PlanCanvas):
            raise UsageError(f"Nothing can be clicked by coordinates in the pane {pane!r}.")
        _settle()
        while not canvas.ready:  # what cannot be seen yet cannot be clicked
            QTest.qWait(20)
        where = QPointF(*canvas.camera.point(x, y)).toPoint()
        QTest.mouseMove(canvas, where)
        QTest.mouseClick(canvas, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, where)
        self.wait()

    def _ended(self, error: Exception | None) -> None:
        self._error = error


def _settle() -> None:
    """Let all that follows from the last action happen."""
    QApplication.processEvents()
    catch_up()
    QApplication.processEvents()


def run_script(path: Path, window: MainWindow) -> None:
    """Run ``path``: ``.json`` is a list of actions, anything else Python with ``app`` defined."""
    if not path.is_file():
        raise InputError(f"The script {path} does not exist.")
    app = ScriptedApplication(window)
    if path.suffix.lower() == ".json":
        _run_actions(path, app)
        return
    try:
        # Not by runpy: a helper process of ours would take the script for the program, and run it again.
        exec(
            compile(path.read_bytes(), str(path), "exec"),
            {"app": app, "__name__": "__main__", "__file__": str(path)},
        )
    except FloorPlanError:
        raise
    except SystemExit:
        raise
    except Exception as error:
        raise UsageError(f"{path.name} failed: {type(error).__name__}: {error}.") from error


def _run_actions(path: Path, app: ScriptedApplication) -> None:
    try:
        actions = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, OSError) as error:
        raise InputError(f"{path.name} is not a list of actions ({error}).") from error
    if not isinstance(actions, list) or not all(isinstance(a, dict) and "action" in a for a in actions):
        raise InputError(f'{path.name} is not a list of actions like {{"action": "file.open", "path": …}}.')
    for entry in actions:
        arguments = {k: v for k, v in entry.items() if k != "action"}
        app.run(str(entry["action"]), **arguments)

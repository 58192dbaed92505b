"""Says that the survey of a project is not where it was, and asks where it is now; nothing is stopped."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QMainWindow

from floorcast_app.panels.banner import Banner, answer
from floorcast_app.panels.base import listener_of
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench


class MissingBanner(Banner):
    """Shown until the survey is found or another one is opened."""

    def __init__(self, workbench: Workbench, window: QMainWindow) -> None:
        super().__init__(window, "missing")
        self._workbench = workbench
        for event, then in (
            (workbench.input_missing, self._missing),
            (workbench.survey_changed, self.hide),
            (workbench.plan_changed, self._plan_changed),
        ):
            event.connect(listener_of(self, then, event))

    def _missing(self, path: Path) -> None:
        self.say(lambda: self._ask_for(path))

    def _ask_for(self, path: Path) -> None:
        text = tr("{name} is not where it was, in {folder}. Corrections and checks wait until it is found.")
        self.ask(
            "search",
            text.format(name=path.name, folder=path.parent),
            answer(tr("Find the survey…"), self._find, primary=True),
            answer(tr("Close"), lambda: self._workbench.try_run("file.close")),
        )

    def _find(self) -> None:
        self._workbench.try_run("file.relocate")

    def _plan_changed(self, plan: object) -> None:
        if plan is not None:
            self.hide()

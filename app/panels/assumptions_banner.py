"""Says which unit and up axis were guessed, and lets them be changed; the work goes on meanwhile."""

from __future__ import annotations

import re

from PySide6.QtWidgets import QComboBox, QMainWindow

from floorcast_app.panels.banner import Banner, answer
from floorcast_app.panels.base import listener_of
from floorcast_app.translation import tr, tr_text
from floorcast_app.workbench import Workbench

UNITS = ("m", "cm", "mm", "ft")
AXES = ("z", "y", "x", "-z", "-y", "-x")
GUESSES = ("input.unit", "input.up")  # settings by which an assumption says that it can be forced


class AssumptionsBanner(Banner):
    """Shown once for each survey whose unit or axis was guessed, when its plan is there."""

    def __init__(self, workbench: Workbench, window: QMainWindow) -> None:
        super().__init__(window, "assumptions")
        self._workbench = workbench
        self._shown_for: object = None
        for event, then in (
            (workbench.plan_changed, self._plan_changed),
            (workbench.survey_changed, self._survey_changed),
        ):
            event.connect(listener_of(self, then, event))

    def guesses(self) -> list[str]:
        """The assumptions that are guesses, as sentences."""
        config = self._workbench.state.config.input
        free = {
            name for name, value in zip(GUESSES, (config.unit, config.up), strict=True) if value == "auto"
        }
        return [_plain(tr_text(t)) for t in self._workbench.assumptions if any(name in t for name in free)]

    def _survey_changed(self) -> None:
        self.hide()

    def _plan_changed(self, plan: object) -> None:
        survey = self._workbench.state.survey
        if plan is None or not self.guesses() or self._shown_for == survey:
            return
        self._shown_for = survey
        self.say(self._ask)

    def _ask(self) -> None:
        self.unit = self._choice("input.unit", UNITS, tr("Unit as guessed"))
        self.up = self._choice("input.up", AXES, tr("Up axis as guessed"))
        self.ask("info", " ".join(self.guesses()), self.unit, self.up, answer(tr("Looks right"), self.hide))

    def _choice(self, setting: str, words: tuple[str, ...], first: str) -> QComboBox:
        box = QComboBox()
        box.addItem(first, "auto")
        for word in words:
            box.addItem(word, word)
        box.activated.connect(lambda i: self._choose(setting, box.itemData(i)))
        return box

    def _choose(self, setting: str, value: str) -> None:
        self._workbench.try_run("plan.set", name=setting, value=value)


def _plain(sentence: str) -> str:
    """The sentence without the advice for the command line."""
    return re.sub(r"; [^;]*input\.\w+\.?$", ".", sentence)

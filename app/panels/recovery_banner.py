"""Keeps the document while one works, and offers at the start what a crash left behind."""

from __future__ import annotations

from datetime import datetime

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QMainWindow

from floorcast_app.panels.banner import Banner, answer
from floorcast_app.panels.base import listener_of
from floorcast_app.recovery import Recoverable, Recovery, discard, recoverable, restore
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench
from floorplan_core.errors import FloorPlanError


class RecoveryBanner(Banner):
    """One line for the newest document that was left behind; the others are offered after it."""

    def __init__(self, workbench: Workbench, window: QMainWindow) -> None:
        super().__init__(window, "recovery")
        self._workbench = workbench
        self._recovery = Recovery(workbench)
        self._ticking = QTimer(self, interval=1000 * workbench.preferences.number("autosave"))
        self._ticking.timeout.connect(self._recovery.tick)
        self._ticking.start()
        changed = workbench.preferences.changed
        changed.connect(listener_of(self, self._preferred, changed))
        QTimer.singleShot(0, self, self.offer)

    def offer(self) -> None:
        """Ask about the newest document that a crash left behind; hide where there is none."""
        found = recoverable()
        if not found:
            self.hide()
            return
        self.say(lambda: self._offer(found[0]))

    def _offer(self, newest: Recoverable) -> None:
        when = datetime.fromtimestamp(newest.when).strftime("%Y-%m-%d %H:%M")
        text = tr("Floorcast did not end well. {title} was kept as it was at {when}.")
        self.ask(
            "history",
            text.format(title=newest.title, when=when),
            answer(tr("Recover"), lambda: self._restore(newest), primary=True),
            answer(tr("Discard"), lambda: self._discard(newest)),
        )

    def end(self) -> None:
        """The program ends in good order."""
        self._ticking.stop()
        self._recovery.close()

    def _preferred(self, name: str, value: int) -> None:
        if name == "autosave":
            self._ticking.setInterval(1000 * value)

    def _restore(self, item: Recoverable) -> None:
        self.hide()
        try:
            restore(self._workbench, item)
        except FloorPlanError as error:
            self._workbench.ui.tell(str(error), "error")
            return
        self._recovery.keep()
        self._recovery.flush()  # it is safe under the new name before the old one goes
        discard(item)

    def _discard(self, item: Recoverable) -> None:
        discard(item)
        self.offer()

"""Another theme for a window that is shown, a piece at each turn of the event loop.

A new style sheet for the application makes Qt look at every widget anew, 0.2 to 0.4 s in which the window
stands still. So the application keeps the sheet it began with, and each piece of the window (a dock, a bar, a
dialog) gets one of its own above it, a few at a time. The window keeps its last picture until all wear it.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QApplication, QMainWindow, QWidget

from floorcast_app import theme

TURN = 0.02  # s of work after which other events have their turn

Step = Callable[[], object]


class Dresser(QObject):
    """Changes the theme of one window."""

    def __init__(self, window: QMainWindow, more: Callable[[], Iterable[Step]]) -> None:
        """``more`` gives steps that follow those of the window's pieces."""
        super().__init__(window)
        self._window, self._more = window, more
        self._sheet = ""  # of the pieces; "" where they wear that of the application
        self._steps: deque[Step] = deque()
        self._timer = QTimer(self, interval=0)
        self._timer.timeout.connect(self._turn)

    @property
    def busy(self) -> bool:
        """True until all of the window wears the theme."""
        return bool(self._steps)

    def change(self, name: str) -> None:
        """Begin to change the theme; at once where nobody sees the window yet."""
        app = QApplication.instance()
        assert isinstance(app, QApplication)
        self._steps.clear()  # what is left of an earlier change: this one comes to every piece, too
        if not self._window.isVisible() and not self._sheet:
            self._window.setUpdatesEnabled(True)
            theme.apply_theme(app, name)
            self._steps.extend(self._more())
            self.finish()
            return
        self._window.setUpdatesEnabled(False)
        theme.begin(app, name)
        self._sheet = theme.stylesheet(theme.name())
        self._steps.append(lambda: theme.changed.emit(theme.name()))
        self._steps.extend(self._dressing(piece) for piece in self._pieces())
        self._steps.extend(self._more())
        self._steps.append(lambda: self._window.setUpdatesEnabled(True))
        self._timer.start()

    def finish(self) -> None:
        """Do at once what is left of a change."""
        while self._steps:
            self._steps.popleft()()
        self._timer.stop()

    def welcome(self, piece: QObject) -> None:
        """A piece that comes later wears what the others do."""
        if self._sheet and isinstance(piece, QWidget) and not hasattr(piece, "wears_its_own"):
            piece.setStyleSheet(self._sheet)

    def _pieces(self) -> list[QWidget]:
        direct = Qt.FindChildOption.FindDirectChildrenOnly
        return self._window.findChildren(QWidget, options=direct)

    def _dressing(self, piece: QWidget) -> Step:
        def dress() -> None:
            try:
                self.welcome(piece)
            except RuntimeError:  # Qt has deleted it meanwhile
                return

        return dress

    def _turn(self) -> None:
        end = time.perf_counter() + TURN
        while self._steps and time.perf_counter() < end:
            self._steps.popleft()()
        if not self._steps:
            self._timer.stop()

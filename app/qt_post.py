"""Functions of other threads, run in the main one."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, Signal


class QtPost(QObject):
    """``post(function)`` from any thread: the event loop of the thread that made this object runs it."""

    _posted = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._posted.connect(self._run, Qt.ConnectionType.QueuedConnection)

    def __call__(self, function: Callable[[], None]) -> None:
        """Run ``function`` soon."""
        try:
            self._posted.emit(function)
        except RuntimeError:  # the window is gone: nobody is left to be told
            return

    def _run(self, function: Callable[[], None]) -> None:
        function()

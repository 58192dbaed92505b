"""How the core reports progress, results and warnings without knowing any screen.

A stage calls its observer between chunks; ``check_cancelled`` raises :class:`Cancelled` there when the
user gave up. The null observer below does nothing; the command line and the application derive their own.
"""

from __future__ import annotations

import threading

from floorplan_core.errors import Cancelled


class CancelToken:
    """A flag that any thread may raise; work in progress looks at it between chunks."""

    def __init__(self) -> None:
        self._event = threading.Event()

    def cancel(self) -> None:
        """Ask for the work to stop at its next chunk."""
        self._event.set()

    @property
    def cancelled(self) -> bool:
        """True once somebody asked for a stop."""
        return self._event.is_set()


class Observer:
    """Receives what the pipeline does; every method may be overridden, none has to be."""

    def __init__(self, cancel: CancelToken | None = None) -> None:
        self.cancel = cancel or CancelToken()

    def stage_started(self, stage: str, total: int | None = None) -> None:
        """``stage`` begins; ``total`` is its number of steps where known."""

    def progress(self, stage: str, done: int) -> None:
        """``done`` of the announced steps of ``stage`` are finished."""

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        """``stage`` ended after ``seconds`` with ``result`` (a dataclass of ``floorplan_core.model``)."""

    def warning(self, text: str) -> None:
        """Something that the user should know; also collected in ``report.json``."""

    def check_cancelled(self) -> None:
        """Raise :class:`Cancelled` if the user asked for a stop."""
        if self.cancel.cancelled:
            raise Cancelled("Interrupted; nothing was written.")

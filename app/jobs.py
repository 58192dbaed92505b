"""Long work beside the window: one job at a time in a thread; results come back in the main one. No Qt."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from floorcast_app.events import Event
from floorplan_core.errors import Cancelled, FloorPlanError
from floorplan_core.observer import CancelToken, Observer

Post = Callable[[Callable[[], None]], None]  # runs a function in the main thread, soon

REPORT_EVERY = 0.05  # s between two reports of progress: more would only keep the window busy
EARLY = 0.05  # of the work: how long the rest takes is not known before


@dataclass(frozen=True)
class Progress:
    """How far a job is."""

    stage: str
    done: int = 0
    total: int | None = None
    seconds_left: float | None = None


class JobObserver(Observer):
    """Hands progress, stage results and warnings over to the main thread."""

    def __init__(self, cancel: CancelToken, post: Post, jobs: Jobs) -> None:
        super().__init__(cancel)
        self._post, self._jobs = post, jobs
        self._total: int | None = None
        self._began = self._told = 0.0

    def stage_started(self, stage: str, total: int | None = None) -> None:
        self._total, self._began, self._told = total, time.perf_counter(), 0.0
        self._report(Progress(stage, 0, total))

    def progress(self, stage: str, done: int) -> None:
        now = time.perf_counter()
        if now - self._told < REPORT_EVERY:
            return
        self._told = now
        known = self._total is not None and done > EARLY * self._total
        left = (now - self._began) * (self._total - done) / done if known and self._total else None
        self._report(Progress(stage, done, self._total, left))

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        self._post(lambda: self._jobs.stage_done.emit(stage, seconds, result))

    def warning(self, text: str) -> None:
        self._post(lambda: self._jobs.warned.emit(text))

    def _report(self, progress: Progress) -> None:
        self._post(lambda: self._jobs.progressed.emit(progress))


class Jobs:
    """Runs one job at a time; a new one cancels the one that runs."""

    def __init__(self, post: Post) -> None:
        self.started = Event()  # (text)
        self.progressed = Event()  # (Progress)
        self.stage_done = Event()  # (stage, seconds, result)
        self.warned = Event()  # (text)
        self.ended = Event()  # (error: Exception | None); Cancelled where the user gave up
        self._post = post
        self._thread: threading.Thread | None = None  # the last one, even when it was cancelled
        self.running = False  # True while a job runs that was not cancelled
        self._cancel = CancelToken()
        self._serial = 0

    def start(self, text: str, work: Callable[[Observer], Any], done: Callable[[Any], None]) -> None:
        """Run ``work(observer)`` in a thread, then ``done(result)`` in the main thread."""
        previous = self._thread
        if self.running:  # a survey that an earlier job opened goes on listening to that job's token
            self._cancel.cancel()
        self._cancel = CancelToken()
        self._serial += 1
        observer = JobObserver(self._cancel, self._posting(self._serial), self)
        self._thread = threading.Thread(
            target=self._run, args=(previous, work, observer, done, self._serial), daemon=True
        )
        self.running = True
        self.started.emit(text)
        self._thread.start()

    def cancel(self) -> None:
        """Ask the running job to stop at its next chunk; the window goes on at once."""
        if self.running:
            self._cancel.cancel()
            self._end(self._serial, Cancelled("Cancelled."))

    def wait(self, seconds: float | None = None) -> bool:
        """Block until the thread of the last job is gone; False where it is still there after ``seconds``."""
        thread = self._thread
        if thread is not None:
            thread.join(seconds)
            return not thread.is_alive()
        return True

    def _posting(self, serial: int) -> Post:
        """Posts only as long as the job is the current one."""

        def post(function: Callable[[], None]) -> None:
            self._post(lambda: function() if serial == self._serial and self.running else None)

        return post

    def _run(
        self,
        previous: threading.Thread | None,
        work: Callable[[Observer], Any],
        observer: Observer,
        done: Callable[[Any], None],
        serial: int,
    ) -> None:
        if previous is not None:
            previous.join()  # two at once would fight over the cores and the session
        try:
            result = work(observer)
            observer.check_cancelled()
        except FloorPlanError as error:
            self._post(lambda error=error: self._end(serial, error))
        except MemoryError:
            self._post(lambda: self._end(serial, FloorPlanError("Not enough memory for this survey.")))
        except Exception as error:  # noqa: BLE001 (a bug must not close the window)
            message = FloorPlanError(f"Floorcast failed in this job ({type(error).__name__}: {error}).")
            message.__cause__ = error
            self._post(lambda: self._end(serial, message))
        else:
            self._post(lambda: self._end(serial, None, lambda: done(result)))

    def _end(self, serial: int, error: Exception | None, then: Callable[[], None] | None = None) -> None:
        if serial != self._serial or not self.running:
            return
        self.running = False
        if then is not None:
            then()
        self.ended.emit(error)


def immediately(function: Callable[[], None]) -> None:
    """A ``post`` for tests without an event loop."""
    function()

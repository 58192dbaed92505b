"""The process that reads and plans beside the window: it answers one request after the other. No Qt.

A request is ``(method, session, arguments, dropped)``; whatever happens meanwhile is told in messages
``(kind, ...)``, the last of which is ``("done", result)`` or ``("failed", error class, text)``. The window
may say :data:`CANCEL` meanwhile. When the window is gone, so is the pipe, and the process ends.
"""

from __future__ import annotations

import logging
import multiprocessing
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from multiprocessing.connection import Connection
from multiprocessing.connection import wait as wait_for
from pathlib import Path
from typing import Any

from floorcast_app.point_store import Points, Share
from floorcast_app.run_replay import ShownStorey, snapshots
from floorcast_app.workers import wire
from floorplan_core import errors
from floorplan_core.config import Config
from floorplan_core.model import LayoutPlane, ManhattanFrame, OccupancyGrid, PointChunk, Reconstruction
from floorplan_core.model.corrections import Correction, Point
from floorplan_core.observer import CancelToken, Observer
from floorplan_core.session import Names, PlanningSession

CANCEL = "cancel"
GRACE = 2.0  # s in which the process may end by itself where the window is gone
READY = "ready"  # the first message: the process stands
NICE = 5  # of 19: the window goes first where both want a processor
LOOK_EVERY = 0.01  # s between two looks whether the window gave up: a look costs 20 microseconds
PIECE = 100_000  # points of a message: 1 to 3 MB, which the window takes in within milliseconds

_log = logging.getLogger(__name__)


class WindowGone(BaseException):
    """Nobody is left to work for. No Exception: a reader that takes one for a broken file must not go on."""


def serve(connection: Connection) -> None:
    """Answer requests until the other end is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C in a terminal is for the window, which ends us
    if hasattr(os, "nice"):
        os.nice(NICE)
    threading.Thread(target=_end_with_window, name="end with the window", daemon=True).start()
    try:
        wire.send(connection, (READY,))
        warm_up(Observer(_Wanted(connection)))
        _Desk(connection).work()
    except (WindowGone, EOFError, OSError):
        sys.exit(0)  # nobody is left to be told


def _end_with_window() -> None:
    """A window that is killed tells nobody: who compiles or decodes for long would notice a minute later."""
    window = multiprocessing.parent_process()
    if window is None:
        return
    wait_for([window.sentinel])
    time.sleep(GRACE)
    os._exit(0)


def warm_up(observer: Observer) -> None:
    """Plan the bundled survey: modules are imported and kernels linked when they are first called."""
    from floorplan_core.kernel_cache import kernels_complete, use_kernel_cache

    use_kernel_cache()
    if kernels_complete():  # else compiling takes a minute: that is for the first survey, which says so
        with suppress(errors.Cancelled):  # something is wanted: what was loaded is loaded
            _plan_sample(observer)


def compile_kernels(observer: Observer) -> None:
    """The first run of a version compiles its kernels, one to two minutes in which it tells how far it is.

    Planning the bundled survey needs nearly all of them; what was compiled when it is given up stays.
    """
    from floorplan_core import kernel_cache

    kernel_cache.use_kernel_cache()
    if kernel_cache.kernels_complete():
        return
    observer.stage_started("compile", kernel_cache.kernel_count())
    with kernel_cache.compilations(lambda done: observer.progress("compile", done)):
        _plan_sample(Observer(observer.cancel))
    kernel_cache.note_complete()


def _plan_sample(observer: Observer) -> None:
    from importlib.resources import files

    sample = Path(str(files("floorcast_resources").joinpath("sample_survey")))
    config = Config()
    try:
        observer.check_cancelled()
        session = PlanningSession.open(sample, None, config, observer)
        session.read(observer)
        session.plan(config, (), observer, 0)
        session.storeys(config)
    except errors.Cancelled:
        raise
    except errors.FloorPlanError:
        return  # the survey is not there


class _Wanted(CancelToken):
    """Raised as soon as the window says anything."""

    def __init__(self, connection: Connection) -> None:
        super().__init__()
        self._connection = connection

    @property
    def cancelled(self) -> bool:
        return self._connection.poll()


class _GivenUp(CancelToken):
    """Raised when the window says :data:`CANCEL`, until the next request.

    One for all requests: a survey that was opened by one listens to it while it is read by another.
    """

    def __init__(self, connection: Connection) -> None:
        super().__init__()
        self._connection = connection
        self._lock = threading.Lock()
        self._looked = 0.0

    @property
    def cancelled(self) -> bool:
        with self._lock:
            now = time.monotonic()
            if not self._event.is_set() and now - self._looked > LOOK_EVERY:
                self._looked = now
                if self._said() == CANCEL:
                    self._event.set()
            return self._event.is_set()

    def forget(self) -> None:
        """A new request begins."""
        self._event.clear()

    def _said(self) -> Any:
        try:
            return wire.receive(self._connection) if self._connection.poll() else None
        except (EOFError, OSError) as error:
            raise WindowGone from error


class _Teller(Observer):
    """Tells the window what happens."""

    def __init__(self, token: CancelToken, tell: Callable[[Any], None]) -> None:
        super().__init__(token)
        self._tell = tell
        self.first = True  # nothing was planned yet: what stages find is shown meanwhile

    def stage_started(self, stage: str, total: int | None = None) -> None:
        self._tell(("started", stage, total))

    def progress(self, stage: str, done: int) -> None:
        self._tell(("progress", stage, done))

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        self._tell(("finished", stage, seconds, result if self.first and _is_shown(result) else None))

    def warning(self, text: str) -> None:
        self._tell(("warning", text))


class _Desk:
    """Holds the sessions, by the numbers that the window gave them."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._sessions: dict[int, PlanningSession] = {}
        self._token = _GivenUp(connection)
        self._lock = threading.Lock()
        self._teller = _Teller(self._token, self._tell)

    def work(self) -> None:
        """Answer requests for ever."""
        while True:
            request = wire.receive(self._connection)
            if request == CANCEL:  # it came too late: what it was meant for is done
                continue
            self._token.forget()
            self._answer(*request)

    def _answer(self, method: str, session: int, arguments: tuple[Any, ...], dropped: list[int]) -> None:
        for number in dropped:
            self._sessions.pop(number, None)
        try:
            result = getattr(self, f"_{method}")(session, *arguments)
        except MemoryError:
            self._tell(("failed", "MemoryError", ""))
        except errors.FloorPlanError as error:
            self._tell(("failed", _public_class(error), str(error)))
        except Exception as error:  # noqa: BLE001 (a bug must not end the process, and is told)
            _log.exception("The request %s failed.", method)
            self._tell(("failed", "", f"Floorcast failed in this job ({type(error).__name__}: {error})."))
        else:
            self._tell(("done", result))

    def _tell(self, message: Any) -> None:
        try:
            with self._lock:
                wire.send(self._connection, message)
        except OSError as error:
            raise WindowGone from error

    # ---- requests ---------------------------------------------------------------------------------------

    def _open(
        self, number: int, path: Path, trajectory: Path | None, config: Config, names: Names
    ) -> tuple[Reconstruction, bool, Names]:
        self._teller.first = True
        compile_kernels(self._teller)
        session = PlanningSession.open(path, trajectory, config, self._teller)
        session.begin_with_names(names)
        self._sessions[number] = session
        return _without_points(session.reconstruction), session.ready, session.names

    def _read(self, number: int, most: int) -> Reconstruction:
        session, share = self._sessions[number], Share(most)

        def keep(chunk: PointChunk) -> None:
            part = share.take(chunk)
            for piece in _pieces(part):
                self._tell(("points", piece, share.every))

        session.read(self._teller, keep)
        return _without_points(session.reconstruction)

    def _plan(
        self,
        number: int,
        config: Config,
        corrections: tuple[Correction, ...],
        storey: int,
        origin: Point | None,
    ) -> Any:
        session = self._sessions[number]
        plan = session.plan(config, corrections, self._teller, storey, origin)
        self._teller.first = False
        return plan, session.names

    def _storeys(self, number: int, config: Config) -> Any:
        return self._sessions[number].storeys(config)

    def _replay(self, number: int, config: Config, every: float, shown: ShownStorey) -> None:
        run = self._sessions[number].reconstruction
        for snapshot in snapshots(run, config, every, self._teller, shown):
            self._tell(("moment", snapshot))


def _no_points() -> Iterator[PointChunk]:
    """In the window's process there are none."""
    return iter(())


def _without_points(survey: Reconstruction) -> Reconstruction:
    """What is known of a survey, as it can be sent."""
    return replace(survey, chunks=_no_points)


def _pieces(points: Points) -> Iterator[Points]:
    for begin in range(0, len(points.xyz), PIECE):
        yield points.rows(slice(begin, begin + PIECE))


def _is_shown(result: object) -> bool:
    """True for what the panes show of a plan that is being made (see ``floorcast_app.layers.partial``)."""
    if isinstance(result, tuple):
        return bool(result) and all(isinstance(part, LayoutPlane) for part in result)
    return isinstance(result, OccupancyGrid | ManhattanFrame)  # the frame says how the others are turned


def _public_class(error: errors.FloorPlanError) -> str:
    """The name of the class of :mod:`floorplan_core.errors` that ``error`` belongs to."""
    return next(c.__name__ for c in type(error).__mro__ if c.__module__ == errors.__name__)

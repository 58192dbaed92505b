"""Plans in a process beside the window, which never waits for it. No Qt.

A thread of the window that reads or plans takes the interpreter from the thread that paints: while modules
are imported, kernels linked or compiled, files decoded and polygons united. In a process of its own nothing
of it is felt. What comes back are points for the panes, progress and whole plans.
"""

from __future__ import annotations

import itertools
import multiprocessing
import threading
import time
import weakref
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from pathlib import Path
from typing import Any

from floorcast_app.point_store import MOST_POINTS, PointStore
from floorcast_app.run_replay import ShownStorey, Snapshot
from floorcast_app.workers import wire
from floorcast_app.workers.planner import Session
from floorcast_app.workers.planning_process import CANCEL, serve
from floorplan_core import errors
from floorplan_core.config import Config
from floorplan_core.errors import Cancelled, FloorPlanError
from floorplan_core.model import FloorPlan, Reconstruction
from floorplan_core.model.corrections import Correction, Point
from floorplan_core.model.storey import Storey
from floorplan_core.observer import Observer
from floorplan_core.session import Names, reads_alike

LOOK_EVERY = 0.02  # s between two looks whether the user gave up, while nothing is told
PATIENCE = 0.5  # s from giving up to the end of a process that does not hear it: a new one needs about that
OPENING = ("open", "read")  # requests that leave nothing worth keeping when they are given up
LAST_WAIT = 5.0  # s for a process that was ended; the system needs milliseconds


@dataclass(frozen=True, eq=False)
class _Life:
    """One run of the process; sessions end with it."""

    process: SpawnProcess
    connection: Connection
    ended: threading.Event  # somebody of us ended it, or found it dead


class RemotePlanner:
    """The window's end of the process; it is started when first needed, and again where it died."""

    def __init__(self) -> None:
        self._life: _Life | None = None
        self._starting = threading.Lock()
        self._asking = threading.Lock()
        self._numbers = itertools.count(1)
        self._dropped: list[int] = []  # sessions that nobody holds any more
        self._forgotten = threading.Event()  # no session is needed any more

    # ---- the process ------------------------------------------------------------------------------------

    def start(self) -> None:
        """Start the process where it does not run; it makes itself ready while nothing is asked."""
        self._alive()

    def close(self) -> None:
        """End the process, in the middle of whatever it does."""
        with self._starting:
            life, self._life = self._life, None
        if life is not None:
            _end(life)

    def lives(self, life: _Life) -> bool:
        """True where ``life`` is the run of the process that answers now."""
        return life is self._life and not life.ended.is_set()

    def _alive(self) -> _Life:
        with self._starting:
            if self._life is None or self._life.ended.is_set() or not self._life.process.is_alive():
                context = multiprocessing.get_context("spawn")
                ours, theirs = context.Pipe()
                process = context.Process(target=serve, args=(theirs,), name="Floorcast planner", daemon=True)
                process.start()
                theirs.close()  # else we would not notice that the process is gone
                self._life = _Life(process, ours, threading.Event())
            return self._life

    # ---- what the workbench asks ------------------------------------------------------------------------

    def open(
        self, path: Path, trajectory: Path | None, config: Config, names: Names, observer: Observer
    ) -> RemoteSession:
        """See :class:`~floorcast_app.workers.planner.Planner`."""
        self._forgotten.clear()
        number, life = next(self._numbers), self._alive()
        asked = (Path(path).absolute(), trajectory and Path(trajectory).absolute(), config, names)
        try:
            survey, ready, known = self.ask(life, "open", number, asked, observer)
        except FloorPlanError:
            self._dropped.append(number)
            raise
        session = RemoteSession(self, life, number, survey, config)
        session.ready_after_opening, session.names = ready, known
        weakref.finalize(session, self._dropped.append, number)
        return session

    def forget(self) -> None:
        """See :class:`~floorcast_app.workers.planner.Planner`."""
        self._forgotten.set()

    def read(self, session: Session, store: PointStore, observer: Observer) -> None:
        """See :class:`~floorcast_app.workers.planner.Planner`."""
        assert isinstance(session, RemoteSession)
        session.read(store, observer)

    def replay(
        self,
        session: Session,
        config: Config,
        every: float,
        shown: ShownStorey,
        observer: Observer,
        each: Callable[[Snapshot], None],
    ) -> None:
        """See :class:`~floorcast_app.workers.planner.Planner`."""
        assert isinstance(session, RemoteSession)
        session.ask("replay", (config, every, shown), observer, each)

    def ask(
        self,
        life: _Life,
        method: str,
        number: int,
        arguments: tuple[Any, ...],
        observer: Observer,
        take: Callable[..., None] | None = None,
    ) -> Any:
        """The answer to a request; meanwhile ``take`` gets the points or moments that come.

        A step that was given up and does not end soon (a kernel that is compiled, a library that decodes) is
        ended with its process where no session is lost by it, and another process is started.
        """

        def overdue() -> None:
            if method in OPENING or self._forgotten.is_set():
                _end(life)

        with self._asking:
            dropped, self._dropped[:] = list(self._dropped), []
            answer = _Answer(life.connection, observer, take, overdue)
            try:
                wire.send(life.connection, (method, number, arguments, dropped))
                return answer.wait()
            except (EOFError, OSError) as error:
                by_us = life.ended.is_set()
                life.ended.set()
                if by_us:
                    if self._life is life:  # else the window was closed
                        self._alive()
                    raise answer.trouble or Cancelled("Cancelled.") from error
                raise FloorPlanError(_epitaph(life.process)) from error


class RemoteSession:
    """A survey in the other process; see :class:`floorplan_core.session.PlanningSession`."""

    def __init__(
        self, planner: RemotePlanner, life: _Life, number: int, survey: Reconstruction, config: Config
    ) -> None:
        self.reconstruction = survey
        self.names: Names = ()
        self.ready_after_opening = False  # True for a grid map, which has no points to read
        self._planner, self._life, self._number = planner, life, number
        self._read_with = config
        self._was_read = False

    @property
    def ready(self) -> bool:
        """True once all points were integrated, as long as the process that did it lives."""
        return (self._was_read or self.ready_after_opening) and self._planner.lives(self._life)

    @property
    def origin(self) -> Point:
        """World metres of the origin of the survey's local frame."""
        x, y, _ = self.reconstruction.local_frame.shift
        return float(x), float(y)

    def must_read_again(self, config: Config) -> bool:
        """True where ``config`` changes how points are read or integrated."""
        return not self.ready_after_opening and not reads_alike(config, self._read_with)

    def read(self, store: PointStore, observer: Observer) -> None:
        """Integrate all points; ``store`` gets its share of them."""
        if not self.ready:
            self.reconstruction = self.ask("read", (MOST_POINTS,), observer, store.put)
            self._was_read = True

    def plan(
        self,
        config: Config,
        corrections: Sequence[Correction],
        observer: Observer,
        storey: int = 0,
        origin: Point | None = None,
    ) -> FloorPlan:
        """The plan with these settings and corrections."""
        asked = (config, tuple(corrections), storey, origin)
        plan, self.names = self.ask("plan", asked, observer)
        assert isinstance(plan, FloorPlan)
        return plan

    def storeys(self, config: Config) -> tuple[Storey, ...]:
        """The storeys of the survey, lowest first; none for a grid map."""
        found: tuple[Storey, ...] = self.ask("storeys", (config,), Observer())
        return found

    def ask(
        self,
        method: str,
        arguments: tuple[Any, ...],
        observer: Observer,
        take: Callable[..., None] | None = None,
    ) -> Any:
        """The answer of this session's process."""
        return self._planner.ask(self._life, method, self._number, arguments, observer, take)


class _Answer:
    """Waits for the end of a request, and hands on what is told meanwhile."""

    def __init__(
        self,
        connection: Connection,
        observer: Observer,
        take: Callable[..., None] | None,
        overdue: Callable[[], None],
    ) -> None:
        """:param overdue: called again and again where the answer is late after giving up."""
        self._connection, self._observer = connection, observer
        self._take, self._overdue = take, overdue
        self._gave_up: float | None = None  # when
        self.trouble: BaseException | None = None  # of our own, while we took something in

    def wait(self) -> Any:
        """The result; what failed there is raised here."""
        while True:
            while not self._connection.poll(LOOK_EVERY):
                self._look()
            kind, *told = wire.receive(self._connection)
            self._look()
            if kind == "done":
                if self.trouble is not None:
                    raise self.trouble
                return told[0]
            if kind == "failed":
                raise self.trouble or _raised(*told)
            self._hear(kind, told)

    def _look(self) -> None:
        if self._observer.cancel.cancelled:
            self._give_up()
        if self._gave_up is not None and time.monotonic() - self._gave_up > PATIENCE:
            self._overdue()

    def _give_up(self) -> None:
        """Tell it once; the answer is waited for nevertheless: the next request wants a silent pipe."""
        if self._gave_up is None:
            self._gave_up = time.monotonic()
            wire.send(self._connection, CANCEL)

    def _hear(self, kind: str, told: list[Any]) -> None:
        hearers: dict[str, Callable[..., None]] = {
            "started": self._observer.stage_started,
            "progress": self._observer.progress,
            "finished": self._observer.stage_finished,
            "warning": self._observer.warning,
        }
        if self.trouble is not None or kind not in {*hearers, "points", "moment"}:
            return
        try:
            taker = hearers.get(kind, self._take)
            if taker is not None and not (self._gave_up is not None and kind in {"points", "moment"}):
                taker(*told)
        except Exception as error:  # noqa: BLE001 (the answer is waited for first, then it is raised)
            self.trouble = error
            self._give_up()


def _end(life: _Life) -> None:
    """End the process, in the middle of whatever it does."""
    life.ended.set()
    life.process.kill()
    life.process.join(LAST_WAIT)


def _raised(name: str, text: str) -> BaseException:
    """The error that was told."""
    if name == "MemoryError":
        return MemoryError(text)
    found = getattr(errors, name, FloorPlanError)
    return FloorPlanError(text) if not issubclass(found, FloorPlanError) else found(text)


def _epitaph(process: SpawnProcess) -> str:
    process.join(LAST_WAIT)
    return (
        f"The process that reads and plans ended unexpectedly (status {process.exitcode}); the system may "
        "have run out of memory. The next change reads the survey again."
    )

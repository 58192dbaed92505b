"""Who holds the event loop: every gap between two ticks, and what each thread did in it.

On a busy machine a gap is also time in which the window's own thread had no processor: Linux says how long
it waited for that, and for how long a virtual machine had none at all (100 ms at a time are common); this
part of a gap is told apart. Where asked, a thread looks at the stacks of all others whenever the loop comes
late. It needs the interpreter lock for that: of a call that holds it, it sees where it ended. (Python's own
watchdog looks without the lock, and a stack that changes meanwhile ends the program.)
"""

from __future__ import annotations

import os
import sys
import threading
import time
import traceback
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

from PySide6.QtCore import QObject, QTimer

TICK = 10  # ms between two ticks of the event loop
LEAST = 60.0  # ms: a shorter gap is not told
LOOK = 0.005  # s between two looks whether the loop is late
DEPTH = 7  # calls of a stack that are told
IDLE = ("threading.py", "thread.py")  # a thread that stands in one of these waits for work


@dataclass(frozen=True)
class Gap:
    """The loop came late once."""

    milliseconds: float
    waited: float  # ms in which the window's thread was ready to run and had no processor
    busy: float  # ms that it computed itself
    threads: tuple[tuple[str, float], ...]  # name of another thread, ms that it computed
    stacks: str  # of all threads, while it lasted; "" where nobody asked

    @property
    def own(self) -> float:
        """Milliseconds without what other programs took from the window's thread."""
        return self.milliseconds - self.waited


@dataclass(frozen=True)
class _Clock:
    """Milliseconds: of the wall, stolen by the host, and of each thread (name, computed, waited)."""

    at: float
    stolen: float
    threads: dict[int, tuple[str, float, float]]

    @classmethod
    def now(cls) -> _Clock:
        threads = [(t.native_id, t.name) for t in threading.enumerate()]
        found = {id: (name, _computed(id), _waited(id)) for id, name in threads if id is not None}
        return cls(time.perf_counter() * 1000, _stolen(), found)


def _call(frame: FrameType, line: int) -> str:
    return f"{Path(frame.f_code.co_filename).name}:{line} in {frame.f_code.co_name}"


class _Watchdog(threading.Thread):
    """Notes the stacks of all threads as long as the loop is late."""

    def __init__(self, least: float) -> None:
        super().__init__(name="watchdog", daemon=True)
        self._least = least
        self._since = time.perf_counter()
        self._seen: list[str] = []
        self._ended = threading.Event()

    def tick(self) -> str:
        """The loop is here: what was seen since it was here last."""
        self._since = time.perf_counter()
        seen, self._seen = self._seen, []
        return "\n".join(dict.fromkeys(seen))

    def end(self) -> None:
        """Look no more."""
        self._ended.set()
        self.join()

    def run(self) -> None:
        while not self._ended.wait(LOOK):
            if (time.perf_counter() - self._since) * 1000 > self._least:
                self._seen += self._stacks()

    def _stacks(self) -> list[str]:
        """One line for each thread that does something."""
        lines = []
        for ident, frame in sys._current_frames().items():
            calls = list(traceback.walk_stack(frame))[:DEPTH]
            if ident != self.ident and not calls[0][0].f_code.co_filename.endswith(IDLE):
                told = (
                    f"{Path(f.f_code.co_filename).name}:{line} in {f.f_code.co_name}" for f, line in calls
                )
                lines.append("        " + " < ".join(told))
        return lines


def _computed(thread: int) -> float:
    """Processor milliseconds of a thread of this process; 0 where it is gone or the system does not say."""
    try:
        return time.clock_gettime(~thread << 3 | 6) * 1000  # the clock of one thread, as Linux numbers them
    except (OSError, AttributeError):
        return 0.0


def _waited(thread: int) -> float:
    """Milliseconds for which a thread was ready and had no processor; 0 where the system does not say."""
    try:
        return int(Path(f"/proc/self/task/{thread}/schedstat").read_text().split()[1]) / 1e6
    except (OSError, IndexError, ValueError):
        return 0.0


def _stolen() -> float:
    """Milliseconds in which the host ran others in place of this machine, mean of the processors."""
    try:
        fields = Path("/proc/stat").read_text().splitlines()[0].split()
        return int(fields[8]) / os.sysconf("SC_CLK_TCK") / (os.cpu_count() or 1) * 1000
    except (OSError, IndexError, ValueError, AttributeError):
        return 0.0


class StandStill(QObject):
    """Ticks in the event loop, and remembers every gap longer than ``least`` ms since :meth:`take`."""

    def __init__(self, least: float = LEAST, stacks: bool = False) -> None:
        super().__init__()
        self._least = least
        self._watchdog = _Watchdog(least) if stacks else None
        self._gaps: list[Gap] = []
        self._main = threading.get_native_id()
        self._last = _Clock.now()
        self._timer = QTimer(self, interval=TICK)
        self._timer.timeout.connect(self._tick)
        self._timer.start()
        if self._watchdog is not None:
            self._watchdog.start()

    def take(self) -> list[Gap]:
        """The gaps since the last call, longest first."""
        taken, self._gaps = self._gaps, []
        self._last = _Clock.now()
        return sorted(taken, key=lambda gap: -gap.own)

    def stop(self) -> None:
        """Stop watching."""
        self._timer.stop()
        if self._watchdog is not None:
            self._watchdog.end()

    def _tick(self) -> None:
        stacks = "" if self._watchdog is None else self._watchdog.tick()
        last, now = self._last, _Clock.now()
        self._last = now
        if now.at - last.at >= self._least:
            self._gaps.append(self._gap(last, now, stacks))

    def _gap(self, last: _Clock, now: _Clock, stacks: str) -> Gap:
        spent = {}
        for id, (name, computed, waited) in now.threads.items():
            _, before, ready = last.threads.get(id, ("", 0.0, 0.0))
            spent[id] = (name, computed - before, waited - ready)
        _, busy, waited = spent.pop(self._main)
        others = tuple((name, computed) for name, computed, _ in spent.values())
        total, stolen = now.at - last.at, now.stolen - last.stolen
        return Gap(total, min(waited + stolen, total - busy), busy, others, stacks)

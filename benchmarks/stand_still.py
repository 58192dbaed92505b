"""Who holds the event loop: every gap between two ticks, and what each thread did in it.

On a busy machine a gap is also time in which the window's own thread had no processor: Linux says how long
it waited for that, and for how long a virtual machine had none at all (100 ms at a time are common); this
part of a gap is told apart. Where asked, Python's watchdog writes the stacks of all
threads whenever the loop comes late. It does so without the interpreter lock: whoever holds the lock is seen
in the call that holds it, but a stack that changes meanwhile may end the program. It is for looking, not for
measuring.
"""

from __future__ import annotations

import faulthandler
import os
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, QTimer

TICK = 10  # ms between two ticks of the event loop
LEAST = 60.0  # ms: a shorter gap is not told
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


def _brief(dumps: str) -> str:
    """One line for each thread that does something, for each of the watchdog's dumps."""
    lines = []
    for thread in dumps.split("\n\n"):
        calls = [line.strip() for line in thread.splitlines() if line.strip().startswith("File")]
        if calls and not calls[0].partition('"')[2].partition('"')[0].endswith(IDLE):
            told = (call.rpartition("/")[2].replace('", line ', ":") for call in calls[:DEPTH])
            lines.append("        " + " < ".join(told))
    return "\n".join(lines)


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
        self._least, self._with_stacks = least, stacks
        self._gaps: list[Gap] = []
        self._main = threading.get_native_id()
        self._file = tempfile.TemporaryFile("w+")  # noqa: SIM115 (open as long as the watchdog)
        self._last = _Clock.now()
        self._timer = QTimer(self, interval=TICK)
        self._timer.timeout.connect(self._tick)
        self._timer.start()

    def take(self) -> list[Gap]:
        """The gaps since the last call, longest first."""
        taken, self._gaps = self._gaps, []
        self._last = _Clock.now()
        return sorted(taken, key=lambda gap: -gap.own)

    def stop(self) -> None:
        """Stop watching."""
        self._timer.stop()
        faulthandler.cancel_dump_traceback_later()
        self._file.close()

    def _tick(self) -> None:
        faulthandler.cancel_dump_traceback_later()
        last, now = self._last, _Clock.now()
        self._last = now
        if now.at - last.at >= self._least:
            self._gaps.append(self._gap(last, now))
        if self._with_stacks:
            faulthandler.dump_traceback_later(self._least / 1000, repeat=True, file=self._file)

    def _gap(self, last: _Clock, now: _Clock) -> Gap:
        spent = {}
        for id, (name, computed, waited) in now.threads.items():
            _, before, ready = last.threads.get(id, ("", 0.0, 0.0))
            spent[id] = (name, computed - before, waited - ready)
        _, busy, waited = spent.pop(self._main)
        others = tuple((name, computed) for name, computed, _ in spent.values())
        total, stolen = now.at - last.at, now.stolen - last.stolen
        return Gap(total, min(waited + stolen, total - busy), busy, others, self._stacks())

    def _stacks(self) -> str:
        self._file.seek(0)
        text = _brief(self._file.read())
        self._file.seek(0)
        self._file.truncate()
        return text

"""How long kernels took to load or compile, so that the times of stages say how long the work itself takes.

A first run compiles kernels, every other loads them: a third of a second or so, once a process, which would
be counted to whichever stage happens to need a kernel first.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable


class _Clock:
    """Wall time in which any thread loaded or compiled a kernel, or waited for another that did."""

    def __init__(self) -> None:
        self._lock, self._inside = threading.Lock(), 0
        self._total = self._since = 0.0

    def enter(self) -> None:
        with self._lock:
            if self._inside == 0:
                self._since = time.perf_counter()
            self._inside += 1

    def leave(self) -> None:
        with self._lock:
            self._inside -= 1
            if self._inside == 0:
                self._total += time.perf_counter() - self._since

    def seconds(self) -> float:
        with self._lock:
            return self._total + (time.perf_counter() - self._since if self._inside > 0 else 0.0)


_clock: _Clock | None = None  # of this process, once somebody asked for it


def time_kernels() -> None:
    """From now on :func:`kernel_seconds` counts; idempotent. Called before the first kernel is."""
    global _clock
    if _clock is not None:
        return
    from numba.core import event

    clock = _clock = _Clock()

    class Relay(event.Listener):  # type: ignore[misc]  # numba has no types
        def on_start(self, event: object) -> None:
            clock.enter()

        def on_end(self, event: object) -> None:
            clock.leave()

    event.register("numba:compiler_lock", Relay())


def kernel_seconds() -> float:
    """Wall seconds spent on loading and compiling kernels since :func:`time_kernels`; 0 without it."""
    return 0.0 if _clock is None else _clock.seconds()


def stopwatch() -> Callable[[], float]:
    """Seconds since this call, without those in which kernels were loaded: work alone, warm or not."""
    began, before = time.perf_counter(), kernel_seconds()
    return lambda: max(0.0, time.perf_counter() - began - (kernel_seconds() - before))

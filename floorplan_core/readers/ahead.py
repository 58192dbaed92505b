"""Reading ahead: a thread of its own decodes the next chunks while those before are integrated.

The chunks come in the order of their file and nothing depends on who was faster. A reader waits as soon as
``DEPTH`` chunks wait for it, so that memory stays bounded. What a reader warns of is told by the thread that
takes the chunks, at the place in the order of the file at which it was said.
"""

from __future__ import annotations

import os
import queue
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Generic, TypeVar

from floorplan_core.observer import Observer

T = TypeVar("T")

DEPTH = 1  # chunks that wait: with the one in work and the one taken, three are in memory
STALL = 0.1  # seconds after which a reader that waits looks whether anybody still wants its chunks
FILES = min(4, max(2, os.cpu_count() or 1))  # that are read at a time: each takes three chunks of memory

_own = threading.local()  # .said: what the reader in this thread has to tell


@dataclass(frozen=True)
class _Failed:
    error: BaseException


@dataclass(frozen=True)
class _Said:
    warning: str


class _End:
    pass


class RelayedObserver(Observer):
    """The observer that readers get: warnings from a reading thread wait for their turn."""

    def __init__(self, inner: Observer) -> None:
        super().__init__(inner.cancel)
        self._inner = inner

    def stage_started(self, stage: str, total: int | None = None) -> None:
        """Passed on."""
        self._inner.stage_started(stage, total)

    def progress(self, stage: str, done: int) -> None:
        """Passed on."""
        self._inner.progress(stage, done)

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        """Passed on."""
        self._inner.stage_finished(stage, seconds, result)

    def warning(self, text: str) -> None:
        """At once, or when the chunks that came before were taken."""
        say: Callable[[str], None] = getattr(_own, "say", self._inner.warning)
        say(text)

    def check_cancelled(self) -> None:
        """Passed on."""
        self._inner.check_cancelled()


class Ahead(Generic[T]):
    """An iterator that runs in a thread from its making on; to be closed, as ``with`` does."""

    def __init__(self, start: Callable[[], Iterator[T]], observer: Observer | None = None) -> None:
        self._observer = observer or Observer()
        self._items: queue.Queue[T | _Failed | _Said | _End] = queue.Queue(DEPTH)
        self._unwanted = threading.Event()
        self._thread = threading.Thread(target=self._run, args=(start,), name="reading ahead", daemon=True)
        self._thread.start()

    def _run(self, start: Callable[[], Iterator[T]]) -> None:
        _own.say = lambda text: self._put(_Said(text))
        try:
            items = start()
            for item in items:
                if not self._put(item):
                    close = getattr(items, "close", None)
                    if close is not None:
                        close()  # files are let go of here, not when somebody collects garbage
                    return
            self._put(_End())
        except BaseException as error:  # noqa: BLE001 - whatever it is belongs to the thread that takes the chunks
            self._put(_Failed(error))

    def _put(self, item: T | _Failed | _Said | _End) -> bool:
        while not self._unwanted.is_set():
            try:
                self._items.put(item, timeout=STALL)
                return True
            except queue.Full:
                continue
        return False

    def __iter__(self) -> Iterator[T]:
        while not isinstance(item := self._items.get(), _End):
            if isinstance(item, _Failed):
                raise item.error
            if isinstance(item, _Said):
                self._observer.warning(item.warning)
            else:
                yield item

    def close(self) -> None:
        """Let the thread end; it finishes the chunk that it is at."""
        self._unwanted.set()
        self._thread.join()

    def __enter__(self) -> Ahead[T]:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def read_ahead(
    passes: Sequence[Callable[[], Iterator[T]]], observer: Observer | None = None
) -> Iterator[tuple[int, T]]:
    """All items of all ``passes`` in their order, with the number of each pass; ``FILES`` run at a time."""
    waiting, running = deque(passes), deque[Ahead[T]]()
    try:
        for number in range(len(passes)):
            while waiting and len(running) < FILES:
                running.append(Ahead(waiting.popleft(), observer))
            for item in running[0]:
                yield number, item
            running.popleft().close()
    finally:
        for left in running:
            left.close()

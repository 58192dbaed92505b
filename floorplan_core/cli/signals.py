"""Ctrl-C and SIGTERM: cancel the work in progress and unwind, so that temporary files are removed.

Both ways out are taken: the token that every stage looks at between chunks is raised, because compiled code
and callbacks may swallow an exception; and KeyboardInterrupt is raised at once, for everything else.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from types import FrameType

from floorplan_core.observer import CancelToken


class Terminated(KeyboardInterrupt):
    """SIGTERM; a kind of Ctrl-C, so that nothing that lets Ctrl-C through can swallow it."""


@contextmanager
def interrupts_cancel() -> Iterator[CancelToken]:
    """Install the handlers around one command and yield its token; the earlier ones come back."""
    token = CancelToken()
    if threading.current_thread() is not threading.main_thread():  # only the main thread gets signals
        yield token
        return
    before = {s: signal.getsignal(s) for s in (signal.SIGINT, signal.SIGTERM)}
    try:
        signal.signal(signal.SIGINT, partial(_unwind, token, KeyboardInterrupt()))
        signal.signal(signal.SIGTERM, partial(_unwind, token, Terminated()))
        yield token
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _unwind(token: CancelToken, error: BaseException, number: int, frame: FrameType | None) -> None:
    token.cancel()
    raise error

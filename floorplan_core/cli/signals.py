"""Ctrl-C and SIGTERM: cancel the work in progress and unwind, so that temporary files are removed.

Both ways out are taken: the token that every stage looks at between chunks is raised, because compiled code
and callbacks may swallow an exception; and KeyboardInterrupt is raised at once, for everything else. One that
ends in a callback or a finaliser (the interpreter would print it as ignored) is raised again a moment later.
"""

from __future__ import annotations

import _thread
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from types import FrameType
from typing import TYPE_CHECKING

from floorplan_core.observer import CancelToken

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

AGAIN_AFTER = 0.1  # s; the callback that swallowed the exception has returned by then


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
    hook, raised = sys.unraisablehook, list[BaseException]()
    try:
        sys.unraisablehook = partial(_raise_swallowed_again, hook)
        signal.signal(signal.SIGINT, partial(_unwind, token, raised, KeyboardInterrupt()))
        signal.signal(signal.SIGTERM, partial(_unwind, token, raised, Terminated()))
        yield token
    except Exception as error:
        if raised:  # what a library made of it: an import that is interrupted fails with an error of its own
            raise raised[0] from error
        raise
    finally:
        sys.unraisablehook = hook
        for number, handler in before.items():
            signal.signal(number, handler)


def _unwind(
    token: CancelToken,
    raised: list[BaseException],
    error: BaseException,
    number: int,
    frame: FrameType | None,
) -> None:
    token.cancel()
    raised.append(error)
    raise error


def _raise_swallowed_again(
    hook: Callable[[UnraisableHookArgs], object], unraisable: UnraisableHookArgs
) -> None:
    """Stand in for ``hook``, the ``sys.unraisablehook``: ours are not printed, they come again."""
    if not isinstance(unraisable.exc_value, KeyboardInterrupt):
        hook(unraisable)
        return
    number = signal.SIGTERM if isinstance(unraisable.exc_value, Terminated) else signal.SIGINT
    again = threading.Timer(AGAIN_AFTER, _thread.interrupt_main, (number,))
    again.daemon = True
    again.start()

"""Signals that arrive where an exception cannot leave: they come again, and nothing is printed."""

from __future__ import annotations

import ctypes
import os
import signal
import time

import pytest

from floorplan_core.cli.signals import Terminated, interrupts_cancel


@pytest.mark.parametrize(
    ("number", "error"), [(signal.SIGTERM, Terminated), (signal.SIGINT, KeyboardInterrupt)]
)
def test_a_signal_inside_a_callback_of_compiled_code_comes_again_silently(
    number: int, error: type[BaseException], capfd: pytest.CaptureFixture[str]
) -> None:
    def killed() -> None:
        os.kill(os.getpid(), number)
        time.sleep(0.01)  # the handler runs here, and its exception ends in the callback

    with pytest.raises(error), interrupts_cancel() as token:
        ctypes.CFUNCTYPE(None)(killed)()
        assert token.cancelled
        time.sleep(10.0)
    assert capfd.readouterr().err == ""


def test_other_swallowed_exceptions_are_still_told(capfd: pytest.CaptureFixture[str]) -> None:
    import sys

    told = []
    before, sys.unraisablehook = sys.unraisablehook, told.append
    try:
        with interrupts_cancel():
            ctypes.CFUNCTYPE(None)(lambda: 1 / 0)()
        assert sys.unraisablehook == told.append
    finally:
        sys.unraisablehook = before
    assert [type(args.exc_value) for args in told] == [ZeroDivisionError]

"""Signals that arrive where an exception cannot leave: they come again, and nothing is printed."""

from __future__ import annotations

import ctypes
import os
import signal
import time
from pathlib import Path

import pytest

from floorplan_core.cli.signals import Terminated, interrupts_cancel
from floorplan_core.plugin_guard import guarded
from floorplan_core.plugins import PluginStatus
from floorplan_core.readers.foreign import damaged


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


@pytest.mark.parametrize(
    ("number", "error"), [(signal.SIGTERM, Terminated), (signal.SIGINT, KeyboardInterrupt)]
)
def test_an_error_that_a_library_makes_of_a_signal_is_the_signal(
    number: int, error: type[BaseException]
) -> None:
    """As Python does where it interrupts the first import of a compiled module."""
    with pytest.raises(error) as caught, interrupts_cancel():
        try:
            os.kill(os.getpid(), number)
            time.sleep(10.0)
        except KeyboardInterrupt:
            raise ImportError("initialization failed") from None
    assert type(caught.value) is error
    with pytest.raises(ImportError), interrupts_cancel():
        raise ImportError("no signal came")


def made_of_ctrl_c() -> Exception:
    error = SystemError("a compiled function returned a result with an exception set")
    error.__cause__ = KeyboardInterrupt()
    return error


def test_ctrl_c_in_the_compiled_code_of_a_plugin_does_not_switch_it_off(tmp_path: Path) -> None:
    class Exporter:
        name, suffixes, description = "x", (".x",), "x"

        def write(self, plan: object, path: Path) -> None:
            raise made_of_ctrl_c()

    status = PluginStatus("x", "shipped")
    with pytest.raises(KeyboardInterrupt):
        guarded(Exporter(), status).write(None, tmp_path / "a.x")
    assert not status.error
    with pytest.raises(KeyboardInterrupt), damaged("a.ply", "PLY"):
        raise made_of_ctrl_c()

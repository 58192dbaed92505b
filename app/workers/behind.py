"""Threads that work behind the window: it goes first where both want a processor. No Qt."""

from __future__ import annotations

import os
import sys
import threading

NICE = 10  # of 19: a tenth of the window's share where processors are scarce, all of it where they are not


def step_behind() -> None:
    """The calling thread gives way to the window from now on; only Linux knows threads of different rank."""
    if not sys.platform.startswith("linux"):
        return
    try:
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICE)
    except OSError:
        return  # a system that forbids it: then all threads are alike

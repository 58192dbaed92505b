"""A workbench without an event loop: what its jobs post waits in a queue until a test lets it happen."""

from __future__ import annotations

import queue
import time
from collections.abc import Callable
from pathlib import Path

from floorcast_app.workbench import Workbench

SAMPLE = Path(__file__).resolve().parents[2] / "resources" / "sample_survey"
MOST_SECONDS = 240.0  # for a job on a loaded machine whose kernels are not compiled yet


class Pump:
    """Keeps what a job's thread posts until the test asks for it to happen."""

    def __init__(self) -> None:
        self._waiting: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()

    def post(self, function: Callable[[], None]) -> None:
        """What the workbench gets in place of an event loop's ``post``."""
        self._waiting.put(function)

    def run_until(self, done: Callable[[], bool], seconds: float = MOST_SECONDS) -> None:
        """Do what was posted until ``done()`` holds."""
        end = time.monotonic() + seconds
        while not done():
            assert time.monotonic() < end, "the job did not end in time"
            try:
                self._waiting.get(timeout=0.02)()
            except queue.Empty:
                continue


def make_workbench() -> Workbench:
    """A workbench whose posts wait in ``workbench.pump``; ``settle(workbench)`` does what waits."""
    pump = Pump()
    workbench = Workbench(pump.post)
    workbench.pump = pump  # type: ignore[attr-defined]
    return workbench


def settle(workbench: Workbench) -> None:
    """Let the running job end, and do all that it posted."""
    workbench.pump.run_until(lambda: not workbench.jobs.running)  # type: ignore[attr-defined]


def planned(folder: Path) -> Workbench:
    """A workbench with the survey of ``folder`` and its plan."""
    workbench = make_workbench()
    workbench.open_survey(folder)
    settle(workbench)
    assert workbench.plan is not None, workbench.ui.told  # type: ignore[attr-defined]
    return workbench

"""What the first plan needs is loaded beforehand; the program does not wait for it when it ends."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from floorcast_app.warm_up import WarmUp, load_without_collecting
from floorcast_app.workers.planner import LocalPlanner
from floorcast_app.workers.planning_process import compile_kernels
from floorcast_app.workers.remote_planner import RemotePlanner
from floorplan_core.errors import Cancelled
from floorplan_core.kernel_cache import kernels_complete
from floorplan_core.observer import Observer

OPENS_AFTERWARDS = """
import sys
from floorcast_app import theme
from floorcast_app.workers.planning_process import warm_up
from floorplan_core.config import Config
from floorplan_core.observer import Observer
from floorplan_core.session import PlanningSession

warm_up(Observer())
loaded = set(sys.modules)
sample, observer = theme.resource("sample_survey"), Observer()
session = PlanningSession.open(sample / "points.ply", None, Config(), observer)
session.read(observer)
session.plan(Config(), (), observer, 0)
print(sorted(set(sys.modules) - loaded))
"""


def test_a_survey_that_is_opened_afterwards_needs_no_module_more() -> None:
    compile_kernels(Observer())  # else there is no warm-up
    ran = subprocess.run([sys.executable, "-c", OPENS_AFTERWARDS], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


def test_the_first_run_tells_how_far_it_is(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """An empty cache as it looks from outside: what compiles is a kernel of the test's own."""
    from numba import njit

    from floorcast_app.workers import planning_process

    told: list[tuple[str, int | None]] = []

    class Told(Observer):
        def stage_started(self, stage: str, total: int | None = None) -> None:
            told.append((stage, total))

        def progress(self, stage: str, done: int) -> None:
            told.append((stage, done))

    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))

    def kernel(x):
        return x + 1

    def compile_some(observer: Observer) -> None:
        njit(lambda x: x + 2)(1)  # not ours
        monkeypatch.setattr(kernel, "__module__", "floorplan_core.stages.some")
        for value in (1, 1.0):  # twice, and counted once
            compiled(value)

    compiled = njit(kernel)
    monkeypatch.setattr(planning_process, "_plan_sample", compile_some)
    compile_kernels(Told())
    (begun, total), *progress = told
    assert begun == "compile" and total is not None and total > 50
    assert progress == [("compile", 1)]
    told.clear()
    compile_kernels(Told())
    assert told == [], "only the first run"


def test_giving_up_the_first_run_goes_on_with_it_the_next_time(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    given_up = Observer()
    given_up.cancel.cancel()
    with pytest.raises(Cancelled):
        compile_kernels(given_up)
    assert not kernels_complete()


def test_the_process_that_plans_is_started() -> None:
    planner = RemotePlanner()
    warming = WarmUp(planner)
    warming.start()
    warming._thread.join()
    try:
        assert planner._life is not None and planner._life.process.is_alive()
    finally:
        planner.close()
    assert "scipy.spatial" in sys.modules


def test_stopped_before_it_begins_it_starts_nothing() -> None:
    class Watched(LocalPlanner):
        started = threading.Event()

        def start(self) -> None:
            self.started.set()

    planner = Watched()
    warming = WarmUp(planner)
    assert warming.stop()
    warming.start()
    warming._thread.join(60)
    assert not warming._thread.is_alive() and not planner.started.is_set()


def test_what_was_loaded_is_never_looked_through_again() -> None:
    before = gc.isenabled(), gc.get_freeze_count()
    load_without_collecting()
    assert not gc.isenabled()
    warming = WarmUp(LocalPlanner())
    warming.start()
    warming._thread.join()
    try:
        assert gc.isenabled() and gc.get_freeze_count() > before[1]
    finally:
        gc.unfreeze()

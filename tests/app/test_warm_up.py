"""What the first plan needs is loaded beforehand; the program does not wait for it when it ends."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading

from floorcast_app.warm_up import WarmUp, load_without_collecting
from floorcast_app.workers.planner import LocalPlanner
from floorcast_app.workers.remote_planner import RemotePlanner

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
    from floorplan_core.kernel_cache import kernels_compiled, use_kernel_cache

    use_kernel_cache()
    if not kernels_compiled():  # then there is no warm-up: make it so
        from floorcast_app import theme
        from floorplan_core import process

        process(theme.resource("sample_survey"))
    ran = subprocess.run([sys.executable, "-c", OPENS_AFTERWARDS], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


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
    warming.stop()
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

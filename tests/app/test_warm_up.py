"""What the first plan needs is loaded beforehand; the program does not wait for it when it ends."""

from __future__ import annotations

import subprocess
import sys

from floorcast_app.warm_up import WarmUp

OPENS_AFTERWARDS = """
import sys
from floorcast_app import theme
from floorcast_app.warm_up import WarmUp
from floorplan_core.session import PlanningSession

warming = WarmUp()
warming.start()
warming._thread.join()
loaded = set(sys.modules)
from floorplan_core.config import Config
from floorplan_core.observer import Observer

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


def test_it_can_be_stopped_at_once() -> None:
    warming = WarmUp()
    warming.start()
    warming.stop()
    assert not warming._thread.is_alive()

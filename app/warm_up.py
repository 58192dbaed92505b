"""Loads what the first plan needs while the user looks for a file. No Qt.

Modules are imported and compiled kernels linked when they are first called, which holds the interpreter for a
moment each: better now than while a survey is on its way. The bundled survey is planned for that.
"""

from __future__ import annotations

import threading
from importlib.resources import files
from pathlib import Path

from floorplan_core.config import Config
from floorplan_core.errors import FloorPlanError
from floorplan_core.observer import CancelToken, Observer

LAST_WAIT = 60.0  # s for what cannot be interrupted; nobody sees it, the window is gone


class WarmUp:
    """A thread that can be told to stop."""

    def __init__(self) -> None:
        self._cancel = CancelToken()
        self._thread = threading.Thread(target=self._run, name="warm-up", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def stop(self) -> None:
        """Stop at the next stage, and wait for that."""
        self._cancel.cancel()
        if self._thread.is_alive():
            self._thread.join(LAST_WAIT)

    def _run(self) -> None:
        from floorplan_core.kernel_cache import kernels_compiled, use_kernel_cache

        use_kernel_cache()
        if not kernels_compiled() or self._cancel.cancelled:
            return  # compiling takes a minute: that is for the first survey, which says so
        import scipy.spatial  # noqa: F401 (the 3D pane's points ask it for their wall)

        from floorplan_core.session import PlanningSession

        sample = Path(str(files("floorcast_resources").joinpath("sample_survey")))
        config, observer = Config(), Observer(self._cancel)
        try:
            session = PlanningSession.open(sample, None, config, observer)
            session.read(observer)
            session.plan(config, (), observer, 0)
            session.storeys(config)
        except FloorPlanError:
            return  # cancelled, or the survey is not there: what was loaded is loaded

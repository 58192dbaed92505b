"""Loads what the first survey needs while the user looks for a file. No Qt.

The process that plans is started, and makes itself ready on its own. What the panes need to show points is
imported here: modules that a thread imports hold the window up for a moment each, better now than while a
survey is on its way.
"""

from __future__ import annotations

import gc
import threading

from floorcast_app.workers.behind import step_behind
from floorcast_app.workers.planner import Planner

LAST_WAIT = 60.0  # s for what cannot be interrupted; nobody sees it, the window is gone


def load_without_collecting() -> None:
    """Let nothing look for garbage until :class:`WarmUp` has loaded all, and never in what is there then.

    A look at all 160,000 objects of the modules takes 0.1 s, in which the window stands still.
    """
    gc.disable()


class WarmUp:
    """A thread that can be waited for."""

    def __init__(self, planner: Planner) -> None:
        self._planner = planner
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._run, name="warm-up", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def stop(self, seconds: float = LAST_WAIT) -> bool:
        """Begin nothing more, and wait for what was begun; False where it goes on after ``seconds``."""
        self._stopped.set()
        if self._thread.is_alive():
            self._thread.join(seconds)
        return not self._thread.is_alive()

    def _run(self) -> None:
        step_behind()
        try:
            if not self._stopped.is_set():
                self._planner.start()
            if not self._stopped.is_set():
                import scipy.spatial  # noqa: F401 (the 3D pane's points ask it for their wall)

                import floorcast_app.rendering.kernels  # noqa: F401
        finally:
            gc.freeze()
            gc.enable()

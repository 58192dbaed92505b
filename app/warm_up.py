"""Loads what the first plan needs while the user looks for a file. No Qt.

Compiled kernels are linked when they are first called, which holds the interpreter for a moment each: better
now than while a survey is on its way. A box of points goes through the whole pipeline for that.
"""

from __future__ import annotations

import threading

import numpy as np

from floorplan_core.errors import FloorPlanError
from floorplan_core.observer import CancelToken, Observer

LAST_WAIT = 60.0  # s for what cannot be interrupted; nobody sees it, the window is gone
SIZE = (4.0, 3.0, 2.5)  # metres of the box
STEP = 0.05  # metres between its points


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
        from floorplan_core.pipeline import FloorPlanner

        if not kernels_compiled() or self._cancel.cancelled:
            return  # compiling takes a minute: that is for the first survey, which says so
        planner = FloorPlanner(observer=Observer(self._cancel))
        eye = np.eye(4)
        eye[:3, 3] = np.array(SIZE) / 2
        try:
            planner.integrate(box() - eye[:3, 3], eye)
            planner.plan()
        except FloorPlanError:
            return  # cancelled, or the box is no room: what was loaded is loaded


def box() -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """(N, 3) points on the inside of a box, metres."""
    sides = []
    for axis in range(3):
        a, b = (np.arange(0, SIZE[k], STEP) for k in range(3) if k != axis)
        grid = np.stack(np.meshgrid(a, b, indexing="ij"), axis=-1).reshape(-1, 2)
        for at in (0.0, SIZE[axis]):
            sides.append(np.insert(grid, axis, at, axis=1))
    return np.concatenate(sides)

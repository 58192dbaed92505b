"""Points for the 3D pane, made ready in a thread: shuffled, moved into the scene, coloured. No Qt."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.point_store import PointStore
from floorcast_app.rendering.cloud import Cloud, Paint, lowest_level, make_cloud, paint, scene_matrix
from floorcast_app.workers.behind import step_behind
from floorplan_core.model import FloorPlan

Float = NDArray[np.float64]

_log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class Wanted:
    """What the points are wanted for. Stores and plans are compared by identity: they hold arrays."""

    store: PointStore
    plan: FloorPlan | None
    colour: str  # one of POINT_COLOURS
    theme: str
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)  # metres: of the plan's local frame in the points'
    scans: int | None = None  # rows of the trajectory whose points are shown; None: all

    def same(self, other: Wanted | None) -> bool:
        """True where both want the same."""
        if other is None or self.store is not other.store or self.plan is not other.plan:
            return False
        told = (self.colour, self.theme, self.origin, self.scans)
        return told == (other.colour, other.theme, other.origin, other.scans)


@dataclass(frozen=True)
class Loaded:
    """Points ready to draw."""

    wanted: Wanted
    cloud: Cloud
    paint: Paint
    matrix: Float  # (3, 4) local frame to scene
    read: int  # points that the store had then


class CloudMaker:
    """Makes what is wanted; keeps the cloud as long as only its colours change."""

    def __init__(self) -> None:
        self._kept: tuple[PointStore, int, int | None, Float, Cloud] | None = None

    def load(self, wanted: Wanted) -> Loaded:
        """Points of the store as it is now."""
        _, read, _, matrix, cloud = self._cloud(wanted)
        colours = paint(cloud, wanted.colour, wanted.plan, wanted.theme)
        return Loaded(wanted, cloud, colours, matrix, read)

    def _cloud(self, wanted: Wanted) -> tuple[PointStore, int, int | None, Float, Cloud]:
        store, plan, scans = wanted.store, wanted.plan, wanted.scans
        count, matrix = len(store), None if plan is None else scene_matrix(plan, origin=wanted.origin)
        kept = self._kept
        if kept is not None and kept[:3] == (store, count, scans) and _near(kept[3], matrix):
            return kept
        points = store.snapshot()
        if scans is not None and points.scan is not None:
            points = points.rows(np.flatnonzero(points.scan < scans))
        if matrix is None:
            matrix = scene_matrix(None, lowest_level(points.xyz))
        self._kept = (store, count, scans, matrix, make_cloud(points, matrix))
        return self._kept


class CloudLoader:
    """Loads what was wanted last, and tells ``done(loaded)`` in its own thread."""

    def __init__(self, done: Callable[[Loaded], None]) -> None:
        self._done = done
        self._wake = threading.Condition()
        self._wanted: Wanted | None = None
        self._closed = self._busy = False
        self._maker = CloudMaker()
        threading.Thread(target=self._run, name="3D points", daemon=True).start()

    @property
    def busy(self) -> bool:
        """True while something that was wanted is not there yet."""
        return self._busy or self._wanted is not None

    def want(self, wanted: Wanted) -> None:
        """Load soon; what was wanted before is forgotten."""
        with self._wake:
            self._wanted = wanted
            self._wake.notify()

    def close(self) -> None:
        """Load no more; returns at once."""
        with self._wake:
            self._closed = True
            self._wake.notify()

    def _run(self) -> None:
        step_behind()
        while True:
            with self._wake:
                self._busy = False
                self._wake.wait_for(lambda: self._wanted is not None or self._closed)
                if self._closed or self._wanted is None:
                    return
                wanted, self._wanted, self._busy = self._wanted, None, True
            try:
                loaded = self._maker.load(wanted)
            except Exception:  # noqa: BLE001 (the next wish may be possible)
                _log.exception("The points of the 3D pane could not be made ready.")
                continue
            if self._wanted is None and not self._closed:
                self._done(loaded)


def _near(kept: Float, matrix: Float | None) -> bool:
    """True where points need not be moved again: no plan, or a frame that did not turn."""
    return matrix is None or bool(np.array_equal(kept, matrix))

"""Frames in a thread of their own: a quick one at once, a fine one when nothing moves any more. No Qt."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorcast_app.rendering.cloud import Cloud, Paint
from floorcast_app.rendering.floors import NO_FLOORS, Floors, Section, make_floors
from floorcast_app.rendering.renderer import Frame, FrameRequest, Renderer
from floorcast_app.rendering.scene import Scene, build_scene
from floorcast_app.selection import Item
from floorcast_app.view_state import Look
from floorcast_app.workers.behind import step_behind
from floorplan_core.model import FloorPlan

TARGET = 0.030  # s for a frame while something moves: 30 a second with what the window itself needs
REST = 0.15  # s without a new request after which the fine frame is drawn
FEWEST, MOST = 250_000, 4_000_000  # points of a frame while something moves
FIRST = 400_000  # points of the very first one

_log = logging.getLogger(__name__)

_CAMERA = {"centre": (0.0, 0.0), "span": 1.0, "azimuth": 0.0, "elevation": 0.0, "workspace": "", "units": ""}


@dataclass(frozen=True)
class Subject:
    """What is to be seen, before it is known how it is drawn."""

    look: Look
    width: int  # pixels of the pane
    height: int
    ratio: float = 1.0  # device pixels for a pixel of the pane, for the fine frame
    plan: FloorPlan | None = None
    selected: tuple[Item, ...] = ()
    hovered: Item | None = None
    path: NDArray[np.float64] | None = None  # (M, 3) metres, scene frame
    cloud: Cloud | None = None
    paint: Paint | None = None


class Stage:
    """Makes requests of subjects; keeps floors and scene as long as they hold."""

    def __init__(self) -> None:
        self._floors: tuple[FloorPlan | None, Section | None, Floors] = (None, None, NO_FLOORS)
        self._scene: tuple[Subject, Scene] | None = None

    def request(self, subject: Subject, ratio: float = 1.0) -> FrameRequest:
        """What the renderer needs, at ``ratio`` pixels for a pixel of the pane."""
        width, height = (max(round(ratio * n), 1) for n in (subject.width, subject.height))
        scene = self._scene_of(subject)
        planned = subject.plan is not None
        return FrameRequest(subject.look, width, height, scene, subject.cloud, subject.paint, planned, ratio)

    def _scene_of(self, subject: Subject) -> Scene:
        # all that the scene does not depend on is set to the same value
        key = replace(
            subject,
            look=replace(subject.look, **_CAMERA),
            width=0,
            height=0,
            ratio=1.0,
            cloud=None,
            paint=None,
        )
        if self._scene is None or not _same(self._scene[0], key):
            floors = self._floors_of(subject)
            scene = build_scene(
                subject.plan, subject.look, subject.selected, subject.hovered, subject.path, floors
            )
            self._scene = (key, scene)
        return self._scene[1]

    def _floors_of(self, subject: Subject) -> Floors:
        plan, section = subject.plan, subject.look.section
        if self._floors[0] is not plan or self._floors[1] != section:
            made = NO_FLOORS if plan is None else make_floors(plan, section)
            self._floors = (plan, section, made)
        return self._floors[2]


class FrameWorker:
    """Draws what was asked for last, and tells ``done(frame, fine)`` in its own thread."""

    def __init__(self, done: Callable[[Frame, bool], None]) -> None:
        self._done = done
        self._wake = threading.Condition()
        self._asked: Subject | None = None
        self._closed = False
        self._budget = FIRST
        self._renderer, self._stage = Renderer(), Stage()
        self._thread = threading.Thread(target=self._run, name="3D frames", daemon=True)
        self._thread.start()

    def ask(self, subject: Subject) -> None:
        """Draw ``subject`` soon; what was asked for before is forgotten."""
        with self._wake:
            self._asked = subject
            self._wake.notify()

    def close(self) -> None:
        """Draw no more; returns at once."""
        with self._wake:
            self._closed = True
            self._wake.notify()

    def join(self, seconds: float) -> bool:
        """Wait for the thread to end after :meth:`close`; False where it has not."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def _run(self) -> None:
        step_behind()
        while (subject := self._next()) is not None:
            try:
                self._quick(subject)
                if self._rests():
                    self._fine(subject)
            except Exception:  # noqa: BLE001 (one frame that fails must not freeze the pane for good)
                _log.exception("A frame of the 3D pane failed.")

    def _next(self) -> Subject | None:
        with self._wake:
            self._wake.wait_for(self._disturbed)
            subject, self._asked = self._asked, None
            return None if self._closed else subject

    def _rests(self) -> bool:
        with self._wake:
            return not self._wake.wait_for(self._disturbed, REST)

    def _disturbed(self) -> bool:
        return self._asked is not None or self._closed

    def _quick(self, subject: Subject) -> None:
        request = self._stage.request(subject)
        began = time.perf_counter()
        frame = self._renderer.render(request, self._budget, stop=lambda: self._closed)
        if frame is None:
            return
        self._adapt(time.perf_counter() - began, frame.points)
        self._done(frame, False)

    def _fine(self, subject: Subject) -> None:
        """Where the screen has small pixels the frame has as many; else edges are smoothed."""
        small = subject.ratio > 1.0
        request = self._stage.request(subject, subject.ratio if small else 1.0)
        frame = self._renderer.render(request, fine=not small, stop=self._disturbed)
        if frame is not None:
            self._done(frame, True)

    def _adapt(self, seconds: float, drawn: int) -> None:
        """More or fewer points next time, so that a frame takes about :data:`TARGET`."""
        if drawn >= FEWEST:
            ratio = min(max(TARGET / max(seconds, 1e-4), 0.5), 1.25)
            self._budget = int(min(max(self._budget * ratio, FEWEST), MOST))


def _same(a: Subject, b: Subject) -> bool:
    """True where both make the same scene; plans and paths are compared by identity (they hold arrays)."""
    return (
        a.plan is b.plan
        and a.path is b.path
        and (a.look, a.selected, a.hovered) == (b.look, b.selected, b.hovered)
    )

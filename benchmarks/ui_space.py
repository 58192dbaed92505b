"""How fluently the 3D pane orbits: ``python -m benchmarks.ui_space [millions of points]``.

The bundled survey is planned, then its points are repeated with 5 mm of noise until the store is full. A pane
of 1280 x 800 pixels is orbited by mouse moves for some seconds. Reported are frames per second that reached
the window, the points of a frame, the largest time for which the event loop stood still, and the processor
time of one frame alone in its thread (which other work on the machine disturbs least).
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QElapsedTimer, QEvent, QPointF, Qt, QTimer
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from benchmarks.record import Outcome, report
from floorcast_app.qt_post import QtPost
from floorcast_app.rendering.frame_worker import Stage, Subject
from floorcast_app.rendering.renderer import Renderer
from floorcast_app.viewports.space_view import SpaceView
from floorcast_app.workbench import Workbench
from floorplan_core.model import PointChunk

SAMPLE = Path(__file__).resolve().parents[1] / "resources" / "sample_survey"
WIDTH, HEIGHT = 1280, 800
SECONDS = 6.0  # of orbiting
NOISE = 0.005  # metres
TICK = 5  # ms between two mouse moves
MOST_SECONDS = 300.0  # for planning on a loaded machine
BLOCK = 340_000


class Measured(SpaceView):
    """Counts the frames that reach the window."""

    frames = fine = 0

    def _show_frame(self, frame, fine):  # type: ignore[no-untyped-def]
        self.fine += fine
        self.frames += not fine
        super()._show_frame(frame, fine)


def planned(app: QApplication) -> Workbench:
    """A workbench with the bundled survey."""
    workbench = Workbench(QtPost(app))
    workbench.open_survey(SAMPLE)
    wait(app, lambda: not workbench.jobs.running, MOST_SECONDS)
    if workbench.plan is None:
        raise SystemExit("The bundled survey was not planned.")
    workbench.run("view.fit")
    return workbench


def fill(workbench: Workbench, count: int) -> None:
    """Repeat the points of the store with noise."""
    points, rng = workbench.points.snapshot().xyz, np.random.default_rng(0)
    while len(workbench.points) < count:
        more = points[: count - len(workbench.points)]
        noisy = more + rng.normal(0.0, NOISE, more.shape).astype(np.float32)
        workbench.points.add(PointChunk(noisy))


def wait(app: QApplication, done, seconds: float) -> float:  # type: ignore[no-untyped-def]
    """Run the event loop until ``done()``; the largest time between two of its ticks, seconds."""
    ticks, clock = [0.0], QElapsedTimer()
    timer = QTimer(interval=TICK)
    timer.timeout.connect(lambda: ticks.append(clock.nsecsElapsed() * 1e-9))
    clock.start()
    timer.start()
    while not done() and clock.elapsed() < seconds * 1000:
        app.processEvents()
        time.sleep(0.001)
    return float(np.diff(ticks).max()) if len(ticks) > 1 else 0.0


def orbit(app: QApplication, view: Measured) -> tuple[float, int, float]:
    """Frames per second, points of a frame and the largest gap in seconds while a mouse orbits."""

    def send(kind: QEvent.Type, x: float, buttons: Qt.MouseButton) -> None:
        at = QPointF(x, HEIGHT / 2)
        button = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseMove else Qt.MouseButton.LeftButton
        event = QMouseEvent(kind, at, view.mapToGlobal(at), button, buttons, Qt.KeyboardModifier.NoModifier)
        app.sendEvent(view, event)

    began = time.perf_counter()
    send(QEvent.Type.MouseButtonPress, 0.0, Qt.MouseButton.LeftButton)
    mover = QTimer(interval=TICK)
    mover.timeout.connect(
        lambda: send(QEvent.Type.MouseMove, 200.0 * (time.perf_counter() - began), Qt.MouseButton.LeftButton)
    )
    mover.start()
    wait(app, lambda: False, 1.0)  # the number of points settles
    view.frames, start = 0, time.perf_counter()
    gap = wait(app, lambda: False, SECONDS)
    rate = view.frames / (time.perf_counter() - start)
    points = view.frame.points if view.frame is not None else 0
    mover.stop()
    send(QEvent.Type.MouseButtonRelease, 0.0, Qt.MouseButton.NoButton)
    return rate, points, gap


def frame_seconds(view: Measured, points: int | None, fine: bool) -> float:
    """Processor time of one frame in its own thread, the best of several."""
    renderer, stage = Renderer(), Stage()
    subject: Subject = view.subject(WIDTH, HEIGHT)
    times = []
    for _ in range(6):
        began = time.thread_time()
        renderer.render(stage.request(subject), points, fine)
        times.append(time.thread_time() - began)
    return min(times)


def window_seconds(view: Measured) -> float:
    """Processor time of the window's own thread for showing one frame, the best of several."""
    frame, times = view.frame, []
    for _ in range(6):
        began = time.thread_time()
        view._show_frame(frame, True)
        view.repaint()
        times.append(time.thread_time() - began)
    return min(times)


def space(millions: float = 10.0) -> Outcome:
    """Orbit a store of so many points."""
    app = QApplication.instance() or QApplication([])
    workbench = planned(app)  # type: ignore[arg-type]
    count = int(millions * 1e6)
    fill(workbench, count)
    view = Measured(workbench)
    view.resize(WIDTH, HEIGHT)
    view.show()
    loading = wait(app, lambda: view.frame is not None and view.frame.points > 0, 120.0)  # type: ignore[arg-type]
    wait(app, lambda: view.fine > 0, 30.0)  # type: ignore[arg-type]
    rate, points, gap = orbit(app, view)  # type: ignore[arg-type]
    alone = frame_seconds(view, points, False)
    whole, shown = frame_seconds(view, None, True), window_seconds(view)
    million = frame_seconds(view, 1_000_000, False)
    view.shut_down()
    figures = {
        "frames_per_second": rate,
        "points_of_a_frame": points,
        "largest_gap_ms": gap * 1e3,
        "largest_gap_loading_ms": loading * 1e3,
        "frame_cpu_ms": alone * 1e3,
        "frame_of_a_million_cpu_ms": million * 1e3,
        "window_cpu_ms": shown * 1e3,
        "fine_frame_cpu_ms": whole * 1e3,
    }
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    note = f"load of the machine meanwhile: {load:.1f} on {os.cpu_count()} cores"
    title = f"orbiting {count:,} points at {WIDTH} x {HEIGHT}"
    return Outcome(title, figures=figures, notes=(note,), header=("pane",))


if __name__ == "__main__":
    report("ui_space", space(*map(float, sys.argv[1:2])))

"""How fluently the plan panes pan and zoom: ``python -m benchmarks.ui_plan``.

A made-up building of 10 x 10 rooms with 180 doors, planes in 4,000 observed runs, 200,000 observed columns
and a raster of 2,000 x 2,000 cells, in panes of 1280 x 800 pixels. Reported is the processor time of one
frame of the pane under the pointer (everything is painted anew), of one frame of a pane beside it (its last
picture is shifted), and of a move of the pointer.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
import shapely
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from benchmarks.record import Outcome, best_seconds, report
from floorcast_app import theme
from floorcast_app.jobs import immediately
from floorcast_app.viewports.canvas import PlanCanvas
from floorcast_app.viewports.floor_plan_view import FloorPlanView
from floorcast_app.viewports.free_space_view import FreeSpaceView
from floorcast_app.viewports.planes_view import PlanesView
from floorcast_app.workbench import Workbench
from floorplan_core.model import (
    FREE,
    OCCUPIED,
    Door,
    FloorPlan,
    OccupancyGrid,
    Region,
    RegionSide,
    WallPoints,
)
from floorplan_core.pipeline import process
from floorplan_core.readers import open_survey

ROOMS, SIZE, WALL = 10, 4.0, 0.15  # rooms along each side, metres
CELLS, RUNS, POINTS = 2000, 10, 200_000
WIDTH, HEIGHT = 1280, 800
FRAMES = 10  # of which the mean is taken
STEP = 0.03  # metres between two frames


def building() -> FloorPlan:
    """The made-up plan; frames, segments and settings are those of the bundled survey."""
    plan = process(open_survey(theme.resource("sample_survey")))
    pitch = SIZE + WALL
    corners = [(i * pitch, j * pitch) for j in range(ROOMS) for i in range(ROOMS)]
    regions = tuple(_room(k, x, y) for k, (x, y) in enumerate(corners))
    doors = tuple(_door(k, x, y, axis) for axis in (0, 1) for k, (x, y) in enumerate(corners) if (x, y)[axis])
    rng = np.random.default_rng(0)
    runs = np.sort(rng.uniform(0, ROOMS * pitch, (RUNS, 2)), axis=1)
    planes = tuple(
        replace(p, id=f"p{k}", offset=k * pitch / 10, observed=runs, walls=runs)
        for k, p in zip(range(4 * 10 * ROOMS), plan.planes * 40, strict=False)
    )
    states = rng.choice(np.array([FREE, FREE, FREE, OCCUPIED], dtype=np.uint8), (CELLS, CELLS))
    cell = ROOMS * pitch / CELLS
    grid = OccupancyGrid(np.zeros(2), cell, states, states == FREE, 1.5)
    xy = rng.uniform(0, ROOMS * pitch, (POINTS, 2)).astype(np.float32)
    points = WallPoints(xy, xy[:, 0], rng.integers(-1, 4, POINTS).astype(np.int8))
    return replace(
        plan, regions=regions, doors=doors, planes=planes, segments=(), grid=grid, wall_points=points
    )


def _room(k: int, x: float, y: float) -> Region:
    box = shapely.box(x, y, x + SIZE, y + SIZE)
    ring = box.exterior.coords
    sides = tuple(RegionSide(a, b, "", float(k % 7 > 0)) for a, b in pairwise(ring))
    return Region(f"r{k}", f"{k + 1}", box, ("room", "corridor")[k % 9 == 0], 1000, 1100, 0.1, sides)


def _door(k: int, x: float, y: float, axis: int) -> Door:
    at, along = ((x, y), (y, x))[axis]
    return Door(f"d{axis}{k}", (), axis, at - WALL / 2, along + 1.0, along + 1.9, WALL, confidence=0.8)


def _seconds(work: Callable[[], None]) -> float:
    """Processor seconds of one call, of the best of three runs of many."""

    def many() -> None:
        for _ in range(FRAMES):
            work()

    return best_seconds(many, clock=time.process_time) / FRAMES


def _measure(app: QApplication, workbench: Workbench, pane: PlanCanvas) -> tuple[float, float, float, float]:
    """Seconds of: a pan near, a pan far, a pan beside, a move of the pointer."""
    pane.resize(WIDTH, HEIGHT)
    pane.show()
    while not pane.ready:
        app.processEvents()

    def pan() -> None:
        x, y = workbench.view.look.centre
        workbench.view.set(centre=(x + STEP, y))
        pane.repaint()

    def hover() -> None:
        at = QPointF(600 + 50 * np.sin(time.process_time() * 1000), 400)
        button = Qt.MouseButton.NoButton
        event = QMouseEvent(QEvent.Type.MouseMove, at, at, button, button, Qt.KeyboardModifier.NoModifier)
        QApplication.sendEvent(pane, event)
        pane.repaint()

    hover()
    out = []
    for span in (1.1 * ROOMS * (SIZE + WALL), 2.5 * SIZE):
        workbench.view.set(span=span, centre=(20.0, 20.0))
        out.append(_seconds(pan))
    moves = _seconds(hover)
    QApplication.sendEvent(pane, QEvent(QEvent.Type.Leave))
    beside = _seconds(pan)
    pane.close()
    pane.shut_down()
    return out[1], out[0], beside, moves


def panes() -> Outcome:
    """All three plan panes."""
    app = QApplication.instance() or QApplication([])
    theme.apply_theme(app, "light")  # type: ignore[arg-type]
    workbench = Workbench(immediately)
    workbench.plan = building()
    rows, figures = [], {}
    for name, made in (("planes", PlanesView), ("free space", FreeSpaceView), ("floor plan", FloorPlanView)):
        seconds = _measure(app, workbench, made(workbench))  # type: ignore[arg-type]
        rows.append([name, *(f"{1000 * s:.1f}" for s in seconds), f"{1 / max(seconds[:2]):.0f}"])
        figures[f"{name} frame ms"] = 1000 * max(seconds[:2])
    header = ("pane", "near, ms", "whole, ms", "beside, ms", "pointer, ms", "frames/s at least")
    return Outcome(f"Plan panes of {WIDTH} x {HEIGHT}: processor time of one frame", header, rows, figures)


if __name__ == "__main__":
    report("ui_plan", panes())

"""The status bar: what runs, where the pointer is, and what the plan is made of."""

from __future__ import annotations

import math

from PySide6.QtWidgets import QLabel, QStatusBar, QWidget

from floorcast_app import theme
from floorcast_app.format import angle, length, number, percent, seconds
from floorcast_app.panels.base import listener_of
from floorcast_app.panels.progress_strip import ProgressStrip
from floorcast_app.translation import tr, tr_n
from floorcast_app.workbench import Workbench


class StatusBar(QStatusBar):
    """Pieces, each of which knows what it shows."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self.setSizeGripEnabled(False)
        self.pointer = QLabel()
        self.frame, self.points, self.counts, self.ready = QLabel(), QLabel(), QLabel(), QLabel()
        self.pointer.setMinimumWidth(160)
        self.pointer.setFont(theme.font(figures=True))
        self.progress = ProgressStrip(workbench, self)
        self.addWidget(self.pointer)
        self.addWidget(self.progress)
        for piece in (self.frame, self.points, self.counts, self.ready):
            piece.setMinimumWidth(1)  # rather cut short for a moment than a window that grows
            self.addPermanentWidget(piece)
        self._connect()
        self._refresh()

    def _connect(self) -> None:
        w = self._workbench
        for event, then in (
            (w.pointer_moved, self._moved),
            (w.plan_changed, self._refresh),
            (w.points_changed, self._refresh),
            (w.view.changed, self._refresh),
            (w.jobs.started, self._refresh),
            (w.jobs.ended, self._refresh),
        ):
            event.connect(listener_of(self, then, event))

    def _moved(self, x: float | None, y: float | None) -> None:
        units = self._workbench.view.look.units
        if x is None or y is None:
            self.pointer.clear()
        elif units == "m":
            self.pointer.setText(f"x {number(x, '.3f')}  y {number(y, '.3f')} m")
        else:
            self.pointer.setText(f"x {length(x, units)}  y {length(y, units)}")

    def _refresh(self, *_: object) -> None:
        plan, points = self._workbench.plan, len(self._workbench.points)
        shown = plan.point_count if plan is not None else points
        self.points.setText(tr_n("%Ln point(s)", shown) if shown else "")
        working = self._workbench.jobs.running  # its progress takes the place of what was
        for piece in (self.frame, self.counts, self.ready):
            piece.setVisible(plan is not None and not working)
        if plan is None:
            return
        yaw, support = math.degrees(plan.frame.yaw), plan.frame.support
        self.frame.setText(tr("frame {yaw} (support {share})").format(yaw=angle(yaw), share=percent(support)))
        counts = (
            tr_n("%Ln plane(s)", len(plan.all_planes)),
            tr_n("%Ln region(s)", len(plan.regions)),
            tr_n("%Ln door(s)", len(plan.doors)),
        )
        self.counts.setText(" · ".join(counts))
        took = sum(s for stage, s in plan.seconds.items() if stage not in ("total", "read", "export"))
        self.ready.setText(tr("ready in {time}").format(time=seconds(plan.seconds.get("total", took))))

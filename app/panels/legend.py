"""What the signs of the plan mean: those that the present plan has."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtCore import QLineF, QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from floorcast_app import theme
from floorcast_app.panels.base import GRID, Panel, clear, label
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench
from floorplan_core.model import FloorPlan

SIGN = QSize(28, 16)  # px
PALER = 0.6  # how far predicted floor goes towards the ground, as in the plan
KNOWN = ("room", "corridor")  # labels with a colour of their own


def entries(plan: FloorPlan) -> Iterator[tuple[str, str]]:
    """(sign, English words), from the ground up."""
    labels = {r.label for r in plan.regions}
    for name, text in (("room", "Room"), ("corridor", "Corridor")):
        if name in labels:
            yield name, text
    for name in sorted(labels - set(KNOWN)):
        yield "other", name
    if any(r.speculated_fraction > 0 for r in plan.regions):
        yield "predicted", "Predicted floor"
    yield "wall", "Wall"
    if any(s.speculated for r in plan.regions for s in r.sides):
        yield "guessed", "Guessed side"
    if any(d.kind == "door" and not d.shut for d in plan.doors):
        yield "door", "Door"
    if any(d.shut for d in plan.doors):
        yield "shut", "Door, found shut"
    if any(d.kind != "door" for d in plan.doors):
        yield "opening", "Opening"


class Legend(Panel):
    """One row for each sign; hidden where there is no plan."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(GRID)
        self._grid.setColumnStretch(1, 1)
        self._shown: list[tuple[str, str]] = []
        self.listen(workbench.plan_changed)
        self.refresh()

    def refresh(self) -> None:
        plan = self.workbench.plan
        wanted = list(entries(plan)) if plan is not None else []
        self.setVisible(bool(wanted))
        if wanted == self._shown:
            return
        self._shown = wanted
        clear(self._grid)
        self._grid.addWidget(label(tr("Legend"), "section"), 0, 0, 1, 2)
        for row, (sign, text) in enumerate(wanted, start=1):
            self._grid.addWidget(Sign(sign), row, 0)
            self._grid.addWidget(QLabel(tr(text)), row, 1)


class Sign(QWidget):
    """A swatch in the colours of the present theme."""

    def __init__(self, kind: str) -> None:
        super().__init__()
        self._kind = kind
        self.setFixedSize(SIGN)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, c = QPainter(self), theme.colours()
        box = QRectF(self.rect()).adjusted(0.5, 1.5, -0.5, -1.5)
        middle = QLineF(box.left(), box.center().y(), box.right(), box.center().y())
        if self._kind == "guessed":
            pen = QPen(QColor(c.wall), 2)
            pen.setDashPattern([3, 2])
            painter.setPen(pen)
            painter.drawLine(middle)
        elif self._kind == "wall":
            painter.fillRect(box, QColor(c.wall))
        elif self._kind in ("door", "shut", "opening"):
            self._paint_door(painter, box, middle)
        else:
            self._paint_floor(painter, box)
        painter.end()

    def _paint_floor(self, painter: QPainter, box: QRectF) -> None:
        c = theme.colours()
        floor = {"corridor": c.corridor, "other": c.other}.get(self._kind, c.room)
        painter.fillRect(box, QColor(floor))
        if self._kind == "predicted":
            paler = QColor(c.canvas)
            paler.setAlphaF(PALER)
            painter.fillRect(box, paler)
            painter.fillRect(box, QBrush(QColor(c.accent), Qt.BrushStyle.BDiagPattern))
        painter.setPen(QPen(QColor(c.line_strong), 1))
        painter.drawRect(box)

    def _paint_door(self, painter: QPainter, box: QRectF, middle: QLineF) -> None:
        c = theme.colours()
        painter.fillRect(box, QColor(c.door))
        ink = QColor(c.door).darker(170)
        dashed = Qt.PenStyle.DashLine if self._kind == "opening" else Qt.PenStyle.SolidLine
        painter.setPen(QPen(ink, 1, dashed))
        painter.drawLine(box.topLeft(), box.topRight())
        painter.drawLine(box.bottomLeft(), box.bottomRight())
        if self._kind == "shut":  # its leaf, across the opening
            painter.setPen(QPen(ink, 2))
            painter.drawLine(middle)

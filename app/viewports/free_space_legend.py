"""What the tones of the free-space pane mean: a row, or a column where the row would hide the plan."""

from __future__ import annotations

import numpy as np
import shapely
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from floorcast_app.layers.source import PlanSource
from floorcast_app.theme import Colours
from floorcast_app.translation import tr
from floorcast_app.viewports.plan_frame import SMALL, Frame, colour, draw_text, text_size

SWATCH = 11.0  # pixels
EDGE, PAD = 10.0, 10.0  # pixels from the edge of the pane, and inside the plate
GAP = 6.0  # pixels between a swatch and its word
BETWEEN = 16.0  # pixels between two entries of a row
LINE = 18.0  # pixels of a line
TALL = 24.0  # pixels of a row's plate

Entries = list[tuple[str, str]]  # (word, "#rrggbb")


def paint_legend(painter: QPainter, frame: Frame, source: PlanSource) -> None:
    """At the upper left."""
    entries = _entries(frame.colours)
    row, column = _row(entries), _column(entries)
    upright = _hidden(row, frame, source) > _hidden(column, frame, source)
    plate = column if upright else row
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour(frame.colours.panel, 0.88))
    painter.drawRoundedRect(plate, 5, 5)
    x, y = plate.left() + PAD, plate.top() + (LINE if upright else TALL) / 2 + (4 if upright else 0)
    for word, tone in entries:
        wide = _entry(painter, frame, word, tone, x, y)
        x, y = (x, y + LINE) if upright else (x + wide + BETWEEN, y)


def _entries(c: Colours) -> Entries:
    return [
        (tr("Free"), c.free),
        (tr("Predicted"), c.predicted),
        (tr("Occupied"), c.occupied),
        (tr("Not seen"), c.unobserved),
    ]


def _widths(entries: Entries) -> list[float]:
    return [SWATCH + GAP + text_size(word, SMALL)[0] for word, _ in entries]


def _row(entries: Entries) -> QRectF:
    widths = _widths(entries)
    return QRectF(EDGE, EDGE, round(sum(widths) + BETWEEN * (len(widths) - 1) + 2 * PAD), TALL)


def _column(entries: Entries) -> QRectF:
    return QRectF(EDGE, EDGE, round(max(_widths(entries)) + 2 * PAD), LINE * len(entries) + 8)


def _hidden(plate: QRectF, frame: Frame, source: PlanSource) -> float:
    """Square metres of the plan under a plate."""
    x0, y1 = frame.camera.to_plan(plate.left(), plate.top())
    x1, y0 = frame.camera.to_plan(plate.right(), plate.bottom())
    polygons = np.array([r.polygon for r in source.drawn.regions], dtype=object)
    return float(shapely.area(shapely.intersection(polygons, shapely.box(x0, y0, x1, y1))).sum())


def _entry(painter: QPainter, frame: Frame, word: str, tone: str, x: float, y: float) -> float:
    """One swatch with its word, about ``y``; returns its width."""
    left, top = round(x), round(y - SWATCH / 2)
    painter.setPen(colour(frame.colours.line_strong))
    painter.setBrush(colour(tone))
    painter.drawRect(left, top, round(SWATCH), round(SWATCH))
    if tone == frame.colours.predicted:
        painter.setPen(colour(QColor(tone).darker(145).name()))
        for k in (3, 8):
            painter.drawLine(left + k - 2, top + 11, left + k + 3, top + 1)
    wide = text_size(word, SMALL)[0]
    draw_text(painter, word, (x + SWATCH + GAP + wide / 2, y), SMALL, colour(frame.colours.text))
    return SWATCH + GAP + wide

"""The three tracks of the evidence pane: histogram, gradient and filter over metres along a plane."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPolygonF

from floorcast_app.layers.evidence import EvidenceLayer
from floorcast_app.theme import Colours
from floorcast_app.viewports.plan_frame import SMALL, colour, draw_text, pen, text_size
from floorcast_app.viewports.plan_observed_views import plane_colour

GRADIENT = 1.1  # the most of either sign that the track shows


def track_x(track: QRectF, shown: tuple[float, float], along: float) -> float:
    """Horizontal pixel of a place along the plane, metres."""
    low, high = shown
    return track.left() + (along - low) / (high - low) * track.width()


def curve(
    track: QRectF,
    evidence: EvidenceLayer,
    shown: tuple[float, float],
    values: NDArray[np.float64],
    low: float,
    high: float,
) -> QPolygonF:
    """The values of the bins in view as a line of pixels."""
    first = max(int(np.searchsorted(evidence.at, shown[0])) - 1, 0)
    last = min(int(np.searchsorted(evidence.at, shown[1])) + 2, len(values))
    x = track.left() + (evidence.at[first:last] - shown[0]) / (shown[1] - shown[0]) * track.width()
    y = (
        track.bottom()
        - (np.clip(values[first:last], low, high) - low) / (high - low) * (track.height() - 4)
        - 2
    )
    return QPolygonF([QPointF(a, b) for a, b in zip(x.tolist(), y.tolist(), strict=True)])


def filled(painter: QPainter, line: QPolygonF, base: float, name: str, alpha: float) -> None:
    """A line with the ground between it and ``base``."""
    if line.isEmpty():
        return
    area = QPolygonF([QPointF(line.first().x(), base), *line, QPointF(line.last().x(), base)])
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour(name, alpha))
    painter.drawPolygon(area)
    painter.setPen(pen(name, 1.4))
    painter.drawPolyline(line)


def paint_histogram(
    painter: QPainter, track: QRectF, evidence: EvidenceLayer, shown: tuple[float, float], c: Colours
) -> None:
    """Wall seen below 2 m, filled; above 2 m (lintels) as a thin line."""
    tone = plane_colour(c, evidence.facing.axis)
    filled(painter, curve(track, evidence, shown, evidence.histogram, 0, 1), track.bottom(), tone, 0.28)
    painter.setPen(pen(c.muted, 1.0, 0.9))
    painter.drawPolyline(curve(track, evidence, shown, evidence.lintel, 0, 1))


def paint_gradient(
    painter: QPainter, track: QRectF, evidence: EvidenceLayer, shown: tuple[float, float], c: Colours
) -> None:
    """Falls where an opening begins, rises where it ends."""
    middle = track.center().y()
    painter.setPen(pen(c.line_strong, 1.0))
    painter.drawLine(QPointF(track.left(), middle), QPointF(track.right(), middle))
    painter.setPen(pen(c.text, 1.3))
    painter.drawPolyline(curve(track, evidence, shown, evidence.gradient, -GRADIENT, GRADIENT))


def paint_response(
    painter: QPainter, track: QRectF, evidence: EvidenceLayer, shown: tuple[float, float], c: Colours
) -> None:
    """The best answer of the matched filter, and the threshold."""
    filled(painter, curve(track, evidence, shown, evidence.response, 0, 1), track.bottom(), c.accent, 0.25)
    y = track.bottom() - evidence.threshold * (track.height() - 4) - 2
    painter.setPen(pen(c.warning, 1.0, 1.0, (5.0, 4.0)))
    painter.drawLine(QPointF(track.left(), y), QPointF(track.right(), y))


def paint_label(painter: QPainter, track: QRectF, text: str, c: Colours) -> None:
    """The frame of a track and its name: reading upwards beside it, in a low track level and inside."""
    painter.setPen(pen(c.line_strong, 1.0))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(track)
    width, height = text_size(text, SMALL)
    if width <= track.height():
        draw_text(painter, text, (track.left() - 14, track.center().y()), SMALL, colour(c.muted), 400, True)
        return
    at = (track.left() + 6 + width / 2, track.top() + 3 + height / 2)
    draw_text(painter, text, at, SMALL, colour(c.muted), halo=colour(c.panel, 0.85))

"""Two areas over the moments of a run: what was seen, and what was predicted on top of it.

A click goes to that moment; each lies under its place on the slider above.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QBrush, QColor, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSlider, QWidget

from floorcast_app import theme
from floorcast_app.format import SQUARE_FEET_PER_M2, number
from floorcast_app.translation import tr

ROOMY = 80  # px: a lower one shows its shape only
MARGIN = 8.0  # px left and right, as much as half a slider's handle


class Sparkline(QWidget):
    """``values``: (time, seen m2, predicted m2) in order of time."""

    picked = Signal(int)

    def __init__(self, slider: QSlider) -> None:
        super().__init__()
        self._slider = slider
        self.values: tuple[tuple[float, float, float], ...] = ()
        self.at = -1
        self.units = "m"
        self.setMinimumHeight(24)

    def sizeHint(self) -> QSize:
        return QSize(400, 48)

    def show_values(self, values: Sequence[tuple[float, float, float]], at: int) -> None:
        """Draw ``values``, with a mark at index ``at``."""
        self.values, self.at = tuple(values), at
        self.update()

    def x_of(self, index: int) -> float:
        """Pixel of a moment."""
        left, right = self._ends()
        share = index / (len(self.values) - 1) if len(self.values) > 1 else 0.5
        return left + share * (right - left)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._pick(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._pick(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        if not self.values:
            return
        holds = theme.colours()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        top = self._top()
        seen = [s for _, s, _ in self.values]
        both = [s + p for _, s, p in self.values]
        self._area(painter, both, seen, top, QBrush(QColor(holds.predicted), Qt.BrushStyle.BDiagPattern))
        self._area(painter, seen, [0.0] * len(seen), top, QBrush(QColor(holds.accent_soft)))
        painter.setPen(QPen(QColor(holds.accent), 1.5))
        painter.drawPolyline(self._line(seen, top))
        if self.height() >= ROOMY:
            self._scale(painter, top)
        if 0 <= self.at < len(self.values):
            x = self.x_of(self.at)
            painter.setPen(QPen(QColor(holds.text), 1))
            painter.drawLine(QPointF(x, 0), QPointF(x, self.height()))
            y = self._y(seen[self.at], top)
            painter.setBrush(QColor(holds.accent))
            painter.drawEllipse(QRectF(x - 3, y - 3, 6, 6))
        painter.end()

    def _ends(self) -> tuple[float, float]:
        """Pixels of the first and the last place of the slider."""
        left = self._slider.mapToGlobal(QPoint(0, 0)).x() - self.mapToGlobal(QPoint(0, 0)).x()
        return left + MARGIN, left + self._slider.width() - MARGIN

    def _top(self) -> float:
        return max(seen + predicted for _, seen, predicted in self.values) or 1.0

    def _scale(self, painter: QPainter, top: float) -> None:
        """Round areas as fine lines, with their numbers; what the two fills mean."""
        holds = theme.colours()
        painter.setFont(theme.font(11))
        unit = 1.0 if self.units == "m" else 1 / SQUARE_FEET_PER_M2  # m2
        step, (left, right) = _round(top / unit / 3), self._ends()
        for k in range(1, int(top / unit / step) + 1):
            y = self._y(k * step * unit, top)
            painter.setPen(QPen(QColor(holds.line_strong), 1, Qt.PenStyle.DotLine))
            painter.drawLine(QPointF(left, y), QPointF(right, y))
            text = f"{number(k * step, ',.0f')} {'m²' if self.units == 'm' else 'sq ft'}"
            painter.setPen(QColor(holds.muted))
            box = QRectF(0, y - MARGIN, left - MARGIN, 2 * MARGIN)
            painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, text)
        x = right - MARGIN
        for text, brush in (
            (tr("predicted"), QBrush(QColor(holds.predicted), Qt.BrushStyle.BDiagPattern)),
            (tr("seen"), None),
        ):
            wide = painter.fontMetrics().horizontalAdvance(text)
            x -= wide
            painter.setPen(QColor(holds.muted))
            painter.drawText(QPointF(x, self.height() - 12), text)
            x -= 22
            swatch = QRectF(x, self.height() - 21, 16, 10)
            painter.setPen(QPen(QColor(holds.muted if brush else holds.accent), 1))
            painter.setBrush(brush or QBrush(QColor(holds.accent_soft)))
            painter.drawRect(swatch)
            x -= 16

    def _area(
        self, painter: QPainter, upper: Sequence[float], lower: Sequence[float], top: float, brush: QBrush
    ) -> None:
        outline = [*self._line(upper, top).toList(), *reversed(self._line(lower, top).toList())]
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(brush)
        painter.drawPolygon(QPolygonF(outline))

    def _line(self, heights: Sequence[float], top: float) -> QPolygonF:
        return QPolygonF([QPointF(self.x_of(i), self._y(h, top)) for i, h in enumerate(heights)])

    def _y(self, value: float, top: float) -> float:
        return self.height() - 2 - value / top * (self.height() - 8)

    def _pick(self, event: QMouseEvent) -> None:
        if self.values:
            x = event.position().x()
            self.picked.emit(min(range(len(self.values)), key=lambda i: abs(self.x_of(i) - x)))


def _round(value: float) -> float:
    """The next of 1, 2, 5, 10, 20, … that is not below ``value``."""
    power = 10.0 ** math.floor(math.log10(max(value, 1e-9)))
    return next(f * power for f in (1.0, 2.0, 5.0, 10.0) if f * power >= value * (1 - 1e-9))

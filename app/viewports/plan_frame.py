"""What every view of a layer paints with: camera, colours and look; paths, pens, hatches and text."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFont,
    QFontMetricsF,
    QImage,
    QPainter,
    QPainterPath,
    QPen,
    QPolygonF,
    QTransform,
)

from floorcast_app import theme
from floorcast_app.layers.source import Rings
from floorcast_app.theme import Colours
from floorcast_app.view_state import Look
from floorcast_app.viewports.plan_camera import Camera

HATCH_STEP = 8  # pixels from line to line
BODY, SMALL, NAME = 12, 11, 13  # pixels of text


@dataclass(frozen=True)
class Frame:
    """One picture of one pane."""

    camera: Camera
    colours: Colours
    look: Look
    ratio: float = 1.0  # device pixels for a pixel

    def transform(self) -> QTransform:
        """Plan metres to pixels."""
        c = self.camera
        x, y = c.centre
        return QTransform(c.scale, 0, 0, -c.scale, c.width / 2 - x * c.scale, c.height / 2 + y * c.scale)

    def shows(self, kind: str, id: str) -> bool:
        """False where the eye of this thing is shut."""
        return (kind, id) not in self.look.hidden

    def with_look(self, look: Look) -> Frame:
        """The same picture with another look."""
        return replace(self, look=look)


def colour(name: str, alpha: float = 1.0) -> QColor:
    """A colour "#rrggbb" with an opacity."""
    made = QColor(name)
    made.setAlphaF(alpha)
    return made


def pen(name: str, width: float = 1.0, alpha: float = 1.0, dashes: Iterable[float] | None = None) -> QPen:
    """A pen for painting in pixels; ``dashes`` in pixels, too."""
    made = QPen(colour(name, alpha), width)
    made.setCapStyle(Qt.PenCapStyle.FlatCap)
    made.setJoinStyle(Qt.PenJoinStyle.MiterJoin)
    if dashes is not None:
        made.setDashPattern([d / width for d in dashes])
    return made


def plan_pen(
    frame: Frame, name: str, width: float = 1.0, alpha: float = 1.0, dashes: Iterable[float] | None = None
) -> QPen:
    """The same for painting in metres. A cosmetic pen counts device pixels, however many make a pixel."""
    made = pen(name, width, alpha, dashes)
    made.setWidthF(width * frame.ratio)
    made.setCosmetic(True)
    return made


def path_of(rings: Rings) -> QPainterPath:
    """All rings as one path, filled by the odd-even rule."""
    path = QPainterPath()
    path.setFillRule(Qt.FillRule.OddEvenFill)
    for ring in rings:
        path.addPolygon(QPolygonF([QPointF(x, y) for x, y in ring.tolist()]))
        path.closeSubpath()
    return path


def lines_path(lines: np.ndarray) -> QPainterPath:
    """(K, 2, 2) separate lines as one path."""
    path = QPainterPath()
    for (x0, y0), (x1, y1) in lines.tolist():
        path.moveTo(x0, y0)
        path.lineTo(x1, y1)
    return path


def hatch(
    frame: Frame, name: str, alpha: float = 1.0, step: int = HATCH_STEP, falling: bool = False
) -> QBrush:
    """Diagonal lines of pixels at every zoom that stay with the plan while it is moved."""
    brush = QBrush(_hatch_tile(name, alpha, step, falling, frame.ratio))
    s = frame.camera.scale
    brush.setTransform(QTransform(1 / s, 0, 0, -1 / s, 0, 0))
    return brush


@lru_cache(maxsize=64)
def _hatch_tile(name: str, alpha: float, step: int, falling: bool, ratio: float) -> QImage:
    """One tile, drawn four times as fine and reduced so that its lines are smooth."""
    size = max(round(step * ratio), 3)
    fine = QImage(size * 4, size * 4, QImage.Format.Format_ARGB32_Premultiplied)
    fine.fill(Qt.GlobalColor.transparent)
    painter = QPainter(fine)
    painter.setPen(QPen(colour(name, alpha), 4.4 * ratio))
    n = size * 4
    for shift in (-n, 0, n):
        a, b = (QPointF(shift - 8, -8), QPointF(shift + n + 8, n + 8))
        if not falling:
            a, b = QPointF(shift - 8, n + 8), QPointF(shift + n + 8, -8)
        painter.drawLine(a, b)
    painter.end()
    tile = fine.scaled(
        size, size, Qt.AspectRatioMode.IgnoreAspectRatio, Qt.TransformationMode.SmoothTransformation
    )
    tile.setDevicePixelRatio(ratio)
    return tile


@lru_cache(maxsize=32)
def font(pixels: int, weight: int = 400) -> QFont:
    """The application's font."""
    return theme.font(pixels, weight)


@lru_cache(maxsize=4096)
def text_size(text: str, pixels: int, weight: int = 400) -> tuple[float, float]:
    """Width and height of a line of text, pixels."""
    metrics = QFontMetricsF(font(pixels, weight))
    return metrics.horizontalAdvance(text), metrics.height()


def draw_text(
    painter: QPainter,
    text: str,
    at: tuple[float, float],
    pixels: int,
    ink: QColor,
    weight: int = 400,
    turned: bool = False,
    halo: QColor | None = None,
) -> None:
    """A line of text centred on ``at`` (pixels); turned, it reads upwards; a halo keeps it legible."""
    width, height = text_size(text, pixels, weight)
    painter.save()
    painter.translate(*at)
    if turned:
        painter.rotate(-90)
    if halo is not None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(halo)
        painter.drawRoundedRect(QRectF(-width / 2 - 3, -height / 2, width + 6, height), 3, 3)
    painter.setFont(font(pixels, weight))
    painter.setPen(ink)
    painter.drawText(
        QRectF(-width / 2 - 2, -height / 2, width + 4, height), Qt.AlignmentFlag.AlignCenter, text
    )
    painter.restore()


def draw_chip(
    painter: QPainter,
    frame: Frame,
    text: str,
    at: tuple[float, float],
    pixels: int = BODY,
    strong: bool = True,
) -> QRectF:
    """Text on a rounded ground, centred on ``at`` (pixels), inside the pane; returns where it lies."""
    width, height = text_size(text, pixels, 500)
    w, h = width + 16, height + 7
    x = min(max(at[0] - w / 2, 6), max(frame.camera.width - w - 6, 6))
    y = min(max(at[1] - h / 2, 6), max(frame.camera.height - h - 6, 6))
    box = QRectF(x, y, w, h)
    ground, ink = (
        (frame.colours.tip, frame.colours.tip_text) if strong else (frame.colours.panel, frame.colours.muted)
    )
    painter.setPen(Qt.PenStyle.NoPen if strong else QPen(colour(frame.colours.line), 1))
    painter.setBrush(colour(ground, 0.94))
    painter.drawRoundedRect(box, 5, 5)
    painter.setPen(colour(ink))
    painter.setFont(font(pixels, 500))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
    return box


def round_length(metres: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above ``metres``."""
    power = 10.0 ** math.floor(math.log10(metres))
    return next(m * power for m in (5, 2, 1) if m * power <= metres * (1 + 1e-9))

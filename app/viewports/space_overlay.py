"""What is written on the 3D picture: names, axes, the scale of the grid, the ramp of heights, notes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QCoreApplication, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from floorcast_app import theme
from floorcast_app.format import area
from floorcast_app.rendering import ramps
from floorcast_app.rendering.camera import Camera, camera_of
from floorcast_app.rendering.cloud import Paint, facing_colours
from floorcast_app.rendering.scene import Label
from floorcast_app.rendering.shapes import grid_step
from floorcast_app.selection import Item
from floorcast_app.view_state import Look
from floorplan_core.model import Facing

MARGIN = 16.0  # pixels from the edges of the pane
NAME_SIZE, SMALL_SIZE = 12, 11  # pixels of text
AXIS_LENGTH = 26.0  # pixels
RAMP_WIDTH, RAMP_HEIGHT = 10.0, 112.0  # pixels
LOWEST_FOR_NAMES = 12.0  # degrees of elevation: seen from lower, names lie on top of each other
SMALLEST = 240  # pixels: in a smaller pane only names are written
FOOT = 0.3048  # metres


@dataclass(frozen=True)
class Overlay:
    """What there is to write."""

    look: Look
    labels: tuple[Label, ...] = ()
    selected: tuple[Item, ...] = ()
    hovered: Item | None = None
    paint: Paint | None = None  # of the points; None where none are shown
    message: str = ""  # in the middle of the pane
    grid: bool = True


def tr(text: str) -> str:
    """The text in the user's language."""
    return QCoreApplication.translate("SpaceView", text)


def draw_overlay(painter: QPainter, overlay: Overlay, width: int, height: int) -> None:
    """Write on a picture of ``width`` x ``height`` pixels."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    look = overlay.look
    camera = camera_of(look, width, height)
    if overlay.labels and abs(look.elevation) >= LOWEST_FOR_NAMES:
        _names(painter, overlay, camera)
    if min(width, height) >= SMALLEST:
        _axes(painter, camera, look)
        if overlay.grid:
            _scale(painter, look, width, height)
        if overlay.paint is not None:
            _legend(painter, overlay.paint, look, width, height)
            _note(painter, overlay.paint, look)
    if overlay.message:
        _message(painter, overlay.message, look, width, height)


def _names(painter: QPainter, overlay: Overlay, camera: Camera) -> None:
    """Names and areas on the floors; where two meet the selected, then the larger one is written."""
    lit = {*overlay.selected, overlay.hovered}
    order = sorted(overlay.labels, key=lambda label: (label.item not in lit, -label.area, label.text))
    places = camera.project(np.array([label.at for label in order]))
    taken: list[QRectF] = []
    for label, (x, y, _) in zip(order, places.tolist(), strict=True):
        if not (0 <= x <= camera.width and 0 <= y <= camera.height):
            continue
        rect = _name_rect(label, QPointF(x, y), overlay.look.units)
        if not any(rect.intersects(other) for other in taken):
            taken.append(rect)
            _name(painter, label, rect, overlay)


def _name_rect(label: Label, at: QPointF, units: str) -> QRectF:
    name = QFontMetricsF(theme.font(NAME_SIZE, 600)).horizontalAdvance(label.text)
    size = QFontMetricsF(theme.font(SMALL_SIZE)).horizontalAdvance(area(label.area, units))
    width, height = max(name, size) + 14, NAME_SIZE + SMALL_SIZE + 13.0
    return QRectF(at.x() - width / 2, at.y() - height / 2, width, height)


def _name(painter: QPainter, label: Label, rect: QRectF, overlay: Overlay) -> None:
    holds = theme.colours(overlay.look.theme)
    edge = holds.selection if label.item in overlay.selected else holds.line
    edge = holds.hover if label.item == overlay.hovered else edge
    painter.setPen(QPen(QColor(edge), 1.0))
    painter.setBrush(_faded(holds.panel, 0.86))
    painter.drawRoundedRect(rect, 6, 6)
    upper = QRectF(rect.left(), rect.top() + 3, rect.width(), NAME_SIZE + 5)
    lower = QRectF(rect.left(), upper.bottom(), rect.width(), SMALL_SIZE + 4)
    _text(painter, upper, label.text, holds.text, NAME_SIZE, 600)
    _text(painter, lower, area(label.area, overlay.look.units), holds.muted, SMALL_SIZE)


def _axes(painter: QPainter, camera: Camera, look: Look) -> None:
    """The three axes as they lie in the picture, those that point away first."""
    holds = theme.colours(look.theme)
    middle = QPointF(MARGIN + AXIS_LENGTH + 6, camera.height - MARGIN - AXIS_LENGTH - 6)
    axes = [("x", holds.plane_ew), ("y", holds.plane_ns), ("z", holds.accent)]
    order = sorted(range(3), key=lambda i: -camera.rotation[2, i])
    for i in order:
        name, colour = axes[i]
        tip = QPointF(camera.rotation[0, i], -camera.rotation[1, i]) * AXIS_LENGTH
        painter.setPen(QPen(QColor(colour), 2.0, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawLine(middle, middle + tip)
        if (
            abs(tip.x()) + abs(tip.y()) > 0.3 * AXIS_LENGTH
        ):  # an axis that points at us has no room for a name
            at = middle + tip * 1.32
            _text(painter, QRectF(at.x() - 8, at.y() - 8, 16, 16), name, colour, SMALL_SIZE, 600)


def _scale(painter: QPainter, look: Look, width: int, height: int) -> None:
    holds = theme.colours(look.theme)
    step = shown_grid_step(look)
    number = f"{step / FOOT:g} ft" if look.units == "ft-in" else f"{step:g} m"
    text = tr("Grid {step}").format(step=number)
    rect = QRectF(width - MARGIN - 140, height - MARGIN - 14, 140, 16)
    _text(painter, rect, text, holds.muted, SMALL_SIZE, flags=Qt.AlignmentFlag.AlignRight)


def shown_grid_step(look: Look) -> float:
    """Metres between the lines of the floor's grid: whole feet where lengths are shown in feet."""
    unit = FOOT if look.units == "ft-in" else 1.0
    return grid_step(look.span / unit) * unit


def _legend(painter: QPainter, paint: Paint, look: Look, width: int, height: int) -> None:
    """What the colours of the points mean, at the right."""
    if paint.heights is not None:
        _ramp(painter, paint.heights, look, width, height)
    elif look.point_colour == "facing":
        _facings(painter, look, width, height)


def _ramp(painter: QPainter, heights: tuple[float, float], look: Look, width: int, height: int) -> None:
    holds = theme.colours(look.theme)
    bar = QRectF(width - MARGIN - RAMP_WIDTH, height - MARGIN - 30 - RAMP_HEIGHT, RAMP_WIDTH, RAMP_HEIGHT)
    colours = ramps.height_ramp(look.theme)[::-1]
    painter.setPen(Qt.PenStyle.NoPen)
    for row in range(int(RAMP_HEIGHT)):
        painter.setBrush(QColor(int(colours[int(row * len(colours) / RAMP_HEIGHT)])))
        painter.drawRect(QRectF(bar.left(), bar.top() + row, RAMP_WIDTH, 1.2))
    unit, name = (FOOT, "ft") if look.units == "ft-in" else (1.0, "m")
    low, high = (round(value / unit, 1) + 0.0 for value in heights)
    for y, text in ((bar.top(), f"{high:.1f} {name}"), (bar.bottom() - 12, f"{low:.1f} {name}")):
        rect = QRectF(bar.left() - 68, y - 2, 62, 16)
        _text(painter, rect, text, holds.muted, SMALL_SIZE, flags=Qt.AlignmentFlag.AlignRight)


def _facings(painter: QPainter, look: Look, width: int, height: int) -> None:
    """Four swatches: the way the walls look."""
    holds, colours = theme.colours(look.theme), facing_colours(look.theme)
    names = {
        Facing.NORTH: tr("Faces north"),
        Facing.SOUTH: tr("Faces south"),
        Facing.EAST: tr("Faces east"),
        Facing.WEST: tr("Faces west"),
    }
    top = height - MARGIN - 34 - 18 * len(names)
    for row, (facing, text) in enumerate(names.items()):
        y = top + 18 * row
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(int(colours[facing])))
        painter.drawRoundedRect(QRectF(width - MARGIN - 12, y + 2, 12, 12), 3, 3)
        rect = QRectF(width - MARGIN - 140, y, 120, 16)
        _text(painter, rect, text, holds.muted, SMALL_SIZE, flags=Qt.AlignmentFlag.AlignRight)


def _note(painter: QPainter, paint: Paint, look: Look) -> None:
    """Why the points are not coloured as asked."""
    notes = {
        "rgb": tr("This survey holds no colour: points by height"),
        "intensity": tr("This survey holds no intensity: points by height"),
        "facing": tr("Facings are known once there is a plan: points by height"),
        "plane": tr("Planes are known once there is a plan: points by height"),
    }
    if paint.note:
        rect = QRectF(MARGIN, MARGIN - 4, 420, 18)
        holds = theme.colours(look.theme)
        _text(painter, rect, notes[paint.note], holds.muted, SMALL_SIZE, flags=Qt.AlignmentFlag.AlignLeft)


def _message(painter: QPainter, text: str, look: Look, width: int, height: int) -> None:
    rect = QRectF(MARGIN, height / 2 - 30, width - 2 * MARGIN, 60)
    flags = Qt.AlignmentFlag.AlignHCenter | Qt.TextFlag.TextWordWrap
    _text(painter, rect, text, theme.colours(look.theme).muted, 13, flags=flags)


def _text(
    painter: QPainter,
    rect: QRectF,
    text: str,
    colour: str,
    size: int,
    weight: int = 400,
    flags: int | Qt.AlignmentFlag = Qt.AlignmentFlag.AlignHCenter,
) -> None:
    painter.setFont(theme.font(size, weight))
    painter.setPen(QColor(colour))
    painter.drawText(rect, int(flags) | int(Qt.AlignmentFlag.AlignVCenter), text)


def _faded(colour: str, alpha: float) -> QColor:
    made = QColor(colour)
    made.setAlphaF(alpha)
    return made

"""What is written on the 3D picture: names, axes, the scale of the grid, the ramp of heights, notes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QLinearGradient, QPainter, QPen

from floorcast_app import theme
from floorcast_app.format import area
from floorcast_app.format import number as _number
from floorcast_app.rendering import ramps
from floorcast_app.rendering.camera import Camera, camera_of
from floorcast_app.rendering.cloud import Paint, facing_colours
from floorcast_app.rendering.scene import Label
from floorcast_app.rendering.shapes import grid_step
from floorcast_app.selection import Item
from floorcast_app.translation import tr
from floorcast_app.view_state import Look
from floorplan_core.model import Facing

MARGIN = 16.0  # pixels from the edges of the pane
NAME_SIZE, SMALL_SIZE = 12, 11  # pixels of text
AXIS_LENGTH = 26.0  # pixels
RAMP_WIDTH, RAMP_HEIGHT = 10.0, 112.0  # pixels
LOWEST_FOR_NAMES = 12.0  # degrees of elevation: seen from lower, names lie on top of each other
PLATE = 0.86  # opacity of what text stands on
ROOM_SHARE = 0.9  # of a region's width in the picture that its name may take
ROOMY = 440  # pixels: in a smaller pane the ornaments shrink
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


def draw_overlay(painter: QPainter, overlay: Overlay, width: int, height: int) -> None:
    """Write on a picture of ``width`` x ``height`` pixels."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    look = overlay.look
    camera = camera_of(look, width, height)
    if overlay.labels and abs(look.elevation) >= LOWEST_FOR_NAMES:
        _names(painter, overlay, camera)
    if min(width, height) >= SMALLEST:
        _axes(painter, camera, look)
        _legend(painter, overlay, width, height)
        if overlay.paint is not None:
            _note(painter, overlay.paint, look)
    if overlay.message:
        draw_message(painter, overlay.message, look, width, height)


def _names(painter: QPainter, overlay: Overlay, camera: Camera) -> None:
    """Names and areas on the floors; where two meet the selected, then the larger one is written."""
    lit = {*overlay.selected, overlay.hovered}
    order = sorted(overlay.labels, key=lambda label: (label.item not in lit, -label.area, label.text))
    places = camera.project(np.array([label.at for label in order]))
    taken: list[QRectF] = []
    for label, (x, y, depth) in zip(order, places.tolist(), strict=True):
        if not (0 <= x <= camera.width and 0 <= y <= camera.height):
            continue
        room = label.width * camera.focal / depth  # pixels across the region
        lines = _lines_of(label, overlay.look.units, math.inf if label.item in lit else room)
        if not lines:
            continue
        rect = _name_rect(lines, QPointF(x, y))
        if not any(rect.intersects(other) for other in taken):
            taken.append(rect)
            _name(painter, lines, rect, label.item, overlay)


def _lines_of(label: Label, units: str, room: float) -> tuple[str, ...]:
    """Name and area, the name alone, or nothing: what fits into ``room`` pixels."""
    lines = (label.text, area(label.area, units))
    while lines and _name_rect(lines, QPointF()).width() > ROOM_SHARE * room:
        lines = lines[:-1]
    return lines


def _name_rect(lines: tuple[str, ...], at: QPointF) -> QRectF:
    """Around the name in the first line and what follows in smaller ones."""
    widths = [
        _width(text, *font) for font, text in zip(((NAME_SIZE, 600), (SMALL_SIZE, 400)), lines, strict=False)
    ]
    width, height = max([*widths, 8.0]) + 12, NAME_SIZE + 8.0 + (SMALL_SIZE + 4.0) * (len(lines) - 1)
    return QRectF(at.x() - width / 2, at.y() - height / 2, width, height)


@lru_cache(maxsize=1 << 14)
def _width(text: str, pixels: int, weight: int) -> float:
    """Pixels that ``text`` takes. Of hundreds of regions it is asked in every frame."""
    return QFontMetricsF(theme.font(pixels, weight)).horizontalAdvance(text)


def _name(painter: QPainter, lines: tuple[str, ...], rect: QRectF, item: Item, overlay: Overlay) -> None:
    holds = theme.colours(overlay.look.theme)
    edge = holds.hover if item == overlay.hovered else holds.line
    _plate(painter, rect, holds, holds.selection if item in overlay.selected else edge)
    upper = QRectF(rect.left(), rect.top() + 2, rect.width(), NAME_SIZE + 5)
    _text(painter, upper, lines[0], holds.text, NAME_SIZE, 600)
    for text in lines[1:]:
        lower = QRectF(rect.left(), upper.bottom(), rect.width(), SMALL_SIZE + 4)
        _text(painter, lower, text, holds.muted, SMALL_SIZE)


def _plate(painter: QPainter, rect: QRectF, holds: theme.Colours, edge: str) -> None:
    """What text stands on, so that it can be read over points."""
    painter.setPen(QPen(QColor(edge), 1.0))
    painter.setBrush(_faded(holds.panel, PLATE))
    painter.drawRoundedRect(rect, 6, 6)


def _axes(painter: QPainter, camera: Camera, look: Look) -> None:
    """The three axes as they lie in the picture, those that point away first."""
    holds = theme.colours(look.theme)
    length = AXIS_LENGTH * _small(camera.width, camera.height)
    around = length + 14 * _small(camera.width, camera.height)
    middle = QPointF(MARGIN + around, camera.height - MARGIN - around)
    painter.setPen(QPen(QColor(holds.line), 1.0))
    painter.setBrush(_faded(holds.panel, PLATE))
    painter.drawEllipse(middle, around, around)
    axes = [("x", holds.plane_ew), ("y", holds.plane_ns), ("z", holds.accent)]
    order = sorted(range(3), key=lambda i: -camera.rotation[2, i])
    for i in order:
        name, colour = axes[i]
        tip = QPointF(camera.rotation[0, i], -camera.rotation[1, i]) * length
        painter.setPen(QPen(QColor(colour), 2.0, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawLine(middle, middle + tip)
        if abs(tip.x()) + abs(tip.y()) > 0.3 * length:  # an axis that points at us has no room for a name
            at = middle + tip * 1.32
            _text(painter, QRectF(at.x() - 8, at.y() - 8, 16, 16), name, colour, SMALL_SIZE, 600)


def shown_grid_step(look: Look) -> float:
    """Metres between the lines of the floor's grid: whole feet where lengths are shown in feet."""
    unit = FOOT if look.units == "ft-in" else 1.0
    return grid_step(look.span / unit) * unit


def _legend(painter: QPainter, overlay: Overlay, width: int, height: int) -> None:
    """What the colours of the points mean, and the grid's step, on a plate at the right."""
    look, paint = overlay.look, overlay.paint
    holds = theme.colours(look.theme)
    ramp = paint is not None and paint.heights is not None
    facings = paint is not None and not ramp and look.point_colour == "facing"
    ramp_height = RAMP_HEIGHT * _small(width, height)
    grid = QFontMetricsF(theme.font(SMALL_SIZE)).horizontalAdvance(_grid_text(look)) + 22
    wide = max(108.0 if facings else 84.0, grid if overlay.grid else 0.0)
    tall = (
        (26.0 if overlay.grid else 8.0) + (ramp_height + 12 if ramp else 0) + (18.0 * 4 + 4 if facings else 0)
    )
    if not (overlay.grid or ramp or facings):
        return
    plate = QRectF(width - MARGIN - wide, height - MARGIN - tall, wide, tall)
    _plate(painter, plate, holds, holds.line)
    if ramp and paint is not None and paint.heights is not None:
        _ramp(painter, paint.heights, look, plate, ramp_height)
    if facings:
        _facings(painter, look, plate)
    if overlay.grid:
        rect = QRectF(plate.left() + 10, plate.bottom() - 22, wide - 20, 18)
        _text(painter, rect, _grid_text(look), holds.muted, SMALL_SIZE, flags=Qt.AlignmentFlag.AlignLeft)


def _small(width: int, height: int) -> float:
    """The share of their size that ornaments have in a small pane."""
    return min(max(min(width, height) / ROOMY, 0.5), 1.0)


def _grid_text(look: Look) -> str:
    step = shown_grid_step(look)
    number = f"{_number(step / FOOT, 'g')} ft" if look.units == "ft-in" else f"{_number(step, 'g')} m"
    return tr("Grid {step}").format(step=number)


def _ramp(painter: QPainter, heights: tuple[float, float], look: Look, plate: QRectF, tall: float) -> None:
    holds = theme.colours(look.theme)
    bar = QRectF(plate.left() + 10, plate.top() + 10, RAMP_WIDTH, tall)
    gradient = QLinearGradient(bar.topLeft(), bar.bottomLeft())
    colours = ramps.height_ramp(look.theme)[::-1]
    for share in np.linspace(0.0, 1.0, 17).tolist():
        gradient.setColorAt(share, QColor(int(colours[round(share * (len(colours) - 1))])))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(gradient)
    painter.drawRoundedRect(bar, 2, 2)
    unit, name = (FOOT, "ft") if look.units == "ft-in" else (1.0, "m")
    low, high = (round(value / unit, 1) + 0.0 for value in heights)
    for y, text in (
        (bar.top() - 2, f"{_number(high, '.1f')} {name}"),
        (bar.bottom() - 14, f"{_number(low, '.1f')} {name}"),
    ):
        rect = QRectF(bar.right() + 8, y, 48, 16)
        _text(painter, rect, text, holds.muted, SMALL_SIZE, flags=Qt.AlignmentFlag.AlignLeft)


def _facings(painter: QPainter, look: Look, plate: QRectF) -> None:
    """Four swatches: the way the walls look."""
    holds, colours = theme.colours(look.theme), facing_colours(look.theme)
    names = {
        Facing.NORTH: tr("Faces north"),
        Facing.SOUTH: tr("Faces south"),
        Facing.EAST: tr("Faces east"),
        Facing.WEST: tr("Faces west"),
    }
    for row, (facing, text) in enumerate(names.items()):
        y = plate.top() + 6 + 18 * row
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(int(colours[facing])))
        painter.drawRoundedRect(QRectF(plate.left() + 10, y + 3, 10, 10), 3, 3)
        rect = QRectF(plate.left() + 28, y, plate.width() - 30, 16)
        _text(painter, rect, text, holds.muted, SMALL_SIZE, flags=Qt.AlignmentFlag.AlignLeft)


def _note(painter: QPainter, paint: Paint, look: Look) -> None:
    """Why the points are not coloured as asked."""
    notes = {
        "rgb": tr("This survey holds no colour: points by height"),
        "intensity": tr("This survey holds no intensity: points by height"),
        "facing": tr("Facings are known once there is a plan: points by height"),
        "plane": tr("Planes are known once there is a plan: points by height"),
    }
    if paint.note:
        holds = theme.colours(look.theme)
        wide = QFontMetricsF(theme.font(SMALL_SIZE)).horizontalAdvance(notes[paint.note])
        rect = QRectF(MARGIN, MARGIN, wide + 2, 22)
        _plate(painter, rect.adjusted(-8, 0, 8, 0), holds, holds.line)
        _text(painter, rect, notes[paint.note], holds.muted, SMALL_SIZE, flags=Qt.AlignmentFlag.AlignLeft)


def draw_message(painter: QPainter, text: str, look: Look, width: int, height: int) -> None:
    """A sentence in the middle of a pane that has nothing else to show."""
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

"""What lies over the layers of a plan pane: lit-up things, measurements, marks of the tool, scale, north."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPixmap, QPolygonF

from floorcast_app import format
from floorcast_app.layers.item_shapes import ItemShape, anchor, item_shape
from floorcast_app.layers.source import PlanSource
from floorcast_app.selection import Item
from floorcast_app.tools.gestures import Mark, Point
from floorcast_app.viewports.plan_camera import Camera
from floorcast_app.viewports.plan_frame import (
    BODY,
    NAME,
    SMALL,
    Frame,
    colour,
    draw_chip,
    draw_text,
    font,
    lines_path,
    path_of,
    pen,
    plan_pen,
    text_size,
)
from floorcast_app.viewports.plan_observed_views import across
from floorcast_app.viewports.plan_scale import MARGIN, bar_length
from floorplan_core.model.layout import turned

COMPASS = 15.0  # pixels, radius
CROSS = 9.0  # pixels, half the linked cursor
PLACES = (0.5, 0.3, 0.7, 0.2, 0.8, 0.12, 0.88)  # along a measurement: where its length is written
PIN = 5.0  # pixels, radius of a pin's head
TICK = 5.0
GRIPPED = 24.0  # pixels that a thing needs for handles at its ends
CARD, CARD_AIR = 440.0, 16.0  # pixels: width of a card at most, and the air in it and around it


def paint_card(painter: QPainter, frame: Frame, heading: str, text: str) -> None:
    """A sentence of any length under its heading, on a card in the middle of the pane."""
    width = min(CARD, frame.camera.width - 2 * CARD_AIR)
    wrapped = Qt.AlignmentFlag.AlignLeft | Qt.TextFlag.TextWordWrap
    inner = QRectF(0, 0, width - 2 * CARD_AIR, frame.camera.height)
    head, body = (
        QFontMetricsF(face).boundingRect(inner, int(wrapped), words).height()
        for face, words in ((font(NAME, 600), heading), (font(BODY), text))
    )
    card = QRectF(0, 0, width, head + body + 2.5 * CARD_AIR)
    card.moveCenter(QPointF(*frame.camera.middle))
    painter.setPen(pen(frame.colours.line))
    painter.setBrush(colour(frame.colours.panel))
    painter.drawRoundedRect(card, 6, 6)
    inner = card.adjusted(CARD_AIR, CARD_AIR, -CARD_AIR, -CARD_AIR)
    painter.setPen(colour(frame.colours.error))
    painter.setFont(font(NAME, 600))
    painter.drawText(inner, wrapped, heading)
    painter.setPen(colour(frame.colours.text))
    painter.setFont(font(BODY))
    painter.drawText(inner.adjusted(0, head + CARD_AIR / 2, 0, 0), wrapped, text)


def paint_item(painter: QPainter, frame: Frame, source: PlanSource, item: Item, selected: bool) -> None:
    """Light up a selected thing, or the one under the pointer."""
    shape = item_shape(source, item)
    name = frame.colours.selection if selected else frame.colours.hover
    if shape.infinite is not None:
        painter.setPen(pen(name, 1.2, 0.9, (6.0, 4.0)))
        painter.drawLine(*across(frame, *shape.infinite))
    painter.save()
    painter.setTransform(frame.transform(), True)
    _fill(painter, shape, name, 0.22 if selected else 0.14)
    painter.setPen(plan_pen(frame, name, 2.4 if selected else 1.8))
    painter.drawPath(path_of(shape.areas))
    if shape.infinite is not None or not shape.areas:
        painter.setPen(plan_pen(frame, name, 4.0 if selected else 3.0))
        painter.drawPath(lines_path(shape.lines))
    painter.restore()


def _fill(painter: QPainter, shape: ItemShape, name: str, alpha: float) -> None:
    if shape.areas:
        painter.fillPath(path_of(shape.areas), colour(name, alpha))


def draw_shifted(painter: QPainter, frame: Frame, picture: QPixmap, taken: Camera) -> None:
    """A picture that another camera took, where the frame's camera has it."""
    corners = ((0.0, 0.0), (taken.width, taken.height))
    (x0, y0), (x1, y1) = (frame.camera.point(*taken.to_plan(*c)) for c in corners)
    painter.drawPixmap(QRectF(x0, y0, x1 - x0, y1 - y0), picture, QRectF(picture.rect()))


def paint_check(
    painter: QPainter,
    frame: Frame,
    ends: tuple[Point, Point],
    metres: float,
    tone: str,
    taken: Sequence[QRectF] = (),
    always: bool = True,
) -> QRectF | None:
    """A measurement: a line with ticks and its length, beside what is ``taken`` where the line is long.

    :param always: with the length even where it hides something.
    :returns: where the length is written, pixels; None where it is not.
    """
    a, b = (QPointF(*frame.camera.point(*end)) for end in ends)
    painter.setPen(pen(tone, 1.6))
    painter.drawLine(a, b)
    angle = math.atan2(b.y() - a.y(), b.x() - a.x())
    across_ = QPointF(-math.sin(angle) * TICK, math.cos(angle) * TICK)
    for end in (a, b):
        painter.drawLine(end - across_, end + across_)
    length = math.hypot(b.x() - a.x(), b.y() - a.y())
    if length <= 2 * TICK:
        return None
    text = format.length(metres, frame.look.units)
    wide = text_size(text, SMALL, 600)[0] + 4 * TICK
    raised = 3 * TICK if length < wide else 0.0
    box = _free_place(a, b, wide, raised, taken, always)
    if box is not None:
        at = box.center().x(), box.center().y()
        draw_text(painter, text, at, SMALL, colour(tone), 600, False, colour(frame.colours.panel, 0.92))
    return box


def _free_place(
    a: QPointF, b: QPointF, wide: float, raised: float, taken: Sequence[QRectF], always: bool
) -> QRectF | None:
    """The place on or above the line a-b, near its middle, where a text of this width hides nothing.

    Where there is none: the middle, or no place at all.
    """
    points = [a + (b - a) * share for share in PLACES]
    lifts = (raised, -raised) if raised else (0.0,)
    boxes = [
        QRectF(p.x() - wide / 2, p.y() - lift - 2 * TICK, wide, 4 * TICK) for lift in lifts for p in points
    ]
    free = (box for box in boxes if not any(box.intersects(t) for t in taken))
    return next(free, boxes[0] if always else None)


def paint_pins(
    painter: QPainter, frame: Frame, source: PlanSource, items: tuple[Item, ...], names: dict[str, QRectF]
) -> None:
    """A pin on everything that a person corrected; that of a region stands on its name, others off names."""
    for item in items:
        if item.kind == "region" and item.id in names:
            x, y = names[item.id].center().x(), names[item.id].top() - 1
        elif (at := anchor(source, item)) is not None:
            x, y = _pin_place(frame, item_shape(source, item).bounds or (*at, *at), tuple(names.values()))
        else:
            continue
        painter.setPen(pen(frame.colours.accent, 1.6))
        painter.drawLine(QPointF(x, y), QPointF(x, y - 2 * PIN))
        painter.setPen(pen(frame.colours.panel, 1.4))
        painter.setBrush(colour(frame.colours.accent))
        painter.drawEllipse(QPointF(x, y - 2 * PIN), PIN, PIN)
        painter.setBrush(colour(frame.colours.panel))
        painter.drawEllipse(QPointF(x, y - 2 * PIN), PIN / 4, PIN / 4)


def _pin_place(frame: Frame, bounds: tuple[float, float, float, float], names: Sequence[QRectF]) -> Point:
    """The foot of a pin (pixels) along a wall or door, near its middle, where it hides no name if it can."""
    (x0, y0), (x1, y1) = frame.camera.point(*bounds[:2]), frame.camera.point(*bounds[2:])
    feet = [(x0 + share * (x1 - x0), y0 + share * (y1 - y0)) for share in PLACES]
    free = (
        (x, y)
        for x, y in feet
        if not any(QRectF(x - PIN, y - 3 * PIN, 2 * PIN, 3 * PIN).intersects(name) for name in names)
    )
    return next(free, feet[0])


def paint_marks(painter: QPainter, frame: Frame, marks: tuple[Mark, ...]) -> None:
    """What the tool in hand wants drawn."""
    for mark in marks:
        _MARKS[mark.kind](painter, frame, mark)


def paint_cross(painter: QPainter, frame: Frame, at: Point) -> None:
    """Where the pointer is in another pane."""
    x, y = frame.camera.point(*at)
    painter.setPen(pen(frame.colours.accent, 1.2, 0.9))
    for dx, dy in ((1, 0), (0, 1)):
        for sign in (-1, 1):
            near, far = 3 * sign, CROSS * sign
            painter.drawLine(QPointF(x + near * dx, y + near * dy), QPointF(x + far * dx, y + far * dy))


def paint_compass(painter: QPainter, frame: Frame, source: PlanSource) -> None:
    """Which way the survey's +y (its north) lies, at the upper right."""
    north = source.plan.frame.rotation @ np.array([0.0, 1.0, 0.0])
    angle = math.degrees(math.atan2(north[0], north[1]))
    painter.save()
    painter.translate(frame.camera.width - MARGIN - COMPASS, MARGIN + COMPASS)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour(frame.colours.panel, 0.82))
    painter.drawEllipse(QPointF(0, 0), COMPASS + 5, COMPASS + 5)
    painter.rotate(angle)
    for side, alpha in ((-1, 1.0), (1, 0.35)):
        half = QPolygonF([QPointF(0, -COMPASS), QPointF(side * 6, 5), QPointF(0, 1)])
        painter.setBrush(colour(frame.colours.text, alpha))
        painter.drawPolygon(half)
    painter.translate(0, COMPASS - 5)
    painter.rotate(-angle)
    draw_text(painter, "N", (0, 0), 10, colour(frame.colours.text), 600)
    painter.restore()


def paint_hint(painter: QPainter, frame: Frame, text: str) -> None:
    """What the tool in hand expects, at the lower middle, above the scale bar where they would meet."""
    middle, half = frame.camera.width / 2, text_size(text, SMALL, 500)[0] / 2 + 8
    raised = 40 if middle - half < MARGIN + bar_length(frame)[1] + 14 else 0
    draw_chip(painter, frame, text, (middle, frame.camera.height - 22 - raised), SMALL, strong=False)


# ---- marks ----------------------------------------------------------------------------------------------


def _role(frame: Frame, mark: Mark) -> str:
    return str(getattr(frame.colours, mark.role))


def _line(painter: QPainter, frame: Frame, mark: Mark) -> None:
    """A line, dashed where it is only an idea."""
    a, b = (QPointF(*frame.camera.point(*p)) for p in mark.points)
    painter.setPen(pen(frame.colours.panel, 5.0, 0.7))
    painter.drawLine(a, b)
    painter.setPen(pen(_role(frame, mark), 2.4, 1.0, (7.0, 5.0) if mark.kind == "dashes" else None))
    painter.drawLine(a, b)


def _plane(painter: QPainter, frame: Frame, mark: Mark) -> None:
    """All across the pane."""
    painter.setPen(pen(_role(frame, mark), 1.8))
    offset = turned(np.array(mark.points[:1]), -mark.turn)[0, mark.axis]
    painter.drawLine(*across(frame, mark.axis, float(offset), mark.turn))


def _area(painter: QPainter, frame: Frame, mark: Mark) -> None:
    """A polygon with dots at its corners."""
    points = [QPointF(*frame.camera.point(*p)) for p in mark.points]
    painter.setPen(pen(_role(frame, mark), 1.8))
    painter.setBrush(colour(_role(frame, mark), 0.15))
    painter.drawPolygon(QPolygonF(points))
    painter.setBrush(colour(_role(frame, mark)))
    for point in points:
        painter.drawEllipse(point, 3, 3)


def _dot(painter: QPainter, frame: Frame, mark: Mark) -> None:
    """A handle."""
    painter.setPen(pen(_role(frame, mark), 1.8))
    painter.setBrush(colour(frame.colours.panel))
    painter.drawEllipse(QPointF(*frame.camera.point(*mark.points[0])), 4.5, 4.5)


def _grips(painter: QPainter, frame: Frame, mark: Mark) -> None:
    """Handles at both ends, where they do not hide what they are on."""
    a, b = mark.points
    if math.dist(a, b) * frame.camera.scale >= GRIPPED:
        for end in mark.points:
            _dot(painter, frame, Mark("dot", (end,), mark.role))


def _snap(painter: QPainter, frame: Frame, mark: Mark) -> None:
    """A square: the click will be exact."""
    x, y = frame.camera.point(*mark.points[0])
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(pen(frame.colours.panel, 4.0, 0.8))
    painter.drawRect(QRectF(x - 5, y - 5, 10, 10))
    painter.setPen(pen(_role(frame, mark), 1.8))
    painter.drawRect(QRectF(x - 5, y - 5, 10, 10))


def _text(painter: QPainter, frame: Frame, mark: Mark) -> None:
    """Beside the point, so that the pointer does not hide it."""
    x, y = frame.camera.point(*mark.points[-1])
    draw_chip(painter, frame, mark.text, (x, y - 26))


_MARKS = {
    "line": _line,
    "dashes": _line,
    "plane": _plane,
    "area": _area,
    "dot": _dot,
    "grips": _grips,
    "snap": _snap,
    "text": _text,
}

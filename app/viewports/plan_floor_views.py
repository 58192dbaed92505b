"""How regions, walls, doors and dimensions are painted: the floor plan of the pane."""

from __future__ import annotations

import math

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath

from floorcast_app import format
from floorcast_app.layers.dimensions import ROWS, DimensionsLayer, Row, Width, row_gap
from floorcast_app.layers.label_spots import Spot
from floorcast_app.layers.regions import RegionShape, RegionsLayer
from floorcast_app.layers.walls import DoorShape, DoorsLayer, WallsLayer
from floorcast_app.translation import tr_text
from floorcast_app.viewports.plan_frame import (
    BODY,
    NAME,
    SMALL,
    Frame,
    colour,
    draw_text,
    hatch,
    lines_path,
    path_of,
    pen,
    plan_pen,
    text_size,
)
from floorplan_core.drawing_style import NEARLY
from floorplan_core.exporters.dimensions import Span
from floorplan_core.exporters.door_symbols import Leaf

LEADING = 1.3  # line height over text size
TICK = 4.0  # pixels, half a tick
STUB = 8.0  # pixels of extension line
RAISE = 9.0  # pixels from a dimension's line to the middle of its text
AIR = 6.0  # pixels that text leaves at both ends
GUESSED = (6.0, 4.0)


class RegionsView:
    """Floors, predicted parts hatched."""

    def __init__(self, model: RegionsLayer) -> None:
        self._shapes = [
            (s, path_of(s.floor), path_of(s.predicted), lines_path(s.guessed)) for s in model.shapes
        ]

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """The floors; what nobody saw is paler and hatched, what closes it dashed."""
        painter.setTransform(frame.transform(), True)
        for shape, floor, predicted, guessed in self._shapes:
            if not frame.shows("region", shape.item.id):
                continue
            tone = frame.colours.region(shape.label)
            painter.fillPath(floor, colour(tone))
            painter.fillPath(predicted, colour(frame.colours.canvas, 0.6))
            painter.fillPath(predicted, hatch(frame, _accent(frame, tone), 0.55))
            painter.setPen(plan_pen(frame, frame.colours.muted, 1.6, 1.0, GUESSED))
            painter.drawPath(guessed)


class NamesView:
    """Names and areas of the regions, as much as fits at this zoom."""

    def __init__(self, model: RegionsLayer) -> None:
        self._shapes = model.shapes

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Name, area and clear size, one under the other."""
        for shape in self._shapes:
            if frame.shows("region", shape.item.id):
                self._paint(painter, frame, shape)

    def blocks(self, frame: Frame) -> dict[str, QRectF]:
        """The ground of each name in pixels, by region; none for a region without one."""
        made = {}
        for shape in self._shapes:
            lines, spot = fitting_lines(frame, shape)
            if lines and frame.shows("region", shape.item.id):
                size = max(text_size(*line)[0] for line in lines), sum(p * LEADING for _, p, _ in lines)
                wide, tall = size[::-1] if spot.turned else size
                x, y = frame.camera.point(spot.x, spot.y)
                made[shape.item.id] = QRectF(x - wide / 2, y - tall / 2, wide, tall)
        return made

    def _paint(self, painter: QPainter, frame: Frame, shape: RegionShape) -> None:
        lines, spot = fitting_lines(frame, shape)
        # Text on hatching gets ground of its own.
        halo = colour(frame.colours.region(shape.label), 0.8) if shape.predicted else None
        total = sum(pixels * LEADING for _, pixels, _ in lines)
        x, y = frame.camera.point(spot.x, spot.y)
        down = -total / 2
        for text, pixels, weight in lines:
            middle = down + pixels * LEADING / 2
            at = (x + middle, y) if spot.turned else (x, y + middle)
            ink = frame.colours.text if weight > 400 or pixels > SMALL else frame.colours.muted
            draw_text(painter, text, at, pixels, colour(ink), weight, spot.turned, halo)
            down += pixels * LEADING


class WallsView:
    """Solid walls; those that only close a region are hatched and dashed."""

    def __init__(self, model: WallsLayer) -> None:
        self._observed, self._guessed = path_of(model.observed), path_of(model.guessed)

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """The poché."""
        wall = frame.colours.wall
        painter.setTransform(frame.transform(), True)
        painter.fillPath(self._guessed, colour(frame.colours.canvas))
        painter.fillPath(self._guessed, hatch(frame, wall, 0.6, 5, falling=True))
        painter.setPen(plan_pen(frame, wall, 1.0, 0.9, (4.0, 3.0)))
        painter.drawPath(self._guessed)
        painter.setPen(plan_pen(frame, wall, 1.0))
        painter.setBrush(colour(wall))
        painter.drawPath(self._observed)


class DoorsView:
    """Openings in yellow, with swings."""

    def __init__(self, model: DoorsLayer) -> None:
        self._shapes = [(s, _leaves_path(s.leaves), _swing_path(s.leaves)) for s in model.shapes]

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """A yellow threshold, the leaf, its arc; dashed faces where there is no leaf."""
        ink = _accent(frame, frame.colours.door)
        painter.setTransform(frame.transform(), True)
        for shape, leaf, swing in self._shapes:
            if not frame.shows("door", shape.item.id):
                continue
            painter.fillPath(_opening(shape), colour(frame.colours.door))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            dashes = None if shape.sure and shape.leaves else (4.0, 3.0)
            painter.setPen(plan_pen(frame, ink, 1.1, 1.0, dashes))
            painter.drawPath(_faces(shape))
            painter.setPen(plan_pen(frame, ink, 1.0))
            painter.drawPath(swing)
            painter.setPen(plan_pen(frame, ink, 2.0))
            painter.drawPath(leaf)


class DimensionsView:
    """Rows of lengths beside the plan at a constant distance in pixels, and the widths of arms."""

    def __init__(self, model: DimensionsLayer) -> None:
        self.model = model

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """What has no room for its number is left out."""
        for row in self.model.rows:
            gap = row_gap(row.level, min(frame.camera.width, frame.camera.height))
            for span in row.spans if gap is not None else ():
                _paint_span(painter, frame, row, gap or 0.0, span)
        for width in self.model.widths:
            _paint_width(painter, frame, width)


def fitting_lines(frame: Frame, shape: RegionShape) -> tuple[list[tuple[str, int, int]], Spot]:
    """(text, pixels, weight) of the lines that have room, else of the number, else none; and where.

    A name that is made of a number comes with the area or not at all: the number says as much alone, and the
    rooms of a small pane look alike.
    """
    units, scale = frame.look.units, frame.camera.scale
    room, height = shape.seat.width * scale, shape.spot.height * scale
    if height < NAME * LEADING and room < SMALL:  # as most rooms of a site seen whole: nothing is measured
        return [], shape.seat
    lines = [(tr_text(shape.name), NAME, 600), (format.area(shape.area, units), BODY, 400)]
    if shape.clear is not None:
        pair = zip(shape.clear, shape.nearly, strict=True)
        lines.append((" × ".join(written(v, units, nearly) for v, nearly in pair), SMALL, 400))
    width = shape.spot.width * scale
    least = 2 if shape.short.isdecimal() else 1
    for n in range(len(lines), least - 1, -1):
        wide = max(text_size(*line)[0] for line in lines[:n])
        if wide + AIR <= width and sum(p * LEADING for _, p, _ in lines[:n]) <= height:
            return lines[:n], shape.spot
    for pixels in (BODY, SMALL):
        short = (shape.short, pixels, 600)
        if text_size(*short)[0] <= room and pixels <= room:
            return [short], shape.seat
    return [], shape.seat


def _accent(frame: Frame, tone: str) -> str:
    """A darker version of a fill that reads on it; a lighter one in dark themes."""
    made = QColor(tone)
    h, s, lightness, _ = made.getHslF()
    dark = QColor(frame.colours.canvas).lightnessF() < 0.5
    value = min(lightness + 0.25, 0.9) if dark else lightness * 0.5
    return QColor.fromHslF(max(h, 0.0), min(s * 1.1, 1.0), value).name()


def _opening(shape: DoorShape) -> QPainterPath:
    """The ground between the two faces."""
    (a, b), (d, c) = shape.faces.tolist()
    path = QPainterPath()
    path.moveTo(*a)
    for corner in (b, c, d):
        path.lineTo(*corner)
    path.closeSubpath()
    return path


def _faces(shape: DoorShape) -> QPainterPath:
    """The two faces of the wall across an opening."""
    ends = shape.faces.reshape(2, 4).tolist()
    path = QPainterPath()
    for a, b, c, d in ends:
        path.moveTo(a, b)
        path.lineTo(c, d)
    return path


def _leaves_path(leaves: tuple[Leaf, ...]) -> QPainterPath:
    path = QPainterPath()
    for leaf in leaves:
        path.moveTo(*leaf.hinge.tolist())
        path.lineTo(*leaf.tip.tolist())
    return path


def _swing_path(leaves: tuple[Leaf, ...]) -> QPainterPath:
    """The arc that the free end of each leaf draws."""
    path = QPainterPath()
    for leaf in leaves:
        (x, y), u, v = leaf.hinge.tolist(), leaf.tip - leaf.hinge, leaf.closed - leaf.hinge
        radius = float(math.hypot(*u))
        start = math.degrees(math.atan2(-u[1], u[0]))
        turn = math.degrees(math.atan2(u[0] * v[1] - u[1] * v[0], float(u @ v)))
        box = QRectF(x - radius, y - radius, 2 * radius, 2 * radius)
        path.arcMoveTo(box, start)
        path.arcTo(box, start, -turn)
    return path


def written(metres: float, units: str, nearly: bool = False) -> str:
    """A length at a dimension line, its metres understood; one to a guessed wall is only ``nearly`` so."""
    return (NEARLY if nearly else "") + format.length(metres, units).removesuffix(" m")


def _paint_span(painter: QPainter, frame: Frame, row: Row, gap: float, span: Span) -> None:
    """One length of a row."""
    start, end = span.start, span.end
    text = written(span.length, frame.look.units, span.guessed)
    room = (end - start) * frame.camera.scale
    if text_size(text, SMALL)[0] + AIR > room:
        return
    a, b = (_beside(frame, row, gap, v) for v in (start, end))
    painter.setPen(pen(frame.colours.muted, 1.0))
    painter.drawLine(QPointF(*a), QPointF(*b))
    out = (0.0, float(-row.sign)) if row.axis else (float(row.sign), 0.0)
    for x, y in (a, b):
        painter.setPen(pen(frame.colours.line_strong, 1.0))
        stub = QPointF(x - STUB * out[0], y - STUB * out[1]), QPointF(x + TICK * out[0], y + TICK * out[1])
        painter.drawLine(*stub)
        _tick(painter, frame, x, y)
    x, y = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
    inwards = -row.sign if row.axis else row.sign  # text above or left of a line may lie towards the walls
    away = RAISE if inwards > 0 and gap < ROWS[1] else -RAISE  # where that is tight, it lies outside
    at = (x, y + away) if row.axis else (x + away, y)
    draw_text(painter, text, at, SMALL, colour(frame.colours.text), 400, not row.axis)


def _beside(frame: Frame, row: Row, gap: float, along: float) -> tuple[float, float]:
    """The place of a coordinate along a row, pixels."""
    if row.axis:
        x, y = frame.camera.point(along, row.edge)
        return x, y - row.sign * gap
    x, y = frame.camera.point(row.edge, along)
    return x + row.sign * gap, y


def _paint_width(painter: QPainter, frame: Frame, width: Width) -> None:
    """The clear width of an arm, from wall to wall."""
    text = written(width.length, frame.look.units, width.guessed)
    if text_size(text, SMALL)[0] + 2 * AIR > width.length * frame.camera.scale:
        return
    a, b = frame.camera.point(*width.start), frame.camera.point(*width.end)
    painter.setPen(pen(frame.colours.muted, 1.0))
    painter.drawLine(QPointF(*a), QPointF(*b))
    for x, y in (a, b):
        _tick(painter, frame, x, y)
    level = abs(a[1] - b[1]) < 1
    x, y = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
    at = (x, y - RAISE) if level else (x - RAISE, y)
    draw_text(painter, text, at, SMALL, colour(frame.colours.text), 400, not level)


def _tick(painter: QPainter, frame: Frame, x: float, y: float) -> None:
    painter.setPen(pen(frame.colours.text, 1.3))
    painter.drawLine(QPointF(x - TICK, y + TICK), QPointF(x + TICK, y - TICK))

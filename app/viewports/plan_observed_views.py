"""How observed points, the path, planes and free space are painted."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRect, Qt
from PySide6.QtGui import QBrush, QColor, QImage, QPainter, QPolygonF, QTransform

from floorcast_app.layers.free_space import PREDICTED, SEEN_FREE, SOLID, UNSEEN, FreeSpaceLayer
from floorcast_app.layers.observed import PointsLayer, TrajectoryLayer
from floorcast_app.layers.planes import PlaneShape, PlanesLayer
from floorcast_app.theme import Colours
from floorcast_app.viewports.plan_frame import HATCH_STEP, Frame, colour, path_of, pen, plan_pen

DOT = 0.035  # metres that a dot covers when zoomed in
SMALLEST_DOT, LARGEST_DOT = 2, 5  # device pixels
DOTTED = (2, 6)  # pixels on, and from dot to dot
GUESSED = (7, 12)


class PointsView:
    """Dots, splatted into an image: faster than drawing each, and crisp at every zoom."""

    def __init__(self, model: PointsLayer) -> None:
        self._xy = np.ascontiguousarray(model.xy.T, dtype=np.float64)
        self._tone = np.where(model.facing < 0, 0, 1 + model.facing // 2)

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """The dots in the colours of their planes."""
        width, height = (round(v * frame.ratio) for v in (frame.camera.width, frame.camera.height))
        c = frame.colours
        palette = np.array([_argb(n, a) for n, a in ((c.faint, 0.55), (c.plane_ew, 0.9), (c.plane_ns, 0.9))])
        size = int(min(max(DOT * frame.camera.scale * frame.ratio, SMALLEST_DOT), LARGEST_DOT))
        # With an edge as wide as a dot, no dot needs to be cut.
        row = width + 2 * size
        canvas = np.zeros((height + 2 * size, row), dtype=np.uint32)
        x, y = (self._pixels(frame, axis) + (size - size // 2) for axis in (0, 1))
        seen = np.flatnonzero((x >= 0) & (x < width + size) & (y >= 0) & (y < height + size))
        at = y[seen].astype(np.intp) * row + x[seen]
        tone = palette.astype(np.uint32)[self._tone[seen]]
        flat = canvas.ravel()
        for shift in range(size * size):
            flat[at + (shift // size * row + shift % size)] = tone
        inner = np.ascontiguousarray(canvas[size:-size, size:-size])
        image = QImage(inner.data, width, height, width * 4, QImage.Format.Format_ARGB32_Premultiplied)
        draw_image(painter, frame, image)

    def _pixels(self, frame: Frame, axis: int) -> NDArray[np.int32]:
        """(N,) device pixels along an axis."""
        origin = frame.camera.point(0.0, 0.0)[axis] * frame.ratio
        scale = frame.camera.scale * frame.ratio * (1 - 2 * axis)
        return np.floor(self._xy[axis] * scale + origin).astype(np.int32)


class TrajectoryView:
    """The path with a mark where it begins."""

    def __init__(self, model: TrajectoryLayer) -> None:
        self._path = QPolygonF([QPointF(x, y) for x, y in model.xy.tolist()])

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """A thin line in the accent."""
        if self._path.size() < 2:
            return
        painter.setTransform(frame.transform(), True)
        painter.setPen(plan_pen(frame, frame.colours.accent, 1.0, 0.9))
        painter.drawPolyline(self._path)
        painter.resetTransform()
        painter.setPen(pen(frame.colours.canvas, 1.5))
        painter.setBrush(colour(frame.colours.accent))
        painter.drawEllipse(frame.transform().map(self._path.first()), 4, 4)


class PlanesView:
    """Dotted all across the pane, full where they were seen."""

    def __init__(self, model: PlanesLayer) -> None:
        self._shapes = model.shapes
        self._runs = {s.item: [QLineF(*line) for line in s.lines().reshape(-1, 4)] for s in model.shapes}

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """Red for planes across x, green for those across y."""
        shown = [s for s in self._shapes if s.facing in frame.look.facings and frame.shows(*_key(s))]
        for shape in shown:
            _draw_dotted(painter, frame, shape)
        painter.setTransform(frame.transform(), True)
        for shape in shown:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, bool(shape.turn))  # most run along pixels
            painter.setPen(plan_pen(frame, plane_colour(frame.colours, shape.facing.axis), 3.0))
            painter.drawLines(self._runs[shape.item])


class FreeSpaceView:
    """Cells by their state; predicted ones hatched; the outline of the plan."""

    def __init__(self, model: FreeSpaceLayer) -> None:
        self._model = model
        self._padded = np.pad(model.codes, 1)  # UNSEEN around the grid
        self._outlines = path_of(model.outlines)

    def paint(self, painter: QPainter, frame: Frame) -> None:
        """White, hatched grey, black, and a tone for what nobody saw."""
        codes = self._pixels(frame)
        height, width = codes.shape
        image = QImage(codes.data, width, height, width, QImage.Format.Format_Indexed8)
        image.setColorTable(self._palette(frame.colours))
        draw_image(painter, frame, image)
        painter.setTransform(frame.transform(), True)
        painter.setPen(plan_pen(frame, frame.colours.hover, 1.2))
        painter.drawPath(self._outlines)

    def _pixels(self, frame: Frame) -> NDArray[np.uint8]:
        """The code of the nearest cell of each device pixel, plus four on the lines of the hatching."""
        width, height = (round(v * frame.ratio) for v in (frame.camera.width, frame.camera.height))
        scale, (x, y) = frame.camera.scale * frame.ratio, frame.camera.centre
        model = self._model
        along = (x - model.origin[0] + (np.arange(width) + 0.5 - width / 2) / scale) / model.cell
        up = (y - model.origin[1] - (np.arange(height) + 0.5 - height / 2) / scale) / model.cell
        ix, iy = (
            np.clip(np.floor(v) + 1, 0, n + 1).astype(np.intp)
            for v, n in zip((along, up), model.codes.shape[::-1], strict=True)
        )
        codes = self._padded.take(iy, axis=0).take(ix, axis=1)
        codes += self._on_line(frame, width, height)
        return codes

    def _on_line(self, frame: Frame, width: int, height: int) -> NDArray[np.uint8]:
        """4 on a line of the hatching, which stays with the plan, else 0: a sliding view of one row."""
        step = max(round(HATCH_STEP * frame.ratio), 3)
        s = frame.camera.scale * frame.ratio
        shift = round(frame.camera.centre[0] * s) + round(-frame.camera.centre[1] * s)
        row = (np.arange(width + height) + shift) % step < max(round(1.5 * frame.ratio), 1)
        return np.lib.stride_tricks.sliding_window_view(row.astype(np.uint8) * np.uint8(4), width)[:height]

    def _palette(self, c: Colours) -> list[int]:
        """By code; the second four where the hatching is."""
        tones = {UNSEEN: c.unobserved, SEEN_FREE: c.free, PREDICTED: c.predicted, SOLID: c.occupied}
        plain = [_argb(tones[k]) for k in range(4)]
        lines = list(plain)
        lines[PREDICTED] = _argb(QColor(c.predicted).darker(145).name())
        return [*plain, *lines]


def plane_colour(colours: Colours, axis: int) -> str:
    """Red for planes across x, green for those across y."""
    return colours.plane_ns if axis else colours.plane_ew


def across(frame: Frame, axis: int, offset: float, turn: float = 0.0) -> tuple[QPointF, QPointF]:
    """The ends of a line all across the pane, pixels."""
    if turn:
        return _slanted(frame, turn + (0.0, math.pi / 2)[axis], offset)
    x, y = frame.camera.point(offset, offset)
    if axis == 0:
        return QPointF(x, 0), QPointF(x, frame.camera.height)
    return QPointF(0, y), QPointF(frame.camera.width, y)


def _slanted(frame: Frame, angle: float, offset: float) -> tuple[QPointF, QPointF]:
    """The line ``offset`` metres from the origin in a direction, as long as the pane is at most."""
    camera = frame.camera
    normal = np.array([math.cos(angle), math.sin(angle)])
    centre = np.array(camera.centre)
    foot = centre + (offset - centre @ normal) * normal
    reach = math.hypot(camera.width, camera.height) / 2 / camera.scale
    run = reach * np.array([-normal[1], normal[0]])
    a, b = foot - run, foot + run
    return QPointF(*camera.point(*a.tolist())), QPointF(*camera.point(*b.tolist()))


def _draw_dotted(painter: QPainter, frame: Frame, shape: PlaneShape) -> None:
    """A line of dots all across the pane, as a tiled brush: strokes of dashes took ten times as long."""
    axis = shape.facing.axis
    on, step = GUESSED if shape.speculated else DOTTED
    if shape.turn:
        painter.setPen(pen(plane_colour(frame.colours, axis), 1.0, 0.75, (float(on), float(step - on))))
        painter.drawLine(*across(frame, axis, shape.offset, shape.turn))
        return
    brush = QBrush(_dots_tile(plane_colour(frame.colours, axis), on, step, axis))
    start, _ = across(frame, axis, shape.offset)
    origin = frame.camera.point(0.0, 0.0)
    shift = [round(v) % step for v in origin]
    brush.setTransform(QTransform.fromTranslate(*((0, shift[1]) if axis == 0 else (shift[0], 0))))
    x, y = round(start.x()), round(start.y())
    if axis == 0:
        painter.fillRect(QRect(x, 0, 1, round(frame.camera.height)), brush)
    else:
        painter.fillRect(QRect(0, y, round(frame.camera.width), 1), brush)


@lru_cache(maxsize=32)
def _dots_tile(name: str, on: int, step: int, axis: int) -> QImage:
    """``on`` of ``step`` pixels in a row, or in a column for planes across x."""
    tile = QImage(
        1 if axis == 0 else step, step if axis == 0 else 1, QImage.Format.Format_ARGB32_Premultiplied
    )
    tile.fill(Qt.GlobalColor.transparent)
    painter = QPainter(tile)
    painter.fillRect(QRect(0, 0, on, on), colour(name, 0.75))
    painter.end()
    return tile


def draw_image(painter: QPainter, frame: Frame, image: QImage) -> None:
    """An image of the whole pane in device pixels."""
    if not image.isNull():
        image.setDevicePixelRatio(frame.ratio)
        painter.drawImage(0, 0, image)


def _argb(name: str, alpha: float = 1.0) -> int:
    """Premultiplied."""
    r, g, b = (int(name[i : i + 2], 16) for i in (1, 3, 5))
    return (round(255 * alpha) << 24) | (round(r * alpha) << 16) | (round(g * alpha) << 8) | round(b * alpha)


def _key(shape: PlaneShape) -> tuple[str, str]:
    return shape.item.kind, shape.item.id

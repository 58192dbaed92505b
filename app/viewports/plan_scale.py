"""The scale bar of a plan pane: in a corner where it hides neither a room nor a dimension."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter

from floorcast_app import format
from floorcast_app.layers.dimensions import WRITING, Row, row_gap
from floorcast_app.layers.source import PlanSource
from floorcast_app.viewports.plan_frame import SMALL, Frame, colour, draw_text, pen, round_length, text_size
from floorplan_core.drawing_style import METRES_PER_FOOT

Shapes = np.ndarray[tuple[int], np.dtype[np.object_]]  # shapely

BAR, SHORT_BAR = 150.0, 70.0  # pixels that the scale bar may take, and where that hides something
MARGIN = 16.0  # pixels from the edges
AROUND, ABOVE, BELOW = 8.0, 24.0, 8.0  # pixels of its plate around the bar
ROOMY = (520.0, 380.0)  # pixels: a pane of this size shows a bar whatever it hides


def paint_scale(
    painter: QPainter, frame: Frame, source: PlanSource | None = None, rows: Sequence[Row] = ()
) -> None:
    """A bar of a round length; nothing in a small pane where it would hide the plan everywhere.

    :param rows: of dimensions beside the plan, that are shown.
    """
    found = scale_place(frame, source, rows)
    if found is None:
        return
    box, value, width = found
    x, y = box.left() + AROUND, box.bottom() - BELOW
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour(frame.colours.panel, 0.93))
    painter.drawRoundedRect(box, 5, 5)
    painter.setPen(pen(frame.colours.text, 1.6))
    painter.drawPolyline([QPointF(x, y - 5), QPointF(x, y), QPointF(x + width, y), QPointF(x + width, y - 5)])
    text = _text(value, frame)
    draw_text(painter, text, (box.center().x(), y - 11), SMALL, colour(frame.colours.text), 500)


def scale_place(
    frame: Frame, source: PlanSource | None, rows: Sequence[Row] = ()
) -> tuple[QRectF, float, float] | None:
    """The plate of the bar, what the bar measures (m or ft) and its pixels; None where there is no place."""
    if not frame.look.scale_bar:
        return None
    places = [_plate(frame, corner, longest) for longest in (BAR, SHORT_BAR) for corner in ("ll", "lr")]
    if source is None:
        return places[0]
    taken = _taken(frame, source, rows)
    for place in places:
        if not _hides(place[0], taken, frame):
            return place
    roomy = frame.camera.width >= ROOMY[0] and frame.camera.height >= ROOMY[1]
    return places[0] if roomy else None


def bar_length(frame: Frame, longest: float = BAR) -> tuple[float, float]:
    """Of the scale bar: metres or feet, and pixels."""
    unit = METRES_PER_FOOT if frame.look.units == "ft-in" else 1.0
    value = round_length(longest / frame.camera.scale / unit)
    return value, value * unit * frame.camera.scale


def _plate(frame: Frame, corner: str, longest: float) -> tuple[QRectF, float, float]:
    """The plate at the lower left ("ll") or the lower right ("lr"); legend and north stand above."""
    value, width = bar_length(frame, longest)
    wide = max(width, text_size(_text(value, frame), SMALL, 500)[0]) + 2 * AROUND
    tall = ABOVE + BELOW
    x = MARGIN - AROUND if corner == "ll" else frame.camera.width - MARGIN + AROUND - wide
    y = frame.camera.height - MARGIN + BELOW - tall
    return QRectF(x, y, wide, tall), value, width


def _text(value: float, frame: Frame) -> str:
    if frame.look.units == "ft-in":
        return f"{format.number(value, 'g')} ft"
    return f"{value * 100:g} cm" if value < 1 else f"{format.number(value, 'g')} m"


def _taken(frame: Frame, source: PlanSource, rows: Sequence[Row]) -> Shapes:
    """Shapes that the bar should not hide, metres."""
    shapes = [r.polygon for r in source.drawn.regions]
    for row in rows:
        gap = row_gap(row.level, min(frame.camera.width, frame.camera.height))
        if gap is None:
            continue
        out = row.edge + row.sign * (gap + WRITING) / frame.camera.scale
        low, high = sorted((row.edge, out))
        start, end = min(s.start for s in row.spans), max(s.end for s in row.spans)
        shapes.append(shapely.box(*((start, low, end, high) if row.axis else (low, start, high, end))))
    return np.array(shapes, dtype=object)


def _hides(box: QRectF, taken: Shapes, frame: Frame) -> bool:
    (x0, y1), (x1, y0) = (
        frame.camera.to_plan(box.left(), box.top()),
        frame.camera.to_plan(box.right(), box.bottom()),
    )
    return bool(shapely.intersects(taken, shapely.box(x0, y0, x1, y1)).any())

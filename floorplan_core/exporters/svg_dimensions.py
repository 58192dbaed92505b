"""Dimension lines outside the plan: a chain of clear lengths on each side, the overall ones beyond them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.exporters import palette
from floorplan_core.exporters.dimensions import Span, chain, differs, overall
from floorplan_core.exporters.sheet import Sheet
from floorplan_core.exporters.svg_canvas import SvgCanvas, text_width
from floorplan_core.model import Region

Float = NDArray[np.float64]

CHAIN_ROW, OVERALL_ROW = 6.5, 13.0  # mm from the walls
TICK = 0.8  # mm, half a tick
TEXT, TOTAL = 1.9, 2.2  # mm
SMALLEST = 1.35  # mm
RAISE = 0.8  # mm between text and line
CLEAR = 1.6  # mm between a wall and an extension line
LINE, EXTENSION = 0.13, 0.09  # mm


@dataclass(frozen=True)
class Side:
    """One side of the page."""

    axis: int  # of the faces' normal: 1 top and bottom, 0 left and right
    sign: int  # +1 top and right


TOP, BOTTOM, LEFT, RIGHT = Side(1, 1), Side(1, -1), Side(0, -1), Side(0, 1)


def draw_dimensions(canvas: SvgCanvas, sheet: Sheet, regions: Sequence[Region]) -> None:
    """Chains at the top and left, at the bottom and right where those say more, and overall lengths."""
    with canvas.group(
        id="dimensions", stroke=palette.GREY, stroke_width=LINE, fill=palette.GREY, text_anchor="middle"
    ):
        if not regions:
            return
        for first, second in ((TOP, BOTTOM), (LEFT, RIGHT)):
            one, other = (chain(regions, side.axis, side.sign) for side in (first, second))
            _draw_row(canvas, sheet, first, one, CHAIN_ROW, TEXT)
            start, end = overall(regions, 1 - first.axis)
            total = [Span(start, end, float("nan"))]
            if differs(other, [*one, *total]):
                _draw_row(canvas, sheet, second, other, CHAIN_ROW, TEXT)
            if len(one) > 1:
                _draw_row(canvas, sheet, first, total, OVERALL_ROW, TOTAL)


def _draw_row(
    canvas: SvgCanvas, sheet: Sheet, side: Side, spans: Sequence[Span], row: float, size: float
) -> None:
    at = _row(sheet, side, row)
    for span in spans:
        a, b = _along(sheet, side, span.start), _along(sheet, side, span.end)
        canvas.line(_point(side, a, at), _point(side, b, at))
        for end in (a, b):
            _draw_end(canvas, sheet, side, end, at, span.face)
        _draw_text(canvas, side, (a + b) / 2, at, f"{span.length:.2f}", abs(b - a), size)


def _row(sheet: Sheet, side: Side, distance: float) -> float:
    """Page coordinate of a row of dimensions."""
    x, y = sheet.corner
    w, h = sheet.size
    edge = {TOP: y, BOTTOM: y + h, LEFT: x, RIGHT: x + w}[side]
    return edge + distance * _outwards(side)


def _outwards(side: Side) -> int:
    """Direction away from the plan on the page, where y points down."""
    return -side.sign if side.axis == 1 else side.sign


def _along(sheet: Sheet, side: Side, value: float) -> float:
    """Page coordinate along the side of a plan coordinate."""
    return float(sheet.to_page(np.array([value, value]))[0, 1 - side.axis])


def _point(side: Side, along: float, across: float) -> tuple[float, float]:
    return (along, across) if side.axis == 1 else (across, along)


def _draw_end(canvas: SvgCanvas, sheet: Sheet, side: Side, along: float, at: float, face: float) -> None:
    """A tick, and an extension line from the wall where the face is known."""
    x, y = _point(side, along, at)
    canvas.line((x - TICK, y + TICK), (x + TICK, y - TICK), stroke_width=2 * LINE, stroke=palette.INK)
    wall = at - CLEAR * _outwards(side)
    if np.isfinite(face):
        page = float(sheet.to_page(np.array([face, face]))[0, side.axis])
        wall = page + (CLEAR + 0.3 * sheet.mm) * _outwards(side)
    if (at - wall) * _outwards(side) > 0:
        canvas.line(
            _point(side, along, wall),
            _point(side, along, at + TICK * _outwards(side)),
            stroke_width=EXTENSION,
            stroke=palette.FAINT,
        )


def _draw_text(
    canvas: SvgCanvas, side: Side, along: float, at: float, text: str, room: float, size: float
) -> None:
    """The length beside its line, smaller where it is tight, left out where it would not fit at all."""
    fitting = min(size, size * room / text_width(text, size) * 0.95)
    if fitting < SMALLEST:
        return
    x, y = _point(side, along, at - RAISE)
    canvas.text(text, x, y, fitting, turn=0.0 if side.axis == 1 else -90.0, stroke="none", fill=palette.INK)

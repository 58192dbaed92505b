"""Dimension lines outside the plan: a chain of clear lengths on each side, the overall ones beyond them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters import palette
from floorplan_core.exporters.dimensions import Arm, Span, arms, chain, differs, ends_guessed, overall_span
from floorplan_core.exporters.sheet import Sheet
from floorplan_core.exporters.svg_canvas import SvgCanvas, text_width
from floorplan_core.exporters.svg_labels import is_rectangle
from floorplan_core.model import Region

Float = NDArray[np.float64]

CHAIN_ROW, OVERALL_ROW = 6.5, 13.0  # mm from the walls
TICK = 0.8  # mm, half a tick
TEXT, TOTAL = 2.5, 2.8  # mm: ISO 3098 has 2.5 for writing on a drawing
SMALLEST = 1.5  # mm; stretches too short for such text are left out
FILL = 0.86  # of the stretch that text may take: that of the next one begins a wall farther on
RAISE = 0.8  # mm between text and line
INSIDE = 2.2  # mm, widths inside the plan
SLIM = 1.8  # arms this much longer than wide get a width
PLACES = (0.5, 0.35, 0.65, 0.2, 0.8, 0.1, 0.9)  # along the arm, in the order in which they are tried
SHORTEST = 5.0  # mm: narrower arms have no room for text
KEEP_OFF = 3.4  # mm around a width inside the plan
LONGEST = 7.0  # mm: extension lines are stubs; whole ones would hatch the sheet
BEHIND = 0.3  # metres of wall that an extension line leaves free
CLEAR = 1.6  # mm between a wall and an extension line
LINE, EXTENSION = 0.13, 0.09  # mm


@dataclass(frozen=True)
class Side:
    """One side of the page."""

    axis: int  # of the faces' normal: 1 top and bottom, 0 left and right
    sign: int  # +1 top and right


TOP, BOTTOM, LEFT, RIGHT = Side(1, 1), Side(1, -1), Side(0, -1), Side(0, 1)


def draw_dimensions(
    canvas: SvgCanvas, sheet: Sheet, regions: Sequence[Region], taken: Any, style: DrawingStyle = PLAIN
) -> None:
    """Chains at the top and left, and where they say more at the bottom and right; overall lengths; widths.

    ``taken`` is ground on the page that the dimensions inside the plan keep off.
    """
    with canvas.group(
        id="dimensions", stroke=palette.GREY, stroke_width=LINE, fill=palette.GREY, text_anchor="middle"
    ):
        if not regions:
            return
        for first, second in ((TOP, BOTTOM), (LEFT, RIGHT)):
            one, other = (chain(regions, side.axis, side.sign) for side in (first, second))
            _draw_row(canvas, sheet, first, one, CHAIN_ROW, TEXT, style)
            total = [overall_span(regions, 1 - first.axis)]
            if differs(other, [*one, *total]):
                _draw_row(canvas, sheet, second, other, CHAIN_ROW, TEXT, style)
            if differs(total, one):
                _draw_row(canvas, sheet, first, total, OVERALL_ROW, TOTAL, style)
        for region in (r for r in regions if not is_rectangle(r)):
            _draw_arms(canvas, sheet, region, taken, style)


def _draw_arms(canvas: SvgCanvas, sheet: Sheet, region: Region, taken: Any, style: DrawingStyle) -> None:
    """The clear width of a corridor's arms, where there is room for it."""
    for arm in arms(region.polygon, SLIM):
        for share in PLACES:
            at = arm.start + share * (arm.end - arm.start)
            ends = np.array([[arm.low, at], [arm.high, at]])
            a, b = sheet.to_page(ends if arm.axis == 0 else ends[:, ::-1])
            ground = shapely.LineString([a, b]).buffer(KEEP_OFF, cap_style="flat")
            if abs(b - a).sum() >= SHORTEST and not taken.intersects(ground):
                guessed = ends_guessed([region], arm.axis, (arm.low, arm.high), at)
                _draw_width(canvas, a, b, arm, style.dimension(arm.width, guessed))
                break


def _draw_width(canvas: SvgCanvas, a: Float, b: Float, arm: Arm, text: str) -> None:
    canvas.line(a.tolist(), b.tolist())
    for x, y in (a.tolist(), b.tolist()):
        canvas.line((x - TICK, y + TICK), (x + TICK, y - TICK), stroke_width=2 * LINE, stroke=palette.INK)
    x, y = ((a + b) / 2).tolist()
    x, y = (x, y - RAISE) if arm.axis == 0 else (x - RAISE, y)
    turn = 0.0 if arm.axis == 0 else -90.0
    fitting = _text_size(float(abs(b - a).sum()), text, INSIDE)
    canvas.text(text, x, y, fitting, turn=turn, stroke="none", fill=palette.INK)


def _draw_row(
    canvas: SvgCanvas,
    sheet: Sheet,
    side: Side,
    spans: Sequence[Span],
    row: float,
    size: float,
    style: DrawingStyle,
) -> None:
    at = _row(sheet, side, row)
    for span in spans:
        text = style.dimension(span.length, span.guessed)
        if _text_size(span.length * sheet.mm, text, size) < SMALLEST:
            continue
        a, b = _along(sheet, side, span.start), _along(sheet, side, span.end)
        canvas.line(_point(side, a, at), _point(side, b, at))
        for end in (a, b):
            _draw_end(canvas, sheet, side, end, at, span.face)
        x, y = _point(side, (a + b) / 2, at - RAISE)
        turn = 0.0 if side.axis == 1 else -90.0
        fitting = _text_size(abs(b - a), text, size)
        canvas.text(text, x, y, fitting, turn=turn, stroke="none", fill=palette.INK)


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
        near = max((at - page) * _outwards(side) - CLEAR - BEHIND * sheet.mm, 0.0)
        wall = at - min(near, LONGEST) * _outwards(side)
    if (at - wall) * _outwards(side) > 0:
        canvas.line(
            _point(side, along, wall),
            _point(side, along, at + TICK * _outwards(side)),
            stroke_width=EXTENSION,
            stroke=palette.FAINT,
        )


def _text_size(room: float, text: str, size: float) -> float:
    """The size at which ``text`` fits between the ticks; ``size`` at most."""
    return min(size, FILL * size * room / text_width(text, size))

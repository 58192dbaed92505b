"""Dimensions: chains and overall lengths outside the plan, widths of arms inside it."""

from __future__ import annotations

from dataclasses import dataclass

import shapely

from floorcast_app.layers.source import PlanSource
from floorplan_core.exporters.dimensions import Arm, Span, arms, chain, differs, ends_guessed, overall_span
from floorplan_core.exporters.svg_labels import is_rectangle
from floorplan_core.model import Region

SLIM = 1.8  # arms this much longer than wide get a width
PLACES = (0.5, 0.35, 0.65, 0.2, 0.8, 0.1, 0.9)  # along the arm, in the order in which they are tried
ROWS = {1: 24.0, 2: 46.0}  # pixels from the walls to the rows of dimensions
TIGHT = 14.0  # pixels to the one row that a small pane shows
SMALL_PANE = 380.0  # pixels of its shorter side
WRITING = 15.0  # pixels beyond a row that its text and ticks take
KEEP_OFF = 0.35  # metres around a width inside the plan


@dataclass(frozen=True)
class Row:
    """A row of dimensions beside the plan."""

    axis: int  # of the faces' normal: 1 above and below the plan, 0 beside it
    sign: int  # +1 above and to the right
    level: int  # 1 next to the plan, 2 beyond
    edge: float  # metres along ``axis``: where the walls of the plan end
    spans: tuple[Span, ...]


@dataclass(frozen=True)
class Width:
    """The clear width of an arm."""

    start: tuple[float, float]  # metres, manhattan frame
    end: tuple[float, float]
    length: float  # metres
    guessed: bool = False  # True where it goes to a wall that nobody saw


@dataclass(frozen=True)
class DimensionsLayer:
    """Everything that is dimensioned without being asked for."""

    rows: tuple[Row, ...]
    widths: tuple[Width, ...]


def row_gap(level: int, shorter: float) -> float | None:
    """Pixels from the walls to a row in a pane whose shorter side has ``shorter`` pixels; None: not shown."""
    if shorter >= SMALL_PANE:
        return ROWS[level]
    return TIGHT if level == 1 else None


def writing_around(shorter: float) -> float:
    """Pixels that dimensions need around the plan in such a pane."""
    return (ROWS[2] if shorter >= SMALL_PANE else TIGHT) + WRITING


def dimensions_layer(source: PlanSource) -> DimensionsLayer:
    """As on the drawing: a chain above and to the left, the others where they say more, and the arms."""
    if not source.drawn.regions:
        return DimensionsLayer((), ())
    taken = shapely.union_all(
        [
            *(leaf.sector for made in source.swings for leaf in made),
            *(shapely.box(*o.bounds) for o in source.walls.openings),
        ]
    )
    slim = [r for r in source.drawn.regions if not is_rectangle(r)]
    widths = (_width(r, arm, taken) for r in slim for arm in arms(r.polygon, SLIM))
    rows = (*_rows(source, 1, 1), *_rows(source, 0, -1))
    return DimensionsLayer(rows, tuple(w for w in widths if w is not None))


def _rows(source: PlanSource, axis: int, sign: int) -> list[Row]:
    """The chain of the side ``sign``, that of the other side if it says more, and the whole length."""
    regions = source.drawn.regions
    edges = {s: source.extent[axis + (2 if s > 0 else 0)] for s in (-1, 1)}
    one, other = chain(regions, axis, sign), chain(regions, axis, -sign)
    total = (overall_span(regions, 1 - axis),)
    rows = [Row(axis, sign, 1, edges[sign], one)]
    if differs(other, [*one, *total]):
        rows.append(Row(axis, -sign, 1, edges[-sign], other))
    if differs(total, one):
        rows.append(Row(axis, sign, 2, edges[sign], total))
    return rows


def _width(region: Region, arm: Arm, taken: object) -> Width | None:
    """Across the arm, at the first place where nothing is in the way."""
    for share in PLACES:
        at = arm.start + share * (arm.end - arm.start)
        ends = ((arm.low, at), (arm.high, at))
        a, b = ends if arm.axis == 0 else (ends[0][::-1], ends[1][::-1])
        ground = shapely.LineString([a, b]).buffer(KEEP_OFF, cap_style="flat")
        if not shapely.intersects(taken, ground):
            guessed = ends_guessed([region], arm.axis, (arm.low, arm.high), at)
            return Width(a, b, arm.width, guessed)
    return None

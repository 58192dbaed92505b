"""Names, areas and inside dimensions of the regions, on free floor (page millimetres)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters import palette
from floorplan_core.exporters.dimensions import ends_guessed
from floorplan_core.exporters.placement import LEADING, Line, Placed, block_size, place
from floorplan_core.exporters.sheet import Sheet
from floorplan_core.exporters.svg_canvas import SvgCanvas
from floorplan_core.model import FloorPlan, Region

NAME, AREA, NOTE = 3.2, 2.6, 2.2  # mm
PAD = 0.9  # mm between text and wall
AIR = 0.5  # mm around text that hatching leaves free
RECTANGULAR = 0.995  # share of its bounds that a region fills to be called a rectangle
CAP = 0.72  # height of capitals over font size


def place_labels(
    sheet: Sheet, plan: FloorPlan, swept: Sequence[Any], style: DrawingStyle = PLAIN
) -> list[Placed]:
    """A label for each region; ``swept`` are polygons on the page, doors and their swing: text keeps off."""
    sectors = shapely.STRtree(swept)
    floors = [sheet.geometry(region.polygon) for region in plan.regions]
    placed = [_place(r, floor, sectors, style) for r, floor in zip(plan.regions, floors, strict=True)]
    return _apart(placed, floors)


def _apart(labels: list[Placed], floors: Sequence[Any]) -> list[Placed]:
    """The labels; those that fit nowhere and lie on others are as small as their ``floors`` have room for.

    A lone number that reaches over the walls of a closet is easier to read; at 1:2000 nearly all do.
    """
    loose = [k for k, label in enumerate(labels) if not label.fits]
    boxes = np.array([_ground(label, 0.0) for label in labels], dtype=object)
    one, other = shapely.STRtree(boxes).query(boxes[loose], predicate="intersects")
    for k in {loose[i] for i, j in zip(one.tolist(), other.tolist(), strict=True) if loose[i] != j}:
        labels[k] = _shrunk(labels[k], floors[k])
    return labels


def _shrunk(label: Placed, floor: Any) -> Placed:
    """The label in the circle around its spot that touches the walls."""
    room = 2 * shapely.distance(shapely.Point(label.x, label.y), floor.boundary)
    share = min(1.0, room / float(np.hypot(*block_size(label.lines))))
    return replace(label, lines=tuple(replace(line, size=share * line.size) for line in label.lines))


def label_ground(labels: Sequence[Placed]) -> Any:
    """The ground that the labels cover on the page, with a little air."""
    return shapely.union_all([_ground(label, AIR) for label in labels])


def _ground(label: Placed, air: float) -> Any:
    width, height = block_size(label.lines)[:: -1 if label.turned else 1]
    w, h = width / 2 + air, height / 2 + air
    return shapely.box(label.x - w, label.y - h, label.x + w, label.y + h)


def draw_labels(canvas: SvgCanvas, labels: Sequence[Placed]) -> None:
    """Write the labels."""
    with canvas.group(id="labels", text_anchor="middle"):
        for label in labels:
            _draw(canvas, label)


def label_lines(region: Region, style: DrawingStyle = PLAIN) -> tuple[Line, ...]:
    """Name with label, area, clear dimensions of a rectangle: the most important first."""
    lines = [Line(display_name(region, style), NAME, "name"), Line(style.area(region.area), AREA, "area")]
    if not region.name.isdigit():
        lines.append(Line(style.say(region.label), NOTE, "note"))
    if is_rectangle(region):
        x0, y0, x1, y1 = region.polygon.bounds
        across, along = (ends_guessed([region], k, ends) for k, ends in enumerate(((x0, x1), (y0, y1))))
        clear = f"{style.dimension(x1 - x0, across)} × {style.dimension(y1 - y0, along)}"
        lines.append(Line(clear, NOTE, "note"))
    return tuple(lines)


def is_rectangle(region: Region) -> bool:
    """True where the region fills its bounds, so that two lengths describe it."""
    x0, y0, x1, y1 = region.polygon.bounds
    return bool(region.area >= RECTANGULAR * (x1 - x0) * (y1 - y0))


def display_name(region: Region, style: DrawingStyle = PLAIN) -> str:
    """``Room 3`` for a region that has only a number, else its name."""
    return f"{style.label(region.label)} {region.name}" if region.name.isdigit() else region.name


def _place(region: Region, floor: Any, sectors: shapely.STRtree, style: DrawingStyle) -> Placed:
    near = sectors.geometries[np.sort(sectors.query(floor, predicate="intersects"))]
    free = _largest(floor.difference(shapely.union_all(near))) if len(near) else floor
    placed = place(label_lines(region, style), free, PAD, floor)
    if not placed.fits and region.name.isdigit():
        number = (Line(region.name, NAME, "name"),)
        placed = place(number, free, PAD / 2, floor)
        if not placed.fits:
            placed = place(number, floor, PAD / 2)
    return placed


def _largest(geometry: Any) -> Any:
    return max(shapely.get_parts(geometry), key=lambda part: part.area)


def _draw(canvas: SvgCanvas, placed: Placed) -> None:
    """Lines under each other, centred on the spot as a block."""
    styles: dict[str, dict[str, Any]] = {
        "name": {"font_weight": "600", "fill": palette.INK},
        "area": {"fill": palette.INK},
        "note": {"fill": palette.GREY},
    }
    height = sum(line.size * LEADING for line in placed.lines)
    offset = -height / 2
    for line in placed.lines:
        baseline = offset + line.size * (LEADING + CAP) / 2
        x, y = (placed.x + baseline, placed.y) if placed.turned else (placed.x, placed.y + baseline)
        canvas.text(line.text, x, y, line.size, turn=-90.0 if placed.turned else 0.0, **styles[line.style])
        offset += line.size * LEADING

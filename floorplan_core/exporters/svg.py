"""plan.svg: the plan as a drawing to print and to frame.

SVG 1.1 in millimetres of paper at a usual scale, page axes along the walls (manhattan frame). Layers, from
the ground up: ``rooms``, ``predicted``, ``walls``, ``doors``, ``dimensions``, ``annotation``. Seen floor is
plain, predicted floor hatched; walls of which no face was seen are hatched instead of solid. No outside
assets; the same plan always gives the same bytes.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import shapely

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters import palette
from floorplan_core.exporters.door_symbols import Leaf, swings
from floorplan_core.exporters.sheet import Sheet, lay_out
from floorplan_core.exporters.svg_blocks import draw_blocks
from floorplan_core.exporters.svg_canvas import FONT, SvgCanvas, number
from floorplan_core.exporters.svg_dimensions import draw_dimensions
from floorplan_core.exporters.svg_labels import draw_labels, label_ground, place_labels
from floorplan_core.exporters.walls import Opening, Poche, poche, predicted_floor
from floorplan_core.model import Door, FloorPlan, Region

HATCH = 1.5  # mm between the lines of predicted floor
WALL_HATCH = 0.9  # mm between the lines of a guessed wall
OUTLINE = 0.25  # mm, the edge of walls
FINE = 0.13  # mm, swings and dashes
LEAF = 0.32  # mm, door leaves


class SvgExporter:
    """Writes ``plan.svg``."""

    name = "SVG"
    suffixes: tuple[str, ...] = (".svg",)
    description = (
        "A drawing at a usual scale: walls, doors, areas, dimensions, seen and predicted told apart."
    )

    def __init__(self, style: DrawingStyle = PLAIN) -> None:
        self._style = style

    def styled(self, style: DrawingStyle) -> SvgExporter:
        """The exporter of drawings in these units, in this language."""
        return SvgExporter(style)

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the drawing of ``plan`` to ``path`` as UTF-8."""
        path.write_text(svg_text(plan, self._style), encoding="utf-8", newline="\n")


def svg_text(plan: FloorPlan, style: DrawingStyle = PLAIN) -> str:
    """The drawing of ``plan`` as the text of an SVG 1.1 document."""
    walls = poche(plan)
    sheet = lay_out(drawn_bounds(plan, walls), style.imperial)
    swung = swings(walls.openings, plan.regions)
    canvas = SvgCanvas()
    canvas.box(0, 0, sheet.width, sheet.height, fill=palette.PAPER)
    _draw_rooms(canvas, sheet, plan, style)
    swept = _swept(sheet, swung)
    openings = [sheet.geometry(o.polygon) for o in walls.openings]
    labels = place_labels(sheet, plan, [*swept, *openings], style)
    text = label_ground(labels)
    _draw_predicted(canvas, sheet, plan, text)
    _draw_walls(canvas, sheet, walls)
    _draw_doors(canvas, sheet, walls, swung, style)
    draw_dimensions(canvas, sheet, plan.regions, shapely.union_all([text, *swept, *openings]), style)
    with canvas.group(id="annotation", fill=palette.INK):
        draw_labels(canvas, labels)
        draw_blocks(canvas, sheet, plan, style)
    return "\n".join([_head(sheet, plan, style), _definitions(plan), *canvas.lines, "</svg>", ""])


def drawn_bounds(plan: FloorPlan, walls: Poche) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 in plan metres of what the drawing shows, walls included."""
    shapes = [walls.observed, walls.guessed, *(r.polygon for r in plan.regions)]
    x0, y0, x1, y1 = shapely.total_bounds(shapes).tolist() if plan.regions else plan.grid.extent
    return x0, y0, x1, y1


def _head(sheet: Sheet, plan: FloorPlan, style: DrawingStyle) -> str:
    canvas = SvgCanvas()
    canvas.title(style.say("Floor plan of {}, {}", style.title or plan.source, sheet.scale_text))
    w, h = number(sheet.width), number(sheet.height)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" version="1.1" xml:lang="{style.language}" '
        f'width="{w}mm" height="{h}mm" viewBox="0 0 {w} {h}" '
        f'font-family="{FONT}" style="font-variant-numeric: tabular-nums">\n'
        f"{canvas.lines[0]}"
    )


def _definitions(plan: FloorPlan) -> str:
    """The hatches: one for guessed walls, one for each kind of floor."""
    patterns = [_hatch("guessed-wall", WALL_HATCH, 0.22, palette.WALL, -45, palette.PAPER)]
    tones = {palette.tone(r.label).accent for r in plan.regions} | {palette.ROOM.accent}
    patterns += [_hatch(f"predicted-{t[1:]}", HATCH, 0.16, t, 45, palette.PAPER) for t in sorted(tones)]
    return " <defs>\n" + "\n".join(patterns) + "\n </defs>"


def _hatch(ident: str, step: float, width: float, colour: str, turn: int, ground: str) -> str:
    s = number(step)
    return (
        f'  <pattern id="{ident}" width="{s}" height="{s}" patternUnits="userSpaceOnUse" '
        f'patternTransform="rotate({turn})">'
        f'<rect width="{s}" height="{s}" fill="{ground}" fill-opacity="0.55"/>'
        f'<line x1="0" y1="0" x2="0" y2="{s}" stroke="{colour}" stroke-width="{number(2 * width)}" '
        'stroke-opacity="0.6"/></pattern>'
    )


def _draw_rooms(canvas: SvgCanvas, sheet: Sheet, plan: FloorPlan, style: DrawingStyle) -> None:
    with canvas.group(id="rooms"):
        for i, region in enumerate(plan.regions):
            with canvas.group(region_title(region, style), id=f"region-{i + 1}"):
                canvas.area(sheet.geometry(region.polygon), fill=palette.tone(region.label).tint)


def region_title(region: Region, style: DrawingStyle = PLAIN) -> str:
    """What the tooltip of a region says."""
    seen = style.say("{} % seen", f"{100 * (1 - region.speculated_fraction):.0f}")
    return f"{style.label(region.label)} {region.name}: {style.area(region.area)}, {seen} ({region.id})"


def _draw_predicted(canvas: SvgCanvas, sheet: Sheet, plan: FloorPlan, text: Any) -> None:
    """Hatches, left out under ``text`` (page geometry) so that it can be read."""
    floor = predicted_floor(plan)
    shapely.prepare(floor)
    with canvas.group(id="predicted"):
        for region in plan.regions:
            if not shapely.intersects(floor, region.polygon):
                continue
            part = floor.intersection(region.polygon)
            fill = f"url(#predicted-{palette.tone(region.label).accent[1:]})"
            canvas.area(_polygons(sheet.geometry(part).difference(text)), fill=fill)


def _polygons(geometry: Any) -> Any:
    """The polygons of a geometry, without what clipping leaves at edges."""
    return shapely.MultiPolygon([p for p in shapely.get_parts(geometry) if p.geom_type == "Polygon"])


def _draw_walls(canvas: SvgCanvas, sheet: Sheet, walls: Poche) -> None:
    with canvas.group(id="walls", stroke_linejoin="miter"):
        canvas.area(
            sheet.geometry(_polygons(walls.guessed)),
            id="walls-guessed",
            fill="url(#guessed-wall)",
            stroke=palette.WALL,
            stroke_width=FINE * sheet.pen,
            stroke_dasharray=_dashes(sheet, 1.1, 0.7),
        )
        canvas.area(
            sheet.geometry(_polygons(walls.observed)),
            id="walls-observed",
            fill=palette.WALL,
            stroke=palette.WALL,
            stroke_width=OUTLINE / 2 * sheet.pen,
        )


def _draw_doors(
    canvas: SvgCanvas, sheet: Sheet, walls: Poche, swung: list[tuple[Leaf, ...]], style: DrawingStyle
) -> None:
    fine = FINE * sheet.pen
    with canvas.group(id="doors", fill="none", stroke=palette.DOOR.accent, stroke_width=fine):
        for opening, made in zip(walls.openings, swung, strict=True):
            with canvas.group(door_title(opening.door, style)):
                canvas.area(sheet.geometry(opening.polygon), fill=palette.DOOR.tint, stroke="none")
                _draw_faces(canvas, sheet, opening, dashed=not made)
                for leaf in made:
                    _draw_leaf(canvas, sheet, leaf)


def door_title(door: Door, style: DrawingStyle = PLAIN) -> str:
    """What the tooltip of a door says."""
    kind = style.say((f"shut {door.kind}" if door.shut else door.kind).capitalize())
    sure = style.say("confidence {}", style.number(door.confidence, 2))
    return f"{kind} {door.id}: {style.length(door.width)}, {sure}"


def _draw_faces(canvas: SvgCanvas, sheet: Sheet, opening: Opening, dashed: bool) -> None:
    """The two faces of the wall across an opening: dashed where there is no leaf, a fine threshold else."""
    page = sheet.to_page(opening.faces.reshape(4, 2)).tolist()
    for a, b in (page[:2], page[2:]):
        canvas.line(
            a,
            b,
            stroke_dasharray=_dashes(sheet, 1.2, 0.8) if dashed else None,
            stroke_width=2 * FINE * sheet.pen if dashed else None,
        )


def _dashes(sheet: Sheet, line: float, gap: float) -> str:
    return f"{number(line * sheet.pen)} {number(gap * sheet.pen)}"


def _draw_leaf(canvas: SvgCanvas, sheet: Sheet, leaf: Leaf) -> None:
    hinge, tip, closed = sheet.to_page(np.array([leaf.hinge, leaf.tip, leaf.closed])).tolist()
    canvas.line(hinge, tip, stroke_width=LEAF * sheet.pen)
    if leaf.shut:
        return
    radius = number(float(np.hypot(tip[0] - hinge[0], tip[1] - hinge[1])))
    u, v = np.subtract(tip, hinge), np.subtract(closed, hinge)
    sweep = int(u[0] * v[1] - u[1] * v[0] > 0)
    start, end = (f"{number(p[0])},{number(p[1])}" for p in (tip, closed))
    canvas.add("path", d=f"M{start}A{radius},{radius} 0 0 {sweep} {end}")


def _swept(sheet: Sheet, swung: list[tuple[Leaf, ...]]) -> list[Any]:
    """Ground that doors sweep, on the page: labels keep off."""
    return [sheet.geometry(leaf.sector) for made in swung for leaf in made]

"""Title, legend, scale bar and north arrow (page millimetres)."""

from __future__ import annotations

import math
from typing import Any

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters import palette
from floorplan_core.exporters.placement import BOLD
from floorplan_core.exporters.sheet import BLOCKS, COLUMN, MARGIN, Sheet
from floorplan_core.exporters.svg_canvas import SvgCanvas, text_width
from floorplan_core.model import FloorPlan

TITLE, SCALE, BODY, SMALL = 4.6, 3.4, 2.5, 2.2  # mm
ROW = 3.9  # mm from line to line
RULE = 0.25  # mm
SWATCH = (7.0, 3.2)  # mm
LEGEND_TOP, LEGEND_DEPTH = 9.4, 22.6  # mm below the block's top where the legend begins, and its depth
LEGEND_ROW, LEGEND_AIR = 5.4, 1.0  # mm from entry to entry where few are, and at least between swatches
LEAF = 0.32  # mm, as thick as the leaves in the plan
SIGNS = 4  # entries of the first column: walls and floors
BAR_LENGTHS = (1, 2, 5, 10, 20, 50, 100, 200, 500)  # metres or feet
BAR_SHARE = 0.62  # of the block's width that the scale bar may take
NORTH, NORTH_EDGE = 6.5, 2.0  # mm, radius of the arrow's circle, and what is right of it


def draw_blocks(canvas: SvgCanvas, sheet: Sheet, plan: FloorPlan, style: DrawingStyle = PLAIN) -> None:
    """The three information blocks, under the plan or beside it."""
    title, legend, scale = sheet.blocks
    if not sheet.beside:
        canvas.line(title, (sheet.width - MARGIN, title[1]), stroke=palette.INK, stroke_width=RULE)
    _draw_title(canvas, sheet, plan, style, *title)
    _draw_legend(canvas, sheet, plan, style, *legend)
    with canvas.group(id="scale"):
        _draw_scale_bar(canvas, sheet, style, *scale)
        _draw_north(canvas, sheet, plan, style, *scale)


def _width(sheet: Sheet, block: int) -> float:
    return COLUMN if sheet.beside else BLOCKS[block][0]


def _draw_rule(canvas: SvgCanvas, sheet: Sheet, block: int, x: float, y: float) -> None:
    """Beside the plan each block has its own rule; below it, one rule joins them."""
    if sheet.beside:
        canvas.line((x, y), (x + _width(sheet, block), y), stroke=palette.INK, stroke_width=RULE)


def _draw_title(
    canvas: SvgCanvas, sheet: Sheet, plan: FloorPlan, style: DrawingStyle, x: float, y: float
) -> None:
    with canvas.group(id="title-block"):
        _draw_rule(canvas, sheet, 0, x, y)
        title = style.title or plan.source
        size = _fitting(title, TITLE, _width(sheet, 0) / BOLD)
        canvas.text(style.say("Floor plan"), x, y + 5.2, BODY, font_weight="600", fill=palette.ACCENT)
        canvas.text(title, x, y + 11.2, size, font_weight="600")
        lines = title_lines(sheet, plan, style)
        fitting = min(_fitting(text, BODY, _width(sheet, 0)) for text in lines)
        for i, text in enumerate(lines):
            canvas.text(text, x, y + 16.4 + i * ROW, fitting, fill=palette.INK if i == 0 else palette.GREY)


def _fitting(text: str, size: float, room: float) -> float:
    """The size at which ``text`` is no wider than ``room``; ``size`` at most."""
    width = text_width(text, size)
    return size if width <= room else size * room / width


def title_lines(sheet: Sheet, plan: FloorPlan, style: DrawingStyle = PLAIN) -> list[str]:
    """What the title block says under the name."""
    free, total = (sum(getattr(r, name) for r in plan.regions) for name in ("free_cells", "total_cells"))
    observed = f"{100.0 * free / total if total else 0.0:.0f}"
    area = style.area(sum(r.area for r in plan.regions))
    counts = [style.count(len(plan.regions), "region"), style.count(len(plan.doors), "door")]
    counts += [style.say("storey {}", plan.storey)] if plan.storey else []
    counts.append(style.say("lengths in feet and inches" if style.imperial else "lengths in metres"))
    if any(side.speculated for region in plan.regions for side in region.sides):
        counts[-1] += ", " + style.say("≈ to a speculated wall")
    last, height = [style.say("Doors swing by convention")], plan.grid.slice_height
    last += [style.say("slice {} above the floor", style.length(height))] if height > 0 else []
    yaw, support = style.number(math.degrees(plan.frame.yaw), 2), f"{100 * plan.frame.support:.0f}"
    return [
        style.say("{} net internal area to wall faces; {} % observed", area, observed),
        " · ".join(counts),
        style.say("Scale {} when printed on {} at full size", sheet.scale_text, style.say(sheet.paper)),
        style.say("Drawn along the walls: {}° from the survey's axes (support {} %)", yaw, support),
        " · ".join(last),
    ]


def legend_entries(plan: FloorPlan) -> list[tuple[str, dict[str, Any]]]:
    """Text and swatch attributes, in reading order down the columns."""
    fine = {"stroke": palette.GREY, "stroke_width": 0.1}
    labels = {r.label for r in plan.regions}
    others = sorted(labels - set(palette.TONES))
    floors = [(label.capitalize(), tone) for label, tone in palette.TONES.items() if label in labels]
    floors += [(", ".join(others).capitalize(), palette.OTHER)] if others else []
    dashed = {"stroke": palette.WALL, "stroke_width": 0.13, "stroke_dasharray": "1.1 0.7"}
    return [
        ("Wall, observed", {"fill": palette.WALL}),
        ("Wall, speculated", {"fill": "url(#guessed-wall)", **dashed}),
        ("Floor, seen", {"fill": palette.ROOM.tint, **fine}),
        ("Floor, predicted", {"fill": f"url(#predicted-{palette.ROOM.accent[1:]})", **fine}),
        *((text, {"fill": tone.tint, "stroke": tone.accent, "stroke_width": 0.1}) for text, tone in floors),
    ]


def _draw_legend(
    canvas: SvgCanvas, sheet: Sheet, plan: FloorPlan, style: DrawingStyle, x: float, y: float
) -> None:
    """Walls and floors in the first column; labels and doors, those that the plan has, in the second."""
    with canvas.group(id="legend"):
        _draw_rule(canvas, sheet, 1, x, y)
        canvas.text(style.say("Legend"), x, y + 5.2, BODY, font_weight="600", fill=palette.ACCENT)
        entries, doors = legend_entries(plan), door_kinds(plan)
        half = _width(sheet, 1) / 2
        pitch = min(LEGEND_ROW, LEGEND_DEPTH / max(len(entries) + len(doors) - SIGNS, SIGNS))
        size = SWATCH[0], min(SWATCH[1], pitch - LEGEND_AIR)
        for i, (text, look) in enumerate(entries):
            second = i >= SIGNS
            left, top = x + half * second, y + LEGEND_TOP + (i - SIGNS * second) * pitch
            if text == "Floor, predicted":
                canvas.box(left, top, *size, fill=palette.ROOM.tint)
            canvas.box(left, top, *size, **look)
            _draw_word(canvas, style.say(text), left, top, size, half)
        for i, text in enumerate(doors, len(entries) - SIGNS):
            top = y + LEGEND_TOP + i * pitch
            _draw_door_swatch(canvas, text, x + half, top, size)
            _draw_word(canvas, style.say(text), x + half, top, size, half)


def door_kinds(plan: FloorPlan) -> list[str]:
    """What the legend says of doors: only what the plan has."""
    there = {
        "Door": any(d.kind == "door" and not d.shut for d in plan.doors),
        "Door, found shut": any(d.shut for d in plan.doors),
        "Opening": any(d.kind == "opening" for d in plan.doors),
    }
    return [kind for kind, shown in there.items() if shown]


def _draw_word(
    canvas: SvgCanvas, text: str, left: float, top: float, size: tuple[float, float], column: float
) -> None:
    fitting = _fitting(text, BODY, column - SWATCH[0] - 3)
    canvas.text(text, left + SWATCH[0] + 2, top + size[1] / 2 + 0.8, fitting)


def _draw_door_swatch(canvas: SvgCanvas, text: str, x: float, top: float, size: tuple[float, float]) -> None:
    w, h = size
    canvas.box(x, top, w, h, fill=palette.DOOR.tint)
    look: dict[str, Any] = {"stroke": palette.DOOR.accent, "stroke_width": 0.2}
    dash = "1.2 0.8" if text == "Opening" else None
    for edge in (top, top + h):
        canvas.line((x, edge), (x + w, edge), stroke_dasharray=dash, **look)
    if text == "Door, found shut":  # its leaf, across the opening
        canvas.line((x, top + h / 2), (x + w, top + h / 2), stroke=palette.DOOR.accent, stroke_width=LEAF)


def _draw_scale_bar(canvas: SvgCanvas, sheet: Sheet, style: DrawingStyle, x: float, y: float) -> None:
    """Alternating fields; the longest round length that fits."""
    _draw_rule(canvas, sheet, 2, x, y)
    room = _width(sheet, 2) * BAR_SHARE
    mm = sheet.mm * style.metres_per_unit
    length = max((m for m in BAR_LENGTHS if m * mm <= room), default=BAR_LENGTHS[0])
    fields = 4 if length % 5 else 5
    field = length * mm / fields
    top = y + 21.6
    canvas.text(style.say("Scale and north"), x, y + 5.2, BODY, font_weight="600", fill=palette.ACCENT)
    canvas.text(sheet.scale_text, x, y + 11.2, SCALE, font_weight="600")
    for i in range(fields):
        fill = palette.INK if i % 2 == 0 else palette.PAPER
        canvas.box(x + i * field, top, field, 1.4, fill=fill, stroke=palette.INK, stroke_width=0.15)
    for share, anchor in ((0, "start"), (0.5, "middle"), (1, "end")):
        text = style.short(length * share) + (f" {style.unit}" if share == 1 else "")
        if share != 0.5 or length > 1:
            canvas.text(text, x + share * length * mm, top - 1.4, SMALL, text_anchor=anchor)


def _draw_north(
    canvas: SvgCanvas, sheet: Sheet, plan: FloorPlan, style: DrawingStyle, x: float, y: float
) -> None:
    """The direction of the world's +y axis."""
    right, up = (plan.frame.rotation[:2, :2] @ (0.0, 1.0)).tolist()
    turn = math.degrees(math.atan2(right, up))
    cx, cy = x + _width(sheet, 2) - NORTH - NORTH_EDGE, y + 16.0
    r = NORTH
    with canvas.group(id="north", transform=f"translate({cx:.3f} {cy:.3f})"):
        canvas.add("circle", cx=0.0, cy=0.0, r=r, fill="none", stroke=palette.INK, stroke_width=0.18)
        with canvas.group(transform=f"rotate({turn:.2f})"):
            canvas.add(
                "path", d=f"M0,{-r + 0.8}L{r * 0.34:.3f},{r * 0.62:.3f}L0,{r * 0.36:.3f}Z", fill=palette.INK
            )
            canvas.add(
                "path",
                d=f"M0,{-r + 0.8}L{-r * 0.34:.3f},{r * 0.62:.3f}L0,{r * 0.36:.3f}Z",
                fill=palette.PAPER,
                stroke=palette.INK,
                stroke_width=0.15,
            )
            canvas.text("N", 0.0, -r - 1.0, 2.6, text_anchor="middle", font_weight="600")
        note = style.say("north = world +y")
        fitting = _fitting(note, SMALL, 2 * (r + NORTH_EDGE))
        canvas.text(note, 0.0, r + 6.0, fitting, text_anchor="middle", fill=palette.GREY)

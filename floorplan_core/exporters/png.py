"""The paper's three figures as PNG: (a) planes and points, (b) occupancy, (c) the semantic plan.

Top views in the manhattan frame, 1600 pixels on the longer side, all three to the same scale.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Self

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters.palette import rgb
from floorplan_core.exporters.placement import Line, Placed, block_size, place
from floorplan_core.exporters.png_canvas import (
    AIR,
    BAR_SHARE,
    NARROW,
    ROW,
    Colour,
    Swatch,
    View,
    draw_block,
    draw_caption,
    draw_dashed,
    draw_rings,
    draw_scale_bar,
    finish,
    fit_view,
    paper,
    save,
)
from floorplan_core.exporters.walls import Opening, Poche, poche, predicted_cells
from floorplan_core.model import FREE, FloorPlan, Region
from floorplan_core.model.floor_plan import regions_mask

WHITE, BLACK = (255, 255, 255), (0, 0, 0)
INK = rgb("#1f2933")
RED, GREEN, DIM = (205, 25, 30), (14, 122, 52), (190, 196, 202)
RED_LINE, GREEN_LINE = (238, 150, 150), (140, 200, 158)
FREE_KNOWN, FREE_GUESSED, OUTLINE = WHITE, (150, 150, 150), (45, 115, 255)
ROOM, CORRIDOR, OTHER, DOOR = rgb("#9fe3ec"), rgb("#f2b3d9"), rgb("#ddd6bd"), rgb("#ffd400")
LABELS = ("room", "corridor")
FLOORS = (ROOM, CORRIDOR, OTHER)

DOT, DOT_STEP = 4, 10  # pixels: dotted planes
POINT = 3  # pixels
HATCH, HATCH_STEP = 3, 12  # pixels: predicted floor
LIGHTER = 0.7  # how far predicted floor goes towards white
WALL_LINE = 4  # pixels
SHUT_LEAF = 3  # pixels
DOOR_DEPTH = 0.25  # metres: drawn at least so deep
NAME, AREA, PAD = 30, 17, 5  # pixels


class _Figure:
    """What the three exporters share."""

    def __init__(self, style: DrawingStyle = PLAIN) -> None:
        self.style = style

    def styled(self, style: DrawingStyle) -> Self:
        """The exporter of figures in these units, in this language."""
        return type(self)(style)


class PlanesPngExporter(_Figure):
    """Writes figure (a), ``planes.png``."""

    name = "Planes PNG"
    suffixes: tuple[str, ...] = (".planes.png",)
    description = (
        "Figure (a): layout planes as red (x) and green (y) dotted lines over their observed points."
    )

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the picture of ``plan`` to ``path``."""
        save(planes_image(plan, style=self.style), path)


class OccupancyPngExporter(_Figure):
    """Writes figure (b), ``occupancy.png``."""

    name = "Occupancy PNG"
    suffixes: tuple[str, ...] = (".occupancy.png",)
    description = "Figure (b): known free white, speculated free grey, the rest black, the plan outlined."

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the picture of ``plan`` to ``path``."""
        save(occupancy_image(plan, style=self.style), path)


class PlanPngExporter(_Figure):
    """Writes figure (c), ``plan.png``."""

    name = "PNG"
    suffixes: tuple[str, ...] = (".png",)
    description = "Figure (c): rooms cyan, corridors magenta, doors yellow, regions numbered, areas."

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the picture of ``plan`` to ``path``."""
        save(plan_image(plan, style=self.style), path)


def planes_image(plan: FloorPlan, view: View | None = None, style: DrawingStyle = PLAIN) -> Image.Image:
    """Figure (a)."""
    view = view or fit_view(plan.bounds)
    codes, colours = paper(view), (WHITE, RED_LINE, GREEN_LINE, DIM, RED, GREEN)
    shown = [p for p in plan.planes if p.by_hand != "hidden"]
    for plane in shown:
        _dotted(codes, view, plane.facing.axis, plane.offset, 1 + plane.facing.axis)
    points = plan.wall_points
    kind = np.where(points.facing < 0, 3, 4 + points.facing // 2)
    for code in (3, 4, 5):
        _dots(codes, view, points.xy[kind == code], code)
    image, draw = finish(codes, colours, view)
    count = [sum(p.facing.axis == axis for p in shown) for axis in (0, 1)]
    x, y = style.say("x planes ({})", count[0]), style.say("y planes ({})", count[1])
    _draw_strip(draw, view, [(x, RED), (y, GREEN), (style.say("other points"), DIM)], INK, style)
    return image


def occupancy_image(plan: FloorPlan, view: View | None = None, style: DrawingStyle = PLAIN) -> Image.Image:
    """Figure (b)."""
    view = view or fit_view(plan.bounds)
    grid = plan.grid
    state = np.where(grid.states == FREE, 1, np.where(regions_mask(plan.regions, grid), 2, 0)).astype(
        np.uint8
    )
    codes = view.sample(state, grid.origin, grid.cell, 0)
    image, draw = finish(codes, (BLACK, FREE_KNOWN, FREE_GUESSED), view)
    for region in plan.regions:
        draw_rings(draw, view, region.polygon, OUTLINE, WALL_LINE - 1)
    entries = [("free, known", FREE_KNOWN), ("free, speculated", FREE_GUESSED), ("plan", OUTLINE)]
    _draw_strip(draw, view, [(style.say(text), sign) for text, sign in entries], WHITE, style)
    return image


def plan_image(plan: FloorPlan, view: View | None = None, style: DrawingStyle = PLAIN) -> Image.Image:
    """Figure (c)."""
    view = view or fit_view(plan.bounds)
    walls = poche(plan)
    doors = shapely.STRtree([opening.polygon for opening in walls.openings])
    names = [_place_name(view, region, doors, style) for region in plan.regions]
    image, draw = finish(_ground(plan, view, walls, names), _ground_colours(), view)
    for region in plan.regions:
        _draw_sides(draw, view, region)
    for opening in walls.openings:
        _draw_door(draw, view, opening)
    for placed in names:
        draw_block(draw, placed, INK)
    _draw_strip(draw, view, _plan_legend(plan, style), INK, style)
    return image


def _plan_legend(plan: FloorPlan, style: DrawingStyle) -> list[tuple[str, Any]]:
    """Words and swatches: those of what the plan has."""
    entries: list[tuple[str, Any]] = [("room", ROOM), ("corridor", CORRIDOR), ("door", DOOR)]
    if any(door.shut for door in plan.doors):
        entries.append(("shut door", Swatch(DOOR, "leaf")))
    if any(region.speculated_fraction > 0 for region in plan.regions):
        entries.append(("predicted", Swatch(ROOM, "hatched")))
    if any(side.speculated for region in plan.regions for side in region.sides):
        entries.append(("guessed side", Swatch(WHITE, "dashed")))
    words = [(style.say(text), sign) for text, sign in entries]
    total = style.area(sum(r.area for r in plan.regions), 1)
    return [*words, (f"{style.count(len(plan.regions), 'region')}, {total}", None)]


def _draw_strip(
    draw: Any, view: View, entries: list[tuple[str, Any]], ink: Colour, style: DrawingStyle
) -> None:
    beside = (1 - BAR_SHARE - 0.05) * view.width  # the bar
    rows = (view.width, beside) if view.width < NARROW else (beside,)
    draw_caption(draw, entries, view.height + 10 + ROW / 2, ink, rows)
    draw_scale_bar(draw, view, view.width - 24, view.height + view.strip - 10 - ROW / 2 + 10, ink, style)


def _dots(codes: NDArray[np.uint8], view: View, xy: NDArray[Any], code: int) -> None:
    """Paint points as small squares."""
    at = np.floor((xy - view.origin) * view.scale).astype(np.int64)
    for dx in range(POINT):
        for dy in range(POINT):
            x, y = at[:, 0] + dx, at[:, 1] + dy
            ok = (x >= 0) & (y >= 0) & (x < view.width) & (y < view.height)
            codes[y[ok], x[ok]] = code


def _dotted(codes: NDArray[np.uint8], view: View, axis: int, offset: float, code: int) -> None:
    """A dotted line across the whole picture."""
    at = int(np.floor((offset - view.origin[axis]) * view.scale))
    lines = np.swapaxes(codes, 0, 1) if axis == 0 else codes
    if 0 <= at < len(lines):
        for i in range(DOT):
            lines[max(0, at - 1) : at + 1, i::DOT_STEP] = code


def _ground(plan: FloorPlan, view: View, walls: Poche, names: Sequence[Placed]) -> NDArray[np.uint8]:
    """Codes of :func:`_ground_colours`: regions by their label; hatched where predicted; walls filled.

    Hatching leaves out the ground of the ``names``: they can be read there.
    """
    code = np.zeros((view.height, view.width), dtype=np.uint8)
    for region in plan.regions:
        window, inside = view.window(region.polygon)
        code[window][inside] = 1 + LABELS.index(region.label) if region.label in LABELS else len(FLOORS)
    rows, columns = np.indices(code.shape, sparse=True)
    gap = (rows + columns) % HATCH_STEP >= HATCH
    pale = view.sample(predicted_cells(plan), plan.grid.origin, plan.grid.cell, False) & gap
    for placed in names:
        pale[_text_window(view, placed)] = False
    code[pale & (code > 0)] += len(FLOORS)
    for wall in shapely.get_parts(walls.observed):
        if wall.geom_type == "Polygon":
            window, inside = view.window(wall)
            code[window][inside] = 2 * len(FLOORS) + 1
    return code


def _ground_colours() -> list[Colour]:
    """The paper, the floors, the same floors lighter, the walls."""
    lighter = [(_lighter(r), _lighter(g), _lighter(b)) for r, g, b in FLOORS]
    return [WHITE, *FLOORS, *lighter, INK]


def _text_window(view: View, placed: Placed) -> tuple[slice, slice]:
    """Rows and columns under a name, row 0 lowest."""
    width, height = block_size(placed.lines)[:: -1 if placed.turned else 1]
    half, y = (width / 2 + AIR, height / 2 + AIR), view.height - placed.y
    return (
        slice(max(0, round(y - half[1])), max(0, round(y + half[1]))),
        slice(max(0, round(placed.x - half[0])), max(0, round(placed.x + half[0]))),
    )


def _lighter(channel: int) -> int:
    return round(channel + LIGHTER * (255 - channel))


def _draw_sides(draw: Any, view: View, region: Region) -> None:
    """Walls as lines; guessed sides dashed."""
    if not region.sides:
        draw_rings(draw, view, region.polygon, INK, WALL_LINE)
    for side in region.sides:
        a, b = view.pixels(np.array([side.start, side.end])).round()
        if side.speculated:
            draw_dashed(draw, a, b, INK, WALL_LINE)
        else:
            draw.line([tuple(a), tuple(b)], fill=INK, width=WALL_LINE)


def _draw_door(draw: Any, view: View, opening: Opening) -> None:
    """A yellow box as deep as the wall, or as can be seen; openings without a leaf have no outline."""
    door = opening.door
    low, high = view.pixels(opening.faces.reshape(4, 2)).reshape(2, 2, 2)
    depth = float(np.hypot(*(high - low)[0]))
    grown = max(0.0, view.scale * DOOR_DEPTH - depth) / 2 / max(depth, 1e-9) * (high - low)
    a, b, c, d = (tuple(p) for p in np.concatenate([low - grown, (high + grown)[::-1]]).round().tolist())
    draw.polygon([a, b, c, d], fill=DOOR, outline=INK if door.kind == "door" else None)
    if door.shut:  # its leaf, across the opening
        middle = opening.faces.mean(axis=0)
        draw.line([tuple(p) for p in view.pixels(middle).round().tolist()], fill=INK, width=SHUT_LEAF)


def _place_name(view: View, region: Region, doors: shapely.STRtree, style: DrawingStyle) -> Placed:
    """The number or name, and the area where there is room for it, off the doors."""
    near = doors.geometries[np.sort(doors.query(region.polygon, predicate="intersects"))]
    rest = region.polygon.difference(shapely.union_all(near)) if len(near) else region.polygon
    free = max(shapely.get_parts(rest), key=lambda part: part.area, default=region.polygon)
    lines = (Line(region.name, NAME, "name"), Line(style.area(region.area, 1), AREA, "area"))
    floor = shapely.transform(region.polygon, view.pixels)
    return place(lines, shapely.transform(free, view.pixels), PAD, floor)

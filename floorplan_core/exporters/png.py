"""The paper's three figures as PNG: (a) planes and points, (b) occupancy, (c) the semantic plan.

Top views in the manhattan frame, 1600 pixels on the longer side, all three to the same scale.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image

from floorplan_core.exporters.palette import rgb
from floorplan_core.exporters.placement import LEADING, Line, block_size, place
from floorplan_core.exporters.png_canvas import (
    ROW,
    Colour,
    View,
    draw_caption,
    draw_dashed,
    draw_rings,
    draw_scale_bar,
    draw_text,
    finish,
    fit_view,
    paper,
    plan_bounds,
    save,
)
from floorplan_core.exporters.walls import predicted_cells
from floorplan_core.model import FREE, Door, FloorPlan, Region
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
DOOR_DEPTH = 0.25  # metres: a door without a known thickness
NAME, AREA, PAD = 30, 17, 5  # pixels


class PlanesPngExporter:
    """Writes figure (a), ``planes.png``."""

    name = "Planes PNG"
    suffixes: tuple[str, ...] = (".planes.png",)
    description = (
        "Figure (a): layout planes as red (x) and green (y) dotted lines over their observed points."
    )

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the picture of ``plan`` to ``path``."""
        save(planes_image(plan), path)


class OccupancyPngExporter:
    """Writes figure (b), ``occupancy.png``."""

    name = "Occupancy PNG"
    suffixes: tuple[str, ...] = (".occupancy.png",)
    description = "Figure (b): known free white, speculated free grey, the rest black, the plan outlined."

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the picture of ``plan`` to ``path``."""
        save(occupancy_image(plan), path)


class PlanPngExporter:
    """Writes figure (c), ``plan.png``."""

    name = "PNG"
    suffixes: tuple[str, ...] = (".png",)
    description = "Figure (c): rooms cyan, corridors magenta, doors yellow, regions numbered, areas."

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the picture of ``plan`` to ``path``."""
        save(plan_image(plan), path)


def planes_image(plan: FloorPlan, view: View | None = None) -> Image.Image:
    """Figure (a)."""
    view = view or fit_view(plan_bounds(plan))
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
    entries = [(f"x planes ({count[0]})", RED), (f"y planes ({count[1]})", GREEN), ("other points", DIM)]
    _draw_strip(draw, view, entries, INK)
    return image


def occupancy_image(plan: FloorPlan, view: View | None = None) -> Image.Image:
    """Figure (b)."""
    view = view or fit_view(plan_bounds(plan))
    grid = plan.grid
    state = np.where(grid.states == FREE, 1, np.where(regions_mask(plan.regions, grid), 2, 0)).astype(
        np.uint8
    )
    codes = view.sample(state, grid.origin, grid.cell, 0)
    image, draw = finish(codes, (BLACK, FREE_KNOWN, FREE_GUESSED), view)
    for region in plan.regions:
        draw_rings(draw, view, region.polygon, OUTLINE, WALL_LINE - 1)
    entries = [("free, known", FREE_KNOWN), ("free, speculated", FREE_GUESSED), ("plan", OUTLINE)]
    _draw_strip(draw, view, entries, WHITE)
    return image


def plan_image(plan: FloorPlan, view: View | None = None) -> Image.Image:
    """Figure (c)."""
    view = view or fit_view(plan_bounds(plan))
    image, draw = finish(_floors(plan, view), _floor_colours(), view)
    for region in plan.regions:
        _draw_sides(draw, view, region)
    for door in plan.doors:
        _draw_door(draw, view, door)
    for region in plan.regions:
        _draw_name(draw, view, region)
    total = sum(r.area for r in plan.regions)
    entries: list[tuple[str, Colour | None]] = [("room", ROOM), ("corridor", CORRIDOR), ("door", DOOR)]
    entries += [("hatched: predicted", None), (f"{len(plan.regions)} regions, {total:.1f} m²", None)]
    _draw_strip(draw, view, entries, INK)
    return image


def _draw_strip(draw: Any, view: View, entries: list[tuple[str, Any]], ink: Colour) -> None:
    draw_caption(draw, entries, view.height + 10 + ROW / 2, ink)
    draw_scale_bar(draw, view, view.width - 24, view.height + view.strip - 10 - ROW / 2 + 10, ink)


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


def _floors(plan: FloorPlan, view: View) -> NDArray[np.uint8]:
    """Codes of :func:`_floor_colours`: regions by their label; where they are predicted, hatched."""
    code = np.zeros((view.height, view.width), dtype=np.uint8)
    for region in plan.regions:
        window, inside = view.window(region.polygon)
        code[window][inside] = 1 + LABELS.index(region.label) if region.label in LABELS else len(FLOORS)
    rows, columns = np.indices(code.shape, sparse=True)
    gap = (rows + columns) % HATCH_STEP >= HATCH
    pale = view.sample(predicted_cells(plan), plan.grid.origin, plan.grid.cell, False) & gap
    code[pale & (code > 0)] += len(FLOORS)
    return code


def _floor_colours() -> list[Colour]:
    """The ground, the floors, and the same floors lighter."""
    lighter = [(_lighter(r), _lighter(g), _lighter(b)) for r, g, b in FLOORS]
    return [WHITE, *FLOORS, *lighter]


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


def _draw_door(draw: Any, view: View, door: Door) -> None:
    """A yellow box in the wall; openings without a leaf have no outline."""
    half = max(door.thickness, DOOR_DEPTH) / 2
    ink = INK if door.kind == "door" else None
    if door.turn:
        a, b = door.line()
        across = half * np.array([a[1] - b[1], b[0] - a[0]]) / door.width
        corners = view.pixels(np.array([a - across, b - across, b + across, a + across])).round()
        draw.polygon([tuple(p) for p in corners.tolist()], fill=DOOR, outline=ink)
    else:
        low, high = door.line() - half, door.line() + half
        low[:, 1 - door.axis], high[:, 1 - door.axis] = door.start, door.end
        (x0, y1), (x1, y0) = view.pixels(np.array([low[0], high[1]])).round().tolist()
        draw.rectangle([x0, y0, x1, y1], fill=DOOR, outline=ink, width=1)
    if door.shut:  # its leaf, across the opening
        draw.line([tuple(p) for p in view.pixels(door.line()).round().tolist()], fill=INK, width=SHUT_LEAF)


def _draw_name(draw: Any, view: View, region: Region) -> None:
    """The number or name, and the area where there is room for it."""
    floor = shapely.transform(region.polygon, view.pixels)
    lines = (Line(region.name, NAME, "name"), Line(f"{region.area:.1f} m²", AREA, "area"))
    placed = place(lines, floor, PAD)
    top = placed.y - block_size(placed.lines)[1] / 2
    for line in placed.lines:
        draw_text(draw, (placed.x, top + line.size * LEADING / 2), line.text, round(line.size), INK, 0.5)
        top += line.size * LEADING

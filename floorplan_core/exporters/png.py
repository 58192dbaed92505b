"""The paper's three figures as PNG: (a) planes and points, (b) occupancy, (c) the semantic plan.

Top views in the manhattan frame, 1600 pixels on the longer side, all three to the same scale.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from floorplan_core.exporters.palette import rgb
from floorplan_core.exporters.png_canvas import (
    STRIP,
    Colour,
    View,
    draw_caption,
    draw_dashed,
    draw_rings,
    draw_scale_bar,
    finish,
    fit_view,
    font,
    paper,
    plan_bounds,
    save,
)
from floorplan_core.model import FREE, Door, FloorPlan, Region
from floorplan_core.model.floor_plan import regions_mask

WHITE, BLACK = (255, 255, 255), (0, 0, 0)
INK = rgb("#1f2933")
RED, GREEN, DIM = (214, 39, 40), (22, 138, 62), (188, 194, 200)
FREE_KNOWN, FREE_GUESSED, OUTLINE = WHITE, (150, 150, 150), (45, 115, 255)
ROOM, CORRIDOR, OTHER, DOOR = rgb("#9fe3ec"), rgb("#f2b3d9"), rgb("#ddd6bd"), rgb("#ffd400")
FLOORS = {"room": ROOM, "corridor": CORRIDOR}

DOT, DOT_STEP = 4, 10  # pixels: dotted planes
POINT = 2  # pixels
HATCH, HATCH_STEP = 2, 12  # pixels: predicted floor
LIGHTER = 0.55  # how far predicted floor goes towards white
WALL_LINE = 4  # pixels
DOOR_DEPTH = 0.25  # metres: a door without a known thickness
NAME, AREA, SMALLEST = 30, 17, 10  # pixels


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
    pixels = paper(view, WHITE)
    points = plan.wall_points
    for colour, chosen in (
        (DIM, points.facing < 0),
        (RED, (points.facing == 0) | (points.facing == 1)),
        (GREEN, points.facing >= 2),
    ):
        _dots(pixels, view, points.xy[chosen], colour)
    for plane in plan.planes:
        _dotted(pixels, view, plane.facing.axis, plane.offset, RED if plane.facing.axis == 0 else GREEN)
    image, draw = finish(pixels, WHITE)
    count = [sum(p.facing.axis == axis for p in plan.planes) for axis in (0, 1)]
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
    colours = np.array([BLACK, FREE_KNOWN, FREE_GUESSED], dtype=np.uint8)
    image, draw = finish(colours[view.sample(state, grid.origin, grid.cell, 0)], BLACK)
    for region in plan.regions:
        draw_rings(draw, view, region.polygon, OUTLINE, WALL_LINE - 1)
    entries = [("free, known", FREE_KNOWN), ("free, speculated", FREE_GUESSED), ("plan", OUTLINE)]
    _draw_strip(draw, view, entries, WHITE)
    return image


def plan_image(plan: FloorPlan, view: View | None = None) -> Image.Image:
    """Figure (c)."""
    view = view or fit_view(plan_bounds(plan))
    image, draw = finish(_floors(plan, view), WHITE)
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
    draw_caption(draw, entries, view.height + STRIP / 2, ink)
    draw_scale_bar(draw, view, view.width - 24, view.height + STRIP / 2 + 10, ink)


def _dots(pixels: NDArray[np.uint8], view: View, xy: NDArray[Any], colour: Colour) -> None:
    """Paint points as small squares."""
    at = np.floor((xy - view.origin) * view.scale).astype(np.int64)
    for dx in range(POINT):
        for dy in range(POINT):
            x, y = at[:, 0] + dx, at[:, 1] + dy
            ok = (x >= 0) & (y >= 0) & (x < view.width) & (y < view.height)
            pixels[y[ok], x[ok]] = colour


def _dotted(pixels: NDArray[np.uint8], view: View, axis: int, offset: float, colour: Colour) -> None:
    """A dotted line across the whole picture."""
    at = int(np.floor((offset - view.origin[axis]) * view.scale))
    lines = np.swapaxes(pixels, 0, 1) if axis == 0 else pixels
    if 0 <= at < len(lines):
        for i in range(DOT):
            lines[max(0, at - 1) : at + 1, i::DOT_STEP] = colour


def _floors(plan: FloorPlan, view: View) -> NDArray[np.uint8]:
    """Regions in the colour of their label; where they are predicted, lighter and hatched."""
    pixels = paper(view, WHITE)
    seen = view.sample(plan.grid.states == FREE, plan.grid.origin, plan.grid.cell, False)
    rows, columns = np.indices((view.height, view.width), sparse=True)
    hatch = (rows + columns) % HATCH_STEP < HATCH
    for region in plan.regions:
        colour = FLOORS.get(region.label, OTHER)
        inside = view.mask(region.polygon)
        pale = tuple(round(c + LIGHTER * (255 - c)) for c in colour)
        pixels[inside] = colour
        pixels[inside & ~seen & ~hatch] = pale
    return pixels


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
    low, high = door.line() - half, door.line() + half
    axis = door.axis
    low[:, 1 - axis], high[:, 1 - axis] = door.start, door.end
    (x0, y1), (x1, y0) = view.pixels(np.array([low[0], high[1]])).round().tolist()
    draw.rectangle([x0, y0, x1, y1], fill=DOOR, outline=INK if door.kind == "door" else None, width=1)


def _draw_name(draw: Any, view: View, region: Region) -> None:
    """The number or name, and the area where there is room, at a point well inside."""
    x, y = view.pixels(np.array(_anchor(region)))[0].tolist()
    x0, y0, x1, y1 = region.polygon.bounds
    room = 0.8 * min(x1 - x0, 3 * (y1 - y0)) * view.scale
    area = f"{region.area:.1f} m²"
    sizes = [_fitting(draw, text, size, room) for text, size in ((region.name, NAME), (area, AREA))]
    if sizes[1] >= SMALLEST and sizes[0] + sizes[1] + 8 < 0.8 * (y1 - y0) * view.scale:
        draw.text((x, y), region.name, fill=INK, font=font(sizes[0]), anchor="mb")
        draw.text((x, y + 6), area, fill=INK, font=font(sizes[1]), anchor="mt")
    else:
        draw.text((x, y), region.name, fill=INK, font=font(max(sizes[0], SMALLEST)), anchor="mm")


def _anchor(region: Region) -> tuple[float, float]:
    """The centroid, or the pole of inaccessibility where the centroid lies outside."""
    import shapely

    point = region.polygon.centroid
    if not region.polygon.contains(point):
        circle = shapely.maximum_inscribed_circle(region.polygon, tolerance=0.05)
        return float(circle.coords[0][0]), float(circle.coords[0][1])
    return float(point.x), float(point.y)


def _fitting(draw: Any, text: str, size: int, room: float) -> int:
    """The font size at which ``text`` is no wider than ``room`` pixels."""
    width = draw.textlength(text, font=font(size))
    return size if width <= room else int(size * room / width)

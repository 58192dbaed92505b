"""A plan with its truth on top: what is wrong with a survey, at one glance."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from floorplan_core.evaluation.compare import inverse
from floorplan_core.evaluation.doors import match_doors
from floorplan_core.evaluation.plan_file import PlanFile
from floorplan_core.evaluation.truth import Truth

LONG_SIDE, MARGIN, HEADER, OVERSAMPLING = 1500, 40, 96, 2  # pixels of the finished picture
HATCH = 0.25  # m
INK, PAPER, TRUTH, GUESS = (38, 44, 52), (255, 255, 255), (205, 40, 60), (120, 128, 138)
FILL = {"room": (214, 238, 242), "corridor": (243, 220, 238)}
OTHER = (232, 232, 226)
FOUND, MISSED, FALSE, OPTIONAL = (30, 140, 80), (205, 40, 60), (240, 140, 0), (150, 156, 164)
LOST, HIDDEN = (252, 226, 226), (240, 240, 238)
FREE, WALL = (206, 232, 208), (90, 60, 60)
Colour = tuple[int, int, int]
PLAN_LEGEND = (
    ("plan", INK),
    ("truth", TRUTH),
    ("door found", FOUND),
    ("door missed", MISSED),
    ("false door", FALSE),
    ("shut door, window", OPTIONAL),
    ("floor missed: pink, never seen: grey, predicted: hatched", GUESS),
)
OBSERVED_LEGEND = (
    ("plan and its doors", INK),
    ("carved free by the sensor", FOUND),
    ("surface above furniture", WALL),
    ("predicted: hatched", GUESS),
)


class Canvas:
    """Draws metres: y up, oversampled."""

    def __init__(self, bounds: tuple[float, float, float, float]) -> None:
        x0, y0, x1, y1 = bounds
        self.scale = OVERSAMPLING * (LONG_SIDE - 2 * MARGIN) / max(x1 - x0, y1 - y0, 1e-6)
        self.left, self.top = x0, y1
        width = round((x1 - x0) * self.scale) + 2 * MARGIN * OVERSAMPLING
        height = round((y1 - y0) * self.scale) + (2 * MARGIN + HEADER) * OVERSAMPLING
        self.image = Image.new("RGB", (max(width, 900 * OVERSAMPLING), height), PAPER)
        self.draw = ImageDraw.Draw(self.image)

    def pixels(self, xy: Any) -> list[tuple[float, float]]:
        """(N, 2) metres to picture coordinates."""
        points = np.asarray(xy, dtype=float)[:, :2]
        x = (points[:, 0] - self.left) * self.scale + MARGIN * OVERSAMPLING
        y = (self.top - points[:, 1]) * self.scale + (MARGIN + HEADER) * OVERSAMPLING
        return list(zip(x.tolist(), y.tolist(), strict=True))

    def polygon(self, shape: Any, fill: Colour) -> None:
        """Filled; holes keep what is under them."""
        mask = Image.new("1", self.image.size)
        draw = ImageDraw.Draw(mask)
        draw.polygon(self.pixels(shape.exterior.coords), fill=1)
        for hole in shape.interiors:
            draw.polygon(self.pixels(hole.coords), fill=0)
        self.image.paste(fill, (0, 0), mask)

    def outline(self, shape: Any, color: Colour, width: float) -> None:
        """All rings of a polygon."""
        for ring in (shape.exterior, *shape.interiors):
            self.line(ring.coords, color, width)

    def line(self, xy: Any, color: Colour, width: float) -> None:
        """A polyline, ``width`` in finished pixels."""
        self.draw.line(self.pixels(xy), fill=color, width=round(width * OVERSAMPLING), joint="curve")

    def text(
        self, at: tuple[float, float], text: str, size: int, color: Any = INK, anchor: str = "la"
    ) -> None:
        """At finished pixels from the top left."""
        font = ImageFont.load_default(size=size * OVERSAMPLING)
        self.draw.text(
            (at[0] * OVERSAMPLING, at[1] * OVERSAMPLING), text, fill=color, font=font, anchor=anchor
        )

    def save(self, path: Path) -> None:
        """Write the PNG at its finished size."""
        size = self.image.width // OVERSAMPLING, self.image.height // OVERSAMPLING
        self.image.resize(size, Image.Resampling.BOX).save(path, optimize=True)


def draw_overlay(plan: PlanFile, truth: Truth, title: str, remark: str, path: Path) -> None:
    """Regions filled by label, truth as thin outlines, doors by whether they are right."""
    local = plan.moved(inverse(truth.world_from_building))
    canvas = Canvas(_bounds(local, truth))
    _observed(canvas, truth)
    for room in truth.rooms:
        canvas.polygon(room.polygon, HIDDEN if room.exposure == "hidden" else LOST)
    for region in local.regions:
        for part in getattr(region.polygon, "geoms", [region.polygon]):
            canvas.polygon(part, FILL.get(region.label, OTHER))
    _hatch(canvas, local.speculated)
    for region in local.regions:
        for part in getattr(region.polygon, "geoms", [region.polygon]):
            canvas.outline(part, INK, 2.4)
    for room in truth.rooms:
        canvas.outline(room.polygon, TRUTH, 1.0 if room.exposure == "entered" else 0.6)
    _doors(canvas, local, truth)
    _names(canvas, local)
    _header(canvas, title, remark, PLAN_LEGEND if truth.observed is None else OBSERVED_LEGEND)
    _scale_bar(canvas)
    canvas.save(path)


def _bounds(plan: PlanFile, truth: Truth) -> tuple[float, float, float, float]:
    import shapely

    shapes = [r.polygon for r in plan.regions] + [r.polygon for r in truth.rooms]
    shapes += [shapely.box(*d.bounds) for d in truth.doors]
    boxes = np.array([shapely.bounds(s) for s in shapes]).reshape(-1, 4)
    if truth.observed is not None:
        (ny, nx), cell, origin = truth.observed.free.shape, truth.observed.cell, truth.observed.origin
        boxes = np.vstack([boxes, [*origin, *(origin + cell * np.array([nx, ny]))]])
    if not len(boxes):
        return 0.0, 0.0, 1.0, 1.0
    lo, hi = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
    return float(lo[0]), float(lo[1]), float(hi[0]), float(hi[1])


def _observed(canvas: Canvas, truth: Truth) -> None:
    """What a real sensor saw, under the plan; nothing for surveys with a true plan."""
    if truth.observed is None:
        return
    grid, half = truth.observed, 0.5 * truth.observed.cell
    for mask, color in ((grid.free, FREE), (grid.wall, WALL)):
        rows, columns = np.nonzero(mask)
        centres = np.column_stack([columns, rows]) * grid.cell + grid.origin + half
        low, high = canvas.pixels(centres - half), canvas.pixels(centres + half)
        for (x0, y0), (x1, y1) in zip(low, high, strict=True):
            canvas.draw.rectangle((x0, y1, x1, y0), fill=color)


def _hatch(canvas: Canvas, area: Any) -> None:
    """Predicted floor: diagonal lines, ``HATCH`` metres apart."""
    import shapely

    if area.is_empty:
        return
    x0, y0, x1, y1 = area.bounds
    starts = np.arange(x0 - (y1 - y0), x1, HATCH)
    lines = shapely.linestrings([[(s, y0), (s + y1 - y0, y1)] for s in starts])
    for part in shapely.get_parts(shapely.intersection(lines, area)):
        for line in shapely.get_parts(part):
            if line.geom_type == "LineString" and not line.is_empty:
                canvas.line(line.coords, GUESS, 0.6)


def _doors(canvas: Canvas, plan: PlanFile, truth: Truth) -> None:
    matches = match_doors(plan.doors, truth.doors)
    found, right = {m.truth for m in matches}, {m.plan for m in matches}
    for i, door in enumerate(truth.doors):
        x0, y0, x1, y1 = door.bounds
        color = FOUND if i in found and door.kind != "window" else MISSED if door.required else OPTIONAL
        canvas.line([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)], color, 1.4)
    for i, door in enumerate(plan.doors):
        known = INK if truth.observed is not None else FALSE  # carved space knows no doors
        canvas.line(door.line, FOUND if i in right else known, 4.0)


def _names(canvas: Canvas, plan: PlanFile) -> None:
    for region in plan.regions:
        point = region.polygon.representative_point()
        ((x, y),) = canvas.pixels([(point.x, point.y)])
        canvas.text((x / OVERSAMPLING, y / OVERSAMPLING), region.name, 15, anchor="mm")


def _header(canvas: Canvas, title: str, remark: str, legend: tuple[tuple[str, Colour], ...]) -> None:
    canvas.text((MARGIN, 22), title, 22)
    canvas.text((MARGIN, 54), remark, 14, GUESS)
    x = MARGIN
    for word, color in legend:
        canvas.text((x, 78), word, 13, color)
        x += 24 + round(canvas.draw.textlength(word, font=ImageFont.load_default(size=13)))


def _scale_bar(canvas: Canvas) -> None:
    """A bar of about a tenth of the picture, in round metres, at the top right."""
    pixels = canvas.scale / OVERSAMPLING
    metres = next((m for m in (1, 2, 5, 10, 20, 50) if m * pixels >= 0.08 * LONG_SIDE), 100)
    right, y = canvas.image.width / OVERSAMPLING - MARGIN, 40
    ends = [(right - metres * pixels, y), (right, y)]
    scaled = [(a * OVERSAMPLING, b * OVERSAMPLING) for a, b in ends]
    canvas.draw.line(scaled, fill=INK, width=3 * OVERSAMPLING)
    canvas.text((right, y + 8), f"{metres} m", 13, anchor="ra")

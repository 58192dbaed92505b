"""The pictures of docs/limits.md: parts of plans, with the true rooms in red where they are known.

Made by ``docs/make_pictures.py`` from the plans of its surveys.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from PIL import Image, ImageDraw

from floorplan_core.evaluation.truths import load_truth
from floorplan_core.exporters.png import plan_image
from floorplan_core.exporters.png_canvas import View
from floorplan_core.intermediates import load
from floorplan_core.model import FloorPlan

LONG_SIDE = 640  # pixels
TRUTH, LINE = (205, 40, 60), 3  # colour, and pixels


@dataclass(frozen=True)
class Detail:
    """A part of a plan."""

    name: str  # of the picture
    survey: str
    bounds: tuple[float, float, float, float]  # x0, y0, x1, y1 metres, manhattan frame


DETAILS = (
    Detail("limits-label", "intel", (-15.3, -4.4, -9.9, 3.4)),
    Detail("limits-kitchen", "duplex", (-2.8, -12.8, 5.9, -4.6)),
    Detail("limits-stairs", "duplex", (3.2, -6.9, 5.9, -2.4)),
    Detail("limits-balcony", "house", (-3.6, -7.6, 9.2, 4.3)),
    Detail("limits-pair", "fr079", (3.6, -7.3, 21.2, 7.1)),
    Detail("limits-hall", "intel", (-3.5, 3.6, 14.0, 17.7)),
)


def draw_details(survey: str, folder: Path, truth: Path | None, images: Path) -> None:
    """The details of a survey, whose plan is in ``folder``, as pictures in ``images``."""
    for detail in (d for d in DETAILS if d.survey == survey):
        plan = load(folder / "plan.floorplan", FloorPlan)
        draw_detail(plan, detail, truth).save(images / f"{detail.name}.png", optimize=True)


def draw_detail(plan: FloorPlan, detail: Detail, truth: Path | None) -> Image.Image:
    """The plan within the bounds of a detail, and the rooms of ``truth``."""
    x0, y0, x1, y1 = detail.bounds
    scale = LONG_SIDE / max(x1 - x0, y1 - y0)
    view = View(x0, y0, scale, round((x1 - x0) * scale), round((y1 - y0) * scale))
    image = plan_image(plan, view).crop((0, 0, view.width, view.height))  # without legend
    draw = ImageDraw.Draw(image)
    for ring in true_rings(plan, truth) if truth else []:
        draw.line([tuple(p) for p in view.pixels(ring).tolist()], fill=TRUTH, width=LINE, joint="curve")
    return image


def true_rings(plan: FloorPlan, file: Path) -> list[np.ndarray]:
    """The outlines of the true rooms, in the plan's frame; none where only free space is known."""
    truth = load_truth(file)
    to_plan = plan.manhattan_from_world
    rings = []
    for room in truth.rooms:
        xy = shapely.get_coordinates(room.polygon.exterior)
        world = xy @ truth.world_from_building[:, :2].T + truth.world_from_building[:, 2]
        rings.append(world @ to_plan[:2, :2].T + to_plan[:2, 3])
    return rings

"""A film strip of an online run, like the paper's online figures: one column for each plan, all to one scale.

Above, what was known when the plan was made (occupancy); below, the plan. Columns share their coordinates as
far as their frames agree, so that growth is seen at a glance.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.errors import UsageError
from floorplan_core.exporters.png import INK, WHITE, occupancy_image, plan_image
from floorplan_core.exporters.png_canvas import Bounds, View, draw_text, face, fit_view, save
from floorplan_core.model import FloorPlan

MUTED = (84, 96, 108)
FRAME = (205, 210, 215)
PANEL = 760  # pixels, longer side of one panel
GAP = 28  # pixels
TITLE = 84  # pixels above the panels
HEADING, FACTS = 30, 23  # pixels of text: a strip of four is looked at at half its size
COLUMNS = 4  # columns before a new row begins
TURNED = np.deg2rad(2.0)  # frames that differ more do not share coordinates


def filmstrip_png(
    plans: Sequence[FloorPlan], titles: Sequence[str], path: Path, style: DrawingStyle = PLAIN
) -> None:
    """Write the film strip of ``plans``, each under its title; :class:`UsageError` where there are none."""
    save(filmstrip_image(plans, titles, style), path)


def filmstrip_image(
    plans: Sequence[FloorPlan], titles: Sequence[str], style: DrawingStyle = PLAIN
) -> Image.Image:
    """The picture; as many titles as plans."""
    if not plans or len(plans) != len(titles):
        raise UsageError(
            f"A film strip needs plans with titles; got {len(plans)} plans, {len(titles)} titles."
        )
    views = _views(plans)
    columns = [
        _column(plan, title, view, style) for plan, title, view in zip(plans, titles, views, strict=True)
    ]
    width, height = (max(c.size[i] for c in columns) + GAP for i in (0, 1))
    across = min(COLUMNS, len(columns))
    down = -(-len(columns) // across)
    sheet = Image.new("RGB", (across * width + GAP, down * height + GAP), WHITE)
    for i, column in enumerate(columns):
        sheet.paste(column, (GAP + (i % across) * width, GAP + (i // across) * height))
    return sheet


def _views(plans: Sequence[FloorPlan]) -> list[View]:
    """The same view for all plans whose frame agrees with the last one's; others keep its size."""
    last = plans[-1]
    together = [p for p in plans if _agrees(p, last)]
    bounds = np.array([p.bounds for p in together])
    common = _tuple([*bounds[:, :2].min(axis=0), *bounds[:, 2:].max(axis=0)])
    shared = fit_view(common, PANEL)
    return [shared if _agrees(p, last) else _centred(p.bounds, shared) for p in plans]


def _tuple(values: Sequence[float]) -> Bounds:
    x0, y0, x1, y1 = (float(v) for v in values)
    return x0, y0, x1, y1


def _agrees(plan: FloorPlan, other: FloorPlan) -> bool:
    """True where the two manhattan frames differ by less than ``TURNED``."""
    cosine = (np.trace(plan.frame.rotation @ other.frame.rotation.T) - 1) / 2
    return bool(np.arccos(np.clip(cosine, -1, 1)) < TURNED)


def _centred(bounds: Bounds, like: View) -> View:
    x0, y0, x1, y1 = bounds
    left = (x0 + x1) / 2 - like.width / like.scale / 2
    low = (y0 + y1) / 2 - like.height / like.scale / 2
    return View(left, low, like.scale, like.width, like.height)


def _column(plan: FloorPlan, title: str, view: View, style: DrawingStyle) -> Image.Image:
    """Title, occupancy, plan."""
    area = (0, 0, view.width, view.height)
    upper = occupancy_image(plan, view, style).crop(area)
    lower = plan_image(plan, view, style).crop(area)
    column = Image.new("RGB", (view.width, TITLE + 2 * view.height + GAP), WHITE)
    column.paste(upper, (0, TITLE))
    column.paste(lower, (0, TITLE + view.height + GAP))
    draw = ImageDraw.Draw(column)
    draw.text((0, 4), title, fill=INK, font=face(title, HEADING), anchor="lt")
    free, total = (sum(getattr(r, k) for r in plan.regions) for k in ("free_cells", "total_cells"))
    seen = f", {style.say('{} % seen', f'{100 * free / total:.0f}')}" if total else ""
    total_area = style.area(sum(r.area for r in plan.regions), 1)
    facts = f"{style.count(len(plan.regions), 'region')}, {total_area}{seen}"
    draw_text(draw, (0, TITLE - 26), facts, FACTS, MUTED)
    draw.rectangle([0, TITLE + view.height + GAP, view.width - 1, column.height - 1], outline=FRAME)
    return column

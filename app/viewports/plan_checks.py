"""The rows of the ground-truth table in the plan panes: where they lie, how they are painted and hit."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter

from floorcast_app.item_bounds import check_ends
from floorcast_app.layers.hit_index import segment_distance
from floorcast_app.selection import Item
from floorcast_app.viewports.plan_frame import Frame
from floorcast_app.viewports.plan_overlay import paint_check
from floorcast_app.workbench import Workbench

LAYER = "dimensions"  # of the look, that shows them


def check_at(workbench: Workbench, x: float, y: float, reach: float) -> Item | None:
    """The measurement within ``reach`` metres of a place."""
    if LAYER not in workbench.view.look.layers:
        return None
    for check in workbench.state.checks:
        ends = check_ends(workbench, check.id)
        if ends is not None and segment_distance(np.array([[*ends[0], *ends[1]]]), x, y)[0] <= reach:
            return Item("check", check.id)
    return None


def paint_checks(painter: QPainter, frame: Frame, workbench: Workbench, taken: Sequence[QRectF]) -> None:
    """All measurements, selected and hovered ones lit up; their lengths beside what is ``taken``.

    Lengths that would hide names or each other are left out until their measurement is lit up: those come
    first, then the longest. The table has all of them.
    """
    if LAYER not in frame.look.layers:
        return
    c, selection, written = frame.colours, workbench.selection, list(taken)
    lit = (*selection.items, selection.hovered)
    shown = []
    for check in workbench.state.checks:
        ends, item = check_ends(workbench, check.id), Item("check", check.id)
        if ends is not None and frame.shows("check", check.id):
            shown.append((item not in lit, -math.dist(*ends), item, ends))
    for unlit, length, item, ends in sorted(shown, key=lambda s: s[:2]):
        tone = c.selection if item in selection.items else c.accent
        tone = c.hover if item == selection.hovered else tone
        box = paint_check(painter, frame, ends, -length, tone, written, always=not unlit)
        written += [box] if box is not None else []

"""Area of the plan against the free space of the building, and against what a real sensor carved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from floorplan_core.evaluation.plan_file import PlanFile
from floorplan_core.evaluation.truth import ObservedSpace, Truth


@dataclass(frozen=True)
class FreeSpaceScores:
    """Areas in m2; shares from 0 to 1. None where the truth cannot tell."""

    plan_m2: float
    truth_m2: float
    precision: float | None  # share of the plan's area that is free in truth
    recall: float | None  # share of the expected rooms' area that the plan has
    outside_m2: float | None  # area of the plan beyond the building's outer walls
    outside_percent: float | None  # of the plan's area
    predicted_m2: float  # predicted, not seen
    predicted_right: float | None  # share of it that is free in truth
    predicted_outside_m2: float | None


def free_space_scores(plan: PlanFile, truth: Truth) -> FreeSpaceScores:
    """Exact areas; the thresholds of true doors count as free. ``plan`` in building axes."""
    import shapely

    area = shapely.union_all([r.polygon for r in plan.regions])
    free = shapely.union_all([r.polygon for r in truth.rooms] + [shapely.box(*d.bounds) for d in truth.doors])
    expected = shapely.union_all([r.polygon for r in truth.rooms if r.exposure != "hidden"])
    building = footprint(truth)
    outside, guessed = area.difference(building).area, plan.speculated.intersection(area)
    return FreeSpaceScores(
        plan_m2=area.area,
        truth_m2=expected.area,
        precision=_share(area.intersection(free).area, area.area),
        recall=_share(area.intersection(expected).area, expected.area),
        outside_m2=outside,
        outside_percent=100.0 * outside / area.area if area.area else 0.0,
        predicted_m2=guessed.area,
        predicted_right=_share(guessed.intersection(free).area, guessed.area),
        predicted_outside_m2=guessed.difference(building).area,
    )


def _share(part: float, whole: float) -> float | None:
    return min(1.0, part / whole) if whole > 0 else None


def footprint(truth: Truth) -> Any:
    """The building to the outside of its walls: the rooms, grown by the thickest wall, small gaps closed."""
    import shapely

    inside = shapely.union_all([r.polygon for r in truth.rooms])
    grown = inside.buffer(2.0 * truth.wall, join_style="mitre")
    return grown.buffer(-truth.wall, join_style="mitre")


def observed_scores(plan: PlanFile, observed: ObservedSpace) -> FreeSpaceScores:
    """Cells of the plan against carved cells, where something was observed. ``plan`` in world axes."""
    import shapely

    area = shapely.union_all([r.polygon for r in plan.regions])
    inside, guessed = _mask(area, observed), _mask(plan.speculated, observed)
    seen, cell = observed.free | observed.wall, observed.cell**2
    return FreeSpaceScores(
        plan_m2=area.area,
        truth_m2=float(observed.free.sum()) * cell,
        precision=_share(float((inside & observed.free).sum()), float((inside & seen).sum())),
        recall=_share(float((inside & observed.free).sum()), float(observed.free.sum())),
        outside_m2=None,
        outside_percent=None,
        predicted_m2=plan.speculated.area,
        predicted_right=_share(float((guessed & observed.free).sum()), float((guessed & seen).sum())),
        predicted_outside_m2=None,
    )


def _mask(shape: Any, grid: ObservedSpace) -> Any:
    from floorplan_core.geometry.raster import polygon_mask

    if shape.is_empty:
        return np.zeros(grid.free.shape, dtype=bool)
    return polygon_mask(shape, grid.origin, grid.cell, grid.free.shape)

"""Compare a plan with a ground truth: dimensions, rooms, labels, doors, free space and frame."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from floorplan_core.evaluation import rooms as room_metrics
from floorplan_core.evaluation.dimensions import MeasuredDimension, dimension_scores, measure
from floorplan_core.evaluation.doors import door_scores
from floorplan_core.evaluation.free_space import free_space_scores, observed_scores
from floorplan_core.evaluation.plan_file import Float, PlanFile, read_plan
from floorplan_core.evaluation.report import EvaluationReport
from floorplan_core.evaluation.truth import Exposure, Truth
from floorplan_core.evaluation.truths import load_truth


def evaluate(plan: Path, truth: Path, storey: int = 0) -> EvaluationReport:
    """Compare ``plan.geojson`` with a ground truth; both may be named by the folder that holds them.

    ``storey`` is that of the truth where it is an IFC model of several, from the lowest.
    Raises :class:`~floorplan_core.errors.InputError` where one of the two is not what it claims to be.
    """
    return compare(read_plan(plan), load_truth(truth, storey))


def compare(plan: PlanFile, truth: Truth) -> EvaluationReport:
    """The same for a plan and a truth in memory. The plan is turned into the building's axes first."""
    local = plan.moved(inverse(truth.world_from_building))
    areas = room_metrics.overlap(local.regions, truth.rooms)
    matches = room_metrics.match_rooms(local.regions, truth.rooms, areas)
    homes = room_metrics.region_homes(truth.rooms, areas)
    measured = measure(truth.dimensions, local.regions)
    entered = in_rooms(measured, truth, ("entered",))
    expected = in_rooms(measured, truth, ("entered", "glimpsed"))
    right, judged = room_metrics.label_accuracy(matches)
    doors = door_scores(local.doors, truth.doors) if truth.rooms else None
    observed = None if truth.observed is None else observed_scores(plan, truth.observed)
    return EvaluationReport(
        plan=plan.name,
        truth=truth.source,
        dimensions=dimension_scores(entered) if entered else None,
        dimensions_all=dimension_scores(expected) if expected else None,
        rooms=room_metrics.room_scores(matches, homes, ("entered", "glimpsed")),
        rooms_entered=room_metrics.room_scores(matches, homes, ("entered",)),
        rooms_glimpsed=room_metrics.room_scores(matches, homes, ("glimpsed",)),
        merged=room_metrics.merged_regions(truth.rooms, areas),
        split=room_metrics.split_rooms(areas),
        labels_right=right,
        labels_judged=judged,
        doors=doors,
        free_space=free_space_scores(local, truth) if truth.rooms else observed,
        yaw_error_deg=yaw_error(plan.yaw, truth) if truth.rooms else None,
        matches=matches,
        measured=measured,
    )


def inverse(matrix: Float) -> Float:
    """The inverse of a (2, 3) affine map."""
    linear = np.linalg.inv(matrix[:, :2])
    return np.column_stack([linear, -linear @ matrix[:, 2]])


def yaw_error(yaw: float | None, truth: Truth) -> float | None:
    """Degrees between the plan's axes and the building's, modulo a quarter turn, absolute."""
    if yaw is None:
        return None
    quarter = np.pi / 2
    turn = (yaw - truth.yaw + quarter / 2) % quarter - quarter / 2
    return float(abs(np.degrees(turn)))


def in_rooms(
    measured: tuple[MeasuredDimension, ...], truth: Truth, classes: tuple[Exposure, ...]
) -> tuple[MeasuredDimension, ...]:
    """The dimensions whose middle lies in a room of the given classes; all, where the truth has no rooms."""
    import shapely

    if not truth.rooms:
        return measured

    area = shapely.union_all([r.polygon for r in truth.rooms if r.exposure in classes])
    shapely.prepare(area)
    middles = [0.5 * np.add(d.start, d.end) for d in truth.dimensions]
    return tuple(m for m, xy in zip(measured, middles, strict=True) if shapely.intersects_xy(area, *xy))

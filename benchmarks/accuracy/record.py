"""What is kept of each survey: flat numbers, and how they are averaged."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from floorplan_core.evaluation import EvaluationReport

Record = dict[str, Any]  # name, half, factors, seconds, error, then one number (or None) for each metric


@dataclass(frozen=True)
class Metric:
    """One column: how it is called, printed and judged."""

    key: str
    title: str
    digits: int
    good: int  # +1 higher is better, -1 lower is better
    target: float | None = None  # of the mean
    worst: float | None = None  # of the worst survey


# Targets: the accuracy goals of the project (halves that were not tuned on count).
METRICS = (
    Metric("yaw_error_deg", "yaw error, °", 3, -1, 0.1),
    Metric("dimension_m", "dimension error, m", 3, -1, 0.01, 0.03),
    Metric("dimension_percent", "dimension error, %", 2, -1, 0.25),
    Metric("dimension_share", "dimensions measured", 3, 1),
    Metric("f1_entered", "room F1, entered", 3, 1, 0.98),
    Metric("iou_entered", "room IoU, entered", 3, 1, 0.96, 0.9),
    Metric("recall_glimpsed", "room recall, glimpsed", 3, 1, 0.8),
    Metric("iou_glimpsed", "room IoU, glimpsed", 3, 1, 0.6),
    Metric("labels", "labels, the paper's", 3, 1, 0.97),
    Metric("labels_outlines", "labels, the paper's rule on the true outlines", 3, 1),
    Metric("labels_shape", "labels, shape", 3, 1, 0.97),
    Metric("door_precision", "door precision", 3, 1, 0.95, 0.85),
    Metric("door_recall", "door recall", 3, 1, 0.95, 0.85),
    Metric("door_width_m", "door width error, m", 3, -1, 0.03),
    Metric("openings_share", "wide openings found", 3, 1),
    Metric("free_precision", "free space precision", 3, 1),
    Metric("free_recall", "free space recall", 3, 1),
    Metric("outside_percent", "outside building, %", 2, -1, 1.0),
    Metric("predicted_right", "predicted area right", 3, 1),
    Metric("seconds", "seconds", 2, -1),
)
# How bad a survey is, for the choice of pictures: metres count like shares when divided by this.
GROSS_DIMENSION = 0.1


def record(report: EvaluationReport, by_shape: EvaluationReport | None = None) -> Record:
    """The metrics of one report; None where the truth or the plan cannot tell.

    ``by_shape`` is of the same plan with the labels of the other classifier; None where there are none.
    """
    dimensions, rooms, doors, free = report.dimensions, report.rooms_entered, report.doors, report.free_space
    glimpsed = report.rooms_glimpsed
    return {
        "yaw_error_deg": report.yaw_error_deg,
        "dimension_m": dimensions and dimensions.mean_m,
        "dimension_percent": dimensions and dimensions.mean_percent,
        "dimension_max_m": dimensions and dimensions.max_m,
        "dimension_share": dimensions and dimensions.share,
        "f1_entered": rooms and rooms.f1,
        "iou_entered": rooms and rooms.mean_iou,
        "iou_worst_room": rooms and rooms.min_iou,
        "worst_room": rooms.worst if rooms else "",
        "recall_glimpsed": glimpsed and glimpsed.recall,
        "iou_glimpsed": glimpsed and glimpsed.mean_iou,
        "merged": report.merged,
        "split": report.split,
        "labels": report.label_accuracy,
        "labels_shape": by_shape and by_shape.label_accuracy,
        "door_precision": doors and doors.precision,
        "door_recall": doors and doors.recall,
        "door_width_m": doors and doors.mean_width_error_m,
        "windows_as_doors": doors and doors.windows_as_doors,
        "openings_found": doors and doors.openings_found,
        "openings": doors and doors.openings,
        "openings_share": doors.openings_found / doors.openings if doors and doors.openings else None,
        "free_precision": free and free.precision,
        "free_recall": free and free.recall,
        "outside_percent": free and free.outside_percent,
        "predicted_m2": free and free.predicted_m2,
        "predicted_right": free and free.predicted_right,
    }


def mean(records: Iterable[Record], key: str) -> float | None:
    """Mean over the surveys that have the metric."""
    values = [r[key] for r in records if r.get(key) is not None]
    return sum(values) / len(values) if values else None


def worst(records: Iterable[Record], metric: Metric) -> Record | None:
    """The survey with the worst value (ties: the first)."""
    having = [r for r in records if r.get(metric.key) is not None]
    return min(having, key=lambda r: metric.good * r[metric.key]) if having else None


def badness(entry: Record) -> float:
    """How far from perfect: rooms, doors and dimensions, missing ones counting as lost."""
    door = min(_or(entry.get("door_precision"), 1.0), _or(entry.get("door_recall"), 1.0))
    rooms = _or(entry.get("iou_entered"), _or(entry.get("free_recall"), 0.0))
    dimension = min(1.0, _or(entry.get("dimension_m"), 0.0) / GROSS_DIMENSION)
    return (1 - rooms) + 0.5 * (1 - door) + 0.5 * (1 - _or(entry.get("f1_entered"), 1.0)) + 0.5 * dimension


def _or(value: float | None, other: float) -> float:
    return other if value is None else value

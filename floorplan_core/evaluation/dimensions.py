"""Dimensions, as in the paper's accuracy tables: the plan's distance between wall faces against the truth.

From the middle of each true dimension a line is shot both ways within the region that holds it; where it
leaves the region are the plan's faces. A dimension counts as measured when both ends are found near the true
ones: where two rooms were merged, the plan simply does not have that dimension.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.evaluation.plan_file import PlanRegion
from floorplan_core.evaluation.truth import TruthDimension, shoot

# An end farther than this from the true face is another wall: that dimension is missing, not wrong by metres.
SAME_WALL = 1.0


@dataclass(frozen=True)
class MeasuredDimension:
    """One true dimension and what the plan says."""

    id: str
    truth: float  # metres
    plan: float | None  # metres; None where the plan does not have it

    @property
    def error(self) -> float | None:
        """Metres, plan minus truth."""
        return None if self.plan is None else self.plan - self.truth


@dataclass(frozen=True)
class DimensionScores:
    """Absolute errors over the measured dimensions (None where there are none)."""

    total: int
    measured: int
    mean_m: float | None
    median_m: float | None
    max_m: float | None
    mean_percent: float | None
    median_percent: float | None
    max_percent: float | None
    worst: str  # id of the largest error in metres

    @property
    def share(self) -> float:
        """0 to 1: share of the true dimensions that the plan has."""
        return self.measured / self.total if self.total else 0.0


def measure(truths: Sequence[TruthDimension], regions: Sequence[PlanRegion]) -> tuple[MeasuredDimension, ...]:
    """Every true dimension with the plan's value (both in building axes)."""
    return tuple(MeasuredDimension(t.id, t.metres, _plan_length(t, regions)) for t in truths)


def _plan_length(truth: TruthDimension, regions: Sequence[PlanRegion]) -> float | None:
    middle = 0.5 * (truth.start[0] + truth.end[0]), 0.5 * (truth.start[1] + truth.end[1])
    direction = truth.end[0] - truth.start[0], truth.end[1] - truth.start[1]
    if direction == (0.0, 0.0):
        return None
    for region in regions:
        ends = shoot(region.polygon, middle, direction)
        if ends is not None:
            return _length(ends, truth)
    return None


def _length(ends: Any, truth: TruthDimension) -> float | None:
    """Distance between the plan's faces, if they are the faces that the dimension touches."""
    apart = [np.hypot(*np.subtract(e, t)) for e, t in zip(ends, (truth.start, truth.end), strict=True)]
    return float(np.hypot(*np.subtract(ends[1], ends[0]))) if max(apart) <= SAME_WALL else None


def dimension_scores(measured: Sequence[MeasuredDimension]) -> DimensionScores:
    """Mean, median and largest absolute error in metres and per cent."""
    found = [(abs(m.error), m) for m in measured if m.error is not None]
    if not found:
        return DimensionScores(len(measured), 0, None, None, None, None, None, None, "")
    metres = np.array([e for e, _ in found])
    percent = 100.0 * metres / np.array([max(m.truth, 1e-9) for _, m in found])
    worst = max(found, key=lambda pair: pair[0])[1].id
    return DimensionScores(len(measured), len(found), *_statistics(metres), *_statistics(percent), worst)


def _statistics(values: NDArray[np.float64]) -> tuple[float, float, float]:
    """Mean, median, largest."""
    return float(values.mean()), float(np.median(values)), float(values.max())

"""Does the confidence of a door mean what it says? All apertures of a survey, sure or not, against truth."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from floorplan_core.config import DoorsConfig
from floorplan_core.evaluation.compare import inverse
from floorplan_core.evaluation.doors import affinity, match_doors
from floorplan_core.evaluation.plan_file import PlanDoor
from floorplan_core.evaluation.truth import Truth
from floorplan_core.model import Door, FloorPlan, LayoutPlane
from floorplan_core.model.evidence import Evidence
from floorplan_core.model.quarter_turns import turned_door
from floorplan_core.observer import Observer
from floorplan_core.stages.doors import find_doors

Judged = list[tuple[float, bool]]  # confidence, and whether there is a door or opening
# Edges of the table's bins; most apertures are either clearly doors or clearly not.
BINS = (0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0)


class Keeper(Observer):
    """Keeps what the search for doors starts from."""

    evidence: Evidence | None = None
    planes: tuple[LayoutPlane, ...] = ()

    def stage_finished(self, name: str, seconds: float, result: object = None) -> None:
        """Stages come in the order of the pipeline: the last planes before the doors are theirs."""
        if isinstance(result, Evidence):
            self.evidence = result
        elif name == "planes":
            planes = result[-1] if isinstance(result, tuple) and isinstance(result[-1], tuple) else result
            self.planes = tuple(planes)  # type: ignore[arg-type]

    def apertures(self, config: DoorsConfig) -> tuple[Door, ...]:
        """Every aperture with its confidence, however small."""
        if self.evidence is None:
            return ()
        return find_doors(self.planes, self.evidence, config.model_copy(update={"min_confidence": 0.0}))


def judge(apertures: Sequence[Door], plan: FloorPlan, truth: Truth) -> Judged:
    """Each aperture with whether truth has a door or opening there; second ones of a door are left out."""
    right = is_door(apertures, plan, truth)
    return [(round(d.confidence, 3), r) for d, r in zip(apertures, right, strict=True) if r is not None]


def is_door(apertures: Sequence[Door], plan: FloorPlan, truth: Truth) -> list[bool | None]:
    """Whether truth has a door or opening at each aperture; None for second ones, and where it has none.

    ``apertures`` lie as the stages see them, in the survey's own quadrant; the finished plan was turned.
    """
    to_building = inverse(truth.world_from_building)
    turned = [turned_door(door, plan.candidates.quarters) for door in apertures]
    doors = [_in_building(door, plan, to_building) for door in turned]
    if not doors or not truth.doors:
        return [None] * len(doors)
    near = affinity(doors, truth.doors).max(axis=1) > 0
    partner = {m.plan: truth.doors[m.truth].kind for m in match_doors(doors, truth.doors)}
    return [
        partner.get(k, "none") in ("door", "opening") if k in partner or not near[k] else None
        for k in range(len(doors))
    ]


def _in_building(door: Door, plan: FloorPlan, to_building: np.ndarray) -> PlanDoor:
    line = plan.to_world(door.line()) @ to_building[:, :2].T + to_building[:, 2]
    return PlanDoor(door.id, line, door.width, door.kind, door.confidence)


def table(judged: Judged) -> list[tuple[str, int, float | None, float | None]]:
    """For each bin its name, count, mean confidence and share of doors (None where it is empty)."""
    values = np.array([c for c, _ in judged])
    right = np.array([r for _, r in judged], dtype=bool)
    rows: list[tuple[str, int, float | None, float | None]] = []
    for low, high in pairwise(BINS):
        inside = (values >= low) & ((values < high) | (high == BINS[-1]))
        count = int(inside.sum())
        mean = float(values[inside].mean()) if count else None
        rows.append((f"{low:g} to {high:g}", count, mean, float(right[inside].mean()) if count else None))
    return rows


def brier(judged: Judged) -> float | None:
    """Mean squared difference of confidence and truth; None without apertures."""
    return float(np.mean([(c - r) ** 2 for c, r in judged])) if judged else None

"""Doors of the plan against true doors: same wall, overlapping along it; one to one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.evaluation.plan_file import PlanDoor
from floorplan_core.evaluation.rooms import scores
from floorplan_core.evaluation.truth import TruthDoor

ACROSS = 0.5  # m, largest distance between the middles of the two openings across the wall
ALONG = 0.5  # smallest overlap along the wall, as a share of the narrower opening
DOUBLE = 1.2  # m, a wider door has two leaves: a plan may call it a door or an opening
PARALLEL = np.cos(np.radians(20.0))  # a door turned further than this lies in another wall
Float = NDArray[np.float64]


@dataclass(frozen=True)
class DoorMatch:
    """A true door and the one that was matched to it."""

    truth: int  # row
    plan: int  # row


@dataclass(frozen=True)
class DoorScores:
    """Precision is over the plan's doors that were judged, recall over the true doors that are required."""

    required: int
    judged: int
    found: int
    precision: float
    recall: float
    f1: float
    mean_width_error_m: float | None
    max_width_error_m: float | None
    optional_found: (
        int  # shut or exterior doors and unlisted passages that the plan has: neither right nor wrong
    )
    windows_as_doors: int  # windows that the plan calls a door: wrong
    openings: int  # wide passages that are required
    openings_found: int
    openings_unmatched: int  # wide passages of the plan that are none in truth (a room cut in two, mostly)
    kinds_right: int  # matched doors and openings that carry the right one of the two words
    kinds_judged: int


def affinity(plan: Sequence[PlanDoor], truth: Sequence[TruthDoor]) -> Float:
    """(P, T) 0 where two doors cannot be the same, else overlap along the wall times nearness across."""
    return np.array([[_affinity(p, t) for t in truth] for p in plan]).reshape(len(plan), len(truth))


def _affinity(plan: PlanDoor, truth: TruthDoor) -> float:
    direction = plan.line[1] - plan.line[0]
    length = float(np.hypot(*direction))
    if length == 0 or abs(direction[1 - truth.axis]) < PARALLEL * length:
        return 0.0
    across = abs(float(plan.line[:, truth.axis].mean()) - truth.across)
    start, end = np.sort(plan.line[:, 1 - truth.axis])
    shared = min(end, truth.span[1]) - max(start, truth.span[0])
    narrower = min(end - start, truth.width)
    if across > ACROSS or shared < ALONG * narrower:
        return 0.0
    union = max(end, truth.span[1]) - min(start, truth.span[0])
    return float(shared / union * (1.0 - 0.5 * across / ACROSS))


def match_doors(plan: Sequence[PlanDoor], truth: Sequence[TruthDoor]) -> tuple[DoorMatch, ...]:
    """The assignment of largest total affinity."""
    from scipy.optimize import linear_sum_assignment

    value = affinity(plan, truth)
    if not value.size:
        return ()
    rows, columns = linear_sum_assignment(value, maximize=True)
    return tuple(DoorMatch(int(c), int(r)) for r, c in zip(rows, columns, strict=True) if value[r, c] > 0)


def door_scores(plan: Sequence[PlanDoor], truth: Sequence[TruthDoor]) -> DoorScores:
    """Counts over one building (both in building axes)."""
    matches = match_doors(plan, truth)
    partner = {m.plan: truth[m.truth] for m in matches}
    pairs = [(plan[m.plan], truth[m.truth]) for m in matches]
    right = [(p, t) for p, t in pairs if t.required and t.kind == "door"]
    judged = sum(_judged(p, partner.get(i)) for i, p in enumerate(plan))
    required = sum(t.required and t.kind == "door" for t in truth)
    errors = [abs(p.width - t.width) for p, t in right]
    known = [(p, t) for p, t in pairs if t.required and (t.kind == "opening" or t.width <= DOUBLE)]
    return DoorScores(
        required,
        max(judged, len(right)),
        len(right),
        *scores(len(right), max(judged, len(right)), required),
        mean_width_error_m=float(np.mean(errors)) if errors else None,
        max_width_error_m=float(np.max(errors)) if errors else None,
        optional_found=sum(not t.required and t.kind != "window" for _, t in pairs),
        windows_as_doors=sum(t.kind == "window" for _, t in pairs),
        openings=sum(t.required and t.kind == "opening" for t in truth),
        openings_found=sum(t.required and t.kind == "opening" for _, t in pairs),
        openings_unmatched=sum(p.kind == "opening" and i not in partner for i, p in enumerate(plan)),
        kinds_right=sum(p.kind == t.kind for p, t in known),
        kinds_judged=len(known),
    )


def _judged(door: PlanDoor, truth: TruthDoor | None) -> bool:
    """Whether a door of the plan counts for precision: not a passage, nor where truth is open about it."""
    if truth is None:
        return door.kind == "door"
    return truth.kind == "window" or (truth.required and truth.kind == "door")

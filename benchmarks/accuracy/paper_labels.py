"""What the paper's classifier gets wrong, and whether the plan or the rule is to blame.

The rule is asked about the true outline of every room too: where that is called wrong as well, no plan helps.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from floorplan_core.config import LabelsConfig
from floorplan_core.evaluation import EvaluationReport
from floorplan_core.evaluation.rooms import MATCH_IOU
from floorplan_core.evaluation.truth import Truth, TruthRoom
from floorplan_core.geometry.turning import turning_distance

Mislabelled = dict[str, Any]  # room, kind, label, by_outline, perimeter (m), turning distance


def on_true_outlines(truth: Truth, config: LabelsConfig) -> float | None:
    """Share of the rooms that a plan should have of which the rule is right, their outlines being true."""
    rooms = [r for r in truth.rooms if r.kind is not None and r.exposure != "hidden"]
    if not rooms:
        return None
    return sum(by_rule(r, config)[0] == r.kind for r in rooms) / len(rooms)


def by_rule(room: TruthRoom, config: LabelsConfig) -> tuple[str, float, float]:
    """What the rule calls a true outline, its perimeter in metres and its turning distance to the square."""
    outline = room.polygon.exterior
    perimeter = float(outline.length)
    turning = turning_distance(np.asarray(shapely.get_coordinates(outline))[:-1])
    is_room = perimeter < config.max_room_perimeter and turning < config.max_room_turning
    return "room" if is_room else "corridor", perimeter, turning


def mislabelled(report: EvaluationReport, truth: Truth, config: LabelsConfig) -> list[Mislabelled]:
    """The rooms found that carry the wrong label, in the order of the truth."""
    found = []
    for match, room in zip(report.matches, truth.rooms, strict=True):
        judged = match.iou >= MATCH_IOU and room.kind is not None and room.exposure != "hidden"
        if judged and match.label != room.kind:
            label, perimeter, turning = by_rule(room, config)
            found.append(
                {
                    "room": room.name,
                    "kind": room.kind,
                    "label": match.label,
                    "by_outline": label,
                    "perimeter": round(perimeter, 1),
                    "turning": round(turning, 3),
                }
            )
    return found

"""How likely a region is a room of the building: a probability from what was seen of it.

In: its sides, cells and area. Out: the probability that one room of the building (or corridor, hall) and
it have an intersection over union of 0.5 or more. Three measures tell: the share of the boundary along which
wall was seen, the share of the floor seen free, and the floor seen, for a patch of half a square metre behind
a door says little about the room around it. A logistic regression on the regions of simulated 3-D surveys
(``python -m benchmarks.accuracy.fit_regions``); of maps and planar runs the formula is the same, unproven.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from floorplan_core.model import RegionSide

# Log odds of a whole measure, and of none. Fitted on the regions of 72 simulated surveys.
_BIAS = -0.23
_WEIGHTS = {"walls": 2.09, "floor": 1.20, "patch": 2.65}
MEASURES = tuple(_WEIGHTS)  # in this order
_ENOUGH = 4.0  # m2 of floor seen: more tells no more
_DECIMALS = 3


def measures_of(
    sides: Sequence[RegionSide], free: int, total: int, area: float
) -> tuple[float, float, float]:
    """0 to 1 each: share of the boundary seen, share of the floor seen, the floor seen up to 4 m2.

    :param free: cells seen free of ``total``; ``area``: m2.
    """
    length = sum(s.length for s in sides)
    walls = sum(s.length * s.observed for s in sides) / length if length else 0.0
    floor = free / total if total else 0.0
    return walls, floor, min(floor * area / _ENOUGH, 1.0)


def probability(measures: Sequence[float]) -> float:
    """That a region with these measures is a room, 0 to 1."""
    odds = _BIAS + sum(w * m for w, m in zip(_WEIGHTS.values(), measures, strict=True))
    return round(1.0 / (1.0 + math.exp(-odds)), _DECIMALS)


def share_seen(measures: Sequence[float]) -> float:
    """Half of it the boundary seen, half the floor: what ranks two regions that claim one place."""
    return round(0.5 * measures[0] + 0.5 * measures[1], _DECIMALS)

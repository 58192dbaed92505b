"""What a person says on a site of buildings that stand apart is of the building where it lies.

In: the corrections of the whole site and what was seen of each building, all in the axes of the plan. Out:
the corrections of each building. Names and labels of regions are said of the whole plan, where every region
is. Cost: nothing but a look at a few boxes; one pass over the columns of buildings whose boxes overlap.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from floorplan_core.model.corrections import Correction, MergeRegions, Point
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.corrections import NOTHING, Placed, Remarks, Said, place

_EXACT = 1e-6  # m, to which distances from two boxes are the same


def said_of_buildings(said: Said, seen: Sequence[Evidence]) -> tuple[tuple[Said, ...], Remarks]:
    """What is said of each building, in the order of ``seen``; and remarks on what is of none."""
    where = {c: building_at(_places(c), seen) for c in (*said.walls, *said.doors, *said.shapes)}
    remarks = sum((_between(c) for c in said.shapes if where[c] is None), NOTHING)

    def own(corrections: tuple[Correction, ...], building: int) -> tuple[Correction, ...]:
        return tuple(c for c in corrections if where[c] == building)

    return tuple(
        Said(own(said.walls, k), own(said.doors, k), own(said.shapes, k)) for k in range(len(seen))
    ), remarks


def building_at(places: Sequence[Point], seen: Sequence[Evidence]) -> int | None:
    """The building that all of the places are nearest to; None where they lie in more than one."""
    found = {_nearest(np.array(at, dtype=np.float64), seen) for at in places}
    return found.pop() if len(found) == 1 else None


def _places(correction: Any) -> tuple[Point, ...]:
    """Where the thing is that a correction is about: of what is drawn, its middle."""
    if isinstance(correction, MergeRegions):
        return correction.at
    if hasattr(correction, "plane"):
        return (correction.plane.at,)
    if hasattr(correction, "at"):
        return (correction.at,)
    (x0, y0), (x1, y1) = correction.start, correction.end
    return (((x0 + x1) / 2, (y0 + y1) / 2),)


def _nearest(at: Any, seen: Sequence[Evidence]) -> int:
    """The building whose box is nearest; of several, that with the nearest surface, then the first."""
    away = [_from_box(at, each) for each in seen]
    near = [k for k, d in enumerate(away) if d <= min(away) + _EXACT]
    return near[0] if len(near) == 1 else min(near, key=lambda k: (_from_surfaces(at, seen[k]), k))


def _from_box(at: Any, seen: Evidence) -> float:
    high = seen.origin + np.array(seen.shape[::-1]) * seen.cell
    return float(np.hypot(*np.maximum(np.maximum(seen.origin - at, at - high), 0.0)))


def _from_surfaces(at: Any, seen: Evidence) -> float:
    rows, columns = np.nonzero(seen.hits)
    centres = (np.column_stack([columns, rows]) + 0.5) * seen.fine + seen.origin
    return float(np.min(np.hypot(*(centres - at).T), initial=np.inf))


def _between(merge: Correction) -> Remarks:
    assert isinstance(merge, MergeRegions)
    where = " and ".join(map(place, merge.at))
    text = f"The regions at {where} stand in different buildings: they cannot be merged."
    return Remarks(warnings=(Placed(text, *merge.at),))

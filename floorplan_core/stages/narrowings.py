"""Openings without a lintel: where two ends of one wall come towards each other, two rooms begin.

The doors of the paper are apertures that a lintel closes above. In open plans a wall merely stops, and goes
on some metres farther: nothing spans the gap, but both ends protrude into the space that they part. Where a
wall ends at another wall instead, the gap is the mouth of a corridor or of an alcove, and parts nothing.
In: planes with their runs, doors. Out: doors of kind "opening". Cost: runs times walls across.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, Facing, LayoutPlane
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.door_apertures import shows_lintels
from floorplan_core.stages.doors import find_doors
from floorplan_core.stages.necks import find_necks
from floorplan_core.stages.wall_lines import line_doors

Float = NDArray[np.float64]

_NARROWEST = 0.8  # m: less is no passage
_PROTRUDES = 0.6  # m of wall that must stand free at both ends
_FREE = 0.4  # m between the end of a wall and a wall across it: an end nearer to it is a corner
_STANDS = 0.35  # of the height below 2 m that was seen of it
_BESIDE = 0.5  # m that a wall across must go on beside a face, to be one that the end belongs to
_PASSED = 0.5  # share of the gap through which free space was seen
_SAME = 0.7  # share of the gap that both faces of the wall have in common
_CONFIDENCE = 0.6  # an opening that only the plan shows, no lintel


def find_openings(
    planes: tuple[LayoutPlane, ...], evidence: Evidence, around: Evidence, config: DoorsConfig
) -> tuple[Door, ...]:
    """The doors, and the gaps between wall ends that part rooms without a lintel.

    :param around: the evidence with what may have been seen where that was guessed; for single walls it does
        not count, since through a hole in the data much may have been seen.
    """
    doors = find_doors(planes, evidence, config)
    if not shows_lintels([p.profile for p in planes if p.profile]):
        return find_necks(planes, doors, evidence, config)
    doors += line_doors(planes, doors, around, config)
    return (*doors, *find_narrowings(planes, doors, config))


def find_narrowings(
    planes: Sequence[LayoutPlane], doors: Sequence[Door], config: DoorsConfig
) -> tuple[Door, ...]:
    """Gaps up to ``config.max_opening`` between free ends of walls that were seen from both sides."""
    found: list[Door] = []
    of = {facing: [p for p in planes if p.facing == facing] for facing in Facing}
    for near in (p for p in planes if p.facing.sign < 0):
        for far in of[near.facing.opposite]:
            if 0.0 < far.offset - near.offset <= config.max_thickness:
                found += _between(near, far, planes, [*doors, *found], config)
    return tuple(found)


def _between(
    near: LayoutPlane,
    far: LayoutPlane,
    planes: Sequence[LayoutPlane],
    doors: Sequence[Door],
    config: DoorsConfig,
) -> list[Door]:
    """The narrowings of the wall between its two faces."""
    thickness = far.offset - near.offset
    others = [q for q in planes if q.facing.axis != near.facing.axis]
    out: list[Door] = []
    for start, end in _gaps(near, others, config.max_opening):
        for s, e in _gaps(far, others, config.max_opening):
            shared = min(end, e) - max(start, s)
            middle = (near.offset + far.offset) / 2
            if shared < _SAME * max(end - start, e - s) or _known(
                near.facing.axis, middle, start, end, doors
            ):
                continue
            out.append(
                Door(
                    f"d{len(doors) + len(out) + 1}",
                    (near.id, far.id),
                    near.facing.axis,
                    middle,
                    (start + s) / 2,
                    (end + e) / 2,
                    thickness=thickness,
                    kind="opening",
                    confidence=_CONFIDENCE,
                    evidence=("both wall ends", "both faces", "free passage"),
                )
            )
    return out


def _gaps(plane: LayoutPlane, others: Sequence[LayoutPlane], widest: float) -> list[tuple[float, float]]:
    """Gaps between two runs of a face that both end in the open, passed by free space."""
    runs = sorted((float(s), float(e)) for s, e in plane.walls)
    return [
        (end, start)
        for (first, end), (start, last) in pairwise(runs)
        if _NARROWEST <= start - end <= widest
        and min(end - first, last - start) >= _PROTRUDES
        and _is_passed(plane, end, start)
        and not _meets(plane, end, -1, others)
        and not _meets(plane, start, 1, others)
    ]


def _is_passed(plane: LayoutPlane, start: float, end: float) -> bool:
    """True where free space passes the gap, and wall was seen to stand at both of its ends."""
    profile = plane.profile
    if profile is None:
        return False
    a, b = (round((v - profile.start) / profile.step) for v in (start, end))
    reach = round(_PROTRUDES / profile.step)
    ends = (profile.low[max(a - reach, 0) : a], profile.low[b : b + reach])
    stands = all(len(part) and float(part.mean()) >= _STANDS for part in ends)
    return stands and float((profile.through[a:b] > 0.3).mean()) >= _PASSED


def _meets(plane: LayoutPlane, end: float, back: int, others: Sequence[LayoutPlane]) -> bool:
    """True where a wall across begins within reach of the end of a run; ``back``: the way along the run."""
    for other in others:
        if -0.2 <= (other.offset - end) * back < _FREE:
            for s, e in other.walls:
                if s - _BESIDE < plane.offset < e + _BESIDE and e - s > _BESIDE:
                    return True
    return False


def _known(axis: int, offset: float, start: float, end: float, doors: Sequence[Door]) -> bool:
    """True where a door is there already."""
    return any(
        d.axis == axis and abs(d.offset - offset) < d.thickness / 2 + 0.3 and d.start < end and d.end > start
        for d in doors
    )

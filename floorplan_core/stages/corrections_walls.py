"""Corrections of walls: planes hidden, kept, moved, and walls that the machine does not know.

In: the planes after :func:`~floorplan_core.stages.layout_planes.mark_recesses`. Out: the planes with what a
person said. Segments stay where they were measured; a side of a region follows a plane that was moved or
added by hand, not the surfaces near it (:class:`~floorplan_core.stages.region_sides.WallSurfaces`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from floorplan_core.model import Facing, LayoutPlane
from floorplan_core.model.corrections import (
    AddWall,
    Correction,
    HidePlane,
    KeepPlane,
    MovePlane,
    PlaneAt,
    Point,
)
from floorplan_core.stages.blockers import crossing_offsets, crossing_walls
from floorplan_core.stages.corrections import (
    NOTHING,
    REACH,
    Placed,
    Remarks,
    Span,
    beyond,
    line_of,
    place,
    runs_of,
    wall_place,
)

ADDED = "hw"  # the ids of walls added by hand begin so
SHORTEST = 0.1  # m: a shorter line by hand is a slip of the mouse

Planes = tuple[LayoutPlane, ...]


def correct_walls(planes: Planes, corrections: Sequence[Correction]) -> tuple[Planes, Remarks]:
    """The planes after ``corrections`` (manhattan frame), one after the other; the same tuple where none."""
    said, before, added = NOTHING, {p.id: p for p in planes}, 0
    for correction in corrections:
        if isinstance(correction, AddWall):
            added += 1
            planes, remarks = _add(planes, correction, added)
            before |= {p.id: p for p in planes if p.id not in before}
        else:
            assert isinstance(correction, HidePlane | KeepPlane | MovePlane)
            planes, remarks = _change(planes, before, correction)
        said += remarks
    return planes, said


def still_walls(machine: Planes, corrected: Planes) -> Planes:
    """The machine's planes that nobody switched off: those that doors are looked for in."""
    hidden = {p.id for p in corrected if p.by_hand == "hidden"}
    return tuple(p for p in machine if p.id not in hidden)


def find_plane(planes: Sequence[LayoutPlane], wanted: PlaneAt) -> LayoutPlane | None:
    """The nearest plane among those that look the same way, the first of two; None beyond reach."""
    facing = facing_of(wanted.normal)
    near = [(_distance(p, wanted.at), k, p) for k, p in enumerate(planes) if p.facing == facing]
    best = min(near, key=lambda n: n[:2], default=None)
    return best[2] if best is not None and best[0] <= REACH else None


def facing_of(normal: Point) -> Facing:
    """The facing whose direction is nearest to a normal."""
    axis = 0 if abs(normal[0]) >= abs(normal[1]) else 1
    return Facing(2 * axis + (normal[axis] < 0))


def _distance(plane: LayoutPlane, at: Point) -> float:
    axis = plane.facing.axis
    return math.hypot(plane.offset - at[axis], beyond(runs_of(plane), at[1 - axis]))


def _change(
    planes: Planes, first: dict[str, LayoutPlane], correction: HidePlane | KeepPlane | MovePlane
) -> tuple[Planes, Remarks]:
    found = find_plane(planes, correction.plane)
    if found is None and isinstance(correction, KeepPlane):
        return _keep_unseen(planes, correction)
    if found is None and isinstance(correction, HidePlane):
        return _hide_unseen(planes, correction)
    if found is None:
        where = place(correction.plane.at)
        text = f"The wall moved from {where} is not there any more."
        return planes, Remarks(warnings=(Placed(text, correction.plane.at),))
    before = first.get(found.id, found)
    changed = _changed(found, before, correction)
    by_machine = found.id in first and not before.by_hand
    remark = Remarks(((found.id, _wall_at(before)),)) if by_machine else NOTHING
    return tuple(changed if p is found else p for p in planes), remark


def _wall_at(plane: LayoutPlane) -> Placed:
    at = (plane.offset, 0.0) if plane.facing.axis == 0 else (0.0, plane.offset)
    return Placed(f"wall at {wall_place(at)}", at, form=wall_place)


def _changed(
    plane: LayoutPlane, machine: LayoutPlane, correction: HidePlane | KeepPlane | MovePlane
) -> LayoutPlane:
    if isinstance(correction, HidePlane):
        return replace(plane, by_hand="hidden", walls=np.zeros((0, 2)))
    walls = machine.walls if plane.by_hand == "hidden" else plane.walls
    if isinstance(correction, MovePlane):
        plane = replace(plane, offset=correction.to[plane.facing.axis])
    kept = "kept" if plane.offset == machine.offset else "moved"
    return replace(plane, by_hand="added" if plane.id.startswith(ADDED) else kept, walls=walls)


def _keep_unseen(planes: Planes, correction: KeepPlane) -> tuple[Planes, Remarks]:
    """A plane where the machine saw none: it may bound rectangles, but it parts nothing."""
    facing = facing_of(correction.plane.normal)
    number = 1 + sum(p.id.startswith("hk") for p in planes)
    at = correction.plane.at[facing.axis]
    return (*planes, LayoutPlane(f"hk{number}", facing, at, by_hand="kept")), NOTHING


def _hide_unseen(planes: Planes, correction: HidePlane) -> tuple[Planes, Remarks]:
    """Where no plane was seen, none is speculated either."""
    facing = facing_of(correction.plane.normal)
    number = 1 + sum(p.id.startswith("hx") for p in planes)
    at = correction.plane.at
    hidden = LayoutPlane(f"hx{number}", facing, at[facing.axis], speculated=True, by_hand="hidden")
    return (*planes, hidden), NOTHING


def _add(planes: Planes, wall: AddWall, number: int) -> tuple[Planes, Remarks]:
    """The two faces of a wall, its ends at the walls that they nearly reach."""
    axis, offset, span = line_of(wall.start, wall.end)
    if span[1] - span[0] < SHORTEST:
        text = f"The wall added at {place(wall.start)} is too short for one."
        return planes, Remarks(warnings=(Placed(text, wall.start),))
    run = np.array([_snapped(planes, axis, offset, span)])
    faces = [
        LayoutPlane(
            f"{ADDED}{number}{'ab'[k]}",
            Facing(2 * axis + k),
            offset + (0.5 - k) * wall.thickness,
            walls=run,
            by_hand="added",
        )
        for k in (0, 1)
    ]
    return (*planes, *faces), NOTHING


def _snapped(planes: Planes, axis: int, offset: float, span: Span) -> Span:
    """The span with each end at the nearest wall across that is within reach."""
    probe = LayoutPlane("", Facing(2 * axis), offset)
    meets = crossing_offsets(probe, crossing_walls(planes, 1 - axis))

    def snap(end: float) -> float:
        near = meets[np.abs(meets - end) <= REACH]
        return float(near[np.argmin(np.abs(near - end))]) if len(near) else end

    low, high = snap(span[0]), snap(span[1])
    return (low, high) if high - low >= SHORTEST else span

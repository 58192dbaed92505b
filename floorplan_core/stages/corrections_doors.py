"""Corrections of doors: accepted, rejected, resized, and doors that the machine does not know.

In: the doors of :func:`~floorplan_core.stages.doors.find_doors` and the corrected planes. Out: doors that lie
in the planes as they are now, and planes whose walls close where a door was rejected and open where one was
added.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, LayoutPlane
from floorplan_core.model.corrections import AcceptDoor, AddDoor, Correction, Point, RejectDoor, ResizeDoor
from floorplan_core.stages.corrections import (
    NOTHING,
    REACH,
    Placed,
    Remarks,
    Span,
    beyond,
    joined,
    line_of,
    place,
    runs_of,
    without,
)

BY_HAND = "by hand"  # the word of evidence
SAME = 0.3  # of the narrower of two doors that they share: they are one
NARROWEST = 0.2  # m: a narrower door by hand is a slip of the mouse

Doors = tuple[Door, ...]
Planes = tuple[LayoutPlane, ...]


def follow_planes(
    doors: Doors, machine: Sequence[LayoutPlane], planes: Sequence[LayoutPlane], thickest: float
) -> Doors:
    """The doors, moved with the planes that they are cut into.

    :param thickest: metres; a face that is moved farther from the other one is of another wall.
    """
    before = {p.id: p.offset for p in machine}
    moved = {p.id: p.offset - before[p.id] for p in planes if p.id in before and p.offset != before[p.id]}
    sign = {p.id: p.facing.sign for p in planes}
    return tuple(_moved(d, moved, sign, thickest) for d in doors) if moved else doors


def _moved(door: Door, moved: dict[str, float], sign: dict[str, int], thickest: float) -> Door:
    """Faces of one side of the wall are taken together, so that the thickness changes with each side."""
    if not any(name in moved for name in door.planes):
        return door
    sides = [[moved.get(n, 0.0) for n in door.planes if sign.get(n) == s] for s in (1, -1)]
    shifts = [float(np.mean(side)) for side in sides if side]
    thickness = door.thickness + (shifts[0] - shifts[1] if len(shifts) == 2 else 0.0)
    if 0 <= thickness <= thickest:
        return replace(door, offset=door.offset + float(np.mean(shifts)), thickness=thickness)
    stayed = tuple(n for n in door.planes if n not in moved)
    if not stayed:
        return replace(door, offset=door.offset + shifts[0], planes=door.planes[:1], thickness=0.0)
    out = 0.5 * door.thickness * sign[stayed[0]]  # from the middle of the wall to the face that stayed
    return replace(door, offset=door.offset + out, planes=stayed, thickness=0.0)


def correct_doors(
    doors: Doors,
    planes: Planes,
    corrections: Sequence[Correction],
    config: DoorsConfig,
    faint: Callable[[], Doors],
) -> tuple[Doors, Planes, Remarks]:
    """Doors and planes after ``corrections`` (manhattan frame), one after the other.

    :param faint: all doors, those of too little confidence included; asked only for one that is accepted.
    """
    said, added = NOTHING, 0
    for correction in corrections:
        if isinstance(correction, AddDoor):
            added += 1
            doors, planes, remarks = _add(doors, planes, correction, f"hd{added}", config)
        elif isinstance(correction, AcceptDoor):
            doors, remarks = _accept(doors, correction, faint)
        else:
            assert isinstance(correction, RejectDoor | ResizeDoor)
            doors, planes, remarks = _change(doors, planes, correction)
        said += remarks
    return doors, planes, said


def find_door(doors: Sequence[Door], at: Point) -> Door | None:
    """The door nearest to a point, the first of two; None beyond reach."""
    near = [(_distance(d, at), k, d) for k, d in enumerate(doors)]
    best = min(near, key=lambda n: n[:2], default=None)
    return best[2] if best is not None and best[0] <= REACH else None


def _distance(door: Door, at: Point) -> float:
    across = max(abs(door.offset - at[door.axis]) - door.thickness / 2, 0.0)
    return math.hypot(across, beyond([(door.start, door.end)], at[1 - door.axis]))


def _accept(doors: Doors, correction: AcceptDoor, faint: Callable[[], Doors]) -> tuple[Doors, Remarks]:
    found = find_door(doors, correction.at)
    if found is not None:
        changed = tuple(_accepted(d) if d is found else d for d in doors)
        return changed, _said(found)
    found = find_door(faint(), correction.at)
    if found is None:
        text = f"The door accepted at {place(correction.at)} is not there any more."
        return doors, Remarks(warnings=(Placed(text, correction.at),))
    known = {d.id for d in doors}
    name = next(f"hf{k}" for k in range(1, len(doors) + 2) if f"hf{k}" not in known)
    return (*doors, replace(_accepted(found), id=name)), NOTHING


def _accepted(door: Door) -> Door:
    words = tuple(dict.fromkeys((*door.evidence, BY_HAND)))
    return replace(door, confidence=1.0, evidence=words, by_hand=door.by_hand or "accepted")


def _said(door: Door) -> Remarks:
    """What the machine had said of a door; of one by hand it said nothing."""
    if door.by_hand:
        return NOTHING
    return Remarks(((door.id, f"{door.kind}, {door.width:.3f} m wide, {door.confidence:.0%} sure"),))


def _change(
    doors: Doors, planes: Planes, correction: RejectDoor | ResizeDoor
) -> tuple[Doors, Planes, Remarks]:
    found = find_door(doors, correction.at)
    where = place(correction.at)
    if found is None:
        what = "rejected" if isinstance(correction, RejectDoor) else "resized"
        text = f"The door {what} at {where} is not there any more."
        return doors, planes, Remarks(warnings=(Placed(text, correction.at),))
    closed = _closed(planes, found)
    if isinstance(correction, RejectDoor):
        return tuple(d for d in doors if d is not found), closed, NOTHING
    start, end = sorted((correction.start[1 - found.axis], correction.end[1 - found.axis]))
    if end - start < NARROWEST:
        text = f"The door at {where} cannot be {end - start:.2f} m wide."
        return doors, planes, Remarks(warnings=(Placed(text, correction.at),))
    resized = replace(_accepted(found), start=start, end=end, by_hand=found.by_hand or "resized")
    if found.by_hand == "accepted":
        resized = replace(resized, by_hand="resized")
    return tuple(resized if d is found else d for d in doors), _opened(closed, resized), _said(found)


def _closed(planes: Planes, door: Door) -> Planes:
    """The walls of the door's planes go on where the door was."""
    span = (door.start, door.end)
    return tuple(
        replace(p, walls=joined(p.walls, span)) if p.id in door.planes and p.by_hand != "hidden" else p
        for p in planes
    )


def _opened(planes: Planes, door: Door) -> Planes:
    """The walls of the door's planes end at its jambs."""
    span = (door.start, door.end)
    return tuple(replace(p, walls=without(p.walls, span)) if p.id in door.planes else p for p in planes)


def _add(
    doors: Doors, planes: Planes, correction: AddDoor, name: str, config: DoorsConfig
) -> tuple[Doors, Planes, Remarks]:
    """A door in the nearest wall along the line drawn; doors that it overlaps there give way."""
    axis, offset, (start, end) = line_of(correction.start, correction.end)
    where = place(correction.start)
    if end - start < NARROWEST:
        text = f"The door added at {where} is too narrow for one."
        return doors, planes, Remarks(warnings=(Placed(text, correction.start),))
    faces = _faces(planes, axis, offset, (start, end), config.max_thickness)
    if not faces:
        problem = f"The door added at {where} is in no wall: there is none within {REACH:g} m."
        return doors, planes, Remarks(warnings=(Placed(problem, correction.start),))
    ends = [p.offset for p in faces]
    door = Door(
        id=name,
        planes=tuple(p.id for p in faces),
        axis=axis,
        offset=float(np.mean(ends)),
        start=start,
        end=end,
        thickness=max(ends) - min(ends),
        kind=correction.kind,
        confidence=1.0,
        evidence=(BY_HAND,),
        by_hand="added",
    )
    beside = [d for d in doors if _overlap(d, door, config.max_thickness) > 0]
    gone = [d for d in beside if _overlap(d, door, config.max_thickness) > SAME * min(d.width, door.width)]
    for other in beside:
        if other not in gone:
            door = _trimmed(door, other)
    return (*(d for d in doors if d not in gone), door), _opened(planes, door), NOTHING


def _faces(planes: Planes, axis: int, offset: float, span: Span, thickest: float) -> list[LayoutPlane]:
    """The face nearest to a line, and the other face of its wall where there is one."""
    middle = 0.5 * (span[0] + span[1])
    along = [
        p
        for p in planes
        if p.facing.axis == axis and p.by_hand != "hidden" and beyond(runs_of(p), middle) < span[1] - span[0]
    ]
    first = min(along, key=lambda p: abs(p.offset - offset), default=None)
    if first is None or abs(first.offset - offset) > REACH:
        return []
    behind = [p for p in along if p.facing != first.facing]
    depth = [(first.offset - p.offset) * first.facing.sign for p in behind]  # of the wall between the faces
    walls = [(d, k) for k, d in enumerate(depth) if 0 <= d <= thickest]
    return [first, behind[min(walls)[1]]] if walls else [first]


def _overlap(a: Door, b: Door, thickest: float) -> float:
    """Metres that two doors have in common; negative where they have none, or lie in different walls."""
    if a.axis != b.axis or abs(a.offset - b.offset) > thickest:
        return -1.0
    return min(a.end, b.end) - max(a.start, b.start)


def _trimmed(door: Door, other: Door) -> Door:
    """A door that ends where the next one begins."""
    if door.start + door.end < other.start + other.end:
        return replace(door, end=min(door.end, other.start))
    return replace(door, start=max(door.start, other.end))


def lost_doors(before: Doors, doors: Doors) -> Remarks:
    """Doors by hand that join no two regions, and so are none."""
    left = {d.id for d in doors}
    gone = [d for d in before if d.by_hand and d.id not in left]
    return Remarks(warnings=tuple(map(_between_none, gone)))


def _between_none(door: Door) -> Placed:
    x, y = door.line().mean(axis=0).tolist()
    where = place((x, y))
    text = f"The door {door.by_hand} by hand at {where} does not lie between two regions, and is left out."
    return Placed(text, (x, y))

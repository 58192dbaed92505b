"""From things of the plan to the corrections that name them by where they are, and back. No Qt."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import shapely

from floorcast_app.format import number
from floorcast_app.selection import Item
from floorplan_core.errors import UsageError
from floorplan_core.model import Door, LayoutPlane, Region
from floorplan_core.model.corrections import (
    AcceptDoor,
    AddDoor,
    AddWall,
    Correction,
    HidePlane,
    KeepPlane,
    LabelRegion,
    MergeRegions,
    MovePlane,
    NameRegion,
    PlaneAt,
    Point,
    RejectDoor,
    ResizeDoor,
    SplitRegion,
)
from floorplan_core.stages.corrections import REACH, in_plan, shifted, turned_back
from floorplan_core.stages.corrections_doors import find_door
from floorplan_core.stages.corrections_walls import facing_of, find_plane

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

_SAME = 1e-3  # m, between where a wall lies and where it was moved to
_SPLIT = 0.05  # m, from the boundary of a region to the line that made it
WORDS = {"plane": "wall", "door": "door", "region": "region", "check": "check"}

Ids = str | Sequence[str] | None


def things(workbench: Workbench, kind: str, ids: Ids = None, least: int = 1) -> list[Any]:
    """The planes, doors or regions with these ids; those selected where none are given.

    :raises UsageError: where there are fewer than ``least``, or one is not in the plan.
    """
    if ids is None:
        names = [i.id for i in workbench.selection.items if i.kind == kind]
    else:
        names = [ids] if isinstance(ids, str) else list(ids)
    if len(set(names)) < least:
        raise UsageError(
            f"Select {'a' if least == 1 else f'at least {least}'} {WORDS[kind]}{'s' * (least > 1)} first."
        )
    found = [workbench.find(Item(kind, str(name))) for name in dict.fromkeys(names)]
    if None in found:
        missing = list(dict.fromkeys(names))[found.index(None)]
        raise UsageError(f"There is no {WORDS[kind]} {missing!r} in this plan.")
    return found


def point(workbench: Workbench, xy: Sequence[float]) -> Point:
    """Plan coordinates, checked, in the local frame."""
    if isinstance(xy, str) or len(xy) != 2 or not all(math.isfinite(float(v)) for v in xy):
        raise UsageError(f"A place is two numbers in metres, like (1.5, 2.0); given {xy!r}.")
    return workbench.to_local((float(xy[0]), float(xy[1])))


def middle(plane: LayoutPlane) -> float:
    """Where along a plane most of it is: the middle of its longest run."""
    runs = [(float(b - a), float(a + b) / 2) for a, b in (*plane.observed, *plane.walls)]
    return max(runs, default=(0.0, 0.0))[1]


def plane_at(workbench: Workbench, plane: LayoutPlane) -> PlaneAt:
    """A plane by a place on it and by the way it looks."""
    along = middle(plane)
    here = workbench.to_local(plane.point(along))
    there = workbench.to_local(plane.point(along, plane.offset + plane.facing.sign))
    length = math.hypot(there[0] - here[0], there[1] - here[1])
    return PlaneAt(here, ((there[0] - here[0]) / length, (there[1] - here[1]) / length))


def door_at(workbench: Workbench, door: Door) -> Point:
    """The middle of a door, local frame."""
    x, y = door.line().mean(axis=0)
    return workbench.to_local((float(x), float(y)))


def region_at(workbench: Workbench, region: Region) -> Point:
    """A place well inside a region, local frame."""
    inside = region.polygon.representative_point()
    return workbench.to_local((float(inside.x), float(inside.y)))


def about(workbench: Workbench, item: Item) -> frozenset[int]:
    """Which corrections of the document speak of a thing: their places in the list."""
    found = workbench.find(item)
    if found is None or workbench.plan is None:
        return frozenset()
    said = [_in_plan(c, workbench) for c in workbench.state.corrections]
    test = {"plane": _of_plane, "door": _of_door, "region": _of_region}.get(item.kind)
    return frozenset() if test is None else frozenset(test(said, found))


def _in_plan(correction: Correction, workbench: Workbench) -> Correction:
    assert workbench.plan is not None
    said = in_plan(shifted([correction], workbench.shift_to_plan()), workbench.plan.frame)
    return (*said.walls, *said.doors, *said.shapes, *said.names)[0]


def _of_plane(said: Sequence[Correction], plane: LayoutPlane) -> list[int]:
    """Backwards, as a wall may have been moved several times; in the axes of the wall's own part."""
    said = [turned_back(c, plane.turn) for c in said]
    plane = replace(plane, turn=0.0)
    out, axis = [], plane.facing.axis
    for k, c in reversed(list(enumerate(said))):
        if isinstance(c, MovePlane) and facing_of(c.plane.normal) == plane.facing:
            if abs(c.to[axis] - plane.offset) < _SAME and find_plane([plane], _beside(c.plane, plane)):
                out.append(k)
                plane = replace(plane, offset=c.plane.at[axis])
        elif _speaks_of(c, k, said, plane):
            out.append(k)
    return out


def _speaks_of(correction: Correction, index: int, said: Sequence[Correction], plane: LayoutPlane) -> bool:
    """True where a wall was switched, kept or added by this correction."""
    if isinstance(correction, HidePlane | KeepPlane):
        return _is_at(correction.plane, plane)
    return isinstance(correction, AddWall) and bool(plane.by_hand) and _is_added(plane.id, index, said)


def _beside(at: PlaneAt, plane: LayoutPlane) -> PlaneAt:
    """The same place along the wall, moved onto the plane."""
    return replace(at, at=plane.point(at.at[1 - plane.facing.axis]))


def _is_at(at: PlaneAt, plane: LayoutPlane) -> bool:
    if len(plane.walls) or len(plane.observed):
        return find_plane([plane], at) is not None
    near = (
        abs(at.at[plane.facing.axis] - plane.offset) <= REACH
    )  # a plane that nobody saw is where it is all along
    return facing_of(at.normal) == plane.facing and near


def _is_added(name: str, index: int, said: Sequence[Correction]) -> bool:
    number = sum(isinstance(c, AddWall) for c in said[: index + 1])
    return name in (f"hw{number}a", f"hw{number}b")


def _of_door(said: Sequence[Correction], door: Door) -> list[int]:
    out = []
    for k, c in enumerate(said):
        if isinstance(c, AcceptDoor | RejectDoor | ResizeDoor) and find_door([door], c.at):
            out.append(k)
        elif isinstance(c, AddDoor):
            centre = ((c.start[0] + c.end[0]) / 2, (c.start[1] + c.end[1]) / 2)
            out += [k] if door.by_hand and find_door([door], centre) else []
    return out


def _of_region(said: Sequence[Correction], region: Region) -> list[int]:
    def inside(at: Point) -> bool:
        return bool(region.polygon.contains(shapely.Point(at)))

    out = []
    for k, c in enumerate(said):
        if isinstance(c, LabelRegion | NameRegion):
            out += [k] if inside(c.at) else []
        elif isinstance(c, MergeRegions):
            out += [k] if any(map(inside, c.at)) else []
        elif isinstance(c, SplitRegion) and "split" in region.by_hand:
            line = shapely.LineString([c.start, c.end])
            out += [k] if line.distance(region.polygon) < _SPLIT else []
    return out


def names_of(word: str, chosen: Sequence[object]) -> str:
    """ "wall p3", "walls p3 and p7", "5 walls"."""
    names = [str(getattr(c, "name", "") or c.id) for c in chosen]  # type: ignore[attr-defined]
    if len(names) == 1:
        return f"{word} {names[0]}"
    return f"{word}s {' and '.join(names)}" if len(names) == 2 else f"{len(names)} {word}s"


def asked_number(workbench: Workbench, title: str, label: str, now: float) -> float | None:
    """Metres that a person types; None where they give up, :class:`UsageError` for what is no number."""
    text = workbench.ui.ask_text(title, label, number(now, ".3f"))
    if text is None:
        return None
    try:
        return float(text.strip().removesuffix("m").strip().replace(",", "."))
    except ValueError:
        raise UsageError(f"{text!r} is not a number of metres, like 3.412.") from None

"""From things of the plan to the corrections that name them by where they are, and back. No Qt."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from floorcast_app.format import number
from floorcast_app.layers.source import source_of
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
from floorplan_core.model.layout import turned
from floorplan_core.stages.corrections import REACH, in_plan, line_of, part_of, shifted, turned_back
from floorplan_core.stages.corrections_doors import find_door
from floorplan_core.stages.corrections_walls import ADDED, facing_of, find_plane

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

_SAME = 1e-3  # m, between where a wall lies and where it was moved to
_DRAWN = re.compile(rf"(w\d+)?{ADDED}\d+[ab]")  # ids of the faces of walls added by hand
_SPLIT = 0.05  # m, from the boundary of a region to the line that made it
WORDS = {"plane": "wall", "door": "door", "region": "region", "check": "check"}

_OF_REGIONS = (LabelRegion, NameRegion, MergeRegions, SplitRegion)

Ids = str | Sequence[str] | None
Said = Sequence[tuple[int, Correction]]  # place in the document's list, and what is said in plan coordinates


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


def across_door(workbench: Workbench, door: Door) -> Point:
    """Unit vector across the wall of a door, local frame: it tells in which wing the wall is."""
    normal = (1.0, 0.0) if door.axis == 0 else (0.0, 1.0)
    (x, y), (u, v) = door.in_plan(np.array([(0.0, 0.0), normal])).tolist()
    here, there = workbench.to_local((x, y)), workbench.to_local((u, v))
    return there[0] - here[0], there[1] - here[1]


def region_at(workbench: Workbench, region: Region) -> Point:
    """A place well inside a region, local frame."""
    inside = region.polygon.representative_point()
    return workbench.to_local((float(inside.x), float(inside.y)))


def line_across(workbench: Workbench, region: Region) -> tuple[Point, Point]:
    """Across the middle of a region, in the axes of its walls."""
    assert workbench.plan is not None
    inside = region.polygon.representative_point()
    turn = source_of(workbench.plan).turn_at(inside.x, inside.y)
    corners = turned(np.array(region.polygon.exterior.coords), -turn)
    (x0, y0), (x1, y1) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    ends = ((x, y0), (x, y1)) if x1 - x0 > y1 - y0 else ((x0, y), (x1, y))
    (ax, ay), (bx, by) = turned(np.array(ends), turn).tolist()
    return (ax, ay), (bx, by)


def about(workbench: Workbench, item: Item) -> frozenset[int]:
    """Which corrections of the document speak of a thing: their places in the list."""
    found = workbench.find(item)
    if found is None or workbench.plan is None:
        return frozenset()
    said = [(k, _in_plan(c, workbench)) for k, c in enumerate(workbench.state.corrections)]
    if isinstance(found, Region):
        return frozenset(_of_region(said, found))
    if not isinstance(found, LayoutPlane | Door):
        return frozenset()
    turns = [0.0, *(wing.turn for wing in workbench.plan.wings)]
    mine = turns.index(found.turn)  # the part whose wall it is: what is said of others does not count
    walls = [(k, c) for k, c in said if not isinstance(c, _OF_REGIONS) and part_of(c, turns) == mine]
    own = [(k, turned_back(c, found.turn)) for k, c in walls]
    plain = replace(found, turn=0.0)
    if isinstance(plain, Door):
        return frozenset(_of_door(own, plain))
    return frozenset(_of_plane(own, plain))


def _in_plan(correction: Correction, workbench: Workbench) -> Correction:
    assert workbench.plan is not None
    said = in_plan(shifted([correction], workbench.shift_to_plan()), workbench.plan.frame)
    return (*said.walls, *said.doors, *said.shapes, *said.names)[0]


def _of_plane(said: Said, plane: LayoutPlane) -> list[int]:
    """Backwards, as a wall may have been moved several times; in the axes of the wall's own part."""
    out, axis = [], plane.facing.axis
    for k, c in reversed(said):
        if isinstance(c, MovePlane) and facing_of(c.plane.normal) == plane.facing:
            if abs(c.to[axis] - plane.offset) < _SAME and find_plane([plane], _beside(c.plane, plane)):
                out.append(k)
                plane = replace(plane, offset=c.plane.at[axis])
        elif isinstance(c, HidePlane | KeepPlane):
            out += [k] if _is_at(c.plane, plane) else []
        elif isinstance(c, AddWall) and _DRAWN.fullmatch(plane.id):
            out += [k] if _is_face_of(plane, c) else []
    return out


def _is_face_of(plane: LayoutPlane, wall: AddWall) -> bool:
    """True where a plane drawn by hand is a face of that wall, or of another at the very same place."""
    axis, offset, (low, high) = line_of(wall.start, wall.end)
    face = offset + 0.5 * plane.facing.sign * wall.thickness
    if plane.facing.axis != axis or abs(plane.offset - face) >= _SAME:
        return False
    return len(plane.walls) == 0 or bool(plane.walls.min() < high and plane.walls.max() > low)


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


def _of_door(said: Said, door: Door) -> list[int]:
    out = []
    for k, c in said:
        if isinstance(c, AcceptDoor | RejectDoor | ResizeDoor) and find_door([door], c.at):
            out.append(k)
        elif isinstance(c, AddDoor):
            centre = ((c.start[0] + c.end[0]) / 2, (c.start[1] + c.end[1]) / 2)
            out += [k] if door.by_hand and find_door([door], centre) else []
    return out


def _of_region(said: Said, region: Region) -> list[int]:
    def inside(at: Point) -> bool:
        return bool(region.polygon.contains(shapely.Point(at)))

    out = []
    for k, c in said:
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

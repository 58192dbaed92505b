"""The correct menu: what a person says against the machine, each one undoable step.

Things are given by id, or are those selected; places are plan coordinates in metres.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from floorcast_app.actions.naming import (
    Ids,
    about,
    across_door,
    asked_number,
    door_at,
    line_across,
    middle,
    names_of,
    plane_at,
    point,
    region_at,
    things,
)
from floorcast_app.actions.registry import Action, with_plan
from floorcast_app.selection import Item
from floorplan_core.errors import UsageError
from floorplan_core.model import Door, LayoutPlane
from floorplan_core.model.corrections import (
    AcceptDoor,
    AddDoor,
    AddWall,
    HidePlane,
    KeepPlane,
    LabelRegion,
    MergeRegions,
    MovePlane,
    NameRegion,
    RejectDoor,
    ResizeDoor,
    SplitRegion,
)

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

Place = Sequence[float]  # x, y in metres, plan coordinates

_SNAP = 0.15  # m, within which a wall that is moved goes to a surface that was seen
_WIDEST_DOOR = 1.3  # m: what is wider is an opening
_THICKEST = 2.0  # m of a wall added by hand


def hide_plane(workbench: Workbench, plane: Ids = None) -> None:
    """Say of walls that they are none."""
    chosen = things(workbench, "plane", plane)
    workbench.correct(
        f"Switch off {names_of('wall', chosen)}", *(HidePlane(plane_at(workbench, p)) for p in chosen)
    )


def keep_plane(workbench: Workbench, plane: Ids = None) -> None:
    """Say of planes that they are walls; switches them on again, too."""
    chosen = things(workbench, "plane", plane)
    workbench.correct(
        f"Keep {names_of('wall', chosen)}", *(KeepPlane(plane_at(workbench, p)) for p in chosen)
    )


def move_plane(
    workbench: Workbench,
    plane: str | None = None,
    to: Place | None = None,
    offset: float | None = None,
    snap: bool = False,
) -> None:
    """Move a wall through a place, or to an exact offset; asked for where neither is given.

    :param snap: go to the nearest surface seen that looks the same way, if there is one within 15 cm.
    """
    wall: LayoutPlane = things(workbench, "plane", plane)[0]
    if to is not None:
        x, y = (float(v) for v in to)
        offset = wall.own((x, y))[1]
    if offset is None:
        offset = asked_number(workbench, "Move wall", "Offset in metres", wall.offset)
    if offset is None:
        return
    if snap:
        offset = _snapped(workbench, wall, offset)
    target = point(workbench, wall.point(middle(wall), offset))
    moved = MovePlane(plane_at(workbench, wall), target)
    workbench.correct(f"Move wall {wall.id} to {offset:.3f} m", moved)


def _snapped(workbench: Workbench, wall: LayoutPlane, offset: float) -> float:
    assert workbench.plan is not None
    segments = workbench.plan.all_segments
    seen = [s.offset for s in segments if (s.facing, s.turn) == (wall.facing, wall.turn)]
    nearest = min(seen, key=lambda o: abs(o - offset), default=offset)
    return nearest if abs(nearest - offset) <= _SNAP else offset


def add_wall(
    workbench: Workbench,
    start: Place | None = None,
    end: Place | None = None,
    thickness: float | None = None,
) -> None:
    """Draw a wall from ``start`` to ``end``, as thick as the others if not said. Without: take the tool."""
    if start is None or end is None:
        workbench.set_tool("wall")
        return
    thick = _usual_thickness(workbench) if thickness is None else float(thickness)
    if not 0 <= thick <= _THICKEST:
        raise UsageError(f"A wall of {thick:g} m is no wall: its thickness is between 0 and {_THICKEST:g} m.")
    workbench.correct("Add wall", AddWall(point(workbench, start), point(workbench, end), thick))


def _usual_thickness(workbench: Workbench) -> float:
    from floorplan_core.stages.region_sides import typical_thickness

    assert workbench.plan is not None
    return round(typical_thickness(workbench.plan.planes), 3)


def accept_door(workbench: Workbench, door: Ids = None) -> None:
    """Say of doors that they are ones."""
    chosen = things(workbench, "door", door)
    workbench.correct(
        f"Accept {names_of('door', chosen)}",
        *(AcceptDoor(door_at(workbench, d), across_door(workbench, d)) for d in chosen),
    )


def reject_door(workbench: Workbench, door: Ids = None) -> None:
    """Say of doors that there is wall."""
    chosen = things(workbench, "door", door)
    workbench.correct(
        f"Reject {names_of('door', chosen)}",
        *(RejectDoor(door_at(workbench, d), across_door(workbench, d)) for d in chosen),
    )


def add_door(
    workbench: Workbench, start: Place | None = None, end: Place | None = None, kind: str = "auto"
) -> None:
    """A door in the wall along the line from ``start`` to ``end``. Without: take the tool.

    :param kind: "door", "opening", or "auto": by its width.
    """
    if start is None or end is None:
        workbench.set_tool("door")
        return
    if kind not in ("auto", "door", "opening"):
        raise UsageError(f"A door is a 'door' or an 'opening', not {kind!r}.")
    width = math.dist([float(v) for v in start], [float(v) for v in end])
    if kind == "auto":
        kind = "opening" if width > _WIDEST_DOOR else "door"
    workbench.correct("Add door", AddDoor(point(workbench, start), point(workbench, end), kind))


def resize_door(
    workbench: Workbench,
    door: str | None = None,
    width: float | None = None,
    start: Place | None = None,
    end: Place | None = None,
) -> None:
    """A door of another width about its middle, or from ``start`` to ``end``; asked for where not given."""
    chosen: Door = things(workbench, "door", door)[0]
    if start is None or end is None:
        if width is None:
            width = asked_number(workbench, "Resize door", "Width in metres", chosen.width)
        if width is None:
            return
        if not width > 0:
            raise UsageError(f"A door cannot be {width:g} m wide.")
        half, centre = width / 2, (chosen.start + chosen.end) / 2
        start, end = replace(chosen, start=centre - half, end=centre + half).line().tolist()
    along = 1 - chosen.axis
    low, high = sorted(chosen.in_own(np.array([start, end], dtype=np.float64))[:, along].tolist())
    text = f"Resize door {chosen.id} to {high - low:.3f} m"
    ends = point(workbench, start), point(workbench, end)
    workbench.correct(text, ResizeDoor(door_at(workbench, chosen), *ends))


def relabel(workbench: Workbench, region: Ids = None, label: str | None = None) -> None:
    """Say what regions are: "room", "corridor", or any word."""
    chosen = things(workbench, "region", region)
    if label is None:
        label = workbench.ui.ask_text("Relabel region", "Room, corridor or any other word", chosen[0].label)
    if label is None:
        return
    if not label.strip():
        raise UsageError("A label is a word, like room or corridor.")
    said = (LabelRegion(region_at(workbench, r), label.strip()) for r in chosen)
    workbench.correct(f"Label {names_of('region', chosen)} as {label.strip()}", *said)


def rename(workbench: Workbench, region: str | None = None, name: str | None = None) -> None:
    """Give a region another name."""
    chosen = things(workbench, "region", region)[0]
    if name is None:
        name = workbench.ui.ask_text("Rename region", "Name", chosen.name)
    if name is None or name.strip() == chosen.name:
        return
    if not name.strip():
        raise UsageError("A name must not be empty.")
    assert workbench.plan is not None
    if any(r.name == name.strip() for r in workbench.plan.regions):
        raise UsageError(f"There is a region {name.strip()} already.")
    said = NameRegion(region_at(workbench, chosen), name.strip())
    workbench.correct(f"Rename region {chosen.name} to {name.strip()}", said)


def merge(workbench: Workbench, regions: Ids = None) -> None:
    """Make regions that touch one. With fewer than two selected: take the tool."""
    selected = [i for i in workbench.selection.items if i.kind == "region"]
    if regions is None and len(selected) < 2:
        workbench.set_tool("merge")
        return
    chosen = things(workbench, "region", regions, least=2)
    said = MergeRegions(tuple(region_at(workbench, r) for r in chosen))
    workbench.correct(f"Merge {names_of('region', chosen)}", said)


def split(
    workbench: Workbench, start: Place | None = None, end: Place | None = None, region: str | None = None
) -> None:
    """Cut the region that the line from ``start`` to ``end`` crosses, from side to side.

    With a region only: across the middle of its longer extent. Without anything: take the tool.
    """
    if region is not None and (start is None or end is None):
        start, end = line_across(workbench, things(workbench, "region", region)[0])
    if start is None or end is None:
        workbench.set_tool("split")
        return
    workbench.correct("Split region", SplitRegion(point(workbench, start), point(workbench, end)))


def release(workbench: Workbench, item: Item | str | None = None) -> None:
    """Take back all that was said of a thing (the leading one of the selection): the machine decides again.

    :param item: an item, or its kind and id like "door:d3".
    """
    if isinstance(item, str):
        item = Item(*item.partition(":")[::2])
    item = item or workbench.selection.item
    if item is None:
        raise UsageError("Select a wall, a door or a region first.")
    gone = about(workbench, item)
    if not gone:
        raise UsageError(f"Nothing was said by hand of {item.id}.")
    kept = tuple(c for k, c in enumerate(workbench.state.corrections) if k not in gone)
    workbench.change(f"Release {item.id}", corrections=kept)


def clear(workbench: Workbench) -> None:
    """Take all corrections back, in one step."""
    workbench.change("Take back all corrections", corrections=())


ACTIONS: tuple[Action, ...] = (
    Action(
        "correct.keep_plane",
        "Keep wall",
        keep_plane,
        "It is a wall, even where the machine takes it for furniture; also switches a wall on again.",
        "K",
        "lock",
        with_plan,
    ),
    Action(
        "correct.hide_plane",
        "Switch wall off",
        hide_plane,
        "It is no wall: it bounds no room and keeps none apart.",
        "H",
        "eye-off",
        with_plan,
    ),
    Action(
        "correct.move_plane",
        "Move wall…",
        move_plane,
        "Type where it lies; or drag it in a plan, where it snaps to what was seen.",
        "",
        "move",
        with_plan,
    ),
    Action(
        "correct.add_wall",
        "Add wall",
        add_wall,
        "Draw a wall that the machine does not know: two clicks.",
        "",
        "brick-wall",
        with_plan,
    ),
    Action(
        "correct.accept_door",
        "Accept door",
        accept_door,
        "It is a door, however sure the machine is.",
        "Y",
        "circle-check",
        with_plan,
    ),
    Action(
        "correct.reject_door",
        "Reject door",
        reject_door,
        "It is no door: the wall goes on here.",
        "N",
        "ban",
        with_plan,
    ),
    Action(
        "correct.add_door",
        "Add door",
        add_door,
        "Two clicks on a wall, one at each jamb.",
        "",
        "door-open",
        with_plan,
    ),
    Action(
        "correct.resize_door",
        "Resize door…",
        resize_door,
        "Type the width of the opening; or drag its ends in a plan.",
        "",
        "ruler-dimension-line",
        with_plan,
    ),
    Action(
        "correct.relabel",
        "Relabel region…",
        relabel,
        "Room, corridor, or a word of your own.",
        "L",
        "tag",
        with_plan,
    ),
    Action(
        "correct.rename",
        "Rename region…",
        rename,
        "Give it the name that people use.",
        "F2",
        "text-cursor-input",
        with_plan,
    ),
    Action(
        "correct.merge",
        "Merge regions",
        merge,
        "Make the selected regions one; the wall between them goes.",
        "Ctrl+M",
        "merge",
        with_plan,
    ),
    Action(
        "correct.split",
        "Split region",
        split,
        "Two clicks: the region between them is cut from side to side.",
        "",
        "split",
        with_plan,
    ),
    Action(
        "correct.release",
        "Release",
        release,
        "Take back all that was said of it by hand: the machine decides again.",
        "",
        "lock-open",
        with_plan,
    ),
    Action(
        "correct.clear",
        "Take back all corrections",
        clear,
        "The plan as the machine made it; undo brings your corrections back.",
        "",
        "rotate-ccw",
        lambda w: bool(w.state.corrections),
    ),
)

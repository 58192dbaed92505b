"""Select, and take hold of what is selected: a plane is moved across itself, a door's end along its wall."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from floorcast_app import format
from floorcast_app.layers.snap_index import snap_offset
from floorcast_app.selection import Item
from floorcast_app.tools.gestures import GRIP, SNAP, At, Mark, Point, Tool, Typed, distance, way
from floorplan_core.model import Door, LayoutPlane
from floorplan_core.model.layout import turned

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

SHORTEST_DOOR = 0.3  # metres: an end cannot be dragged nearer to the other


@dataclass
class PlaneDrag:
    """A plane on its way."""

    plane: LayoutPlane
    grip: Point  # where it was taken hold of
    offset: float  # metres, where it would go now
    segment: str = ""  # the observed segment that it snapped to


@dataclass
class DoorDrag:
    """A door's end on its way."""

    door: Door
    end: int  # 0: the start is dragged, 1: the end
    value: float  # metres along the wall, where it would go now


class SelectTool(Tool):
    """Click selects; Ctrl adds; what is selected can be dragged; a typed number sets its offset or width."""

    name = "select"
    plane_hint = "Drag the wall, or type its offset (@0.05 moves it by that)."
    door_hint = "Drag an end of the door, or type its width."

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._held: PlaneDrag | DoorDrag | None = None
        self._moving = False
        self._typed = Typed()

    @property
    def hint(self) -> str:  # type: ignore[override]
        """What can be done with the one thing that is selected."""
        held = self._selected()
        if held is None:
            return ""
        return self.plane_hint if isinstance(held, PlaneDrag) else self.door_hint

    def cursor_at(self, at: At) -> str:
        held = self._held or self._grip(at)
        if held is None:
            return self.cursor
        if isinstance(held, PlaneDrag):
            return way(held.plane.turn + held.plane.facing.axis * math.pi / 2)
        return way(held.door.turn + (1 - held.door.axis) * math.pi / 2)

    @property
    def busy(self) -> bool:
        return self._moving or bool(self._typed.text)

    @property
    def drags(self) -> bool:
        return self._held is not None

    def press(self, at: At) -> None:
        self._held = self._grip(at)
        self._typed = Typed()

    def drag(self, at: At) -> None:
        self._moving = True
        if isinstance(self._held, PlaneDrag):
            self._drag_plane(self._held, at)
        elif isinstance(self._held, DoorDrag):
            self._drag_door(self._held, at)

    def release(self, at: At, moved: bool) -> None:
        held = self._held if self._moving else None
        self.cancel()
        if held is not None:
            self._commit(held)
        elif not moved:
            self.click(at)

    def click(self, at: At) -> None:
        """What a click without a drag does."""
        self.workbench.selection.select(at.item, at.ctrl)

    def key(self, key: str) -> bool:
        held = self._held or self._selected()
        if key == "Enter" and self._typed.metres is not None and held is not None:
            self._set_typed(held)
            self.cancel()
            self._commit(held)
            return True
        if held is None or not self._typed.take(key):
            return False
        self._held = held if self._typed.text or self._moving else None
        self._set_typed(held)
        return True

    def cancel(self) -> bool:
        was = self.busy
        self._held, self._moving, self._typed = None, False, Typed()
        return was

    def marks(self) -> tuple[Mark, ...]:
        if self._held is None or not self.busy:
            return self._grips()
        if isinstance(self._held, PlaneDrag):
            return self._plane_marks(self._held)
        return self._door_marks(self._held)

    # ---- planes -----------------------------------------------------------------------------------------

    def _drag_plane(self, held: PlaneDrag, at: At) -> None:
        if self._typed.metres is not None:
            return
        own = held.plane.own
        wanted = held.plane.offset + own(at.xy)[1] - own(held.grip)[1]
        reach = 0.0 if at.shift else at.reach(SNAP)
        source = self.source
        assert source is not None
        held.offset, held.segment = snap_offset(source, held.plane, wanted, reach)

    def _plane_marks(self, held: PlaneDrag) -> tuple[Mark, ...]:
        axis = held.plane.facing.axis
        units = self.workbench.view.look.units
        moved = format.length(held.offset - held.plane.offset, units)
        sign = "" if moved.startswith("-") else "+"
        text = f"{'xy'[axis]} {format.length(held.offset, units)}  ({sign}{moved})"
        if self._typed.text:
            text = f"{'xy'[axis]} {self._typed.text}▏ → {format.length(held.offset, units)}"
        turn = held.plane.turn
        at = held.plane.point(held.plane.own(held.grip)[0], held.offset)
        marks = [Mark("plane", (at,), axis=axis, turn=turn), Mark("text", (at,), text=text)]
        segment = next((s for s in self.source.plan.all_segments if s.id == held.segment), None)  # type: ignore[union-attr]
        if segment is not None:
            (a, b), (c, d) = turned(segment.line(), turn).tolist()
            marks.insert(1, Mark("line", ((a, b), (c, d)), "warning"))
        return tuple(marks)

    # ---- doors ------------------------------------------------------------------------------------------

    def _drag_door(self, held: DoorDrag, at: At) -> None:
        source = self.source
        if self._typed.metres is not None or source is None:
            return
        x, y = at.xy if at.shift else source.snaps.at(at.x, at.y, at.reach(SNAP)).xy
        door = held.door
        ((own_x, own_y),) = door.in_own(np.array([[x, y]])).tolist()
        value = own_y if door.axis == 0 else own_x
        low, high = door.start + SHORTEST_DOOR, door.end - SHORTEST_DOOR
        held.value = max(value, low) if held.end else min(value, high)

    def _door_marks(self, held: DoorDrag) -> tuple[Mark, ...]:
        a, b = door_ends(held.door, *_span(held))
        width = format.length(distance(a, b), self.workbench.view.look.units)
        text = f"{self._typed.text}▏ → {width}" if self._typed.text else width
        return Mark("line", (a, b), "door"), Mark("text", (b if held.end else a,), text=text)

    # ---- both -------------------------------------------------------------------------------------------

    def _selected(self) -> PlaneDrag | DoorDrag | None:
        """Hold of the one selected thing, for a number that is typed."""
        items = self.workbench.selection.items
        thing = self.workbench.find(items[0]) if len(items) == 1 else None
        if isinstance(thing, LayoutPlane):
            return PlaneDrag(thing, _middle(thing), thing.offset)
        return DoorDrag(thing, 1, thing.end) if isinstance(thing, Door) else None

    def _grip(self, at: At) -> PlaneDrag | DoorDrag | None:
        """Hold of what is selected, where the pointer is on it."""
        thing = self.workbench.find(self.workbench.selection.item)
        if isinstance(thing, Door):
            ends = door_ends(thing, thing.start, thing.end)
            away = [distance(at.xy, end) for end in ends]
            k = away.index(min(away))
            return DoorDrag(thing, k, (thing.start, thing.end)[k]) if away[k] <= at.reach(GRIP) else None
        if isinstance(thing, LayoutPlane) and at.item == Item("plane", thing.id):
            return PlaneDrag(thing, at.xy, thing.offset)
        return None

    def _grips(self) -> tuple[Mark, ...]:
        """Dots where a selected door can be taken hold of."""
        thing = self.workbench.find(self.workbench.selection.item)
        if not isinstance(thing, Door):
            return ()
        return (Mark("grips", door_ends(thing, thing.start, thing.end)),)

    def _set_typed(self, held: PlaneDrag | DoorDrag) -> None:
        number = self._typed.metres
        if isinstance(held, PlaneDrag):
            base = held.plane.offset if self._typed.relative or number is None else 0.0
            held.offset, held.segment = base + (number or 0.0), ""
        elif number is not None:
            width = number + (held.door.width if self._typed.relative else 0.0)
            width = max(width, SHORTEST_DOOR)
            held.value = held.door.start + width if held.end else held.door.end - width

    def _commit(self, held: PlaneDrag | DoorDrag) -> None:
        if isinstance(held, PlaneDrag):
            if held.offset != held.plane.offset:
                self.workbench.try_run("correct.move_plane", plane=held.plane.id, offset=held.offset)
            return
        a, b = door_ends(held.door, *_span(held))
        self.workbench.try_run("correct.resize_door", door=held.door.id, start=a, end=b)


def door_ends(door: Door, start: float, end: float) -> tuple[Point, Point]:
    """The points of a door's wall at two coordinates along it."""
    (ax, ay), (bx, by) = replace(door, start=start, end=end).line().tolist()
    return (ax, ay), (bx, by)


def _span(held: DoorDrag) -> tuple[float, float]:
    """Where the door would begin and end now."""
    return (held.door.start, held.value) if held.end else (held.value, held.door.end)


def _middle(plane: LayoutPlane) -> Point:
    """A point on the plane, in the middle of what was seen."""
    runs = plane.observed
    along = float((runs.min() + runs.max()) / 2) if len(runs) else 0.0
    return plane.point(along)

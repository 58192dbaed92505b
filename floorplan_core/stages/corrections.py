"""What a person says against the machine, applied on top of what the stages made.

Corrections name things by where they are, in the local frame. Here they are brought into the manhattan frame
and sorted by the stage that they follow; the modules ``corrections_walls``, ``_doors`` and ``_regions`` apply
them in the order in which they were made. The machine's own results stay untouched; a correction that finds
nothing is a sentence for the user, never an error.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from floorplan_core.model import LayoutPlane, ManhattanFrame
from floorplan_core.model.corrections import (
    UNSAID,
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
from floorplan_core.model.quarter_turns import turned_place

WALL_KINDS = (HidePlane, KeepPlane, MovePlane, AddWall)
DOOR_KINDS = (AcceptDoor, RejectDoor, AddDoor, ResizeDoor)
SHAPE_KINDS = (MergeRegions, SplitRegion)
NAME_KINDS = (LabelRegion, NameRegion)

REACH = 0.5  # m from the point of a correction, within which the thing it is about must lie

Span = tuple[float, float]
Move = Callable[[Sequence[Point], bool], tuple[Point, ...]]  # places, or directions where True


class Placed(str):
    """A sentence that names places (manhattan frame in which it was said), to be said in other axes, too.

    :param points: the places, each written as ``form`` writes it.
    """

    points: tuple[Point, ...]
    form: Callable[[Point], str]

    def __new__(cls, text: str, *points: Point, form: Callable[[Point], str] | None = None) -> Placed:
        sentence = super().__new__(cls, text)
        sentence.points, sentence.form = points, form or place
        return sentence

    def within(self, text: str) -> Placed:
        """``text``, of which this is a part."""
        return Placed(text, *self.points, form=self.form)

    def turned(self, quarters: int) -> str:
        """The sentence in axes turned by so many quarters, counter-clockwise."""
        text = str(self)
        for point in self.points:
            text = text.replace(self.form(point), self.form(turned_place(point, quarters)))
        return text


def _said_turned(text: str, quarters: int) -> str:
    return text.turned(quarters) if isinstance(text, Placed) else text


@dataclass(frozen=True)
class Remarks:
    """What came of some corrections."""

    machine: tuple[tuple[str, str], ...] = ()  # id, what the machine had said of it
    warnings: tuple[str, ...] = ()  # sentences

    def __add__(self, other: Remarks) -> Remarks:
        return Remarks(self.machine + other.machine, self.warnings + other.warnings)

    def turned(self, quarters: int) -> Remarks:
        """The same in axes turned by so many quarters."""
        machine = tuple((ident, _said_turned(text, quarters)) for ident, text in self.machine)
        return Remarks(machine, tuple(_said_turned(text, quarters) for text in self.warnings))

    def machine_said(self) -> dict[str, str]:
        """By id all that the machine had said of a thing, in the order in which it was overruled."""
        out: dict[str, str] = {}
        for ident, text in self.machine:
            if text not in out.get(ident, "").split("; "):
                out[ident] = f"{out[ident]}; {text}" if ident in out else text
        return out


NOTHING = Remarks()


@dataclass(frozen=True)
class Said:
    """The corrections of one plan in its manhattan frame, by what they change; each in the order made."""

    walls: tuple[Correction, ...] = ()
    doors: tuple[Correction, ...] = ()
    shapes: tuple[Correction, ...] = ()
    names: tuple[Correction, ...] = ()


def shifted(corrections: Sequence[Correction], by: Point) -> tuple[Correction, ...]:
    """The corrections with all places moved by ``by`` metres; the same ones where that is nothing."""
    if not any(by):
        return tuple(corrections)

    def move(points: Sequence[Point], direction: bool) -> tuple[Point, ...]:
        return tuple(points) if direction else tuple((x + by[0], y + by[1]) for x, y in points)

    return tuple(_moved(c, move) for c in corrections)


def in_plan(corrections: Sequence[Correction], frame: ManhattanFrame) -> Said:
    """The corrections with all points in manhattan coordinates."""

    def move(points: Sequence[Point], direction: bool) -> tuple[Point, ...]:
        moved = frame.plan_from_local(np.array(points, dtype=np.float64).reshape(-1, 2))
        if direction:
            moved = moved - frame.plan_from_local(np.zeros((1, 2)))
        return tuple((float(x), float(y)) for x, y in moved)

    moved: list[Correction] = [_moved(c, move) for c in corrections]

    def of(kinds: tuple[type[Correction], ...]) -> tuple[Correction, ...]:
        return tuple(c for c in moved if isinstance(c, kinds))

    return Said(of(WALL_KINDS), of(DOOR_KINDS), of(SHAPE_KINDS), of(NAME_KINDS))


def said_of_part(said: Said, part: int, turns: Sequence[float]) -> Said:
    """What of all that was said is about one part of a building, in the axes of that part.

    Shapes and names of regions are said of the whole plan.

    :param turns: radians from the plan's axes to those of each part, that of the building (0) first.
    """

    def own(corrections: Sequence[Correction]) -> tuple[Correction, ...]:
        return tuple(turned_back(c, turns[part]) for c in corrections if part_of(c, turns) == part)

    return Said(walls=own(said.walls), doors=own(said.doors))


def turned_back(correction: Correction, turn: float) -> Correction:
    """A correction with its places in axes that are turned by ``turn`` radians."""

    def move(points: Sequence[Point], _direction: bool) -> tuple[Point, ...]:
        return tuple((float(x), float(y)) for x, y in turned(np.array(points), -turn))

    moved: Correction = _moved(correction, move) if turn else correction
    return moved


def part_of(correction: Any, turns: Sequence[float]) -> int:
    """The part to whose axes a wall, a door's wall or a line drawn is nearest; of two as near the first.

    The first one, too, for a door of which was not said how its wall stands.
    """
    if isinstance(correction, AddWall | AddDoor | ResizeDoor | SplitRegion):
        (x0, y0), (x1, y1) = correction.start, correction.end
        across = x1 - x0, y1 - y0
    else:
        across = getattr(correction, "normal", None) or correction.plane.normal
    if across == UNSAID:
        return 0
    angle = math.atan2(across[1], across[0])
    quarter = math.pi / 2
    away = [abs((angle - turn + quarter / 2) % quarter - quarter / 2) for turn in turns]
    return min(range(len(turns)), key=lambda k: (round(away[k], 9), k))


def _moved(correction: Any, move: Move) -> Any:
    """A correction, or a part of one, with its points moved."""

    def value(name: str, old: Any) -> Any:
        if isinstance(old, PlaneAt):
            return _moved(old, move)
        if not isinstance(old, tuple) or not old:
            return old
        many = isinstance(old[0], tuple)
        points = move(old if many else [old], name == "normal")
        return points if many else points[0]

    values = {f.name: value(f.name, getattr(correction, f.name)) for f in fields(correction)}
    return replace(correction, **values)


def place(point: Point) -> str:
    """A point as a sentence names it."""
    return f"({point[0]:.2f}, {point[1]:.2f})"


def wall_place(point: Point) -> str:
    """Where a wall is along its normal, of a point of which the other coordinate is 0."""
    return f"{point[0] + point[1]:.3f} m"


def line_of(start: Point, end: Point) -> tuple[int, float, Span]:
    """The axis-parallel line that two clicks mean: axis of its normal, offset, from where to where."""
    axis = 0 if abs(end[0] - start[0]) < abs(end[1] - start[1]) else 1
    low, high = sorted((start[1 - axis], end[1 - axis]))
    return axis, 0.5 * (start[axis] + end[axis]), (low, high)


def runs_of(plane: LayoutPlane) -> list[Span]:
    """Where a plane has a surface: its wall runs and what was seen of it."""
    return [(float(a), float(b)) for a, b in (*plane.walls, *plane.observed)]


def beyond(runs: Sequence[Span], at: float) -> float:
    """Metres from ``at`` to the nearest of the runs along the same line; 0 inside one, inf without any."""
    return min((max(a - at, at - b, 0.0) for a, b in runs), default=float("inf"))


def without(runs: np.ndarray[Any, Any], span: Span) -> np.ndarray[Any, Any]:
    """The runs (K, 2) less a span."""
    low, high = span
    pieces = [p for s, e in runs for p in ((s, min(e, low)), (max(s, high), e)) if p[1] - p[0] > 1e-6]
    return np.array(pieces, dtype=np.float64).reshape(-1, 2)


def joined(runs: np.ndarray[Any, Any], span: Span) -> np.ndarray[Any, Any]:
    """The runs (K, 2) and a span as disjoint runs in order."""
    out: list[list[float]] = []
    for start, end in sorted([*((float(s), float(e)) for s, e in runs), span]):
        if out and start <= out[-1][1] + 1e-6:
            out[-1][1] = max(out[-1][1], end)
        else:
            out.append([start, end])
    return np.array(out, dtype=np.float64).reshape(-1, 2)

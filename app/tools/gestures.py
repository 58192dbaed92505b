"""The words in which panes and tools talk: where the pointer is, what is to be drawn, what is typed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from floorcast_app.format import parse_length
from floorcast_app.layers.source import PlanSource, source_of
from floorcast_app.selection import Item

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

Point = tuple[float, float]  # metres, manhattan frame
WAYS = ("x", "rising", "y", "falling")  # as a cursor shows them, by eighths of a turn from x

SNAP = 10.0  # pixels within which a click snaps
GRIP = 8.0  # pixels around the end of a door that can be dragged
TYPED = "0123456789.,-@'\"/"  # characters of a typed length; @ begins a relative one


@dataclass(frozen=True)
class At:
    """The pointer in a pane."""

    x: float  # metres, manhattan frame
    y: float
    scale: float  # pixels for a metre
    item: Item | None = None  # what lies under it
    shift: bool = False
    ctrl: bool = False

    @property
    def xy(self) -> Point:
        """The point."""
        return self.x, self.y

    def reach(self, pixels: float) -> float:
        """Pixels in metres."""
        return pixels / self.scale


@dataclass(frozen=True)
class Mark:
    """Something that a tool wants drawn."""

    kind: str  # "line", "dashes", "area", "dot", "grips", "snap", "plane" or "text"
    points: tuple[Point, ...]  # metres; for "plane" one point on it
    role: str = "selection"  # "selection", "door", "wall" or "warning"
    text: str = ""  # beside the last point, or on the middle of a line
    axis: int = 0  # of a plane's normal
    turn: float = 0.0  # radians from the plan's axes to those of the plane


class Typed:
    """A length that is being typed: digits, Backspace; ``@`` first means relative."""

    def __init__(self) -> None:
        self.text = ""

    def take(self, key: str) -> bool:
        """True where ``key`` belongs to a number."""
        if key == "Backspace" and self.text:
            self.text = self.text[:-1]
            return True
        if (len(key) == 1 and key in TYPED) or (key == " " and self.text):
            self.text += key
            return True
        return False

    @property
    def relative(self) -> bool:
        """True where the number is to be added."""
        return self.text.startswith("@")

    @property
    def metres(self) -> float | None:
        """What was typed; None where it is no number yet."""
        value = parse_length(self.text.removeprefix("@"))
        return value if value is not None and math.isfinite(value) else None


class Tool:
    """A tool; its methods change what :meth:`marks` shows and, at the end of a gesture, the document."""

    name = "select"
    hint = ""
    cursor = "arrow"  # or "cross"
    lights: tuple[str, ...] = (
        "check",
        "door",
        "plane",
        "region",
    )  # kinds of items that light up under the pointer

    def __init__(self, workbench: Workbench) -> None:
        self.workbench = workbench

    @property
    def source(self) -> PlanSource | None:
        """The plan that is worked on."""
        plan = self.workbench.plan
        return None if plan is None else source_of(plan)

    @property
    def busy(self) -> bool:
        """True in the middle of a gesture."""
        return False

    @property
    def drags(self) -> bool:
        """True where moving with the button held belongs to the tool; else it moves the plan."""
        return False

    def press(self, at: At) -> None:
        """The left button went down."""

    def drag(self, at: At) -> None:
        """The pointer moved with the left button down, and :attr:`drags` holds."""

    def release(self, at: At, moved: bool) -> None:
        """The left button went up; ``moved``: it was a drag, not a click."""

    def move(self, at: At) -> None:
        """The pointer moved with no button down."""

    def cursor_at(self, at: At) -> str:
        """The cursor over a place: "arrow", "cross", or which way something goes, one of :data:`WAYS`."""
        return self.cursor

    def double(self, at: At) -> bool:
        """A double click; False where the pane shall zoom to what lies there."""
        return False

    def key(self, key: str) -> bool:
        """A character, "Enter" or "Backspace"; True where the tool took it."""
        return False

    def cancel(self) -> bool:
        """Give up the gesture; False where there was none."""
        return False

    def marks(self) -> tuple[Mark, ...]:
        """What to draw over the panes."""
        return ()


def way(angle: float) -> str:
    """The one of :data:`WAYS` that is nearest to a direction, radians from x."""
    return WAYS[round(angle / (math.pi / 4)) % len(WAYS)]


def straight(start: Point, end: Point, turn: float = 0.0) -> Point:
    """``end`` moved so that the line from ``start`` runs along x or y, whichever it is nearer to.

    :param turn: radians from the plan's axes to those that x and y are here.

    >>> straight((1.0, 1.0), (3.0, 1.4))
    (3.0, 1.0)
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    if turn == 0.0:
        return (end[0], start[1]) if abs(dx) >= abs(dy) else (start[0], end[1])
    x, y = (math.cos(turn), math.sin(turn)), (-math.sin(turn), math.cos(turn))
    return on_line(start, max((x, y), key=lambda u: abs(dx * u[0] + dy * u[1])), end)


def on_line(start: Point, along: Point, at: Point) -> Point:
    """The foot of a place on the line through ``start`` along a unit vector."""
    t = (at[0] - start[0]) * along[0] + (at[1] - start[1]) * along[1]
    return start[0] + t * along[0], start[1] + t * along[1]


def towards(start: Point, end: Point, length: float) -> Point:
    """The point ``length`` metres from ``start`` in the direction of ``end`` (along x where they are one)."""
    d = distance(start, end)
    u = ((end[0] - start[0]) / d, (end[1] - start[1]) / d) if d > 0 else (1.0, 0.0)
    return start[0] + length * u[0], start[1] + length * u[1]


def distance(start: Point, end: Point) -> float:
    """Metres."""
    return math.hypot(end[0] - start[0], end[1] - start[1])

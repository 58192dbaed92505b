"""What a person says against the machine: constraints that are kept through every rerun and better data.

All positions are in the local frame of the survey (metres, z up; world minus its large offset), so that they
mean the same place when a rerun turns the Manhattan frame by a hair. A thing is named by where it is, never
by its id: ``at`` is a point on it (a wall, a door) or in it (a region).
"""

from __future__ import annotations

from dataclasses import dataclass

Point = tuple[float, float]  # metres, local frame
UNSAID = (0.0, 0.0)  # a normal that was not said: of a wall along the building's own axes


@dataclass(frozen=True)
class PlaneAt:
    """The layout plane nearest to a point, among those that look the same way."""

    at: Point
    normal: Point  # unit vector, into the free space that the plane bounds


@dataclass(frozen=True)
class HidePlane:
    """This plane is no wall: it is neither paired nor does it block."""

    plane: PlaneAt


@dataclass(frozen=True)
class KeepPlane:
    """This plane is a wall, even where the machine takes it for furniture or speculates it (a lock)."""

    plane: PlaneAt


@dataclass(frozen=True)
class MovePlane:
    """This plane lies elsewhere: it goes through ``to``."""

    plane: PlaneAt
    to: Point


@dataclass(frozen=True)
class AddWall:
    """A wall that the machine does not know: from ``start`` to ``end``, with two faces where it is thick."""

    start: Point
    end: Point
    thickness: float = 0.0  # metres; 0: one plane that bounds both sides


@dataclass(frozen=True)
class AcceptDoor:
    """The door here is one, whatever its confidence (a lock)."""

    at: Point
    normal: Point = UNSAID  # unit vector across its wall, either way: it tells in which wing the wall is


@dataclass(frozen=True)
class RejectDoor:
    """The door here is none: there is wall."""

    at: Point
    normal: Point = UNSAID  # unit vector across its wall, either way


@dataclass(frozen=True)
class AddDoor:
    """A door that the machine does not know."""

    start: Point
    end: Point
    kind: str = "door"  # "door" or "opening"


@dataclass(frozen=True)
class ResizeDoor:
    """The door here goes from ``start`` to ``end``."""

    at: Point
    start: Point
    end: Point


@dataclass(frozen=True)
class LabelRegion:
    """The region here is of another kind: "room", "corridor", or any word."""

    at: Point
    label: str


@dataclass(frozen=True)
class NameRegion:
    """The region here has another name."""

    at: Point
    name: str


@dataclass(frozen=True)
class MergeRegions:
    """The regions at these points are one, where they touch."""

    at: tuple[Point, ...]


@dataclass(frozen=True)
class SplitRegion:
    """The region that this line crosses is two."""

    start: Point
    end: Point


Correction = (
    HidePlane
    | KeepPlane
    | MovePlane
    | AddWall
    | AcceptDoor
    | RejectDoor
    | AddDoor
    | ResizeDoor
    | LabelRegion
    | NameRegion
    | MergeRegions
    | SplitRegion
)

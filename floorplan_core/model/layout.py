"""Layout segments, layout planes, wall profiles and doors (section 3 of the paper and its input, SL-LMS).

A *facing* is the way a surface's normal points, into the free space that it bounds. Planes that face east or
west are perpendicular to x: their offset is an x coordinate and they run along y; north and south likewise.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


def turned(xy: Float, angle: float) -> Float:
    """(N, 2) positions turned counter-clockwise by ``angle`` radians; the same ones where that is nothing."""
    if angle == 0.0:
        return xy
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(np.asarray(xy, dtype=np.float64) @ np.array([[c, s], [-s, c]]))


class Facing(IntEnum):
    """The way a surface looks: EAST +x, WEST -x, NORTH +y, SOUTH -y."""

    axis: int  # 0 where the plane is perpendicular to x, 1 where perpendicular to y
    sign: int  # +1 or -1: the sign of the normal along its axis

    EAST = 0
    WEST = 1
    NORTH = 2
    SOUTH = 3

    def __init__(self, number: int) -> None:
        # Plain attributes: these are asked for tens of thousands of times a plan.
        self.axis, self.sign = number // 2, 1 - 2 * (number % 2)

    @property
    def opposite(self) -> Facing:
        """The facing of the surface that looks back at this one."""
        return _OPPOSITE[self]


_OPPOSITE = (Facing.WEST, Facing.EAST, Facing.SOUTH, Facing.NORTH)


@dataclass(frozen=True)
class LayoutSegment:
    """An observed, bounded patch of a structural surface."""

    id: str
    facing: Facing
    offset: float  # metres along the facing's axis, manhattan frame
    start: float  # metres along the other axis, manhattan frame
    end: float  # metres, end > start
    z_min: float  # metres above the floor
    z_max: float  # metres above the floor
    area: float  # m2 of surface that was really observed
    points: int  # supporting points
    residual: float  # metres, 95 % of the supporting points lie closer to the offset than this
    sigma: float  # metres, standard error of the offset
    plane: str = ""  # id of the layout plane that explains it
    structural: bool = True  # False: furniture; kept for pictures, never paired, never blocking
    evidence: tuple[str, ...] = ()  # words: why it is structural, or why not
    turn: float = 0.0  # radians from the plan's axes to those of the wing that all of this refers to

    @property
    def length(self) -> float:
        """Metres along the surface."""
        return self.end - self.start

    def line(self) -> Float:
        """(2, 2) end points in the plan, manhattan frame."""
        a, b = (self.offset, self.start), (self.offset, self.end)
        return np.array([a, b]) if self.facing.axis == 0 else np.array([a[::-1], b[::-1]])


@dataclass(frozen=True)
class WallProfile:
    """What was seen along a plane, in equal bins of ``step`` metres from ``start`` (all arrays (B,))."""

    start: float  # metres along the plane
    step: float  # metres
    low: NDArray[np.float64]  # points' surface seen below 2 m, as a fraction of the wall height there, 0 to 1
    high: NDArray[np.float64]  # metres of surface seen above 2 m (lintels, walls above furniture)
    through: NDArray[np.float64]  # 0 to 1: share of the heights at which free space crosses the plane here


@dataclass(frozen=True)
class LayoutPlane:
    """An axis-aligned plane of infinite extent that explains one or more segments."""

    id: str
    facing: Facing
    offset: float  # metres along the facing's axis, manhattan frame
    segments: tuple[str, ...] = ()  # ids
    support: float = 0.0  # m2 observed
    residual: float = 0.0  # metres, 95 % of the supporting points lie closer than this
    speculated: bool = False  # True: no surface was seen here; it closes a room whose wall is missing
    profile: WallProfile | None = None
    # (K, 2) metres, runs along the plane that are wall: seen, under a lintel, or hidden between seen parts;
    # these block rectangles
    walls: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 2)))
    observed: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 2)))  # (K, 2) runs really seen
    recess: bool = False  # True: it lies in a recess of another plane's wall (a pane, a shut leaf, a niche)
    by_hand: str = ""  # what a person said of it: "hidden" (no wall), "kept", "moved" or "added"; "" nothing
    turn: float = 0.0  # radians from the plan's axes to those of the wing that all of this refers to

    def point(self, along: float, offset: float | None = None) -> tuple[float, float]:
        """The place in the plan ``along`` it, metres; of a plane parallel to it where an offset is given."""
        at = self.offset if offset is None else offset
        own = (at, along) if self.facing.axis == 0 else (along, at)
        x, y = turned(np.array([own]), self.turn)[0].tolist()
        return x, y

    def own(self, xy: tuple[float, float]) -> tuple[float, float]:
        """A place in the plan as (metres along the plane, metres along its facing's axis)."""
        x, y = turned(np.array([xy]), -self.turn)[0].tolist()
        return (y, x) if self.facing.axis == 0 else (x, y)


@dataclass(frozen=True)
class Door:
    """An opening in a wall; a child of the planes of the wall's faces."""

    id: str
    planes: tuple[str, ...]  # ids of the layout planes it is cut into (one or both faces of the wall)
    axis: int  # axis of the wall's normal: 0 the wall runs along y, 1 along x
    offset: float  # metres along ``axis``: the middle of the wall
    start: float  # metres along the wall
    end: float  # metres, end > start
    thickness: float = 0.0  # metres between the wall's faces; 0 where only one was seen
    height: float | None = None  # metres from the floor to the lintel, where seen
    kind: str = "door"  # "door" or "opening" (wider than a door, or without a lintel)
    confidence: float = 0.5  # 0 to 1
    evidence: tuple[str, ...] = ()  # words
    connects: tuple[str, ...] = ()  # ids of the one or two regions that it joins
    by_hand: str = ""  # what a person said of it: "accepted", "resized" or "added"; "" nothing
    turn: float = 0.0  # radians from the plan's axes to those of the wing that all of this refers to
    shut: bool = False  # True: a leaf that stood shut when it was seen

    @property
    def width(self) -> float:
        """Metres."""
        return self.end - self.start

    def line(self) -> Float:
        """(2, 2) end points in the plan, manhattan frame."""
        a, b = (self.offset, self.start), (self.offset, self.end)
        return self.in_plan(np.array([a, b]) if self.axis == 0 else np.array([a[::-1], b[::-1]]))

    def in_plan(self, xy: Float) -> Float:
        """(N, 2) positions in the axes of the door's wall to the manhattan frame of the plan."""
        return turned(xy, self.turn)

    def in_own(self, xy: Float) -> Float:
        """(N, 2) positions in the manhattan frame to the axes of the door's wall; undoes :meth:`in_plan`."""
        return turned(xy, -self.turn)

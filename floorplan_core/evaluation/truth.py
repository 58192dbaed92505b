"""Ground truth of a survey: rooms, openings, dimensions and free space, in the building's own axes.

Every format of truth (:mod:`floorplan_core.evaluation.truths`) becomes one :class:`Truth`. Lengths in metres.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Exposure = Literal["entered", "glimpsed", "hidden"]

# Below this share of its floor seen, a room that was not entered cannot be expected in the plan.
MIN_SEEN = 0.15
# A room that was entered at one end only is no better known than one seen through its door (long corridors).
MIN_SEEN_ENTERED = 0.5
IDENTITY: Float = np.eye(3)[:2]


@dataclass(frozen=True)
class TruthRoom:
    """One room or corridor, bounded by the interior faces of its walls."""

    name: str
    polygon: Any  # shapely Polygon, building axes; may have holes
    kind: str | None  # "room" or "corridor"; None where the truth does not say
    entered: bool = True  # the sensor was inside
    seen: float | None = None  # 0 to 1, share of the floor that the sensor saw; None where unknown

    @property
    def exposure(self) -> Exposure:
        """Entered; glimpsed (seen in part); or hidden: seen too little to be expected in a plan."""
        seen = 1.0 if self.seen is None else self.seen
        if self.entered and seen >= MIN_SEEN_ENTERED:
            return "entered"
        return "glimpsed" if seen >= MIN_SEEN else "hidden"


@dataclass(frozen=True)
class TruthDoor:
    """An opening in a wall: the box that it cuts out of it."""

    bounds: tuple[float, float, float, float]  # x0, y0, x1, y1 in building axes
    axis: int  # axis of the wall's normal: 0 the wall runs along y, 1 along x
    kind: str = "door"  # "door", "opening" (a wide passage) or "window"
    required: bool = True  # False: shut, exterior or unseen; finding it is no error, missing it neither
    joins: tuple[int, ...] = ()  # rows of the rooms

    @property
    def across(self) -> float:
        """Coordinate of the wall's middle along ``axis``."""
        return 0.5 * (self.bounds[self.axis] + self.bounds[self.axis + 2])

    @property
    def span(self) -> tuple[float, float]:
        """Start and end along the wall."""
        return self.bounds[1 - self.axis], self.bounds[3 - self.axis]

    @property
    def width(self) -> float:
        """Clear width along the wall."""
        return self.span[1] - self.span[0]


@dataclass(frozen=True)
class TruthDimension:
    """A length that a laser meter would read between two wall faces."""

    id: str
    start: tuple[float, float]  # building axes
    end: tuple[float, float]
    metres: float


@dataclass(frozen=True)
class ObservedSpace:
    """What a real sensor saw at the slice, on a grid: where there is no plan to compare with (world axes)."""

    origin: Float  # (2,) lower left corner of cell [0, 0]
    cell: float
    free: NDArray[np.bool_]  # (ny, nx) carved by rays in the band of the slice
    wall: NDArray[np.bool_]  # (ny, nx) surface seen above furniture, nothing free in the band


@dataclass(frozen=True)
class Truth:
    """Everything known about the building; parts that the source does not hold are empty."""

    source: str
    rooms: tuple[TruthRoom, ...] = ()
    doors: tuple[TruthDoor, ...] = ()
    dimensions: tuple[TruthDimension, ...] = ()
    world_from_building: Float = field(default_factory=IDENTITY.copy)  # (2, 3) affine map of plan coordinates
    wall: float = 0.3  # thickest exterior wall: how far the building reaches beyond its rooms
    observed: ObservedSpace | None = None

    @property
    def yaw(self) -> float:
        """Radians: direction of the building's x axis in the world."""
        return float(np.arctan2(self.world_from_building[1, 0], self.world_from_building[0, 0]))


def door_axis(bounds: tuple[float, float, float, float]) -> int:
    """Axis of the wall's normal: doors are wider than walls are thick (ties: the wall runs along x)."""
    return 0 if bounds[3] - bounds[1] > bounds[2] - bounds[0] else 1


def room_dimensions(rooms: tuple[TruthRoom, ...]) -> tuple[TruthDimension, ...]:
    """Two dimensions a room, through a point well inside it, along both axes of the building."""
    found = []
    for room in rooms:
        point = room.polygon.representative_point()
        for axis, word in ((0, "x"), (1, "y")):
            ends = chord(room.polygon, (point.x, point.y), axis)
            length = float(np.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]))
            found.append(TruthDimension(f"{room.name}-{word}", ends[0], ends[1], length))
    return tuple(found)


def chord(
    polygon: Any, point: tuple[float, float], axis: int
) -> tuple[tuple[float, float], tuple[float, float]]:
    """The ends of the longest free line through ``point`` (inside ``polygon``) along an axis."""
    direction = (1.0, 0.0) if axis == 0 else (0.0, 1.0)
    ends = shoot(polygon, point, direction)
    if ends is None:  # cannot happen for a representative point; keeps the type honest
        return point, point
    return ends


def shoot(
    polygon: Any, point: tuple[float, float], direction: tuple[float, float]
) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """Where a line through ``point`` leaves ``polygon``, backwards and forwards; None for a point outside."""
    import shapely

    middle = shapely.Point(point)
    if not polygon.intersects(middle):
        return None
    x0, y0, x1, y1 = polygon.bounds
    reach = 2.0 * float(np.hypot(x1 - x0, y1 - y0)) + 1.0
    step = np.array(direction) / np.hypot(*direction) * reach
    line = shapely.LineString([np.array(point) - step, np.array(point) + step])
    pieces = [
        part for part in shapely.get_parts(line.intersection(polygon)) if part.geom_type == "LineString"
    ]
    if not pieces:
        return None
    piece = min(pieces, key=lambda part: part.distance(middle))
    ends = sorted(piece.coords, key=lambda xy: float(np.dot(np.subtract(xy, point), step)))
    return (float(ends[0][0]), float(ends[0][1])), (float(ends[-1][0]), float(ends[-1][1]))

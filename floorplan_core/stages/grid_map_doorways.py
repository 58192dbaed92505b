"""A chord of a map's floor as a doorway: the rows of cells along its wall, its faces, its middle.

All coordinates are in cells, the middle of a cell at whole numbers. ``u`` runs along the wall, ``v`` across.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.stages.grid_map_chords import march

Bool = NDArray[np.bool_]
Point = tuple[float, float]

MAX_LEAN = math.radians(25)  # a chord across a thick wall may lean this much
UPRIGHT = math.radians(6)  # a chord that leans more needs a wall as thick as its lean
WIDER = 1.2  # a run along the wall this much longer than the chord is not the opening itself


@dataclass(frozen=True)
class Chord:
    """A chord along the axis that it is nearer to."""

    axis: int  # that it crosses: 1 where it runs along x
    lean: float  # radians off that axis
    u: float  # of its middle
    v: float
    low: float  # of its ends, along the wall
    high: float

    @classmethod
    def of(cls, start: Point, end: Point) -> Chord:
        """The chord from ``start`` to ``end``, each x, y."""
        (x0, y0), (x1, y1) = start, end
        dx, dy = abs(x1 - x0), abs(y1 - y0)
        x, y = (x0 + x1) / 2, (y0 + y1) / 2
        lean = math.atan2(min(dx, dy), max(dx, dy))
        if dx < dy:
            return cls(0, lean, y, x, *sorted((y0, y1)))
        return cls(1, lean, x, y, *sorted((x0, x1)))

    def rows(self, floor: Bool) -> Bool:
        """The floor with its rows along the wall."""
        return floor if self.axis == 1 else floor.T

    def point(self, u: float, v: float) -> Point:
        """A point as x, y."""
        return (u, v) if self.axis == 1 else (v, u)


def middle_of_wall(floor: Bool, start: Point, end: Point, thickest: float) -> tuple[Point, Point]:
    """The chord half way between the faces of its wall, from jamb to jamb; as it is where it leans.

    A chord joins corners, often all on one face: cut there, the whole depth of the doorway, and the door with
    it, would lie inside one of the two spaces.
    """
    chord = Chord.of(start, end)
    cells, width = chord.rows(floor), chord.high - chord.low
    if chord.lean > UPRIGHT:
        return start, end
    row = row_in_wall(cells, chord.u, chord.v, width)
    near, far = faces(cells, chord.u, row, width, thickest)
    middle = math.floor((near + far - 1) / 2)
    if far - near < 2 or _run(cells, chord.u, middle, width) > WIDER * width + 2:
        return start, end
    u = round(chord.u)
    left, right = (math.ceil(march(cells, u, middle, s, 0.0, 2 * width) - 0.5) for s in (-1.0, 1.0))
    return chord.point(float(u - left), float(middle)), chord.point(float(u + right), float(middle))


def row_in_wall(cells: Bool, u: float, v: float, width: float) -> int:
    """The row of a chord, or the one beside it between the jambs: corners belong to the rooms, too."""
    rows = (round(v), round(v) + 1, round(v) - 1)
    return next((row for row in rows if _run(cells, u, row, width) <= WIDER * width + 2), rows[0])


def faces(cells: Bool, u: float, row: int, width: float, thickest: float) -> tuple[float, float]:
    """Edges of the wall's faces, cells: as far as the opening gets no wider; none where it never does."""
    limit, steps = round(thickest), []
    for sign in (-1, 1):
        n = 0
        while n < limit and _run(cells, u, row + sign * (n + 1), width) <= WIDER * width:
            n += 1
        steps.append(n)
    near, far = float(row - steps[0]), float(row + steps[1] + 1)
    return (near, far) if far - near <= limit else (row + 0.5, row + 0.5)


def _run(cells: Bool, u: float, j: int, width: float) -> float:
    """Free cells along the wall through u in row j; infinite where that is no free cell."""
    i = round(u)
    if not (0 <= j < cells.shape[0] and 0 <= i < cells.shape[1] and cells[j, i]):
        return math.inf
    return float(march(cells, i, j, 1.0, 0.0, 2 * width) + march(cells, i, j, -1.0, 0.0, 2 * width))

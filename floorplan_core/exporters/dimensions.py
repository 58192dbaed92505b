"""Chain dimensions: what somebody would measure along each side of the building. Metres, manhattan frame.

Looking at the plan from one side, the faces that are seen whole are dimensioned, each from corner to corner.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.model import Region

Float = NDArray[np.float64]

STRAIGHT = 1e-6  # metres: an edge is square to an axis if its ends differ less
HIDDEN = 0.02  # metres of a face that may be hidden by others in front of it
TOUCHING = 1e-4  # metres: a side ends at a corner that is no farther
SAME = 0.05  # metres: two chains that differ less say the same


@dataclass(frozen=True)
class Span:
    """A dimensioned stretch."""

    start: float  # metres along the side
    end: float
    face: float  # metres across: where the face lies
    guessed: bool = False  # True where it ends at a wall that nobody saw

    @property
    def length(self) -> float:
        """Metres."""
        return self.end - self.start


def chain(regions: Sequence[Region], axis: int, sign: int) -> tuple[Span, ...]:
    """Faces seen whole by somebody outside who looks along ``-sign * axis``; sorted by start.

    ``axis`` 1 and ``sign`` +1 is the view from the top of the page: horizontal faces of the topmost regions.
    """
    edges = _faces(regions, axis, sign)
    rows = np.array(edges).reshape(-1, 3)
    seen = {(face, a, b) for face, a, b in edges if _visible(face, a, b, rows, sign) >= b - a - HIDDEN}
    walls = _walls(regions, 1 - axis)
    spans = [Span(a, b, face, _guessed(walls, (a, b), face)) for face, a, b in seen]
    return tuple(sorted(spans, key=lambda s: (s.start, s.end, s.face)))


def ends_guessed(
    regions: Sequence[Region], axis: int, ends: tuple[float, float], at: float | None = None
) -> bool:
    """True where a length along ``axis`` goes to a wall that nobody saw.

    :param ends: metres along ``axis``: where walls square to it lie.
    :param at: metres across ``axis`` where the walls are looked at; None: anywhere.
    """
    return _guessed(_walls(regions, axis), ends, at)


def _walls(regions: Sequence[Region], axis: int) -> Float:
    """(K, 4) sides square to ``axis``: where they lie, their ends across, 1 where nobody saw them."""
    along = 1 - axis
    rows = [
        (s.start[axis], *sorted((s.start[along], s.end[along])), float(s.speculated))
        for region in regions
        for s in region.sides
        if abs(s.start[axis] - s.end[axis]) < STRAIGHT
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, 4)


def _guessed(walls: Float, ends: tuple[float, float], at: float | None) -> bool:
    for end in ends:
        here = np.abs(walls[:, 0] - end) < TOUCHING
        if at is not None:
            here &= (walls[:, 1] - TOUCHING <= at) & (at <= walls[:, 2] + TOUCHING)
        if here.any() and walls[here, 3].all():
            return True
    return False


def overall_span(regions: Sequence[Region], axis: int) -> Span:
    """The extent along ``axis`` as a stretch of no face."""
    ends = overall(regions, axis)
    return Span(*ends, float("nan"), ends_guessed(regions, axis, ends))


def overall(regions: Sequence[Region], axis: int) -> tuple[float, float]:
    """Lowest and highest coordinate along ``axis``: the extent between the outermost inside faces."""
    bounds = shapely.total_bounds([r.polygon for r in regions])
    return float(bounds[axis]), float(bounds[axis + 2])


def differs(one: Sequence[Span], other: Sequence[Span]) -> bool:
    """True where ``one`` says something that ``other`` does not."""
    return any(all(abs(s.start - o.start) > SAME or abs(s.end - o.end) > SAME for o in other) for s in one)


def _faces(regions: Sequence[Region], axis: int, sign: int) -> list[tuple[float, float, float]]:
    """(position across, start, end) of the edges square to ``axis`` with the inside at ``-sign``.

    Edges of one region that go on in one line are one face: a corner between them is no corner of the room.
    """
    return [face for region in regions for face in _joined(_edges(region, axis, sign))]


def _edges(region: Region, axis: int, sign: int) -> list[tuple[float, float, float]]:
    ring = shapely.get_coordinates(shapely.orient_polygons(region.polygon).exterior)
    along, edges = 1 - axis, []
    for a, b in itertools.pairwise(ring.tolist()):
        # Inside is to the left: a top face (axis 1, sign +1) runs towards -x, a right face towards +y.
        runs = (b[along] - a[along]) * sign * (1 if axis == 0 else -1)
        if abs(a[axis] - b[axis]) < STRAIGHT and runs > STRAIGHT:
            edges.append((a[axis], *sorted((a[along], b[along]))))
    return edges


def _joined(edges: list[tuple[float, float, float]]) -> list[tuple[float, float, float]]:
    joined: list[tuple[float, float, float]] = []
    for face, start, end in sorted(edges):
        if joined and face - joined[-1][0] < STRAIGHT and start - joined[-1][2] < STRAIGHT:
            joined[-1] = (joined[-1][0], joined[-1][1], end)
        else:
            joined.append((face, start, end))
    return joined


def _visible(face: float, start: float, end: float, edges: Float, sign: int) -> float:
    """Metres of the face with none of the ``edges`` (E, 3; position across, start, end) in front of it."""
    across, low, high = edges.T
    ahead = (sign * (across - face) > STRAIGHT) & (low < end) & (high > start)
    front = sorted(map(tuple, edges[ahead, 1:].tolist()))
    seen, at = 0.0, start
    for a, b in front:
        seen += max(0.0, a - at)
        at = max(at, b)
    return seen + max(0.0, end - at)


@dataclass(frozen=True)
class Arm:
    """A stretch of a region that is longer than wide, like a corridor."""

    axis: int  # of the width
    low: float  # metres along ``axis``: the two faces
    high: float
    start: float  # metres across: where the stretch begins and ends
    end: float

    @property
    def width(self) -> float:
        """Metres between the faces."""
        return self.high - self.low


def arms(polygon: Any, slimness: float) -> tuple[Arm, ...]:
    """For each axis the longest arm of a polygon that is ``slimness`` times longer than wide, if any."""
    corners, ring = shapely.get_coordinates(shapely.get_rings(polygon), return_index=True)
    edges = np.stack([corners[:-1], corners[1:]], axis=1)[ring[:-1] == ring[1:]]
    found = []
    for axis in (0, 1):
        ticks = np.unique(np.round(corners[:, 1 - axis], 6)).tolist()
        stretches = [
            Arm(axis, low, high, a, b)
            for a, b in itertools.pairwise(ticks)
            for low, high in _chords(edges, axis, (a + b) / 2)
        ]
        slim = [arm for arm in stretches if arm.end - arm.start >= slimness * arm.width]
        found += [max(slim, key=lambda arm: arm.end - arm.start)] if slim else []
    return tuple(found)


def _chords(edges: Float, axis: int, at: float) -> list[tuple[float, float]]:
    """Where the line ``at`` across ``axis`` is in the polygon of ``edges`` (E, 2, 2); it meets no corner."""
    v = edges[:, :, 1 - axis]
    crossed = edges[(v[:, 0] > at) != (v[:, 1] > at)]
    a, b = crossed[:, 0], crossed[:, 1]
    share = (at - a[:, 1 - axis]) / (b[:, 1 - axis] - a[:, 1 - axis])
    ends = np.sort(a[:, axis] + share * (b[:, axis] - a[:, axis])).tolist()
    return [(low, high) for low, high in zip(ends[::2], ends[1::2], strict=True) if high - low > STRAIGHT]

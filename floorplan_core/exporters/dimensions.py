"""Chain dimensions: what somebody would measure along each side of the building. Metres, manhattan frame.

Looking at the plan from one side, the faces that are seen whole are dimensioned, each from corner to corner.
Steps along a curved or slanted wall are no corners: what they and the faces beside them span is one length.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.runs import runs_of
from floorplan_core.model import Region

Float = NDArray[np.float64]

STRAIGHT = 1e-6  # metres: an edge is square to an axis if its ends differ less
HIDDEN = 0.02  # metres of a face that may be hidden by others in front of it
TOUCHING = 1e-4  # metres: a side ends at a corner that is no farther
SAME = 0.05  # metres: two chains that differ less say the same
STEP, STEPS = 2.0, 4  # metres of an edge of a stair at most; edges in a row that turn left and right by turns


@dataclass(frozen=True)
class _Face:
    """A face of one region, square to the axis that somebody looks along."""

    at: float  # metres across
    start: float  # metres along
    end: float
    step: bool  # True where it is one of many that follow a curved or slanted wall


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
    faces = [_joined(_edges(region, axis, sign)) for region in regions]
    rows = np.array([(f.at, f.start, f.end) for own in faces for f in own]).reshape(-1, 3)
    walls = _walls(regions, 1 - axis)

    def seen(f: _Face) -> bool:
        return _visible(f.at, f.start, f.end, rows, sign) >= f.end - f.start - HIDDEN

    lengths = {
        (f.start, f.end, f.at)
        for region, own in zip(regions, faces, strict=True)
        for f in _without_steps([f for f in own if seen(f)], region, 1 - axis, sign)
    }
    return tuple(Span(a, b, at, _guessed(walls, (a, b), at)) for a, b, at in sorted(lengths))


def _without_steps(faces: list[_Face], region: Region, along: int, sign: int) -> list[_Face]:
    """The faces of a region that are seen, with one for each row of them that has steps.

    Where a row ends at a step that is no end of the region, it goes on unseen, and has no length.
    """
    faces = sorted(faces, key=lambda f: (f.start, f.end))
    cuts = [k for k in range(1, len(faces)) if abs(faces[k].start - faces[k - 1].end) > TOUCHING]
    low, high = region.polygon.bounds[along], region.polygon.bounds[along + 2]
    out: list[_Face] = []
    for first, last in itertools.pairwise([0, *cuts, len(faces)]):
        row = faces[first:last]
        plain = [f for f in row if not f.step]
        if len(plain) == len(row):
            out += row
        elif (not row[0].step or row[0].start - low < SAME) and (
            not row[-1].step or high - row[-1].end < SAME
        ):
            at = max((f.at for f in row), key=lambda at: sign * at)
            out.append(_Face(at, row[0].start, row[-1].end, False))
        else:
            out += plain
    return out


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


def _edges(region: Region, axis: int, sign: int) -> list[_Face]:
    """The edges square to ``axis`` with the inside at ``-sign``."""
    ring = shapely.get_coordinates(shapely.orient_polygons(region.polygon).exterior)
    along, edges, steps = 1 - axis, [], _steps(ring)
    for k, (a, b) in enumerate(itertools.pairwise(ring.tolist())):
        # Inside is to the left: a top face (axis 1, sign +1) runs towards -x, a right face towards +y.
        runs = (b[along] - a[along]) * sign * (1 if axis == 0 else -1)
        if abs(a[axis] - b[axis]) < STRAIGHT and runs > STRAIGHT:
            edges.append(_Face(a[axis], min(a[along], b[along]), max(a[along], b[along]), bool(steps[k])))
    return edges


def _steps(ring: Float) -> NDArray[np.bool_]:
    """(E,) which edges of a closed ring (E + 1, 2) are of a stair: it turns left and right by turns."""
    run = np.diff(ring, axis=0)
    before = np.roll(run, 1, axis=0)
    turn = np.sign(before[:, 0] * run[:, 1] - before[:, 1] * run[:, 0])  # at the start of each edge
    length = np.hypot(*run.T)
    bent = (turn * np.roll(turn, -1) < 0) & (length <= STEP)
    steps: NDArray[np.bool_] = np.zeros(len(bent), dtype=bool)
    first = int(np.argmin(bent))  # a row may go on over the end of the ring
    for start, end in runs_of(np.roll(bent, -first)).tolist():
        if end - start >= STEPS:
            row = (np.arange(start - 1, end + 1) + first) % len(bent)
            longest = length[row[1:-1]].max()
            steps[row[length[row] <= longest + TOUCHING]] = True  # with the edge at either end, if it is one
    return steps


def _joined(edges: list[_Face]) -> list[_Face]:
    """Edges of one region that go on in one line are one face: a corner between them is no corner of it."""
    joined: list[_Face] = []
    for f in sorted(edges, key=lambda f: (f.at, f.start, f.end)):
        last = joined[-1] if joined else None
        if last is not None and f.at - last.at < STRAIGHT and f.start - last.end < STRAIGHT:
            joined[-1] = _Face(last.at, last.start, f.end, last.step and f.step)
        else:
            joined.append(f)
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

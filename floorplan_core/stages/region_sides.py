"""The sides of a region: where they belong by the surfaces seen along them, and how much of each was seen."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.rectilinear import corners, map_polygon, move_sides
from floorplan_core.model import Door, Facing, LayoutPlane, LayoutSegment, RegionSide

Float = NDArray[np.float64]
Corner = Sequence[float] | Float  # x, y; lists of plain floats are several times as fast

_DEEPEST = 0.35  # m behind a side, where the back of its recesses lies
_THICKEST = 0.45  # m between two faces that are one wall
_MOST, _TWO_SIGMA = 0.95, 1.96  # share of the points that a residual holds; in standard deviations
_HALVINGS = 16  # of an interval under a metre: to a few hundredths of a millimetre
_ON = 1e-4  # m between a side and the plane that it lies on
_USUAL = 0.12  # m, thickness of an inner wall where no wall was seen from both sides


@dataclass(frozen=True)
class Surfaces:
    """What was seen of one facing: as it came, and in the order of the offsets."""

    data: Float  # (K, 4) offset, start, end, residual; metres
    offsets: list[float]
    rows: list[tuple[float, float, float, float, str]]  # the same in that order, with the plane of each

    def near(self, at: float, reach: float) -> list[tuple[float, float, float, float, str]]:
        """The rows less than ``reach`` metres from an offset."""
        first, last = bisect_left(self.offsets, at - 2 * reach), bisect_right(self.offsets, at + 2 * reach)
        return [row for row in self.rows[first:last] if abs(row[0] - at) < reach]


class WallSurfaces:
    """The segments by facing, to look up what was seen along a side."""

    REACH = 0.22  # m between a side and a surface that can be its own

    def __init__(self, planes: Sequence[LayoutPlane], segments: Sequence[LayoutSegment]) -> None:
        self._table = {}
        # A window's pane is not where its wall is, nor is what a person took for no wall.
        refused = {p.id for p in planes if p.by_hand == "hidden" or (p.recess and not p.by_hand)}
        self._by_hand = [p for p in planes if p.by_hand in ("moved", "added")]
        for facing in Facing:
            mine = [s for s in segments if s.facing == facing and s.plane and s.plane not in refused]
            data = np.array([[s.offset, s.start, s.end, s.residual] for s in mine]).reshape(-1, 4)
            order = np.argsort(data[:, 0], kind="stable")
            rows = [(*data[k].tolist(), mine[k].plane) for k in order]
            self._table[facing] = Surfaces(data, data[order, 0].tolist(), rows)
        recesses = {p.id for p in planes if p.recess and not p.by_hand}
        self._panes = {
            f: [(s.offset, s.start, s.end) for s in segments if s.facing == f and s.plane in recesses]
            for f in Facing
        }
        self.thickness = typical_thickness(planes)

    @staticmethod
    def facing(a: Corner, b: Corner) -> Facing:
        """The facing of the surface along a side of a ring whose inside is at the left."""
        if abs(a[0] - b[0]) < abs(a[1] - b[1]):
            return Facing.WEST if b[1] > a[1] else Facing.EAST
        return Facing.NORTH if b[0] > a[0] else Facing.SOUTH

    def along(self, a: Corner, b: Corner) -> tuple[Float, list[str]]:
        """(K, 4) offset, start, end (clipped to the side), residual of what was seen along it; its planes."""
        table = self._table[self.facing(a, b)]
        across = 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
        low, high = sorted((a[1 - across], b[1 - across]))
        seen, planes = [], []
        for offset, start, end, residual, plane in table.near(a[across], self.REACH):
            start, end = max(start, low), min(end, high)
            if end > start:
                seen.append((offset, start, end, residual))
                planes.append(plane)
        return np.array(seen, dtype=np.float64).reshape(-1, 4), planes

    def panes(self, a: Corner, b: Corner) -> list[tuple[float, float]]:
        """Start and end of what was seen in the recesses of a side: the wall is there, just not its face."""
        facing = self.facing(a, b)
        axis, sign = facing.axis, facing.sign
        return [
            (start, end)
            for offset, start, end in self._panes[facing]
            if -self.REACH < (a[axis] - offset) * sign < _DEEPEST
        ]

    def target(self, a: Corner, b: Corner) -> float:
        """Where a side belongs: the median of the surfaces seen along it, by length; else where it is."""
        across = 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
        if self.placed(a, b):
            return float(a[across])
        seen, _ = self.along(a, b)
        length = seen[:, 2] - seen[:, 1]
        if length.sum() < min(0.3, 0.3 * abs(a[1 - across] - b[1 - across])):
            return self._behind_other_face(a, b, across)
        order = np.argsort(seen[:, 0], kind="stable")
        middle = np.searchsorted(np.cumsum(length[order]), 0.5 * length.sum())
        near = np.abs(seen[:, 0] - seen[order[middle], 0]) < 0.03
        return float(np.average(seen[near, 0], weights=length[near]))

    def placed(self, a: Corner, b: Corner) -> list[tuple[float, float, str]]:
        """Start, end and plane of the walls moved or added by hand that a side lies on; [] where on none.

        Such a side stays where it was put, whatever was seen near it.
        """
        facing, across = self.facing(a, b), 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
        low, high = sorted((a[1 - across], b[1 - across]))
        on = [p for p in self._by_hand if p.facing == facing and abs(p.offset - a[across]) < _ON]
        runs = [(max(s, low), min(e, high), p.id) for p in on for s, e in p.walls]
        return [(float(s), float(e), name) for s, e, name in runs if e > s]

    def _behind_other_face(self, a: Corner, b: Corner, across: int) -> float:
        """Where only the other face of the wall was seen, the side lies one wall's thickness behind it."""
        facing = self.facing(a, b)
        data = self._table[facing.opposite].data
        low, high = sorted((a[1 - across], b[1 - across]))
        length = np.minimum(data[:, 2], high) - np.maximum(data[:, 1], low)
        ahead = (a[across] - data[:, 0]) * facing.sign  # of the other face, into the region
        near = (length > 0) & (ahead > -self.REACH) & (ahead < self.thickness)
        if length[near].sum() < 0.5 * (high - low):
            return float(a[across])
        return float(np.average(data[near, 0], weights=length[near])) + facing.sign * self.thickness

    def plane(self, names: list[str], lengths: Float) -> str:
        """The plane that explains most of a side."""
        total: dict[str, float] = {}
        for name, length in zip(names, lengths, strict=True):
            total[name] = total.get(name, 0.0) + float(length)
        return max(total, key=lambda n: (total[n], n)) if total else ""

    def fit(self, polygon: Any) -> Any:
        """The polygon with every side moved to the surfaces seen along it."""
        return map_polygon(polygon, lambda ring: move_sides(ring, self.target))


def typical_thickness(planes: Sequence[LayoutPlane]) -> float:
    """Metres: the median distance between the two faces of the walls that were seen from both sides."""
    found = []
    of = {facing: [p for p in planes if p.facing == facing] for facing in Facing}
    for west in (p for p in planes if p.facing.sign < 0):
        for east in of[west.facing.opposite]:
            gap = east.offset - west.offset
            if 0.04 < gap < _THICKEST and _overlap(west.observed, east.observed) > 0.5:
                found.append(gap)
    return float(np.median(found)) if found else _USUAL


def _overlap(a: Float, b: Float) -> float:
    """Metres that two sets of runs (K, 2) have in common."""
    if not len(a) or not len(b):
        return 0.0
    common = np.minimum(a[:, None, 1], b[None, :, 1]) - np.maximum(a[:, None, 0], b[None, :, 0])
    return float(np.maximum(common, 0).sum())


class KnownSides:
    """The sides of shapes between the same walls and doors, kept: they are asked for again and again."""

    def __init__(self, walls: WallSurfaces, doors: Sequence[Door]) -> None:
        self._walls, self._doors = walls, doors
        self._known: dict[bytes, tuple[RegionSide, ...]] = {}

    def of(self, polygon: Any) -> tuple[RegionSide, ...]:
        """What :func:`sides_of` says of ``polygon``."""
        key = polygon.wkb
        if key not in self._known:
            self._known[key] = sides_of(polygon, self._walls, self._doors)
        return self._known[key]


def sides_of(polygon: Any, walls: WallSurfaces, doors: Sequence[Door]) -> tuple[RegionSide, ...]:
    """The sides of all rings, the inside at their left, with the share of each that was seen."""
    rings = ((polygon.exterior, False), *((ring, True) for ring in polygon.interiors))
    return tuple(
        _side(a, b, walls, doors, hole) for ring, hole in rings for a, b in _edges(np.asarray(ring.coords))
    )


def _edges(ring: Float) -> list[tuple[list[float], list[float]]]:
    points = corners(ring).tolist()
    return list(zip(points, points[1:] + points[:1], strict=True))


def _side(
    a: list[float], b: list[float], walls: WallSurfaces, doors: Sequence[Door], hole: bool
) -> RegionSide:
    """A side with the share of its length along which wall, or a door in it, was seen."""
    across = 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
    low, high = sorted((a[1 - across], b[1 - across]))
    seen, names = walls.along(a, b)
    placed = walls.placed(a, b)
    spans = [(s, e) for _, s, e, _ in seen.tolist()] + [(s, e) for s, e, _ in placed] + walls.panes(a, b)
    for door in doors:
        if door.axis == across and abs(door.offset - a[across]) < door.thickness / 2 + walls.REACH:
            spans.append((door.start, door.end))
    covered, at = 0.0, low
    for s, e in sorted(spans):
        s, e = max(s, at), min(e, high)
        if e > s:
            covered += e - s
            at = e
    lengths = np.concatenate([seen[:, 2] - seen[:, 1], [e - s for s, e, _ in placed]])
    plane = walls.plane([*names, *(name for _, _, name in placed)], lengths)
    start, end = (a[0], a[1]), (b[0], b[1])
    share = round(min(1.0, covered / max(high - low, 1e-9)), 4)
    residual = _residual(seen, a[across])
    return RegionSide(start, end, plane, share, hole, residual)


def _residual(seen: Float, at: float) -> float | None:
    """Metres within which 95 % of the points seen along a side lie of it.

    The points of each surface are taken as normally distributed about its own offset, with its own residual.
    """
    length, away = seen[:, 2] - seen[:, 1], np.abs(seen[:, 0] - at)
    total = float(length.sum())
    if total <= 0:
        return None
    scale = np.maximum(seen[:, 3] / _TWO_SIGMA, 1e-6) * math.sqrt(2.0)
    low, high = 0.0, float((away + 2 * seen[:, 3]).max()) + 1e-3
    surfaces = list(zip(length.tolist(), away.tolist(), scale.tolist(), strict=True))  # two or three
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        inside = sum(n * (math.erf((middle - a) / s) + math.erf((middle + a) / s)) for n, a, s in surfaces)
        low, high = (middle, high) if 0.5 * inside / total < _MOST else (low, middle)
    return high

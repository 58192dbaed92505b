"""The sides of a region: where they belong by the surfaces seen along them, and how much of each was seen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.rectilinear import corners, map_polygon, move_sides
from floorplan_core.model import Door, Facing, LayoutPlane, LayoutSegment, RegionSide

Float = NDArray[np.float64]

_DEEPEST = 0.35  # m behind a side, where the back of its recesses lies
_THICKEST = 0.45  # m between two faces that are one wall
_MOST, _TWO_SIGMA = 0.95, 1.96  # share of the points that a residual holds; in standard deviations
_HALVINGS = 16  # of an interval under a metre: to a few hundredths of a millimetre
_ON = 1e-4  # m between a side and the plane that it lies on
_USUAL = 0.12  # m, thickness of an inner wall where no wall was seen from both sides


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
            self._table[facing] = (data, [s.plane for s in mine])
        recesses = {p.id for p in planes if p.recess and not p.by_hand}
        self._panes = {
            f: np.array(
                [[s.offset, s.start, s.end] for s in segments if s.facing == f and s.plane in recesses]
            ).reshape(-1, 3)
            for f in Facing
        }
        self.thickness = typical_thickness(planes)

    @staticmethod
    def facing(a: Float, b: Float) -> Facing:
        """The facing of the surface along a side of a ring whose inside is at the left."""
        if abs(a[0] - b[0]) < abs(a[1] - b[1]):
            return Facing.WEST if b[1] > a[1] else Facing.EAST
        return Facing.NORTH if b[0] > a[0] else Facing.SOUTH

    def along(self, a: Float, b: Float) -> tuple[Float, list[str]]:
        """(K, 4) offset, start, end (clipped to the side), residual of what was seen along it; its planes."""
        data, planes = self._table[self.facing(a, b)]
        across = 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
        low, high = sorted((a[1 - across], b[1 - across]))
        start, end = np.maximum(data[:, 1], low), np.minimum(data[:, 2], high)
        near = (np.abs(data[:, 0] - a[across]) < self.REACH) & (end > start)
        k = np.flatnonzero(near)
        return np.column_stack([data[k, 0], start[k], end[k], data[k, 3]]), [planes[i] for i in k]

    def panes(self, a: Float, b: Float) -> list[tuple[float, float]]:
        """Start and end of what was seen in the recesses of a side: the wall is there, just not its face."""
        facing = self.facing(a, b)
        offset, start, end = self._panes[facing].T
        behind = (a[facing.axis] - offset) * facing.sign
        near = (behind > -self.REACH) & (behind < _DEEPEST)
        return [(float(s), float(e)) for s, e in zip(start[near], end[near], strict=True)]

    def target(self, a: Float, b: Float) -> float:
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

    def placed(self, a: Float, b: Float) -> list[tuple[float, float, str]]:
        """Start, end and plane of the walls moved or added by hand that a side lies on; [] where on none.

        Such a side stays where it was put, whatever was seen near it.
        """
        facing, across = self.facing(a, b), 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
        low, high = sorted((a[1 - across], b[1 - across]))
        on = [p for p in self._by_hand if p.facing == facing and abs(p.offset - a[across]) < _ON]
        runs = [(max(s, low), min(e, high), p.id) for p in on for s, e in p.walls]
        return [(float(s), float(e), name) for s, e, name in runs if e > s]

    def _behind_other_face(self, a: Float, b: Float, across: int) -> float:
        """Where only the other face of the wall was seen, the side lies one wall's thickness behind it."""
        facing = self.facing(a, b)
        data, _ = self._table[facing.opposite]
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
    for west in (p for p in planes if p.facing in (Facing.WEST, Facing.SOUTH)):
        for east in (p for p in planes if p.facing == west.facing.opposite):
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


def sides_of(
    polygon: Any, walls: WallSurfaces, doors: Sequence[Door], residuals: bool = True
) -> tuple[RegionSide, ...]:
    """The sides of all rings, the inside at their left, with the share of each that was seen.

    :param residuals: False leaves the residuals out, which cost most of the time.
    """
    rings = ((polygon.exterior, False), *((ring, True) for ring in polygon.interiors))
    return tuple(
        _side(a, b, walls, doors, hole, residuals)
        for ring, hole in rings
        for a, b in _edges(np.asarray(ring.coords))
    )


def _edges(ring: Float) -> list[tuple[Float, Float]]:
    points = corners(ring)
    return [(points[k], points[(k + 1) % len(points)]) for k in range(len(points))]


def _side(
    a: Float, b: Float, walls: WallSurfaces, doors: Sequence[Door], hole: bool, residuals: bool
) -> RegionSide:
    """A side with the share of its length along which wall, or a door in it, was seen."""
    across = 0 if abs(a[0] - b[0]) < abs(a[1] - b[1]) else 1
    low, high = sorted((float(a[1 - across]), float(b[1 - across])))
    seen, names = walls.along(a, b)
    placed = walls.placed(a, b)
    spans = [(s, e) for _, s, e, _ in seen] + [(s, e) for s, e, _ in placed] + walls.panes(a, b)
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
    start, end = (float(a[0]), float(a[1])), (float(b[0]), float(b[1]))
    share = round(min(1.0, covered / max(high - low, 1e-9)), 4)
    residual = _residual(seen, float(a[across])) if residuals else None
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

"""The sides of a region: where they belong by the surfaces seen along them, and how much of each was seen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.rectilinear import corners, map_polygon, move_sides
from floorplan_core.model import Door, Facing, LayoutPlane, LayoutSegment, RegionSide
from floorplan_core.stages.side_measures import REACH, measure_sides, side_targets
from floorplan_core.stages.side_steps import add_steps
from floorplan_core.stages.structure import LOW

Float = NDArray[np.float64]
Corner = Sequence[float] | Float  # x, y

_THICKEST = 0.45  # m between two faces that are one wall
_USUAL = 0.12  # m, thickness of an inner wall where no wall was seen from both sides


@dataclass(frozen=True)
class Surfaces:
    """What was seen of the walls, as the tables of :mod:`~floorplan_core.stages.side_measures`."""

    names: list[str]  # of the planes, in order; the tables have their numbers
    seen: Float  # (K, 6) offset, start, end, residual, plane, mean height seen; by facing, then offset
    first: NDArray[np.int64]  # (5,) where the rows of each facing begin
    placed: Float  # (H, 5) facing, offset, start, end, plane of the walls moved or added by hand
    panes: Float  # (P, 4) facing, offset, start, end of what was seen in recesses
    low: Float  # (L, 4) the same of what is too short and low to be told from furniture, by offset


def _tabulate(planes: Sequence[LayoutPlane], segments: Sequence[LayoutSegment]) -> Surfaces:
    # A window's pane is not where its wall is, nor is what a person took for no wall.
    refused = {p.id for p in planes if p.by_hand == "hidden" or (p.recess and not p.by_hand)}
    recesses = {p.id for p in planes if p.recess and not p.by_hand}
    by_hand = [p for p in planes if p.by_hand in ("moved", "added")]
    walls = sorted(
        (s for s in segments if s.plane and s.plane not in refused), key=lambda s: (s.facing, s.offset)
    )
    names = sorted({s.plane for s in walls} | {p.id for p in by_hand})
    number = {name: k for k, name in enumerate(names)}
    seen = [(s.offset, s.start, s.end, s.residual, number[s.plane], s.area / s.length) for s in walls]
    placed = [(p.facing, p.offset, s, e, number[p.id]) for p in by_hand for s, e in p.walls]
    panes = [(s.facing, s.offset, s.start, s.end) for s in segments if s.plane in recesses]
    low = sorted((s.facing, s.offset, s.start, s.end) for s in segments if s.evidence == (LOW,))
    return Surfaces(
        names,
        np.array(seen, dtype=np.float64).reshape(-1, 6),
        np.searchsorted([s.facing for s in walls], np.arange(len(Facing) + 1)),
        np.array(placed, dtype=np.float64).reshape(-1, 5),
        np.array(panes, dtype=np.float64).reshape(-1, 4),
        np.array(low, dtype=np.float64).reshape(-1, 4),
    )


class WallSurfaces:
    """The segments by facing, to look up what was seen along a side."""

    def __init__(self, planes: Sequence[LayoutPlane], segments: Sequence[LayoutSegment]) -> None:
        self._table = _tabulate(planes, segments)
        self.thickness = typical_thickness(planes)

    @staticmethod
    def facing(a: Corner, b: Corner) -> Facing:
        """The facing of the surface along a side of a ring whose inside is at the left."""
        if abs(a[0] - b[0]) < abs(a[1] - b[1]):
            return Facing.WEST if b[1] > a[1] else Facing.EAST
        return Facing.NORTH if b[0] > a[0] else Facing.SOUTH

    def along(self, a: Corner, b: Corner) -> Float:
        """(K, 2) start and end, clipped to a side, of what was seen along it."""
        facing = self.facing(a, b)
        rows = self._table.seen[self._table.first[facing] : self._table.first[facing + 1]]
        low, high = sorted((a[1 - facing.axis], b[1 - facing.axis]))
        runs = rows[np.abs(rows[:, 0] - a[facing.axis]) < REACH, 1:3].clip(low, high)
        return runs[runs[:, 1] > runs[:, 0]]

    def ahead(self, facing: Facing, start: float, end: float) -> tuple[Float, Float]:
        """(K, 2) offset of each wall surface seen of a facing, and metres of it between two places along it.

        And (L, 2) the same of what may be wall or furniture.
        """
        of = slice(*self._table.first[[facing, facing + 1]])
        low = self._table.low[self._table.low[:, 0] == facing]
        found = []
        for offset, first, last in (self._table.seen[of, :3].T, low[:, 1:].T):
            common = np.minimum(last, end) - np.maximum(first, start)
            found.append(np.column_stack([offset, common])[common > 0])
        return found[0], found[1]

    def measure(self, corners_: Float, doors: Float) -> list[tuple[float, str, float | None]]:
        """Of each side of a ring: the share that was seen, the plane that explains most of it, the residual.

        :param corners_: (N, 2) corners; ``doors``: (D, 5), see :func:`doors_of`.
        """
        t = self._table
        found = measure_sides(corners_, t.seen, t.first, t.placed, t.panes, doors, len(t.names))
        names = [*t.names, ""]  # -1: none
        return [
            (share, names[int(plane)], None if residual != residual else residual)
            for share, plane, residual in found.tolist()
        ]

    def fit(self, polygon: Any) -> Any:
        """The polygon with every side moved to the surfaces seen along it, in steps where they step; those
        placed by hand stay."""
        t = self._table

        def targets(points: Float) -> Float:
            return np.asarray(side_targets(points, t.seen, t.first, t.placed, self.thickness))

        moved = map_polygon(polygon, lambda ring: move_sides(ring, targets))
        return add_steps(moved, t.seen, t.first, t.placed)


def doors_of(doors: Sequence[Door]) -> Float:
    """(D, 5) axis, offset, reach to a side that the door lies in, start, end; metres."""
    rows = [(d.axis, d.offset, d.thickness / 2 + REACH, d.start, d.end) for d in doors]
    return np.array(rows, dtype=np.float64).reshape(-1, 5)


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
        self._walls, self._doors = walls, doors_of(doors)
        self._known: dict[Any, tuple[RegionSide, ...]] = {}  # by polygon

    def of(self, polygon: Any) -> tuple[RegionSide, ...]:
        """What :func:`sides_of` says of ``polygon``."""
        if polygon not in self._known:
            self._known[polygon] = _sides(polygon, self._walls, self._doors)
        return self._known[polygon]


def sides_of(polygon: Any, walls: WallSurfaces, doors: Sequence[Door]) -> tuple[RegionSide, ...]:
    """The sides of all rings, the inside at their left, with the share of each that was seen."""
    return _sides(polygon, walls, doors_of(doors))


def _sides(polygon: Any, walls: WallSurfaces, doors: Float) -> tuple[RegionSide, ...]:
    out: list[RegionSide] = []
    for ring, hole in ((polygon.exterior, False), *((ring, True) for ring in polygon.interiors)):
        points = corners(shapely.get_coordinates(ring))
        ends = [(x, y) for x, y in points.tolist()]
        for a, b, (share, plane, residual) in zip(
            ends, ends[1:] + ends[:1], walls.measure(points, doors), strict=True
        ):
            out.append(RegionSide(a, b, plane, round(share, 4), hole, residual))
    return tuple(out)

"""Regions keep their names from one plan of a run to the next, where they persist (paper, online figures).

A region is the one of the plan before with which it shares the most area; numbers are never used twice.
Cost: one overlap for each pair of regions whose boxes meet.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from floorplan_core.model import Door, Region
from floorplan_core.model.quarter_turns import turned_place

ID_PREFIX = "r"  # of a region's id; its number follows
MIN_SHARE = 0.3  # of the smaller of two regions that the other must cover to be the same one


def in_reading_order(regions: Sequence[Region], quarters: int = 0) -> tuple[Region, ...]:
    """The regions named from top to bottom, in steps of a decimetre, then from left to right.

    :param quarters: quarter turns, counter-clockwise, from the axes of the regions to those of the reader.
    """
    inside = [r.polygon.representative_point() for r in regions]
    points = [turned_place((p.x, p.y), quarters) for p in inside]
    order = sorted(range(len(regions)), key=lambda k: (-round(points[k][1], 1), points[k][0]))
    return tuple(replace(regions[k], id=f"{ID_PREFIX}{n + 1}", name=str(n + 1)) for n, k in enumerate(order))


def persist_names(
    previous: Sequence[Region], regions: Sequence[Region], first_unused: int = 1
) -> tuple[Region, ...]:
    """``regions`` with the names and ids of those of ``previous`` that they continue.

    New ones get the next numbers as their names, and ids made of them.

    Pairs are matched in the order of falling overlap; ties go to the earlier region of ``previous``, then to
    the earlier of ``regions``. ``first_unused`` is the lowest number that the run never gave to any region;
    numbers of ``previous`` are skipped as well.
    """
    continued = _match(previous, regions)
    fresh = max(first_unused, next_number(previous))
    named = []
    for index, region in enumerate(regions):
        if index in continued:
            before = previous[continued[index]]
            named.append(replace(region, name=before.name, id=before.id))
        else:
            named.append(replace(region, name=str(fresh), id=f"{ID_PREFIX}{fresh}"))
            fresh += 1
    return tuple(named)


def keep_names(
    previous: Sequence[Region], regions: Sequence[Region], doors: Sequence[Door], first_unused: int
) -> tuple[tuple[Region, ...], tuple[Door, ...]]:
    """:func:`persist_names` for the regions and for the doors that name them."""
    named = persist_names(previous, regions, first_unused)
    new_id = {old.id: new.id for old, new in zip(regions, named, strict=True)}
    return named, tuple(replace(d, connects=tuple(new_id[c] for c in d.connects)) for d in doors)


def next_number(regions: Sequence[Region]) -> int:
    """The number after the largest among the names of ``regions``."""
    return 1 + max((int(r.name) for r in regions if r.name.isdecimal()), default=0)


def _match(previous: Sequence[Region], regions: Sequence[Region]) -> dict[int, int]:
    """Index in ``regions`` to index in ``previous``, one to one."""
    overlaps = sorted((-area, i, j) for i, j, area in _overlaps(previous, regions))
    matched: dict[int, int] = {}
    taken: set[int] = set()
    for _, i, j in overlaps:
        if i not in taken and j not in matched:
            matched[j] = i
            taken.add(i)
    return matched


def _overlaps(previous: Sequence[Region], regions: Sequence[Region]) -> list[tuple[int, int, float]]:
    """(index before, index now, m2) of all pairs that share enough."""
    import shapely

    if not previous or not regions:
        return []
    before = np.array([r.polygon for r in previous])
    now = np.array([r.polygon for r in regions])
    i, j = shapely.STRtree(now).query(before, predicate="intersects")
    shared = shapely.area(shapely.intersection(before[i], now[j]))
    enough = shared > MIN_SHARE * np.minimum(shapely.area(before[i]), shapely.area(now[j]))
    return [(int(a), int(b), float(s)) for a, b, s in zip(i[enough], j[enough], shared[enough], strict=True)]


class RegionNames(Protocol):
    """Gives the regions of a plan the names that they had in the plans before."""

    def __call__(
        self, regions: tuple[Region, ...], doors: tuple[Door, ...], storey: int
    ) -> tuple[tuple[Region, ...], tuple[Door, ...]]:
        """Regions and doors of one storey with names and ids that persist."""


class NamesOfRun:
    """Names from one plan of a run to the next: more is seen, nothing is taken back."""

    def __init__(self) -> None:
        self._before: dict[int, tuple[Region, ...]] = {}  # by storey
        self._unused: dict[int, int] = {}  # the lowest number that no region of a storey ever had

    def __call__(
        self, regions: tuple[Region, ...], doors: tuple[Door, ...], storey: int
    ) -> tuple[tuple[Region, ...], tuple[Door, ...]]:
        """:func:`keep_names` with the plan before."""
        before, unused = self._before.get(storey), self._unused.get(storey, 1)
        if before:
            regions, doors = keep_names(before, regions, doors, unused)
        self._before[storey] = regions
        self._unused[storey] = max(unused, next_number(regions))
        return regions, doors


class NamesOfSession:
    """Names from one replan to the next, where settings and corrections are tried and taken back.

    A region keeps the name of the place where it first appeared, and regions that were there before in the
    very same shapes have the very same names: undo brings them back exactly.
    """

    def __init__(self) -> None:
        self._first: dict[int, tuple[Region, ...]] = {}  # by storey: every name, where it first appeared
        self._given: dict[tuple[int, bytes], tuple[tuple[str, str], ...]] = {}  # id and name of each region
        self.last: tuple[Region, ...] = ()  # of storey 0, as they were named last

    def begin_with(self, regions: Sequence[Region]) -> None:
        """Go on with the names of an earlier session: those of these regions."""
        self.last = self._first[0] = tuple(regions)
        self._given[0, _shapes(regions)] = tuple((r.id, r.name) for r in regions)

    def __call__(
        self, regions: tuple[Region, ...], doors: tuple[Door, ...], storey: int
    ) -> tuple[tuple[Region, ...], tuple[Door, ...]]:
        """The names given to these shapes before, or else by the overlap with where names first appeared."""
        shapes = _shapes(regions)
        names = self._given.get((storey, shapes))
        if names is None:
            first = self._first.get(storey, ())
            known = {r.id for r in first}
            named = persist_names(first, regions) if first else regions
            self._first[storey] = (*first, *(r for r in named if r.id not in known))
            names = self._given[storey, shapes] = tuple((r.id, r.name) for r in named)
        new_id = {r.id: ident for r, (ident, _) in zip(regions, names, strict=True)}
        regions = tuple(replace(r, id=i, name=n) for r, (i, n) in zip(regions, names, strict=True))
        self.last = regions if storey == 0 else self.last
        return regions, tuple(replace(d, connects=tuple(new_id[c] for c in d.connects)) for d in doors)


def _shapes(regions: Sequence[Region]) -> bytes:
    import shapely

    return b"".join(shapely.to_wkb(np.array([r.polygon for r in regions], dtype=object)))

"""Regions keep their names from one plan of a run to the next, where they persist (paper, online figures).

A region is the one of the plan before with which it shares the most area; numbers are never used twice.
Cost: one overlap for each pair of regions whose boxes meet.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from floorplan_core.model import Door, Region

ID_PREFIX = "r"  # of a region's id; its number follows
MIN_SHARE = 0.3  # of the smaller of two regions that the other must cover to be the same one


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

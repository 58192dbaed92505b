"""Regions of a plan with wings, merged and split by hand: after the parts were joined, at any angle.

In: the joined regions and what a person said, in the axes of the plan. Out: regions that are still disjoint,
and the merged polygons, in which no wall parts anything any more. A line that is drawn follows the axes of
the part that it is nearest to. Heights stay as they were; sides are found along their lines.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import shapely

from floorplan_core.model import OccupancyGrid, Region
from floorplan_core.model.corrections import Correction, MergeRegions, SplitRegion
from floorplan_core.stages.corrections import NOTHING, Remarks, part_of
from floorplan_core.stages.corrections_regions import merge, split
from floorplan_core.stages.regions import count_cells, region_of
from floorplan_core.stages.wing_joins import sides_between

_EXACT = 1e-6  # m, to which corners are rounded
_SHARED = 1e-4  # m2 that a polygon has in common with a region whose sides it takes over

Regions = tuple[Region, ...]


def correct_joined_shapes(
    regions: Regions,
    corrections: Sequence[Correction],
    turns: Sequence[float],
    walls: Any,
    grid: OccupancyGrid,
    least: float,
) -> tuple[Regions, tuple[Any, ...], Remarks]:
    """Regions after ``corrections``, one after the other, the polygons that were merged, and remarks.

    :param turns: radians from the plan's axes to those of each part, that of the building (0) first.
    :param walls: the faces of the walls of all parts, lines in the axes of the plan.
    :param least: m2 of a part of a region that is split.
    """
    merged: list[Any] = []
    said = NOTHING
    for correction in corrections:
        before = regions

        def remake(polygon: Any, region: Region, before: Regions = before) -> Region:
            return _remade(polygon, region, before, walls, grid)

        if isinstance(correction, MergeRegions):
            regions, whole, remarks = merge(regions, correction, remake, _closed, _closed)
            merged += [] if whole is None else [whole]
        else:
            assert isinstance(correction, SplitRegion)
            turn = turns[part_of(correction, turns)]
            regions, remarks = split(regions, correction, least, remake, turn)
        said += remarks
    return regions, tuple(merged), said


def _closed(shape: Any, width: float) -> Any:
    """Gaps filled that are narrower than ``width``, at any angle."""
    grown = shape.buffer(width / 2, join_style="mitre")
    return shapely.set_precision(grown.buffer(-width / 2, join_style="mitre"), _EXACT)


def _remade(polygon: Any, region: Region, before: Regions, walls: Any, grid: OccupancyGrid) -> Region:
    polygon = shapely.orient_polygons(polygon)
    sides = [s for r in before if r.polygon.intersection(polygon).area > _SHARED for s in r.sides]
    made = region_of(polygon, None, sides_between(polygon, sides, walls), *count_cells(polygon, grid))
    return replace(made, id=region.id, name=region.name, height=region.height, by_hand=region.by_hand)

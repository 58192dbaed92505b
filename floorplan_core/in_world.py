"""The finished plan, made in the survey's own quadrant, as its user sees it: along the axes of the world that
are nearest, and with the names that its regions had in the plans before."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.layout_wings import counted
from floorplan_core.model import FloorPlan
from floorplan_core.model.quarter_turns import quarters_to_world, turned_plan
from floorplan_core.stages.region_names import RegionNames

Float = NDArray[np.float64]


def in_world(own: FloorPlan) -> FloorPlan:
    """The plan in the axes of its walls that are nearest to those of the local frame."""
    quarters = quarters_to_world(own.frame)
    if not quarters:
        return own
    plan = turned_plan(own, quarters)  # a cell's centre that lies on a side counts for the other region now
    return replace(plan, regions=tuple(counted(region, plan.grid) for region in plan.regions))


def named(plan: FloorPlan, names: RegionNames, centre: Float) -> FloorPlan:
    """The plan with names that persist by place.

    :param centre: (3,) metres, of the frame's origin in the local frame: it changes as more is seen.
    """
    import shapely

    def local(xy: Float) -> Float:
        return (plan.frame.from_manhattan(xy) + centre)[:, :2]

    placed = tuple(replace(r, polygon=shapely.transform(r.polygon, local)) for r in plan.regions)
    called, doors = names(placed, plan.doors, plan.storey)
    regions = tuple(replace(r, id=n.id, name=n.name) for r, n in zip(plan.regions, called, strict=True))
    return replace(plan, regions=regions, doors=doors)

"""The slice of the voxel map: free, predicted, occupied, unobserved cells, and the outline of the plan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.layers.source import PlanSource, Rings, rings
from floorplan_core.model import FREE, OCCUPIED, OccupancyGrid, Region
from floorplan_core.model.floor_plan import regions_mask

UNSEEN, SEEN_FREE, PREDICTED, SOLID = 0, 1, 2, 3  # codes of the cells


@dataclass(frozen=True)
class FreeSpaceLayer:
    """Cell ``[iy, ix]`` covers ``origin + cell * [ix, iy]`` to ``+ cell``."""

    codes: NDArray[np.uint8]  # (ny, nx) UNSEEN, SEEN_FREE, PREDICTED or SOLID
    origin: tuple[float, float]  # metres, manhattan frame: lower left corner
    cell: float  # metres
    height: float  # metres above the floor, of the slice
    outlines: Rings  # of the regions


def free_space_layer(source: PlanSource) -> FreeSpaceLayer:
    """The slice of a whole plan."""
    return free_space_of(source.plan.grid, source.drawn.regions)


def free_space_of(grid: OccupancyGrid, regions: tuple[Region, ...]) -> FreeSpaceLayer:
    """Predicted is what lies in a region and was not seen to be anything."""
    inside = regions_mask(regions, grid)
    codes = np.zeros(grid.states.shape, dtype=np.uint8)
    codes[inside] = PREDICTED
    codes[grid.states == OCCUPIED] = SOLID
    codes[grid.states == FREE] = SEEN_FREE
    x, y = grid.origin.tolist()
    outlines = tuple(ring for r in regions for ring in rings(r.polygon))
    return FreeSpaceLayer(codes, (x, y), grid.cell, grid.slice_height, outlines)

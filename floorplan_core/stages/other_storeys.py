"""The outline of what is in the plan of another storey: the void beside a gallery, a half level below.

The cells of the evidence say where that is to a cell or two; a region that ends there shall have straight
sides. Cost: linear in the cells.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.masks import opened
from floorplan_core.geometry.raster import cells_to_polygon
from floorplan_core.model.evidence import Evidence

Float = NDArray[np.float64]

_NEXT = 0.25  # m from one side to the next: those in between are jags of one
_SPAN = 0.5  # m from the first to the last of them


def straight_outline(evidence: Evidence) -> Any:
    """Polygons of the cells ``elsewhere``, the jags of their sides taken out."""
    assert evidence.elsewhere is not None
    cells = opened(np.pad(evidence.elsewhere, 1))[1:-1, 1:-1]
    outline = cells_to_polygon(cells, np.zeros(2), 1.0)
    rings = [shapely.get_coordinates(ring) for ring in shapely.get_rings(shapely.get_parts(outline))]
    if not rings:
        return shapely.MultiPolygon()
    sides = np.concatenate([np.hstack([ring[:-1], ring[1:]]) for ring in rings])
    moved = [_straight(sides, axis, evidence.cell) for axis in (0, 1)]

    def placed(xy: Float) -> Float:
        new = [[moved[axis][v] for v in xy[:, axis].tolist()] for axis in (0, 1)]
        return np.array(new).T * evidence.cell + evidence.origin

    return shapely.make_valid(shapely.transform(outline, placed))


def _straight(sides: Float, axis: int, cell: float) -> dict[float, float]:
    """For each coordinate of (N, 4) sides across ``axis``, in cells, that of the line of which it is a jag:
    the middle one by length."""
    across = sides[:, axis] == sides[:, axis + 2]
    at, length = sides[across, axis], np.abs(sides[across, 1 - axis] - sides[across, 3 - axis])
    order = np.argsort(at, kind="stable")
    at, length = at[order], length[order]
    out: dict[float, float] = {}
    first = 0
    for k in range(1, len(at) + 1):
        if k < len(at) and at[k] - at[k - 1] <= _NEXT / cell and at[k] - at[first] <= _SPAN / cell:
            continue
        weight = np.cumsum(length[first:k])
        middle = float(at[first + np.searchsorted(weight, weight[-1] / 2)])
        out |= dict.fromkeys(at[first:k].tolist(), middle)
        first = k
    return out

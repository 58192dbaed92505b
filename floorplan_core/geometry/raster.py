"""Polygons to cells and back, on a regular grid (row = y, column = x)."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray


def polygon_mask(
    polygon: Any, origin: NDArray[np.float64], cell: float, shape: tuple[int, ...]
) -> NDArray[np.bool_]:
    """(ny, nx) True where the centre of a cell lies inside ``polygon`` (shapely, metres)."""
    ny, nx = shape
    mask = np.zeros((ny, nx), dtype=bool)
    x0, y0, x1, y1 = polygon.bounds
    i0, i1 = (int(np.clip(np.floor((v - origin[0]) / cell) + d, 0, nx)) for v, d in ((x0, 0), (x1, 1)))
    j0, j1 = (int(np.clip(np.floor((v - origin[1]) / cell) + d, 0, ny)) for v, d in ((y0, 0), (y1, 1)))
    if i1 <= i0 or j1 <= j0:
        return mask
    xs = origin[0] + cell * (np.arange(i0, i1) + 0.5)
    ys = origin[1] + cell * (np.arange(j0, j1) + 0.5)
    gx, gy = np.meshgrid(xs, ys)
    shapely.prepare(polygon)
    mask[j0:j1, i0:i1] = shapely.contains_xy(polygon, gx, gy)
    return mask


def cells_to_polygon(mask: NDArray[np.bool_], origin: NDArray[np.float64], cell: float) -> Any:
    """Shapely MultiPolygon that is the union of the True cells of ``mask``."""
    runs = []
    for iy, row in enumerate(mask):
        edges = np.flatnonzero(np.diff(np.concatenate([[False], row, [False]]).astype(np.int8)))
        runs += [(a, iy, b, iy + 1) for a, b in edges.reshape(-1, 2)]
    if not runs:
        return shapely.MultiPolygon()
    box = np.array(runs, dtype=np.float64) * cell + np.tile(origin, 2)
    union = shapely.union_all(shapely.box(*box.T))
    return union if union.geom_type == "MultiPolygon" else shapely.MultiPolygon([union])

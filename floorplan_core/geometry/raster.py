"""Polygons to cells and back, on a regular grid (row = y, column = x).

Both directions are exact: a mask holds the cells whose centre lies inside (half open: a centre on a left or
lower edge is inside, on a right or upper edge outside, so that adjacent polygons never share a cell), and the
polygon of a mask is the union of its cells. Cost: edges times rows; boundary corners.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]
Int = NDArray[np.int64]
Bool = NDArray[np.bool_]


def polygon_mask(polygon: Any, origin: Float, cell: float, shape: tuple[int, ...]) -> Bool:
    """(ny, nx) True where the centre of a cell lies inside ``polygon`` (shapely, metres), holes left out."""
    mask = np.zeros(shape, dtype=bool)
    window, inside = polygon_window(polygon, origin, cell, shape)
    mask[window] = inside
    return mask


def polygon_window(
    polygon: Any, origin: Float, cell: float, shape: tuple[int, ...]
) -> tuple[tuple[slice, slice], Bool]:
    """The same for the cells around the polygon only: rows and columns, and their mask."""
    if polygon.is_empty:
        return (slice(0, 0), slice(0, 0)), np.zeros((0, 0), dtype=bool)
    x0, y0, x1, y1 = polygon.bounds
    i0, i1 = (_index(v, origin[0], cell, shape[1]) for v in (x0, x1))
    j0, j1 = (_index(v, origin[1], cell, shape[0]) for v in (y0, y1))
    edges = edges_of(polygon)
    return (slice(j0, j1), slice(i0, i1)), _fill(edges, i0, j0, i1 - i0, j1 - j0, origin[0], origin[1], cell)


def _index(value: float, origin: float, cell: float, count: int) -> int:
    """The first cell whose centre is not below ``value``, within the grid."""
    return min(max(math.ceil((value - origin) / cell - 0.5), 0), count)


def edges_of(polygon: Any) -> Float:
    """(E, 4) x0, y0, x1, y1 of the edges of all rings."""
    if polygon.geom_type == "Polygon" and not shapely.get_num_interior_rings(polygon):
        points = shapely.get_coordinates(polygon)
        return np.hstack([points[:-1], points[1:]])
    rings = shapely.get_rings(shapely.get_parts(polygon))
    points, ring = shapely.get_coordinates(rings, return_index=True)
    same = ring[1:] == ring[:-1]
    return np.hstack([points[:-1][same], points[1:][same]])


@njit(cache=True, nogil=True)
def _fill(edges, i0, j0, nx, ny, left, bottom, cell):  # type: ignore[no-untyped-def]
    """(ny, nx) even-odd fill: each edge marks, in each row that it crosses, the first cell to its right.

    Cells are counted on the whole grid, so that polygons that share an edge round it alike.
    """
    crossings = np.zeros((ny, nx + 1), dtype=np.bool_)
    for x0, y0, x1, y1 in edges:
        first = min(max(math.ceil((min(y0, y1) - bottom) / cell - 0.5), j0), j0 + ny) - j0
        last = min(max(math.ceil((max(y0, y1) - bottom) / cell - 0.5), j0), j0 + ny) - j0
        for row in range(first, last):
            x = x0
            if x1 != x0:
                x += (bottom + cell * (row + j0 + 0.5) - y0) * ((x1 - x0) / (y1 - y0))
            column = math.ceil((x - left) / cell - 0.5) - i0
            crossings[row, min(max(column, 0), nx)] ^= True
    out = np.empty((ny, nx), dtype=np.bool_)
    for row in range(ny):
        inside = False
        for column in range(nx):
            inside ^= crossings[row, column]
            out[row, column] = inside
    return out


def cells_to_polygon(mask: Bool, origin: Float, cell: float) -> Any:
    """Shapely MultiPolygon that is the union of the True cells: one valid polygon per 4-connected patch."""
    if not mask.any():
        return shapely.MultiPolygon()
    from floorplan_core.geometry.masks import label_patches

    labels = np.pad(label_patches(mask)[0], 1)
    ix, iy, left_is_north = _corners(labels)
    walks = _rings(ix, iy, left_is_north)
    order, ring = np.concatenate(walks), np.repeat(np.arange(len(walks)), [len(walk) for walk in walks])
    points = np.column_stack([ix[order], iy[order]]) * cell + origin
    ends = np.array([walk[:2] for walk in walks])
    homes = _homes(labels, ix[ends].min(axis=1), iy[ends[:, 0]])
    return shapely.MultiPolygon(_assemble(shapely.linearrings(points, indices=ring), homes))


def _corners(labels: NDArray[np.int32]) -> tuple[Int, Int, Bool]:
    """Lattice corners of the boundary: x, y, and whether the edge to the west joins the one to the north.

    Where two cells touch at a corner only, the corner is listed twice, once for each of the two rings
    that meet there. Cells of one patch are joined across it, of two kept apart: every ring is simple.
    """
    sw, se, nw, ne = labels[:-1, :-1], labels[:-1, 1:], labels[1:, :-1], labels[1:, 1:]
    filled = (sw > 0).astype(np.int8) + (se > 0) + (nw > 0) + (ne > 0)
    rising = (filled == 2) & (sw > 0) & (ne > 0)
    falling = (filled == 2) & (nw > 0) & (se > 0)
    west_north = (rising & (sw == ne)) | (falling & (nw != se))
    times = ((filled == 1) | (filled == 3)) + 2 * (rising | falling)
    iy, ix = np.nonzero(times)
    count = times[iy, ix]
    return np.repeat(ix, count), np.repeat(iy, count), np.repeat(west_north[iy, ix], count)


def _rings(ix: Int, iy: Int, west_north: Bool) -> list[Int]:
    """Closed walks over the corners: in a row they pair up from the left, in a column from below."""
    n = len(ix)
    second = np.zeros(n, dtype=bool)  # the copy of a double corner that owns the edge to the east
    second[1:] = (ix[1:] == ix[:-1]) & (iy[1:] == iy[:-1])
    across = np.lexsort((second, ix, iy))
    upright = np.lexsort((second ^ west_north, iy, ix))
    beside, above = np.empty(n, dtype=np.int64), np.empty(n, dtype=np.int64)
    for partner, order in ((beside, across), (above, upright)):
        partner[order[0::2]], partner[order[1::2]] = order[1::2], order[0::2]
    return _walk(beside.tolist(), above.tolist())


def _walk(beside: list[int], above: list[int]) -> list[Int]:
    """Follow horizontal and vertical edges in turn until each ring closes."""
    left = [True] * len(beside)
    rings = []
    for start in range(len(beside)):
        ring, at = [], start
        while left[at]:
            other = beside[at]
            left[at] = left[other] = False
            ring += [at, other]
            at = above[other]
        if ring:
            rings.append(np.array(ring))
    return rings


def _homes(labels: NDArray[np.int32], x: Int, y: Int) -> Int:
    """(R,) the patch that each ring bounds: of the two cells beside its first edge along x, the filled one.

    :param x, y: (R,) the left end of that edge.
    """
    return np.maximum(labels[y, x + 1], labels[y + 1, x + 1]).astype(np.int64)


def _assemble(rings: NDArray[np.object_], homes: Int) -> NDArray[np.object_]:
    """One polygon for each patch: its largest ring is the shell, the others are holes, largest first."""
    size = shapely.area(shapely.polygons(rings))
    order = np.lexsort((-size, homes))
    first = np.flatnonzero(np.concatenate([[True], np.diff(homes[order]) != 0]))
    patch = np.repeat(np.arange(len(first)), np.diff([*first, len(order)]))
    hole = np.ones(len(order), dtype=bool)
    hole[first] = False
    polygons = shapely.polygons(rings[order[first]])
    for k in np.unique(patch[hole]):
        polygons[k] = shapely.Polygon(rings[order[first[k]]], list(rings[order[hole & (patch == k)]]))
    return np.asarray(shapely.orient_polygons(polygons))

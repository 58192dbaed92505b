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

# Kinds of corners; modulo 3 the number of rings that turn there.
_SINGLE, _WEST_SOUTH, _WEST_NORTH = 1, 2, 5


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
    edges = edges_of(polygon)
    if not len(edges):
        return (slice(0, 0), slice(0, 0)), np.zeros((0, 0), dtype=bool)
    i0, j0, inside = _fill(edges, shape[0], shape[1], origin[0], origin[1], cell)
    return (slice(j0, j0 + inside.shape[0]), slice(i0, i0 + inside.shape[1])), inside


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
def _fill(edges, rows, columns, left, bottom, cell):  # type: ignore[no-untyped-def]
    """Even-odd fill: each edge marks, in each row that it crosses, the first cell to its right.

    Cells are counted on the whole grid, so that polygons that share an edge round it alike.

    :return: first column, first row, mask (ny, nx) of the cells around the polygon.
    """
    i0, i1 = (
        _cell_at(edges[:, 0].min(), left, cell, columns),
        _cell_at(edges[:, 0].max(), left, cell, columns),
    )
    j0, j1 = _cell_at(edges[:, 1].min(), bottom, cell, rows), _cell_at(edges[:, 1].max(), bottom, cell, rows)
    nx, ny = i1 - i0, j1 - j0
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
    return i0, j0, out


@njit(cache=True, nogil=True)
def _cell_at(value, start, cell, count):  # type: ignore[no-untyped-def]
    """The first cell whose centre is not below ``value``, within the grid."""
    return min(max(math.ceil((value - start) / cell - 0.5), 0), count)


def cells_to_polygon(mask: Bool, origin: Float, cell: float) -> Any:
    """Shapely MultiPolygon that is the union of the True cells: one valid polygon per 4-connected patch."""
    if not mask.any():
        return shapely.MultiPolygon()
    from floorplan_core.geometry.masks import label_patches

    labels = np.zeros((mask.shape[0] + 2, mask.shape[1] + 2), dtype=np.int32)
    labels[1:-1, 1:-1] = label_patches(mask)[0]
    corners, first, homes = _trace(labels)
    ring = np.repeat(np.arange(len(homes)), np.diff(first))
    return shapely.multipolygons(_assemble(shapely.linearrings(corners * cell + origin, indices=ring), homes))


@njit(cache=True, nogil=True)
def _trace(labels):  # type: ignore[no-untyped-def]
    """Walk around the patches of ``labels``, which have a rim of zeros.

    Where two cells touch at a corner only, the corner is listed twice, once for each of the two rings
    that meet there. Cells of one patch are joined across it, of two kept apart: every ring is simple.

    :return: (C, 2) lattice corners x, y, ring by ring; (R + 1,) where each begins; (R,) the patch it bounds.
    """
    x, y, above = _pair_up(labels)  # in a row corners pair up from the left: the next, or the one before
    corners, first = np.empty((len(x), 2)), np.zeros(len(x) // 4 + 1, dtype=np.int64)
    homes, done = np.empty(len(x) // 4, dtype=np.int64), np.zeros(len(x), dtype=np.bool_)
    rings, count = 0, 0
    for start in range(len(x)):
        if done[start]:
            continue
        left, row = min(x[start], x[start ^ 1]), y[start]  # its first edge: one cell beside it is filled
        homes[rings] = max(labels[row, left + 1], labels[row + 1, left + 1])
        at = start
        while not done[at]:
            for k in (at, at ^ 1):
                done[k] = True
                corners[count, 0], corners[count, 1] = x[k], y[k]
                count += 1
            at = above[at ^ 1]
        rings += 1
        first[rings] = count
    return corners, first[: rings + 1], homes[:rings]


@njit(cache=True, nogil=True)
def _pair_up(labels):  # type: ignore[no-untyped-def]
    """Corners of the boundary in row order, and the partner of each in its column, paired up from below."""
    ny, nx = labels.shape[0] - 1, labels.shape[1] - 1
    count = 0
    for j in range(ny):
        for i in range(nx):
            count += _corner_kind(labels, i, j) % 3
    x, y = np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int64)
    above, open_ = np.empty(count, dtype=np.int64), np.full(nx, -1)
    c = 0
    for j in range(ny):
        for i in range(nx):
            kind = _corner_kind(labels, i, j)
            for k in range(kind % 3):
                # Of a double corner the first copy owns the edge to the west, the second that to the east.
                at = c + (1 - k if kind == _WEST_NORTH else k)
                x[at], y[at] = i, j
                if open_[i] < 0:
                    open_[i] = at
                else:
                    above[at], above[open_[i]] = open_[i], at
                    open_[i] = -1
            c += kind % 3
    return x, y, above


@njit(cache=True, nogil=True)
def _corner_kind(labels, i, j):  # type: ignore[no-untyped-def]
    """0: no corner; 1: one; else two cells touch there: their rings turn from west to south, or to north."""
    sw, se, nw, ne = labels[j, i] > 0, labels[j, i + 1] > 0, labels[j + 1, i] > 0, labels[j + 1, i + 1] > 0
    filled = int(sw) + int(se) + int(nw) + int(ne)
    if filled % 2:
        return _SINGLE
    if filled != 2 or sw in (se, nw):
        return 0
    if sw:
        return _WEST_NORTH if labels[j, i] == labels[j + 1, i + 1] else _WEST_SOUTH
    return _WEST_SOUTH if labels[j + 1, i] == labels[j, i + 1] else _WEST_NORTH


def _assemble(rings: NDArray[np.object_], homes: Int) -> NDArray[np.object_]:
    """One polygon for each patch: its largest ring is the shell, the others are holes, largest first."""
    if len(homes) == 1:
        return np.asarray(shapely.orient_polygons(shapely.polygons(rings)))
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

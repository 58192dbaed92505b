"""Polygons to cells and back, on a regular grid (row = y, column = x).

Both directions are exact: a mask holds the cells whose centre lies inside (half open: a centre on a left or
lower edge is inside, on a right or upper edge outside, so that adjacent polygons never share a cell), and the
polygon of a mask is the union of its cells. Cost: edges times rows; boundary corners.
"""

from __future__ import annotations

import math
from collections import defaultdict
from typing import Any

import numpy as np
import shapely
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
    crossings = np.zeros((j1 - j0, i1 - i0 + 1), dtype=bool)
    for edge in _edges(polygon):
        _toggle(crossings, edge, (i0, j0), origin, cell)
    return (slice(j0, j1), slice(i0, i1)), np.logical_xor.accumulate(crossings[:, :-1], axis=1)


def _index(value: float, origin: float, cell: float, count: int) -> int:
    """The first cell whose centre is not below ``value``, within the grid."""
    return min(max(math.ceil((value - origin) / cell - 0.5), 0), count)


def _toggle(
    crossings: Bool, edge: tuple[float, ...], corner: tuple[int, int], origin: Float, cell: float
) -> None:
    """Mark, in each row that the edge crosses, the first cell to its right: even-odd fill, row by row.

    Cells are counted on the whole grid, so that polygons that share an edge round it alike.
    """
    x0, y0, x1, y1 = edge
    (i0, j0), (ny, nx) = corner, crossings.shape
    low, high = (max(_index(v, origin[1], cell, j0 + ny), j0) for v in sorted((y0, y1)))
    if low >= high:
        return
    if x0 == x1:
        crossings[low - j0 : high - j0, _index(x0, origin[0], cell, i0 + nx - 1) - i0] ^= True
        return
    rows = np.arange(low, high)
    x = x0 + (origin[1] + cell * (rows + 0.5) - y0) * ((x1 - x0) / (y1 - y0))
    columns = np.ceil((x - origin[0]) / cell - 0.5).astype(np.int64) - i0
    crossings[rows - j0, np.clip(columns, 0, nx - 1)] ^= True  # a row crosses an edge once: no index repeats


def _edges(polygon: Any) -> list[tuple[float, float, float, float]]:
    """x0, y0, x1, y1 of every edge of every ring."""
    edges: list[tuple[float, float, float, float]] = []
    for part in getattr(polygon, "geoms", [polygon]):
        if part.geom_type != "Polygon":  # lines and points, which an intersection leaves, hold no cell
            continue
        for ring in (part.exterior, *part.interiors):
            c = shapely.get_coordinates(ring)
            edges += [tuple(e) for e in np.hstack([c[:-1], c[1:]]).tolist()]
    return edges


def cells_to_polygon(mask: Bool, origin: Float, cell: float) -> Any:
    """Shapely MultiPolygon that is the union of the True cells: one valid polygon per 4-connected patch."""
    if not mask.any():
        return shapely.MultiPolygon()
    from floorplan_core.geometry.masks import label_patches

    labels = np.pad(label_patches(mask)[0], 1)
    ix, iy, left_is_north = _corners(labels)
    rings, homes = [], []
    for ring in _rings(ix, iy, left_is_north):
        x, y = ix[ring], iy[ring]
        rings.append(shapely.LinearRing(np.column_stack([x, y]) * cell + origin))
        homes.append(_home(labels, x, y))
    return shapely.MultiPolygon(_assemble(rings, homes))


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


def _home(labels: NDArray[np.int32], x: Int, y: Int) -> int:
    """The patch that a ring bounds: of the two cells beside its first horizontal edge, the filled one."""
    column = min(int(x[0]), int(x[1])) + 1
    return int(max(labels[y[0], column], labels[y[0] + 1, column]))


def _assemble(rings: list[Any], homes: list[int]) -> list[Any]:
    """One polygon for each patch: its largest ring is the shell, the others are holes."""
    patches: dict[int, list[Any]] = defaultdict(list)
    for ring, home in zip(rings, homes, strict=True):
        patches[home].append(shapely.Polygon(ring))
    polygons = []
    for home in sorted(patches):
        shell, *holes = sorted(patches[home], key=lambda p: -p.area)
        polygons.append(shapely.Polygon(shell.exterior, [h.exterior for h in holes]))
    return list(shapely.orient_polygons(polygons))

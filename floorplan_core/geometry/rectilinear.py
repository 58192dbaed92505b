"""Rectilinear polygons: simplification, and moving whole sides."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import shapely
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.raster import cells_to_polygon

Float = NDArray[np.float64]

_SAME = 1e-6  # m, coordinates closer than this are equal
_EXACT = 1e-9  # m, beyond which sums of coordinates may differ in their last bits


def corners(ring: Float) -> Float:
    """(N, 2) corners of a closed rectilinear ring: no repeated, no collinear vertices; not closed."""
    return np.asarray(_corners(ring))


@njit(cache=True, nogil=True)
def _corners(ring):  # type: ignore[no-untyped-def]
    points, count, keep = ring.copy(), len(ring), np.empty(len(ring), dtype=np.bool_)
    if abs(ring[0, 0] - ring[-1, 0]) < _SAME and abs(ring[0, 1] - ring[-1, 1]) < _SAME:
        count -= 1
    while True:
        kept = _mark_corners(points[:count], keep)
        if kept == count:
            return points[:count]
        if kept < 4:
            return points[:0]
        at = 0
        for k in range(count):
            if keep[k]:
                points[at, 0], points[at, 1] = points[k, 0], points[k, 1]
                at += 1
        count = kept


@njit(cache=True, nogil=True)
def _mark_corners(points, keep):  # type: ignore[no-untyped-def]
    """Mark in ``keep`` the points that differ from those before them, or, where all do, the corners."""
    count, repeated = len(points), 0
    for k in range(count):
        still = abs(points[k, 0] - points[k - 1, 0]) < _SAME and abs(points[k, 1] - points[k - 1, 1]) < _SAME
        keep[k] = not still
        repeated += still
    if repeated > 0:  # these go first: beside its copy a corner would look like a point of a side
        return count - repeated
    kept = 0
    for k in range(count):
        after = k + 1 if k + 1 < count else 0
        keep[k] = True
        for axis in range(2):
            at = points[k, axis]
            if abs(at - points[k - 1, axis]) < _SAME and abs(points[after, axis] - at) < _SAME:
                keep[k] = False
        kept += keep[k]
    return kept


def move_sides(ring: Float, targets: Callable[[Float], Float]) -> Float:
    """(N, 2) corners of a ring with every side moved across its own direction.

    Where the ring would cross itself, sides that would change places with their next but one stay.

    :param targets: of the (N, 2) corners, the (N,) offsets to which the sides that begin there are moved.
    """
    points = corners(ring)
    if len(points) == 0:
        return points
    offsets = targets(points)
    out = np.asarray(_moved(points, offsets))
    return out if shapely.Polygon(out).is_valid else _moved_uncrossed(points, offsets)


def _moved_uncrossed(points: Float, offsets: Float) -> Float:
    """The corners with those sides left where they are that would turn the side between them round.

    First where the ring comes back beside itself, the end of a spike or a notch: a mere step may turn round.
    """
    following = np.roll(np.arange(len(points)), -1)
    way = points[following] - points
    across = (np.abs(way[:, 0]) >= _SAME).astype(np.int64)
    before = points[np.arange(len(points)), across]
    back = (np.roll(way, 1, axis=0) * np.roll(way, -1, axis=0)).sum(axis=1) < 0
    while True:
        out = np.asarray(_moved(points, offsets))
        if shapely.Polygon(out).is_valid:
            return out
        turned = ((out[following] - out) * way).sum(axis=1) < 0
        for ends in (turned & back, turned):
            beside = np.roll(ends, 1) | np.roll(ends, -1)
            if (beside & (offsets != before)).any():
                break
        else:
            return points
        offsets = np.where(beside, before, offsets)


@njit(cache=True, nogil=True)
def _moved(points, offsets):  # type: ignore[no-untyped-def]
    out = points.copy()
    for k in range(len(points)):
        following = k + 1 if k + 1 < len(points) else 0
        across = int(abs(points[k, 0] - points[following, 0]) >= _SAME)
        out[k, across] = out[following, across] = offsets[k]
    return out


def map_polygon(polygon: Any, move: Callable[[Float], Float]) -> Any:
    """Apply ``move`` to the corners of each ring, the inside at its left; holes that collapse are dropped."""
    rings = shapely.get_rings(shapely.orient_polygons(polygon))
    shell, *holes = (move(shapely.get_coordinates(ring)) for ring in rings)
    if not holes:  # most rooms
        return shapely.polygons(shell) if len(shell) else shapely.Polygon()
    return shapely.Polygon(shell, [h for h in holes if len(h) >= 4])


def union_boxes(boxes: Float) -> Any:
    """The union of (K, 4) boxes x0, y0, x1, y1, exactly: painted on the grid of their own coordinates."""
    xs, ys, mask = _paint(boxes)
    if mask.all():  # most rooms
        return shapely.box(xs[0], ys[0], xs[-1], ys[-1])

    def place(index: Float) -> Float:
        cells = np.rint(index).astype(np.int64)
        return np.column_stack([xs[cells[:, 0]], ys[cells[:, 1]]])

    return shapely.transform(cells_to_polygon(mask, np.zeros(2), 1.0), place)


@njit(cache=True, nogil=True)
def _paint(boxes):  # type: ignore[no-untyped-def]
    """The X and Y coordinates of boxes, in order; (Y - 1, X - 1) which cells between these they hold."""
    xs, ys = np.unique(boxes[:, ::2].copy().ravel()), np.unique(boxes[:, 1::2].copy().ravel())
    mask = np.zeros((len(ys) - 1, len(xs) - 1), dtype=np.bool_)
    for x0, y0, x1, y1 in boxes:
        left, right = np.searchsorted(xs, x0), np.searchsorted(xs, x1)
        for row in range(np.searchsorted(ys, y0), np.searchsorted(ys, y1)):
            mask[row, left:right] = True
    return xs, ys, mask


def open_polygon(polygon: Any, width: float) -> Any:
    """Remove the parts of a rectilinear polygon narrower than ``width`` (opening with a square).

    Made of boxes instead of buffers: those leave out steps below a hundredth of their distance, and so turn
    the small steps between neighbouring planes into slanted sides.
    """
    if width <= 0:
        return polygon
    if (sides := as_rectangle(polygon)) and min(sides[2] - sides[0], sides[3] - sides[1]) > 2 * width:
        return _opened_rectangle(*sides, width / 2)
    shrunk = shapely.difference(polygon, shapely.union_all(_borders(polygon, width / 2)))
    grown = shapely.union_all([shrunk, *_borders(shrunk, width / 2)])
    return shapely.set_precision(grown, _EXACT)


def as_rectangle(shape: Any) -> tuple[float, float, float, float] | None:
    """x0, y0, x1, y1 of a polygon, or of a multi-polygon of one, that is a rectangle along the axes."""
    points = shapely.get_coordinates(shape)
    if len(points) != 5:
        return None
    (ax, ay), (bx, by), (cx, cy), (dx, dy), _ = points.tolist()
    upright_first = ax == bx and by == cy and cx == dx and dy == ay
    level_first = ay == by and bx == cx and cy == dy and dx == ax
    if ax == cx or ay == cy or not (upright_first or level_first):
        return None
    return min(ax, cx), min(ay, cy), max(ax, cx), max(ay, cy)


def _opened_rectangle(x0: float, y0: float, x1: float, y1: float, half: float) -> Any:
    """What is left of a rectangle after its opening: itself, to the last bits as the boxes would have it."""
    x0, y0, x1, y1 = (x0 + half) - half, (y0 + half) - half, (x1 - half) + half, (y1 - half) + half
    return shapely.set_precision(shapely.box(x0, y0, x1, y1), _EXACT, mode="pointwise")


def close_polygon(shape: Any, width: float) -> Any:
    """Fill the gaps in and between rectilinear polygons narrower than ``width`` (closing with a square)."""
    grown = shapely.union_all([shape, *_borders(shape, width / 2)])
    shrunk = shapely.difference(grown, shapely.union_all(_borders(grown, width / 2)))
    return shapely.set_precision(shrunk, _EXACT)


def _borders(shape: Any, reach: float) -> NDArray[np.object_]:
    """A box around each side of a polygon or several, ``reach`` beyond it in all directions."""
    rings = [shapely.get_coordinates(ring) for ring in shapely.get_rings(shapely.get_parts(shape))]
    if not rings:
        return np.empty(0, dtype=object)
    ends = np.concatenate([np.stack([ring[:-1], ring[1:]]) for ring in rings], axis=1)
    low, high = ends.min(axis=0) - reach, ends.max(axis=0) + reach
    return np.asarray(shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1]))


def without_slits(shape: Any, width: float) -> Any:
    """Polygons without the holes narrower than ``width``: what millimetres between two planes leave open."""
    parts = [
        shapely.Polygon(part.exterior, [h for h in part.interiors if _narrow_side(h) >= width])
        for part in polygons_of(shape)
    ]
    return parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)


def _narrow_side(ring: Any) -> float:
    x0, y0, x1, y1 = ring.bounds
    return float(min(x1 - x0, y1 - y0))


@njit(cache=True, nogil=True)
def chords(edges, axis, offset):  # type: ignore[no-untyped-def]
    """(K, 2) from where to where the line at ``offset`` across ``axis`` runs inside a polygon, in order.

    A line along a side counts as just beyond it in the positive direction.

    :param edges: (E, 4) x0, y0, x1, y1 of all rings of the polygon.
    """
    at, count = np.empty(len(edges)), 0
    for k in range(len(edges)):
        u0, v0, u1, v1 = edges[k, axis], edges[k, 1 - axis], edges[k, axis + 2], edges[k, 3 - axis]
        if (u0 <= offset) != (u1 <= offset):
            at[count] = v0 + (offset - u0) * ((v1 - v0) / (u1 - u0))
            count += 1
    return np.sort(at[:count])[: count - count % 2].reshape(-1, 2)


def polygons_of(shape: Any) -> list[Any]:
    """The polygons of a polygon, multi-polygon or collection, largest first."""
    if shape.geom_type == "Polygon":
        return [shape] if shape.area > 0 else []
    parts = [p for p in shapely.get_parts(shape) if p.geom_type == "Polygon" and p.area > 0]
    return sorted(parts, key=lambda p: (-p.area, p.bounds))

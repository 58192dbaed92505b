"""Rectilinear polygons: simplification, and moving whole sides."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.raster import cells_to_polygon

Float = NDArray[np.float64]

_SAME = 1e-6  # m, coordinates closer than this are equal
_EXACT = 1e-9  # m, beyond which sums of coordinates may differ in their last bits


def corners(ring: Float) -> Float:
    """(N, 2) corners of a closed rectilinear ring: no repeated, no collinear vertices; not closed."""
    points = ring[:-1] if np.abs(ring[0] - ring[-1]).max() < _SAME else ring
    while True:
        before, after = np.concatenate([points[-1:], points[:-1]]), np.concatenate([points[1:], points[:1]])
        still = np.abs(points - before) < _SAME
        straight = still & (np.abs(after - points) < _SAME)
        # Repeated points go first: beside its copy a corner would look like a point of a side.
        repeated = still.all(axis=1)
        keep = ~repeated if repeated.any() else ~straight.any(axis=1)
        if keep.all() or keep.sum() < 4:
            return points if keep.all() else points[:0]
        points = points[keep]


def move_sides(ring: Float, targets: Callable[[Float], Float]) -> Float:
    """(N, 2) corners of a ring with every side moved across its own direction.

    :param targets: of the (N, 2) corners, the (N,) offsets to which the sides that begin there are moved.
    """
    points = corners(ring)
    if len(points) == 0:
        return points
    out, following = points.copy(), np.roll(np.arange(len(points)), -1)
    across = (np.abs(points[:, 0] - points[following, 0]) >= _SAME).astype(np.int64)
    offsets = targets(points)
    out[np.arange(len(points)), across] = offsets
    out[following, across] = offsets
    return out


def map_polygon(polygon: Any, move: Callable[[Float], Float]) -> Any:
    """Apply ``move`` to the corners of each ring, the inside at its left; holes that collapse are dropped."""
    polygon = shapely.orient_polygons(polygon)
    shell = move(np.asarray(polygon.exterior.coords))
    holes = [move(np.asarray(ring.coords)) for ring in polygon.interiors]
    return shapely.Polygon(shell, [h for h in holes if len(h) >= 4])


def union_boxes(boxes: Float) -> Any:
    """The union of (K, 4) boxes x0, y0, x1, y1, exactly: painted on the grid of their own coordinates."""
    xs, column = np.unique(boxes[:, [0, 2]], return_inverse=True)
    ys, row = np.unique(boxes[:, [1, 3]], return_inverse=True)
    mask = np.zeros((len(ys), len(xs)), dtype=bool)
    for (x0, x1), (y0, y1) in zip(column.reshape(-1, 2), row.reshape(-1, 2), strict=True):
        mask[y0:y1, x0:x1] = True
    if mask.all():  # most rooms
        return shapely.MultiPolygon([_rectangle(xs[0], ys[0], xs[-1], ys[-1])])

    def place(index: Float) -> Float:
        cells = np.rint(index).astype(np.int64)
        return np.column_stack([xs[cells[:, 0]], ys[cells[:, 1]]])

    return shapely.transform(cells_to_polygon(mask, np.zeros(2), 1.0), place)


def open_polygon(polygon: Any, width: float) -> Any:
    """Remove the parts of a rectilinear polygon narrower than ``width`` (opening with a square).

    Made of boxes instead of buffers: those leave out steps below a hundredth of their distance, and so turn
    the small steps between neighbouring planes into slanted sides.
    """
    if width <= 0:
        return polygon
    if (bounds := as_rectangle(polygon)) is not None and _narrow_side(polygon) > 2 * width:
        return _opened_rectangle(*bounds, width / 2)
    shrunk = shapely.difference(polygon, shapely.union_all(_borders(polygon, width / 2)))
    grown = shapely.union_all([shrunk, *_borders(shrunk, width / 2)])
    return shapely.set_precision(grown, _EXACT)


def as_rectangle(shape: Any) -> tuple[float, float, float, float] | None:
    """x0, y0, x1, y1 of a polygon, or of a multi-polygon of one, that is a rectangle along the axes."""
    if shapely.get_num_coordinates(shape) != 5 or shapely.get_num_geometries(shape) != 1:
        return None
    x0, y0, x1, y1 = shape.bounds
    points = shapely.get_coordinates(shape)
    square = np.isin(points[:, 0], (x0, x1)).all() and np.isin(points[:, 1], (y0, y1)).all()
    moved = (points[1:] != points[:-1]).sum(axis=1)
    return (x0, y0, x1, y1) if square and (moved == 1).all() else None


def _opened_rectangle(x0: float, y0: float, x1: float, y1: float, half: float) -> Any:
    """What is left of a rectangle after its opening: itself, to the last bits as the boxes would have it."""
    x0, y0, x1, y1 = (x0 + half) - half, (y0 + half) - half, (x1 - half) + half, (y1 - half) + half
    return shapely.set_precision(_rectangle(x0, y0, x1, y1, 1), _EXACT, mode="pointwise")


def _rectangle(x0: float, y0: float, x1: float, y1: float, first: int = 0) -> Any:
    """A rectangle, counter-clockwise from its ``first`` corner (0 is x0, y0)."""
    around = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return shapely.Polygon(around[first:] + around[:first])


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


def chords(edges: Float, axis: int, offset: float) -> list[tuple[float, float]]:
    """From where to where along the line at ``offset`` across ``axis`` it runs inside a polygon, in order.

    A line along a side counts as just beyond it in the positive direction.

    :param edges: (E, 4) x0, y0, x1, y1 of all rings of the polygon.
    """
    crossed = edges[(edges[:, axis] <= offset) != (edges[:, axis + 2] <= offset)]
    u0, v0, u1, v1 = crossed[:, [axis, 1 - axis, axis + 2, 3 - axis]].T
    at = np.sort(v0 + (offset - u0) * ((v1 - v0) / (u1 - u0))).tolist()
    return list(zip(at[::2], at[1::2], strict=True))


def polygons_of(shape: Any) -> list[Any]:
    """The polygons of a polygon, multi-polygon or collection, largest first."""
    parts = [p for p in shapely.get_parts(shape) if p.geom_type == "Polygon" and p.area > 0]
    return sorted(parts, key=lambda p: (-p.area, p.bounds))

"""Region polygons that stay disjoint when their coordinates are rounded.

Rounding moves each vertex on its own, so two regions stay apart only where they share vertices. Hence, in
the manhattan frame: coordinates that nearly agree are made equal, and every vertex that lies on an edge of
another region becomes a vertex of that edge too. After that, shared edges are pairs of equal vertices,
whatever rotation and rounding follow.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

Float = NDArray[np.float64]

# Metres. Faces nearer than this would cross when both are rounded to 0.1 mm; they are exported as one.
MERGE = 5e-4
# Polygons are kept on a grid of 1e-6: a vertex on a slanted edge of its neighbour lies beside it by as much.
ON_EDGE = 2e-6
AT_ONCE = 200_000  # pairs of an edge and a vertex that are looked at together: 20 MB


def matched(polygons: Sequence[Any]) -> list[Any]:
    """The same shapely Polygons with equal vertices along shared edges, shells counter-clockwise."""
    merged = _merge_coordinates(list(polygons))
    vertices = np.unique(shapely.get_coordinates(merged), axis=0)
    return [_rebuild(p, lambda ring: _insert(ring, vertices)) for p in shapely.orient_polygons(merged)]


def rounded(polygons: Sequence[Any], transform: Callable[[Float], Float], decimals: int) -> list[Any]:
    """The polygons after ``transform`` ((N, 2) to (N, 2)), rounded, without repeated vertices."""
    moved = shapely.transform(
        np.array(polygons, dtype=object), lambda points: np.round(transform(points), decimals)
    )
    repeated = _with_repeats(moved)  # few: to look for them in all takes GEOS longer than all the rest
    moved[repeated] = shapely.remove_repeated_points(moved[repeated], 0.0)
    return list(moved)


def _with_repeats(polygons: NDArray[np.object_]) -> NDArray[np.int64]:
    """Numbers of the polygons in which a vertex is that before it."""
    rings, owner = shapely.get_rings(polygons, return_index=True)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    same = (ring[1:] == ring[:-1]) & (points[1:] == points[:-1]).all(axis=1)
    return np.unique(owner[ring[1:][same]])


def _merge_coordinates(polygons: list[Any]) -> Any:
    """Snap each coordinate to the smallest one of its group; groups are at most ``MERGE`` wide."""
    coordinates = shapely.get_coordinates(polygons)
    for axis in range(2):
        values, inverse = np.unique(coordinates[:, axis], return_inverse=True)
        coordinates[:, axis] = _snap_sorted(values)[inverse]
    return shapely.set_coordinates(np.array(polygons, dtype=object), coordinates)


def _snap_sorted(values: Float) -> Float:
    snapped = values.copy()
    first = 0
    for i in range(1, len(values)):
        if values[i] - values[first] > MERGE:
            first = i
        snapped[i] = values[first]
    return snapped


def _rebuild(polygon: Any, change: Callable[[Float], Float]) -> Any:
    """A polygon of the changed rings, each (N, 2) with its last vertex equal to its first.

    A hole that is thinner than what is merged has nothing left inside, and is left out.
    """
    shell, *holes = (change(shapely.get_coordinates(r)) for r in (polygon.exterior, *polygon.interiors))
    return shapely.Polygon(shell, [h for h in holes if len(h) > 3 and shapely.Polygon(h).area > MERGE**2])


def _insert(ring: Float, vertices: Float) -> Float:
    """The ring with all ``vertices``, sorted by x, that lie inside its edges, in order."""
    low, high = ring.min(axis=0) - MERGE, ring.max(axis=0) + MERGE
    vertices = vertices[slice(*np.searchsorted(vertices[:, 0], [low[0], high[0]]))]
    vertices = vertices[(vertices[:, 1] > low[1]) & (vertices[:, 1] < high[1])]
    edge = np.diff(ring, axis=0)
    length = np.hypot(edge[:, 0], edge[:, 1])
    starts, edge, length = ring[:-1][length > 0], edge[length > 0], length[length > 0, None]
    step = max(1, AT_ONCE // max(len(vertices), 1))
    parts = [
        part
        for k in range(0, len(starts), step)
        for part in _split(starts[k : k + step], edge[k : k + step], length[k : k + step], vertices)
    ]
    return np.vstack([*parts, ring[:1]])


def _split(starts: Float, edge: Float, length: Float, vertices: Float) -> list[Float]:
    """The start of each edge and, in order, those of the ``vertices`` that lie inside it."""
    away = vertices - starts[:, None]  # (edges, vertices, 2)
    along = (away[..., 0] * edge[:, :1] + away[..., 1] * edge[:, 1:]) / length
    across = (away[..., 1] * edge[:, :1] - away[..., 0] * edge[:, 1:]) / length
    # The corners of a slanted edge were moved when coordinates were made equal, each by itself.
    reach = np.where(np.abs(edge).min(axis=1) > MERGE, MERGE, ON_EDGE)[:, None]
    on = (np.abs(across) < reach) & (along > MERGE / 2) & (along < length - MERGE / 2)
    parts = []
    for k in range(len(starts)):
        parts.append(starts[k : k + 1])
        if on[k].any():
            parts.append(vertices[on[k]][np.argsort(along[k, on[k]])])
    return parts

"""Geometry that rays hit: walls with holes, lintels and sills, leaves, furniture, floor and ceiling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.building import Building

Float = NDArray[np.float64]

SLAB = 0.2  # m, thickness of floor and ceiling
_CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
_FACES = np.array(
    [
        *([0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4]),
        *([1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]),
    ]
)


def dilated(building: Building) -> Float:
    """(N, 4) the spaces' rectangles grown by the exterior wall: their union is the footprint."""
    return np.round(building.rects + building.exterior_wall * np.array([-1, -1, 1, 1]), 4)


def wall_rectangles(building: Building) -> Float:
    """(K, 4) disjoint rectangles: the footprint without spaces, doors and windows."""
    outer, holes = dilated(building), [building.rects]
    holes += [np.array([o.bounds for o in group]) for group in (building.doors, building.windows) if group]
    inner = np.vstack(holes)
    both = np.round(np.vstack([outer, inner]), 4)
    xs, ys = np.unique(both[:, [0, 2]]), np.unique(both[:, [1, 3]])
    mask = np.zeros((len(ys) - 1, len(xs) - 1), dtype=bool)
    index = np.column_stack([np.searchsorted(xs if k % 2 == 0 else ys, both[:, k]) for k in range(4)])
    for number, (i0, j0, i1, j1) in enumerate(index):
        mask[j0:j1, i0:i1] = number < len(outer)
    cells = merge_cells(mask)
    return np.column_stack([xs[cells[:, 0]], ys[cells[:, 1]], xs[cells[:, 2]], ys[cells[:, 3]]])


def merge_cells(mask: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(K, 4) i0, j0, i1, j1: disjoint rectangles that cover the True cells (row runs, stacked)."""
    open_runs: dict[tuple[int, int], int] = {}
    done: list[tuple[int, int, int, int]] = []
    for j in range(len(mask) + 1):
        row = mask[j] if j < len(mask) else np.zeros(mask.shape[1], dtype=bool)
        edges = np.flatnonzero(np.diff(np.concatenate([[False], row, [False]]).astype(np.int8)))
        runs = {(int(a), int(b)) for a, b in edges.reshape(-1, 2)}
        done += [(a, open_runs[a, b], b, j) for a, b in sorted(set(open_runs) - runs)]
        open_runs = {run: open_runs.get(run, j) for run in sorted(runs)}
    return np.array(done, dtype=np.int64).reshape(-1, 4)


def _stand(rects: Float, low: Float | float, high: Float | float) -> Float:
    """(N, 7) axis-aligned solids from plan rectangles and heights."""
    n = len(rects)
    z0, z1 = np.broadcast_to(low, n), np.broadcast_to(high, n)
    return np.column_stack([rects[:, :2], z0, rects[:, 2:], z1, np.zeros(n)])


def building_solids(building: Building, furnished: bool = True) -> Float:
    """(N, 7) x0, y0, z0, x1, y1, z1, yaw of everything but the glass."""
    height = building.height
    parts = [_stand(wall_rectangles(building), 0.0, height)]
    parts.append(_stand(building.columns, 0.0, height))
    slabs = merged_footprint(building)
    parts += [_stand(slabs, -SLAB, 0.0), _stand(slabs, height, height + SLAB)]
    if building.doors:
        bounds = np.array([d.bounds for d in building.doors])
        parts.append(_stand(bounds, np.array([d.height for d in building.doors]), height))
        parts += [d.leaves for d in building.doors]
    if building.windows:
        bounds = np.array([w.bounds for w in building.windows])
        parts.append(_stand(bounds, 0.0, np.array([w.sill for w in building.windows])))
        parts.append(_stand(bounds, np.array([w.head for w in building.windows]), height))
    if furnished:
        parts += [f.solids for f in building.furniture]
    return np.vstack(parts)


def merged_footprint(building: Building) -> Float:
    """(K, 4) disjoint rectangles that tile the footprint."""
    outer = dilated(building)
    xs, ys = np.unique(outer[:, [0, 2]]), np.unique(outer[:, [1, 3]])
    mask = np.zeros((len(ys) - 1, len(xs) - 1), dtype=bool)
    for x0, y0, x1, y1 in outer:
        mask[
            np.searchsorted(ys, y0) : np.searchsorted(ys, y1),
            np.searchsorted(xs, x0) : np.searchsorted(xs, x1),
        ] = True
    cells = merge_cells(mask)
    return np.column_stack([xs[cells[:, 0]], ys[cells[:, 1]], xs[cells[:, 2]], ys[cells[:, 3]]])


def glass_solids(building: Building) -> Float:
    """(N, 7) window panes, thin, in the middle of their walls."""
    if not building.windows:
        return np.zeros((0, 7))
    panes = np.array([w.bounds for w in building.windows])
    for row, window in zip(panes, building.windows, strict=True):
        middle = (row[window.axis] + row[window.axis + 2]) / 2
        row[[window.axis, window.axis + 2]] = middle - 0.005, middle + 0.005
    sills, heads = (np.array([getattr(w, n) for w in building.windows]) for n in ("sill", "head"))
    return _stand(panes, sills, heads)


def triangles(solids: Float) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """Vertices (8N, 3) and faces (12N, 3) of (N, 7) solids."""
    low, high = solids[:, None, :3], solids[:, None, 3:6]
    vertices = low + _CORNERS[None] * (high - low)
    middle = (low + high) / 2
    rel = vertices - middle
    c, s = np.cos(solids[:, 6, None]), np.sin(solids[:, 6, None])
    vertices[..., 0] = middle[..., 0] + c * rel[..., 0] - s * rel[..., 1]
    vertices[..., 1] = middle[..., 1] + s * rel[..., 0] + c * rel[..., 1]
    faces = np.arange(len(solids))[:, None, None] * 8 + _FACES[None]
    return vertices.reshape(-1, 3).astype(np.float32), faces.reshape(-1, 3).astype(np.uint32)

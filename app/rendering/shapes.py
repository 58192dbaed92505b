"""Triangles and lines of walls, floors, outlines and the floor's grid. Pure functions, no Qt."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_app.colours import THEMES
from floorcast_app.rendering import ramps
from floorcast_app.rendering.drawables import Lines
from floorcast_app.view_state import Look

Float = NDArray[np.float64]

DASH = 0.18  # metres of a dash, and between two: guessed sides
GRID_ALPHA, GRID_FIFTH_ALPHA = 42, 95  # of 256
GRID_LINES = 20  # across the pane, about


def triangles_of(polygon: Any, z: float) -> Float:
    """(T, 3, 3) triangles of a shapely polygon (or several) at height ``z``."""
    from shapely import constrained_delaunay_triangles, get_coordinates, get_parts

    made = get_parts(constrained_delaunay_triangles(polygon))
    if not len(made):
        return np.zeros((0, 3, 3))
    flat = get_coordinates(made).reshape(-1, 4, 2)[:, :3]
    return np.concatenate([flat, np.full((*flat.shape[:2], 1), z)], axis=2)


def dashed(ends: Float) -> Float:
    """(K, 2, 3) the dashes of (L, 2, 3) lines; each begins and ends with one."""
    made = []
    for a, b in ends:
        count = max(int(np.hypot(*(b - a)[:2]) / DASH) // 2, 0) * 2 + 1
        at = np.linspace(0.0, 1.0, count + 1)
        points = a + at[:, None] * (b - a)
        made.append(np.stack([points[0:-1:2], points[1::2]], axis=1))
    return np.concatenate(made)


def floor_grid(bounds: tuple[float, float, float, float], step: float, look: Look) -> Lines:
    """A grid of ``step`` metres on the floor under ``bounds`` x0, y0, x1, y1; every fifth is stronger."""
    x0, y0 = np.floor(np.array(bounds[:2]) / step - 1).astype(int).tolist()
    x1, y1 = np.ceil(np.array(bounds[2:]) / step + 1).astype(int).tolist()
    xs, ys = np.arange(x0, x1 + 1), np.arange(y0, y1 + 1)
    along_y = np.array([[[x, y0, 0], [x, y1, 0]] for x in xs], dtype=np.float64)
    along_x = np.array([[[x0, y, 0], [x1, y, 0]] for y in ys], dtype=np.float64)
    ends = np.concatenate([along_y, along_x]) * step
    strong = np.concatenate([xs, ys]) % 5 == 0
    colour = np.full(len(ends), ramps.packed(THEMES[look.theme].muted), dtype=np.uint32)
    return Lines(
        ends,
        colour,
        np.where(strong, GRID_FIFTH_ALPHA, GRID_ALPHA).astype(np.uint32),
        np.ones(len(ends), dtype=np.int64),
    )


def grid_step(span: float) -> float:
    """Metres between grid lines: 1, 2 or 5 times a power of ten, some 20 across the pane."""
    power = 10.0 ** np.floor(np.log10(span / GRID_LINES))
    return float(
        next(power * factor for factor in (1, 2, 5, 10) if power * factor >= span / GRID_LINES - 1e-9)
    )


def on_wall(axis: int, offset: float, run: Float) -> Float:
    """(2, 2) end points in the plan of a run along a wall."""
    ends = np.full((2, 2), float(offset))
    ends[:, 1 - axis] = run
    return ends


def raised(xy: Float, z: float) -> Float:
    return np.column_stack([xy, np.full(len(xy), z)])


def quad(ends: Float, low: float, high: float) -> Float:
    """(2, 3, 3) the two triangles of an upright rectangle."""
    a, b = raised(ends, low)
    c, d = raised(ends, high)
    return np.array([[a, b, d], [a, d, c]])


def fan(corners: Float) -> Float:
    return np.array([[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]])


def frame(ends: Float, low: float, high: float) -> Float:
    """(4, 2, 3) the edges of an upright rectangle."""
    a, b = raised(ends, low)
    c, d = raised(ends, high)
    return np.array([[a, b], [b, d], [d, c], [c, a]])


def parts(area: Any) -> list[Any]:
    return [
        part for part in getattr(area, "geoms", [area]) if part.geom_type == "Polygon" and not part.is_empty
    ]


def outline(polygon: Any, z: float) -> Float:
    """(K, 2, 3) the edges of a shapely polygon, holes included."""
    rings = [ring for part in parts(polygon) for ring in (part.exterior, *part.interiors)]
    points = [raised(np.asarray(ring.coords), z) for ring in rings]
    return np.concatenate([np.stack([p[:-1], p[1:]], axis=1) for p in points])

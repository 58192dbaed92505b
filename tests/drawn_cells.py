"""Voxel columns drawn by hand: boxes of free space, and walls where planes run."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from floorplan_core.geometry.columns import height_mask
from floorplan_core.model import LayoutPlane, ManhattanFrame
from floorplan_core.model.evidence import Evidence

CELL = 0.1
TALL = height_mask(0.0, 2.4)
Box = tuple[float, float, float, float]


def drawn(free: list[Box], planes: list[LayoutPlane], viewpoints: bool = True) -> Evidence:
    """Voxel columns of 20 x 12 m: free in the boxes (x0, y0, x1, y1, metres), wall where planes run."""
    cells = np.zeros((120, 200), dtype=np.uint64)
    for x0, y0, x1, y1 in free:
        cells[round(y0 / CELL) : round(y1 / CELL), round(x0 / CELL) : round(x1 / CELL)] = TALL
    walls = np.zeros_like(cells)
    for plane in planes:
        grid = walls if plane.facing.axis == 0 else walls.T
        for start, end in plane.walls:
            grid[round(start / CELL) : round(end / CELL), int(plane.offset / CELL - 1e-9)] = TALL
    return seen_free(
        cells & ~walls,
        hits=np.repeat(np.repeat(walls, 2, axis=0), 2, axis=1),
        occupied=walls,
        inferred=not viewpoints,
        viewpoints=viewpoints,
    )


def seen_free(free: np.ndarray, **fields: Any) -> Evidence:
    """Columns (ny, nx) of which nothing but free space was seen; ``fields`` say what else there is."""
    none, (ny, nx) = np.zeros((0, 2)), free.shape
    frame = ManhattanFrame(np.eye(3), 0.0, 0.0, 1.0, 1.0, 0.0, None)
    bare = Evidence(
        frame, np.zeros((0, 3)), np.zeros(0, dtype=np.int32), none, none, 0.05, np.zeros(2), CELL / 2,
        np.zeros((2 * ny, 2 * nx), dtype=np.uint64), CELL, free, np.zeros_like(free), none, False, True,
    )  # fmt: skip
    return replace(bare, **fields)

"""Borders of the patches of a mask as rings of cells, and rings with fewer corners.

By OpenCV, which is imported late (docs/decisions/0024-opencv.md). Borders are followed after Suzuki and Abe
(1985): the cells of a patch along its outside and along each of its holes, in order; cells that touch at a
corner belong together. Rings are simplified after Douglas and Peucker (1973).
Cost: linear in the cells; border cells times the depth of the subdivision.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Bool = NDArray[np.bool_]
Float = NDArray[np.float64]
Int = NDArray[np.int32]


@dataclass(frozen=True)
class Border:
    """One closed walk along border cells."""

    cells: Int  # (N, 2) x, y; the last is followed by the first
    hole: bool  # runs around a hole of its patch


def find_borders(mask: Bool) -> list[Border]:
    """All borders of ``mask`` (ny, nx), in row order of their first cells; outsides before holes."""
    import cv2

    image = np.ascontiguousarray(mask, dtype=np.bool_).view(np.uint8)
    rings, tree = cv2.findContours(image, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
    if not rings:
        return []
    has_parent = tree[0, :, 3] >= 0
    found = [Border(ring[:, 0], bool(hole)) for ring, hole in zip(rings, has_parent, strict=True)]
    return sorted(found, key=lambda b: (*b.cells[0, ::-1].tolist(), b.hole))  # its own order is no promise


def simplified(ring: NDArray[np.generic], tolerance: float) -> Float:
    """(M, 2) corners of a ring of cells; none of its cells deviates more than about ``tolerance``."""
    import cv2

    corners = cv2.approxPolyDP(np.ascontiguousarray(ring, dtype=np.float32)[:, None], tolerance, True)
    return np.asarray(corners[:, 0], dtype=np.float64)


def smallest_box(points: Float) -> tuple[float, float]:
    """The shorter and the longer side of the smallest rectangle, in any direction, around (N, 2) points."""
    import cv2

    short, long = sorted(cv2.minAreaRect(points.astype(np.float32))[1])
    return float(short), float(long)

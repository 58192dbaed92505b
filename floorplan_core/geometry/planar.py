"""Planar scans: a laser that turns in one horizontal plane sees walls as lines.

Each return is lifted to a column of the height of a wall, its ray to as many rays: what stands in the plane
of the laser is taken to stand from floor to ceiling, since nothing else is known of it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

_FLAT = 0.02  # m, spread of heights within which a survey is planar
_ENOUGH = 50  # points
_BELOW, _ABOVE, _STEP = -0.9, 1.5, 0.1  # m, the column around the plane of the laser, taken to be 1 m high
_HEIGHTS = np.arange(_BELOW, _ABOVE, _STEP)
LEVELS = len(_HEIGHTS)  # points that each return becomes


def is_planar(points: NDArray[Any]) -> bool:
    """True where all (N, 3) points have the same height."""
    z = points[np.isfinite(points).all(axis=1), 2]
    return len(z) >= _ENOUGH and float(np.ptp(z)) < _FLAT


def lift(
    points: NDArray[Any], scan: NDArray[np.int32], origins: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]:
    """Points, the rows of their origins, and origins, repeated at every height of the column."""
    up = np.column_stack([np.zeros((LEVELS, 2)), _HEIGHTS])
    lifted = (points[None].astype(np.float64) + up[:, None]).reshape(-1, 3)
    raised = (origins[None] + up[:, None]).reshape(-1, 3)
    rows = (scan[None] + np.arange(LEVELS, dtype=np.int32)[:, None] * len(origins)).ravel()
    return lifted, np.where(np.tile(scan, LEVELS) < 0, -1, rows).astype(np.int32), raised

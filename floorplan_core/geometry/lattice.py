"""Clouds that are the centres of voxels: recognised by their lattice, and made dense again.

A map of 8 cm voxels holds one point for each voxel of surface; finer grids would see holes between them.
"""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

_SAMPLE = 20_000
_ENOUGH = 500  # points from which a lattice can be told from chance


def lattice_spacing(points: NDArray[Any]) -> float:
    """Spacing (metres) of the lattice on which all (N, 3) points lie; 0 where they lie on none."""
    finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) < _ENOUGH:
        return 0.0
    sample = finite[:: max(1, len(finite) // _SAMPLE)].astype(np.float64)
    spacings = [_axis_spacing(sample[:, k]) for k in range(3)]
    return spacings[0] if spacings[0] > 0 and np.ptp(spacings) < 1e-3 else 0.0


def _axis_spacing(values: NDArray[np.float64]) -> float:
    distinct = np.unique(np.round(values, 4))
    steps = np.diff(distinct)
    steps = steps[steps > 1e-3]
    if len(steps) < 5 or len(distinct) > len(values) / 4:
        return 0.0
    spacing = float(np.median(steps[steps < 1.5 * steps.min()]))
    multiples = steps / spacing
    return spacing if float(np.abs(multiples - np.round(multiples)).max()) < 0.1 else 0.0


def share_enclosed(points: NDArray[Any], spacing: float) -> float:
    """Share of the voxels around (N, 3) centres that have a neighbour on every side; a surface has few."""
    cells = np.round((points - points.min(axis=0)) / spacing).astype(np.int64) + 1
    size = cells.max(axis=0) + 2
    keys = np.unique(np.ravel_multi_index(tuple(cells.T), tuple(size)))
    steps = (1, int(size[2]), int(size[1] * size[2]))
    beside = [np.isin(keys + sign * step, keys) for step in steps for sign in (-1, 1)]
    return float(np.all(beside, axis=0).mean())


def subdivide(points: NDArray[Any], spacing: float, finest: float) -> NDArray[np.float64]:
    """(k N, 3) each voxel's centre replaced by the centres of its parts, none larger than ``finest``.

    Many parts lie on borders of the finer voxels, exactly; the centres are rounded to float32, so that each
    layer falls to one side or the other (decision 21: any one side for all of them is worse).
    """
    parts = max(1, int(np.ceil(spacing / finest - 1e-6)))
    offset = ((np.arange(parts) + 0.5) / parts - 0.5) * spacing
    shifts = np.array(list(product(offset, offset, offset)))
    centres: NDArray[np.float64] = points[:, None, :].astype(np.float32).astype(np.float64) + shifts[None]
    return centres.reshape(-1, 3)

"""Normals of surfaces from the moments of the surfels in coarse cells, in one pass.

Each surfel weighs the same, so a cell's weight is its observed area whatever the density of the points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.voxel_keys import EMPTY, pack, spread

Float = NDArray[np.float64]

_MIN_SURFELS = 8  # fewer do not fix a plane in a cell
_WORTH = 2_000  # cells of which a second thread takes half


@dataclass(frozen=True)
class CellNormals:
    """The planar cells: one surface patch each."""

    centre: Float  # (C, 3) metres, local frame
    normal: Float  # (C, 3) unit vectors; the sign is arbitrary
    weight: Float  # (C,) surfels
    cell_of: NDArray[np.int32]  # (N,) planar cell of each surfel, -1 where none
    share: float  # of the surfels in cells with enough of them, that in the planar ones


def fit_cell_normals(centroid: Float, cell: float, planarity: float, most: int = 20_000) -> CellNormals:
    """A plane in each cell of side ``cell`` (metres); kept when thinner than ``planarity`` times its width.

    With more than ``most`` expected cells only every k-th (by a hash of its place) is used.
    """
    thinning = max(1, int(len(centroid) * 0.08 / most))
    cell_of, moments = _accumulate(centroid, cell, thinning)
    many = moments[:, 0] >= _MIN_SURFELS
    cell_of, moments = _kept(cell_of, many), moments[many]
    count = moments[:, 0]
    mean = moments[:, 1:4] / count[:, None]
    cov = np.empty((len(moments), 3, 3))
    for k, (i, j) in enumerate(((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))):
        cov[:, i, j] = cov[:, j, i] = moments[:, 4 + k] / count - mean[:, i] * mean[:, j]
    values, vectors = np.empty((len(cov), 3)), np.empty((len(cov), 3, 3))

    def part(start: int, stop: int) -> None:
        values[start:stop], vectors[start:stop] = np.linalg.eigh(cov[start:stop])

    in_halves(part, len(cov), worth=_WORTH)
    thin = np.sqrt(np.maximum(values[:, 0], 0)) < planarity * 2 * np.sqrt(np.maximum(values[:, 1], 1e-12))
    share = float(count[thin].sum() / max(count.sum(), 1.0))
    return CellNormals(mean[thin], vectors[thin, :, 0], count[thin], _kept(cell_of, thin), share)


def _kept(cell_of: NDArray[np.int32], chosen: NDArray[np.bool_]) -> NDArray[np.int32]:
    """(N,) cells renumbered without those that are not ``chosen``; -1 for what lay in these."""
    number = np.append(np.where(chosen, np.cumsum(chosen) - 1, -1), -1).astype(np.int32)
    return number[cell_of]  # the last is that of no cell


@njit(cache=True, nogil=True)
def _accumulate(centroid, cell, thinning):  # type: ignore[no-untyped-def]
    n = len(centroid)
    capacity = 1 << 12
    while capacity < n // 2:
        capacity <<= 1
    mask = capacity - 1
    keys, ids = np.full(capacity, EMPTY, dtype=np.int64), np.zeros(capacity, dtype=np.int32)
    moments = np.zeros((capacity // 2 + 1, 10))
    cell_of = np.full(n, -1, dtype=np.int32)
    used = 0
    for i in range(n):
        x, y, z = centroid[i, 0], centroid[i, 1], centroid[i, 2]
        key = pack(int(np.floor(x / cell)), int(np.floor(y / cell)), int(np.floor(z / cell)))
        h = spread(key)
        if (h >> 8) % thinning != 0:
            continue
        slot = h & mask
        while keys[slot] != key and keys[slot] != EMPTY:
            slot = (slot + 1) & mask
        if keys[slot] == EMPTY:
            if used >= len(moments):
                continue
            keys[slot], ids[slot] = key, used
            used += 1
        c = ids[slot]
        cell_of[i] = c
        m = moments[c]
        m[0] += 1.0
        m[1] += x
        m[2] += y
        m[3] += z
        m[4] += x * x
        m[5] += x * y
        m[6] += x * z
        m[7] += y * y
        m[8] += y * z
        m[9] += z * z
    return cell_of, moments[:used]

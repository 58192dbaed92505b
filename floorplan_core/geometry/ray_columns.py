"""The map of rays sampled in columns of another frame: bit k of a word stands for level k of its column.

The columns are nearly those of the map, turned about the vertical: up to 16 levels lie in one row of one
block, whose counts are read one after the other. Only where a tilted column changes over into the next row
is it followed level by level.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from floorplan_core.geometry.voxel_keys import EMPTY, find_slot, pack


@njit(cache=True, nogil=True)
def sample_columns(tables, grid, least, few, many, first, start, stop):  # type: ignore[no-untyped-def]
    """Fill rows ``start`` to ``stop`` of the words ``few`` and ``many``, which begin with row ``first``
    (:meth:`MissMap.column_bits`)."""
    keys, ids, pool, size = tables
    rotation, origin, cell, z0, levels = grid
    r, one = rotation * (1.0 / size), np.uint64(1)
    for iy in range(start, stop):
        gy = origin[1] + (iy + 0.5) * cell
        for ix in range(few.shape[1]):
            gx = origin[0] + (ix + 0.5) * cell
            fx, fy, fz = r[0, 0] * gx + r[1, 0] * gy, r[0, 1] * gx + r[1, 1] * gy, r[0, 2] * gx + r[1, 2] * gy
            bits, more, k = np.uint64(0), np.uint64(0), 0
            while k < levels:
                x, y, z = _voxel(r, fx, fy, fz, z0 + (k + 0.5) * cell)
                end = min(levels, k + 16 - (z & 15))
                while end > k + 1 and _voxel(r, fx, fy, fz, z0 + (end - 0.5) * cell) != (
                    x,
                    y,
                    z + end - 1 - k,
                ):
                    end = k + (end - k) // 2
                slot = find_slot(pack(x >> 4, y >> 4, z >> 4), keys)
                if keys[slot] != EMPTY:
                    at = ((x & 15) << 8) | ((y & 15) << 4) | (z & 15)
                    for j in range(end - k):
                        rays, bit = pool[ids[slot], at + j], one << np.uint64(k + j)
                        bits |= bit if rays >= least[0] else np.uint64(0)
                        more |= bit if rays >= least[1] else np.uint64(0)
                k = end
            few[iy - first, ix], many[iy - first, ix] = bits, more


@njit(cache=True, inline="always")
def _voxel(r, fx, fy, fz, gz):  # type: ignore[no-untyped-def]
    """The voxel of the map at height ``gz`` of the column whose foot is at (fx, fy, fz)."""
    return (
        int(np.floor(fx + r[2, 0] * gz)),
        int(np.floor(fy + r[2, 1] * gz)),
        int(np.floor(fz + r[2, 2] * gz)),
    )

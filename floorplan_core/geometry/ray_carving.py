"""Free space by ray casting: counts the rays that pass through each voxel of a sparse map.

Voxels are held in blocks of 16 x 16 x 16, found through a hash; a ray looks a block up only when it enters
one. It is sampled once a voxel along its longest axis (a 3-D Bresenham line): no branch depends on the data,
which is three times faster than visiting every voxel that it clips, and walls are grazed less. Counting is
order-free.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.voxel_keys import BIAS, EMPTY, pack, spread

Float = NDArray[np.float64]

BLOCK = 16
_VOLUME = BLOCK**3
_MOST = np.uint16(65535)
SHIFT = 24  # rays are followed in fixed point: 24 bits of fraction of a voxel
BLOCK_SHIFT = SHIFT + 4
ONE = float(1 << SHIFT)


class MissMap:
    """Rays through each voxel, saturating at 65535."""

    def __init__(self, size: float) -> None:
        self.size = size
        self._keys = np.full(1 << 10, EMPTY, dtype=np.int64)
        self._ids = np.zeros(1 << 10, dtype=np.int32)
        self._pool = np.zeros((1 << 8, _VOLUME), dtype=np.uint16)
        self._used = 0

    @property
    def blocks(self) -> int:
        """Number of blocks that any ray has entered."""
        return self._used

    def carve(
        self, points: NDArray[Any], scan: NDArray[np.int32], origins: Float, limits: tuple[float, float]
    ) -> None:
        """Cast a ray from each point's sensor origin to the point; the point's own voxel is not counted."""
        start = 0
        while start < len(points):
            start, self._used = _carve(
                points,
                scan,
                origins,
                self.size,
                limits[0],
                limits[1],
                self._keys,
                self._ids,
                self._pool,
                self._used,
                start,
            )
            if start < len(points):
                self._grow()

    def _grow(self) -> None:
        pool = np.zeros((2 * len(self._pool), _VOLUME), dtype=np.uint16)
        pool[: self._used] = self._pool[: self._used]
        keys = np.full(4 * len(pool), EMPTY, dtype=np.int64)
        ids = np.zeros(len(keys), dtype=np.int32)
        _rehash(self._keys, self._ids, keys, ids)
        self._keys, self._ids, self._pool = keys, ids, pool

    def mark(self, points: NDArray[Any], rays: int) -> None:
        """Count ``rays`` rays through the voxels of (N, 3) points that are known to be free."""
        start = 0
        while start < len(points):
            start, self._used = _mark(
                points, rays, self.size, self._keys, self._ids, self._pool, self._used, start
            )
            if start < len(points):
                self._grow()

    def take(self, other: MissMap) -> None:
        """Add the counts of another map of the same voxels to this one; the other is empty then."""
        while self._used + other._used > len(self._pool):
            self._grow()
        self._used = _merge(
            self._keys, self._ids, self._pool, self._used, other._keys, other._ids, other._pool
        )
        other._pool[: other._used] = 0
        other._keys[:] = EMPTY
        other._used = 0

    def column_bits(
        self,
        rotation: Float,
        origin: Float,
        cell: float,
        shape: tuple[int, int],
        z0: float,
        levels: int,
        least: tuple[int, int],
    ) -> tuple[NDArray[np.uint64], NDArray[np.uint64]]:
        """Two (ny, nx) words: bit ``k`` set where at least ``least[0]`` (``least[1]``) rays passed level k.

        The map is sampled at the cell centres of a grid in another frame: ``rotation`` takes local to grid
        coordinates; column [iy, ix] starts at ``origin + cell * [ix, iy]``, level k at ``z0 + k * cell``.
        """
        few, many = np.zeros(shape, dtype=np.uint64), np.zeros(shape, dtype=np.uint64)
        r = np.ascontiguousarray(rotation)
        tables = (self._keys, self._ids, self._pool, self.size)

        def rows(start: int, stop: int) -> None:
            _column_bits(*tables, r, origin, cell, z0, levels, least[0], least[1], few, many, start, stop)

        in_halves(rows, shape[0], worth=50)
        return few, many


@njit(cache=True, inline="always")
def _find(key, keys):  # type: ignore[no-untyped-def]
    mask = len(keys) - 1
    slot = spread(key) & mask
    while keys[slot] != key and keys[slot] != EMPTY:
        slot = (slot + 1) & mask
    return slot


@njit(cache=True, nogil=True)
def _carve(points, scan, origins, size, nearest, farthest, keys, ids, pool, used, start):  # type: ignore[no-untyped-def]
    near2, far2, inverse = nearest * nearest, farthest * farthest, 1.0 / size
    edge = (BIAS - BLOCK) * 1.0
    counts = pool.reshape(-1)
    for i in range(start, len(points)):
        if scan[i] < 0:
            continue
        ox, oy, oz = (
            origins[scan[i], 0] * inverse,
            origins[scan[i], 1] * inverse,
            origins[scan[i], 2] * inverse,
        )
        px, py, pz = points[i, 0] * inverse, points[i, 1] * inverse, points[i, 2] * inverse
        dx, dy, dz = px - ox, py - oy, pz - oz
        r2 = (dx * dx + dy * dy + dz * dz) * size * size
        if not (r2 >= near2 and r2 <= far2):  # also leaves out what is not a number
            continue
        if max(abs(px), abs(ox)) > edge or max(abs(py), abs(oy)) > edge or max(abs(pz), abs(oz)) > edge:
            continue
        ex, ey, ez = int(np.floor(px)), int(np.floor(py)), int(np.floor(pz))
        x, y, z = int(np.floor(ox * ONE)), int(np.floor(oy * ONE)), int(np.floor(oz * ONE))
        entered = (
            abs((ex >> 4) - (x >> BLOCK_SHIFT))
            + abs((ey >> 4) - (y >> BLOCK_SHIFT))
            + abs((ez >> 4) - (z >> BLOCK_SHIFT))
            + 4
        )
        if used + entered > len(pool):  # the caller makes room and resumes at this ray
            return i, used
        longest = max(abs(dx), abs(dy), abs(dz), 1e-9)
        sx, sy, sz = int(dx / longest * ONE), int(dy / longest * ONE), int(dz / longest * ONE)
        inx, iny, inz, block = ~x, y, z, 0  # a place in the block that the ray is in; in none at first
        for _ in range(int(longest) + 1):
            if ((x ^ inx) | (y ^ iny) | (z ^ inz)) >> BLOCK_SHIFT != 0:
                inx, iny, inz = x, y, z
                key = pack(x >> BLOCK_SHIFT, y >> BLOCK_SHIFT, z >> BLOCK_SHIFT)
                slot = _find(key, keys)
                if keys[slot] == EMPTY:
                    keys[slot], ids[slot] = key, used
                    used += 1
                block = ids[slot] * _VOLUME
            vx, vy, vz = x >> SHIFT, y >> SHIFT, z >> SHIFT
            if ((vx ^ ex) | (vy ^ ey) | (vz ^ ez)) == 0:
                break
            # an unsigned index: numba need not ask whether it counts from the end
            at = np.uint64(block | ((vx & 15) << 8) | ((vy & 15) << 4) | (vz & 15))
            if counts[at] < _MOST:
                counts[at] += np.uint16(1)
            x += sx
            y += sy
            z += sz
    return len(points), used


@njit(cache=True, nogil=True)
def _mark(points, rays, size, keys, ids, pool, used, start):  # type: ignore[no-untyped-def]
    edge = (BIAS - BLOCK) * size
    for i in range(start, len(points)):
        px, py, pz = points[i, 0], points[i, 1], points[i, 2]
        if not (abs(px) < edge and abs(py) < edge and abs(pz) < edge):  # also leaves out what is not a number
            continue
        x, y, z = int(np.floor(px / size)), int(np.floor(py / size)), int(np.floor(pz / size))
        key = pack(x >> 4, y >> 4, z >> 4)
        slot = _find(key, keys)
        if keys[slot] == EMPTY:
            if used >= len(pool):  # the caller makes room and resumes here
                return i, used
            keys[slot], ids[slot] = key, used
            used += 1
        at = ((x & 15) << 8) | ((y & 15) << 4) | (z & 15)
        pool[ids[slot], at] = min(int(_MOST), int(pool[ids[slot], at]) + rays)
    return len(points), used


@njit(cache=True, nogil=True)
def _merge(keys, ids, pool, used, other_keys, other_ids, other_pool):  # type: ignore[no-untyped-def]
    for i in range(len(other_keys)):
        if other_keys[i] == EMPTY:
            continue
        slot = _find(other_keys[i], keys)
        if keys[slot] == EMPTY:
            keys[slot], ids[slot] = other_keys[i], used
            used += 1
        to, there = ids[slot], other_ids[i]
        for k in range(_VOLUME):
            pool[to, k] = min(np.uint32(_MOST), np.uint32(pool[to, k]) + np.uint32(other_pool[there, k]))
    return used


@njit(cache=True, nogil=True)
def _rehash(keys, ids, new_keys, new_ids):  # type: ignore[no-untyped-def]
    for i in range(len(keys)):
        if keys[i] != EMPTY:
            slot = _find(keys[i], new_keys)
            new_keys[slot], new_ids[slot] = keys[i], ids[i]


@njit(cache=True, nogil=True)
def _column_bits(  # type: ignore[no-untyped-def]
    keys, ids, pool, size, rotation, origin, cell, z0, levels, few, many, out, strong, start, stop
):
    inverse = 1.0 / size
    r = rotation * inverse
    for iy in range(start, stop):
        gy = origin[1] + (iy + 0.5) * cell
        for ix in range(out.shape[1]):
            gx = origin[0] + (ix + 0.5) * cell
            fx, fy, fz = r[0, 0] * gx + r[1, 0] * gy, r[0, 1] * gx + r[1, 1] * gy, r[0, 2] * gx + r[1, 2] * gy
            bits, more = np.uint64(0), np.uint64(0)
            bx, by, bz, block = 1 << 40, 0, 0, -1
            for k in range(levels):
                gz = z0 + (k + 0.5) * cell
                x = int(np.floor(fx + r[2, 0] * gz))
                y = int(np.floor(fy + r[2, 1] * gz))
                z = int(np.floor(fz + r[2, 2] * gz))
                if x >> 4 != bx or y >> 4 != by or z >> 4 != bz:
                    bx, by, bz = x >> 4, y >> 4, z >> 4
                    slot = _find(pack(bx, by, bz), keys)
                    block = ids[slot] if keys[slot] != EMPTY else -1
                if block >= 0:
                    rays = pool[block, ((x & 15) << 8) | ((y & 15) << 4) | (z & 15)]
                    if rays >= few:
                        bits |= np.uint64(1) << np.uint64(k)
                    if rays >= many:
                        more |= np.uint64(1) << np.uint64(k)
            out[iy, ix], strong[iy, ix] = bits, more

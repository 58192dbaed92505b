"""Free space by ray casting: counts the rays that pass through each voxel of a sparse map.

Voxels are held in blocks of 16 x 16 x 16, found through a hash. A ray is sampled once a voxel along its
longest axis (a 3-D Bresenham line): no branch depends on the data, and walls are grazed less than by
visiting every voxel that it clips (:mod:`floorplan_core.geometry.ray_steps`). A :class:`_Window` over what
was seen so far, a plain array, gives the block of each place. Counting is order-free.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.ray_columns import sample_columns
from floorplan_core.geometry.ray_steps import BLOCK, MOST, VOLUME, follow_rays, open_block, reach_of
from floorplan_core.geometry.scratch import disk_array, let_go
from floorplan_core.geometry.voxel_keys import BIAS, EMPTY, find_slot

Float = NDArray[np.float64]

_WINDOW_BITS = 20  # a cell and a voxel fit 32 bits (800 x 800 x 6 m); beyond it the hash is asked


@dataclass(frozen=True)
class _Window:
    """A box of blocks: the number of each in the pool, -1 where the hash has to be asked."""

    ids: NDArray[np.int32]  # (2 ** (bx + by + bz),)
    place: NDArray[np.int64]  # (6,) block of the lower corner, and bits bx, by, bz of its sides

    @staticmethod
    def over(low: NDArray[np.int64], high: NDArray[np.int64]) -> _Window:
        """The window over the blocks ``low`` to ``high``, with room around them."""
        bits = np.array([int(n).bit_length() for n in high - low + 3], dtype=np.int64)
        corner = (low + high + 1) // 2 - (1 << bits) // 2
        return _Window(np.full(1 << int(bits.sum()), -1, dtype=np.int32), np.concatenate([corner, bits]))


class MissMap:
    """Rays through each voxel; counts end at ``MOST``.

    :param size: metres, side of a voxel.
    :param room: bytes that the counts may take in memory; more are on disk. A block is a page there, and a
        scan looks at few of them. None: all there is.
    """

    def __init__(self, size: float, room: float | None = None) -> None:
        self.size, self._room = size, room
        self._keys = np.full(1 << 10, EMPTY, dtype=np.int64)
        self._ids = np.zeros(1 << 10, dtype=np.int32)
        self._pool = np.zeros((1 << 8, VOLUME), dtype=np.uint8)
        self._used = 0
        self._window = _Window(np.full(1, -1, dtype=np.int32), np.zeros(6, dtype=np.int64))
        self._reach = np.zeros((2, 0), dtype=np.int64)  # blocks that the window is over; none yet
        self._beyond = False  # True: the window is as large as it may be

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
            start, self._used, full = follow_rays(
                points,
                scan,
                origins,
                (self.size, limits[0], limits[1]),
                (self._keys, self._ids),
                self._pool,
                (self._window.ids, self._window.place, self._beyond),
                self._used,
                start,
            )
            if full:
                self._grow()
            elif start < len(points):
                self._widen(points[start:], scan[start:], origins, limits)

    def _widen(
        self, points: NDArray[Any], scan: NDArray[np.int32], origins: Float, limits: tuple[float, float]
    ) -> None:
        """Lay the window over these rays, too; where it would become too large, remember that."""
        low, high = reach_of(points, scan, origins, self.size, *limits)
        if self._reach.size:
            low, high = np.minimum(low, self._reach[0]), np.maximum(high, self._reach[1])
        bits = sum(int(n).bit_length() for n in high - low + 3)
        self._beyond = bits > _WINDOW_BITS
        if not self._beyond:
            self._window, self._reach = _Window.over(low, high), np.stack([low, high])

    def _grow(self) -> None:
        shape = 2 * len(self._pool), VOLUME
        small = self._room is None or shape[0] * VOLUME <= self._room
        pool = np.zeros(shape, dtype=np.uint8) if small else disk_array(shape, np.uint8)
        pool[: self._used] = self._pool[: self._used]
        keys = np.full(4 * len(pool), EMPTY, dtype=np.int64)
        ids = np.zeros(len(keys), dtype=np.int32)
        _rehash(self._keys, self._ids, keys, ids)
        self._keys, self._ids, self._pool = keys, ids, pool

    def pack(self) -> None:
        """Leave what is on disk to the disk: it counts no more as memory of this process."""
        let_go(self._pool)

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
        other._window.ids[:] = -1
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
        first: int = 0,
    ) -> tuple[NDArray[np.uint64], NDArray[np.uint64]]:
        """Two (ny, nx) words: bit ``k`` set where at least ``least[0]`` (``least[1]``) rays passed level k.

        The map is sampled at the cell centres of a grid in another frame: ``rotation`` takes local to grid
        coordinates; column [iy, ix] starts at ``origin + cell * [ix, iy]``, level k at ``z0 + k * cell``.
        The words begin with the row ``first`` of that grid.
        """
        few, many = np.empty(shape, dtype=np.uint64), np.empty(shape, dtype=np.uint64)
        tables = (self._keys, self._ids, self._pool, self.size)
        grid = (np.ascontiguousarray(rotation), origin, cell, z0, levels)

        def part(start: int, stop: int) -> None:
            sample_columns(tables, grid, least, few, many, first, first + start, first + stop)

        in_halves(part, shape[0], worth=50)
        return few, many


@njit(cache=True, nogil=True)
def _mark(points, rays, size, keys, ids, pool, used, start):  # type: ignore[no-untyped-def]
    edge = (BIAS - BLOCK) * size
    for i in range(start, len(points)):
        px, py, pz = points[i, 0], points[i, 1], points[i, 2]
        if not (abs(px) < edge and abs(py) < edge and abs(pz) < edge):  # also leaves out what is not a number
            continue
        if used >= len(pool):  # the caller makes room and resumes here
            return i, used
        x, y, z = int(np.floor(px / size)), int(np.floor(py / size)), int(np.floor(pz / size))
        block, used = open_block(x >> 4, y >> 4, z >> 4, keys, ids, used)
        at = ((x & 15) << 8) | ((y & 15) << 4) | (z & 15)
        pool[block, at] = min(MOST, int(pool[block, at]) + rays)
    return len(points), used


@njit(cache=True, nogil=True)
def _merge(keys, ids, pool, used, other_keys, other_ids, other_pool):  # type: ignore[no-untyped-def]
    for i in range(len(other_keys)):
        if other_keys[i] == EMPTY:
            continue
        slot = find_slot(other_keys[i], keys)
        if keys[slot] == EMPTY:
            keys[slot], ids[slot] = other_keys[i], used
            used += 1
        to, there = ids[slot], other_ids[i]
        for k in range(VOLUME):
            pool[to, k] = min(np.uint32(MOST), np.uint32(pool[to, k]) + np.uint32(other_pool[there, k]))
    return used


@njit(cache=True, nogil=True)
def _rehash(keys, ids, new_keys, new_ids):  # type: ignore[no-untyped-def]
    for i in range(len(keys)):
        if keys[i] != EMPTY:
            slot = find_slot(keys[i], new_keys)
            new_keys[slot], new_ids[slot] = keys[i], ids[i]

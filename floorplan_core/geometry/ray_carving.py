"""Free space by ray casting: counts the rays that pass through each voxel of a sparse map.

Voxels are held in blocks of 16 x 16 x 16, found through a hash. A ray is sampled once a voxel along its
longest axis (a 3-D Bresenham line): no branch depends on the data, and walls are grazed less than by
visiting every voxel that it clips. The places of many rays are computed first, eight in one instruction, and
queued; a :class:`_Window` over what was seen so far, a plain array, then gives the block of each. Counting
is order-free.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.ray_columns import sample_columns
from floorplan_core.geometry.voxel_keys import BIAS, EMPTY, find_slot, pack

Float = NDArray[np.float64]

BLOCK = 16
MOST = 255  # rays at which a voxel's count ends
_VOLUME = BLOCK**3
_MOST = np.uint8(MOST)
SHIFT = 24  # rays are followed in fixed point: 24 bits of fraction of a voxel
BLOCK_SHIFT = SHIFT + 4
ONE = float(1 << SHIFT)
_TOGETHER = 32  # places computed in one go: what is more than a ray has is overwritten by the next
_PART = 96  # steps of a ray that are queued at a time: with 7 blocks each way they fit 32 bits
_QUEUE = 4096  # places that wait to be counted: 16 kB, within the first-level cache
_MIDDLE = 8  # block of 16 that a part begins in, in the 32-bit words of its places
_VOXEL_BITS = 12  # of a place, below those of its cell of the window
_WINDOW_BITS = 20  # a cell and a voxel fit 32 bits (800 x 800 x 6 m); beyond it the hash is asked
_LOW = (1 << BLOCK_SHIFT) - 1
_W = np.uint32
_U = np.uint64


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
    """Rays through each voxel; counts end at ``MOST``."""

    def __init__(self, size: float) -> None:
        self.size = size
        self._keys = np.full(1 << 10, EMPTY, dtype=np.int64)
        self._ids = np.zeros(1 << 10, dtype=np.int32)
        self._pool = np.zeros((1 << 8, _VOLUME), dtype=np.uint8)
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
            start, self._used, full = _carve(
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
        low, high = _reach(points, scan, origins, self.size, *limits)
        if self._reach.size:
            low, high = np.minimum(low, self._reach[0]), np.maximum(high, self._reach[1])
        bits = sum(int(n).bit_length() for n in high - low + 3)
        self._beyond = bits > _WINDOW_BITS
        if not self._beyond:
            self._window, self._reach = _Window.over(low, high), np.stack([low, high])

    def _grow(self) -> None:
        pool = np.zeros((2 * len(self._pool), _VOLUME), dtype=np.uint8)
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
    ) -> tuple[NDArray[np.uint64], NDArray[np.uint64]]:
        """Two (ny, nx) words: bit ``k`` set where at least ``least[0]`` (``least[1]``) rays passed level k.

        The map is sampled at the cell centres of a grid in another frame: ``rotation`` takes local to grid
        coordinates; column [iy, ix] starts at ``origin + cell * [ix, iy]``, level k at ``z0 + k * cell``.
        """
        few, many = np.zeros(shape, dtype=np.uint64), np.zeros(shape, dtype=np.uint64)
        tables = (self._keys, self._ids, self._pool, self.size)
        grid = (np.ascontiguousarray(rotation), origin, cell, z0, levels)

        def rows(start: int, stop: int) -> None:
            sample_columns(tables, grid, least, few, many, start, stop)

        in_halves(rows, shape[0], worth=50)
        return few, many


@njit(cache=True, inline="always")
def _open(bx, by, bz, keys, ids, used):  # type: ignore[no-untyped-def]
    """Number of a block in the pool, a new one where it is the first time; and how many blocks there are."""
    key = pack(bx, by, bz)
    slot = find_slot(key, keys)
    if keys[slot] == EMPTY:
        keys[slot], ids[slot] = key, used
        used += 1
    return ids[slot], used


@njit(cache=True, inline="always")
def _ends(px, py, pz, ox, oy, oz, size, nearest, farthest):  # type: ignore[no-untyped-def]
    """True where a ray from o to p (voxels) is no longer and no shorter than may be, and within the keys."""
    dx, dy, dz = px - ox, py - oy, pz - oz
    r2 = (dx * dx + dy * dy + dz * dz) * size * size
    edge = (BIAS - BLOCK) * 1.0
    return (
        r2 >= nearest * nearest  # also leaves out what is not a number
        and r2 <= farthest * farthest
        and max(abs(px), abs(ox)) <= edge
        and max(abs(py), abs(oy)) <= edge
        and max(abs(pz), abs(oz)) <= edge
    )


@njit(cache=True, nogil=True)
def _reach(points, scan, origins, size, nearest, farthest):  # type: ignore[no-untyped-def]
    """Lowest and highest block of all rays; equal where there is none."""
    low, high = np.full(3, BIAS, dtype=np.int64), np.full(3, -BIAS, dtype=np.int64)
    inverse = 1.0 / size
    for i in range(len(points)):
        if scan[i] < 0:
            continue
        px, py, pz = points[i, 0] * inverse, points[i, 1] * inverse, points[i, 2] * inverse
        o = origins[scan[i]]
        if _ends(px, py, pz, o[0] * inverse, o[1] * inverse, o[2] * inverse, size, nearest, farthest):
            for k in range(3):
                a, b = int(np.floor(points[i, k] * inverse)) >> 4, int(np.floor(o[k] * inverse)) >> 4
                low[k], high[k] = min(low[k], a, b), max(high[k], a, b)
    if low[0] > high[0]:
        low[:], high[:] = 0, 0
    return low, high


@njit(cache=True, nogil=True)
def _carve(points, scan, origins, ranges, blocks, pool, window, used, start):  # type: ignore[no-untyped-def]
    """Follow rays from ``start`` on; ends before the first that the pool (True) or the window cannot take."""
    size, nearest, farthest = ranges
    keys, ids = blocks
    _, place, beyond = window
    inverse, counts = 1.0 / size, pool.reshape(-1)
    queue, waiting, entering = np.empty(_QUEUE, dtype=np.uint32), 0, 0
    cx, cy, cz = place[0], place[1], place[2]
    row, column = place[4] + place[5], place[5]
    wide, deep, high = (1 << place[3]) - 1, (1 << place[4]) - 1, (1 << place[5]) - 1
    for i in range(start, len(points)):
        if scan[i] < 0:
            continue
        ox, oy, oz = (
            origins[scan[i], 0] * inverse,
            origins[scan[i], 1] * inverse,
            origins[scan[i], 2] * inverse,
        )
        px, py, pz = points[i, 0] * inverse, points[i, 1] * inverse, points[i, 2] * inverse
        if not _ends(px, py, pz, ox, oy, oz, size, nearest, farthest):
            continue
        ex, ey, ez = int(np.floor(px)), int(np.floor(py)), int(np.floor(pz))
        x, y, z = int(np.floor(ox * ONE)), int(np.floor(oy * ONE)), int(np.floor(oz * ONE))
        # Blocks of both ends in the window. Rounding may take a ray one block further: the outermost are out.
        ax, ay, az = (x >> BLOCK_SHIFT) - cx, (y >> BLOCK_SHIFT) - cy, (z >> BLOCK_SHIFT) - cz
        bx, by, bz = (ex >> 4) - cx, (ey >> 4) - cy, (ez >> 4) - cz
        entered = abs(ax - bx) + abs(ay - by) + abs(az - bz) + 4
        inside = (
            (min(ax, bx) > 0 and max(ax, bx) < wide)
            and (min(ay, by) > 0 and max(ay, by) < deep)
            and (min(az, bz) > 0 and max(az, bz) < high)
        )
        entering += entered
        if waiting > _QUEUE - _PART - _TOGETHER or used + entering > len(pool) or not (inside or beyond):
            used = _count(queue, waiting, window, keys, ids, counts, used)
            waiting, entering = 0, entered
            if used + entered > len(pool) or not (inside or beyond):
                return i, used, used + entered > len(pool)
        dx, dy, dz = px - ox, py - oy, pz - oz
        longest = max(abs(dx), abs(dy), abs(dz), 1e-9)
        sx, sy, sz = int(dx / longest * ONE), int(dy / longest * ONE), int(dz / longest * ONE)
        n = int(longest)  # steps to the voxel of the point, which only the last can reach: or there are n + 1
        n += (((x + n * sx) >> SHIFT) ^ ex | ((y + n * sy) >> SHIFT) ^ ey | ((z + n * sz) >> SHIFT) ^ ez) != 0
        if not inside:
            used = _follow_far(x, y, z, sx, sy, sz, n, keys, ids, counts, used)
            continue
        for first in range(0, n, _PART):
            if waiting > _QUEUE - _PART - _TOGETHER:
                used = _count(queue, waiting, window, keys, ids, counts, used)
                waiting = 0
            part = min(n - first, _PART)
            u, v, w = x + first * sx, y + first * sy, z + first * sz
            corner = ((u >> BLOCK_SHIFT) - cx - _MIDDLE) << row
            corner += ((v >> BLOCK_SHIFT) - cy - _MIDDLE) << column
            corner += (w >> BLOCK_SHIFT) - cz - _MIDDLE
            _locate(
                _W((u & _LOW) + (_MIDDLE << BLOCK_SHIFT)),
                _W((v & _LOW) + (_MIDDLE << BLOCK_SHIFT)),
                _W((w & _LOW) + (_MIDDLE << BLOCK_SHIFT)),
                _W(sx),
                _W(sy),
                _W(sz),
                part,
                _W(corner << _VOXEL_BITS),
                _W(1 << (row + _VOXEL_BITS)),
                _W(1 << (column + _VOXEL_BITS)),
                queue,
                _U(waiting),
            )
            waiting += part
    used = _count(queue, waiting, window, keys, ids, counts, used)
    return len(points), used, False


@njit(cache=True, nogil=True)
def _locate(x, y, z, sx, sy, sz, n, corner, row, column, queue, at):  # type: ignore[no-untyped-def]
    """Queue the place of each of ``n`` steps: cell of the window, and below it the voxel in its block.

    All integers are unsigned words of 32 bits, the sums modulo 2 ** 32. The inner loop has a fixed length,
    no branch and products for shifts: the compiler makes a few wide instructions of it.
    """
    for first in range(0, n, _TOGETHER):
        to = at + _U(first)
        for k in range(_TOGETHER):
            step = _W(first + k)
            u, v, w = _W(x + _W(step * sx)), _W(y + _W(step * sy)), _W(z + _W(step * sz))
            cell = _W(
                _W(_W(u >> _W(BLOCK_SHIFT)) * row)
                + _W(_W(v >> _W(BLOCK_SHIFT)) * column)
                + _W(_W(w >> _W(BLOCK_SHIFT)) << _W(_VOXEL_BITS))
            )
            voxel = _W(
                _W(_W(u >> _W(SHIFT - 8)) & _W(0xF00))
                | _W(_W(v >> _W(SHIFT - 4)) & _W(0xF0))
                | _W(_W(w >> _W(SHIFT)) & _W(0xF))
            )
            queue[to + _U(k)] = _W(_W(cell + corner) + voxel)


@njit(cache=True, nogil=True)
def _count(queue, waiting, window, keys, ids, counts, used):  # type: ignore[no-untyped-def]
    """Count a ray at each place that waits; returns how many blocks there are."""
    near, place, _ = window
    row, column = place[4] + place[5], place[5]
    deep, high = (1 << place[4]) - 1, (1 << place[5]) - 1
    for k in range(waiting):
        where = queue[_U(k)]
        cell = where >> _W(_VOXEL_BITS)
        block = near[cell]
        if block < 0:
            c = int(cell)
            bx, by, bz = place[0] + (c >> row), place[1] + ((c >> column) & deep), place[2] + (c & high)
            block, used = _open(bx, by, bz, keys, ids, used)
            near[cell] = block
        at = (_U(block) << _U(_VOXEL_BITS)) | _U(where & _W(_VOLUME - 1))
        rays = counts[at]
        counts[at] = rays + np.uint8(rays < _MOST)  # a branch would be guessed wrong too often
    return used


@njit(cache=True, nogil=True)
def _follow_far(x, y, z, sx, sy, sz, n, keys, ids, counts, used):  # type: ignore[no-untyped-def]
    """Count one ray that leaves the window: the hash is asked for each block that it enters."""
    inx, iny, inz, block = ~x, y, z, 0  # a place in the block that the ray is in; in none at first
    for _ in range(n):
        if ((x ^ inx) | (y ^ iny) | (z ^ inz)) >> BLOCK_SHIFT != 0:
            inx, iny, inz = x, y, z
            block, used = _open(x >> BLOCK_SHIFT, y >> BLOCK_SHIFT, z >> BLOCK_SHIFT, keys, ids, used)
        at = block * _VOLUME + ((((x >> SHIFT) & 15) << 8) | (((y >> SHIFT) & 15) << 4) | ((z >> SHIFT) & 15))
        if counts[at] < _MOST:
            counts[at] += np.uint8(1)
        x += sx
        y += sy
        z += sz
    return used


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
        block, used = _open(x >> 4, y >> 4, z >> 4, keys, ids, used)
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
        for k in range(_VOLUME):
            pool[to, k] = min(np.uint32(MOST), np.uint32(pool[to, k]) + np.uint32(other_pool[there, k]))
    return used


@njit(cache=True, nogil=True)
def _rehash(keys, ids, new_keys, new_ids):  # type: ignore[no-untyped-def]
    for i in range(len(keys)):
        if keys[i] != EMPTY:
            slot = find_slot(keys[i], new_keys)
            new_keys[slot], new_ids[slot] = keys[i], ids[i]

"""Surfels: the sums of the points in each small voxel, in integers.

Integer sums do not depend on the order of addition: a survey integrated scan by scan, in chunks or at once
gives bit for bit the same sums. One pass over the points, O(1) each; memory grows with the surface, not with
the number of points, and where a limit is set no further than that: the rest goes to disk (``surfel_runs``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import DTypeLike, NDArray

from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.scratch import disk_array, let_go
from floorplan_core.geometry.surfel_runs import SurfelRuns
from floorplan_core.geometry.voxel_keys import BIAS, block_slot, pack, spread

Float = NDArray[np.float64]

STEPS = 100  # a voxel is divided into this many steps a side for the sums: 0.5 mm at 5 cm
VIEW_STEPS = 64  # resolution of the unit view direction
COLUMNS = 9  # count, sums of x, y, z, sums of xx, xy, yy, sums of the view's x, y
MOST_POINTS = 200_000  # of a voxel: its sums of squares stay within 32 bits, its mean is long settled
BLOCK = 5  # voxels on a side of the blocks of a sample
_FAR_BLOCK = BIAS // BLOCK + 1  # blocks from the origin: no index is farther
_START = 1 << 16
_WORTH = 10_000  # surfels of which a second thread takes half
_SPARSE = (
    4  # slots of the hash for each row: neighbours fill whole stretches of it, so half empty is too full
)
_ROW_BYTES = 4 * _SPARSE + 8 + 4 * COLUMNS  # of a surfel: its slots, its key, its sums
_COLUMNS = 0.5  # of the room, that the columns over the plan may take besides
_BATCH = 256  # points whose slots are looked up together: what is kept of them fits the first-level cache


@dataclass(frozen=True)
class Surfels:
    """The occupied small voxels as arrays, ``N`` of them."""

    centroid: Float  # (N, 3) metres, local frame
    count: NDArray[np.int32]  # (N,) points
    variance: Float  # (N, 3) m2: xx, xy, yy of the points about the centroid
    view: Float  # (N, 2) mean of the unit directions from the points to their sensor; 0 where unknown
    size: float  # metres, side of a voxel
    every: int = 1  # one in so many blocks of voxels is here

    def __len__(self) -> int:
        return len(self.count)


class SurfelMap:
    """A growing table of voxel sums: a hash from keys to rows, rows in the order of their first point.

    :param size: metres, side of a voxel.
    :param room: bytes that the table may take in memory (roughly, and no less than 4 MB); None: all there is.
    """

    def __init__(self, size: float, room: float | None = None) -> None:
        self.size, self._room = size, room
        self._most = None if room is None else max(_START, 1 << int(room / _ROW_BYTES).bit_length() >> 1)
        self._runs = SurfelRuns()
        self._on_disk = False  # True: keys and sums are arrays on disk
        self._table = np.zeros(_SPARSE * _START, dtype=np.int32)  # row + 1 of each slot; 0: empty
        self._keys = np.zeros(_START, dtype=np.int64)
        self._sums = np.zeros((_START, COLUMNS), dtype=np.int32)
        self._used = 0
        self.points = 0  # points that were inserted

    def __len__(self) -> int:
        self._gather()
        return self._used

    @property
    def on_disk(self) -> bool:
        """True where the surfels outgrew their room: they, and what is made of them, are on disk."""
        return self._on_disk or len(self._runs) > 0

    def reserve(self, surfels: int) -> None:
        """Make room for that many surfels at once instead of growing step by step."""
        surfels = surfels if self._most is None else min(surfels, self._most)
        if len(self._keys) < surfels:
            self._resize(1 << int(surfels - 1).bit_length())

    def insert(
        self, points: NDArray[Any], scan: NDArray[np.int32], origins: Float, limits: tuple[float, float]
    ) -> None:
        """Add (N, 3) points; ``scan[i]`` picks the sensor origin of point i, -1 where there is none.

        Points that are not finite, or outside ``limits`` (nearest, farthest range, metres), are left out.
        """
        start = 0
        self._resume()
        while start < len(points):
            start, self._used, added = _insert(
                points,
                scan,
                origins,
                self.size,
                limits[0],
                limits[1],
                self._table,
                self._keys,
                self._sums,
                self._used,
                start,
            )
            self.points += added
            if start < len(points):
                self._grow()

    def select(self, rows: NDArray[np.int64]) -> SurfelMap:
        """A packed map of the surfels in ``rows`` (rising), each with all of its points."""
        self._gather()
        part = SurfelMap(self.size, self._room)
        part._used, part._on_disk = len(rows), self._on_disk
        part._keys, part._sums = self._array(np.int64, len(rows)), self._array(np.int32, len(rows), COLUMNS)
        np.take(self._keys, rows, out=part._keys, mode="clip")  # rows are within: saves a copy of all of it
        np.take(self._sums, rows, axis=0, out=part._sums, mode="clip")
        part.points = int(part._sums[:, 0].sum())
        part.pack()
        return part

    def pack(self) -> None:
        """Let go of what only further points need; should there be some, it is made again."""
        self._gather()
        self._table = np.zeros(0, dtype=np.int32)
        if self._on_disk:
            let_go(self._sums)

    def leave_memory(self) -> None:
        """Move all surfels to disk, and with them what will be made of them."""
        self._gather()
        if not self._on_disk:
            keys, sums = disk_array((self._used,), np.int64), disk_array((self._used, COLUMNS), np.int32)
            keys[:], sums[:] = self._keys[: self._used], self._sums[: self._used]
            self._keys, self._sums, self._on_disk = keys, sums, True
        self.pack()

    def _resume(self) -> None:
        """Be ready for points, also after :meth:`pack` or a look at surfels on disk."""
        if self._on_disk:
            self._to_disk()
        elif not len(self._table):
            self._resize(max(_START, 1 << (len(self._keys) - 1).bit_length()))

    def _gather(self) -> None:
        """Put what is on disk and what is in memory together."""
        if len(self._runs):
            self._to_disk()
            self._keys, self._sums = self._runs.merge()
            self._table, self._used, self._on_disk = np.zeros(0, dtype=np.int32), len(self._keys), True

    def _to_disk(self) -> None:
        """Leave the surfels to the disk and begin with an empty table."""
        self._runs.append(self._keys[: self._used], self._sums[: self._used])
        self._used, self._on_disk = 0, False
        self._resize(self._most or _START)

    def columns(self, *shape: int) -> NDArray[np.uint64]:
        """Zeros, a word for each column over the plan: on disk if the surfels are, or as much has no room."""
        large = self._room is not None and 8 * math.prod(shape) > _COLUMNS * self._room
        return disk_array(shape, np.uint64) if large or self.on_disk else np.zeros(shape, dtype=np.uint64)

    def _array(self, kind: DTypeLike, *shape: int) -> NDArray[Any]:
        """An array for something of each surfel: where the surfels are."""
        return disk_array(shape, kind) if self._on_disk else np.empty(shape, dtype=kind)

    def _grow(self) -> None:
        """Room for twice as many surfels; where that is too much, for as many others."""
        if self._most is not None and 2 * len(self._keys) > self._most:
            self._to_disk()
        else:
            self._resize(2 * len(self._keys))

    def _resize(self, capacity: int) -> None:
        self._table = np.zeros(0, dtype=np.int32)  # before the new one is made
        keys, sums = np.zeros(capacity, dtype=np.int64), np.zeros((capacity, COLUMNS), dtype=np.int32)
        keys[: self._used], sums[: self._used] = self._keys[: self._used], self._sums[: self._used]
        self._keys, self._sums = keys, sums
        self._table = np.zeros(_SPARSE * capacity, dtype=np.int32)
        _fill(self._keys, self._used, self._table)

    def surfels(self, every: int = 1) -> Surfels:
        """The map as arrays, in the order in which the voxels were first seen.

        With ``every`` > 1 only one in so many blocks of voxels, whole and chosen by a hash of its place.
        """
        self._gather()
        rows = self._chosen(every) if every > 1 else np.arange(self._used)
        n = len(rows)
        centroid, variance, view = (
            self._array(float, n, 3),
            self._array(float, n, 3),
            self._array(float, n, 2),
        )
        count = self._array(np.int32, n)

        def part(start: int, stop: int) -> None:
            out = (centroid, count, variance, view)
            _unpack(self._keys, self._sums, rows, self.size, out, start, stop)

        in_halves(part, n, worth=_WORTH)
        return Surfels(centroid, count, variance, view, self.size, every)

    def pieces(self, most: int) -> Iterator[Surfels]:
        """The map piece by piece, ``most`` surfels each, in the order of :meth:`surfels`."""
        self._gather()
        for first in range(0, self._used, most):
            rows = np.arange(first, min(first + most, self._used))
            n = len(rows)
            out = np.empty((n, 3)), np.empty(n, dtype=np.int32), np.empty((n, 3)), np.empty((n, 2))
            _unpack(self._keys, self._sums, rows, self.size, out, 0, n)
            yield Surfels(*out, self.size)

    def _chosen(self, every: int) -> NDArray[np.int64]:
        """Rows of the surfels in one of so many blocks."""
        chosen = np.empty(self._used, dtype=np.bool_)
        in_halves(
            lambda start, stop: _in_chosen_block(self._keys, every, chosen, start, stop), self._used, _WORTH
        )
        return np.flatnonzero(chosen)

    def turned(self, rotation: Float, lift: float) -> tuple[Float, NDArray[np.int32], Float, Float]:
        """All surfels in another frame, with ``lift`` (metres) added to their height.

        Centroids (N, 3), counts (N,), variances along the new x and y (N, 2) and views (N, 2).
        """
        self._gather()
        n, r = self._used, np.ascontiguousarray(rotation)
        xyz, variance, view = self._array(float, n, 3), self._array(float, n, 2), self._array(float, n, 2)
        count = self._array(np.int32, n)

        def part(start: int, stop: int) -> None:
            _turn(self._keys, self._sums, self.size, r, lift, xyz, variance, view, start, stop)

        in_halves(part, n, worth=_WORTH)
        count[:] = self._sums[:n, 0]
        if self._on_disk:
            for array in (self._sums, xyz, variance, view):
                let_go(array)
        return xyz, count, variance, view


@njit(cache=True, nogil=True)
def _insert(points, scan, origins, size, nearest, farthest, table, keys, sums, used, start):  # type: ignore[no-untyped-def]
    """Points from ``start`` on, batch by batch; ends before the batch for which there may be no room.

    Neighbours in a file are far apart in the map. Were each point looked up by itself, it would wait for
    memory three times; the slots of a batch are touched first, one after the other without waiting.
    """
    added = 0
    key, slot = np.empty(_BATCH, dtype=np.int64), np.empty(_BATCH, dtype=np.int64)
    parts, touched = np.empty((_BATCH, 5), dtype=np.int32), np.zeros(1, dtype=np.int64)
    for i in range(start, len(points), _BATCH):
        if used + _BATCH > len(keys):  # the caller makes room and resumes at this point
            return i, used, added
        batch = points[i : i + _BATCH]
        count = _quantise(
            batch, scan[i : i + _BATCH], origins, size, nearest, farthest, len(table) - 1, key, slot, parts
        )
        _touch(slot[:count], table, keys, touched)
        used = _add(key[:count], slot[:count], parts, table, keys, sums, used)
        added += count
    return len(points), used, added


@njit(cache=True, nogil=True)
def _quantise(points, scan, origins, size, nearest, farthest, mask, key, slot, parts):  # type: ignore[no-untyped-def]
    """Key, first slot, place in the voxel and view of each point that counts; returns how many they are."""
    count, near2, far2, inverse = 0, nearest * nearest, farthest * farthest, 1.0 / size
    for i in range(len(points)):
        x, y, z = np.float64(points[i, 0]), np.float64(points[i, 1]), np.float64(points[i, 2])
        if not (np.isfinite(x) and np.isfinite(y) and np.isfinite(z)):
            continue
        vx, vy = 0.0, 0.0
        if scan[i] >= 0:
            vx, vy, vz = origins[scan[i], 0] - x, origins[scan[i], 1] - y, origins[scan[i], 2] - z
            r2 = vx * vx + vy * vy + vz * vz
            if not (r2 >= near2 and r2 <= far2):
                continue
            scale = VIEW_STEPS / np.sqrt(max(r2, 1e-12))
            vx, vy = vx * scale, vy * scale
        fx, fy, fz = x * inverse, y * inverse, z * inverse
        if abs(fx) >= BIAS - 1 or abs(fy) >= BIAS - 1 or abs(fz) >= BIAS - 1:
            continue
        ix, iy, iz = int(np.floor(fx)), int(np.floor(fy)), int(np.floor(fz))
        key[count], slot[count] = pack(ix, iy, iz), block_slot(ix, iy, iz, mask)
        parts[count, 0], parts[count, 1] = int((fx - ix) * STEPS), int((fy - iy) * STEPS)
        parts[count, 2] = int((fz - iz) * STEPS)
        parts[count, 3], parts[count, 4] = int(np.rint(vx)), int(np.rint(vy))
        count += 1
    return count


@njit(cache=True, nogil=True)
def _touch(slot, table, keys, touched):  # type: ignore[no-untyped-def]
    """Bring the slots and the keys of their rows into the cache; ``touched`` makes the compiler do it."""
    for i in range(len(slot)):
        touched[0] += table[slot[i]]
    for i in range(len(slot)):
        touched[0] += keys[max(table[slot[i]] - 1, 0)]


@njit(cache=True, nogil=True)
def _add(key, slot, parts, table, keys, sums, used):  # type: ignore[no-untyped-def]
    """Find the row of each key, or begin it, and add to its sums; returns how many rows there are."""
    mask = len(table) - 1
    for i in range(len(key)):
        at = slot[i]
        r = table[at] - 1
        while r >= 0 and keys[r] != key[i]:
            at = (at + 1) & mask
            r = table[at] - 1
        if r < 0:
            r = used
            keys[r] = key[i]
            used += 1
            table[at] = used
        if sums[r, 0] < MOST_POINTS:
            x, y = parts[i, 0], parts[i, 1]
            sums[r, 0] += 1
            sums[r, 1] += x
            sums[r, 2] += y
            sums[r, 3] += parts[i, 2]
            sums[r, 4] += x * x
            sums[r, 5] += x * y
            sums[r, 6] += y * y
            sums[r, 7] += parts[i, 3]
            sums[r, 8] += parts[i, 4]
    return used


@njit(cache=True, nogil=True)
def _fill(keys, used, table):  # type: ignore[no-untyped-def]
    mask, low = len(table) - 1, (1 << 21) - 1
    for i in range(used):
        key = keys[i]
        slot = block_slot((key >> 42) - BIAS, ((key >> 21) & low) - BIAS, (key & low) - BIAS, mask)
        while table[slot] != 0:
            slot = (slot + 1) & mask
        table[slot] = i + 1


@njit(cache=True, nogil=True)
def _unpack(keys, sums, rows, size, out, start, stop):  # type: ignore[no-untyped-def]
    low, step = (1 << 21) - 1, size / STEPS
    centroid, count, variance, view = out
    for row in range(start, stop):
        i = rows[row]
        count[row] = sums[i, 0]
        c = float(sums[i, 0])
        mx, my, mz = sums[i, 1] / c, sums[i, 2] / c, sums[i, 3] / c
        centroid[row, 0] = ((keys[i] >> 42) - BIAS) * size + (mx + 0.5) * step
        centroid[row, 1] = (((keys[i] >> 21) & low) - BIAS) * size + (my + 0.5) * step
        centroid[row, 2] = ((keys[i] & low) - BIAS) * size + (mz + 0.5) * step
        variance[row, 0] = (sums[i, 4] / c - mx * mx) * step * step
        variance[row, 1] = (sums[i, 5] / c - mx * my) * step * step
        variance[row, 2] = (sums[i, 6] / c - my * my) * step * step
        view[row, 0] = sums[i, 7] / (c * VIEW_STEPS)
        view[row, 1] = sums[i, 8] / (c * VIEW_STEPS)


@njit(cache=True, nogil=True)
def _in_chosen_block(keys, every, out, start, stop):  # type: ignore[no-untyped-def]
    low, side = np.uint64((1 << 21) - 1), np.uint64(BLOCK)
    beside = np.uint64(BLOCK * _FAR_BLOCK - BIAS)  # makes indices positive: unsigned division is far quicker
    for i in range(start, stop):
        key = np.uint64(keys[i])
        x = int(((key >> np.uint64(42)) + beside) // side) - _FAR_BLOCK
        y = int((((key >> np.uint64(21)) & low) + beside) // side) - _FAR_BLOCK
        z = int(((key & low) + beside) // side) - _FAR_BLOCK
        out[i] = (spread(pack(x, y, z)) >> 8) % every == 0


@njit(cache=True, nogil=True)
def _turn(keys, sums, size, r, lift, xyz, spread_, view, start, stop):  # type: ignore[no-untyped-def]
    low, step = (1 << 21) - 1, size / STEPS
    for i in range(start, stop):
        c = 1.0 / sums[i, 0]
        mx, my, mz = sums[i, 1] * c, sums[i, 2] * c, sums[i, 3] * c
        x = ((keys[i] >> 42) - BIAS) * size + (mx + 0.5) * step
        y = (((keys[i] >> 21) & low) - BIAS) * size + (my + 0.5) * step
        z = ((keys[i] & low) - BIAS) * size + (mz + 0.5) * step
        for k in range(3):
            xyz[i, k] = r[k, 0] * x + r[k, 1] * y + r[k, 2] * z
        xyz[i, 2] += lift
        xx, xy, yy = sums[i, 4] * c - mx * mx, sums[i, 5] * c - mx * my, sums[i, 6] * c - my * my
        vx, vy = sums[i, 7] * c / VIEW_STEPS, sums[i, 8] * c / VIEW_STEPS
        for k in range(2):
            a, b = r[k, 0], r[k, 1]
            spread_[i, k] = (a * a * xx + 2 * a * b * xy + b * b * yy) * step * step
            view[i, k] = a * vx + b * vy

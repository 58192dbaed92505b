"""The compiled kernels of ray casting: many rays at once, step by step, counted in blocks of voxels.

A batch of rays is aimed without a branch (:func:`_aim`), the places of each ray are computed eight in one
instruction (:func:`_locate`) and queued, and counted from the queue. Neighbours in a file often are
neighbours in direction: where ``_GROUP`` rays in a row begin at one place and end close together, the voxels
that all of them pass are queued once. Which rays are taken together changes no count.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from floorplan_core.geometry.voxel_keys import BIAS, EMPTY, find_slot, pack

BLOCK = 16
MOST = 255  # rays at which a voxel's count ends
VOLUME = BLOCK**3
SHIFT = 24  # rays are followed in fixed point: 24 bits of fraction of a voxel
BLOCK_SHIFT = SHIFT + 4
ONE = float(1 << SHIFT)
_BATCH = 256  # rays whose ends are computed together
_GROUP = 4  # neighbouring rays that are followed together
_APART = 3 << (SHIFT - 2)  # of a voxel, in fixed point: ends of rays farther apart are not
# Where what is known of the rays of a batch begins: start, step, number of steps; see _aim and _group.
_X, _Y, _Z, _SX, _SY, _SZ, _STEPS, _ENTERED, _INSIDE, _MEMBERS = range(0, 10 * _BATCH, _BATCH)
_TOGETHER = 16  # places computed in one go: what is more than a ray has is overwritten by the next
_PART = 96  # steps of a ray that are queued at a time: with 7 blocks each way they fit 32 bits
_QUEUE = 4096  # places that wait to be counted: 16 kB, within the first-level cache
_ROOM = _GROUP * _PART + _TOGETHER  # places that one more part of a group may take
_MIDDLE = 8  # block of 16 that a part begins in, in the 32-bit words of its places
_VOXEL_BITS = 12  # of a place, below those of its cell of the window
_LOW = (1 << BLOCK_SHIFT) - 1
_W = np.uint32
_U = np.uint64


@njit(cache=True, inline="always")
def open_block(bx, by, bz, keys, ids, used):  # type: ignore[no-untyped-def]
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
def reach_of(points, scan, origins, size, nearest, farthest):  # type: ignore[no-untyped-def]
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
def follow_rays(points, scan, origins, ranges, blocks, pool, window, used, start):  # type: ignore[no-untyped-def]
    """Follow rays from ``start`` on; ends before the first that the pool (True) or the window cannot take."""
    ends, rays = np.empty(6 * _BATCH), np.empty(10 * _BATCH, dtype=np.int64)
    queues = np.empty(_QUEUE, dtype=np.uint32), np.empty(_QUEUE, dtype=np.uint32)
    pair = np.empty(_PART + _TOGETHER, dtype=np.uint32), np.empty(_PART + _TOGETHER, dtype=np.uint32)
    for first in range(start, len(points), _BATCH):
        count = min(_BATCH, len(points) - first)
        _scale(points, scan, origins, 1.0 / ranges[0], first, count, ends)
        _aim(ends, ranges, window[1], count, rays)
        _group(scan[first : first + count], rays)
        done, used, full = _follow(rays, count, blocks, pool, window, used, queues, pair)
        if done < count:
            return first + done, used, full
    return len(points), used, False


@njit(cache=True, nogil=True)
def _follow(rays, count, blocks, pool, window, used, queues, pair):  # type: ignore[no-untyped-def]
    """Count the voxels of a batch of rays; how many were followed, blocks, whether the pool is too small.

    The voxel at a step is monotone in the slopes: where the least and the greatest slopes of a group lead to
    the same one, all of its rays do, and it is counted once for all of them.
    """
    keys, ids = blocks
    _, place, beyond = window
    counts = pool.reshape(-1)
    (single, shared), (low, high) = queues, pair
    singles, shares, entering = 0, 0, 0  # places that wait; blocks that they may open
    cx, cy, cz = place[0], place[1], place[2]
    row, column = place[4] + place[5], place[5]
    far, near_by = _W(1 << (row + _VOXEL_BITS)), _W(1 << (column + _VOXEL_BITS))
    i = 0
    while i < count:
        together = rays[_U(_MEMBERS + i)]
        if together == 0:
            i += 1
            continue
        inside, entered = rays[_U(_INSIDE + i)] > 0, rays[_U(_ENTERED + i)]
        entering += entered
        lacking = used + entering > len(pool) or not (inside or beyond)
        if lacking or singles > _QUEUE - _ROOM or shares > _QUEUE - _ROOM:
            used = _count(single, singles, window, keys, ids, counts, used, 1)
            used = _count(shared, shares, window, keys, ids, counts, used, _GROUP)
            singles, shares, entering = 0, 0, entered
            if used + entered > len(pool) or not (inside or beyond):
                return i, used, used + entered > len(pool)
        x, y, z, steps = rays[_U(_X + i)], rays[_U(_Y + i)], rays[_U(_Z + i)], rays[_U(_STEPS + i)]
        ax, ay, az = rays[_U(_SX + i)], rays[_U(_SY + i)], rays[_U(_SZ + i)]
        bx, by, bz = ax, ay, az
        if not inside:
            used = _follow_far(x, y, z, ax, ay, az, steps, keys, ids, counts, used)
            i += 1
            continue
        for r in range(i + 1, i + together):
            sx, sy, sz = rays[_U(_SX + r)], rays[_U(_SY + r)], rays[_U(_SZ + r)]
            ax, ay, az = min(ax, sx), min(ay, sy), min(az, sz)
            bx, by, bz = max(bx, sx), max(by, sy), max(bz, sz)
            steps = min(steps, rays[_U(_STEPS + r)])
        if together == 1:
            for first in range(0, steps, _PART):
                if singles > _QUEUE - _ROOM:
                    used = _count(single, singles, window, keys, ids, counts, used, 1)
                    singles = 0
                part = min(steps - first, _PART)
                u, v, w = x + first * ax, y + first * ay, z + first * az
                corner = _corner(u, v, w, cx, cy, cz, row, column)
                _locate(
                    _near(u),
                    _near(v),
                    _near(w),
                    _W(ax),
                    _W(ay),
                    _W(az),
                    part,
                    corner,
                    far,
                    near_by,
                    single,
                    _U(singles),
                )
                singles += part
            i += 1
            continue
        for first in range(0, steps, _PART):
            if singles > _QUEUE - _ROOM or shares > _QUEUE - _ROOM:
                used = _count(single, singles, window, keys, ids, counts, used, 1)
                used = _count(shared, shares, window, keys, ids, counts, used, _GROUP)
                singles, shares = 0, 0
            part = min(steps - first, _PART)
            u, v, w = x + first * ax, y + first * ay, z + first * az
            corner = _corner(u, v, w, cx, cy, cz, row, column)
            _locate(
                _near(u), _near(v), _near(w), _W(ax), _W(ay), _W(az), part, corner, far, near_by, low, _U(0)
            )
            u, v, w = x + first * bx, y + first * by, z + first * bz
            corner = _corner(u, v, w, cx, cy, cz, row, column)
            _locate(
                _near(u), _near(v), _near(w), _W(bx), _W(by), _W(bz), part, corner, far, near_by, high, _U(0)
            )
            apart = 0
            for k in range(part):
                where = low[_U(k)]
                shared[_U(shares)] = where
                low[_U(apart)] = _W(k)
                same = where == high[_U(k)]
                shares += same
                apart += not same
            for k in range(apart):
                at = first + np.int64(low[_U(k)])
                for r in range(i, i + _GROUP):
                    u, v, w = (
                        x + at * rays[_U(_SX + r)],
                        y + at * rays[_U(_SY + r)],
                        z + at * rays[_U(_SZ + r)],
                    )
                    single[_U(singles)] = _place(u, v, w, cx, cy, cz, row, column)
                    singles += 1
        for r in range(i, i + _GROUP):
            for step in range(steps, rays[_U(_STEPS + r)]):
                if singles > _QUEUE - _ROOM:
                    used = _count(single, singles, window, keys, ids, counts, used, 1)
                    singles = 0
                u, v, w = (
                    x + step * rays[_U(_SX + r)],
                    y + step * rays[_U(_SY + r)],
                    z + step * rays[_U(_SZ + r)],
                )
                single[_U(singles)] = _place(u, v, w, cx, cy, cz, row, column)
                singles += 1
        i += together
    used = _count(single, singles, window, keys, ids, counts, used, 1)
    used = _count(shared, shares, window, keys, ids, counts, used, _GROUP)
    return count, used, False


@njit(cache=True, nogil=True)
def _scale(points, scan, origins, inverse, first, count, ends):  # type: ignore[no-untyped-def]
    """Points and the origins that saw them, in voxels; not a number where there is none."""
    for i in range(count):
        row = scan[first + i]
        for k in range(3):
            ends[_U(k * _BATCH + i)] = points[first + i, k] * inverse
            ends[_U((3 + k) * _BATCH + i)] = origins[row, k] * inverse if row >= 0 else np.nan


@njit(cache=True, nogil=True, error_model="numpy")
def _aim(ends, ranges, place, count, rays):  # type: ignore[no-untyped-def]
    """Start, step and number of steps of each ray, what blocks it may enter (0: it is none), and whether all
    of them lie in the window. No branch depends on the data: the compiler makes wide instructions of it."""
    size, nearest, farthest = ranges
    near2, far2, edge = nearest * nearest, farthest * farthest, (BIAS - BLOCK) * 1.0
    cx, cy, cz = place[0], place[1], place[2]
    wide, deep, high = (1 << place[3]) - 1, (1 << place[4]) - 1, (1 << place[5]) - 1
    one = np.int64(ONE)
    for i in range(count):
        px, py, pz = ends[_U(i)], ends[_U(_Y + i)], ends[_U(_Z + i)]
        ox, oy, oz = ends[_U(_SX + i)], ends[_U(_SY + i)], ends[_U(_SZ + i)]
        dx, dy, dz = px - ox, py - oy, pz - oz
        r2 = (dx * dx + dy * dy + dz * dz) * size * size
        good = (r2 >= near2) & (r2 <= far2)  # also leaves out what is not a number
        good &= (abs(px) <= edge) & (abs(py) <= edge) & (abs(pz) <= edge)
        good &= (abs(ox) <= edge) & (abs(oy) <= edge) & (abs(oz) <= edge)
        # what is no ray gets numbers that can be converted
        px, py, pz = px if good else 0.0, py if good else 0.0, pz if good else 0.0
        ox, oy, oz = ox if good else 0.0, oy if good else 0.0, oz if good else 0.0
        dx, dy, dz = px - ox, py - oy, pz - oz
        ex, ey, ez = np.int64(np.floor(px)), np.int64(np.floor(py)), np.int64(np.floor(pz))
        x, y, z = np.int64(np.floor(ox * ONE)), np.int64(np.floor(oy * ONE)), np.int64(np.floor(oz * ONE))
        longest = max(max(abs(dx), abs(dy)), max(abs(dz), 1e-9))
        sx, sy, sz = (
            np.int64(dx / longest * ONE),
            np.int64(dy / longest * ONE),
            np.int64(dz / longest * ONE),
        )
        n = np.int64(longest)  # steps to the voxel of the point, which only the last can reach: or n + 1
        past = (
            (((x + n * sx) >> SHIFT) ^ ex) | (((y + n * sy) >> SHIFT) ^ ey) | (((z + n * sz) >> SHIFT) ^ ez)
        )
        # Blocks of both ends in the window. Rounding may take a ray one block further: the outermost are out.
        ax, ay, az = (x >> BLOCK_SHIFT) - cx, (y >> BLOCK_SHIFT) - cy, (z >> BLOCK_SHIFT) - cz
        bx, by, bz = (ex >> 4) - cx, (ey >> 4) - cy, (ez >> 4) - cz
        inside = (min(ax, bx) > 0) & (max(ax, bx) < wide)
        inside &= (min(ay, by) > 0) & (max(ay, by) < deep)
        inside &= (min(az, bz) > 0) & (max(az, bz) < high)
        rays[_U(_X + i)], rays[_U(_Y + i)], rays[_U(_Z + i)] = x, y, z
        rays[_U(_SX + i)], rays[_U(_SY + i)], rays[_U(_SZ + i)] = sx, sy, sz
        rays[_U(_STEPS + i)] = n + (past != 0)
        rays[_U(_ENTERED + i)] = (abs(ax - bx) + abs(ay - by) + abs(az - bz) + 4) * good
        side = (sx == one) * 1 + (sx == -one) * 2 + (sy == one) * 4 + (sy == -one) * 8
        rays[_U(_INSIDE + i)] = (side + (sz == one) * 16 + (sz == -one) * 32 + 64) * inside


@njit(cache=True, nogil=True)
def _group(scan, rays):  # type: ignore[no-untyped-def]
    """How many rays are followed together from each on: ``_GROUP`` that begin at one place in the window and
    stay so close that they share most of their voxels, or 1; 0 where there is none to be followed."""
    i, count = 0, len(scan)
    while i < count:
        rays[_U(_MEMBERS + i)] = rays[_U(_ENTERED + i)] > 0
        if i + _GROUP > count or rays[_U(_ENTERED + i)] == 0 or rays[_U(_INSIDE + i)] == 0:
            i += 1
            continue
        close, entered = True, rays[_U(_ENTERED + i)]
        for r in range(i + 1, i + _GROUP):
            far = max(
                abs(rays[_U(_SX + r)] - rays[_U(_SX + i)]),
                abs(rays[_U(_SY + r)] - rays[_U(_SY + i)]),
                abs(rays[_U(_SZ + r)] - rays[_U(_SZ + i)]),
            )
            close &= (
                (rays[_U(_ENTERED + r)] > 0)
                & (scan[r] == scan[i])
                & (rays[_U(_INSIDE + r)] == rays[_U(_INSIDE + i)])
                & (far * rays[_U(_STEPS + r)] <= _APART)
            )
            entered += rays[_U(_ENTERED + r)]
        if close:
            rays[_U(_MEMBERS + i)], rays[_U(_ENTERED + i)] = _GROUP, entered
            i += _GROUP
        else:
            i += 1


@njit(cache=True, inline="always")
def _near(u):  # type: ignore[no-untyped-def]
    """A coordinate in fixed point from ``_MIDDLE`` blocks before its own."""
    return _W((u & _LOW) + (_MIDDLE << BLOCK_SHIFT))


@njit(cache=True, inline="always")
def _corner(u, v, w, cx, cy, cz, row, column):  # type: ignore[no-untyped-def]
    """The cell of the window from which :func:`_near` counts, as a place."""
    corner = ((u >> BLOCK_SHIFT) - cx - _MIDDLE) << row
    corner += ((v >> BLOCK_SHIFT) - cy - _MIDDLE) << column
    return _W((corner + (w >> BLOCK_SHIFT) - cz - _MIDDLE) << _VOXEL_BITS)


@njit(cache=True, inline="always")
def _place(u, v, w, cx, cy, cz, row, column):  # type: ignore[no-untyped-def]
    """Cell of the window, and below it the voxel in its block, of a place in fixed point."""
    cell = ((u >> BLOCK_SHIFT) - cx) << row
    cell += (((v >> BLOCK_SHIFT) - cy) << column) + (w >> BLOCK_SHIFT) - cz
    voxel = (((u >> SHIFT) & 15) << 8) | (((v >> SHIFT) & 15) << 4) | ((w >> SHIFT) & 15)
    return _W((cell << _VOXEL_BITS) | voxel)


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
def _count(queue, waiting, window, keys, ids, counts, used, rays):  # type: ignore[no-untyped-def]
    """Count so many rays at each place that waits; returns how many blocks there are."""
    least = _W(MOST - rays)
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
            block, used = open_block(bx, by, bz, keys, ids, used)
            near[cell] = block
        at = (_U(block) << _U(_VOXEL_BITS)) | _U(where & _W(VOLUME - 1))
        counts[at] = min(_W(counts[at]), least) + _W(rays)  # a branch would be guessed wrong too often
    return used


@njit(cache=True, nogil=True)
def _follow_far(x, y, z, sx, sy, sz, n, keys, ids, counts, used):  # type: ignore[no-untyped-def]
    """Count one ray that leaves the window: the hash is asked for each block that it enters."""
    inx, iny, inz, block = ~x, y, z, 0  # a place in the block that the ray is in; in none at first
    for _ in range(n):
        if ((x ^ inx) | (y ^ iny) | (z ^ inz)) >> BLOCK_SHIFT != 0:
            inx, iny, inz = x, y, z
            block, used = open_block(x >> BLOCK_SHIFT, y >> BLOCK_SHIFT, z >> BLOCK_SHIFT, keys, ids, used)
        at = block * VOLUME + ((((x >> SHIFT) & 15) << 8) | (((y >> SHIFT) & 15) << 4) | ((z >> SHIFT) & 15))
        if counts[at] < MOST:
            counts[at] += np.uint8(1)
        x += sx
        y += sy
        z += sz
    return used

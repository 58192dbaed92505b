"""What was seen along the sides of a polygon, as kernels: hundreds of sides, each beside a few surfaces.

Tables are sorted by facing, then offset, so that each side looks only at surfaces near it. All in metres,
manhattan frame. The facings are numbered as in :class:`~floorplan_core.model.Facing`.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

REACH = 0.22  # m between a side and a surface that can be its own
_DEEPEST = 0.35  # m behind a side, where the back of its recesses lies
_ON = 1e-4  # m between a side and the plane that it lies on
_LITTLE = 0.3  # m, and share of a side: less seen of it tells nothing
_ALIGNED = 0.03  # m between surfaces of one wall, over which its offset is averaged
_OTHER = 0.5  # share of a side behind which the wall's other face must have been seen
_MOST, _TWO_SIGMA = 0.95, 1.96  # share of the points that a residual holds; in standard deviations
_HALVINGS = 16  # of an interval under a metre: to a few hundredths of a millimetre
_NO_LENGTH = 1e-9  # m, against division by nothing


@njit(cache=True, nogil=True)
def side_targets(points, seen, first, placed, thickness):  # type: ignore[no-untyped-def]
    """(N,) where each side of a ring belongs: the median of the surfaces seen along it, by their area.

    A beam along the wall is as long as the wall below it, and not as high. Where too little was seen, one
    wall's thickness behind its other face; where that was not seen either, and on walls placed by hand, where
    it is. Side k runs from corner k to the next, the inside at its left.

    :param points: (N, 2) corners.
    :param seen: (K, 6) offset, start, end, residual, plane, mean height; ``first``: (5,) where the rows of a
        facing begin.
    :param placed: (H, 5) facing, offset, start, end, plane of the walls moved or added by hand.
    """
    out = np.empty(len(points))
    rows = np.empty((len(seen), 2))  # offset, and m2 along the side
    for k in range(len(points)):
        facing, at, low, high = _side(points, k)
        out[k] = at
        if _is_placed(placed, facing, at, low, high):
            continue
        count, total, area = 0, 0.0, 0.0
        for r in range(_begin(seen, first[facing], first[facing + 1], at - 2 * REACH), first[facing + 1]):
            if seen[r, 0] > at + 2 * REACH:
                break
            length = min(seen[r, 2], high) - max(seen[r, 1], low)
            if abs(seen[r, 0] - at) < REACH and length > 0:
                rows[count, 0], rows[count, 1] = seen[r, 0], length * seen[r, 5]
                count += 1
                total += length
                area += length * seen[r, 5]
        if total < min(_LITTLE, _LITTLE * (high - low)):
            out[k] = _behind_other_face(seen, first, facing, at, low, high, thickness)
        else:
            out[k] = _median_offset(rows[:count], area)
    return out


@njit(cache=True, nogil=True)
def _median_offset(rows, total):  # type: ignore[no-untyped-def]
    """The mean of the surfaces close to the median; ``rows`` (K, 2) offset and weight, by offset."""
    k, below = 0, rows[0, 1]
    while below < 0.5 * total and k < len(rows) - 1:
        k += 1
        below += rows[k, 1]
    weight, sum_ = 0.0, 0.0
    for offset, length in rows:
        if abs(offset - rows[k, 0]) < _ALIGNED:
            weight += length
            sum_ += offset * length
    return sum_ / weight


@njit(cache=True, nogil=True)
def _behind_other_face(seen, first, facing, at, low, high, thickness):  # type: ignore[no-untyped-def]
    """Where only the other face of the wall was seen, the side lies one wall's thickness behind it."""
    sign, other = 1 - 2 * (facing % 2), facing ^ 1
    weight, sum_ = 0.0, 0.0
    for r in range(first[other], first[other + 1]):
        length = min(seen[r, 2], high) - max(seen[r, 1], low)
        ahead = (at - seen[r, 0]) * sign  # of the other face, into the region
        if length > 0 and -REACH < ahead < thickness:
            weight += length
            sum_ += seen[r, 0] * length
    return at if weight < _OTHER * (high - low) else sum_ / weight + sign * thickness


@njit(cache=True, nogil=True)
def measure_sides(points, seen, first, placed, panes, doors, planes):  # type: ignore[no-untyped-def]
    """(N, 3) share of each side along which wall or door was seen, its plane (-1: none), its residual (NaN).

    :param panes: (P, 4) facing, offset, start, end of what was seen in recesses: the wall is there.
    :param doors: (D, 5) axis, offset, reach, start, end.
    :param planes: how many there are; the plane that explains most of a side is its own, ties to the last.
    """
    out = np.empty((len(points), 3))
    surfaces, total = np.empty((len(seen), 3)), np.empty(planes)
    spans = np.empty((len(seen) + len(placed) + len(panes) + len(doors), 2))
    for k in range(len(points)):
        facing, at, low, high = _side(points, k)
        total[:] = 0.0
        count, many = 0, 0
        for r in range(_begin(seen, first[facing], first[facing + 1], at - 2 * REACH), first[facing + 1]):
            if seen[r, 0] > at + 2 * REACH:
                break
            start, end = max(seen[r, 1], low), min(seen[r, 2], high)
            if abs(seen[r, 0] - at) < REACH and end > start:
                total[int(seen[r, 4])] += end - start
                surfaces[count, 0], surfaces[count, 1] = end - start, abs(seen[r, 0] - at)
                surfaces[count, 2] = seen[r, 3]
                count += 1
                many = _insert(spans, many, start, end)
        for facing_, offset, start, end, plane in placed:
            start, end = max(start, low), min(end, high)
            if facing_ == facing and abs(offset - at) < _ON and end > start:
                total[int(plane)] += end - start
                many = _insert(spans, many, start, end)
        for facing_, offset, start, end in panes:
            if facing_ == facing and -REACH < (at - offset) * (1 - 2 * (facing % 2)) < _DEEPEST:
                many = _insert(spans, many, start, end)
        for axis, offset, reach, start, end in doors:
            if axis == facing // 2 and abs(offset - at) < reach:
                many = _insert(spans, many, start, end)
        out[k, 0] = min(1.0, _covered(spans[:many], low, high) / max(high - low, _NO_LENGTH))
        out[k, 1], most = -1.0, 0.0
        for plane in range(planes):
            if total[plane] > 0 and total[plane] >= most:
                out[k, 1], most = plane, total[plane]
        out[k, 2] = residual_of(surfaces[:count])
    return out


@njit(cache=True, nogil=True)
def _covered(spans, low, high):  # type: ignore[no-untyped-def]
    """Metres of the side from ``low`` to ``high`` that the ``spans`` (M, 2), in order, cover."""
    covered, at = 0.0, low
    for start, end in spans:
        start, end = max(start, at), min(end, high)
        if end > start:
            covered += end - start
            at = end
    return covered


@njit(cache=True, nogil=True)
def residual_of(surfaces):  # type: ignore[no-untyped-def]
    """Metres within which 95 % of the points seen along a side lie of it; NaN where nothing was seen.

    The points of each surface are taken as normally distributed about its own offset, with its own residual.

    :param surfaces: (K, 3) length along the side, distance from it, residual.
    """
    total, low, high = 0.0, 0.0, 0.0
    for length, away, residual in surfaces:
        total += length
        high = max(high, away + 2 * residual)
    if total <= 0:
        return np.nan
    high += 1e-3
    for _ in range(_HALVINGS):
        middle, inside = 0.5 * (low + high), 0.0
        for length, away, residual in surfaces:
            scale = max(residual / _TWO_SIGMA, 1e-6) * math.sqrt(2.0)
            inside += length * (math.erf((middle - away) / scale) + math.erf((middle + away) / scale))
        if 0.5 * inside / total < _MOST:
            low = middle
        else:
            high = middle
    return high


@njit(cache=True, nogil=True)
def _side(points, k):  # type: ignore[no-untyped-def]
    """Facing of the surface along a side, its offset, and from where to where it runs."""
    a, b = points[k], points[(k + 1) % len(points)]
    if abs(a[0] - b[0]) < abs(a[1] - b[1]):
        return 1 if b[1] > a[1] else 0, a[0], min(a[1], b[1]), max(a[1], b[1])
    return 2 if b[0] > a[0] else 3, a[1], min(a[0], b[0]), max(a[0], b[0])


@njit(cache=True, nogil=True)
def _is_placed(placed, facing, at, low, high):  # type: ignore[no-untyped-def]
    """True where a side lies on a wall moved or added by hand: it stays, whatever was seen near it."""
    for facing_, offset, start, end, _ in placed:
        if facing_ == facing and abs(offset - at) < _ON and min(end, high) > max(start, low):
            return True
    return False


@njit(cache=True, nogil=True)
def _begin(seen, first, last, least):  # type: ignore[no-untyped-def]
    """The first of the rows from ``first`` to ``last`` whose offset is not below ``least``."""
    while first < last:
        middle = (first + last) // 2
        if seen[middle, 0] < least:
            first = middle + 1
        else:
            last = middle
    return first


@njit(cache=True, nogil=True)
def _insert(spans, many, start, end):  # type: ignore[no-untyped-def]
    """Put a span into the ``many`` first rows, which are in order; returns how many they are then."""
    k = many
    while k > 0 and (spans[k - 1, 0] > start or (spans[k - 1, 0] == start and spans[k - 1, 1] > end)):
        spans[k, 0], spans[k, 1] = spans[k - 1, 0], spans[k - 1, 1]
        k -= 1
    spans[k, 0], spans[k, 1] = start, end
    return many + 1

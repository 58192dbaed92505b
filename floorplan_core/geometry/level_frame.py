"""Which way is up in a cloud, from its strongest level: a smooth fit to the points themselves.

A plane is fitted to the points near it, each weighing less the farther it lies (Tukey's biweight), until
nothing moves. The end depends on the points alone, not on the axes that they are given in: a tilted copy of
a cloud has the same level, tilted. Where to begin is searched for over some degrees of tilt.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]

_LARGEST = 10_000.0  # m: points farther apart are no building, and their heights would fill the memory
_COARSE = 2_000  # points that are looked at while the start is searched for
_TILTS = ((math.radians(2.5), 4), (math.radians(1), 2), (math.radians(0.4), 2))  # step, steps to both sides
_BIN = 0.1  # m, of the heights among which a level stands out
_LEVELS = 3  # strongest levels that are compared, once each is fitted
_APART = 0.3  # m between two of them
_REACHES = (0.3, 0.2, 0.1)  # m from the level, beyond which a point has no weight: the last until it rests
_NEAR = 0.5  # m from the level: more than any point that has weight once the fit is near its end
_ROUNDS = 200
_REST = 1e-11  # change of the unit normal
_LEAST = 0.02  # of the points: less is no level
_STEEPEST = math.radians(12)  # from the file's axis: what is steeper is no tilted floor, but a slope
_SLIDE = math.radians(5)  # from the start of the fit: what turns more has slid away from its level
_FEWEST = 3.0  # sum of weights that fixes a plane


def level_rotation(points: NDArray[Any]) -> Float:
    """(3, 3) smallest rotation that makes the strongest level of (N, 3) points horizontal, else identity."""
    p = np.ascontiguousarray(points, dtype=np.float64)
    if np.ptp(p, axis=0).max() > _LARGEST:
        return np.eye(3)
    start = _start(p[:: max(1, len(p) // _COARSE)])
    found = [fit for height in _heights(p @ start) if (fit := _fit(p, start, height)) is not None]
    if not found:
        return np.eye(3)
    weight, up = max(found, key=lambda fit: fit[0])
    if weight < _LEAST * len(p) or up[2] < math.cos(_STEEPEST):
        return np.eye(3)
    return rotation_to_z(up)


def rotation_to_z(up: Float) -> Float:
    """The smallest rotation that takes the unit vector ``up`` to z (Rodrigues)."""
    axis = np.cross(up, [0.0, 0.0, 1.0])
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.asarray(np.eye(3) + K + K @ K / (1.0 + up[2]))


def _start(points: Float) -> Float:
    """Unit vector near z along which the heights of the points are most alike; ties to the smaller tilt."""
    best = np.array([0.0, 0.0, 1.0])
    for step, reach in _TILTS:
        offsets = sorted(
            ((i, j) for i in range(-reach, reach + 1) for j in range(-reach, reach + 1)),
            key=lambda o: (o[0] ** 2 + o[1] ** 2, o),
        )
        ups = best + step * np.array([(i, j, 0.0) for i, j in offsets])
        ups /= np.linalg.norm(ups, axis=1)[:, None]
        best = ups[int(np.argmax(_peakedness(points, ups, _BIN)))]
    return np.asarray(best)


def _heights(height: Float) -> list[float]:
    """Where the heights pile up, the strongest first; at most ``_LEVELS``, ``_APART`` from each other."""
    low = float(height.min()) - _BIN
    hist = np.bincount(((height - low) / (_BIN / 2)).astype(np.int64)).astype(np.float64)
    smooth = np.convolve(hist, [0.5, 1.0, 0.5], mode="same")
    levels: list[float] = []
    for k in np.argsort(-smooth, kind="stable")[: 20 * _LEVELS].tolist():
        level = low + (k + 0.5) * _BIN / 2
        if len(levels) < _LEVELS and all(abs(level - other) > _APART for other in levels):
            levels.append(level)
    return levels


def _fit(points: Float, start: Float, height: float) -> tuple[float, Float] | None:
    """Sum of weights and unit normal of the level near ``height`` along ``start``, once it rests.

    None where it comes to no rest, or slides away.
    """
    up, weight = start, 0.0
    for k in range(len(_REACHES) + _ROUNDS):
        if k == len(_REACHES):
            points = points[np.abs(points @ up - height) < _NEAR]
        sums = _weighted_moments(points, up, height, _REACHES[min(k, len(_REACHES) - 1)])
        weight = float(sums[0])
        if weight < _FEWEST:
            return None
        mean = sums[1:4] / weight
        xx, xy, xz, yy, yz, zz = sums[4:] / weight
        spread = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) - np.outer(mean, mean)
        normal = np.linalg.eigh(spread)[1][:, 0]
        normal = normal * np.copysign(1.0, normal[2])
        moved = float(np.abs(normal - up).max() + abs(normal @ mean - height))
        up, height = normal, float(normal @ mean)
        if k > len(_REACHES) and moved < _REST:
            return (weight, up) if float(up @ start) > math.cos(_SLIDE) else None
    return None


@njit(cache=True, nogil=True)
def _peakedness(points, ups, width):  # type: ignore[no-untyped-def]
    """Sum of squares of the histogram of heights along each of ``ups``, shared between bins linearly."""
    reach = 0.0
    for i in range(len(points)):
        reach = max(reach, abs(points[i, 0]) + abs(points[i, 1]) + abs(points[i, 2]))
    half = int(reach / width) + 2
    hist = np.empty(2 * half + 2)
    score = np.zeros(len(ups))
    for k in range(len(ups)):
        hist[:] = 0.0
        for i in range(len(points)):
            h = points[i, 0] * ups[k, 0] + points[i, 1] * ups[k, 1] + points[i, 2] * ups[k, 2]
            u = h / width + half
            b = int(u)
            hist[b] += 1.0 - (u - b)
            hist[b + 1] += u - b
        for b in range(len(hist)):
            score[k] += hist[b] * hist[b]
    return score


@njit(cache=True, nogil=True)
def _weighted_moments(points, up, height, reach):  # type: ignore[no-untyped-def]
    """Sums of w, w x, w y, w z, w xx, w xy, w xz, w yy, w yz, w zz with Tukey's weights of the distance."""
    out = np.zeros(10)
    for i in range(len(points)):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        d = (x * up[0] + y * up[1] + z * up[2] - height) / reach
        if -1.0 < d < 1.0:
            w = (1.0 - d * d) * (1.0 - d * d)
            out[0] += w
            out[1] += w * x
            out[2] += w * y
            out[3] += w * z
            out[4] += w * x * x
            out[5] += w * x * y
            out[6] += w * x * z
            out[7] += w * y * y
            out[8] += w * y * z
            out[9] += w * z * z
    return out

"""The yaw under which walls are sharpest: where their surfels, projected along them, fall together.

Normals tell the way roughly, and those of noisy or thin walls tell it wrong; the surfels themselves do not.
In: surfels with normals, a level frame. Out: a yaw, radians. Cost: yaws times a bounded sample.
"""

from __future__ import annotations

import math
from typing import Any, TypeVar

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import FrameConfig
from floorplan_core.geometry.cell_normals import CellNormals
from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.surfel_map import Surfels

Float = NDArray[np.float64]
Angle = TypeVar("Angle", float, NDArray[np.float64])  # radians

_SEARCH = math.radians(3)  # normals are nearly always right to this; the search for sharp walls covers it
_OFFSET_BIN = 0.02  # m, of the projection that is to be sharp
_SAMPLE = 30_000  # surfels that the search looks at
_FEW = 4_000  # surfels by which the whole circle is searched
_ROUND_STEP = math.radians(1.0)  # of that search: half of the width of a summit of walls 5 m long
_ROUND_BIN = 0.08  # m, its projection
_AS_SHARP = 0.8  # of the sharpest: a wing at another angle may be nearly as sharp as the building
_FLAT = math.sin(math.radians(60))  # upward part of the normal of a patch that is no wall
_WORTH = 200_000  # surfels, over all yaws, from which a second thread tries half of them
_TOP = 8  # steps to both sides of the sharpest yaw through which a parabola is laid
_BLOCK = 0.25  # m, side of the blocks that are sampled
_PRIMES = np.array([73_856_093, 19_349_663, 83_492_791])  # Teschner et al. 2003, hashing of space


def wrap(angle: Angle) -> Angle:
    """Angles, radians, modulo 90 degrees, in (-45, 45]."""
    quarter = math.pi / 2
    return -((-angle + quarter / 2) % quarter - quarter / 2)


def rough_yaw(surfels: Surfels, normals: CellNormals, level: Float, coarse: float) -> float:
    """``coarse``, the normals' answer, unless walls are clearly sharper elsewhere on the circle: then there.

    Noise as thick as a patch is wide leaves no planar patch in a wall but those that its cell cuts askew, and
    their normals mislead. Here every surfel counts that is not of a floor or ceiling, whatever its normal.
    """
    flat = np.append(np.abs(normals.normal @ level[2]) > _FLAT, False)[normals.cell_of]
    points = surfels.centroid[~flat]
    points = points[_spread_sample(points, max(1, len(points) // _FEW))] @ level[:2].T
    points -= points.mean(axis=0)
    yaws = np.asarray(np.arange(-math.pi / 4, math.pi / 4, _ROUND_STEP), dtype=np.float64)
    score = np.zeros(len(yaws))
    for axis in (0, 1):  # a surfel may be of a wall along either
        score += scores(points, np.full(len(points), axis, dtype=np.int8), yaws, _ROUND_BIN)
    near = score[np.abs(wrap(yaws - coarse)) < _SEARCH].max()
    return coarse if near > _AS_SHARP * score.max() else float(yaws[int(np.argmax(score))])


def sharpest_yaw(
    surfels: Surfels,
    normals: CellNormals,
    vertical: NDArray[np.bool_],
    level: Float,
    coarse: float,
    config: FrameConfig,
) -> float:
    """The yaw around ``coarse`` that concentrates the walls' offsets most."""
    n = normals.normal[vertical] @ level.T
    off = wrap(np.arctan2(n[:, 1], n[:, 0]) - coarse)
    axis_of = np.full(len(normals.weight), -1, dtype=np.int8)
    quarter = np.round((np.arctan2(n[:, 1], n[:, 0]) - coarse - off) / (math.pi / 2)).astype(int) % 2
    axis_of[vertical] = np.where(np.abs(off) < math.radians(10), quarter, -1)
    usable = np.flatnonzero(normals.cell_of >= 0)
    axis = axis_of[normals.cell_of[usable]]
    usable, axis = usable[axis >= 0], axis[axis >= 0]
    if len(usable) == 0:
        return coarse
    chosen = _spread_sample(surfels.centroid[usable], max(1, len(usable) // _SAMPLE))
    points, axis = surfels.centroid[usable[chosen]] @ level.T, axis[chosen]
    points = points[:, :2] - points[:, :2].mean(axis=0)
    yaw = coarse
    fine = math.radians(config.yaw_step_deg)
    for span, pace in ((_SEARCH, 4 * fine), (8 * fine, fine), (2 * fine, fine / 10)):
        trial = np.asarray(
            yaw + np.arange(-round(span / pace), round(span / pace) + 1) * pace, dtype=np.float64
        )
        score = scores(points, axis, trial, _OFFSET_BIN)
        yaw = float(trial[int(np.argmax(score))])
    return float(wrap(_summit(trial, score)))


def scores(points: Float, axis: NDArray[Any], yaws: NDArray[Any], width: float) -> Float:
    """How sharp the walls are under each yaw; two threads that try half of them each."""
    score = np.zeros(len(yaws))

    def part(start: int, stop: int) -> None:
        _sharpness(points, axis, yaws[start:stop], width, score[start:stop])

    in_halves(part, len(yaws), worth=max(2, _WORTH // max(len(points), 1)))
    return score


def _summit(x: Float, score: Float) -> float:
    """Where a parabola through the scores around the highest has its top: between the steps, and steady."""
    best = int(np.argmax(score))
    near = slice(max(0, best - _TOP), best + _TOP + 1)
    step = float(x[1] - x[0])
    a, b, _ = np.polyfit((x[near] - x[best]) / step, score[near] / score[best], 2)
    offset = -b / (2 * a) if a < 0 else 0.0
    return float(x[best] + step * np.clip(offset, -_TOP, _TOP))


def _spread_sample(points: Float, every: int) -> NDArray[np.bool_]:
    """(N,) one in ``every`` blocks of points, by a hash of its place: a few points more change little."""
    if every == 1:
        return np.ones(len(points), dtype=bool)
    block = np.floor(points / _BLOCK).astype(np.int64)
    mixed = (block * _PRIMES).sum(axis=1)
    return np.asarray((mixed ^ (mixed >> 15)) % every == 0)


@njit(cache=True, nogil=True)
def _sharpness(points, axis, yaws, width, score):  # type: ignore[no-untyped-def]
    """Sum of squares of the histogram of offsets, linearly shared between bins so that it varies smoothly."""
    reach = 0.0
    for i in range(len(points)):
        reach = max(reach, abs(points[i, 0]) + abs(points[i, 1]))
    half = int(reach / width) + 2
    hist = np.empty((2, 2 * half + 2))
    for k in range(len(yaws)):
        hist[:] = 0.0
        c, s = np.cos(yaws[k]), np.sin(yaws[k])
        for i in range(len(points)):
            x, y = points[i, 0], points[i, 1]
            u = (c * x + s * y if axis[i] == 0 else c * y - s * x) / width + half
            b = int(u)
            hist[axis[i], b] += 1.0 - (u - b)
            hist[axis[i], b + 1] += u - b
        for a in range(2):
            for b in range(hist.shape[1]):
                score[k] += hist[a, b] * hist[a, b]

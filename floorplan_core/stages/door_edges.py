"""The edges of doors from the points themselves: widths that do not know the histogram's bins.

Along the wall and through its whole thickness nothing stands in a door: it ends where surfaces begin over
most of the height of a body. The reveals stand there, more surface than the faces beyond; their median is the
edge. Where no reveal was seen, the edge is where the wall's face ends. The lowest surface above the passage
is the lintel. Cost: one pass over the surfels.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.boxes import index_boxes, points_in_boxes
from floorplan_core.geometry.columns import LEVEL
from floorplan_core.geometry.runs import runs_of
from floorplan_core.model import Door, LayoutPlane
from floorplan_core.model.evidence import Evidence

Float = NDArray[np.float64]

_AROUND = 0.4  # m beside an aperture in which the wall is looked for
_SKIN = 0.03  # m about the face of a wall: its own noise
_ASSUMED = 0.12  # m, thickness where only one face was seen
_BODY = (0.25, 1.85)  # m above the floor, between skirting and lintel
_ENOUGH = 6  # surfels that make a reveal
_BIN = 0.02  # m along the wall
_LEVELS = 16  # parts of the height of a body
_STANDS = 0.4  # of them seen where wall begins: less are stray points, or things beside the wall
_DENSE, _BEST = 0.4, 80  # of the points in this percentile of the bins: fewer are no wall
_LEAST = 0.4  # m, the narrowest clear width that is believed
_SOFT = 0.1  # m of wall from where it begins, in which its reveal stands
_PEAK = 0.03  # m over which a reveal is spread
_SHARP = 1.5  # times as many surfels in a reveal as in the faces of the wall beyond it


def refine_edges(
    doors: Sequence[Door], planes: Sequence[LayoutPlane], evidence: Evidence
) -> tuple[Door, ...]:
    """The doors with start, end and height measured on the surfels near them."""
    windows = np.array([_window(door) for door in doors]).reshape(-1, 4)
    index = index_boxes(windows, evidence.origin, evidence.cell, evidence.shape)
    near = points_in_boxes(evidence.xyz, index)
    facing = {p.id: p.facing for p in planes}
    signs = [0 if d.thickness > 0 else facing[d.planes[0]].sign for d in doors]
    return tuple(
        _refined(door, sign, rows, evidence) for door, sign, rows in zip(doors, signs, near, strict=True)
    )


def _window(door: Door) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 of all that is looked at for a door."""
    u0, u1 = door.offset - door.thickness / 2 - _ASSUMED, door.offset + door.thickness / 2 + _ASSUMED
    v0, v1 = door.start - _AROUND, door.end + _AROUND
    return (u0, v0, u1, v1) if door.axis == 0 else (v0, u0, v1, u1)


def _refined(door: Door, sign: int, rows: NDArray[np.int64], evidence: Evidence) -> Door:
    half = door.thickness / 2
    depth = (-half, half) if sign == 0 else (min(0.0, -sign * _ASSUMED), max(0.0, -sign * _ASSUMED))
    grid = evidence.free, evidence.origin, evidence.cell
    at = door.axis, door.offset, *depth, half + 0.05
    wall, inner, above = _told_apart(evidence.xyz, evidence.count, rows, *grid, *at)
    stands = _stands(wall[:, 0] - door.start + _AROUND, wall[:, 1], wall[:, 2], _bins(door))
    start, end = _clear_width(stands, inner, door.start, door.end)
    lintel = above[(above[:, 0] > start + 0.08) & (above[:, 0] < end - 0.08), 1]
    height = float(np.percentile(lintel, 3)) if len(lintel) >= _ENOUGH else None
    return replace(door, start=start, end=end, height=height)


@njit(cache=True, nogil=True)
def _told_apart(xyz, count, rows, free, origin, cell, axis, offset, near, far, reach):  # type: ignore[no-untyped-def]
    """Of the surfels in ``rows``: along, height and count of those of the wall at the height of a body; along
    of those between its faces; along and height of those above, within ``reach`` of its middle.

    :param near: and ``far``: metres of the two faces from ``offset``.
    """
    wall, inner, above = np.empty((len(rows), 3)), np.empty(len(rows)), np.empty((len(rows), 2))
    walls, inners, aboves = 0, 0, 0
    for row in rows:
        u, v, z = xyz[row, axis] - offset, xyz[row, 1 - axis], xyz[row, 2]
        if z > _BODY[1]:
            if abs(u) < reach:
                above[aboves, 0], above[aboves, 1] = v, z
                aboves += 1
        elif _BODY[0] < z < _BODY[1] and _is_solid(xyz[row], free, origin, cell):
            if near - _SKIN < u < far + _SKIN:
                wall[walls, 0], wall[walls, 1], wall[walls, 2] = v, z, count[row]
                walls += 1
            if near + _SKIN < u < far - _SKIN:
                inner[inners] = v
                inners += 1
    return wall[:walls], inner[:inners], above[:aboves]


@njit(cache=True, nogil=True)
def _is_solid(at, free, origin, cell):  # type: ignore[no-untyped-def]
    """False for a surfel where rays passed: range sensors mix what lies before and behind an edge."""
    ix, iy = int((at[0] - origin[0]) / cell), int((at[1] - origin[1]) / cell)
    if ix < 0 or iy < 0 or ix >= free.shape[1] or iy >= free.shape[0]:
        return True
    level = np.uint64(min(max(at[2] / LEVEL, 0.0), 63.0))
    return (free[iy, ix] >> level) & np.uint64(1) == 0


def _bins(door: Door) -> int:
    """Bins along a door and what is around it."""
    return round((door.width + 2 * _AROUND) / _BIN)


def _clear_width(stands: NDArray[np.bool_], inner: Float, start: float, end: float) -> tuple[float, float]:
    """Where wall begins on both sides of an aperture; its own edge where none was seen within reach.

    :param stands: (B,) where wall stands, from ``_AROUND`` before ``start`` on.
    :param inner: (N,) metres along the wall of the surfels between its faces.
    """
    runs = start - _AROUND + _BIN * runs_of(~stands)
    shared = np.minimum(runs[:, 1], end) - np.maximum(runs[:, 0], start)
    if not len(runs) or shared.max() < _LEAST:
        return start, end
    low, high = runs[int(np.argmax(shared))]  # ties: the first
    first, last = start - _AROUND, start - _AROUND + _BIN * len(stands)
    low = start if low <= first else low - _jamb(low - inner, low - start)
    high = end if high >= last - _BIN / 2 else high + _jamb(inner - high, end - high)
    return (float(low), float(high)) if high - low > _LEAST else (start, end)


def _stands(v: Float, z: Float, count: Float, bins: int) -> NDArray[np.bool_]:
    """(bins,) True where surfaces were seen over much of a body's height; ``v`` counts from the first."""
    seen = np.zeros((bins + 1, _LEVELS), dtype=bool)
    along = np.floor(v / _BIN).astype(int)
    up = ((z - _BODY[0]) / (_BODY[1] - _BODY[0]) * _LEVELS).astype(int)
    inside = (along >= 0) & (along < bins)
    seen[along[inside], np.minimum(up[inside], _LEVELS - 1)] = True
    near = seen[:-1] | seen[1:] | np.vstack([seen[:1], seen[:-2]])
    levels = near.sum(axis=1)
    return np.asarray(levels >= _STANDS * _LEVELS) & _is_dense(along[inside], count[inside], bins)


def _is_dense(along: NDArray[np.int64], count: Float, bins: int) -> NDArray[np.bool_]:
    """(bins,) True where about as many points lie as where the wall was seen best."""
    points = np.convolve(np.bincount(along, weights=count, minlength=bins), np.ones(3), mode="same")
    return np.asarray(points >= _DENSE * np.percentile(points, _BEST))


def _jamb(depth: Float, edge: float) -> float:
    """Metres from the first solid bin into the wall at which its reveal stands.

    :param depth: (N,) metres of the surfels into the wall, from the side of the opening.
    :param edge: where the aperture was thought to end; taken where no reveal, only faces were seen.
    """
    near = np.sort(depth[(depth > -_BIN) & (depth < _SOFT)])
    if len(near) < _ENOUGH:
        return float(np.clip(edge, 0.0, _SOFT))
    count = np.searchsorted(near, near + _PEAK) - np.arange(len(near))
    first = int(np.argmax(count))
    face = np.count_nonzero((depth > _SOFT) & (depth < 2 * _SOFT)) * _PEAK / _SOFT
    if count[first] >= _ENOUGH and count[first] > _SHARP * face:
        return float(np.median(near[first : first + int(count[first])]))
    return float(np.clip(edge, 0.0, _SOFT))

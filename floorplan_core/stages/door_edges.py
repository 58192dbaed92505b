"""The edges of doors from the points themselves: widths that do not know the histogram's bins.

Inside the thickness of a wall the only surfaces are the reveals of its openings: they face each other across
the door, and their median is its edge. Where none was seen, the edge is where the wall's face ends. The
lowest surface above the passage is the lintel. Cost: one pass over the surfels.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.model import Door, LayoutPlane
from floorplan_core.model.evidence import Evidence

Float = NDArray[np.float64]

_AROUND = 0.25  # m beside an edge in which its reveal is looked for
_SKIN = 0.025  # m below the face of a wall where its own noise ends
_ASSUMED = 0.12  # m, thickness where only one face was seen
_BODY = (0.25, 1.85)  # m above the floor, between skirting and lintel
_ENOUGH = 6  # surfels that make a reveal


def refine_edges(
    doors: Sequence[Door], planes: Sequence[LayoutPlane], evidence: Evidence
) -> tuple[Door, ...]:
    """The doors with start, end and height measured on the surfels near them."""
    near = points_in_boxes(evidence, np.array([_window(door) for door in doors]).reshape(-1, 4))
    facing = {p.id: p.facing for p in planes}
    signs = [0 if d.thickness > 0 else facing[d.planes[0]].sign for d in doors]
    return tuple(
        _refined(door, sign, evidence.xyz[rows]) for door, sign, rows in zip(doors, signs, near, strict=True)
    )


def points_in_boxes(evidence: Evidence, boxes: Float) -> list[NDArray[np.int64]]:
    """For each of the (K, 4) boxes x0, y0, x1, y1 (metres) the rows of the surfels in it, in order."""
    if not len(boxes):
        return []
    ny, nx = evidence.shape
    owner, index = _collect(evidence.xyz, boxes, evidence.origin, evidence.cell, ny, nx)
    order = np.argsort(owner, kind="stable")
    bounds = np.searchsorted(owner[order], np.arange(len(boxes) + 1))
    return [index[order[a:b]] for a, b in pairwise(bounds)]


def _window(door: Door) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 of all that is looked at for a door."""
    u0, u1 = door.offset - door.thickness / 2 - _ASSUMED, door.offset + door.thickness / 2 + _ASSUMED
    v0, v1 = door.start - _AROUND, door.end + _AROUND
    return (u0, v0, u1, v1) if door.axis == 0 else (v0, u0, v1, u1)


@njit(cache=True, nogil=True)
def _collect(xyz, boxes, origin, cell, ny, nx):  # type: ignore[no-untyped-def]
    """Points in boxes: the box and the point of each hit. A grid of marked cells answers for most points."""
    marked = np.zeros((ny, nx), dtype=np.bool_)
    for b in range(len(boxes)):
        for iy in range(
            max(0, int((boxes[b, 1] - origin[1]) / cell)), min(ny, int((boxes[b, 3] - origin[1]) / cell) + 1)
        ):
            for ix in range(
                max(0, int((boxes[b, 0] - origin[0]) / cell)),
                min(nx, int((boxes[b, 2] - origin[0]) / cell) + 1),
            ):
                marked[iy, ix] = True
    owner, index = [0], [0]
    for i in range(len(xyz)):
        ix, iy = int((xyz[i, 0] - origin[0]) / cell), int((xyz[i, 1] - origin[1]) / cell)
        if not (0 <= ix < nx and 0 <= iy < ny) or not marked[iy, ix]:
            continue
        for b in range(len(boxes)):
            if boxes[b, 0] <= xyz[i, 0] <= boxes[b, 2] and boxes[b, 1] <= xyz[i, 1] <= boxes[b, 3]:
                owner.append(b)
                index.append(i)
    return np.array(owner[1:]), np.array(index[1:])


def _refined(door: Door, sign: int, xyz: Float) -> Door:
    u, v, z = xyz[:, door.axis] - door.offset, xyz[:, 1 - door.axis], xyz[:, 2]
    half = door.thickness / 2
    depth = (-half, half) if sign == 0 else (min(0.0, -sign * _ASSUMED), max(0.0, -sign * _ASSUMED))
    within = (u > depth[0] + _SKIN) & (u < depth[1] - _SKIN)
    body = (z > _BODY[0]) & (z < _BODY[1])
    start = _reveal(v[within & body], door.start)
    end = _reveal(v[within & body], door.end)
    if end - start < 0.3:
        start, end = door.start, door.end
    middle = (v > start + 0.08) & (v < end - 0.08) & (np.abs(u) < half + 0.05) & (z > _BODY[1])
    height = float(np.percentile(z[middle], 3)) if middle.sum() >= _ENOUGH else None
    return replace(door, start=start, end=end, height=height)


def _reveal(v: Float, edge: float) -> float:
    """The median of the densest 3 cm of the surfaces within reach of an edge; the edge if there are none."""
    near = np.sort(v[np.abs(v - edge) < _AROUND])
    if len(near) < _ENOUGH:
        return edge
    count = np.searchsorted(near, near + 0.03) - np.arange(len(near))
    first = int(np.argmax(count))
    return float(np.median(near[first : first + int(count[first])])) if count[first] >= _ENOUGH else edge

"""Shut doors: leaves that stand back from the face of their wall, under its lintel and between its jambs.

In: planes, the voxel columns and the surfels. Out: doors whose evidence says "shut". Nothing passes a shut
door, so the aperture detectors see wall; but a leaf is thinner than its wall and set back from one of its
faces. A recess is told from the wall's other face, seen through a gap in the data, by the side from which its
points were seen; from a window by standing back down to the floor; from a set-back wall by width and lintel.
Without viewpoints nothing can be said. Cost: a few rows of the columns a plane, one pass over the surfels.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.geometry.columns import count_bits, height_mask, levels_in_any
from floorplan_core.geometry.runs import runs_of
from floorplan_core.model import Door, LayoutPlane
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.door_edges import points_in_boxes

Float = NDArray[np.float64]

_LEAF = (0.3, 1.8)  # m above the floor, where a leaf and no lintel is
_FOOT = (0.1, 0.3)  # m above the floor, where a leaf stands back and the sill of a window does not
_LINTEL = (2.2, 2.5)  # m above the floor: above a door
_DEPTH = (0.055, 0.17)  # m behind the face at which a leaf hangs
_SKIN = 0.03  # m about the face: the noise of the wall itself
_GONE, _THERE = 0.25, 0.5  # share of the heights that are seen, where a surface is not and where it is
_FLANK, _JAMB = 0.3, 0.15  # m beside the leaf in which that much wall must stand
_WIDEST = 1.8  # m, a double door
_SIDEWAYS = 0.2  # cosine of the steepest view that still tells from which side a point was seen
_FLAT = 0.025  # m, spread of a leaf's points across it
_COVERED = 0.7  # share of a leaf's width at which such points lie
_UNDER = 0.5  # share of its width over which the lintel was seen
CONFIDENCE = 0.8
WORDS = ("shut", "recess", "lintel", "wall on both sides")


def find_shut_doors(
    planes: Sequence[LayoutPlane], evidence: Evidence, doors: Sequence[Door], config: DoorsConfig
) -> list[Door]:
    """The shut doors where none of ``doors`` is, by plane and start; none where there are no viewpoints."""
    if not evidence.viewpoints:
        return []
    found: list[tuple[LayoutPlane, float, float]] = []
    for plane in planes:
        for start, end in _recesses(plane, evidence, config):
            taken = [(d.axis, d.offset, d.start, d.end) for d in doors]
            taken += [(p.facing.axis, p.offset, s, e) for p, s, e in found]
            if not any(_same(plane, start, end, *other, config.max_thickness) for other in taken):
                found.append((plane, start, end))
    boxes = np.array([_box(plane, start, end) for plane, start, end in found]).reshape(-1, 4)
    leaves = points_in_boxes(evidence, boxes)
    made = (_leaf(*place, evidence, rows) for place, rows in zip(found, leaves, strict=True))
    return [door for door in made if door is not None]


def _same(
    plane: LayoutPlane, start: float, end: float, axis: int, at: float, low: float, high: float, near: float
) -> bool:
    """True where an opening that is known lies in the same wall and place."""
    shared = min(end, high) - max(start, low)
    return plane.facing.axis == axis and abs(plane.offset - at) <= near and shared > 0


def _seen(
    plane: LayoutPlane, evidence: Evidence, depth: tuple[float, float], heights: tuple[float, float]
) -> Float:
    """(bins,) 0 to 1: share of ``heights`` at which a surface was seen, ``depth`` metres behind the face."""
    axis = plane.facing.axis
    hits = evidence.hits if axis == 0 else evidence.hits.T
    ends = plane.offset - plane.facing.sign * np.array(depth)
    low, high = np.floor((np.sort(ends) - evidence.origin[axis]) / evidence.fine).astype(int)
    mask = height_mask(*heights)
    seen = levels_in_any(hits, range(max(low, 0), min(max(high, 0) + 1, hits.shape[1]))) & mask
    share: Float = count_bits(seen) / int(mask).bit_count()
    return share


def _recesses(plane: LayoutPlane, evidence: Evidence, config: DoorsConfig) -> list[tuple[float, float]]:
    """(start, end) metres along the plane where its face stands back between jambs and under a lintel."""
    fine = evidence.fine
    base = float(evidence.origin[1 - plane.facing.axis])
    face = _seen(plane, evidence, (-_SKIN, _SKIN), _LEAF)
    back = _seen(plane, evidence, _DEPTH, _LEAF)
    above = _seen(plane, evidence, (-_SKIN, _SKIN), _LINTEL) > 0
    foot = _seen(plane, evidence, (-_SKIN, _SKIN), _FOOT)
    flank, jamb = round(_FLANK / fine), round(_JAMB / fine)
    out = []
    for a, b in runs_of(face < _GONE).tolist():
        fits = config.min_width <= (b - a) * fine <= _WIDEST
        if not fits or (back[a:b] > _THERE).mean() < _COVERED or above[a:b].mean() < _UNDER:
            continue
        if foot[a:b].mean() > _GONE:
            continue  # a window, glazed nearly to the floor
        beside = face[max(0, a - flank) : a], face[b : b + flank]
        if min((side > _THERE).sum() for side in beside) >= jamb:
            out.append((base + a * fine, base + b * fine))
    return out


def _box(plane: LayoutPlane, start: float, end: float) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 of where the leaf must be."""
    u0, u1 = sorted(plane.offset - plane.facing.sign * np.array(_DEPTH))
    return (u0, start, u1, end) if plane.facing.axis == 0 else (start, u0, end, u1)


def _leaf(
    plane: LayoutPlane, start: float, end: float, evidence: Evidence, rows: NDArray[np.int64]
) -> Door | None:
    """The door, if a flat surface seen from the plane's own side fills the recess."""
    axis, sign = plane.facing.axis, plane.facing.sign
    xyz, toward = evidence.xyz[rows], evidence.view[rows, axis] * sign
    mine = xyz[(toward > _SIDEWAYS) & (xyz[:, 2] > _LEAF[0]) & (xyz[:, 2] < _LEAF[1])]
    bins = np.unique(((mine[:, 1 - axis] - start) / evidence.fine).astype(int))
    if len(bins) < _COVERED * (end - start) / evidence.fine or float(np.std(mine[:, axis])) > _FLAT:
        return None
    return Door("", (plane.id,), axis, plane.offset, start, end, confidence=CONFIDENCE, evidence=WORDS)

"""Floor and ceiling of models of closed solids, whose slabs show both faces: the inner ones bound the rooms.

A scan sees a place's floor at one height, so two full levels over the same cells, with nothing in between,
are the faces of a slab. A step, a platform or a lowered ceiling lies over other cells, furniture over few,
and noise leaves no gap. Cost: linear in the surfels near the two levels.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.surfel_map import Surfels

Float = NDArray[np.float64]

_THICKNESS = (0.08, 0.6)  # m, of slabs with what lies on them and hangs from them
_STEP, _HALF = 0.01, 0.03  # m between the heights that are tried; half the thickness of a level
_GAP = (
    0.25  # of the weaker face, in a layer of the same thickness between the two: walls have less, noise more
)
_CELL = 0.5  # m, cells of the plan: wider than the steps at which points lie
_SAME = 0.8  # of the cells of either face that hold the other, too: shafts and stairs open slabs


def inner_faces(
    surfels: Surfels, rotation: Float, floor: float, ceiling: float | None
) -> tuple[float, float | None]:
    """``floor`` and ``ceiling`` (metres, manhattan frame), or the other faces of their slabs within.

    Where the sensor's places are known the outer faces were not seen, and a second floor is drift.
    """
    if surfels.view.any():
        return floor, ceiling
    xyz = surfels.centroid @ rotation.T
    cell = _CELL * surfels.every  # of a sample of blocks the two faces may be in different ones
    inner = floor + _other_face(xyz, floor, 1, cell)
    if ceiling is None:
        return inner, None
    return inner, ceiling - _other_face(xyz, ceiling, -1, cell)


def _other_face(xyz: Float, level: float, inwards: int, cell: float) -> float:
    """Metres from ``level`` to the other face of its slab, 0 where it has none."""
    depth = inwards * (xyz[:, 2] - level)
    near = (depth > -_HALF) & (depth < _THICKNESS[1] + _HALF)
    depth, order = depth[near], np.argsort(depth[near], kind="stable")
    depths = depth[order]

    def count(at: Float) -> NDArray[np.int64]:
        ends = np.searchsorted(depths, [at - _HALF, at + _HALF])
        return np.asarray(ends[1] - ends[0])

    tried = np.arange(_THICKNESS[0], _THICKNESS[1], _STEP)
    counts = count(tried)
    best = float(tried[np.argmax(counts)])  # the first of equals
    between = count(np.arange(_HALF, best - _HALF + _STEP / 2, _STEP))
    if between.min(initial=counts.max()) > _GAP * min(int(counts.max()), int(count(np.zeros(1))[0])):
        return 0.0
    place = np.floor(xyz[near, :2] / cell).astype(np.int64)
    one, two = (np.unique(place[np.abs(depth - d) < _HALF], axis=0) for d in (0.0, best))
    both = len(one) + len(two) - len(np.unique(np.concatenate([one, two]), axis=0))
    if both < _SAME * max(len(one), len(two)):
        return 0.0
    return float(np.median(depth[np.abs(depth - best) < _HALF]))

"""A thinned top view of the observed points for pictures: the paper's figure (a)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from floorplan_core.geometry.columns import LEVEL, count_bits
from floorplan_core.model import LayoutSegment, WallPoints
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.layout_segments import wall_band

_LEVELS = 2  # of a column that were hit: one may be a stray point
_NEAR = 0.08  # m between a column and the segment that explains it


def thin_wall_points(evidence: Evidence, segments: Sequence[LayoutSegment]) -> WallPoints:
    """One point for each column with a vertical surface or an object above the floor."""
    bits = evidence.hits & wall_band(evidence)
    at = np.flatnonzero(count_bits(bits) >= _LEVELS)
    (iy, ix), word = np.divmod(at, bits.shape[1]), bits.ravel()[at]
    xy = np.empty((len(ix), 2), dtype=np.float32)
    for k, cells in enumerate((ix, iy)):
        xy[:, k] = evidence.origin[k] + (cells + 0.5) * evidence.fine
    top = (np.floor(np.log2(word.astype(np.float64))) + 1) * LEVEL
    facing = np.full(evidence.hits.shape, -1, dtype=np.int8)
    for s in segments:
        if not s.plane:
            continue
        a = s.facing.axis
        grid = facing if a == 0 else facing.T
        u = [int((s.offset + d - evidence.origin[a]) / evidence.fine) for d in (-_NEAR, _NEAR)]
        v = [int((e - evidence.origin[1 - a]) / evidence.fine) for e in (s.start, s.end)]
        grid[max(v[0], 0) : v[1] + 1, max(u[0], 0) : u[1] + 1] = int(s.facing)
    return WallPoints(xy, top.astype(np.float32), facing[iy, ix])

"""A thinned top view of the observed points for pictures: the paper's figure (a)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.columns import LEVEL, by_strips
from floorplan_core.model import LayoutSegment, WallPoints
from floorplan_core.model.evidence import Evidence
from floorplan_core.model.layout import turned
from floorplan_core.stages.layout_segments import wall_band

_LEVELS = 2  # of a column that were hit: one may be a stray point
_NEAR = 0.08  # m between a column and the segment that explains it


def thin_wall_points(evidence: Evidence, segments: Sequence[LayoutSegment]) -> WallPoints:
    """One point for each column with a vertical surface or an object above the floor.

    :param segments: those of wings too, each in its own axes.
    """
    band = wall_band(evidence)
    at = np.flatnonzero(by_strips(evidence.hits, lambda hits: np.bitwise_count(hits & band) >= _LEVELS))
    (iy, ix), word = np.divmod(at, evidence.hits.shape[1]), evidence.hits.ravel()[at] & band
    xy = np.empty((len(ix), 2), dtype=np.float32)
    for k, cells in enumerate((ix, iy)):
        xy[:, k] = evidence.origin[k] + (cells + 0.5) * evidence.fine
    top = (np.floor(np.log2(word.astype(np.float64))) + 1) * LEVEL
    facing = np.full(evidence.hits.shape, -1, dtype=np.int8)
    for s in segments:
        if not s.plane or s.turn:
            continue
        a = s.facing.axis
        grid = facing if a == 0 else facing.T
        u = [int((s.offset + d - evidence.origin[a]) / evidence.fine) for d in (-_NEAR, _NEAR)]
        v = [int((e - evidence.origin[1 - a]) / evidence.fine) for e in (s.start, s.end)]
        grid[max(v[0], 0) : v[1] + 1, max(u[0], 0) : u[1] + 1] = int(s.facing)
    seen = facing[iy, ix]
    for s in segments:
        if s.plane and s.turn:
            _explain(seen, xy, s)
    return WallPoints(xy, top.astype(np.float32), seen)


def _explain(facing: NDArray[np.int8], xy: NDArray[np.float32], segment: LayoutSegment) -> None:
    """Note the facing of a segment of a wing at the points (N, 2) near it that no other explains."""
    own = turned(xy.astype(np.float64), -segment.turn)
    a = segment.facing.axis
    near = np.abs(own[:, a] - segment.offset) <= _NEAR
    near &= (own[:, 1 - a] >= segment.start) & (own[:, 1 - a] <= segment.end)
    facing[near & (facing < 0)] = int(segment.facing)

"""Model selection: the minimum set of planes that explains all segments (SL-LMS, with the poses held fixed).

With given poses every segment of one facing is an interval of offsets in which its plane must lie; the fewest
planes are the fewest points that pierce all intervals, which a sweep over their right ends finds exactly in
O(n log n). Where the trajectory drifts, :mod:`floorplan_core.drift` corrects it first (SL-LMS proper).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


def pierce_intervals(low: Float, high: Float) -> NDArray[np.int64]:
    """(N,) group of each interval [low, high]; the number of groups is the smallest possible.

    Groups are numbered by offset. A group's intervals share a common point.
    """
    group = np.full(len(low), -1, dtype=np.int64)
    point, current = -np.inf, -1
    for i in np.lexsort((low, high)):
        if low[i] > point:  # not pierced yet: the last point that can pierce it is its right end
            point = high[i]
            current += 1
        group[i] = current
    return group

"""What no valid rectangle covers: planes at the edge of what was seen, so that no room is silently lost.

A room with an unseen side is covered only if another plane of the building can stand in (the paper's rooms 6
and 7). Where none can, a speculated plane is put at the frontier of each uncovered patch of free space, and the
patch is covered with its help. What even then stays uncovered is reported by the cover.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import Facing, LayoutPlane, OccupancyGrid

_LEAST = 0.6  # m of straight frontier that is worth a plane


def frontier_planes(
    uncovered: NDArray[np.bool_], grid: OccupancyGrid, planes: Sequence[LayoutPlane]
) -> tuple[LayoutPlane, ...]:
    """Speculated planes along the straight frontiers of the uncovered patches, where no plane of that facing is near."""
    least = max(1, round(_LEAST / grid.cell))
    out: list[LayoutPlane] = []
    for facing in Facing:
        cells = uncovered if facing.axis == 0 else uncovered.T
        ahead = np.pad(cells, ((0, 0), (1, 1)))
        edge = cells & ~(ahead[:, :-2] if facing.sign > 0 else ahead[:, 2:])
        length = edge.sum(axis=0)
        taken = [p.offset for p in planes if p.facing == facing]
        for column in np.argsort(-length, kind="stable"):
            if length[column] < least:
                break
            offset = float(grid.origin[facing.axis] + (column + (0 if facing.sign > 0 else 1)) * grid.cell)
            if not any(abs(offset - other) < 2.5 * grid.cell for other in taken):
                taken.append(offset)
                out.append(LayoutPlane(f"q{len(out) + 1}", facing, offset, speculated=True))
    return tuple(out)

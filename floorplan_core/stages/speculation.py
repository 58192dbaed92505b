"""What no valid rectangle covers: planes at the edge of what was seen, so that no room is silently lost.

A room with an unseen side is covered only if another plane of the building can stand in (the paper's rooms 6
and 7). Where none can, a speculated plane is put at the frontier of each uncovered patch of free space, and
the patch is covered with its help. What even then stays uncovered is reported by the cover.
"""

from __future__ import annotations

from bisect import bisect
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import CandidatesConfig, Config
from floorplan_core.model import Facing, LayoutPlane, OccupancyGrid, RectangleCover
from floorplan_core.stages.candidates import pair_planes
from floorplan_core.stages.set_cover import cover as cover_free_space

_SITE = 20_000.0  # m2, for so much of a site the greatest number of valid rectangles holds
_LEAST = 0.6  # m of straight frontier that is worth a plane
_REACH = 4  # cells between the end of a wall and an uncovered cell


def cover_the_rest(
    planes: tuple[LayoutPlane, ...],
    paired: Sequence[LayoutPlane],
    walls: NDArray[np.float64],
    cover: RectangleCover,
    grid: OccupancyGrid,
    config: Config,
) -> tuple[tuple[LayoutPlane, ...], RectangleCover]:
    """Cover what is left with the help of speculated planes; the planes used join the others.

    No plane is speculated where one was switched off by hand.
    """
    refused = [p for p in planes if p.by_hand == "hidden"]
    extra = frontier_planes(cover.uncovered, grid, [*paired, *refused], walls)
    if not extra:
        return planes, cover
    rest = replace(grid, universe=cover.uncovered)
    narrow = for_site(config.candidates, grid).model_copy(
        update={"min_side": config.candidates.min_rest_side}
    )
    more = cover_free_space(pair_planes([*paired, *extra], walls, rest, narrow), rest, config.cover)
    joined = RectangleCover(
        np.concatenate([cover.chosen, np.full(len(more), -1, dtype=np.int64)]),
        np.concatenate([cover.bounds, more.bounds]),
        np.concatenate([cover.total_cells, more.total_cells]),
        np.concatenate([cover.free_cells, more.free_cells]),
        np.concatenate([cover.gained, more.gained]),
        more.uncovered,
    )
    used = {round(float(v), 9) for v in more.bounds.ravel()}
    return (*planes, *(p for p in extra if round(p.offset, 9) in used)), joined


def for_site(config: CandidatesConfig, grid: OccupancyGrid) -> CandidatesConfig:
    """The settings, where more rectangles may be valid on a site of many buildings."""
    x0, y0, x1, y1 = grid.extent
    share = max(1.0, (x1 - x0) * (y1 - y0) / _SITE)
    return config.model_copy(update={"max_count": round(config.max_count * share)})


def frontier_planes(
    uncovered: NDArray[np.bool_],
    grid: OccupancyGrid,
    planes: Sequence[LayoutPlane],
    walls: NDArray[np.float64],
) -> tuple[LayoutPlane, ...]:
    """Speculated planes on the straight frontiers of the uncovered patches and at the wall ends beside them.

    :param walls: (B, 4) blockers; a wall that ends in the open keeps rectangles from passing its end.
    """
    out: list[LayoutPlane] = []
    for facing in Facing:
        taken = sorted(p.offset for p in planes if p.facing == facing)
        for offset in (*_frontiers(uncovered, grid, facing), *_wall_ends(uncovered, grid, facing, walls)):
            at = bisect(taken, offset)
            if not any(abs(offset - other) < 2.5 * grid.cell for other in taken[max(at - 1, 0) : at + 1]):
                taken.insert(at, offset)
                out.append(LayoutPlane(f"q{len(out) + 1}", facing, offset, speculated=True))
    return tuple(out)


def _frontiers(uncovered: NDArray[np.bool_], grid: OccupancyGrid, facing: Facing) -> list[float]:
    """Offsets of the straight edges of the patches, longest first."""
    cells = uncovered if facing.axis == 0 else uncovered.T
    ahead = np.pad(cells, ((0, 0), (1, 1)))
    length = (cells & ~(ahead[:, :-2] if facing.sign > 0 else ahead[:, 2:])).sum(axis=0)
    order = np.argsort(-length, kind="stable")
    order = order[length[order] >= max(1, round(_LEAST / grid.cell))]
    return [float(grid.origin[facing.axis] + (c + (facing.sign < 0)) * grid.cell) for c in order]


def _wall_ends(
    uncovered: NDArray[np.bool_], grid: OccupancyGrid, facing: Facing, walls: NDArray[np.float64]
) -> list[float]:
    """Ends of the walls across the facing that lie within reach of an uncovered cell."""
    a = facing.axis
    ends = []
    for box in walls:
        if box[a + 2] - box[a] <= box[3 - a] - box[1 - a]:
            continue  # this wall does not run across the facing
        for end in (box[a], box[a + 2]):
            point = np.array([end, box[1 - a]] if a == 0 else [box[1 - a], end])
            i, j = ((point - grid.origin) / grid.cell).astype(int)
            if uncovered[max(j - _REACH, 0) : j + _REACH + 1, max(i - _REACH, 0) : i + _REACH + 1].any():
                ends.append(float(end))
    return sorted(set(ends))

"""What bounds one space of a map, as the other stages take it: planes, blockers and a grid of its own.

In: the spaces, their boundary and the layout planes. Out: a :class:`SpaceProblem` for each space. Passages
and other spaces are walls to it, so that its rectangles cannot leak; a passage that is a straight side closes
it like a plane. :func:`join_candidates` and :func:`join_covers` make one set of them for the whole map.
Cost: linear in the cells around the space.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.geometry.raster import polygon_window
from floorplan_core.model import (
    FREE,
    OCCUPIED,
    CandidateSet,
    Facing,
    LayoutPlane,
    LayoutSegment,
    OccupancyGrid,
    RectangleCover,
    Region,
)
from floorplan_core.stages.grid_map_walls import Boundary
from floorplan_core.stages.region_confidence import measures_of, share_seen

Float = NDArray[np.float64]
Int = NDArray[np.int64]
Bool = NDArray[np.bool_]
Labels = NDArray[np.int32]

_MARGIN = 0.5  # m of map around a space
_INSIDE = 0.15  # m off its sides, a region must not hold walls or other spaces


@dataclass(frozen=True)
class SpaceProblem:
    """One space, ready for candidates, cover and regions."""

    number: int  # label of the space
    window: tuple[slice, slice]  # rows and columns of the map that ``grid`` and ``mask`` show
    grid: OccupancyGrid  # the surroundings; universe: free cells of the space
    mask: Bool  # cells of the space, furniture included
    alien: Bool  # cells that belong to walls or to other spaces
    segments: tuple[LayoutSegment, ...]
    planes: tuple[LayoutPlane, ...]  # of its segments, and speculated ones across its passages
    walls: Float  # (B, 4) blockers


def space_problems(
    spaces: Labels,
    floor: Bool,
    grid: OccupancyGrid,
    boundary: Boundary,
    segments: Sequence[LayoutSegment],
    rows: Int,
    planes: Sequence[LayoutPlane],
    config: Config,
) -> list[SpaceProblem]:
    """All spaces in the order of their numbers; ``rows`` are the boundary's pieces behind ``segments``."""
    from scipy.ndimage import find_objects

    plane_of = {p.id: p for p in planes}
    space_of = boundary.space[rows]
    out = []
    for number, box in enumerate(find_objects(spaces), start=1):
        mine = boundary.take(boundary.space == number)
        own = tuple(segments[int(k)] for k in np.flatnonzero(space_of == number))
        names = dict.fromkeys(s.plane for s in own)
        window = _around(box, spaces.shape, grid.cell)
        mask = spaces[window] == number
        local = OccupancyGrid(
            grid.origin + grid.cell * np.array([window[1].start, window[0].start]),
            grid.cell,
            grid.states[window],
            mask & (grid.states[window] == FREE),
            grid.slice_height,
        )
        alien = ~mask & (floor[window] | (grid.states[window] == OCCUPIED))
        solid = [plane_of[name] for name in names]
        walls = mine.take(mine.bounds_space).boxes()
        closers = (*solid, *_passage_planes(number, mine, solid, grid.cell, config))
        out.append(SpaceProblem(number, window, local, mask, alien, own, closers, walls))
    return out


def _around(box: tuple[slice, slice], shape: tuple[int, ...], cell: float) -> tuple[slice, slice]:
    margin = round(_MARGIN / cell)
    rows, columns = (
        slice(max(s.start - margin, 0), min(s.stop + margin, n)) for s, n in zip(box, shape, strict=True)
    )
    return rows, columns


def _passage_planes(
    number: int, mine: Boundary, solid: Sequence[LayoutPlane], cell: float, config: Config
) -> list[LayoutPlane]:
    """Planes across the passages of a space, where no wall lies in the same line."""
    out: list[LayoutPlane] = []
    rows = (mine.open > mine.wall) & mine.bounds_space & (mine.length >= config.segments.min_length)
    for k in np.flatnonzero(rows):
        facing, offset = Facing(int(mine.facing[k])), float(mine.offset[k])
        if not any(p.facing == facing and abs(p.offset - offset) <= 2 * cell for p in (*solid, *out)):
            out.append(LayoutPlane(f"o{number}.{len(out) + 1}", facing, offset, speculated=True))
    return out


def explained(region: Region, problem: SpaceProblem) -> float:
    """0 to 1: how well a region agrees with its space: it covers the space's cells and spares all others."""
    grid = problem.grid
    window, inside = polygon_window(region.polygon, grid.origin, grid.cell, grid.states.shape)
    covered = _share(inside & problem.mask[window], problem.mask)
    core = shapely.buffer(region.polygon, -_INSIDE, join_style="mitre")
    window, deep = polygon_window(core, grid.origin, grid.cell, grid.states.shape)
    return min(covered, 1.0 - _share(deep & problem.alien[window], deep))


def _share(part: Bool, whole: Bool) -> float:
    return int(np.count_nonzero(part)) / max(int(np.count_nonzero(whole)), 1)


def join_candidates(sets: Sequence[CandidateSet]) -> CandidateSet:
    """The candidates of all spaces over the planes of all spaces, in the order of the spaces.

    What are neighbouring planes to one space may have those of others between them: each rectangle becomes a
    family of its own.
    """
    names = ("x_plus", "x_minus", "y_plus", "y_minus")
    planes = [np.unique(np.concatenate([np.zeros(0), *(getattr(s, n) for s in sets)])) for n in names]
    index = [
        np.column_stack(
            [np.searchsorted(planes[a], getattr(s, names[a]))[s.index()[:, a]] for a in (0, 1, 2, 3)]
        )
        for s in sets
    ]
    i0, i1, j0, j1 = np.concatenate([np.zeros((0, 4), dtype=np.int64), *index]).T
    return CandidateSet(
        x_plus=planes[0],
        x_minus=planes[1],
        y_plus=planes[2],
        y_minus=planes[3],
        families=np.column_stack([i0, j0, i1, i1 + 1, j1, j1 + 1]).astype(np.int32),
        enumerated=int(np.prod([len(p) for p in planes], dtype=object)),
    )


def join_covers(
    covers: Sequence[RectangleCover],
    sets: Sequence[CandidateSet],
    problems: Sequence[SpaceProblem],
    shape: tuple[int, ...],
) -> tuple[RectangleCover, Int]:
    """The cover of the whole map, and the first row of each space in it."""
    before = np.cumsum([0, *(len(s) for s in sets)])
    chosen = [np.where(c.chosen >= 0, c.chosen + n, -1) for c, n in zip(covers, before, strict=False)]
    uncovered = np.zeros(shape, dtype=bool)
    for cover, problem in zip(covers, problems, strict=True):
        uncovered[problem.window] |= cover.uncovered
    none = np.zeros(0, dtype=np.int64)
    joined = RectangleCover(
        np.concatenate([none, *chosen]),
        np.concatenate([np.zeros((0, 4)), *(c.bounds for c in covers)]),
        np.concatenate([none, *(c.total_cells for c in covers)]),
        np.concatenate([none, *(c.free_cells for c in covers)]),
        np.concatenate([none, *(c.gained for c in covers)]),
        uncovered,
    )
    return joined, np.cumsum([0, *(len(c) for c in covers)])


def disjoint(regions: Sequence[Region], rebuild: Any) -> list[Region]:
    """Cut the overlaps: what two regions share belongs to the one of which more was seen.

    :param rebuild: called with a polygon and the region that it is left of; gives the region anew.
    """
    seen = [share_seen(measures_of(r.sides, r.free_cells, r.total_cells, r.area)) for r in regions]
    order = sorted(range(len(regions)), key=lambda k: (-seen[k], regions[k].polygon.bounds))
    shapes = [regions[k].polygon for k in order]
    tree = shapely.STRtree(shapes)
    out = list(regions)
    for n, k in enumerate(order):
        before = [shapes[j] for j in np.sort(tree.query(shapes[n], predicate="intersects")) if j < n]
        taken = shapely.union_all(before) if before else shapely.Polygon()
        if not before or shapely.area(shapely.intersection(shapes[n], taken)) == 0:
            continue
        rest = shapely.set_precision(shapely.difference(shapes[n], taken), 1e-6)
        parts = [p for p in shapely.get_parts(rest) if p.geom_type == "Polygon"]
        if parts:
            shapes[n] = max(parts, key=lambda p: (p.area, p.bounds))
            out[k] = rebuild(shapes[n], regions[k])
    return out

"""The universe F_h: free cells of the voxel map sampled at height h (paper, section "Layout Estimation").

In: voxel columns and the wall runs of the planes. Out: :class:`OccupancyGrid`. Rays leave a building through
windows and glass: the free cells out there must not drive the cover. Patches of free cells, cut apart by the
walls, belong to the universe if the sensor was in them, or if enough of them lies under ceiling (over floor
where the survey shows no ceiling). Where no viewpoint told free space, the columns hold what was to be seen
from their wide places (:mod:`floorplan_core.stages.guessed_viewpoints`). Cost: linear in cells.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import OccupancyConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.columns import LEVEL, by_strips, height_mask, merged
from floorplan_core.geometry.masks import label_patches
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, Door, LayoutPlane, OccupancyGrid
from floorplan_core.model.evidence import Bits, Evidence

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

_HEIGHTS = (0.5, 1.9)  # m, between which the best slice is looked for
_TYPICAL = 2.0  # times the indoor share: what the surely inside must show for ceiling (floor) to decide
_BEHIND_DOOR = (
    0.3  # of the indoor share, for what a door joins to the inside: little floor is seen through it
)
_PATCHY = 0.6  # of the indoor share, where free space was guessed between patches of floor and ceiling
_GLIMPSE = 0.15  # m2 of free cells just behind a door that show a space
_WALKED = (0.2, 2.0)  # m above the floor: where something free lets a person stand on seen floor
_BEYOND = 0.6  # m behind a door, where the space that it opens is looked for
_BAND = 2  # levels on each side of the slice whose free voxels count: beams are sparse far away


def slice_map(
    evidence: Evidence, planes: tuple[LayoutPlane, ...], doors: tuple[Door, ...], config: OccupancyConfig
) -> OccupancyGrid:
    """Sample the voxel map and keep the free cells that the cover has to explain."""
    height = _best_height(evidence) if config.slice_height is None else config.slice_height
    level = min(int(height / LEVEL), 60)
    free = _any(evidence.free, height_mask((level - _BAND) * LEVEL, (level + _BAND + 1) * LEVEL))
    free |= _open_floor(evidence)
    states = np.where(free, np.uint8(FREE), np.uint8(UNOBSERVED))
    states[_any(evidence.occupied, height_mask(level * LEVEL, (level + 1) * LEVEL))] = OCCUPIED
    universe = _indoors(states == FREE, evidence, planes, doors, config)
    if not universe.any():
        raise NoPlanError(
            f"No free space was seen indoors at {height:.1f} m above the floor; set occupancy.slice_height "
            "to a height that the sensor saw through, or give the trajectory (--trajectory)."
        )
    return OccupancyGrid(evidence.origin, evidence.cell, states, universe, round(height, 3))


def _open_floor(evidence: Evidence) -> Mask:
    """Cells whose floor was seen and above it something free: through a door a sensor looks down on floor."""
    if evidence.inferred:  # the free space was made of the floor there
        return np.zeros(evidence.shape, dtype=bool)
    return np.asarray(_floor_cells(evidence) & _any(evidence.free, height_mask(*_WALKED)))


def _any(columns: Bits, mask: np.uint64) -> Mask:
    """(ny, nx) columns with any of these levels."""
    return by_strips(columns, lambda some: (some & mask) != 0)


def _best_height(evidence: Evidence) -> float:
    """The middle of the level at which most cells are free."""
    best, most = _HEIGHTS[0], -1
    for level in range(round(_HEIGHTS[0] / LEVEL), round(_HEIGHTS[1] / LEVEL)):
        seen = int(np.count_nonzero(_any(evidence.free, height_mask(level * LEVEL, (level + 1) * LEVEL))))
        if seen > most:
            best, most = (level + 0.5) * LEVEL, seen
    return best


def _indoors(
    free: Mask,
    evidence: Evidence,
    planes: tuple[LayoutPlane, ...],
    doors: tuple[Door, ...],
    config: OccupancyConfig,
) -> Mask:
    """The free cells in patches that are large enough and not outside.

    Inside is where the sensor was, what lies under ceiling, and what a door joins to the inside over seen
    floor.
    """
    label, patches = label_patches(free & ~_wall_cells(evidence, planes))
    count = patches + 1  # with what is in none
    area = np.bincount(label.ravel(), minlength=count)
    large = area * evidence.cell**2 >= config.min_component
    visited = np.zeros(count, dtype=bool)
    visited[_labels_at(label, evidence.path, evidence)] = True
    visited[0] = False

    def share(cover: Mask) -> Float:
        return np.bincount(label[cover], minlength=count) / np.maximum(area, 1)

    sure = visited if visited.any() else large
    ceiling, floor = share(_ceiling_cells(evidence)), share(_floor_cells(evidence))
    shown = [
        s
        for s in (ceiling, floor)
        if float(np.sum((s * area * sure)[1:]))
        > _TYPICAL * config.indoor_share * float(np.sum((area * sure)[1:]))
    ]
    least = config.indoor_share * (_PATCHY if evidence.inferred else 1.0)
    inside = visited | (large & (shown[0] >= least)) if shown else visited | large
    through = area * evidence.cell**2 >= _GLIMPSE
    within = through & (np.maximum(floor, ceiling) >= _BEHIND_DOOR * config.indoor_share)
    inside = _through_doors(inside, within, doors, label, evidence)
    inside[0] = False
    return np.asarray(inside[label])


def _through_doors(
    inside: Mask, possible: Mask, doors: tuple[Door, ...], label: NDArray[np.int32], evidence: Evidence
) -> Mask:
    """Patches that are ``possible`` and that doors join to the inside, directly or through others."""
    sides = [tuple(_beside(door, sign, label, evidence) for sign in (-1, 1)) for door in doors]
    inside, grown = inside.copy(), True
    while grown:
        grown = False
        for one, other in (*sides, *((b, a) for a, b in sides)):
            new = [k for k in other if possible[k] and not inside[k]]
            if new and any(inside[k] for k in one):
                inside[new] = True
                grown = True
    return inside


def _beside(door: Door, sign: int, label: NDArray[np.int32], evidence: Evidence) -> list[int]:
    """Labels of the patches just beyond one face of a door."""
    grid = label if door.axis == 0 else label.T
    u = door.offset + sign * (door.thickness / 2 + np.array([0.05, _BEYOND]))
    u0, u1 = np.sort(((u - evidence.origin[door.axis]) / evidence.cell).astype(int))
    v0, v1 = ((np.array([door.start, door.end]) - evidence.origin[1 - door.axis]) / evidence.cell).astype(int)
    found = np.unique(grid[max(v0, 0) : v1 + 1, max(u0, 0) : u1 + 1])
    return [int(k) for k in found if k > 0]


def _wall_cells(evidence: Evidence, planes: tuple[LayoutPlane, ...]) -> Mask:
    """Cells that a wall run passes through."""
    out = np.zeros(evidence.shape, dtype=bool)
    for plane in planes:
        a = plane.facing.axis
        grid = out if a == 0 else out.T
        column = int((plane.offset - evidence.origin[a]) / evidence.cell)
        if not 0 <= column < grid.shape[1]:
            continue
        for start, end in plane.walls:
            first = max(0, int((start - evidence.origin[1 - a]) / evidence.cell))
            grid[first : max(0, int(np.ceil((end - evidence.origin[1 - a]) / evidence.cell))), column] = True
    return out


def _labels_at(label: NDArray[np.int32], xy: Float, evidence: Evidence) -> NDArray[np.int32]:
    """Labels of the cells at (M, 2) positions; those beyond the grid are left out."""
    cells = np.floor((xy - evidence.origin) / evidence.cell).astype(int)
    inside = ((cells >= 0) & (cells < np.array(label.shape)[::-1])).all(axis=1)
    found: NDArray[np.int32] = label[cells[inside, 1], cells[inside, 0]]
    return found[found > 0]


def _ceiling_cells(evidence: Evidence) -> Mask:
    """Cells with a surface within 0.4 m of the ceiling's height."""
    if evidence.frame.ceiling_z is None:
        return np.zeros(evidence.shape, dtype=bool)
    top = evidence.frame.ceiling_z - evidence.frame.floor_z
    return _any_hit(evidence, height_mask(top - 0.4, top + 0.5))


def _floor_cells(evidence: Evidence) -> Mask:
    """Cells with a surface at most 0.2 m above the floor."""
    return _any_hit(evidence, height_mask(0, 0.2))


def _any_hit(evidence: Evidence, mask: np.uint64) -> Mask:
    def hit(hits: Bits) -> Mask:
        return np.asarray((merged(hits) & mask) != 0)

    return by_strips(evidence.hits, hit)

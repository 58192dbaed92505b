"""The voxel map of one storey: what lies between its slabs, with heights that count from its own floor.

Where parts of a storey lie higher or lower, each is gathered from the floor there, so that doors, walls and
furniture are looked for where they are. Cost: one pass for each height of floor.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import VoxelConfig
from floorplan_core.geometry.columns import LEVEL, LEVELS
from floorplan_core.geometry.ray_carving import MissMap
from floorplan_core.geometry.surfel_map import SurfelMap
from floorplan_core.model import ManhattanFrame
from floorplan_core.model.evidence import Evidence
from floorplan_core.model.storey import HeightMap, Storey
from floorplan_core.stages.voxel_columns import gather_evidence

Float = NDArray[np.float64]

_OPEN = 1.8  # m above the floor, up to which a place belongs to the storey below: nobody stands on it up here


def gather_storey(
    surfels: SurfelMap,
    misses: MissMap,
    frame: ManhattanFrame,
    path: Float,
    config: VoxelConfig,
    storey: Storey,
) -> Evidence:
    """The evidence of ``storey``; ``surfels`` and ``path`` are those that lie in it."""

    def gathered(floor: float) -> Evidence:
        ceiling = None if frame.ceiling_z is None else frame.ceiling_z + floor - frame.floor_z
        raised = replace(frame, floor_z=floor, ceiling_z=ceiling)
        return restrict_evidence(gather_evidence(surfels, misses, raised, path, config), storey)

    storey = storey.along(frame)
    found = gathered(frame.floor_z)
    if storey.floors is not None:
        for floor in np.unique(storey.floors.heights).tolist():
            if floor != frame.floor_z:
                found = _with_part(found, gathered(floor), storey.floors, floor)
    return replace(found, floors=storey.floors, elsewhere=_elsewhere(found, storey))


def _elsewhere(evidence: Evidence, storey: Storey) -> NDArray[np.bool_] | None:
    """(ny, nx) where a room of the storey below is open up here; None: nowhere."""
    ny, nx = evidence.shape
    centres = _centres(evidence, ny, nx, evidence.cell)
    floor = evidence.frame.floor_z if storey.floors is None else storey.floors.at(centres)
    below = storey.bottom.at(centres) > floor + _OPEN
    return below.reshape(ny, nx) if below.any() else None


def restrict_evidence(evidence: Evidence, storey: Storey) -> Evidence:
    """Without the free space of other storeys: rays of those above lie within the columns, too, and beside a
    step in the slab, or in a hall that is open up here, so do those of the one below: nobody stands there."""
    ny, nx = evidence.shape
    centres = _centres(evidence, ny, nx, evidence.cell)

    def up_to(heights: HeightMap) -> NDArray[np.uint64]:
        levels = (heights.at(centres) - evidence.frame.floor_z) / LEVEL
        count = np.clip(np.nan_to_num(levels, posinf=LEVELS), 0, LEVELS).astype(np.uint64)
        return ((np.uint64(1) << count) - np.uint64(1)).reshape(ny, nx)

    below = up_to(storey.bottom)
    own = up_to(storey.top) & ~below
    return replace(evidence, free=evidence.free & own, occupied=evidence.occupied & own | below)


def _with_part(main: Evidence, part: Evidence, floors: HeightMap, z: float) -> Evidence:
    """``main`` with what ``part`` says of the places whose floor is at ``z``."""
    ny, nx = main.shape
    coarse = (floors.at(_centres(main, ny, nx, main.cell)) == z).reshape(ny, nx)
    fine = (floors.at(_centres(main, 2 * ny, 2 * nx, main.fine)) == z).reshape(2 * ny, 2 * nx)
    there = floors.at(main.xyz[:, :2]) == z
    return replace(
        main,
        xyz=np.where(there[:, None], part.xyz, main.xyz),
        hits=np.where(fine, part.hits, main.hits),
        free=np.where(coarse, part.free, main.free),
        occupied=np.where(coarse, part.occupied, main.occupied),
    )


def _centres(evidence: Evidence, ny: int, nx: int, cell: float) -> Float:
    """(ny nx, 2) middles of the cells of a grid over the plan."""
    y, x = np.mgrid[0:ny, 0:nx] + 0.5
    return np.asarray(np.column_stack([x.ravel(), y.ravel()]) * cell + evidence.origin)

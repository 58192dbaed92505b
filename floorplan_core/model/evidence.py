"""What the stages look at once the Manhattan frame is known: surfels and voxel columns over the plan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model.manhattan import ManhattanFrame
from floorplan_core.model.storey import HeightMap

Float = NDArray[np.float64]
Bits = NDArray[np.uint64]


@dataclass(frozen=True)
class Evidence:
    """Surfels in the manhattan frame, and grids of columns whose bits are height levels above the floor."""

    frame: ManhattanFrame
    xyz: Float  # (N, 3) metres, manhattan frame; z above the floor
    count: NDArray[np.int32]  # (N,) points of each surfel
    spread: Float  # (N, 2) variance along x and y of the points of each surfel, m2
    view: Float  # (N, 2) mean unit direction to the sensor, manhattan frame; zeros where unknown
    surfel: float  # metres, side of a surfel's voxel
    origin: Float  # (2,) lower left corner of both grids, metres
    fine: float  # metres, side of a column of ``hits``
    hits: Bits  # (2 ny, 2 nx) levels that hold points
    cell: float  # metres, side of a column of ``free``
    free: Bits  # (ny, nx) levels that are free: rays passed and no surface dominates
    occupied: Bits  # (ny, nx) levels whose hits dominate the rays
    path: Float  # (M, 2) sensor positions, manhattan frame
    inferred: bool  # True: neither rays nor the file told free space; it is guessed from floor and ceiling
    viewpoints: bool  # False: no sensor origins; which way a surface faces is told by the free space
    floors: HeightMap | None = None  # z of the floor that heights count from, where it is not the frame's
    elsewhere: NDArray[np.bool_] | None = None  # (ny, nx) whose floor is in the plan of another storey

    @property
    def shape(self) -> tuple[int, int]:
        """ny, nx of the coarse grid."""
        return self.free.shape[0], self.free.shape[1]

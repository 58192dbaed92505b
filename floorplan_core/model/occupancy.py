"""The voxel map sampled at one height: the universe of the set cover."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

UNOBSERVED, FREE, OCCUPIED = np.uint8(0), np.uint8(1), np.uint8(2)


@dataclass(frozen=True)
class OccupancyGrid:
    """Cells of a horizontal slice; cell ``[iy, ix]`` covers ``origin + cell * [ix, iy]`` to ``+ cell``."""

    origin: NDArray[np.float64]  # (2,) metres, manhattan frame, lower left corner of cell [0, 0]
    cell: float  # metres on a side
    states: NDArray[np.uint8]  # (ny, nx) UNOBSERVED, FREE or OCCUPIED
    universe: NDArray[
        np.bool_
    ]  # (ny, nx) the free cells F_h that the cover must explain (indoors, reachable)
    slice_height: float  # metres above the floor

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 in metres, manhattan frame."""
        ny, nx = self.states.shape
        x0, y0 = float(self.origin[0]), float(self.origin[1])
        return x0, y0, x0 + nx * self.cell, y0 + ny * self.cell

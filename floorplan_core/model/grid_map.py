"""An occupancy grid map as it was read: what a robot drew of one storey, before any layout is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


@dataclass(frozen=True)
class MapRaster:
    """Where a map lies in the world: cell ``[iy, ix]`` covers ``cell * [ix, iy]`` to ``+ cell``."""

    origin: tuple[float, float]  # metres, world frame: lower left corner of cell [0, 0]
    yaw: float  # radians, of the raster's x axis in the world frame
    cell: float  # metres on a side
    shape: tuple[int, int]  # ny, nx

    def from_world(self, xy: Float) -> Float:
        """(N, 2) world metres to (N, 2) cells, x and y."""
        c, s = np.cos(self.yaw), np.sin(self.yaw)
        return np.asarray((xy - np.array(self.origin)) @ np.array([[c, -s], [s, c]]) / self.cell)


@dataclass(frozen=True)
class GridMap:
    """A map of the cells of its raster."""

    name: str  # file name, without its path
    states: NDArray[np.uint8]  # (ny, nx) UNOBSERVED, FREE or OCCUPIED; row 0 is the lowest y
    resolution: float  # metres, side of a cell
    origin: tuple[float, float] = (0.0, 0.0)  # metres, world frame: lower left corner of cell [0, 0]
    yaw: float = 0.0  # radians, of the map's x axis in the world frame
    assumptions: tuple[str, ...] = ()  # sentences: what was guessed about the image, and why

    @property
    def raster(self) -> MapRaster:
        """Where its cells lie."""
        ny, nx = self.states.shape
        return MapRaster(self.origin, self.yaw, self.resolution, (ny, nx))

"""An occupancy grid map as it was read: what a robot drew of one storey, before any layout is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class GridMap:
    """A map of cells; cell ``[iy, ix]`` covers ``resolution * [ix, iy]`` to ``+ resolution`` in the map's axes."""

    name: str  # file name, without its path
    states: NDArray[np.uint8]  # (ny, nx) UNOBSERVED, FREE or OCCUPIED; row 0 is the lowest y
    resolution: float  # metres, side of a cell
    origin: tuple[float, float] = (0.0, 0.0)  # metres, world frame: lower left corner of cell [0, 0]
    yaw: float = 0.0  # radians, of the map's x axis in the world frame
    assumptions: tuple[str, ...] = ()  # sentences: what was guessed about the image, and why

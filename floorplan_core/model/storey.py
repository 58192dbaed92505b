"""A storey of a building: between which heights it lies, everywhere over the plan."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model.layout import turned
from floorplan_core.model.manhattan import ManhattanFrame

Float = NDArray[np.float64]

_STILL = 1e-9  # radians: the same axes


@dataclass(frozen=True)
class HeightMap:
    """A height for every place of the plan: that of the slab there, or of the nearest slab that was seen."""

    heights: Float  # (ny, nx) metres, manhattan frame; (1, 1) where it is the same everywhere
    origin: tuple[float, float] = (0.0, 0.0)  # metres, manhattan frame: lower left corner of cell [0, 0]
    cell: float = 1.0  # metres on a side
    turn: float = (
        0.0  # radians, counter-clockwise, from its axes to those in which places are given (a wing's)
    )

    @staticmethod
    def constant(height: float) -> HeightMap:
        """The same height everywhere."""
        return HeightMap(np.array([[height]]))

    def at(self, xy: Float) -> Float:
        """(N,) heights at (N, 2) places; beyond the map those of its border."""
        ny, nx = self.heights.shape
        index = np.floor((turned(np.asarray(xy), self.turn) - np.array(self.origin)) / self.cell).astype(
            np.int64
        )
        return np.asarray(self.heights[np.clip(index[:, 1], 0, ny - 1), np.clip(index[:, 0], 0, nx - 1)])


@dataclass(frozen=True)
class Storey:
    """One storey; all heights are z of the manhattan frame in metres."""

    number: int  # 0 is the lowest of the survey
    floor_z: float
    ceiling_z: float | None  # None where no ceiling was seen
    bottom: HeightMap  # what lies below belongs to the storey below
    top: HeightMap  # what lies above belongs to the storey above
    floors: HeightMap | None = None  # z of the floor where parts lie higher or lower; None: floor_z
    heading: float = 0.0  # radians, of the x axis of these maps in the frame of the survey

    def holds(self, points: Float) -> NDArray[np.bool_]:
        """(N,) which of (N, 3) points, manhattan frame, lie in this storey."""
        xy, z = points[:, :2], points[:, 2]
        return np.asarray((z >= self.bottom.at(xy)) & (z <= self.top.at(xy)))

    def along(self, frame: ManhattanFrame) -> Storey:
        """The storey for what lies in ``frame``, that of a wing at an angle to the one it was found in."""
        turn = math.remainder(heading(frame) - self.heading, 2 * math.pi)
        if abs(turn) < _STILL:
            return self
        floors = None if self.floors is None else replace(self.floors, turn=turn)
        low, high = replace(self.bottom, turn=turn), replace(self.top, turn=turn)
        return replace(self, bottom=low, top=high, floors=floors)


def heading(frame: ManhattanFrame) -> float:
    """Radians of the x axis of ``frame`` in what it is a rotation of."""
    return math.atan2(frame.rotation[0, 1], frame.rotation[0, 0])

"""A wing of a building: what was found in the frame of its own walls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model.layout import LayoutPlane, LayoutSegment, turned


@dataclass(frozen=True)
class Wing:
    """Planes and segments that are parallel to the axes of a wing; its regions and doors are the plan's."""

    turn: float  # radians from the plan's axes to those of the wing, counter-clockwise about their origin
    planes: tuple[LayoutPlane, ...]  # in the axes of the wing
    segments: tuple[LayoutSegment, ...]

    def to_plan(self, xy: NDArray[np.float64]) -> NDArray[np.float64]:
        """(N, 2) positions in the axes of the wing to the manhattan frame of the plan."""
        return turned(xy, self.turn)

"""Layout planes: infinite, axis-aligned, with the runs that were really seen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.layers.source import PlanSource
from floorcast_app.selection import Item
from floorplan_core.model import Facing, LayoutPlane
from floorplan_core.model.layout import turned


@dataclass(frozen=True)
class PlaneShape:
    """One layout plane."""

    item: Item
    facing: Facing
    offset: float  # metres along the facing's axis
    runs: NDArray[np.float64]  # (K, 2) metres along the plane: really seen
    speculated: bool
    turn: float = 0.0  # radians from the plan's axes to those that offset and runs are along

    def lines(self) -> NDArray[np.float64]:
        """(K, 2, 2) end points of the runs, metres, manhattan frame."""
        out = np.full((len(self.runs), 2, 2), self.offset)
        out[:, :, 1 - self.facing.axis] = self.runs
        return turned(out.reshape(-1, 2), self.turn).reshape(-1, 2, 2)


@dataclass(frozen=True)
class PlanesLayer:
    """All layout planes."""

    shapes: tuple[PlaneShape, ...]


def plane_shape(plane: LayoutPlane) -> PlaneShape:
    """The shape of one plane."""
    runs = np.asarray(plane.observed, dtype=np.float64).reshape(-1, 2)
    item = Item("plane", plane.id)
    return PlaneShape(item, plane.facing, plane.offset, runs, plane.speculated, plane.turn)


def planes_layer(source: PlanSource) -> PlanesLayer:
    """The planes in the order of the plan, then those of its wings."""
    return PlanesLayer(tuple(plane_shape(p) for p in source.plan.all_planes))

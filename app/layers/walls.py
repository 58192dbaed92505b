"""The walls as they are drawn (poché) and the doors in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.layers.source import PlanSource, Rings, rings
from floorcast_app.selection import Item
from floorplan_core.exporters.door_symbols import Leaf


@dataclass(frozen=True)
class WallsLayer:
    """Solid walls, and those that only close a region."""

    observed: Rings
    guessed: Rings


@dataclass(frozen=True)
class DoorShape:
    """One door or opening."""

    item: Item
    bounds: tuple[float, float, float, float]  # x0, y0, x1, y1 around the cut, metres, manhattan frame
    faces: NDArray[np.float64]  # (2, 2, 2) ends of the two faces of the wall across it
    leaves: tuple[Leaf, ...]  # none for an opening
    sure: bool  # False: less than even odds


@dataclass(frozen=True)
class DoorsLayer:
    """All doors."""

    shapes: tuple[DoorShape, ...]


def walls_layer(source: PlanSource) -> WallsLayer:
    """The walls of the plan."""
    return WallsLayer(rings(source.walls.observed), rings(source.walls.guessed))


def doors_layer(source: PlanSource) -> DoorsLayer:
    """The doors of the plan."""
    pairs = zip(source.walls.openings, source.swings, strict=True)
    return DoorsLayer(
        tuple(
            DoorShape(Item("door", o.door.id), o.bounds, o.faces, made, o.door.confidence >= 0.5)
            for o, made in pairs
        )
    )

"""Columns: on a line through large rooms, or standing out of a corner."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.building import DoorOpening, Space
from floorplan_core.simulation.circulation import mm
from floorplan_core.simulation.furniture import door_zones
from floorplan_core.simulation.spec import BuildingSpec

Float = NDArray[np.float64]


def make_columns(
    spaces: tuple[Space, ...],
    doors: tuple[DoorOpening, ...],
    spec: BuildingSpec,
    rng: np.random.Generator,
) -> Float:
    """(K, 4) x0, y0, x1, y1 of columns that reach from floor to ceiling; doors stay clear."""
    zones = np.array([z for d in doors for z in door_zones(d)]).reshape(-1, 4)
    found = []
    for space in spaces:
        for rect in space.rects:
            size = mm(rng.uniform(0.3, 0.45))
            for at in _column_places(space, rect, size, rng):
                column = np.array([*at, *(at + size)])
                clear = not ((zones[:, :2] < column[2:]) & (zones[:, 2:] > column[:2])).all(axis=1).any()
                if clear and rng.random() < spec.columns:
                    found.append(column)
    return np.round(np.array(found).reshape(-1, 4), 3)


def _column_places(space: Space, rect: Float, size: float, rng: np.random.Generator) -> list[Float]:
    """Lower left corners: every 4 to 6 m along the middle of a large room, else now and then in a corner."""
    extent = rect[2:] - rect[:2]
    long = int(np.argmax(extent))
    if space.kind == "room" and extent.min() > 4.5 and extent.prod() > 32:
        count = int(extent[long] / rng.uniform(4, 6))
        middles = np.tile((rect[:2] + rect[2:]) / 2 - size / 2, (count, 1))
        middles[:, long] = rect[long] + extent[long] * (np.arange(count) + 0.5) / count - size / 2
        return list(middles)
    if space.kind == "room" and extent.min() > 3.5 and rng.random() < 0.3:
        return [np.array([rect[0], rect[1]])]  # in a corner: its two faces stand out
    return []

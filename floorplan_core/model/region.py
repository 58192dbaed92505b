"""Regions of the floor plan: connected unions of chosen rectangles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class RegionSide:
    """One straight side of a region's boundary."""

    start: tuple[float, float]  # metres, manhattan frame
    end: tuple[float, float]
    plane: str  # id of the layout plane on which it lies; "" where none
    observed: float  # 0 to 1: share of its length along which wall (or a door in one) was seen
    hole: bool = False  # True on an inner boundary
    residual: float | None = None  # metres, 95 % of the points seen along it lie closer; None where none were

    @property
    def length(self) -> float:
        """Metres."""
        return float(np.hypot(self.end[0] - self.start[0], self.end[1] - self.start[1]))

    @property
    def speculated(self) -> bool:
        """True where most of the side is a guess."""
        return bool(self.observed < 0.5)


@dataclass(frozen=True)
class Region:
    """A disjoint part of the floor plan."""

    id: str
    name: str  # "1", "2", ...
    polygon: Any  # shapely Polygon, manhattan frame, metres; exterior counter-clockwise, may have holes
    label: str  # "room", "corridor", or what a classifier plugin says
    free_cells: int  # cells of the universe inside
    total_cells: int  # all cells inside
    turning_distance: float  # to the unit square, perimeter normalised to 1
    sides: tuple[RegionSide, ...] = ()
    doors: tuple[str, ...] = ()  # ids
    height: float | None = None  # metres, floor to ceiling
    confidence: float = 1.0  # 0 to 1, probability that a room of the building is here, about so large
    rectangles: NDArray[np.int64] | None = None  # rows of the cover
    by_hand: tuple[str, ...] = ()  # what a person did to it: "split", "merged", "label", "name"
    rise: float = 0.0  # metres from the floor of the storey up to its own; 0 but on half levels

    @property
    def area(self) -> float:
        """m2, to the inside faces of the walls."""
        return float(self.polygon.area)

    @property
    def perimeter(self) -> float:
        """Metres of the outer boundary."""
        return float(self.polygon.exterior.length)

    @property
    def speculated_fraction(self) -> float:
        """0 to 1: share of the cells that were not seen free."""
        return 1.0 - self.free_cells / self.total_cells if self.total_cells else 1.0

"""Regions: floor, predicted parts, guessed sides, and where their names go."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from floorcast_app.layers.label_spots import Spot, label_spot, number_spot
from floorcast_app.layers.source import PlanSource, Rings, rings
from floorcast_app.selection import Item
from floorplan_core.exporters.dimensions import ends_guessed
from floorplan_core.exporters.svg_labels import display_name, is_rectangle
from floorplan_core.model import Region


@dataclass(frozen=True)
class RegionShape:
    """One region."""

    item: Item
    label: str  # "room", "corridor", ...
    floor: Rings
    predicted: Rings  # floor that nobody saw
    guessed: NDArray[np.float64]  # (K, 2, 2) sides that are a guess, metres
    name: str  # "Room 3", or the name that it was given
    short: str  # "3"
    area: float  # m2
    clear: tuple[float, float] | None  # metres, width and depth of a rectangle
    nearly: tuple[bool, bool]  # of width and depth: True where one goes to a wall that nobody saw
    spot: Spot  # where the text goes
    seat: Spot  # where its number goes where there is room for no more


@dataclass(frozen=True)
class RegionsLayer:
    """All regions."""

    shapes: tuple[RegionShape, ...]


def regions_layer(source: PlanSource) -> RegionsLayer:
    """The regions of the plan; text keeps off the swing of doors."""
    swept = [leaf.sector for made in source.swings for leaf in made]
    return RegionsLayer(tuple(_shape(r, source, swept) for r in source.drawn.regions))


def _shape(region: Region, source: PlanSource, swept: list[object]) -> RegionShape:
    guessed = [(s.start, s.end) for s in region.sides if s.speculated]
    x0, y0, x1, y1 = region.polygon.bounds
    return RegionShape(
        Item("region", region.id),
        region.label,
        rings(region.polygon),
        rings(shapely.intersection(source.predicted, region.polygon)),
        np.array(guessed, dtype=np.float64).reshape(-1, 2, 2),
        display_name(region),
        region.name,
        region.area,
        (x1 - x0, y1 - y0) if is_rectangle(region) else None,
        (ends_guessed([region], 0, (x0, x1)), ends_guessed([region], 1, (y0, y1))),
        label_spot(region.polygon, swept),
        number_spot(region.polygon, swept),
    )

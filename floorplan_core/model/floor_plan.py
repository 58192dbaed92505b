"""The result: everything that the exporters, the evaluation and the application show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model.cover import CandidateSet, RectangleCover
from floorplan_core.model.grid_map import MapRaster
from floorplan_core.model.layout import Door, LayoutPlane, LayoutSegment
from floorplan_core.model.manhattan import ManhattanFrame
from floorplan_core.model.occupancy import FREE, OccupancyGrid
from floorplan_core.model.reconstruction import LocalFrame
from floorplan_core.model.region import Region, RegionSide
from floorplan_core.model.wing import Wing

if TYPE_CHECKING:
    from floorplan_core.config import Config

__all__ = ["FloorPlan", "RegionSide", "WallPoints"]

Float = NDArray[np.float64]


@dataclass(frozen=True)
class WallPoints:
    """A thinned top view of the observed points, for pictures: one point for each occupied 5 cm column."""

    xy: NDArray[np.float32]  # (N, 2) metres, manhattan frame
    height: NDArray[np.float32]  # (N,) metres above the floor that the column reaches
    facing: NDArray[np.int8]  # (N,) Facing of the plane that explains it; -1 where none


@dataclass(frozen=True)
class FloorPlan:
    """A water-tight, semantic floor plan in the manhattan frame, with what it was made from."""

    frame: ManhattanFrame
    local_frame: LocalFrame
    segments: tuple[LayoutSegment, ...]
    planes: tuple[LayoutPlane, ...]
    doors: tuple[Door, ...]
    grid: OccupancyGrid
    candidates: CandidateSet
    cover: RectangleCover
    regions: tuple[Region, ...]
    wall_points: WallPoints
    trajectory: NDArray[np.float64]  # (M, 2) sensor positions, manhattan frame; (0, 2) where unknown
    source: str  # name of the input
    point_count: int
    config: Config
    warnings: tuple[str, ...] = ()
    seconds: dict[str, float] = field(default_factory=dict)  # wall time of each stage
    storey: int = 0
    raster: MapRaster | None = None  # of the grid map that it was made from
    corrected: tuple[tuple[str, str], ...] = ()  # (kind, id) of what a person changed
    machine: dict[str, str] = field(default_factory=dict)  # by id: what the machine had said of it
    wings: tuple[Wing, ...] = ()  # parts of the building that stand at another angle

    @property
    def all_planes(self) -> tuple[LayoutPlane, ...]:
        """The planes with those of the wings, each in its own axes (:attr:`LayoutPlane.turn`)."""
        return (*self.planes, *(plane for wing in self.wings for plane in wing.planes))

    @property
    def all_segments(self) -> tuple[LayoutSegment, ...]:
        """The segments with those of the wings, each in its own axes."""
        return (*self.segments, *(segment for wing in self.wings for segment in wing.segments))

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 of the regions, of the grid where there are none (metres, manhattan frame)."""
        import shapely

        if not self.regions:
            return self.grid.extent
        x0, y0, x1, y1 = shapely.total_bounds([r.polygon for r in self.regions]).tolist()
        return x0, y0, x1, y1

    def to_world(self, xy: Float) -> Float:
        """(N, 2) manhattan plan coordinates to (N, 2) coordinates of the input's world frame, metres."""
        local = self.frame.from_manhattan(np.asarray(xy, dtype=np.float64).reshape(-1, 2))
        return (local + self.local_frame.shift)[:, :2]

    @property
    def manhattan_from_world(self) -> Float:
        """(4, 4) homogeneous transform, world metres to manhattan metres."""
        T = np.eye(4)
        T[:3, :3] = self.frame.rotation
        T[:3, 3] = -self.frame.rotation @ self.local_frame.shift
        return T

    def speculated(self) -> Any:
        """Shapely MultiPolygon of the plan's area that was predicted, not seen (manhattan frame)."""
        from floorplan_core.geometry.raster import cells_to_polygon

        inside = regions_mask(self.regions, self.grid)
        return cells_to_polygon(inside & (self.grid.states != FREE), self.grid.origin, self.grid.cell)


def regions_mask(regions: tuple[Region, ...], grid: OccupancyGrid) -> NDArray[np.bool_]:
    """(ny, nx) True where a cell's centre lies in a region."""
    from floorplan_core.geometry.raster import polygon_window

    mask = np.zeros(grid.states.shape, dtype=bool)
    for region in regions:
        window, inside = polygon_window(region.polygon, grid.origin, grid.cell, grid.states.shape)
        mask[window] |= inside
    return mask


def by_hand(
    planes: Sequence[LayoutPlane], doors: Sequence[Door], regions: Sequence[Region]
) -> tuple[tuple[str, str], ...]:
    """(kind, id) of everything that a person changed."""
    kinds = (("plane", planes), ("door", doors), ("region", regions))
    return tuple((kind, thing.id) for kind, things in kinds for thing in things if thing.by_hand)

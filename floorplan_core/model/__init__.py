"""The nouns of the field as frozen dataclasses: what the stages hand to each other."""

from floorplan_core.model.cover import CandidateSet, RectangleCover
from floorplan_core.model.floor_plan import FloorPlan, RegionSide, WallPoints
from floorplan_core.model.grid_map import GridMap, MapRaster
from floorplan_core.model.layout import Door, Facing, LayoutPlane, LayoutSegment, WallProfile
from floorplan_core.model.loa import loa_band
from floorplan_core.model.manhattan import ManhattanFrame
from floorplan_core.model.occupancy import FREE, OCCUPIED, UNOBSERVED, OccupancyGrid
from floorplan_core.model.reconstruction import LocalFrame, PointChunk, Reconstruction, Trajectory
from floorplan_core.model.region import Region
from floorplan_core.model.wing import Wing

__all__ = [
    "FREE",
    "OCCUPIED",
    "UNOBSERVED",
    "CandidateSet",
    "Door",
    "Facing",
    "FloorPlan",
    "GridMap",
    "LayoutPlane",
    "LayoutSegment",
    "LocalFrame",
    "ManhattanFrame",
    "MapRaster",
    "OccupancyGrid",
    "PointChunk",
    "Reconstruction",
    "RectangleCover",
    "Region",
    "RegionSide",
    "Trajectory",
    "WallPoints",
    "WallProfile",
    "Wing",
    "loa_band",
]

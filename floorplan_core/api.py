"""What plugins may import: the stable, public names of the core."""

from floorplan_core.config import Config, InputConfig
from floorplan_core.errors import FloorPlanError, InputError, NoPlanError, OutputError, UsageError
from floorplan_core.model import (
    FREE,
    OCCUPIED,
    UNOBSERVED,
    Door,
    Facing,
    FloorPlan,
    LayoutPlane,
    LayoutSegment,
    LocalFrame,
    OccupancyGrid,
    PointChunk,
    Reconstruction,
    Region,
    RegionSide,
    Trajectory,
)
from floorplan_core.observer import Observer
from floorplan_core.plugins import Exporter, Reader, ReadOptions, RegionClassifier, hookimpl

__all__ = [
    "FREE",
    "OCCUPIED",
    "UNOBSERVED",
    "Config",
    "Door",
    "Exporter",
    "Facing",
    "FloorPlan",
    "FloorPlanError",
    "InputConfig",
    "InputError",
    "LayoutPlane",
    "LayoutSegment",
    "LocalFrame",
    "NoPlanError",
    "Observer",
    "OccupancyGrid",
    "OutputError",
    "PointChunk",
    "ReadOptions",
    "Reader",
    "Reconstruction",
    "Region",
    "RegionClassifier",
    "RegionSide",
    "Trajectory",
    "UsageError",
    "hookimpl",
]

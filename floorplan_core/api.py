"""What plugins may import: the stable, public names of the core."""

from floorplan_core.config import Config, InputConfig
from floorplan_core.drawing_style import DrawingStyle
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
    loa_band,
)
from floorplan_core.observer import Observer
from floorplan_core.plugins import Exporter, Reader, ReadOptions, RegionClassifier, hookimpl
from floorplan_core.readers.assemble import assemble
from floorplan_core.readers.colours import as_rgb
from floorplan_core.readers.fields import SCAN_ID_NAMES, STAMP_NAMES, find_name, find_xyz
from floorplan_core.readers.foreign import damaged, import_library, moved, spread_sample
from floorplan_core.readers.join_time import nearest_rows, time_tolerance
from floorplan_core.readers.ply_header import PlyHeader, parse_ply_header
from floorplan_core.readers.records import as_scan_id, join_chunks
from floorplan_core.readers.source import (
    CHUNK_POINTS,
    SAMPLE_POINTS,
    EmptyInput,
    PointSource,
    RawChunk,
    ScanIds,
)
from floorplan_core.readers.trajectory import read_trajectory, rotation_from_quaternion
from floorplan_core.readers.trajectory_check import WrongTrajectory
from floorplan_core.readers.trajectory_forms import is_rigid

__all__ = [
    "CHUNK_POINTS",
    "FREE",
    "OCCUPIED",
    "SAMPLE_POINTS",
    "SCAN_ID_NAMES",
    "STAMP_NAMES",
    "UNOBSERVED",
    "Config",
    "Door",
    "DrawingStyle",
    "EmptyInput",
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
    "PlyHeader",
    "PointChunk",
    "PointSource",
    "RawChunk",
    "ReadOptions",
    "Reader",
    "Reconstruction",
    "Region",
    "RegionClassifier",
    "RegionSide",
    "ScanIds",
    "Trajectory",
    "UsageError",
    "WrongTrajectory",
    "as_rgb",
    "as_scan_id",
    "assemble",
    "damaged",
    "find_name",
    "find_xyz",
    "hookimpl",
    "import_library",
    "is_rigid",
    "join_chunks",
    "loa_band",
    "moved",
    "nearest_rows",
    "parse_ply_header",
    "read_trajectory",
    "rotation_from_quaternion",
    "spread_sample",
    "time_tolerance",
]

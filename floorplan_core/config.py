"""Every number of the method, one frozen model per stage: bounds, unit, meaning.

The same declaration validates ``--set stage.field=value`` and YAML files, prints the resolved configuration
of a run, fills the settings form of the application and the table in ``docs/settings.md``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator

from floorplan_core.errors import UsageError
from floorplan_core.plain_yaml import parse_yaml, read_yaml


def setting(default: Any, unit: str, description: str, **bounds: Any) -> Any:
    """A pydantic field with a unit; ``bounds`` are pydantic's ge, gt, le, lt."""
    return Field(default, description=description, json_schema_extra={"unit": unit}, **bounds)


class Section(BaseModel):
    """Settings of one stage; frozen, unknown names are errors."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class InputConfig(Section):
    """How the file is read."""

    unit: Literal["auto", "m", "cm", "mm", "ft", "us-ft"] = setting(
        "auto", "", "Unit of the file's coordinates; us-ft is the US survey foot."
    )
    up: Literal["auto", "x", "y", "z", "-x", "-y", "-z"] = setting("auto", "", "The file's up axis.")
    mirrored: Literal["auto", "yes", "no"] = setting(
        "auto",
        "",
        "The file's axes are left-handed, its plan would be a mirror image; auto: where its poses say so.",
    )
    topic: str = setting(
        "",
        "",
        "Topics of a ROS recording that hold the scans, with commas between; empty: the clouds of all "
        "sensors, else their planar scans, else their depth images.",
    )
    max_range: float = setting(30.0, "m", "Points farther from their sensor are dropped.", gt=0.5, le=500)
    min_range: float = setting(0.05, "m", "Points nearer to their sensor are dropped.", ge=0, le=5)

    @field_validator("mirrored", mode="before")
    @classmethod
    def _word(cls, value: Any) -> Any:
        """YAML reads yes and no as true and false, and so did earlier versions."""
        return ("no", "yes")[value] if isinstance(value, bool) else value


class DriftConfig(Section):
    """Correction of a drifting trajectory (SL-LMS), before the points are put together."""

    correct: bool = setting(
        False, "", "Find the simplest building that explains what was seen, and move the path to fit it."
    )
    keyframe: float = setting(1.0, "m", "Path of a keyframe; drift within it is nothing.", gt=0.1, le=10)
    odometry: float = setting(0.03, "m/m", "Error of the path for each metre of it.", gt=0, le=0.5)
    heading: float = setting(0.05, "deg/m", "Error of its heading for each metre.", gt=0, le=10)
    reach: float = setting(
        1.0, "m", "Sightings of one wall differ by no more than this once near ones are joined.", gt=0, le=5
    )


class FrameConfig(Section):
    """Manhattan frame: gravity and yaw."""

    cell: float = setting(0.25, "m", "Cells in which normals are fitted.", ge=0.1, le=2)
    planarity: float = setting(0.15, "", "Largest ratio of a cell's thickness to its width.", gt=0, le=1)
    tolerance_deg: float = setting(
        5.0, "deg", "A normal this near to an axis supports the frame.", gt=0, le=20
    )
    yaw_step_deg: float = setting(0.05, "deg", "Step of the search for the sharpest walls.", gt=0, le=1)
    min_support: float = setting(
        0.3, "", "Below this share of supporting wall there is no Manhattan frame.", ge=0, le=1
    )
    yaw_deg: float | None = setting(
        None, "deg", "Force the yaw of the walls instead of estimating it.", ge=-180, le=180
    )
    wings: bool = setting(
        True,
        "",
        "Plan a wing that stands at another angle in a frame of its own.",
    )


class StoreysConfig(Section):
    """Storeys of one survey, from its floors and ceilings."""

    min_height: float = setting(2.0, "m", "From a floor to the ceiling above it at least.", ge=1, le=20)
    max_slab: float = setting(
        1.2, "m", "From a ceiling to the floor of the storey above it at most.", ge=0, le=5
    )
    min_share: float = setting(
        0.3, "", "Of the largest floor or ceiling: a smaller one parts no storeys (a gallery).", ge=0, le=1
    )


class VoxelConfig(Section):
    """Voxel map and surfels."""

    size: float = setting(0.1, "m", "Side of a voxel of the occupancy map (paper: 0.1 m).", ge=0.02, le=1)
    own_axes: bool = setting(
        True, "", "Lay the voxels along the survey's own axes: where the file's world lies changes nothing."
    )
    min_misses: int = setting(1, "rays", "Rays through a voxel that make it free.", ge=1, le=100)
    hit_ratio: float = setting(
        0.15, "", "Share of hits among hits and misses from which a voxel is occupied.", ge=0.005, le=1
    )
    memory: float | None = setting(
        None,
        "MB",
        "What the map of a survey may take in memory; more goes to temporary files, and the plan stays the "
        "same. None: half of what is free, and no more than 1000.",
        ge=4,
        le=1e7,
    )


class SegmentsConfig(Section):
    """Layout segments: observed patches of structural surfaces."""

    window: float = setting(
        0.35, "m", "Side of the window in which the direction of a surface is fitted.", ge=0.15, le=2
    )
    angle_deg: float = setting(
        15.0, "deg", "Largest angle of a surface to the axis of its facing.", gt=0, le=44
    )
    join_gap: float = setting(
        0.4, "m", "Patches of one surface nearer than this along it are one segment.", ge=0, le=5
    )
    offset_tolerance: float = setting(
        0.06, "m", "Patches of one segment differ less in their offset.", gt=0, le=0.5
    )
    min_length: float = setting(0.3, "m", "Shorter segments are dropped.", ge=0, le=5)
    min_area: float = setting(0.15, "m2", "Segments of less observed surface are dropped.", ge=0, le=10)
    furniture_height: float = setting(
        2.05, "m", "A surface that reaches above this is no furniture.", ge=0.5, le=4
    )
    ceiling_gap: float = setting(
        0.35, "m", "A surface that ends less than this below the ceiling touches it.", ge=0, le=2
    )


class PlanesConfig(Section):
    """The minimum set of layout planes."""

    tolerance: float = setting(
        0.05, "m", "An observed offset may differ this much from its plane (3 sigma).", gt=0, le=0.5
    )
    min_support: float = setting(0.4, "m2", "Planes of less observed surface are not paired.", ge=0, le=20)
    bridge: float = setting(
        2.5,
        "m",
        "Unseen stretches between two seen parts of one wall are wall up to this length.",
        ge=0,
        le=20,
    )
    recess: float = setting(
        0.3,
        "m",
        "Surfaces at most this deep behind a wall of the same facing are its recesses, not paired.",
        ge=0,
        le=1,
    )
    wall_depth: float = setting(
        0.18,
        "m",
        "Surfaces this near to a plane are the same wall: its other face, frames, leaves.",
        ge=0,
        le=1,
    )


class OccupancyConfig(Section):
    """The slice of the voxel map that gives the universe F_h."""

    slice_height: float | None = setting(
        None, "m", "Height h above the floor; none: the height that shows most free cells.", gt=0, le=10
    )
    min_component: float = setting(
        0.5, "m2", "Smaller patches of free cells do not drive the cover.", ge=0, le=100
    )
    indoor_share: float = setting(
        0.1, "", "Share of a patch that must lie under seen ceiling or over seen floor.", ge=0, le=1
    )


class DoorsConfig(Section):
    """Doors by histogram, smoothed gradient and matched filter."""

    crop_height: float = setting(
        2.0, "m", "Points above are left out of the histogram (paper: 2 m).", gt=0.5, le=4
    )
    bin: float = setting(0.05, "m", "Width of a histogram bin.", ge=0.01, le=0.5)
    smoothing: float = setting(
        0.05, "m", "Standard deviation of the Gaussian whose derivative gives the gradient.", gt=0, le=1
    )
    aperture: float = setting(1.0, "m", "Width that the filter is matched to (paper: 1 m).", gt=0.3, le=4)
    min_width: float = setting(0.6, "m", "Narrower openings are no doors (paper: 0.8 m).", gt=0.2, le=4)
    max_width: float = setting(
        1.3, "m", "Wider openings are no doors but openings (paper: 1.2 m).", gt=0.3, le=4
    )
    max_opening: float = setting(
        4.0, "m", "Widest opening below a lintel that still separates two regions.", gt=0.5, le=10
    )
    max_beamless: float = setting(
        1.9,
        "m",
        "A wider lintel between two walls that go on beyond it is a beam, and separates nothing.",
        gt=0.5,
        le=10,
    )
    lintel_depth: float = setting(0.45, "m", "A lintel less deep is shallow.", ge=0, le=2)
    min_response: float = setting(
        0.25, "", "Smallest response of the matched filter, 1 being a clean aperture.", ge=0, le=1
    )
    min_confidence: float = setting(0.5, "", "Doors that are less probable are not reported.", ge=0, le=1)
    max_thickness: float = setting(
        0.6, "m", "Two faces farther apart than this are not one wall.", gt=0.02, le=2
    )


class CandidatesConfig(Section):
    """Candidate rectangles and their pruning."""

    min_side: float = setting(1.0, "m", "Shorter sides are pruned (paper: 1 m).", ge=0.1, le=20)
    min_rest_side: float = setting(
        0.6, "m", "The same for what is left uncovered and closed by speculated planes.", ge=0.1, le=20
    )
    tolerance: float = setting(
        0.15, "m", "Walls and doors this near to a side do not lie in the interior.", ge=0, le=1
    )
    max_ratio: float = setting(
        20.0,
        "",
        "Rectangles of more total cells a free cell are pruned; what only they cover is reported.",
        ge=1,
        le=10000,
    )
    max_count: int = setting(
        10_000_000,
        "",
        "More valid rectangles than this on 20,000 m2 are refused; a larger site may have as many more.",
        ge=1,
        le=10**9,
    )


class CoverConfig(Section):
    """Weighted set cover of the free space."""

    solver: Literal["greedy", "exact"] = setting(
        "greedy", "", "greedy (paper) or exact (integer program, HiGHS)."
    )
    time_limit: float = setting(60.0, "s", "Longest run of the exact solver.", gt=0, le=3600)


class RegionsConfig(Section):
    """Regions: connected unions of chosen rectangles."""

    risk: float = setting(
        1000.0, "", "Regions of more total cells a free cell are dropped (paper: 1000).", ge=1, le=1e6
    )
    min_area: float = setting(0.8, "m2", "Smaller regions are dropped.", ge=0, le=100)
    sliver: float = setting(0.3, "m", "Parts narrower than this are not part of a region.", ge=0, le=2)
    wall_support: float = setting(
        0.4, "m2", "Walls of more observed surface than this never lie inside a region.", ge=0, le=20
    )


class LabelsConfig(Section):
    """Rooms and corridors."""

    classifier: str = setting("paper", "", "Name of the region classifier (see `floorcast plugins`).")
    max_room_perimeter: float = setting(
        60.0, "m", "A longer boundary is a corridor (paper: 60 m).", gt=0, le=10000
    )
    max_room_turning: float = setting(
        1.0, "", "A larger turning distance to the square is a corridor (paper: 1).", gt=0, le=100
    )


class MapsConfig(Section):
    """Occupancy grid maps: what parts two rooms on a map without heights."""

    max_door: float = setting(1.6, "m", "Widest aperture that is taken for a door.", gt=0.3, le=4)
    door_opening: float = setting(
        0.7, "", "Largest ratio of a door's width to the free width beyond, on both sides.", gt=0, le=1
    )
    door_wall: float = setting(
        0.3, "", "Least share of wall in the line of a door, the door included.", ge=0, le=1
    )
    max_passage: float = setting(4.2, "m", "Widest gap in a wall that still parts two rooms.", gt=0.3, le=10)
    passage_opening: float = setting(0.8, "", "The ratio of widths for a passage.", gt=0, le=1)
    passage_wall: float = setting(0.4, "", "The share of wall for a passage.", ge=0, le=1)
    max_mouth: float = setting(
        3.0, "m", "A corridor up to this wide ends where it opens into a hall.", gt=0.3, le=10
    )
    mouth_opening: float = setting(
        0.45, "", "Largest ratio of half a corridor's width to the hall's inscribed radius.", gt=0, le=1
    )
    min_width: float = setting(0.3, "m", "Narrower gaps are holes in the data.", gt=0, le=2)
    leg_size: float = setting(
        0.5, "m", "Smaller isolated objects are furniture, whatever their shape.", ge=0, le=3
    )
    furniture_size: float = setting(
        1.6, "m", "Compact isolated objects up to this size are furniture or columns.", ge=0, le=5
    )
    furniture_ratio: float = setting(
        2.2, "", "Isolated objects longer than this times their width are pieces of wall.", ge=1, le=20
    )
    min_space: float = setting(0.8, "m2", "Smaller enclosed spaces are dropped.", ge=0, le=100)
    agreement: float = setting(
        0.9,
        "",
        "Least share of a space that its rectangles must explain; else the map's outline is taken.",
        ge=0,
        le=1,
    )
    max_askew: float = setting(
        0.05, "", "Share of walls at other angles from which a space gets the map's outline.", ge=0, le=1
    )


class Config(Section):
    """All settings. ``Config()`` holds the defaults, ``Config.load`` reads YAML; see also ``with_values``."""

    input: InputConfig = InputConfig()
    drift: DriftConfig = DriftConfig()
    frame: FrameConfig = FrameConfig()
    storeys: StoreysConfig = StoreysConfig()
    voxels: VoxelConfig = VoxelConfig()
    segments: SegmentsConfig = SegmentsConfig()
    planes: PlanesConfig = PlanesConfig()
    occupancy: OccupancyConfig = OccupancyConfig()
    doors: DoorsConfig = DoorsConfig()
    candidates: CandidatesConfig = CandidatesConfig()
    cover: CoverConfig = CoverConfig()
    regions: RegionsConfig = RegionsConfig()
    labels: LabelsConfig = LabelsConfig()
    maps: MapsConfig = MapsConfig()

    @classmethod
    def load(cls, path: Path) -> Config:
        """Read a YAML file of ``stage: {field: value}``; what is not named keeps its default."""
        try:
            data = read_yaml(path)
        except OSError as error:
            raise UsageError(f"Cannot read the configuration {path.name}: {error.strerror}.") from error
        except ValueError as error:
            raise UsageError(f"{path.name} is not valid YAML: {error}.") from error
        return cls.from_dict({} if data is None else data)

    @classmethod
    def from_dict(cls, data: Any) -> Config:
        """Validate nested values; a :class:`UsageError` names the first setting that is wrong."""
        if not isinstance(data, dict):
            raise UsageError("A configuration must be a table of stages, like 'doors: {max_width: 1.2}'.")
        try:
            return cls.model_validate(data)
        except ValidationError as error:
            first = error.errors()[0]
            name = ".".join(str(part) for part in first["loc"])
            raise UsageError(f"Setting {name}: {first['msg']} (given {first['input']!r}).") from error

    def with_values(self, assignments: dict[str, str]) -> Config:
        """A copy with ``{"stage.field": "value"}`` applied; values are parsed as YAML scalars."""
        data = self.model_dump()
        for name, text in assignments.items():
            stage, _, field = name.partition(".")
            if stage not in data or field not in data[stage]:
                raise UsageError(f"There is no setting {name!r}; 'floorcast settings' lists them all.")
            try:
                data[stage][field] = parse_yaml(text) if isinstance(text, str) else text
            except ValueError as error:
                raise UsageError(f"Setting {name}: {text[:60]!r} is not valid YAML: {error}.") from error
        return type(self).from_dict(data)

"""What to simulate: bounded, documented settings of buildings, sensors and surveys.

Every field states its unit and bounds in its metadata; a value out of bounds raises :class:`UsageError`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields, replace
from typing import Any

from floorplan_core.errors import UsageError

STYLES = ("straight", "l", "t", "ring", "grid", "flat")
FURNITURE = ("none", "normal", "heavy")
KINDS = ("camera", "lidar", "station")  # how a sensor's rays lie, and how it is carried
SENSORS = ("camera", "lidar", "station", "tilted", "planar")  # presets


def bounded(default: float | None, low: float, high: float, text: str) -> Any:
    """A field with inclusive bounds; None as default means: drawn by the building's own rng."""
    return field(default=default, metadata={"low": low, "high": high, "text": text})


def chosen(default: str, choices: tuple[str, ...], text: str) -> Any:
    """A field that is one of ``choices``."""
    return field(default=default, metadata={"choices": choices, "text": text})


def check(spec: Any) -> None:
    """Raise :class:`UsageError` for the first field of ``spec`` that is out of its bounds."""
    for item in fields(spec):
        value, meta = getattr(spec, item.name), item.metadata
        if "choices" in meta and value not in meta["choices"]:
            raise UsageError(f"{item.name} must be one of {', '.join(meta['choices'])} (given {value!r}).")
        if item.type == "int" and not isinstance(value, int):
            raise UsageError(f"{item.name} ({meta['text']}) must be a whole number (given {value!r}).")
        if "low" in meta and not (value is None and item.default is None):
            _check_number(item.name, value, meta)


def _check_number(name: str, value: Any, meta: Any) -> None:
    try:
        inside = math.isfinite(value) and meta["low"] <= value <= meta["high"]
    except TypeError:
        inside = False
    if not inside:
        raise UsageError(
            f"{name} ({meta['text']}) must lie in {meta['low']:g} to {meta['high']:g} (given {value!r})."
        )


@dataclass(frozen=True)
class BuildingSpec:
    """A family of buildings; ``make_building(spec, rng)`` draws one member. Metres."""

    style: str = chosen("straight", STYLES, "circulation")
    rooms: int = bounded(12, 2, 3000, "number of rooms, roughly; styles with wings have 10 to 20 at least")
    corridor_width: float = bounded(2.0, 1.1, 5.0, "mean clear width of corridors, m")
    room_width: float = bounded(4.2, 2.5, 12.0, "mean width of rooms along the corridor, m")
    room_depth: float = bounded(5.0, 2.5, 15.0, "mean depth of rooms, m")
    interior_wall: float | None = bounded(None, 0.05, 0.4, "thickness of interior walls, m")
    exterior_wall: float | None = bounded(None, 0.1, 0.6, "thickness of exterior walls, m")
    height: float | None = bounded(None, 2.4, 4.5, "floor to ceiling, m")
    furniture: str = chosen("normal", FURNITURE, "density of furniture")
    shut_doors: float = bounded(0.12, 0, 1, "share of doors that are shut")
    door_leaves: float = bounded(0.5, 0, 1, "share of open doors whose leaf stands in the room")
    double_doors: float = bounded(0.07, 0, 1, "share of doors that are 1.2 to 1.8 m wide")
    nested_rooms: float = bounded(0.2, 0, 1, "share of room slots that hold a room within a room")
    halls: float = bounded(0.08, 0, 1, "share of room slots that are halls or lobbies")
    windows: float = bounded(0.8, 0, 1, "share of the possible windows that are built")
    columns: float = bounded(0.5, 0, 1, "share of the possible columns that are built")

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True)
class SensorSpec:
    """A range sensor and its errors; start from :func:`sensor_preset`."""

    kind: str = chosen("lidar", KINDS, "sensor")
    columns: int = bounded(450, 8, 4096, "rays along the horizon")
    rows: int = bounded(32, 1, 4096, "rays along the vertical")
    horizontal_fov: float = bounded(360.0, 10, 360, "field of view, degrees")
    lowest: float = bounded(-25.0, -90, 89, "elevation of the lowest ray, degrees")
    highest: float = bounded(25.0, -89, 90, "elevation of the highest ray, degrees")
    min_range: float = bounded(0.3, 0, 5, "shortest range, m")
    max_range: float = bounded(30.0, 1, 200, "longest range, m")
    height: float = bounded(1.2, 0.2, 2.2, "of the sensor above the floor, m")
    interval: float = bounded(0.5, 0.02, 600, "time between scans, s")
    speed: float = bounded(0.7, 0.05, 3, "of the walk, m/s")
    tilt: float = bounded(0.0, -90, 90, "of the sensor on its carrier, nose down, degrees")
    wobble: float = bounded(1.0, 0, 10, "roll and pitch while walking, standard deviation, degrees")
    pan: float = bounded(0.0, 0, 90, "amplitude of the slow panning about the walking direction, degrees")
    look_around: float = bounded(0.0, 0, 360, "turn at every waypoint in a room, degrees")
    noise: float = bounded(0.015, 0, 0.2, "standard deviation of a range, m")
    dropout: float = bounded(0.03, 0, 0.9, "share of rays without return")
    mixed_pixels: float = bounded(0.3, 0, 1, "share of rays at depth edges that return a range in between")
    glass_return: float = bounded(0.03, 0, 1, "share of rays that return from window panes")

    def __post_init__(self) -> None:
        check(self)
        if self.lowest >= self.highest:
            raise UsageError(
                f"lowest ({self.lowest:g} degrees) must be below highest ({self.highest:g} degrees)."
            )
        if self.min_range >= self.max_range:
            raise UsageError(
                f"min_range ({self.min_range:g} m) must be below max_range ({self.max_range:g} m)."
            )


_PRESETS = {
    "lidar": SensorSpec(),
    # The paper's depth camera: short range, narrow view, carried at breast height.
    "camera": SensorSpec(
        kind="camera",
        columns=128,
        rows=96,
        horizontal_fov=75.0,
        lowest=-29.0,
        highest=29.0,
        min_range=0.4,
        max_range=5.0,
        height=1.35,
        interval=0.4,
        speed=0.6,
        pan=40.0,
        look_around=360.0,
    ),
    # A tripod scanner: blind below, dense, precise.
    "station": SensorSpec(
        kind="station",
        columns=900,
        rows=375,
        lowest=-60.0,
        highest=88.0,
        min_range=0.4,
        max_range=60.0,
        height=1.6,
        interval=180.0,
        noise=0.003,
        dropout=0.01,
    ),
    # Sixteen rings on a mast, leaning forward: they sweep floor and ceiling, and cross walls at a slant.
    "tilted": SensorSpec(columns=600, rows=16, lowest=-15.0, highest=15.0, tilt=30.0),
    # The laser of a wheeled robot, which stays level: one ring, no heights.
    "planar": SensorSpec(
        columns=720, rows=1, lowest=-0.1, highest=0.0, min_range=0.1, height=0.4, interval=0.2, wobble=0.0
    ),
}


def sensor_preset(kind: str, **changes: Any) -> SensorSpec:
    """The usual sensor of a kind ("camera", "lidar" or "station") with some fields changed."""
    if kind not in _PRESETS:
        raise UsageError(f"There is no sensor {kind!r}; choose one of {', '.join(SENSORS)}.")
    return replace(_PRESETS[kind], **changes)


@dataclass(frozen=True)
class SurveySpec:
    """A building, a sensor, a walk, and how wrong the poses are. The same seed gives the same bytes."""

    building: BuildingSpec = BuildingSpec()
    sensor: SensorSpec = SensorSpec()
    seed: int = bounded(0, 0, 2**32 - 1, "of all random numbers")
    explore: float = bounded(1.0, 0, 1, "share of the reachable rooms that the path enters")
    drift: float = bounded(0.0, 0, 5, "largest error of an estimated position, m")
    drift_yaw_deg: float = bounded(0.0, 0, 10, "largest error of an estimated heading, degrees")
    yaw_deg: float | None = bounded(None, -180, 180, "of the building in the world, degrees")
    roll_deg: float = bounded(0.0, -45, 45, "tilt of the world frame about its x axis, degrees")
    pitch_deg: float = bounded(0.0, -45, 45, "tilt of the world frame about its y axis, degrees")
    offset_x: float = bounded(0.0, -1e7, 1e7, "shift of the world frame, m")
    offset_y: float = bounded(0.0, -1e7, 1e7, "shift of the world frame, m")
    offset_z: float = bounded(0.0, -1e4, 1e4, "shift of the world frame, m")
    thin: float = bounded(0.025, 0, 0.5, "voxel that keeps one point per window of scans, m; 0 keeps all")
    max_points: int = bounded(1_000_000, 1000, 200_000_000, "more points are dropped at random")

    def __post_init__(self) -> None:
        check(self)

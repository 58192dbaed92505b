"""A plan as the evaluation sees it: what ``plan.geojson`` holds, in plan coordinates (metres)."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError

Float = NDArray[np.float64]
PLAN_NAME = "plan.geojson"


@dataclass(frozen=True)
class PlanRegion:
    """One region of the plan."""

    id: str
    name: str
    label: str
    polygon: Any  # shapely Polygon


@dataclass(frozen=True)
class PlanDoor:
    """One door or opening of the plan."""

    id: str
    line: Float  # (2, 2) ends along the opening
    width: float
    kind: str  # "door" or "opening"
    confidence: float


@dataclass(frozen=True)
class PlanFile:
    """The content of one ``plan.geojson``."""

    name: str
    regions: tuple[PlanRegion, ...]
    doors: tuple[PlanDoor, ...]
    speculated: Any  # shapely geometry: area that was predicted, not seen
    manhattan_from_world: Float | None  # (4, 4)
    slice_height: float | None  # metres above the floor

    @property
    def yaw(self) -> float | None:
        """Radians: direction of the plan's x axis in the world."""
        if self.manhattan_from_world is None:
            return None
        return float(np.arctan2(self.manhattan_from_world[0, 1], self.manhattan_from_world[0, 0]))

    def moved(self, matrix: Float) -> PlanFile:
        """The plan with its geometry (not its frame) mapped by a (2, 3) affine ``matrix``."""
        import shapely

        def xy(points: Float) -> Float:
            return points @ matrix[:, :2].T + matrix[:, 2]

        regions = tuple(replace(r, polygon=shapely.transform(r.polygon, xy)) for r in self.regions)
        doors = tuple(replace(d, line=xy(d.line)) for d in self.doors)
        return replace(self, regions=regions, doors=doors, speculated=shapely.transform(self.speculated, xy))


def read_plan(path: Path) -> PlanFile:
    """Read a plan (or the folder that holds ``plan.geojson``); :class:`InputError` where it is none."""
    file = path / PLAN_NAME if path.is_dir() else path
    document = read_json(file, "plan")
    if not isinstance(document, dict) or document.get("type") != "FeatureCollection":
        raise InputError(f"{file.name} is not a plan: a GeoJSON FeatureCollection was expected.")
    try:
        return parse_plan(document, file.name)
    except (KeyError, TypeError, ValueError, IndexError, AttributeError) as error:
        raise InputError(f"{file.name} is not a plan of Floorcast: {_reason(error)}.") from error


def parse_plan(document: dict[str, Any], name: str) -> PlanFile:
    """The same from a parsed FeatureCollection; raises the usual Python errors where it is malformed."""
    features = document["features"]
    meta = document.get("floorcast") or {}
    matrix = meta.get("manhattan_from_world")
    height = meta.get("slice_height_m")
    return PlanFile(
        name=name,
        regions=tuple(_collect(features, "region", _region)),
        doors=tuple(_collect(features, "door", _door)),
        speculated=_speculated(features),
        manhattan_from_world=None if matrix is None else np.array(matrix, dtype=np.float64).reshape(4, 4),
        slice_height=None if height is None else float(height),
    )


def read_json(path: Path, what: str) -> Any:
    """Parse a JSON file; one sentence for every way in which that can fail."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"Cannot read the {what} {path}: {error.strerror}.") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"The {what} {path.name} is not valid JSON: {_reason(error)}.") from error


def _reason(error: Exception) -> str:
    text = str(error).splitlines()[0] if str(error) else type(error).__name__
    return f"{text} is missing" if isinstance(error, KeyError) else text.rstrip(".")


def _collect(features: list[Any], kind: str, make: Callable[[dict[str, Any]], Any]) -> list[Any]:
    return [make(f) for f in features if f["properties"].get("kind") == kind]


def _geometry(feature: dict[str, Any]) -> Any:
    """A finite, valid shapely geometry; :class:`ValueError` names the feature otherwise."""
    import shapely
    from shapely.geometry import shape

    try:
        geometry = shape(feature["geometry"])
    except (shapely.errors.ShapelyError, KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"feature {feature.get('id')!r} has no usable geometry") from error
    if not np.all(np.isfinite(shapely.get_coordinates(geometry))):
        raise ValueError(f"feature {feature.get('id')!r} has coordinates that are not finite")
    return geometry if geometry.is_valid else shapely.make_valid(geometry)


def _region(feature: dict[str, Any]) -> PlanRegion:
    properties = feature["properties"]
    name = str(properties.get("name", feature["id"]))
    return PlanRegion(str(feature["id"]), name, str(properties.get("label", "")), _geometry(feature))


def _door(feature: dict[str, Any]) -> PlanDoor:
    properties = feature["properties"]
    line = np.asarray(_geometry(feature).coords, dtype=np.float64)[:, :2]
    ends = line[[0, -1]]
    width = float(properties.get("width_m", np.hypot(*(ends[1] - ends[0]))))
    words = (properties.get("type"), properties.get("door_kind"), properties.get("opening_kind"))
    kind = "opening" if "opening" in words else "door"
    return PlanDoor(str(feature["id"]), ends, width, kind, float(properties.get("confidence", 1.0)))


def _speculated(features: list[Any]) -> Any:
    import shapely

    return shapely.union_all([_geometry(f) for f in features if f["properties"].get("kind") == "speculated"])

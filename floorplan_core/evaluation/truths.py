"""Ground truth in every form that we know, recognised by what the file holds, not by its name.

=======================  ==============================================================================
``rooms`` + ``doors``    ``truth.json`` of simulated surveys (see the contract in the user documentation)
``wall_segments_high``   wall sections at two heights with room outlines (``gt_plan.json``)
``spaces``               spaces, doors and windows of an IFC model (``gt_ifc.json``)
IFC (STEP file)          the same, from the model itself
``centers`` (NPZ)        free voxels that a real sensor carved, beside the ``points.ply`` they belong to
=======================  ==============================================================================
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from floorplan_core.errors import InputError
from floorplan_core.evaluation.plan_file import read_json
from floorplan_core.evaluation.truth import (
    Float,
    Truth,
    TruthDimension,
    TruthDoor,
    TruthRoom,
    door_axis,
    room_dimensions,
)

# In the order in which they are looked for in a folder.
TRUTH_NAMES = ("truth.json", "gt_plan.json", "gt_ifc.json", "free_voxels.npz")
WALL_MARGIN = 0.05  # m, the outermost face may lie this much beyond the stated wall thickness
USUAL_WALL = 0.3  # m, where the truth does not say
MIN_ROOM_AREA = 0.2  # m2; smaller polygons are remains of the truth's own making
MIN_SEEN_DOOR = 0.02  # share of a room's floor; less means that nobody looked through its door
OPENING_KINDS = ("opening", "passage", "open")


def find_truth(path: Path) -> Path:
    """The truth of a survey: ``path`` itself, or the first known name in the folder ``path``."""
    if not path.is_dir():
        return path
    for name in TRUTH_NAMES:
        if (path / name).is_file():
            return path / name
    raise InputError(f"The folder {path} holds no ground truth ({', '.join(TRUTH_NAMES)}).")


def load_truth(path: Path, storey: int = 0) -> Truth:
    """Read a ground truth; :class:`InputError` says in one sentence why it is none.

    ``storey`` chooses among those of an IFC model, from the lowest; other truths have one.
    """
    file = find_truth(path)
    if file.suffix.lower() == ".npz":
        from floorplan_core.evaluation.voxel_truth import load_free_voxels

        return load_free_voxels(file)
    document = _read_document(file)
    try:
        return parse_truth(document, file.name, storey)
    except (KeyError, TypeError, ValueError, IndexError, AttributeError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(f"The ground truth {file.name} is malformed: {reason.rstrip('.')}.") from error


def _read_document(file: Path) -> Any:
    if file.suffix.lower() != ".ifc":
        return read_json(file, "ground truth")
    from floorplan_core.evaluation.ifc_model import read_ifc

    return read_ifc(file)


def parse_truth(document: Any, source: str, storey: int = 0) -> Truth:
    """A truth from parsed JSON, by its keys."""
    from floorplan_core.evaluation.ifc_truth import parse_ifc
    from floorplan_core.evaluation.wall_section_truth import parse_wall_sections

    keys = set(document) if isinstance(document, dict) else set()
    if "wall_segments_high" in keys:
        return parse_wall_sections(document, source)
    if "spaces" in keys:
        return parse_ifc(document, source, storey)
    if "rooms" in keys:
        return parse_own(document, source)
    raise InputError(f"{source} is no ground truth that Floorcast knows: it has no rooms and no spaces.")


def parse_own(document: dict[str, Any], source: str) -> Truth:
    """The documented ``truth.json``; ``holes``, ``seen``, ``kind`` and ``open`` are used where present."""
    rooms = tuple(_room(i, entry) for i, entry in enumerate(document["rooms"]))
    doors = [_door(entry, rooms) for entry in document.get("doors", ())]
    doors += [_window(entry) for entry in document.get("windows", ()) if "bounds" in entry]
    dimensions = tuple(_dimension(entry) for entry in document.get("dimensions", ()))
    return Truth(
        source=source,
        rooms=rooms,
        doors=tuple(doors),
        dimensions=dimensions or room_dimensions(rooms),
        world_from_building=_world_from_building(document),
        wall=_wall(document) + WALL_MARGIN,
    )


def polygon(exterior: Any, holes: Any = ()) -> Any:
    """A valid shapely Polygon (the largest part where the outline crosses itself)."""
    import shapely

    shape = shapely.Polygon(exterior, holes)
    if not shape.is_valid:
        shape = max(shapely.get_parts(shapely.make_valid(shape)), key=lambda part: part.area)
    if shape.area < MIN_ROOM_AREA or not np.isfinite(shape.area):
        raise ValueError(f"a room polygon has an area of {shape.area:g} m2")
    return shape


def _room(index: int, entry: dict[str, Any]) -> TruthRoom:
    seen = entry.get("seen")
    return TruthRoom(
        name=str(entry.get("name", entry.get("id", index))),
        polygon=polygon(entry["polygon"], entry.get("holes", ())),
        kind=entry.get("kind"),
        entered=bool(entry.get("entered", True)),
        seen=None if seen is None else float(seen),
    )


def _bounds(entry: dict[str, Any]) -> tuple[float, float, float, float]:
    x0, y0, x1, y1 = (float(v) for v in entry["bounds"])
    return min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)


def _door(entry: dict[str, Any], rooms: tuple[TruthRoom, ...]) -> TruthDoor:
    """A door is required when it is open, joins a room that was entered, and both its sides were seen."""
    bounds = _bounds(entry)
    joins = tuple(int(i) for i in entry.get("joins", ()) if i is not None and int(i) >= 0)
    kind = "opening" if entry.get("kind") in OPENING_KINDS else "door"
    is_open = bool(entry.get("open", True)) and not entry.get("shut", False)
    reached = not joins or any(rooms[i].entered for i in joins)
    seen = all(_seen(rooms[i]) >= MIN_SEEN_DOOR for i in joins)
    inside = len(joins) != 1
    axis = int(entry.get("axis", door_axis(bounds)))
    return TruthDoor(bounds, axis, kind, required=is_open and reached and seen and inside, joins=joins)


def _seen(room: TruthRoom) -> float:
    """Share of the floor; all of it where the truth does not say."""
    return 1.0 if room.seen is None else room.seen


def _window(entry: dict[str, Any]) -> TruthDoor:
    bounds = _bounds(entry)
    return TruthDoor(bounds, int(entry.get("axis", door_axis(bounds))), "window", required=False)


def _dimension(entry: dict[str, Any]) -> TruthDimension:
    (x0, y0), (x1, y1) = entry["from"], entry["to"]
    ends = (float(x0), float(y0)), (float(x1), float(y1))
    return TruthDimension(str(entry["id"]), *ends, metres=float(entry["metres"]))


def _world_from_building(document: dict[str, Any]) -> Float:
    """(2, 3) map of floor coordinates: the documented yaw, or the full pose where there is one (tilt)."""
    pose = document.get("T_world_building")
    if pose is not None:
        matrix = np.array(pose, dtype=np.float64).reshape(4, 4)
        return matrix[:2, [0, 1, 3]]
    yaw = np.radians(float(document["yaw_deg"]))
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0]])


def _wall(document: dict[str, Any]) -> float:
    """Thickest wall."""
    return max(float(document.get(key, 0.0)) for key in ("wall", "exterior_wall")) or USUAL_WALL

"""Ground truth from an IFC model: spaces, doors, windows and walls of one of its storeys."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.evaluation.truth import Truth, TruthDoor, TruthRoom, door_axis, room_dimensions

CIRCULATION = re.compile(r"corridor|hall|foyer|lobby|passage|vestibule|circulation", re.IGNORECASE)
# A space boundary with nothing built on it is an opening when it is at least this long (metres).
MIN_OPENING = 0.6
WALL_REACH = 0.3  # m, two spaces this near to each other share a wall or a virtual boundary
BODY_HEIGHT = 2.0  # m, walls that start above the head do not separate spaces
JAMB = 0.03  # m, slack between a space's face and the wall's face


def parse_ifc(document: dict[str, Any], source: str, number: int = 0) -> Truth:
    """Spaces of storey ``number``, from the lowest, as rooms. Exterior doors are shut: not required."""
    from floorplan_core.evaluation.truths import polygon

    storey = nth_storey(document["spaces"], number)
    spaces = [s for s in document["spaces"] if s["storey"] == storey]
    rooms = tuple(_room(s, polygon(s["polygon"], s.get("holes", ())).simplify(0.001)) for s in spaces)
    walls = [w["bbox"] for w in document.get("walls", ()) if w["storey"] == storey]
    doors = [_door(d, rooms) for d in document.get("doors", ()) if d["storey"] == storey]
    windows = [_window(w) for w in document.get("windows", ()) if w["storey"] == storey]
    openings = virtual_openings(rooms, walls)
    return Truth(
        source=source,
        rooms=rooms,
        doors=tuple(doors + openings + windows),
        dimensions=room_dimensions(rooms),
        world_from_building=_turned(float(document.get("yaw_deg", 0.0))),
        wall=_thickest(walls),
    )


def nth_storey(spaces: list[dict[str, Any]], number: int) -> str:
    """The storey whose spaces start lowest but ``number`` (ties: by name)."""
    if not spaces:
        raise ValueError("it has no spaces")
    lowest: dict[str, float] = {}
    for space in spaces:
        name, z = str(space["storey"]), float(space["z"][0])
        lowest[name] = min(z, lowest.get(name, z))
    names = sorted(lowest, key=lambda name: (lowest[name], name))
    if number >= len(names):
        raise ValueError(
            f"it has {len(names)} storeys with spaces ({', '.join(names)}), none of number {number}"
        )
    return names[number]


def _turned(yaw_deg: float) -> NDArray[np.float64]:
    """(2, 3) map from the building's axes to those of the model."""
    c, s = np.cos(np.radians(yaw_deg)), np.sin(np.radians(yaw_deg))
    return np.array([[c, -s, 0.0], [s, c, 0.0]])


def _room(space: dict[str, Any], polygon: Any) -> TruthRoom:
    kind = "corridor" if CIRCULATION.search(str(space.get("long_name", ""))) else "room"
    return TruthRoom(str(space["name"]), polygon, kind)


def _plan_bounds(bbox: Any) -> tuple[float, float, float, float]:
    (x0, y0, *_), (x1, y1, *_) = bbox
    return float(x0), float(y0), float(x1), float(y1)


def _door(door: dict[str, Any], rooms: tuple[TruthRoom, ...]) -> TruthDoor:
    """The opening without its frame: ``overall_width`` about the middle of the bounding box."""
    bounds = _plan_bounds(door["bbox"])
    axis = door_axis(bounds)
    along = 1 - axis
    middle, half = 0.5 * (bounds[along] + bounds[along + 2]), 0.5 * float(door["overall_width"])
    trimmed = list(bounds)
    trimmed[along], trimmed[along + 2] = middle - half, middle + half
    box = (trimmed[0], trimmed[1], trimmed[2], trimmed[3])
    joins = tuple(i for i, room in enumerate(rooms) if _touches(room, box))
    return TruthDoor(box, axis, "door", required=len(joins) >= 2, joins=joins)


def _window(window: dict[str, Any]) -> TruthDoor:
    bounds = _plan_bounds(window["bbox"])
    return TruthDoor(bounds, door_axis(bounds), "window", required=False)


def _touches(room: TruthRoom, bounds: tuple[float, float, float, float]) -> bool:
    import shapely

    return bool(room.polygon.distance(shapely.box(*bounds)) <= JAMB)


def virtual_openings(rooms: tuple[TruthRoom, ...], walls: list[Any]) -> list[TruthDoor]:
    """Boundaries between two spaces on which nothing is built: passages, known but not required of a plan."""
    import shapely

    built = shapely.union_all([shapely.box(*_plan_bounds(w)) for w in walls if float(w[0][2]) < BODY_HEIGHT])
    found = []
    for i, a in enumerate(rooms):
        for j in range(i + 1, len(rooms)):
            shared = a.polygon.buffer(JAMB, join_style="mitre").intersection(rooms[j].polygon.boundary)
            free = shared.difference(built.buffer(JAMB)) if not shared.is_empty else shared
            if free.length < MIN_OPENING:
                continue
            found.append(_opening(free, (i, j)))
    return found


def _opening(line: Any, joins: tuple[int, int]) -> TruthDoor:
    """The box around the longer extent of a free boundary."""
    x0, y0, x1, y1 = (float(v) for v in line.bounds)
    axis = door_axis((x0, y0, x1, y1))
    pad = np.array([JAMB, 0.0]) if axis == 0 else np.array([0.0, JAMB])
    bounds = (x0 - float(pad[0]), y0 - float(pad[1]), x1 + float(pad[0]), y1 + float(pad[1]))
    return TruthDoor(bounds, axis, "opening", required=False, joins=joins)


def _thickest(walls: list[Any]) -> float:
    """Thickness of the thickest wall (the shorter side of its box)."""
    sides = [min(b[2] - b[0], b[3] - b[1]) for b in map(_plan_bounds, walls)]
    return max(sides, default=WALL_REACH)

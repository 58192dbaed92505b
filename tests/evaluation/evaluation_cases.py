"""A small building with every kind of opening, its truth.json, and the plan of a perfect program."""

from __future__ import annotations

import copy
import math
from typing import Any

import numpy as np

YAW = 17.0
WALL = 0.2

# A corridor (10 x 2 m) with three rooms above and one below; the last room is only glimpsed.
TRUTH: dict[str, Any] = {
    "yaw_deg": YAW,
    "height": 2.6,
    "wall": WALL,
    "rooms": [
        {"kind": "corridor", "polygon": [[0, 0], [10, 0], [10, 2], [0, 2]], "entered": True},
        {"kind": "room", "polygon": [[0, 2.2], [4, 2.2], [4, 6], [0, 6]], "entered": True},
        {
            "kind": "room",
            "polygon": [[4.2, 2.2], [10, 2.2], [10, 4], [7, 4], [7, 6], [4.2, 6]],
            "entered": True,
        },
        {"kind": "room", "polygon": [[0, -4.2], [5, -4.2], [5, -0.2], [0, -0.2]], "entered": False},
    ],
    "doors": [
        {"bounds": [1, 2, 1.9, 2.2], "joins": [0, 1], "open": True},
        {"bounds": [5, 2, 5.8, 2.2], "joins": [0, 2], "open": True},
        {"bounds": [2, -0.2, 3, 0], "joins": [0, 3], "open": True},
        {"bounds": [4, 3, 4.2, 4], "joins": [1, 2], "open": False},
    ],
    "windows": [{"bounds": [1, 6, 3, 6.2], "axis": 1}],
    "dimensions": [
        {"id": "corridor-length", "from": [0, 1], "to": [10, 1], "metres": 10.0},
        {"id": "room-1-width", "from": [0, 4], "to": [4, 4], "metres": 4.0},
        {"id": "room-1-depth", "from": [2, 2.2], "to": [2, 6], "metres": 3.8},
        {"id": "room-2-depth", "from": [5, 2.2], "to": [5, 6], "metres": 3.8},
        {"id": "room-3-width", "from": [0, -2], "to": [5, -2], "metres": 5.0},
    ],
}


def truth() -> dict[str, Any]:
    """A copy that a test may change."""
    return copy.deepcopy(TRUTH)


def turned(points: Any, degrees: float = YAW, shift: tuple[float, float] = (0.0, 0.0)) -> list[list[float]]:
    """Building axes to world."""
    a = math.radians(degrees)
    rotation = np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]])
    return (np.asarray(points, dtype=float) @ rotation.T + shift).tolist()


def region(index: int, polygon: Any, label: str, yaw: float = YAW) -> dict[str, Any]:
    """A region feature."""
    ring = turned(polygon, yaw)
    return {
        "type": "Feature",
        "id": f"region-{index}",
        "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
        "properties": {"kind": "region", "name": str(index), "label": label},
    }


def door(index: int, line: Any, kind: str = "door", yaw: float = YAW) -> dict[str, Any]:
    """A door feature."""
    (x0, y0), (x1, y1) = line
    return {
        "type": "Feature",
        "id": f"door-{index}",
        "geometry": {"type": "LineString", "coordinates": turned(line, yaw)},
        "properties": {
            "kind": "door",
            "door_kind": kind,
            "width_m": math.hypot(x1 - x0, y1 - y0),
            "confidence": 1.0,
        },
    }


def frame(yaw: float = YAW) -> list[list[float]]:
    """manhattan_from_world of a plan whose walls have this yaw."""
    c, s = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
    return [[c, s, 0, 0], [-s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def perfect_plan(yaw: float = YAW) -> dict[str, Any]:
    """The plan that equals ``TRUTH``: its open doors as lines in the middle of the wall."""
    features = [region(i + 1, r["polygon"], r["kind"], yaw) for i, r in enumerate(TRUTH["rooms"])]
    for i, d in enumerate(TRUTH["doors"][:3]):
        x0, y0, x1, y1 = d["bounds"]
        features.append(door(i + 1, [[x0, (y0 + y1) / 2], [x1, (y0 + y1) / 2]], yaw=yaw))
    meta = {"units": "metre", "frame": "world", "manhattan_from_world": frame(yaw), "slice_height_m": 1.2}
    return {"type": "FeatureCollection", "floorcast": meta, "features": features}

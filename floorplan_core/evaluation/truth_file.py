"""A ground truth written as the documented ``truth.json``, from whatever form it was read."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from floorplan_core.errors import UsageError
from floorplan_core.evaluation.truth import Truth, TruthDoor, TruthRoom

DIGITS = 6  # micrometres


def write_truth(truth: Truth, path: Path) -> None:
    """Write ``truth.json``; :class:`UsageError` where there are no rooms to write."""
    from floorplan_core.files import output_file

    if not truth.rooms:
        raise UsageError(f"{truth.source} names no rooms, so there is no truth.json to write.")
    with output_file(path) as temporary:
        temporary.write_text(json.dumps(truth_document(truth), indent=1) + "\n", encoding="utf-8")


def truth_document(truth: Truth) -> dict[str, Any]:
    """Plain data that :func:`~floorplan_core.evaluation.truths.parse_own` reads back."""
    pose = np.eye(4)
    pose[:2, [0, 1, 3]] = truth.world_from_building
    return {
        "source": truth.source,
        "yaw_deg": float(np.degrees(truth.yaw)),
        "T_world_building": pose.tolist(),
        "exterior_wall": truth.wall,
        "rooms": [_room(room) for room in truth.rooms],
        "doors": [_door(door) for door in truth.doors if door.kind != "window"],
        "windows": [_box(door) for door in truth.doors if door.kind == "window"],
        "dimensions": [
            {"id": d.id, "from": _rounded(d.start), "to": _rounded(d.end), "metres": round(d.metres, DIGITS)}
            for d in truth.dimensions
        ],
    }


def _room(room: TruthRoom) -> dict[str, Any]:
    rings = [room.polygon.exterior, *room.polygon.interiors]
    exterior, *holes = [[_rounded(xy) for xy in ring.coords[:-1]] for ring in rings]
    known = {"kind": room.kind, "seen": room.seen}
    return {
        "name": room.name,
        "polygon": exterior,
        "holes": holes,
        "entered": room.entered,
        **{key: value for key, value in known.items() if value is not None},
    }


def _door(door: TruthDoor) -> dict[str, Any]:
    """A door that no plan has to find is written as shut."""
    return {**_box(door), "kind": door.kind, "joins": list(door.joins), "open": door.required}


def _box(door: TruthDoor) -> dict[str, Any]:
    return {"bounds": _rounded(door.bounds), "axis": door.axis}


def _rounded(values: tuple[float, ...]) -> list[float]:
    return [round(float(v), DIGITS) for v in values]

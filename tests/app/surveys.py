"""Surveys of small buildings as files: with a wing, of two storeys, of buildings that stand apart."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.box_world import Survey, room, stations, survey, two_rooms
from tests.wing_world import WingWorld

STOREYS = ((4.0, 5.0), (6.0, 3.0))  # metres of the rooms above each other
STOREY = 3.2  # metres from floor to floor
APART = (180.0, 150.0)  # metres from one building to the other
_RAYS = (160, 50)


def write_survey(folder: Path, points: np.ndarray, scan_id: np.ndarray, places: np.ndarray) -> Path:
    """Points with their scans as a PLY and, beside it, where the scanner stood."""
    names = ("float x", "float y", "float z", "int scan_id")
    head = ("ply", "format ascii 1.0", f"element vertex {len(points)}")
    header = "\n".join([*head, *(f"property {name}" for name in names), "end_header"])
    table = np.column_stack([points, scan_id])
    np.savetxt(folder / "points.ply", table, "%.4f %.4f %.4f %d", header=header, comments="")
    at = [f"{k} {x:.4f} {y:.4f} {z:.4f} 0 0 0 1" for k, (x, y, z) in enumerate(places)]
    (folder / "trajectory.tum").write_text("\n".join(at) + "\n")
    return folder


def write_wing(folder: Path) -> Path:
    """Two rooms and a wing at 45 degrees."""
    scans = WingWorld(45.0).survey(10.0, rays=(150, 46))
    return write_survey(folder, scans.points, scans.scan_id, scans.poses[:, :3, 3])


def write_storeys(folder: Path) -> Path:
    """A room above another."""
    points, ids, places = [], [], []
    for level, size in enumerate(STOREYS):
        scans, up = survey(room(*size), stations(*size), rays=_RAYS), np.array([0.0, 0.0, level * STOREY])
        points.append(scans.points + up)
        ids.append(scans.scan_id + len(np.concatenate(places)) if places else scans.scan_id)
        places.append(scans.poses[:, :3, 3] + up)
    return write_survey(folder, np.concatenate(points), np.concatenate(ids), np.concatenate(places))


def campus() -> Survey:
    """Two buildings of two rooms each: 4 x 5 m here, 5 x 5 m :data:`APART`."""
    x, y = APART
    away = [(a + x, b + y, c, d + x, e + y, f) for a, b, c, d, e, f in two_rooms((2.0, 2.9, 2.1), width=5.0)]
    here = [place for k in (0.0, 4.1) for place in stations(4.0, 5.0, k)]
    there = [place for k in (0.0, 5.1) for place in stations(5.0, 5.0, x + k, y)]
    return survey([*two_rooms((1.0, 1.9, 2.1)), *away], [*here, *there], rays=_RAYS)


def write_campus(folder: Path) -> Path:
    """:func:`campus` as files."""
    scans = campus()
    return write_survey(folder, scans.points, scans.scan_id, scans.poses[:, :3, 3])

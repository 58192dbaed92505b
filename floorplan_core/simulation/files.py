"""Writing a survey: binary PLY with ``scan_id``, TUM trajectories, ``truth.json``."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from floorplan_core.files import output_folder, writing
from floorplan_core.simulation.poses import quaternions

if TYPE_CHECKING:
    from floorplan_core.simulation.survey import SimulatedSurvey

Float = NDArray[np.float64]

FLOAT_EXTENT = 2000.0  # m from the origin up to which float32 keeps a tenth of a millimetre


@dataclass(frozen=True)
class SurveyPaths:
    """The files of a simulated survey."""

    points: Path
    trajectory: Path
    trajectory_gt: Path
    truth: Path


def write_survey(survey: SimulatedSurvey, out: Path) -> SurveyPaths:
    """Write all files into the folder ``out`` (made where missing); all appear, or none.

    Raises:
        OutputError: no permission, no space, or ``out`` is a file.
    """
    content: list[tuple[str, Callable[[], bytes]]] = [
        ("points.ply", lambda: ply_bytes(survey.points, survey.scan_id)),
        ("trajectory.tum", lambda: tum_bytes(survey.stamps, survey.trajectory)),
        ("trajectory_gt.tum", lambda: tum_bytes(survey.stamps, survey.trajectory_gt)),
        ("truth.json", lambda: (json.dumps(survey.truth, indent=1) + "\n").encode()),
    ]
    with output_folder(out) as staging:
        for name, make in content:
            with writing(out / name):
                (staging / name).write_bytes(make())
    return SurveyPaths(*(out / name for name, _ in content))


def ply_bytes(points: Float, scan_id: NDArray[np.int32]) -> bytes:
    """Binary little-endian PLY; coordinates become doubles only where float32 would lose precision."""
    wide = bool(len(points)) and float(np.abs(points).max()) > FLOAT_EXTENT
    kind, name = ("<f8", "double") if wide else ("<f4", "float")
    record = np.empty(len(points), dtype=[("x", kind), ("y", kind), ("z", kind), ("scan_id", "<i4")])
    for axis, field in enumerate("xyz"):
        record[field] = points[:, axis]
    record["scan_id"] = scan_id
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    header += [f"property {name} {axis}" for axis in "xyz"] + ["property int scan_id", "end_header", ""]
    return "\n".join(header).encode() + record.tobytes()


def tum_bytes(stamps: Float, T: Float) -> bytes:
    """TUM lines ``timestamp tx ty tz qx qy qz qw``, seconds and metres, nine digits."""
    rows = np.column_stack([T[:, :3, 3], quaternions(T[:, :3, :3])])
    lines = [
        f"{stamp:.6f} " + " ".join(f"{value:.9f}" for value in row)
        for stamp, row in zip(stamps, rows, strict=True)
    ]
    return ("\n".join(["# timestamp tx ty tz qx qy qz qw", *lines]) + "\n").encode()

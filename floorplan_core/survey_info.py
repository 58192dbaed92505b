"""What a survey is, before anything is planned: the facts behind ``floorcast info``.

One pass over the points fills the map that a plan would be made of: extent, Manhattan frame and storeys come
from it, so memory grows with the building and not with the file. A bounded number of points is enough for a
first look.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.model import ManhattanFrame, Reconstruction, Trajectory
from floorplan_core.model.quarter_turns import quarters_to_world, turned_frame
from floorplan_core.model.storey import Storey
from floorplan_core.observer import Observer
from floorplan_core.replay import path_lengths
from floorplan_core.stages.askew_walls import TOLD, walls_at_angles
from floorplan_core.stages.storeys import find_storeys, is_tall
from floorplan_core.survey_map import SurveyMap

Float = NDArray[np.float64]

PIECE = 1_000_000  # surfels that are turned together
ENDS = (0.001, 0.999)  # quantiles between which the building lies: the rest may be ghosts


@dataclass(frozen=True)
class SurveyInfo:
    """Facts about one survey; lengths in metres, coordinates of the world frame."""

    name: str
    format: str
    points: int  # that were read
    points_in_file: int | None  # as the file says; None where only a pass can tell
    whole: bool  # False: only the first points were looked at
    low: Float  # (3,) corner of the box around all points
    high: Float  # (3,)
    size: Float  # (3,) along the walls, across them, and up; without ghosts
    unit: str
    up: str
    mirrored: bool  # the file's axes are left-handed: its mirror image is planned
    crs: str
    shift: Float  # (3,) subtracted inside
    scans: int | None
    trajectory: dict[str, float] | None  # poses, length_m, seconds
    topics: tuple[str, ...]
    frame: ManhattanFrame | None
    no_frame: str  # why there is none
    other: tuple[float, float]  # of walls at other angles: radians from the frame of most, share of all walls
    storeys: tuple[Storey, ...]  # none where the survey is planar
    floor_shift: float  # metres to add to the heights of storeys to have them in the world frame
    planar: bool  # a scan in one plane: it has no heights
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...] = field(default=())

    def as_dict(self) -> dict[str, Any]:
        """Plain values for JSON; names are part of the contract of ``floorcast info --json``."""
        return {
            "name": self.name,
            "format": self.format,
            "points": self.points,
            "points_in_file": self.points_in_file,
            "whole": self.whole,
            "extent": {"low": _rounded(self.low), "high": _rounded(self.high), "size": _rounded(self.size)},
            "unit": self.unit,
            "up": self.up,
            "mirrored": self.mirrored,
            "crs": self.crs,
            "shift": _rounded(self.shift),
            "scans": self.scans,
            "trajectory": self.trajectory,
            "planar": self.planar,
            "topics": list(self.topics),
            "manhattan": None if self.frame is None else _frame_facts(self.frame),
            "no_manhattan": self.no_frame,
            "other_direction": _other_facts(self.other),
            "storeys": [_storey_facts(s, self.floor_shift) for s in self.storeys],
            "assumptions": list(self.assumptions),
            "warnings": list(self.warnings),
        }


def describe(
    survey: Reconstruction, config: Config, observer: Observer, most_points: int | None = None
) -> SurveyInfo:
    """Read ``survey`` (at most about ``most_points``) and say what it is; never refuses a readable survey."""
    seen, low, high, points, whole = _read(survey, config, observer, most_points)
    frame, why, storeys = _directions(seen, config)
    xyz = _turned(seen, frame)
    local = survey.local_frame
    return SurveyInfo(
        name=survey.name,
        format=survey.format,
        points=points,
        points_in_file=survey.point_count,
        whole=whole,
        low=low + local.shift,
        high=high + local.shift,
        size=_size(xyz, seen.planar),
        unit=local.unit,
        up=local.up,
        mirrored=bool(np.linalg.det(local.rotation) < 0),
        crs=local.crs,
        shift=local.shift,
        scans=survey.scans,
        trajectory=None if survey.trajectory is None else _path_facts(survey.trajectory),
        topics=survey.topics,
        frame=frame,
        no_frame=why,
        other=_other(xyz, seen, storeys, config),
        storeys=() if seen.planar else storeys,
        floor_shift=float(local.shift[2] + seen.own.centre[2]),
        planar=seen.planar,
        assumptions=survey.assumptions,
    )


def _read(
    survey: Reconstruction, config: Config, observer: Observer, most_points: int | None
) -> tuple[SurveyMap, Float, Float, int, bool]:
    """The map, the box around all points (local frame), how many points, and whether these were all."""
    seen = SurveyMap(config)
    low, high, done, whole = np.full(3, np.inf), np.full(3, -np.inf), 0, True
    observer.stage_started("read", most_points or survey.point_count)
    for chunk in survey.chunks():
        observer.check_cancelled()
        if most_points is not None and done >= most_points:
            whole = False
            break
        seen.integrate_chunk(chunk, survey.trajectory)
        if len(chunk.points):
            low, high = np.minimum(low, chunk.points.min(axis=0)), np.maximum(high, chunk.points.max(axis=0))
        done += len(chunk.points)
        observer.progress("read", done)
    seen.finish()
    return seen, low if done else np.zeros(3), high if done else np.zeros(3), done, whole


def _directions(seen: SurveyMap, config: Config) -> tuple[ManhattanFrame | None, str, tuple[Storey, ...]]:
    """Frame and storeys, or why there are none: here any support of the frame will do."""
    if len(seen.surfels) == 0:
        return None, "it holds no usable points", ()
    loose = config.frame.model_copy(update={"min_support": 0.0})
    try:
        frame = seen.frame(loose)
        frame = turned_frame(frame, quarters_to_world(frame))
    except NoPlanError as error:
        return None, str(error), ()
    own = replace(frame, rotation=frame.rotation @ seen.own.rotation.T)
    some = seen.sample()
    tall = is_tall(some, own, config.storeys)
    return frame, "", find_storeys(seen.surfels.surfels() if tall else some, own, config.storeys)


def _turned(seen: SurveyMap, frame: ManhattanFrame | None) -> Float:
    """(N, 3) surfels in the frame where there is one; piece by piece, as nothing else of them is needed."""
    turn = np.eye(3) if frame is None else frame.rotation @ seen.own.rotation.T
    out, at = np.empty((len(seen.surfels), 3)), 0
    for piece in seen.surfels.pieces(PIECE):
        out[at : at + len(piece)] = piece.centroid @ turn.T
        at += len(piece)
    return out


def _other(xyz: Float, seen: SurveyMap, storeys: tuple[Storey, ...], config: Config) -> tuple[float, float]:
    """Nothing where so little stands at other angles that the plan would not speak of it."""
    if not storeys:
        return 0.0, 0.0
    walls, turn = walls_at_angles(xyz, seen.surfels.size, [s.floor_z for s in storeys], config.frame)
    return (turn, walls.share) if walls.area >= TOLD else (0.0, 0.0)


def _other_facts(other: tuple[float, float]) -> dict[str, float] | None:
    """None where there are none."""
    angle, share = other
    if share <= 0.0:
        return None
    return {"from_frame_deg": round(float(np.degrees(angle)), 2), "share": round(share, 4)}


def _size(xyz: Float, planar: bool) -> Float:
    if len(xyz) == 0:
        return np.zeros(3)
    low, high = np.stack([np.quantile(along, ENDS) for along in xyz.T], axis=1)
    return np.asarray((high - low) * (1.0, 1.0, 0.0 if planar else 1.0))  # it was lifted to walls


def _path_facts(path: Trajectory) -> dict[str, float]:
    if len(path) == 0:
        return {"poses": 0, "length_m": 0.0, "seconds": 0.0}
    return {
        "poses": len(path),
        "length_m": round(float(path_lengths(path)[-1]), 3),
        "seconds": round(float(path.stamps[-1] - path.stamps[0]), 3),
    }


def _frame_facts(frame: ManhattanFrame) -> dict[str, float]:
    return {
        "support": round(frame.support, 4),
        "yaw_deg": round(float(np.degrees(frame.yaw)), 3),
        "tilt_deg": round(float(np.degrees(frame.tilt)), 3),
        "wall_area_m2": round(frame.wall_area, 2),
    }


def _storey_facts(storey: Storey, shift_z: float) -> dict[str, Any]:
    ceiling = None if storey.ceiling_z is None else round(storey.ceiling_z + shift_z, 3)
    levels = [] if storey.floors is None else np.unique(storey.floors.heights).tolist()
    return {
        "storey": storey.number,
        "floor_m": round(storey.floor_z + shift_z, 3) + 0.0,
        "ceiling_m": ceiling,
        "half_levels_m": _rounded(np.array([z for z in levels if z != storey.floor_z]) + shift_z),
    }


def _rounded(values: Float) -> list[float]:
    return [round(float(v), 3) + 0.0 for v in values]

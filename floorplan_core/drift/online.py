"""Drift corrected while the run goes on: each plan is made of the whole path so far, put right by SL-LMS.

Integrating a scan costs the same at the end of a run as at its start: its points go to their keyframe. A plan
costs in proportion to the path so far, since what was seen long ago moves when a loop closes: all keyframes
are solved again and their points put together anew (paper, section on the online system).
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.drift.correction import find_correction, scan_moves
from floorplan_core.drift.keyframes import KeptPoints, Keyframes, by_keyframe, cut_path
from floorplan_core.drift.sightings import keyframe_patches
from floorplan_core.errors import InputError, NoPlanError
from floorplan_core.geometry.cell_normals import CellNormals
from floorplan_core.geometry.surfel_map import SurfelMap
from floorplan_core.model import FloorPlan, LocalFrame, PointChunk, Trajectory
from floorplan_core.model.corrections import Correction as Edit
from floorplan_core.model.storey import Storey
from floorplan_core.observer import Observer
from floorplan_core.pipeline import FloorPlanner
from floorplan_core.scan_checks import checked_points, checked_pose, checked_rows, in_world
from floorplan_core.stages.manhattan_frame import estimate_frame
from floorplan_core.stages.region_names import NamesOfRun, RegionNames

Float = NDArray[np.float64]

FAR = 10_000.0  # m from the origin at the first scan: a grid of the land survey, not where the run began


class CorrectingPlanner:
    """A :class:`FloorPlanner` for a path that drifts: integrate scans as they come, plan whenever wanted.

    :param correct: False leaves the path as it is given; it changes by :meth:`replace_path` only.
    """

    def __init__(
        self,
        config: Config | None = None,
        observer: Observer | None = None,
        source: str = "",
        local_frame: LocalFrame | None = None,
        correct: bool = True,
    ) -> None:
        self._correct = correct
        self.config = config or Config()
        self.observer = observer or Observer()
        self.source, self.local_frame = source, local_frame or LocalFrame()
        self.names: RegionNames = NamesOfRun()
        self._surfels = SurfelMap(self.config.voxels.size / 2)  # of the path as given: its frame is enough
        self._kept: dict[int, KeptPoints] = {}
        self._patches: dict[int, tuple[int, Float, CellNormals]] = {}  # with points and rotation of then
        self._poses: Float = np.zeros((64, 4, 4))  # of :meth:`integrate`: ``_scans`` of them
        self._scans = 0
        self._shift = np.zeros(3)  # metres, world minus local, of these poses where they begin far away
        self._trajectory: Trajectory | None = None
        self._rows = 0  # of the trajectory whose points are here
        self._moves: Float = np.zeros((0, 4, 4))
        self._corrected_path: Trajectory | None = None
        self._corrected: FloorPlanner | None = None

    def integrate(self, points: Float, T_world_sensor: Float) -> None:
        """Add one scan: (N, 3) metres in the sensor's frame; its (4, 4) pose, z up, as odometry has it."""
        if self._scans == len(self._poses):
            self._poses = np.concatenate([self._poses, np.zeros_like(self._poses)])
        pts, pose = checked_points(points), checked_pose(T_world_sensor)
        if self._scans == 0 and np.abs(pose[:3, 3]).max() > FAR and not self.local_frame.shift.any():
            self._shift = np.round(pose[:3, 3])
            self.local_frame = LocalFrame(shift=self._shift)
        pose = self._poses[self._scans] = self._local(pose)
        row = np.full(len(pts), self._scans, dtype=np.int32)
        self._scans += 1
        path = Trajectory(np.arange(self._scans, dtype=np.float64), self._poses[: self._scans])
        self.integrate_chunk(PointChunk(in_world(pts, pose), row), path)

    def integrate_chunk(self, chunk: PointChunk, trajectory: Trajectory | None) -> None:
        """Add points in the local frame; ``chunk.scan_id`` are rows of ``trajectory``, which may have grown.

        Raises :class:`NoPlanError` where the points do not say from where they were seen.
        """
        if trajectory is None or chunk.scan_id is None:
            raise NoPlanError(
                f"The points of {self.source or 'the run'} do not refer to a trajectory that could be "
                "corrected; leave drift.correct at false."
            )
        if not len(chunk.points):
            return
        _, last = checked_rows(chunk.scan_id, trajectory)
        self._trajectory, self._corrected = trajectory, None
        self._rows = max(self._rows, last + 1)
        for k, points, scan_id in by_keyframe(chunk, self._keyframes()):
            self._kept.setdefault(k, KeptPoints()).add(points, scan_id)
            none = np.full(len(points), -1, dtype=np.int32)
            self._surfels.insert(points, none, np.zeros((0, 3)), (0.0, np.inf))

    def replace_path(self, T_world_sensor: Float) -> None:
        """Take (S, 4, 4) other poses of all scans so far, as after a loop closure of the program that gives
        them: what each scan saw goes with its pose. Costs in proportion to the path.

        Raises :class:`InputError` where it is not one pose for each scan.
        """
        poses = [self._local(checked_pose(T)) for T in T_world_sensor]
        if len(poses) != self._rows:
            raise InputError(
                f"One pose for each of the {self._rows} scans so far is needed (given {len(poses)})."
            )
        if not poses:
            return
        before = self._given_path()
        path = replace(before, T_world_sensor=np.array(poses))
        moves = path.T_world_sensor @ np.linalg.inv(before.T_world_sensor)
        kept = [self._kept[k].all() for k in sorted(self._kept)]
        self._kept, self._patches, self._trajectory = {}, {}, path
        self._surfels = SurfelMap(self._surfels.size)
        self._poses[: min(self._scans, self._rows)] = path.T_world_sensor[: self._scans]
        for points, scan_id in kept:
            self.integrate_chunk(PointChunk(_moved(points, moves[scan_id]), scan_id), path)

    def storeys(self) -> tuple[Storey, ...]:
        """The storeys of all that was integrated so far; raises as that of :class:`FloorPlanner`."""
        return self._planner().storeys()

    def plan(self, storey: int = 0, corrections: Sequence[Edit] = ()) -> FloorPlan:
        """The plan of the run so far, its path corrected; raises as that of :class:`FloorPlanner`."""
        return self._planner().plan(storey=storey, corrections=corrections)

    @property
    def map_from_odom(self) -> Float:
        """(4, 4) what takes the latest pose as it was given to where the last plan has it; world frame.

        A robot multiplies its poses with it from the left until the next plan (as in ROS: ``map``, ``odom``).
        """
        moved = self._moves[-1].copy() if len(self._moves) else np.eye(4)
        shift = self.local_frame.shift
        moved[:3, 3] += shift - moved[:3, :3] @ shift
        return moved

    @property
    def path(self) -> Trajectory | None:
        """The path so far as the last plan has it, local frame; None before the first."""
        return self._corrected_path

    def _local(self, pose: Float) -> Float:
        return np.block([[pose[:3, :3], (pose[:3, 3] - self._shift)[:, None]], [pose[3:]]])

    def _keyframes(self) -> Keyframes:
        return cut_path(self._given_path(), self.config.drift.keyframe)

    def _given_path(self) -> Trajectory:
        assert self._trajectory is not None  # of integrate_chunk
        given = self._trajectory
        rows = slice(self._rows)
        sensor = None if given.sensor is None else given.sensor[rows]
        return Trajectory(given.stamps[rows], given.T_world_sensor[rows], sensor)

    def _planner(self) -> FloorPlanner:
        """The points so far, where the corrected path puts them."""
        if self._corrected is None:
            planner = FloorPlanner(self.config, self.observer, self.source, self.local_frame)
            planner.names = self.names
            if len(self._surfels):
                path = self._corrected_path = self._put_right(self._given_path())
                for k in sorted(self._kept):
                    points, scan_id = self._kept[k].all()
                    moved = _moved(points, self._moves[scan_id])
                    planner.integrate_chunk(PointChunk(moved, scan_id), path)
            self._corrected = planner
        return self._corrected

    def _put_right(self, path: Trajectory) -> Trajectory:
        """The corrected path; keyframes whose points are the same as before keep their patches."""
        if not self._correct:
            self._moves = np.tile(np.eye(4), (len(path), 1, 1))
            return path
        began = time.perf_counter()
        self.observer.stage_started("drift")
        keyframes = cut_path(path, self.config.drift.keyframe)
        rotation = estimate_frame(self._surfels.surfels(), self.config.frame).rotation
        patches = [self._patches_of(k, origin, rotation) for k, origin in enumerate(keyframes.origin)]
        correction = find_correction(
            patches, keyframes, rotation, self.config.drift, self.observer.check_cancelled
        )
        self._moves = scan_moves(correction, keyframes, path, rotation)
        self.observer.stage_finished("drift", time.perf_counter() - began)
        return replace(path, T_world_sensor=self._moves @ path.T_world_sensor)

    def _patches_of(self, k: int, origin: Float, rotation: Float) -> CellNormals:
        """What keyframe ``k`` saw, from its origin, in the axes of the frame."""
        points = self._kept[k].all()[0] if k in self._kept else np.zeros((0, 3))
        count, axes, patches = self._patches.get(k, (-1, rotation, None))
        if patches is None or count != len(points):
            axes = rotation
            patches = keyframe_patches(points, origin, rotation, self.config.frame)
            self._patches[k] = len(points), axes, patches
        turn = rotation @ axes.T  # since they were made
        return replace(patches, centre=patches.centre @ turn.T, normal=patches.normal @ turn.T)


def _moved(points: Float, moves: Float) -> Float:
    """(N, 3) points, each by its own (N, 4, 4) transform."""
    return np.asarray(np.einsum("nij,nj->ni", moves[:, :3, :3], points) + moves[:, :3, 3])

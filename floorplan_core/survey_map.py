"""The map of a survey as it grows: surfels of what was hit, rays through what is free, and the sensor's path.

``integrate`` costs O(points of the scan), however long the run. Sums are integers and do not depend on how
the points were cut into chunks. Two kinds of survey are prepared first, decided on the first points of the
run: the centres of a coarse voxel map are subdivided so that its surfaces have no holes, and a planar scan is
lifted to walls of full height.
"""

from __future__ import annotations

import math
import os
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config, FrameConfig, VoxelConfig
from floorplan_core.geometry.lattice import lattice_spacing, subdivide
from floorplan_core.geometry.own_frame import OwnFrame, own_frame
from floorplan_core.geometry.planar import is_planar, lift
from floorplan_core.geometry.ray_carving import MissMap
from floorplan_core.geometry.surfel_map import SurfelMap, Surfels
from floorplan_core.kernel_times import stopwatch
from floorplan_core.memory import free_memory
from floorplan_core.model import ManhattanFrame, PointChunk, Trajectory
from floorplan_core.scan_checks import Points, Scan, checked_points, checked_pose, checked_rows, in_world
from floorplan_core.stages.manhattan_frame import estimate_frame, seen_from

Float = NDArray[np.float64]

MOST_RESERVED = 2_000_000  # surfels for which room is made in advance: 90 MB
_SHARE = 0.5  # of free memory that surfels may take; the plan needs about as much again
_MOST = 1e9  # bytes of it: from there on a disk costs less CPU than it saves memory (decision 34)
_RAYS = 0.25  # of the same for the ray counts of all threads: a quarter of what surfels take
FILE_RAYS = 3  # that a voxel counts for which the file says is free: a lone hit in it does not fill it
SAMPLE_SURFELS = 250_000  # that the frame is estimated from
PIECE = 50_000  # points at least whose rays a thread follows before it asks for more
HELPERS = max(1, min(3, (os.cpu_count() or 2) - 1))  # threads that follow rays beside the one that inserts
# of a chunk at most: asking needs the interpreter's lock, which the decoder of LAZ holds for 15 to 30 ms
PIECES = 1 + 4 * HELPERS
SAMPLE = 100_000  # first points of a run, which show what kind of survey it is; waiting takes 3 MB


class SurveyMap:
    """Surfels, ray counts and the sensor's path, from scans as they come."""

    def __init__(self, config: Config) -> None:
        self._room = _room(config.voxels)
        self.surfels = SurfelMap(config.voxels.size / 2, self._room)
        self.rays = self._no_rays(config.voxels.size)
        # those that other threads followed: one for each but the first helper
        self._more_rays = [self._no_rays(config.voxels.size) for _ in range(HELPERS)]
        self.seconds = 0.0  # spent on integrating so far
        self.planar = False  # True: a planar scan, lifted
        self.own = OwnFrame()  # of the map: what takes the local frame into it
        self._limits = (config.input.min_range, config.input.max_range)
        self._own_axes = config.voxels.own_axes
        self._path: list[Float] = []
        self._rows: tuple[Trajectory, int, int] | None = None  # first and last row that saw a point so far
        self._helpers = [ThreadPoolExecutor(1) for _ in range(HELPERS)]
        self._carving: list[Future[None]] = []  # the helpers' shares of the last chunk
        self._lattice: float | None = (
            None  # m between the points of a voxel map; 0: none; None: not known yet
        )
        self._sample: tuple[int, Surfels] | None = None  # the last one, of so many points
        self._waiting: list[Scan] = []  # what came before that was known
        self._expected = 0  # surfels, of a run whose length is known
        self._first: list[Scan] = []  # the same, kept where it was decided on fewer points than it takes

    def expect(self, points: int) -> None:
        """Say how many points will come, so that the map need not grow step by step."""
        self._expected = min(points, MOST_RESERVED)
        self.surfels.reserve(self._expected)

    def integrate(self, points: Float, T_world_sensor: Float | None = None) -> None:
        """Add one scan: (N, 3) metres in the sensor frame, or in the world where no pose (4, 4) is given."""
        pts = checked_points(points)
        if T_world_sensor is None:
            self._integrate(pts, np.full(len(pts), -1, dtype=np.int32), np.zeros((0, 3)))
            return
        pose = checked_pose(T_world_sensor)
        self._path.append(pose[None, :3, 3])
        self._integrate(in_world(pts, pose), np.zeros(len(pts), dtype=np.int32), pose[None, :3, 3])

    def integrate_chunk(self, chunk: PointChunk, trajectory: Trajectory | None) -> None:
        """Add points that are in the local frame already; ``chunk.scan_id`` are rows of ``trajectory``.

        Raises :class:`InputError` where the trajectory has no such row.
        """
        if chunk.free is not None and len(chunk.free):
            self._mark_free(chunk.free, chunk.free_size)
        if chunk.scan_id is None or trajectory is None:
            self._integrate(chunk.points, np.full(len(chunk.points), -1, dtype=np.int32), np.zeros((0, 3)))
        elif len(chunk.scan_id):
            first, last = checked_rows(chunk.scan_id, trajectory)
            self._follow(trajectory, first, last)
            origins = trajectory.origins[first : last + 1]
            self._integrate(chunk.points, chunk.scan_id - np.int32(first), origins)

    def settle(self) -> None:
        """Decide on the first points, however they were cut, what kind of survey it is; add what waits.

        Where fewer came than it takes, the decision holds only until more do: a plan in between changes
        nothing of the later ones.
        """
        waiting, self._waiting = self._waiting, []
        if waiting:
            self._first = waiting if _count(waiting) < SAMPLE and not self.rays.blocks else []
            first = np.concatenate([w[0][:SAMPLE] for w in waiting])[:SAMPLE]
            self.planar = is_planar(first) and all(len(w[2]) for w in waiting)
            self._lattice = 0.0 if self.planar else lattice_spacing(first)
            if (
                self._own_axes and not self._lattice and not self.rays.blocks
            ):  # voxels of the file keep their axes
                self.own = own_frame(first, level=not self.planar)
        for points, scan, origins in waiting:
            self._add(points, scan, origins)
        self._wait()
        for rays in self._more_rays:
            if rays.blocks:
                self.rays.take(rays)

    def finish(self) -> None:
        """All points came: let go of what only further ones need."""
        self.settle()
        self.surfels.pack()
        self.rays.pack()
        self._more_rays = [self._no_rays(self.rays.size) for _ in self._more_rays]

    def sample(self) -> Surfels:
        """Enough surfels to see the directions of the building: whole blocks, spread over the survey."""
        if self._sample is None or self._sample[0] != self.surfels.points:
            every = max(1, len(self.surfels) // SAMPLE_SURFELS)
            self._sample = self.surfels.points, self.surfels.surfels(every)
        return self._sample[1]

    def frame(self, config: FrameConfig) -> ManhattanFrame:
        """The Manhattan frame of the local frame (about the map's centre), estimated on the map."""
        asked = config.yaw_deg
        if asked is not None:
            turned = math.degrees(math.atan2(self.own.rotation[1, 0], self.own.rotation[0, 0]))
            config = config.model_copy(update={"yaw_deg": asked + turned})
        frame = estimate_frame(self.sample(), config, self._lattice or 0.0)
        return seen_from(frame, self.own.rotation, asked)

    def path(self) -> Float:
        """(M, 3) sensor positions so far, frame of the map."""
        parts = [np.zeros((0, 3)), *self._path]
        if self._rows is not None:
            trajectory, first, last = self._rows
            parts.append(trajectory.origins[first : last + 1])
        path = np.concatenate(parts)
        return self.own.move_exactly(path) if self.own.is_another else path

    def _mark_free(self, centres: Points, side: float) -> None:
        """Free voxels that the file itself knows (an OctoMap): they need no viewpoints."""
        seconds = stopwatch()
        self._wait()
        self.rays.mark(subdivide(centres, side, self.surfels.size), FILE_RAYS)
        self.seconds += seconds()

    def _follow(self, trajectory: Trajectory, first: int, last: int) -> None:
        """Widen the part of the trajectory that was used: the path does not depend on the chunks."""
        if self._rows is not None:
            first, last = min(first, self._rows[1]), max(last, self._rows[2])
        self._rows = (trajectory, first, last)

    def _integrate(self, points: Points, scan: NDArray[np.int32], origins: Float) -> None:
        if self._first:
            self._begin_again()
        if self._lattice is not None:
            self._add(points, scan, origins)
            return
        self._waiting.append((points.copy(), scan, origins))
        if _count(self._waiting) >= SAMPLE:
            self.settle()

    def _begin_again(self) -> None:
        """As before anything was decided; the points so far wait for more."""
        self._waiting, self._first = self._first, []
        self.surfels, self.rays = SurfelMap(self.surfels.size, self._room), self._no_rays(self.rays.size)
        self.surfels.reserve(self._expected)
        self._lattice, self.planar, self.own, self._sample = None, False, OwnFrame(), None

    def _add(self, points: Points, scan: NDArray[np.int32], origins: Float) -> None:
        seconds, given = stopwatch(), points
        points, scan, origins = self._prepared(points, scan, origins)
        piece = max(PIECE, len(points) // PIECES)
        pieces = deque(range(0, len(points) if len(origins) else 0, piece))

        def carve(rays: MissMap) -> None:
            while pieces:
                with suppress(IndexError):  # another thread took the last one
                    part = slice(start := pieces.popleft(), start + piece)
                    rays.carve(points[part], scan[part], origins, self._limits)

        own, *others = self._more_rays
        before = self._carving
        shares = zip(self._helpers, (self.rays, *others), strict=True)
        self._carving = [helper.submit(carve, rays) for helper, rays in shares]
        self.surfels.insert(points, scan, origins, self._limits)
        carve(own)
        for share in before:
            share.result()  # of the chunk before: the last rays of this one are followed beside the next
        if points is given:
            self._wait()  # an array of the caller, who may use it for something else now
        self.seconds += seconds()

    def _wait(self) -> None:
        """Until the helpers have followed all rays so far."""
        for share in self._carving:
            share.result()

    def _no_rays(self, size: float) -> MissMap:
        """Ray counts to begin with; each thread has its own, and they are added up."""
        return MissMap(size, _RAYS * self._room / (HELPERS + 1))

    def _prepared(self, points: Points, scan: NDArray[np.int32], origins: Float) -> Scan:
        """The scan in the frame of the map, with a voxel map subdivided and a planar scan lifted."""
        if self.own.is_another:
            points, origins = self.own.move(points), self.own.move_exactly(origins)
        if self.planar:
            points, scan, origins = lift(points, scan, origins)
        elif self._lattice and self._lattice > self.surfels.size:
            dense = subdivide(points, self._lattice, self.surfels.size)
            points, scan = dense, np.repeat(scan, len(dense) // max(len(points), 1))
        return (
            points,
            np.ascontiguousarray(scan, dtype=np.int32),
            np.ascontiguousarray(origins, dtype=np.float64),
        )


def _room(config: VoxelConfig) -> float:
    """Bytes that the surfels may take in memory."""
    if config.memory is not None:
        return config.memory * 1e6
    free = free_memory()
    return _MOST if free is None else min(_SHARE * free, _MOST)


def _count(scans: list[Scan]) -> int:
    return sum(len(points) for points, _, _ in scans)

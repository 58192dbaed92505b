"""The order of the stages. Online is the primitive: batch is one call of ``integrate_chunk`` for each chunk.

integrate   points into surfels, rays into the voxel map       O(points of the scan)
plan        frame, voxel columns, segments, planes, doors, universe, candidates, cover, regions, labels
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.errors import InputError, NoPlanError
from floorplan_core.geometry.lattice import lattice_spacing, subdivide
from floorplan_core.geometry.ray_carving import MissMap
from floorplan_core.geometry.surfel_map import SurfelMap
from floorplan_core.model import (
    CandidateSet,
    Door,
    Facing,
    FloorPlan,
    LayoutPlane,
    LocalFrame,
    OccupancyGrid,
    PointChunk,
    Reconstruction,
    RectangleCover,
    Region,
    Trajectory,
)
from floorplan_core.observer import Observer
from floorplan_core.stages.blockers import blockers, close_corners, remove_beams
from floorplan_core.stages.candidates import enumerate_candidates
from floorplan_core.stages.doors import find_doors
from floorplan_core.stages.labels import label_regions
from floorplan_core.stages.layout_planes import find_planes, recessed
from floorplan_core.stages.layout_segments import find_segments
from floorplan_core.stages.manhattan_frame import estimate_frame
from floorplan_core.stages.occupancy import slice_map
from floorplan_core.stages.region_names import next_number, persist_names
from floorplan_core.stages.regions import build_regions, connect_doors
from floorplan_core.stages.set_cover import cover as cover_free_space
from floorplan_core.stages.speculation import frontier_planes
from floorplan_core.stages.voxel_columns import gather_evidence
from floorplan_core.stages.wall_points import thin_wall_points

if TYPE_CHECKING:
    from floorplan_core.plugins import RegionClassifier

Float = NDArray[np.float64]
T = TypeVar("T")

MOST_RESERVED = 2_000_000  # surfels for which room is made in advance: 90 MB
MIN_SURFELS = 200  # fewer occupied voxels hold no room
LATTICE_SAMPLE = 100_000  # first points of a run, which show whether it is a voxel map; waiting takes 3 MB

Points = NDArray[np.float64] | NDArray[np.float32]
Scan = tuple[Points, NDArray[np.int32], Float]  # points, the row of the origins that saw each, origins


class FloorPlanner:
    """Integrate scans as they come, ask for a plan whenever one is wanted."""

    def __init__(
        self, config: Config | None = None, observer: Observer | None = None, source: str = "",
        local_frame: LocalFrame | None = None,
    ) -> None:  # fmt: skip
        self.config = config or Config()
        self.observer = observer or Observer()
        self.source = source
        self.local_frame = local_frame or LocalFrame()
        self._surfels = SurfelMap(self.config.voxels.size / 2)
        self._misses = MissMap(self.config.voxels.size)
        self._path: list[Float] = []
        self._rows: tuple[Trajectory, int, int] | None = None  # first and last row that saw a point so far
        self._names: tuple[Region, ...] = ()
        self._unused = 1  # the lowest number that no region of the run ever had
        self._pool = ThreadPoolExecutor(1)
        self._lattice: float | None = (
            None  # m between the points of a voxel map; 0: no lattice; None: not known yet
        )
        self._waiting: list[Scan] = []  # what came before that was known
        self.seconds: dict[str, float] = {}

    def expect(self, points: int) -> None:
        """Say how many points will come, so that the maps need not grow step by step."""
        self._surfels.reserve(min(points, MOST_RESERVED))

    def integrate(self, points: Float, T_world_sensor: Float | None = None) -> None:
        """Add one scan.

        :param points: (N, 3) metres; in the sensor's frame, or in the world's where no pose is given.
        :param T_world_sensor: (4, 4) pose of the sensor, z up; None: there is no viewpoint.
        """
        pts = np.asarray(points).reshape(-1, 3)
        if T_world_sensor is None:
            self._integrate(pts, np.full(len(pts), -1, dtype=np.int32), np.zeros((0, 3)))
            return
        pose = np.asarray(T_world_sensor, dtype=np.float64)
        if pose.shape != (4, 4) or not np.isfinite(pose).all():
            raise InputError(f"A pose must be a 4 x 4 matrix of finite numbers (given {pose.tolist()}).")
        with np.errstate(invalid="ignore"):  # what is not a number is left out later
            world = pts @ pose[:3, :3].T + pose[:3, 3]
        self._path.append(pose[None, :3, 3])
        self._integrate(world, np.zeros(len(pts), dtype=np.int32), pose[None, :3, 3])

    def integrate_chunk(self, chunk: PointChunk, trajectory: Trajectory | None) -> None:
        """Add points that are in the local frame already; ``chunk.scan_id`` are rows of ``trajectory``.

        Raises :class:`InputError` where the trajectory has no such row.
        """
        if chunk.scan_id is None or trajectory is None:
            self._integrate(chunk.points, np.full(len(chunk.points), -1, dtype=np.int32), np.zeros((0, 3)))
        elif len(chunk.scan_id):
            first, last = int(chunk.scan_id.min()), int(chunk.scan_id.max())
            if first < 0 or last >= len(trajectory):
                raise InputError(
                    f"Points refer to the scans {first} to {last}, the trajectory has the rows 0 to "
                    f"{len(trajectory) - 1}; give the trajectory of this survey."
                )
            self._follow(trajectory, first, last)
            origins = trajectory.origins[first : last + 1]
            self._integrate(chunk.points, chunk.scan_id - np.int32(first), origins)

    def _follow(self, trajectory: Trajectory, first: int, last: int) -> None:
        """Widen the part of the trajectory that was used: the path does not depend on the chunks."""
        if self._rows is not None:
            first, last = min(first, self._rows[1]), max(last, self._rows[2])
        self._rows = (trajectory, first, last)

    def _sensor_path(self) -> Float:
        """(M, 3) sensor positions so far, local frame."""
        parts = [np.zeros((0, 3)), *self._path]
        if self._rows is not None:
            trajectory, first, last = self._rows
            parts.append(trajectory.origins[first : last + 1])
        return np.concatenate(parts)

    def _integrate(self, points: Points, scan: NDArray[np.int32], origins: Float) -> None:
        if self._lattice is not None:
            self._add(points, scan, origins)
            return
        self._waiting.append((points.copy(), scan, origins))
        if sum(len(waiting[0]) for waiting in self._waiting) >= LATTICE_SAMPLE:
            self._begin()

    def _begin(self) -> None:
        """Decide on the run's first points, however they were cut, whether it is a voxel map; add them."""
        waiting, self._waiting = self._waiting, []
        if waiting:
            self._lattice = lattice_spacing(np.concatenate([w[0] for w in waiting])[:LATTICE_SAMPLE])
        for points, scan, origins in waiting:
            self._add(points, scan, origins)

    def _add(self, points: Points, scan: NDArray[np.int32], origins: Float) -> None:
        began = time.perf_counter()
        limits = (self.config.input.min_range, self.config.input.max_range)
        points, scan = self._densify(points, scan)
        scan, origins = (
            np.ascontiguousarray(scan, dtype=np.int32),
            np.ascontiguousarray(origins, dtype=np.float64),
        )
        carving = self._pool.submit(self._misses.carve, points, scan, origins, limits)
        self._surfels.insert(points, scan, origins, limits)
        carving.result()
        self.seconds["integrate"] = self.seconds.get("integrate", 0.0) + time.perf_counter() - began

    def _densify(self, points: Points, scan: NDArray[np.int32]) -> tuple[Points, NDArray[np.int32]]:
        """The points of a coarse voxel map, subdivided so that its surfaces have no holes."""
        if not self._lattice or self._lattice <= self._surfels.size:
            return points, scan
        dense = subdivide(points, self._lattice, self._surfels.size)
        return dense, np.repeat(scan, len(dense) // max(len(points), 1))

    def plan(self, given: Sequence[object] = ()) -> FloorPlan:
        """The floor plan of all that was integrated so far; raises :class:`NoPlanError` where there is none.

        :param given: results of the first stages of an earlier run, in their order; they are taken as they
            are (:mod:`floorplan_core.restart`).
        """
        self._begin()
        if not given and len(self._surfels) < MIN_SURFELS:
            raise NoPlanError(
                f"Too little to make a plan of: {self._surfels.points} points in {len(self._surfels)} voxels "
                f"of {self._surfels.size:g} m; check the unit (--unit) or give more scans."
            )
        config, warnings = self.config, list[str]()
        seconds = {"integrate": self.seconds.get("integrate", 0.0)}
        path = self._sensor_path()
        earlier = iter(given)

        def stage(name: str, work: Callable[[], T]) -> T:
            self.observer.check_cancelled()
            if (known := next(earlier, None)) is not None:
                return cast(T, known)
            self.observer.stage_started(name)
            began = time.perf_counter()
            result = work()
            took = time.perf_counter() - began
            seconds[name] = seconds.get(name, 0.0) + took
            self.observer.stage_finished(name, took, result)
            return result

        surfels = stage("frame", self._surfels.surfels)
        frame = stage("frame", lambda: estimate_frame(surfels, config.frame))
        evidence = stage(
            "occupancy", lambda: gather_evidence(surfels, self._misses, frame, path, config.voxels)
        )
        segments, rows = stage("segments", lambda: find_segments(evidence, config.segments))
        segments, planes = stage(
            "planes", lambda: find_planes(segments, rows, evidence, config.planes, config.doors)
        )
        planes = stage(
            "planes",
            lambda: close_corners(remove_beams(planes, config.doors.max_beamless, config.doors.lintel_depth)),
        )
        doors = stage("doors", lambda: find_doors(planes, evidence, config.doors))
        grid = stage("occupancy", lambda: slice_map(evidence, planes, doors, config.occupancy))
        walls = blockers(planes, doors)
        behind = recessed(planes, config.planes.recess)
        paired = [p for p in planes if p.support >= config.planes.min_support and p.id not in behind]
        candidates = stage("candidates", lambda: _candidates(paired, walls, grid, config, self.observer))
        cover = stage("cover", lambda: cover_free_space(candidates, grid, config.cover, self.observer))
        planes, cover = stage("cover", lambda: _cover_the_rest(planes, paired, walls, cover, grid, config))
        regions = stage(
            "regions", lambda: build_regions(cover, planes, segments, doors, grid, config.regions)
        )
        regions, doors = stage("regions", lambda: connect_doors(regions, doors))
        if not regions:
            raise NoPlanError(
                "No region came out: the free space seen is not enclosed by any pair of walls; "
                "scan more walls, or raise candidates.max_ratio."
            )
        regions = stage("labels", lambda: label_regions(regions, self._classifier(), config))
        if self._names:
            regions, doors = _rename(self._names, regions, doors, self._unused)
        left = int(cover.uncovered.sum()) * grid.cell**2
        if left > 1.0:
            warnings.append(
                f"{left:.1f} m2 of free space are in no region: no rectangle of walls encloses them."
            )
        points = stage("regions", lambda: thin_wall_points(evidence, segments))
        self.observer.check_cancelled()
        self._names, self._unused = regions, max(self._unused, next_number(regions))
        for text in warnings:
            self.observer.warning(text)
        return FloorPlan(
            frame,
            self.local_frame,
            segments,
            planes,
            doors,
            grid,
            candidates,
            cover,
            regions,
            points,
            evidence.path,
            self.source,
            self._surfels.points,
            config,
            tuple(warnings),
            seconds,
        )

    def _classifier(self) -> RegionClassifier:
        from floorplan_core.stages.labels import PaperClassifier

        if self.config.labels.classifier == PaperClassifier.name:
            return PaperClassifier()
        from floorplan_core.plugins import find_classifier

        return find_classifier(self.config.labels.classifier)


def _candidates(
    planes: list[LayoutPlane], walls: Float, grid: OccupancyGrid, config: Config, observer: Observer
) -> CandidateSet:
    east, west, north, south = (
        np.unique([p.offset for p in planes if p.facing == facing]) for facing in Facing
    )
    return enumerate_candidates(east, west, north, south, walls, grid, config.candidates, observer)


def _cover_the_rest(
    planes: tuple[LayoutPlane, ...],
    paired: list[LayoutPlane],
    walls: Float,
    cover: RectangleCover,
    grid: OccupancyGrid,
    config: Config,
) -> tuple[tuple[LayoutPlane, ...], RectangleCover]:
    """Cover what is left with the help of speculated planes at its frontier."""
    from dataclasses import replace

    extra = frontier_planes(cover.uncovered, grid, paired, walls)
    if not extra:
        return planes, cover
    rest = replace(grid, universe=cover.uncovered)
    narrow = config.model_copy(
        update={
            "candidates": config.candidates.model_copy(update={"min_side": config.candidates.min_rest_side})
        }
    )
    candidates = _candidates([*paired, *extra], walls, rest, narrow, Observer())
    more = cover_free_space(candidates, rest, config.cover)
    joined = RectangleCover(
        np.concatenate([cover.chosen, np.full(len(more), -1, dtype=np.int64)]),
        np.concatenate([cover.bounds, more.bounds]),
        np.concatenate([cover.total_cells, more.total_cells]),
        np.concatenate([cover.free_cells, more.free_cells]),
        np.concatenate([cover.gained, more.gained]),
        more.uncovered,
    )
    used = {round(float(v), 9) for v in more.bounds.ravel()}
    return (*planes, *(p for p in extra if round(p.offset, 9) in used)), joined


def _rename(
    previous: tuple[Region, ...], regions: tuple[Region, ...], doors: tuple[Door, ...], unused: int
) -> tuple[tuple[Region, ...], tuple[Door, ...]]:
    """Names and ids that persist from the plan before."""
    from dataclasses import replace

    named = persist_names(previous, regions, unused)
    new_id = {old.id: new.id for old, new in zip(regions, named, strict=True)}
    return named, tuple(replace(d, connects=tuple(new_id[c] for c in d.connects)) for d in doors)


def process(
    reconstruction: Reconstruction, config: Config | None = None, observer: Observer | None = None
) -> FloorPlan:
    """The batch call: integrate every chunk, then plan."""
    observer = observer or Observer()
    planner = FloorPlanner(config, observer, reconstruction.name, reconstruction.local_frame)
    planner.expect(reconstruction.point_count or 0)
    began, done = time.perf_counter(), 0
    observer.stage_started("read", reconstruction.point_count)
    for chunk in reconstruction.chunks():
        observer.check_cancelled()
        planner.integrate_chunk(chunk, reconstruction.trajectory)
        done += len(chunk.points)
        observer.progress("read", done)
    planner._begin()
    took = time.perf_counter() - began
    observer.stage_finished("read", took)
    plan = planner.plan()
    plan.seconds["read"] = took - plan.seconds["integrate"]
    return plan

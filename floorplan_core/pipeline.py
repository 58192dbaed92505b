"""The order of the stages. Online is the primitive: batch is one call of ``integrate_chunk`` for each chunk.

integrate   points into surfels, rays into the voxel map       O(points of the scan)
plan        frame and storey, voxel columns, segments, planes, doors, universe, candidates, cover, regions,
            labels
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError, UsageError
from floorplan_core.model import (
    Door,
    FloorPlan,
    LocalFrame,
    ManhattanFrame,
    OccupancyGrid,
    PointChunk,
    Reconstruction,
    RectangleCover,
    Region,
    Trajectory,
)
from floorplan_core.model.evidence import Evidence
from floorplan_core.model.storey import Storey
from floorplan_core.observer import Observer
from floorplan_core.stages.blockers import blockers, close_corners, remove_beams
from floorplan_core.stages.candidates import pair_planes
from floorplan_core.stages.doors import find_doors
from floorplan_core.stages.labels import label_regions
from floorplan_core.stages.layout_planes import find_planes, mark_recesses, pairable
from floorplan_core.stages.layout_segments import find_segments
from floorplan_core.stages.manhattan_frame import estimate_frame
from floorplan_core.stages.occupancy import slice_map
from floorplan_core.stages.region_names import keep_names, next_number
from floorplan_core.stages.regions import build_regions, connect_doors
from floorplan_core.stages.set_cover import cover as cover_free_space
from floorplan_core.stages.speculation import cover_the_rest
from floorplan_core.stages.storeys import (
    find_storeys,
    is_tall,
    restrict_evidence,
    restrict_path,
    restrict_surfels,
)
from floorplan_core.stages.voxel_columns import gather_evidence
from floorplan_core.stages.wall_points import thin_wall_points
from floorplan_core.survey_map import SurveyMap

if TYPE_CHECKING:
    from floorplan_core.plugins import RegionClassifier

Float = NDArray[np.float64]
T = TypeVar("T")

MIN_SURFELS = 200  # fewer occupied voxels hold no room
LEFT_OUT = 1.0  # m2 of free space in no region, from which the user is told


class StageRunner:
    """Runs stage after stage: progress, wall time, cancellation, and what an earlier run made already."""

    def __init__(self, observer: Observer, given: Sequence[object], integrating: float) -> None:
        self.seconds = {"integrate": integrating}
        self._observer = observer
        self._given = iter(given)

    def __call__(self, name: str, work: Callable[[], T]) -> T:
        """The result of ``work``, or the next of the given results; the time is added to stage ``name``."""
        self._observer.check_cancelled()
        if (known := next(self._given, None)) is not None:
            return cast(T, known)
        self._observer.stage_started(name)
        began = time.perf_counter()
        result = work()
        took = time.perf_counter() - began
        self.seconds[name] = self.seconds.get(name, 0.0) + took
        self._observer.stage_finished(name, took, result)
        return result


class FloorPlanner:
    """Integrate scans as they come, ask for a plan whenever one is wanted."""

    def __init__(
        self,
        config: Config | None = None,
        observer: Observer | None = None,
        source: str = "",
        local_frame: LocalFrame | None = None,
    ) -> None:
        self.config = config or Config()
        self.observer = observer or Observer()
        self.source = source
        self.local_frame = local_frame or LocalFrame()
        self.map = SurveyMap(self.config)
        self._names: dict[int, tuple[Region, ...]] = {}  # of each storey's plan before
        self._unused: dict[int, int] = {}  # the lowest number that no region of a storey ever had
        self._found: tuple[int, ManhattanFrame, tuple[Storey, ...]] | None = None  # after so many points

    def integrate(self, points: Float, T_world_sensor: Float | None = None) -> None:
        """Add one scan.

        :param points: (N, 3) metres; in the sensor's frame, or in the world's where no pose is given.
        :param T_world_sensor: (4, 4) pose of the sensor, z up; None: there is no viewpoint.
        """
        self.map.integrate(points, T_world_sensor)

    def integrate_chunk(self, chunk: PointChunk, trajectory: Trajectory | None) -> None:
        """Add points that are in the local frame already; ``chunk.scan_id`` are rows of ``trajectory``."""
        self.map.integrate_chunk(chunk, trajectory)

    def storeys(self) -> tuple[Storey, ...]:
        """The storeys of all that was integrated so far, lowest first; nearly always one.

        Raises :class:`NoPlanError` where there is no Manhattan frame to find them in.
        """
        return self._frame_and_storeys()[1]

    def plan(self, given: Sequence[object] = (), storey: int = 0) -> FloorPlan:
        """The floor plan of all that was integrated so far; raises :class:`NoPlanError` where there is none.

        :param given: results of the first stages of an earlier run, in their order; they are taken as they
            are (:mod:`floorplan_core.restart`).
        :param storey: number of the storey, 0 for the lowest; :class:`UsageError` where it is not there.
        """
        self.map.settle()
        config, stage = self.config, StageRunner(self.observer, given, self.map.seconds)

        frame = stage("frame", lambda: self._frame_of(storey))
        evidence = stage("occupancy", lambda: self._evidence_of(storey, frame))
        segments, rows = stage("segments", lambda: find_segments(evidence, config.segments))
        segments, planes = stage(
            "planes", lambda: find_planes(segments, rows, evidence, config.planes, config.doors)
        )
        planes = stage(
            "planes",
            lambda: close_corners(remove_beams(planes, config.doors.max_beamless, config.doors.lintel_depth)),
        )
        planes = stage("planes", lambda: mark_recesses(planes, config.planes))
        doors = stage("doors", lambda: find_doors(planes, evidence, config.doors))
        grid = stage("occupancy", lambda: slice_map(evidence, planes, doors, config.occupancy))
        walls, paired = blockers(planes, doors), pairable(planes, config.planes)
        candidates = stage(
            "candidates", lambda: pair_planes(paired, walls, grid, config.candidates, self.observer)
        )
        cover = stage("cover", lambda: cover_free_space(candidates, grid, config.cover, self.observer))
        planes, cover = stage("cover", lambda: cover_the_rest(planes, paired, walls, cover, grid, config))
        regions = stage(
            "regions", lambda: build_regions(cover, planes, segments, doors, grid, config.regions)
        )
        regions, doors = stage("regions", lambda: connect_doors(regions, doors))
        regions = stage("labels", lambda: label_regions(regions, self._classifier(), config))
        regions, doors = self._named(regions, doors, storey)
        points = stage("regions", lambda: thin_wall_points(evidence, segments))

        self.observer.check_cancelled()
        self._names[storey] = regions
        self._unused[storey] = max(self._unused.get(storey, 1), next_number(regions))
        return FloorPlan(
            frame=frame,
            local_frame=self.local_frame,
            segments=segments,
            planes=planes,
            doors=doors,
            grid=grid,
            candidates=candidates,
            cover=cover,
            regions=regions,
            wall_points=points,
            trajectory=evidence.path,
            source=self.source,
            point_count=int(evidence.count.sum()) if self._is_one_of_many() else self.map.surfels.points,
            config=config,
            warnings=self._warnings(cover, grid),
            seconds=stage.seconds,
            storey=storey,
        )

    def _frame_and_storeys(self) -> tuple[ManhattanFrame, tuple[Storey, ...]]:
        """The frame of the whole survey, and its storeys in it; found once for the points so far."""
        self.map.settle()
        points = self.map.surfels.points
        if self._found is None or self._found[0] != points:
            self._require_room()
            sample = self.map.sample()
            frame = estimate_frame(sample, self.config.frame)
            if is_tall(sample, frame, self.config.storeys):
                sample = self.map.surfels.surfels()
            self._found = points, frame, find_storeys(sample, frame, self.config.storeys)
        return self._found[1:]

    def _is_one_of_many(self) -> bool:
        return self._found is not None and len(self._found[2]) > 1

    def _frame_of(self, storey: int) -> ManhattanFrame:
        """The frame with the floor and the ceiling of one storey."""
        frame, storeys = self._frame_and_storeys()
        if not 0 <= storey < len(storeys):
            known = f"its storeys are 0 to {len(storeys) - 1}" if len(storeys) > 1 else "it has one storey, 0"
            raise UsageError(f"There is no storey {storey} in {self.source or 'the survey'}: {known}.")
        return replace(frame, floor_z=storeys[storey].floor_z, ceiling_z=storeys[storey].ceiling_z)

    def _evidence_of(self, storey: int, frame: ManhattanFrame) -> Evidence:
        """The voxel map of one storey."""
        surfels, path = self.map.surfels, self.map.path()
        if not self._is_one_of_many():
            return gather_evidence(surfels, self.map.rays, frame, path, self.config.voxels)
        chosen = self.storeys()[storey]
        surfels, path = restrict_surfels(surfels, frame, chosen), restrict_path(path, frame, chosen)
        evidence = gather_evidence(surfels, self.map.rays, frame, path, self.config.voxels)
        return restrict_evidence(evidence, chosen)

    def _require_room(self) -> None:
        """Raise :class:`NoPlanError` where there is too little to begin with."""
        seen = self.map.surfels
        if len(seen) < MIN_SURFELS:
            raise NoPlanError(
                f"Too little to make a plan of: {seen.points} points in {len(seen)} voxels of "
                f"{seen.size:g} m; check the unit (--set input.unit=...) or give more scans."
            )

    def _named(
        self, regions: tuple[Region, ...], doors: tuple[Door, ...], storey: int
    ) -> tuple[tuple[Region, ...], tuple[Door, ...]]:
        """The regions with the names that they had in the plan before; at least one there must be."""
        if not regions:
            raise NoPlanError(
                "No region came out: the free space seen is not enclosed by any pair of walls; "
                "scan more walls, or raise candidates.max_ratio."
            )
        before = self._names.get(storey)
        return keep_names(before, regions, doors, self._unused[storey]) if before else (regions, doors)

    def _warnings(self, cover: RectangleCover, grid: OccupancyGrid) -> tuple[str, ...]:
        """What the user should know about this plan; told to the observer too."""
        warnings = []
        if self.map.planar:
            warnings.append(
                "A planar scan: walls and furniture alike are taken to reach from floor to ceiling."
            )
        left = int(cover.uncovered.sum()) * grid.cell**2
        if left > LEFT_OUT:
            warnings.append(
                f"{left:.1f} m2 of free space are in no region: no rectangle of walls encloses them."
            )
        for text in warnings:
            self.observer.warning(text)
        return tuple(warnings)

    def _classifier(self) -> RegionClassifier:
        from floorplan_core.stages.labels import PaperClassifier

        if self.config.labels.classifier == PaperClassifier.name:
            return PaperClassifier()
        from floorplan_core.plugins import find_classifier

        return find_classifier(self.config.labels.classifier)


def process(
    reconstruction: Reconstruction,
    config: Config | None = None,
    observer: Observer | None = None,
    storey: int = 0,
) -> FloorPlan:
    """The batch call: integrate every chunk, then plan one storey (0: the lowest, or the only one)."""
    planner, took = integrate_all(reconstruction, config, observer)
    return plan_storey(planner, storey, took)


def process_storeys(
    reconstruction: Reconstruction, config: Config | None = None, observer: Observer | None = None
) -> tuple[FloorPlan, ...]:
    """The batch call for surveys of several storeys: one plan for each, lowest first."""
    planner, took = integrate_all(reconstruction, config, observer)
    return tuple(plan_storey(planner, storey.number, took) for storey in planner.storeys())


def plan_storey(planner: FloorPlanner, storey: int, took: float) -> FloorPlan:
    """The plan of one storey, with the seconds that reading ``took``."""
    plan = planner.plan(storey=storey)
    plan.seconds["read"] = took - plan.seconds["integrate"]
    return plan


def integrate_all(
    reconstruction: Reconstruction, config: Config | None = None, observer: Observer | None = None
) -> tuple[FloorPlanner, float]:
    """A planner that has integrated every chunk, and the seconds that this took."""
    observer = observer or Observer()
    planner = FloorPlanner(config, observer, reconstruction.name, reconstruction.local_frame)
    planner.map.expect(reconstruction.point_count or 0)
    began, done = time.perf_counter(), 0
    observer.stage_started("read", reconstruction.point_count)
    for chunk in reconstruction.chunks():
        observer.check_cancelled()
        planner.integrate_chunk(chunk, reconstruction.trajectory)
        done += len(chunk.points)
        observer.progress("read", done)
    planner.map.settle()
    took = time.perf_counter() - began
    observer.stage_finished("read", took)
    return planner, took

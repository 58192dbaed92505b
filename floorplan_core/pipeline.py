"""The order of the stages. Online is the primitive: batch is one call of ``integrate_chunk`` for each chunk.

integrate   points into surfels, rays into the voxel map       O(points of the scan)
plan        frame, voxel columns, segments, planes, doors, universe, candidates, cover, regions, labels
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.model import FloorPlan, LocalFrame, PointChunk, Reconstruction, Region, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.stages.blockers import blockers, close_corners, remove_beams
from floorplan_core.stages.candidates import pair_planes
from floorplan_core.stages.doors import find_doors
from floorplan_core.stages.labels import label_regions
from floorplan_core.stages.layout_planes import find_planes, recessed
from floorplan_core.stages.layout_segments import find_segments
from floorplan_core.stages.manhattan_frame import estimate_frame
from floorplan_core.stages.occupancy import slice_map
from floorplan_core.stages.region_names import keep_names, next_number
from floorplan_core.stages.regions import build_regions, connect_doors
from floorplan_core.stages.set_cover import cover as cover_free_space
from floorplan_core.stages.speculation import cover_the_rest
from floorplan_core.stages.voxel_columns import gather_evidence
from floorplan_core.stages.wall_points import thin_wall_points
from floorplan_core.survey_map import SurveyMap

if TYPE_CHECKING:
    from floorplan_core.plugins import RegionClassifier

Float = NDArray[np.float64]
T = TypeVar("T")

MIN_SURFELS = 200  # fewer occupied voxels hold no room


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
        self._names: tuple[Region, ...] = ()
        self._unused = 1  # the lowest number that no region of the run ever had

    def integrate(self, points: Float, T_world_sensor: Float | None = None) -> None:
        """Add one scan.

        :param points: (N, 3) metres; in the sensor's frame, or in the world's where no pose is given.
        :param T_world_sensor: (4, 4) pose of the sensor, z up; None: there is no viewpoint.
        """
        self.map.integrate(points, T_world_sensor)

    def integrate_chunk(self, chunk: PointChunk, trajectory: Trajectory | None) -> None:
        """Add points that are in the local frame already; ``chunk.scan_id`` are rows of ``trajectory``."""
        self.map.integrate_chunk(chunk, trajectory)

    def plan(self, given: Sequence[object] = ()) -> FloorPlan:
        """The floor plan of all that was integrated so far; raises :class:`NoPlanError` where there is none.

        :param given: results of the first stages of an earlier run, in their order; they are taken as they
            are (:mod:`floorplan_core.restart`).
        """
        self.map.settle()
        seen = self.map.surfels
        if not given and len(seen) < MIN_SURFELS:
            raise NoPlanError(
                f"Too little to make a plan of: {seen.points} points in {len(seen)} voxels of "
                f"{seen.size:g} m; check the unit (--set input.unit=...) or give more scans."
            )
        config, warnings = self.config, list[str]()
        seconds = {"integrate": self.map.seconds}
        if self.map.planar:
            warnings.append(
                "A planar scan: walls and furniture alike are taken to stand from floor to ceiling."
            )
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

        surfels = stage("frame", seen.surfels)
        frame = stage("frame", lambda: estimate_frame(surfels, config.frame))
        evidence = stage(
            "occupancy",
            lambda: gather_evidence(surfels, self.map.rays, frame, self.map.path(), config.voxels),
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
        candidates = stage(
            "candidates", lambda: pair_planes(paired, walls, grid, config.candidates, self.observer)
        )
        cover = stage("cover", lambda: cover_free_space(candidates, grid, config.cover, self.observer))
        planes, cover = stage("cover", lambda: cover_the_rest(planes, paired, walls, cover, grid, config))
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
            regions, doors = keep_names(self._names, regions, doors, self._unused)
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
            seen.points,
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


def process(
    reconstruction: Reconstruction, config: Config | None = None, observer: Observer | None = None
) -> FloorPlan:
    """The batch call: integrate every chunk, then plan."""
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
    plan = planner.plan()
    plan.seconds["read"] = took - plan.seconds["integrate"]
    return plan

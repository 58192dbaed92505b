"""The order of the stages. Online is the primitive: batch is one call of ``integrate_chunk`` for each chunk.

integrate   points into surfels, rays into the voxel map       O(points of the scan)
plan        frame and storey, voxel columns; segments, planes, doors, universe, candidates, cover, regions
            (:mod:`floorplan_core.layout`), for the building and for each wing at another angle; labels
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.drift import as_configured
from floorplan_core.errors import InputError, NoPlanError, UsageError
from floorplan_core.geometry.columns import STRIP_CELLS
from floorplan_core.geometry.surfel_map import SurfelMap, Surfels
from floorplan_core.in_world import in_world, named
from floorplan_core.kernel_times import stopwatch
from floorplan_core.layout import lay_out
from floorplan_core.layout_islands import site_points
from floorplan_core.layout_parts import add_parts, askew_of, said_of_first
from floorplan_core.memory import fits, require_memory
from floorplan_core.model import (
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
from floorplan_core.model.corrections import Correction
from floorplan_core.model.evidence import Evidence
from floorplan_core.model.floor_plan import by_hand
from floorplan_core.model.quarter_turns import quarters_to_world
from floorplan_core.model.storey import Storey
from floorplan_core.observer import Observer
from floorplan_core.plugins import classifier_of
from floorplan_core.stages.askew_walls import WallsOnce
from floorplan_core.stages.corrections import Remarks, in_plan
from floorplan_core.stages.corrections_doors import lost_doors
from floorplan_core.stages.corrections_regions import correct_names
from floorplan_core.stages.islands import Island, find_islands, is_wide
from floorplan_core.stages.labels import label_regions
from floorplan_core.stages.manhattan_frame import misfit
from floorplan_core.stages.region_names import NamesOfRun, RegionNames
from floorplan_core.stages.regions import connect_doors
from floorplan_core.stages.storey_evidence import gather_storey
from floorplan_core.stages.storeys import find_storeys, is_tall, restrict_path, restrict_surfels
from floorplan_core.stages.voxel_columns import LARGEST, gather_evidence
from floorplan_core.stages.wings import Part, find_wings, part_of, same_floor, wing_frame
from floorplan_core.steps import StageRunner, StepMemory
from floorplan_core.survey_map import SurveyMap

Float = NDArray[np.float64]
MIN_SURFELS = 200  # fewer occupied voxels hold no room
EVIDENCE_SURFEL = 60  # bytes of each surfel in the manhattan frame, where it is in memory
EVIDENCE_COLUMN = 12  # bytes of each fine column there, the same
STAGES_SURFEL, STAGES_COLUMN = 15, 4  # bytes that the stages take for each surfel and each fine column
STRIP_COLUMN = 100  # and for each column of a strip, while two facings are looked at
STOREYS_SURFEL = 80  # where storeys have to be told apart, before
OUTLINE_SURFELS = 20_000  # that the extent of a site is estimated on
OUTLYING = (0.1, 99.9)  # percentiles of the surfels beyond which a site does not reach
LEFT_OUT = 1.0  # m2 of free space in no region, from which the user is told


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
        self.names: RegionNames = NamesOfRun()  # what the regions were called in the plans before
        # After so many points, with these settings:
        self._found: tuple[tuple[object, ...], ManhattanFrame, tuple[Storey, ...]] | None = None
        self._apart: tuple[tuple[object, ...], tuple[Island, ...]] | None = None  # the same for one storey
        self._ahead = 0.0  # seconds in which the frame was found before a plan was asked for

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
        seconds = stopwatch()
        found = self._frame_and_storeys()[1]
        self._ahead += seconds()
        return found

    def plan(
        self,
        given: Sequence[object] = (),
        storey: int = 0,
        corrections: Sequence[Correction] = (),
        memory: StepMemory | None = None,
    ) -> FloorPlan:
        """The floor plan of all that was integrated so far; raises :class:`NoPlanError` where there is none.

        :param given: results of the first stages of an earlier run, in their order; they are taken as they
            are (:mod:`floorplan_core.restart`).
        :param storey: number of the storey, 0 for the lowest; :class:`UsageError` where it is not there.
        :param corrections: what a person said against the machine, in the order in which it was said.
        :param memory: what an earlier plan of the same points and storey made; only steps that depend on
            something else are run again.
        """
        self.map.settle()
        config, patches = self.config, WallsOnce(self.config.frame)
        before = {"integrate": self.map.seconds, "frame": self._ahead}
        stage, self._ahead = StageRunner(self.observer, given, before, memory), 0.0

        frame = stage("frame", lambda: self._frame_of(storey), config.frame, config.storeys)
        evidence = stage("occupancy", lambda: self._largest_of(storey, frame), frame, config.voxels)
        parts = stage(
            "occupancy", lambda: self._parts_of(storey, frame, evidence, patches), evidence, config.frame
        )
        if not all(isinstance(part, Part) for part in parts):
            raise InputError("These stages were kept by another version; run again with --save-stages.")
        say = stage.correct("frame", lambda: in_plan(corrections, frame), frame, tuple(corrections))
        if parts:
            own = said_of_first(say, parts)
            main = lay_out(parts[0].evidence, config, stage, self.observer, own, parts[0].cells)
            made, wings = stage.correct(
                "wings",
                lambda: add_parts(main, parts, config, stage, self.observer, say, evidence),
                *(main, parts, config, say, evidence),
            )
        else:
            made, wings = lay_out(evidence, config, stage, self.observer, say), ()
        askew = stage.correct("askew", lambda: askew_of(parts, evidence, patches), parts, evidence, config)
        frame, said = replace(frame, askew=askew.share), made.remarks + Remarks(warnings=askew.warnings())
        segments, planes, doors, grid = made.segments, made.planes, made.doors, made.grid
        regions, cover = made.regions, made.cover
        shown = (*segments, *(s for wing in wings for s in wing.segments))
        regions, doors = stage("regions", lambda: connect_doors(regions, doors), regions, doors)
        regions = stage(
            "labels", lambda: label_regions(regions, classifier_of(config), config), regions, config
        )
        said += lost_doors(made.doors, doors)
        seen = [part.evidence for part in parts if part.apart] or [evidence]
        points = stage("regions", lambda: site_points(seen, shown), evidence, shown)

        self.observer.check_cancelled()
        plan = FloorPlan(
            frame=frame,
            local_frame=replace(self.local_frame, shift=self.local_frame.shift + self.map.own.centre),
            segments=segments,
            planes=planes,
            doors=doors,
            grid=grid,
            candidates=made.candidates,
            cover=cover,
            regions=self._some(regions),
            wall_points=points,
            trajectory=np.concatenate([each.path for each in seen]),
            source=self.source,
            point_count=int(evidence.count.sum()) if self._is_one_of_many() else self.map.surfels.points,
            config=config,
            seconds=stage.seconds,
            storey=storey,
            wings=wings,
        )
        return self._in_world(plan, said, corrections)

    def _frame_and_storeys(self) -> tuple[ManhattanFrame, tuple[Storey, ...]]:
        """The frame of the whole survey, and its storeys in it; found once for the points so far."""
        self.map.settle()
        made_of = (self.map.surfels.points, self.config.frame, self.config.storeys)
        if self._found is None or self._found[0] != made_of:
            self._require_room()
            sample = self.map.sample()
            frame = self.map.frame(self.config.frame)
            own = self._own(frame)
            if is_tall(sample, own, self.config.storeys):
                self._make_room(self.map.surfels, STOREYS_SURFEL, 0.0, "Telling its storeys apart")
                sample = self.map.surfels.surfels()
            self._found = made_of, frame, find_storeys(sample, own, self.config.storeys)
        return self._found[1:]

    def _own(self, frame: ManhattanFrame) -> ManhattanFrame:
        """``frame`` for what lies in the frame of the map."""
        return replace(frame, rotation=frame.rotation @ self.map.own.rotation.T)

    def _is_one_of_many(self) -> bool:
        return self._found is not None and len(self._found[2]) > 1

    def _frame_of(self, storey: int) -> ManhattanFrame:
        """The frame with the floor and the ceiling of one storey."""
        frame, storeys = self._frame_and_storeys()
        if not 0 <= storey < len(storeys):
            known = f"its storeys are 0 to {len(storeys) - 1}" if len(storeys) > 1 else "it has one storey, 0"
            raise UsageError(f"There is no storey {storey} in {self.source or 'the survey'}: {known}.")
        level = storeys[storey]
        return replace(frame, floor_z=level.floor_z, ceiling_z=level.ceiling_z)

    def _surfels_of(self, storey: int, own: ManhattanFrame) -> tuple[SurfelMap, Float]:
        """Surfels and sensor positions of one storey."""
        surfels, path = self.map.surfels, self.map.path()
        if self._is_one_of_many():
            chosen = self.storeys()[storey]
            surfels, path = restrict_surfels(surfels, own, chosen), restrict_path(path, own, chosen)
        return surfels, path

    def _islands(self, storey: int, frame: ManhattanFrame) -> tuple[Island, ...]:
        """Buildings that stand apart from each other, largest first; () for nearly every survey."""
        own = self._own(frame)
        if not is_wide(self.map.sample(), own):
            return ()
        made_of = (self.map.surfels.points, storey, self.config.storeys, own.floor_z, own.rotation.tobytes())
        if self._apart is None or self._apart[0] != made_of:
            self._apart = made_of, find_islands(self._surfels_of(storey, own)[0], own)
        return self._apart[1]

    def _evidence_of(self, storey: int, frame: ManhattanFrame, island: Island | None = None) -> Evidence:
        """The voxel map of one storey; of one building of it."""
        own = self._own(frame)
        surfels, path = self._surfels_of(storey, own)
        if island is not None:
            surfels, path = island.surfels_of(surfels), path[island.holds(path)]
        seen = (
            self.map.sample() if island is None else surfels.surfels(max(1, len(surfels) // OUTLINE_SURFELS))
        )
        self._make_room_for_plan(surfels, seen, own)
        given = surfels, self.map.rays, own, path, self.config.voxels
        many = self._is_one_of_many()
        if many:
            found = gather_storey(*given, self.storeys()[storey])
        else:
            found = gather_evidence(*given, lifted=self.map.planar)
        return replace(found, frame=frame)

    def _largest_of(self, storey: int, frame: ManhattanFrame) -> Evidence:
        """The voxel map of one storey; where buildings stand apart, of the largest."""
        return self._evidence_of(storey, frame, *self._islands(storey, frame)[:1])

    def _make_room_for_plan(self, surfels: SurfelMap, some: Surfels, own: ManhattanFrame) -> None:
        """See to it that there is memory for the evidence of ``surfels``, of which ``some`` show the extent,
        and for the stages."""
        size, seen = self.config.voxels.size, some.centroid
        xy = seen[:: max(1, len(seen) // OUTLINE_SURFELS)] @ own.rotation[:2].T
        wide, deep = np.ptp(np.percentile(xy, OUTLYING, axis=0), axis=0).tolist()
        columns = min(wide * deep / (size / 2) ** 2, LARGEST)  # a larger site is refused for its size
        what = f"The plan of {wide:.0f} x {deep:.0f} m in voxels of {size:g} m"
        fixed = STAGES_COLUMN * columns + STRIP_COLUMN * min(columns, STRIP_CELLS)
        self._make_room(surfels, STAGES_SURFEL, fixed, what, EVIDENCE_COLUMN * columns)

    def _make_room(
        self, surfels: SurfelMap, each: float, fixed: float, what: str, columns: float = 0.0
    ) -> None:
        """Surfels go to disk where memory has no place for what is made of them, ``each`` bytes of a surfel,
        ``fixed`` ones, and the ``columns``, which go too; :class:`NoPlanError` if that is too little."""
        needed = each * len(surfels) + fixed
        if not fits(needed + (0 if surfels.on_disk else EVIDENCE_SURFEL * len(surfels) + columns)):
            surfels.leave_memory()
            require_memory(needed, what)

    def _parts_of(
        self, storey: int, frame: ManhattanFrame, evidence: Evidence, patches: WallsOnce
    ) -> tuple[Part, ...]:
        """The evidence of the building and of each wing that stands at another angle, or of each of the
        buildings that stand apart; () where there is one building without wings."""
        islands = self._islands(storey, frame)
        if len(islands) > 1:
            others = [self._evidence_of(storey, frame, island) for island in islands[1:]]
            return tuple(Part(0.0, e, np.ones(e.shape, dtype=bool), apart=True) for e in (evidence, *others))
        wings = find_wings(evidence, self.config.frame, patches) if self.config.frame.wings else ()
        if not wings:
            return ()
        building, parts = ~np.any([wing.cells for wing in wings], axis=0), []
        for wing in wings:
            turned = self._evidence_of(storey, wing_frame(frame, wing.turn), *islands[:1])
            floor = same_floor(wing.cells, evidence, turned, wing.turn)
            parts.append(part_of(turned, floor, wing.turn))
        return part_of(evidence, building, 0.0), *parts

    def _require_room(self) -> None:
        """Raise :class:`NoPlanError` where there is too little to begin with."""
        seen = self.map.surfels
        if len(seen) < MIN_SURFELS:
            raise NoPlanError(
                f"Too little to make a plan of: {seen.points} points in {len(seen)} voxels of "
                f"{seen.size:g} m; check the unit (--set input.unit=...) or give more scans."
            )

    def _in_world(self, own: FloorPlan, said: Remarks, corrections: Sequence[Correction]) -> FloorPlan:
        """The plan, made in the survey's own quadrant, along the axes nearest to the world's, with the names
        that its regions had before and all that is said of it."""
        plan = named(in_world(own), self.names, self.map.own.centre)
        regions, remarks = correct_names(plan.regions, in_plan(corrections, plan.frame).names)
        said = said.turned(quarters_to_world(own.frame)) + remarks
        if not plan.wings:
            said += Remarks(warnings=misfit(plan.frame))
        return replace(
            plan,
            regions=regions,
            warnings=self._warnings(plan.cover, plan.grid, said),
            corrected=by_hand(plan.all_planes, plan.doors, regions),
            machine=said.machine_said(),
        )

    def _some(self, regions: tuple[Region, ...]) -> tuple[Region, ...]:
        """The regions; at least one there must be."""
        if not regions:
            raise NoPlanError(
                "No region came out: the free space seen is not enclosed by any pair of walls; "
                "scan more walls, or raise candidates.max_ratio."
            )
        return regions

    def _warnings(self, cover: RectangleCover, grid: OccupancyGrid, said: Remarks) -> tuple[str, ...]:
        """What the user should know about this plan; told to the observer too."""
        warnings = list(said.warnings)
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
    reconstruction = as_configured(reconstruction, config or Config(), observer)
    planner = FloorPlanner(config, observer, reconstruction.name, reconstruction.local_frame)
    planner.map.expect(reconstruction.point_count or 0)
    seconds, done = stopwatch(), 0
    observer.stage_started("read", reconstruction.point_count)
    for chunk in reconstruction.chunks():
        observer.check_cancelled()
        planner.integrate_chunk(chunk, reconstruction.trajectory)
        done += len(chunk.points)
        observer.progress("read", done)
    planner.map.finish()
    took = seconds()
    observer.stage_finished("read", took)
    return planner, took

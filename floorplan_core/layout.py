"""From the evidence to regions: the stages of the paper in their order, for one Manhattan frame.

A building has one frame, or one for each wing that stands at an angle; each is laid out by itself.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config, DoorsConfig
from floorplan_core.model import (
    CandidateSet,
    Door,
    LayoutPlane,
    LayoutSegment,
    OccupancyGrid,
    RectangleCover,
    Region,
)
from floorplan_core.model.corrections import Correction
from floorplan_core.model.evidence import Evidence
from floorplan_core.model.quarter_turns import quarters_to_world
from floorplan_core.observer import Observer
from floorplan_core.stages.blockers import blockers, close_beside_doors, close_corners, remove_beams
from floorplan_core.stages.candidates import pair_planes
from floorplan_core.stages.corrections import Remarks, Said
from floorplan_core.stages.corrections_doors import correct_doors, follow_planes
from floorplan_core.stages.corrections_regions import Surroundings, correct_shapes
from floorplan_core.stages.corrections_walls import correct_walls, still_walls
from floorplan_core.stages.doors import find_doors
from floorplan_core.stages.guessed_viewpoints import looked_around
from floorplan_core.stages.hidden_gaps import close_hidden_gaps
from floorplan_core.stages.layout_planes import find_planes, mark_recesses, pairable
from floorplan_core.stages.layout_segments import find_segments
from floorplan_core.stages.narrowings import find_openings
from floorplan_core.stages.occupancy import slice_map
from floorplan_core.stages.region_heights import measure_heights
from floorplan_core.stages.region_names import in_reading_order
from floorplan_core.stages.regions import build_regions
from floorplan_core.stages.set_cover import cover as cover_free_space
from floorplan_core.stages.slanted_walls import standing_cells
from floorplan_core.stages.speculation import cover_the_rest, for_site
from floorplan_core.stages.stairs import Flight, apart_from_stairs, find_flights, openings
from floorplan_core.stages.wall_lines import bridge_lines
from floorplan_core.steps import StageRunner


@dataclass(frozen=True)
class Layout:
    """What the stages made in one frame; doors are not connected to regions yet."""

    segments: tuple[LayoutSegment, ...]
    planes: tuple[LayoutPlane, ...]
    doors: tuple[Door, ...]
    grid: OccupancyGrid
    candidates: CandidateSet
    cover: RectangleCover
    regions: tuple[Region, ...]
    remarks: Remarks


@dataclass(frozen=True)
class _Walls:
    """What bounds the rooms."""

    segments: tuple[LayoutSegment, ...]
    machine: tuple[LayoutPlane, ...]  # planes as they were found
    planes: tuple[LayoutPlane, ...]  # as a person said that they are
    around: Evidence  # with the free space that a person standing there would see
    said: Remarks


@dataclass(frozen=True)
class _Stairs:
    """Flights of stairs, and the doors at their feet."""

    feet: tuple[Door, ...]
    flights: tuple[Flight, ...]


def lay_out(
    evidence: Evidence,
    config: Config,
    stage: StageRunner,
    observer: Observer,
    say: Said,
    cells: NDArray[np.bool_] | None = None,
) -> Layout:
    """All stages from layout segments to regions.

    :param say: what a person said against the machine, in this frame.
    :param cells: (ny, nx) where the free space is that regions are to explain; None: everywhere.
    """
    walls = _find_walls(evidence, config, stage, say)
    doors, planes, stairs, remarks = _find_doors(walls, evidence, config, stage, say)
    said = walls.said + remarks
    grid = stage(
        "occupancy",
        lambda: _within(slice_map(walls.around, planes, doors, config.occupancy), cells),
        *(walls.around, planes, doors, config.occupancy),
    )
    candidates, planes, cover = _cover_floor(planes, doors, grid, config, stage, observer)
    doors = (*doors, *stairs.feet)
    found = (planes, walls.segments, doors, grid)
    quarters = quarters_to_world(evidence.frame)
    tall = stage.correct("standing", lambda: standing_cells(evidence, grid), evidence, grid)
    regions = stage(
        "regions",
        lambda: in_reading_order(
            build_regions(cover, *found, config.regions, stairs.flights, evidence.inferred, tall), quarters
        ),
        *(cover, *found, config.regions, stairs.flights, evidence.inferred, tall),
    )
    regions, planes, remarks = stage.correct(
        "shapes",
        lambda: correct_shapes(regions, say.shapes, Surroundings(*found), config.regions),
        *(regions, say.shapes, *found, config.regions),
    )
    regions = stage("regions", lambda: measure_heights(regions, evidence, grid), regions, evidence, grid)
    return Layout(walls.segments, planes, doors, grid, candidates, cover, regions, said + remarks)


def _find_walls(evidence: Evidence, config: Config, stage: StageRunner, say: Said) -> _Walls:
    """Segments and planes, and what a person made of the planes."""
    parts, wide = config.planes, config.doors
    segments, rows = stage(
        "segments", lambda: find_segments(evidence, config.segments), evidence, config.segments
    )
    beams = wide.max_beamless, wide.lintel_depth, wide.max_opening
    segments, planes = stage(
        "planes",
        lambda: find_planes(segments, rows, evidence, parts, wide),
        *(segments, rows, evidence, parts, wide),
    )
    widest = wide.max_opening if evidence.viewpoints else 0.0  # else nobody knows what was hidden
    planes = stage(
        "planes", lambda: close_corners(remove_beams(planes, *beams), widest), planes, beams, widest
    )
    around = stage.correct("viewpoints", lambda: looked_around(evidence), evidence)
    machine = stage(
        "planes",
        lambda: mark_recesses(_bridged(planes, evidence, around, wide), parts),
        *(planes, evidence, around, wide, parts),
    )
    planes, said = stage.correct("walls", lambda: correct_walls(machine, say.walls), machine, say.walls)
    return _Walls(segments, machine, planes, around, said)


def _find_doors(
    walls: _Walls, evidence: Evidence, config: Config, stage: StageRunner, say: Said
) -> tuple[tuple[Door, ...], tuple[LayoutPlane, ...], _Stairs, Remarks]:
    """The doors but those at the feet of stairs, the planes that they are cut into, the stairs, and what came
    of the corrections."""
    seen, machine, planes = still_walls(walls.machine, walls.planes), walls.machine, walls.planes
    doors = stage(
        "doors",
        lambda: find_openings(seen, evidence, walls.around, config.doors),
        *(seen, evidence, walls.around, config.doors),
    )
    flights = stage.correct("stairs", lambda: find_flights(evidence), evidence)
    doors = (*doors, *openings(flights, doors))
    doors, planes, remarks = stage.correct(
        "doors",
        lambda: _corrected_doors(doors, planes, machine, say.doors, evidence, config.doors),
        *(doors, planes, machine, say.doors, evidence, config.doors),
    )
    doors, feet, flights = apart_from_stairs(doors, flights)
    planes = stage.correct(
        "stubs", lambda: close_beside_doors(planes, doors, evidence.inferred), planes, doors, evidence
    )
    return doors, planes, _Stairs(feet, flights), remarks


def _cover_floor(
    planes: tuple[LayoutPlane, ...],
    doors: tuple[Door, ...],
    grid: OccupancyGrid,
    config: Config,
    stage: StageRunner,
    observer: Observer,
) -> tuple[CandidateSet, tuple[LayoutPlane, ...], RectangleCover]:
    """The candidates, the planes with those speculated that were needed, and the cover of the free space."""
    walls, paired = blockers(planes, doors), pairable(planes, config.planes)
    layout = (planes, doors, grid, config.planes, config.candidates)
    on_site = for_site(config.candidates, grid)
    candidates = stage("candidates", lambda: pair_planes(paired, walls, grid, on_site, observer), *layout)
    cover = stage(
        "cover",
        lambda: cover_free_space(candidates, grid, config.cover, observer),
        *(candidates, grid, config.cover),
    )
    planes, cover = stage(
        "cover",
        lambda: cover_the_rest(planes, paired, walls, cover, grid, config),
        *(cover, config.cover, *layout),
    )
    return candidates, planes, cover


def _bridged(
    planes: tuple[LayoutPlane, ...], evidence: Evidence, around: Evidence, doors: DoorsConfig
) -> tuple[LayoutPlane, ...]:
    """The planes, wall also where a line of wall is only hidden."""
    return close_hidden_gaps(bridge_lines(planes, around, doors), evidence, doors)


def _within(grid: OccupancyGrid, cells: NDArray[np.bool_] | None) -> OccupancyGrid:
    """The grid with a universe that lies in ``cells``."""
    return grid if cells is None else replace(grid, universe=grid.universe & cells)


def _corrected_doors(
    doors: tuple[Door, ...],
    planes: tuple[LayoutPlane, ...],
    machine: tuple[LayoutPlane, ...],
    corrections: tuple[Correction, ...],
    evidence: Evidence,
    sure: DoorsConfig,
) -> tuple[tuple[Door, ...], tuple[LayoutPlane, ...], Remarks]:
    """The doors in the corrected planes, with what a person said of them."""

    def followed(found: tuple[Door, ...]) -> tuple[Door, ...]:
        return follow_planes(found, machine, planes, sure.max_thickness)

    def faint() -> tuple[Door, ...]:
        unsure = sure.model_copy(update={"min_confidence": 0.0})
        return followed(find_doors(still_walls(machine, planes), evidence, unsure))

    return correct_doors(followed(doors), planes, corrections, sure, faint)

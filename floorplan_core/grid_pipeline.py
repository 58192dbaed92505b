"""The order of the stages for an occupancy grid map: the method, with planes and free space from the grid.

frame       yaw of the map's walls; the map in the Manhattan frame, furniture taken out
doors       chords that complete the walls part the floor into spaces
segments    straight boundaries of the spaces
planes      the fewest offsets that explain them
candidates, cover, regions    as for a reconstruction, for each space by itself
labels      rooms and corridors

A space whose rectangles explain less than ``maps.agreement`` of it has walls at other angles: its outline is
taken from the map instead, and a warning says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.masks import widened
from floorplan_core.model import (
    FREE,
    OCCUPIED,
    CandidateSet,
    Door,
    FloorPlan,
    GridMap,
    LayoutPlane,
    LayoutSegment,
    LocalFrame,
    OccupancyGrid,
    RectangleCover,
    Region,
    WallPoints,
)
from floorplan_core.model.corrections import Correction
from floorplan_core.model.floor_plan import by_hand
from floorplan_core.observer import Observer
from floorplan_core.plugins import classifier_of
from floorplan_core.stages.candidates import pair_planes
from floorplan_core.stages.corrections import Remarks, in_plan
from floorplan_core.stages.corrections_doors import correct_doors
from floorplan_core.stages.corrections_regions import Surroundings, correct_names, correct_shapes
from floorplan_core.stages.corrections_walls import correct_walls
from floorplan_core.stages.grid_map import MapFloor, find_floor
from floorplan_core.stages.grid_map_corrections import correct_map, mark_planes
from floorplan_core.stages.grid_map_doors import grid_doors
from floorplan_core.stages.grid_map_outlines import askew_share, outline, outline_region
from floorplan_core.stages.grid_map_passages import Passage, find_passages
from floorplan_core.stages.grid_map_spaces import (
    SpaceProblem,
    disjoint,
    explained,
    join_candidates,
    join_covers,
    space_problems,
)
from floorplan_core.stages.grid_map_walls import Boundary, find_boundary, wall_planes, wall_segments
from floorplan_core.stages.labels import label_regions
from floorplan_core.stages.region_names import RegionNames, in_reading_order
from floorplan_core.stages.regions import build_regions, connect_doors
from floorplan_core.stages.set_cover import cover as cover_free_space
from floorplan_core.stages.speculation import cover_the_rest
from floorplan_core.steps import StageRunner, StepMemory

Float = NDArray[np.float64]

_LEFT = 0.03  # of a space: less that no rectangle covers are niches and recesses of doors


@dataclass(frozen=True)
class _Solved:
    """One space after candidates and cover."""

    problem: SpaceProblem
    candidates: CandidateSet
    cover: RectangleCover
    planes: tuple[LayoutPlane, ...]  # with the speculated ones that were used
    outline: Any  # shapely polygon around its cells; None where nothing is left of it
    askew: bool  # its walls run at other angles: rectangles have nothing to say


@dataclass(frozen=True)
class _Walls:
    """What bounds the spaces."""

    boundary: Boundary
    segments: tuple[LayoutSegment, ...]
    rows: NDArray[np.int64]  # of the boundary that are segments
    planes: tuple[LayoutPlane, ...]


def plan_grid_map(
    grid_map: GridMap,
    config: Config | None = None,
    observer: Observer | None = None,
    corrections: Sequence[Correction] = (),
    memory: StepMemory | None = None,
    names: RegionNames | None = None,
) -> FloorPlan:
    """The floor plan of a grid map; raises :class:`NoPlanError` where there is none.

    :param corrections: what a person said against the machine; those of walls change the cells of the map.
    :param memory: what an earlier plan of the same map made; only what depends on a change is made again.
    :param names: gives the regions the names that they had before.
    """
    config, observer = config or Config(), observer or Observer()
    stage = StageRunner(observer, memory=memory)

    ground = stage("frame", lambda: find_floor(grid_map, config), config.frame, config.maps)
    say = stage.correct("frame", lambda: in_plan(corrections, ground.frame), ground, tuple(corrections))
    ground, corrected, said = _corrected_walls(stage, ground, say.walls, config)
    passages, spaces = stage(
        "doors", lambda: find_passages(ground.floor, ground.grid.cell, config.maps), ground, config.maps
    )
    grid = stage.correct("grid", lambda: _with_universe(ground.grid, spaces), ground, spaces)
    walls = _find_walls(stage, ground, spaces, grid, corrected, config)
    doors, askew, remarks = _find_doors(stage, ground, passages, grid, walls.planes, say.doors, config)
    said += remarks
    solved = _cover_spaces(stage, ground, spaces, grid, walls, config, observer)
    sets = [s.candidates for s in solved]
    cover, first = join_covers(
        [s.cover for s in solved], sets, [s.problem for s in solved], grid.states.shape
    )
    regions, drawn = stage(
        "regions", lambda: _regions(solved, first, doors, grid, config), solved, doors, grid, config
    )
    planes = stage.correct("planes", lambda: _all_planes(walls.planes, solved), walls.planes, solved)
    found = (planes, walls.segments, doors, grid)
    regions, planes, remarks = stage.correct(
        "shapes",
        lambda: correct_shapes(regions, say.shapes, Surroundings(*found), config.regions),
        *(regions, say.shapes, *found, config.regions),
    )
    said += remarks
    regions, doors = stage("regions", lambda: connect_doors(regions, doors), regions, doors)
    if not regions:
        raise NoPlanError(
            f"No region came out of {grid_map.name}: no enclosed free space is larger than "
            f"{config.regions.min_area:g} m2; check the resolution and the thresholds of the map."
        )
    regions = stage("labels", lambda: label_regions(regions, classifier_of(config), config), regions, config)
    if names is not None:
        regions, doors = names(regions, doors, 0)
    regions, remarks = correct_names(regions, say.names)
    said += remarks
    warnings = (*said.warnings, *_warnings(ground, regions, drawn, askew, config))
    for text in warnings:
        observer.warning(text)
    return FloorPlan(
        ground.frame,
        LocalFrame(),
        walls.segments,
        planes,
        doors,
        grid,
        join_candidates(sets),
        cover,
        regions,
        stage.correct("points", lambda: _wall_points(walls.boundary, grid), walls.boundary, grid),
        np.zeros((0, 2)),
        grid_map.name,
        int(np.count_nonzero(grid_map.states)),
        config,
        warnings,
        stage.seconds,
        raster=grid_map.raster,
        corrected=by_hand(planes, doors, regions),
        machine=said.machine_said(),
    )


def _find_walls(
    stage: StageRunner,
    ground: MapFloor,
    spaces: NDArray[np.int32],
    grid: OccupancyGrid,
    corrected: tuple[LayoutPlane, ...],
    config: Config,
) -> _Walls:
    """The boundary of the spaces as segments and planes, marked with what a person said of them."""
    boundary = stage("segments", lambda: find_boundary(spaces, ground.floor, grid), spaces, ground, grid)
    segments, rows = stage(
        "segments",
        lambda: wall_segments(boundary, grid, config),
        *(boundary, grid, config.segments, config.planes),
    )
    segments, planes = stage(
        "planes", lambda: wall_planes(segments, grid.cell, config), segments, config.planes, config.segments
    )
    planes = stage.correct("marks", lambda: mark_planes(planes, corrected, grid.cell), planes, corrected)
    return _Walls(boundary, segments, rows, planes)


def _find_doors(
    stage: StageRunner,
    ground: MapFloor,
    passages: Sequence[Passage],
    grid: OccupancyGrid,
    planes: tuple[LayoutPlane, ...],
    said: Sequence[Correction],
    config: Config,
) -> tuple[tuple[Door, ...], int, Remarks]:
    """The doors, how many passages lie in walls at other angles, and what came of the corrections."""
    walls = tuple(p for p in planes if p.by_hand != "hidden")
    machine, askew = stage(
        "doors",
        lambda: grid_doors(passages, walls, ground.floor, grid, config.doors),
        *(passages, planes, ground, grid, config.doors),
    )
    doors, _, remarks = stage.correct(
        "doors",
        lambda: correct_doors(machine, planes, said, config.doors, lambda: machine),
        *(machine, planes, said, config.doors),
    )
    return doors, askew, remarks


def _cover_spaces(
    stage: StageRunner,
    ground: MapFloor,
    spaces: NDArray[np.int32],
    grid: OccupancyGrid,
    walls: _Walls,
    config: Config,
    observer: Observer,
) -> list[_Solved]:
    """Candidates and cover of every space."""
    parts = (spaces, ground.floor, grid, walls.boundary, walls.segments, walls.rows, walls.planes)
    problems = stage(
        "candidates",
        lambda: space_problems(*parts, config),
        *(spaces, ground, grid, walls.boundary, walls.segments, walls.rows, walls.planes, config),
    )
    return stage("cover", lambda: [_solve(p, config, observer) for p in problems], problems, config)


def _with_universe(grid: OccupancyGrid, spaces: NDArray[np.int32]) -> OccupancyGrid:
    """The grid with the free cells of the spaces as what the cover has to explain."""
    return replace(grid, universe=(spaces > 0) & (grid.states == FREE))


def _corrected_walls(
    stage: StageRunner, ground: MapFloor, said: Sequence[Correction], config: Config
) -> tuple[MapFloor, tuple[LayoutPlane, ...], Remarks]:
    """The map as corrections of walls say it is, the machine's planes with them, and what came of them."""
    if not said:
        return ground, (), Remarks()

    def work() -> tuple[MapFloor, tuple[LayoutPlane, ...], Remarks]:
        _, spaces = find_passages(ground.floor, ground.grid.cell, config.maps)
        grid = _with_universe(ground.grid, spaces)
        segments, _ = wall_segments(find_boundary(spaces, ground.floor, grid), grid, config)
        _, machine = wall_planes(segments, grid.cell, config)
        corrected, remarks = correct_walls(machine, said)
        return correct_map(ground, machine, corrected), corrected, remarks

    return stage.correct("walls", work, ground, tuple(said), config.maps, config.segments, config.planes)


def _solve(problem: SpaceProblem, config: Config, observer: Observer) -> _Solved:
    """Candidates and cover of one space; what no candidate covers is closed at its frontier."""
    observer.check_cancelled()
    around = outline(problem.mask, problem.grid)
    askew = around is not None and askew_share(around) > config.maps.max_askew
    planes = [] if askew else list(problem.planes)
    candidates = pair_planes(planes, problem.walls, problem.grid, config.candidates)
    cover = cover_free_space(candidates, problem.grid, config.cover)
    used: tuple[LayoutPlane, ...] = tuple(planes)
    left = np.count_nonzero(cover.uncovered)
    if not askew and left > _LEFT * np.count_nonzero(problem.grid.universe):
        used, cover = cover_the_rest(used, planes, problem.walls, cover, problem.grid, config)
    named = tuple(replace(p, id=f"{p.id}.{problem.number}") if p.id.startswith("q") else p for p in used)
    return _Solved(problem, candidates, cover, named, around, askew)


def _regions(
    solved: list[_Solved],
    first: NDArray[np.int64],
    doors: tuple[Door, ...],
    grid: OccupancyGrid,
    config: Config,
) -> tuple[tuple[Region, ...], int]:
    """One region for each space, by its rectangles or by its outline, and how many are outlines."""
    found: list[Region] = []
    drawn, boxes = 0, _door_boxes(doors)
    for space, row in zip(solved, first, strict=False):
        region = _by_rectangles(space, _doors_around(doors, boxes, space.problem.grid), config)
        if region is None:
            region = _by_outline(space)
            drawn += region is not None
        if region is not None and region.area >= config.regions.min_area:
            own = region.rectangles if region.rectangles is not None else np.zeros(0, dtype=np.int64)
            found.append(replace(region, rectangles=own + row))

    def rebuild(polygon: Any, region: Region) -> Region:
        rows = np.zeros(0, dtype=np.int64) if region.rectangles is None else region.rectangles
        return outline_region(polygon, grid, rows)

    return in_reading_order(disjoint(found, rebuild)), drawn


def _by_rectangles(space: _Solved, doors: Sequence[Door], config: Config) -> Region | None:
    """The region of the chosen rectangles, where it explains the space."""
    problem = space.problem
    if space.askew or len(space.cover) == 0:
        return None
    made = build_regions(space.cover, space.planes, problem.segments, doors, problem.grid, config.regions)
    best = max(made, key=lambda r: r.free_cells, default=None)
    return best if best is not None and explained(best, problem) >= config.maps.agreement else None


def _door_boxes(doors: Sequence[Door]) -> Float:
    """(D, 4) x0, y0, x1, y1 of the openings as lines."""
    return np.array([d.line().ravel() for d in doors], dtype=np.float64).reshape(-1, 4)


def _doors_around(doors: Sequence[Door], boxes: Float, grid: OccupancyGrid) -> list[Door]:
    """The doors in a space's part of the map."""
    x0, y0, x1, y1 = grid.extent
    inside = (boxes[:, 0] <= x1) & (boxes[:, 2] >= x0) & (boxes[:, 1] <= y1) & (boxes[:, 3] >= y0)
    return [doors[int(k)] for k in np.flatnonzero(inside)]


def _by_outline(space: _Solved) -> Region | None:
    if space.outline is None:
        return None
    rows = np.arange(len(space.cover), dtype=np.int64)
    return outline_region(space.outline, space.problem.grid, rows)


def _all_planes(planes: tuple[LayoutPlane, ...], solved: list[_Solved]) -> tuple[LayoutPlane, ...]:
    """The observed planes, then the speculated ones that the spaces needed."""
    return (*planes, *(p for s in solved for p in s.planes if p.speculated))


def _warnings(
    ground: MapFloor, regions: tuple[Region, ...], drawn: int, askew: int, config: Config
) -> tuple[str, ...]:
    """What the user should know: walls at other angles, and free space that is in no region."""
    out = []
    if ground.frame.support < config.frame.min_support:
        out.append(
            f"Only {ground.frame.support:.0%} of the walls lie along two perpendicular directions; "
            "this is hardly a Manhattan world."
        )
    if drawn:
        out.append(
            f"{drawn} of {len(regions)} regions have walls at other angles; their outline is the map's own, "
            "not made of layout planes."
        )
    if askew:
        out.append(f"{askew} passages in walls at other angles part regions but are not drawn as doors.")
    return tuple(out)


def _wall_points(boundary: Boundary, grid: OccupancyGrid) -> WallPoints:
    """The occupied cells beside free ones, with the facing of the boundary piece that they belong to."""
    iy, ix = np.nonzero(widened(grid.states == FREE) & (grid.states == OCCUPIED))
    xy = grid.origin + grid.cell * (np.column_stack([ix, iy]) + 0.5)
    facing = np.full(grid.states.shape, -1, dtype=np.int8)
    for k in np.flatnonzero(boundary.wall > boundary.open):
        _mark(facing, boundary, int(k), grid)
    return WallPoints(xy.astype(np.float32), np.zeros(len(xy), dtype=np.float32), facing[iy, ix])


def _mark(facing: NDArray[np.int8], boundary: Boundary, k: int, grid: OccupancyGrid) -> None:
    """Note the facing of one piece in the cells that lie behind it."""
    axis, sign = divmod(int(boundary.facing[k]), 2)
    low, high = ((boundary.start[k], boundary.end[k]) - grid.origin[1 - axis]) / grid.cell
    at = round((boundary.offset[k] - grid.origin[axis]) / grid.cell) - (1 if sign == 0 else 0)
    along, across = slice(round(low), round(high)), slice(max(at - 1, 0), at + 2)
    facing[(along, across) if axis == 0 else (across, along)] = boundary.facing[k]

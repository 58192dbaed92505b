"""The layouts of a building and of its wings as one: every part by itself in its own frame, then joined."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.layout import Layout, lay_out
from floorplan_core.model import LayoutPlane, OccupancyGrid, Region, Wing
from floorplan_core.model.corrections import RejectDoor
from floorplan_core.model.evidence import Evidence
from floorplan_core.model.floor_plan import regions_mask
from floorplan_core.model.layout import turned
from floorplan_core.model.quarter_turns import quarters_to_world
from floorplan_core.observer import Observer
from floorplan_core.stages.corrections import Placed, Remarks, Said, said_of_part
from floorplan_core.stages.corrections_regions import SHAPED, opened
from floorplan_core.stages.region_heights import measure_heights
from floorplan_core.stages.regions import count_cells
from floorplan_core.stages.wing_joins import (
    PartLayout,
    join_doors,
    join_grids,
    join_regions,
    named,
    walls_of,
)
from floorplan_core.stages.wing_shapes import correct_joined_shapes
from floorplan_core.stages.wings import Part, same_floor
from floorplan_core.steps import StageRunner


def add_wings(
    main: Layout,
    parts: tuple[Part, ...],
    config: Config,
    stage: StageRunner,
    observer: Observer,
    say: Said,
    seen: Evidence,
) -> tuple[Layout, tuple[Wing, ...]]:
    """``main``, which is the layout of the first part, with the regions and doors of the others.

    A wing that gives no plan by itself is left out, with a remark. ``say`` is what a person said of the whole
    plan: each part takes what is said of its walls and doors; regions are merged and split when all are
    joined, and measured again in ``seen``, which is all that was seen in the axes of the plan.
    """
    whole, remarks = parts[0].evidence, main.remarks
    turns = [part.turn for part in parts]
    found, cells = [part_layout(main, 0.0)], []
    wings: list[Wing] = []
    for k, part in enumerate(parts[1:], start=1):
        quiet = Observer(observer.cancel)  # what a stage shows is in the frame of the building
        degrees = math.degrees(part.turn)
        area = float(np.count_nonzero(part.cells)) * part.evidence.cell**2
        try:
            own, runner = said_of_part(say, k, turns), stage.part(f"wing {k}", quiet)
            made = lay_out(part.evidence, config, runner, quiet, own, part.cells)
        except NoPlanError as error:
            remarks += Remarks(
                warnings=(f"A wing of {area:.0f} m2 at {degrees:.1f} degrees gives no plan: {error}",)
            )
            continue
        found.append(part_layout(made, part.turn))
        wings.append(wing_of(made, part.turn, len(wings) + 1))
        cells.append(same_floor(part.cells, part.evidence, whole, -part.turn))
        machine = tuple((named(ident, len(wings)), text) for ident, text in made.remarks.machine)
        remarks += Remarks(machine, tuple(map(_in_the_wing, made.remarks.warnings)))
        remarks += Remarks(
            warnings=(
                f"A wing of {area:.0f} m2 stands at {degrees:.1f} degrees to the rest: it is planned in a "
                "frame of its own.",
            )
        )
    quarters = quarters_to_world(whole.frame)
    regions = join_regions(found, config.regions.min_area, quarters)
    grid = join_grids(main.grid, found[1:], cells)
    regions, merged, shaped = correct_joined_shapes(
        regions, say.shapes, turns, walls_of(found), grid, config.regions.min_area
    )
    regions = _measured(regions, seen, grid)
    left = main.cover.uncovered & ~regions_mask(regions, grid)  # a region of a wing may have it
    joined = replace(
        main,
        planes=_opened(main.planes, merged, 0.0),
        regions=tuple(counted(r, grid) for r in regions),
        doors=join_doors(found, [c.at for c in say.doors if isinstance(c, RejectDoor)]),
        grid=grid,
        cover=replace(main.cover, uncovered=left),
        remarks=remarks + shaped,
    )
    return joined, tuple(replace(w, planes=_opened(w.planes, merged, w.turn)) for w in wings)


def _measured(regions: tuple[Region, ...], seen: Evidence, grid: OccupancyGrid) -> tuple[Region, ...]:
    """The regions, those that a person gave another shape with the height of what they are now."""
    others = {r.id: r for r in regions if SHAPED & set(r.by_hand)}
    measured = measure_heights(tuple(others.values()), seen, grid) if others else ()
    new = {r.id: r for r in measured}
    return tuple(new.get(r.id, r) for r in regions)


def _in_the_wing(text: str) -> str:
    said = f"In the wing: {text}"
    return text.within(said) if isinstance(text, Placed) else said


def _opened(planes: tuple[LayoutPlane, ...], merged: tuple[Any, ...], turn: float) -> tuple[LayoutPlane, ...]:
    """Planes in axes turned by ``turn`` without their walls inside of merged regions."""
    for polygon in merged:
        planes = opened(planes, shapely.transform(polygon, lambda xy: turned(xy, -turn)))
    return planes


def counted(region: Region, grid: OccupancyGrid) -> Region:
    """The region with the cells that it has in the grid of the plan."""
    free, total = count_cells(region.polygon, grid)
    return replace(region, free_cells=free, total_cells=total)


def part_layout(made: Layout, turn: float) -> PartLayout:
    """What was made of a part, for the joining."""
    return PartLayout(turn, made.planes, made.doors, made.regions, made.grid)


def wing_of(made: Layout, turn: float, number: int) -> Wing:
    """Planes and segments with ids that say of which wing they are."""
    planes = tuple(
        replace(p, id=named(p.id, number), segments=tuple(named(s, number) for s in p.segments), turn=turn)
        for p in made.planes
    )
    segments = tuple(
        replace(s, id=named(s.id, number), plane=named(s.plane, number), turn=turn) for s in made.segments
    )
    return Wing(turn, planes, segments)

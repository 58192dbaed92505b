"""The layouts of buildings that stand apart as one plan: each over its own rectangle, then joined."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.layout import Layout, lay_out
from floorplan_core.layout_wings import counted, part_layout, wing_of
from floorplan_core.model import LayoutSegment, OccupancyGrid, Region, WallPoints, Wing
from floorplan_core.model.evidence import Evidence
from floorplan_core.model.quarter_turns import quarters_to_world
from floorplan_core.observer import Observer
from floorplan_core.stages.corrections import Remarks, Said
from floorplan_core.stages.corrections_islands import said_of_buildings
from floorplan_core.stages.region_names import in_reading_order
from floorplan_core.stages.wall_points import thin_wall_points
from floorplan_core.stages.wing_joins import join_doors, named
from floorplan_core.stages.wings import Part
from floorplan_core.steps import StageRunner

Float = NDArray[np.float64]
_APART = "{0} buildings stand apart from each other: each is planned by itself, in one frame."
_WITHOUT = "A building of {0:.0f} x {1:.0f} m that stands apart gives no plan: {2}"


def add_islands(
    main: Layout, parts: tuple[Part, ...], config: Config, stage: StageRunner, observer: Observer, say: Said
) -> tuple[Layout, tuple[Wing, ...]]:
    """``main``, which is the layout of the first part, with all that the others hold.

    Planes and segments of the others are theirs only (``Wing``, not turned). A building that gives no plan by
    itself is left out, with a remark. ``say`` is what a person said of the whole site.
    """
    says, odd = said_of_buildings(say, [part.evidence for part in parts])
    made, wings, remarks = [main], list[Wing](), main.remarks + odd
    for k, part in enumerate(parts[1:], start=1):
        quiet = Observer(observer.cancel)  # what a stage shows is of the first building
        try:
            runner = stage.part(f"building {k}", quiet)
            each = lay_out(part.evidence, config, runner, quiet, says[k], part.cells)
        except NoPlanError as error:
            deep, wide = (n * part.evidence.cell for n in part.evidence.shape)
            remarks += Remarks(warnings=(_WITHOUT.format(wide, deep, error),))
            continue
        made.append(each)
        wings.append(wing_of(each, 0.0, len(wings) + 1))
        remarks += Remarks(tuple((named(i, len(wings)), text) for i, text in each.remarks.machine))
        remarks += Remarks(warnings=each.remarks.warnings)
    remarks += Remarks(warnings=(_APART.format(len(made)),))
    grids = [each.grid for each in made]
    uncovered = [replace(each.grid, universe=each.cover.uncovered) for each in made]
    grid, quarters = site_grid(grids), quarters_to_world(parts[0].evidence.frame)
    return replace(
        main,
        regions=tuple(counted(r, grid) for r in _regions(made, quarters)),
        doors=join_doors([part_layout(each, 0.0) for each in made]),
        grid=grid,
        cover=replace(main.cover, uncovered=site_grid(uncovered).universe),
        remarks=remarks,
    ), tuple(wings)


def site_grid(grids: Sequence[OccupancyGrid]) -> OccupancyGrid:
    """One grid over all; their origins differ by whole cells. Where two overlap, the higher state is kept."""
    first = grids[0]
    origin = np.min([grid.origin for grid in grids], axis=0)
    starts = [np.rint((grid.origin - origin) / first.cell).astype(int) for grid in grids]
    nx, ny = np.max([s + g.states.shape[::-1] for s, g in zip(starts, grids, strict=True)], axis=0)
    states, universe = np.zeros((ny, nx), dtype=np.uint8), np.zeros((ny, nx), dtype=bool)
    for (x, y), grid in zip(starts, grids, strict=True):
        rows, columns = grid.states.shape
        window = slice(y, y + rows), slice(x, x + columns)
        np.maximum(states[window], grid.states, out=states[window])
        universe[window] |= grid.universe
    return replace(first, origin=origin, states=states, universe=universe)


def site_points(seen: Sequence[Evidence], segments: Sequence[LayoutSegment]) -> WallPoints:
    """The wall points of all buildings; ``segments`` are those of all of them."""
    if len(seen) == 1:
        return thin_wall_points(seen[0], segments)
    found = []
    for each in seen:
        low, high = each.origin, each.origin + np.array(each.shape[::-1]) * each.cell
        lines = [(s, s.line().mean(axis=0)) for s in segments]
        own = [s for s, middle in lines if (middle > low).all() and (middle < high).all()]
        found.append(thin_wall_points(each, own))
    return WallPoints(*(np.concatenate([getattr(f, n) for f in found]) for n in ("xy", "height", "facing")))


def _regions(made: Sequence[Layout], quarters: int) -> tuple[Region, ...]:
    """All regions, in reading order."""
    regions = [
        replace(r, sides=tuple(replace(s, plane=named(s.plane, k)) for s in r.sides))
        for k, each in enumerate(made)
        for r in each.regions
    ]
    return in_reading_order(regions, quarters)

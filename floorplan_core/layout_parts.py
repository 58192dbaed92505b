"""A plan of several parts: the wings of one building, or buildings that stand apart."""

from __future__ import annotations

import numpy as np

from floorplan_core.config import Config
from floorplan_core.layout import Layout
from floorplan_core.layout_islands import add_islands
from floorplan_core.layout_wings import add_wings
from floorplan_core.model import Wing
from floorplan_core.model.evidence import Evidence
from floorplan_core.observer import Observer
from floorplan_core.stages.askew_walls import AskewWalls, WallsOnce, askew_walls
from floorplan_core.stages.corrections import Said, said_of_part
from floorplan_core.stages.corrections_islands import said_of_buildings
from floorplan_core.stages.wings import Part, floor_of_wings
from floorplan_core.steps import StageRunner


def said_of_first(say: Said, parts: tuple[Part, ...]) -> Said:
    """What of all that was said is about the first part, which is laid out before the others."""
    if parts[0].apart:
        return said_of_buildings(say, [part.evidence for part in parts])[0][0]
    return said_of_part(say, 0, [part.turn for part in parts])


def askew_of(parts: tuple[Part, ...], seen: Evidence, patches: WallsOnce) -> AskewWalls:
    """The walls that follow no frame of the plan; ``seen`` as in :func:`add_parts`."""
    if parts and parts[0].apart:
        whole = [(part.evidence, np.zeros(part.evidence.shape, dtype=bool)) for part in parts]
        return askew_walls(whole, patches)
    return askew_walls([(seen, floor_of_wings(parts[1:], seen))], patches)


def add_parts(
    main: Layout,
    parts: tuple[Part, ...],
    config: Config,
    stage: StageRunner,
    observer: Observer,
    say: Said,
    seen: Evidence,
) -> tuple[Layout, tuple[Wing, ...]]:
    """The layout of the first part with those of the others.

    :param say: what a person said of the whole plan.
    :param seen: all that was seen of one building, in the axes of the plan.
    """
    if parts[0].apart:
        return add_islands(main, parts, config, stage, observer, say)
    return add_wings(main, parts, config, stage, observer, say, seen)

"""``make_building``: from a spec to a building, in the order in which an architect would draw it."""

from __future__ import annotations

import numpy as np

from floorplan_core.simulation.building import Building, DoorOpening, Space
from floorplan_core.simulation.circulation import Walls, circulation, mm
from floorplan_core.simulation.columns import make_columns
from floorplan_core.simulation.doors import make_doors
from floorplan_core.simulation.furniture import furnish
from floorplan_core.simulation.rooms import make_spaces
from floorplan_core.simulation.spec import BuildingSpec
from floorplan_core.simulation.windows import make_windows


def make_building(spec: BuildingSpec, rng: np.random.Generator) -> Building:
    """Draw a building; the same spec and generator state give the same building.

    Spaces never overlap, are at least a wall apart, and each room has a door (which may be shut).
    """
    walls = _walls(spec, rng)
    spaces = make_spaces(spec, circulation(spec, walls, rng), walls, rng)
    doors = make_doors(spaces, spec, walls, rng)
    spaces, doors = _drop_unreached(spaces, doors)
    windows = make_windows(spaces, spec, walls, rng)
    columns = make_columns(spaces, doors, spec, rng)
    furniture = furnish(spaces, doors, windows, columns, spec, rng)
    return Building(spaces, doors, windows, furniture, columns, walls.height, walls.interior, walls.exterior)


def _walls(spec: BuildingSpec, rng: np.random.Generator) -> Walls:
    """What the spec leaves open is drawn: thin partitions, thicker outer walls, usual storey heights."""
    interior, exterior, height = rng.uniform(0.1, 0.2), rng.uniform(0.25, 0.35), rng.uniform(2.5, 3.2)
    return Walls(
        mm(interior if spec.interior_wall is None else spec.interior_wall),
        mm(exterior if spec.exterior_wall is None else spec.exterior_wall),
        mm(height if spec.height is None else spec.height),
    )


def _drop_unreached(
    spaces: tuple[Space, ...], doors: tuple[DoorOpening, ...]
) -> tuple[tuple[Space, ...], tuple[DoorOpening, ...]]:
    """Spaces that no door could be cut into are left as solid core; the others are renumbered."""
    reached = sorted({0} | {i for door in doors for i in door.joins})
    number = {old: new for new, old in enumerate(reached)}
    kept = tuple(Space(s.kind, s.use, s.rects, number.get(s.host, -1)) for s in (spaces[i] for i in reached))
    renumbered = tuple(
        DoorOpening(
            d.bounds, d.axis, (number[d.joins[0]], number[d.joins[1]]), d.height, d.kind, d.open, d.leaves
        )
        for d in doors
    )
    return kept, renumbered

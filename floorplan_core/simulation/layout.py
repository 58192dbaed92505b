"""Layouts without ray casting: what perfect earlier stages would hand to the candidates and the cover.

For benchmarks of the cover: planes, blockers and the free grid of a building, straight from its truth.
Grows linearly with the floor area; 20,000 m2 take about a second.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import FREE, UNOBSERVED, Facing, OccupancyGrid
from floorplan_core.simulation.architect import make_building
from floorplan_core.simulation.building import Building, Space, solid_hulls
from floorplan_core.simulation.spec import BuildingSpec

Float = NDArray[np.float64]

SLICE = 1.2  # m above the floor
SAME = 1e-6  # m: offsets that are one plane


@dataclass(frozen=True)
class BuildingLayout:
    """Planes, walls, doors and free cells of a building, in its own axes (a manhattan frame), metres."""

    x_plus: Float  # sorted unique offsets of east-facing wall faces
    x_minus: Float  # west-facing
    y_plus: Float  # north-facing
    y_minus: Float  # south-facing
    blockers: Float  # (B, 4) x0, y0, x1, y1: wall faces (degenerate, cut at the doors), then the doors
    doors: int  # the last so many blockers are doors
    grid: OccupancyGrid  # the universe: every cell whose centre is on a free floor

    @property
    def planes(self) -> int:
        """Number of planes of all facings."""
        return sum(len(p) for p in (self.x_plus, self.x_minus, self.y_plus, self.y_minus))


def layout_only(
    spec: BuildingSpec, rng: np.random.Generator, cell: float = 0.1, seen: float = 1.0
) -> BuildingLayout:
    """A building's layout directly; ``seen`` is the share of its rooms whose floor is known free."""
    building = make_building(spec, rng)
    unseen = rng.random(len(building.spaces)) >= seen
    unseen[0] = False
    return building_layout(building, cell, frozenset(np.flatnonzero(unseen).tolist()))


def building_layout(
    building: Building, cell: float = 0.1, unseen: frozenset[int] = frozenset()
) -> BuildingLayout:
    """Wall faces, doors and free cells of ``building``; the spaces in ``unseen`` have no free cells.

    Furniture and columns occupy the cells that they fill at 1.2 m above the floor.
    """
    edges = [edge for space in building.spaces for edge in _edges(space)]
    doors = np.array([d.bounds for d in building.doors]).reshape(-1, 4)
    lines = [piece for _, line in edges for piece in _cut(line, doors)]
    blockers = np.vstack([np.array(lines).reshape(-1, 4), doors])
    east, west, north, south = (_offsets(edges, facing) for facing in Facing)
    grid = _free_grid(building, cell, unseen)
    return BuildingLayout(east, west, north, south, blockers, len(doors), grid)


def _edges(space: Space) -> list[tuple[Facing, Float]]:
    """The boundary of a space: facing and (4,) x0, y0, x1, y1 of each straight wall face."""
    from shapely.geometry.polygon import orient

    polygon = orient(space.polygon)  # the floor lies to the left of every edge
    rings = [np.asarray(ring.coords) for ring in (polygon.exterior, *polygon.interiors)]
    return [_edge(a, b) for ring in rings for a, b in pairwise(ring)]


def _edge(a: Float, b: Float) -> tuple[Facing, Float]:
    dx, dy = b - a
    if abs(dx) > abs(dy):
        facing = Facing.NORTH if dx > 0 else Facing.SOUTH
    else:
        facing = Facing.WEST if dy > 0 else Facing.EAST
    return facing, np.concatenate([np.minimum(a, b), np.maximum(a, b)])


def _cut(line: Float, doors: Float) -> list[Float]:
    """The wall face ``line`` without the doors that open in it."""
    axis = int(line[3] - line[1] > line[2] - line[0])  # it runs along x (0) or y (1)
    other = 1 - axis
    at = line[other]
    here = (doors[:, other] <= at + SAME) & (doors[:, other + 2] >= at - SAME)
    here &= (doors[:, axis] < line[axis + 2]) & (doors[:, axis + 2] > line[axis])
    ends = [line[axis]]
    for door in sorted(doors[here].tolist(), key=lambda d: d[axis]):
        ends += [door[axis], door[axis + 2]]
    ends.append(line[axis + 2])
    pieces = []
    for start, end in zip(ends[::2], ends[1::2], strict=True):
        piece = line.copy()
        piece[[axis, axis + 2]] = start, end
        pieces.append(piece)
    return pieces


def _offsets(edges: list[tuple[Facing, Float]], facing: Facing) -> Float:
    """Sorted unique offsets of the wall faces that look this way."""
    found = [line[facing.axis] for way, line in edges if way == facing]
    return np.unique(np.round(found, 6)).astype(np.float64)


def _free_grid(building: Building, cell: float, unseen: frozenset[int]) -> OccupancyGrid:
    """Free floors without furniture and columns; everything else unobserved."""
    x0, y0, x1, y1 = building.extent
    shape = (int(np.ceil((y1 - y0) / cell)), int(np.ceil((x1 - x0) / cell)))
    origin, free = np.array([x0, y0]), np.zeros(shape, dtype=bool)
    floors = [s.rects for i, s in enumerate(building.spaces) if i not in unseen]
    _paint(free, np.vstack(floors), origin, cell, True)
    hulls = np.vstack([np.zeros((0, 6)), *(solid_hulls(f.solids) for f in building.furniture)])
    hulls = hulls[(hulls[:, 2] < SLICE) & (hulls[:, 5] > SLICE)]
    _paint(free, np.vstack([hulls[:, [0, 1, 3, 4]], building.columns]), origin, cell, False)
    states = np.where(free, FREE, UNOBSERVED).astype(np.uint8)
    return OccupancyGrid(origin, cell, states, free, SLICE)


def _paint(mask: NDArray[np.bool_], rects: Float, origin: Float, cell: float, value: bool) -> None:
    """Set the cells whose centre lies in a rectangle (low side in, high side out)."""
    low = np.maximum(np.ceil((rects[:, :2] - origin) / cell - 0.5).astype(int), 0)
    high = np.maximum(np.ceil((rects[:, 2:] - origin) / cell - 0.5).astype(int), 0)
    for (i0, j0), (i1, j1) in zip(low, high, strict=True):
        mask[j0:j1, i0:i1] = value

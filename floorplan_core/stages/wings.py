"""Wings at other angles: which parts of a survey follow a Manhattan frame of their own (beyond the paper).

In: the evidence in the frame of the building. Out: a :class:`WingFloor` each, none for nearly all surveys.
Free space is cut into rooms at its narrow places; the walls around each vote, by the direction that they
have. Rooms in which the second direction wins are a wing; one room that has walls of both (a corridor with a
bend) is cut where they are equally near. A direction is one in which long lines of wall run
(:mod:`~floorplan_core.stages.askew_walls`), however small their share of the building. Cost: a pass over the
surfels; where there is such a direction, one more and one over the cells for each wing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import FrameConfig
from floorplan_core.geometry.columns import height_mask
from floorplan_core.geometry.masks import distance_to_gap, label_patches
from floorplan_core.geometry.surfel_map import Surfels
from floorplan_core.model import ManhattanFrame
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.askew_walls import (
    WallPatches,
    WallsOnce,
    in_band,
    in_long_lines,
    over_cells,
    quarter,
)
from floorplan_core.stages.manhattan_frame import refined_direction, strongest_direction, turned_by

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

MOST_WINGS = 4  # at angles of their own: more is no building of wings
_LEAST_WALLS = 8.0  # m2 of wall with the second direction, in all and in each wing
_LEAST_LINES = 3.0  # m2 of it in long lines: clutter has none
_DIRECTIONS = 4  # that are tried: the walls of a round room have all
_OWN = 1.5  # times as much wall around a wing follows it as does not: a hall with a slanted wall is none
_LEAST_AREA = 6.0  # m2 of floor of a wing
_FREE_BAND = (0.5, 1.9)  # m above the floor, where space must be free at some height
_CLOSED = 3  # cells that walls are widened by to close gaps between what was seen of them
_HALF_DOOR = 0.65  # m: space that is nowhere wider than twice this is the opening between two rooms
_VOTE = (0.15, 0.3, 0.45)  # m in front of a wall, where the room is that it votes for
_MIXED = 0.35  # share of a room's walls that is too much for a mistake
_MIXED_WALLS = 3.0  # m2 of them
_ACROSS = 0.5  # m2 of them that were hit on each of two sides across from each other
_WALL_REACH = 0.6  # m around the floor of a part, within which its walls stand
_DOOR_REACH = 1.2  # m around it, within which free space shows that a door leads out of it


@dataclass(frozen=True)
class WingFloor:
    """The part of a survey that follows another direction."""

    turn: float  # radians from the frame's axes to those of the wing, counter-clockwise
    cells: Mask  # (ny, nx) of the evidence: the floor of the wing


@dataclass(frozen=True)
class Part:
    """The evidence of one part of a survey, in its own frame."""

    turn: float  # radians from the plan's axes to those of the part
    evidence: Evidence
    cells: Mask  # (ny, nx) where its floor is
    apart: bool = False  # True: a building by itself on a site of several (stages.islands)


def find_wings(
    evidence: Evidence, config: FrameConfig, patches: WallsOnce | None = None
) -> tuple[WingFloor, ...]:
    """The wings, that with most wall first; ``evidence`` is in the frame of the building.

    Each is looked for in what those before it left: two wings at two angles do not blur each other.
    """
    found: list[WingFloor] = []
    rest, patches = evidence, patches or WallsOnce(config)
    while len(found) < MOST_WINGS and (wing := find_wing(rest, patches(rest), config)) is not None:
        found.append(wing)
        rest = _without(rest, wing.cells)
    return tuple(found)


def _without(evidence: Evidence, cells: Mask) -> Evidence:
    """The evidence less the walls and the free space over ``cells``, to look for another wing in."""
    rows = np.flatnonzero(~_over(_grown(cells, _WALL_REACH / evidence.cell), evidence))
    return replace(
        evidence,
        xyz=evidence.xyz[rows],
        count=evidence.count[rows],
        spread=evidence.spread[rows],
        view=evidence.view[rows],
        free=np.where(cells, np.uint64(0), evidence.free),
    )


def find_wing(evidence: Evidence, walls: WallPatches, config: FrameConfig) -> WingFloor | None:
    """The wing, if there is one; ``evidence``, which has these ``walls``, is in the frame of the building."""
    lines = in_long_lines(walls, walls.askew)
    rooms = None
    for turn in _directions(walls, lines):
        rooms = _rooms_of(evidence, walls) if rooms is None else rooms
        cells = _floor_of(evidence, rooms, walls, lines, turn)
        if cells.any():
            near = in_band(evidence.xyz[:, 2])
            around = _over(_grown(cells, _WALL_REACH / evidence.cell), evidence)  # its walls stand beside it
            return WingFloor(refined_direction(_plain_surfels(evidence, near & around), turn, config), cells)
    return None


def _directions(walls: WallPatches, lines: Mask) -> Iterator[float]:
    """Directions of the long ``lines`` of wall, that of most first, with enough walls for a wing."""
    left = lines.copy()
    for _ in range(_DIRECTIONS):
        if walls.extent(left) < _LEAST_LINES:
            return
        turn = strongest_direction(walls.angle[left], walls.area[left])
        if walls.extent(walls.askew & walls.along(turn)) >= _LEAST_WALLS:
            yield turn
        left &= ~walls.along(turn)


def part_of(evidence: Evidence, cells: Mask, turn: float) -> Part:
    """The evidence of the part whose floor is ``cells``: its walls, and what its doors show."""
    walls, doors = _grown(cells, _WALL_REACH / evidence.cell), _grown(cells, _DOOR_REACH / evidence.cell)
    rows = np.flatnonzero(_over(walls, evidence))
    none = np.uint64(0)
    only = replace(
        evidence,
        xyz=evidence.xyz[rows],
        count=evidence.count[rows],
        spread=evidence.spread[rows],
        view=evidence.view[rows],
        hits=np.where(np.repeat(np.repeat(walls, 2, axis=0), 2, axis=1), evidence.hits, none),
        free=np.where(doors, evidence.free, none),
        occupied=np.where(walls, evidence.occupied, none),
    )
    return Part(turn, only, cells)


def same_floor(cells: Mask, evidence: Evidence, other: Evidence, turn: float) -> Mask:
    """``cells`` of one evidence as cells of another, whose axes are turned by ``turn``."""
    ny, nx = other.shape
    y, x = np.mgrid[0:ny, 0:nx] + 0.5
    centres = np.column_stack([x.ravel(), y.ravel()]) * other.cell + other.origin
    return over_cells(cells, centres @ turned_by(-turn)[:2, :2], evidence).reshape(ny, nx)


def floor_of_wings(wings: Sequence[Part], seen: Evidence) -> Mask:
    """(ny, nx) cells of ``seen``, in the axes of the plan, in the wings or as near as their walls."""
    cells = np.zeros(seen.shape, dtype=bool)
    for wing in wings:
        cells |= same_floor(wing.cells, wing.evidence, seen, -wing.turn)
    return _grown(cells, _WALL_REACH / seen.cell) if wings else cells


def wing_frame(frame: ManhattanFrame, turn: float) -> ManhattanFrame:
    """The frame of a wing."""
    return replace(frame, rotation=turned_by(-turn) @ frame.rotation, yaw=float(quarter(frame.yaw + turn)))


def _plain_surfels(evidence: Evidence, rows: Mask) -> Surfels:
    xyz = evidence.xyz[rows]
    zeros = np.zeros((len(xyz), 3))
    return Surfels(xyz, evidence.count[rows], zeros, zeros[:, :2], evidence.surfel)


def _rooms_of(evidence: Evidence, walls: WallPatches) -> NDArray[np.int32]:
    """(ny, nx) number of the room of each cell, from 1; 0 elsewhere."""
    free = (evidence.free & height_mask(*_FREE_BAND)) != 0
    return _rooms(free | _enclosed(evidence, walls) if evidence.inferred else free, evidence.cell)


def _enclosed(evidence: Evidence, walls: WallPatches) -> Mask:
    """Cells that walls and lintels close in: in a small room a scan may see neither floor nor ceiling."""
    stands = np.zeros(evidence.shape, dtype=bool)
    stands[_cell_index(walls.surfels, evidence)] = True
    label, _ = label_patches(np.pad(~_grown(stands, _CLOSED), 1, constant_values=True))
    inside = (label != 0) & (label != label[0, 0])
    return _grown(inside[1:-1, 1:-1], _CLOSED) & ~stands


def _floor_of(
    evidence: Evidence, rooms: NDArray[np.int32], walls: WallPatches, lines: Mask, turn: float
) -> Mask:
    """(ny, nx) cells of the rooms whose walls follow the second direction."""
    straight, follows = walls.along(0.0), walls.askew & walls.along(turn)
    count = int(rooms.max()) + 1
    asked = ((straight, 0.0), (follows, turn), (lines & ~follows, 0.0))
    sides = [_votes(rooms, walls, mask, towards, evidence, count) for mask, towards in asked]
    votes = [side.sum(axis=0) for side in sides]
    # A hall with one side along the building has walls across from each other in its own direction only.
    across = [np.minimum(side[:2], side[2:]).max(axis=0) > _ACROSS for side in sides[:2]]
    most = np.where(across[0] == across[1], votes[1] > votes[0] + votes[2], across[1] & (votes[1] > votes[2]))
    most[0] = False
    cells = most[rooms]
    mixed = np.minimum(*votes[:2]) > np.maximum(_MIXED * (votes[0] + votes[1]), _MIXED_WALLS)
    mixed &= across[0] & across[1] & (votes[2] < votes[1])  # a round room has walls of all directions
    mixed[0] = False
    if mixed.any():
        nearer = _distance(walls, follows, evidence) < _distance(walls, straight, evidence)
        cells = np.where(mixed[rooms], nearer & (rooms > 0), cells)
    label, number = label_patches(_grown(cells, 2))
    area = np.bincount(label[cells], minlength=number + 1) * evidence.cell**2
    around = _grown_labels(label, round(_WALL_REACH / evidence.cell))
    part = around[_cell_index(walls.xy, evidence)]
    wall, other = (
        np.bincount(part[mask], minlength=number + 1) * walls.cell**2 for mask in (follows, ~follows)
    )
    kept = (area >= _LEAST_AREA) & (wall >= np.maximum(_LEAST_WALLS, _OWN * other))
    kept[0] = False
    return np.asarray(cells & kept[label])


def _rooms(free: Mask, cell: float) -> NDArray[np.int32]:
    """(ny, nx) number of the room of each free cell, from 1; 0 elsewhere."""
    label, _ = label_patches(distance_to_gap(free) * cell > _HALF_DOOR)
    while True:
        wider = np.where(free, _grown_labels(label, 1), 0)
        if np.array_equal(wider, label):
            return np.asarray(label, dtype=np.int32)
        label = wider


def _grown_labels(label: NDArray[np.int32], steps: int) -> NDArray[np.int32]:
    """Labels, spread over cells that have none; the higher number wins."""
    from scipy.ndimage import grey_dilation

    for _ in range(steps):
        wider = grey_dilation(label, size=(3, 3))
        label = np.where(label == 0, wider, label)
    return label


def _votes(
    rooms: NDArray[np.int32], walls: WallPatches, mask: Mask, turn: float, evidence: Evidence, count: int
) -> Float:
    """(4, count) m2 of the walls ``mask`` in front of which each room lies, by the side that they face."""
    total = np.zeros((4, count))
    for sign in (-1, 1):
        voted = np.zeros(int(mask.sum()), dtype=np.int32)
        for reach in _VOTE:
            at = walls.xy[mask] + sign * reach * walls.normal[mask]
            voted = np.where(voted == 0, rooms[_cell_index(at, evidence)], voted)
        facing = np.round((walls.angle[mask] - turn) / (np.pi / 2) + (1 - sign)).astype(np.int64) % 4
        np.add.at(total, (facing, voted), walls.area[mask])
    total[:, 0] = 0.0
    return total


def _distance(walls: WallPatches, mask: Mask, evidence: Evidence) -> Float:
    """(ny, nx) cells to the nearest of the walls ``mask``."""
    away = np.ones(evidence.shape, dtype=bool)
    away[_cell_index(walls.xy[mask], evidence)] = False
    return distance_to_gap(away)


def _grown(cells: Mask, steps: float) -> Mask:
    """``cells`` and all that are at most so many cells from them."""
    return np.asarray(distance_to_gap(~cells) <= steps)


def _over(cells: Mask, evidence: Evidence) -> Mask:
    """(N,) which surfels lie over ``cells``."""
    return over_cells(cells, evidence.xyz[:, :2], evidence)


def _cell_index(xy: Float, evidence: Evidence) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Row and column of points; those beyond the grid at its edge."""
    index = np.floor((xy[:, :2] - evidence.origin) / evidence.cell).astype(np.int64)
    ny, nx = evidence.shape
    return np.clip(index[:, 1], 0, ny - 1), np.clip(index[:, 0], 0, nx - 1)

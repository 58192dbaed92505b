"""Layout segments and planes of a map: the straight boundaries of its spaces.

In: the spaces of the floor and the states of the map. Out: segments (observed walls, facing the free side),
planes (fewest offsets that explain them) and, for each space, everything that bounds it: the lines that
block rectangles and the offsets that may close them. A boundary cell stands against *wall*, against the
*open* floor of another space (a passage), or against the *frontier* of what was never seen; the frontier
neither blocks nor closes, so that rectangles may predict beyond it. Heights are unknown: areas are per metre
of height.
Cost: linear in the boundary cells.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import Config
from floorplan_core.geometry.masks import label_patches
from floorplan_core.model import OCCUPIED, Facing, LayoutPlane, LayoutSegment, OccupancyGrid
from floorplan_core.stages.model_selection import pierce_intervals

Float = NDArray[np.float64]
Int = NDArray[np.int64]
Bool = NDArray[np.bool_]
Labels = NDArray[np.int32]

WALL, OPEN, FRONTIER = 0, 1, 2  # what a boundary cell stands against

_WALL_DEPTH = 2  # cells beyond a boundary in which a wall may begin (blurred edges)
_STRAIGHT = 2  # cells that the boundary of one piece may move to and fro
_MOSTLY = 0.5  # share of a piece that decides what it is


@dataclass(frozen=True)
class Boundary:
    """Straight pieces of the boundaries of all spaces; all arrays (N,), metres, manhattan frame."""

    facing: NDArray[np.int8]
    space: Labels
    offset: Float  # mean over its wall cells: finer than a cell where the wall is not quite straight
    spread: Float  # none of its wall cells deviates more
    start: Float
    end: Float
    wall: Float  # share of the piece that stands against wall
    open: Float  # share that stands against another space

    def __len__(self) -> int:
        return len(self.offset)

    @property
    def length(self) -> Float:
        """(N,) metres."""
        return self.end - self.start

    @property
    def bounds_space(self) -> Bool:
        """(N,) walls and passages; not the frontier."""
        return self.wall + self.open >= _MOSTLY

    def take(self, rows: Bool | Int) -> Boundary:
        """Some of the pieces."""
        return Boundary(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))

    def boxes(self) -> Float:
        """(N, 4) x0, y0, x1, y1 of the pieces as lines."""
        a, b = np.column_stack([self.offset, self.start]), np.column_stack([self.offset, self.end])
        along_y = (self.facing // 2 == 0)[:, None]
        return np.hstack([np.where(along_y, a, a[:, ::-1]), np.where(along_y, b, b[:, ::-1])])


def find_boundary(spaces: Labels, floor: Bool, grid: OccupancyGrid) -> Boundary:
    """The straight pieces of every boundary of every space, by facing, space, offset and start."""
    parts = [_pieces(facing, spaces, floor, grid) for facing in Facing]
    names = Boundary.__dataclass_fields__
    joined = Boundary(*(np.concatenate([getattr(p, name) for p in parts]) for name in names))
    return joined.take(np.lexsort((joined.start, joined.offset, joined.space, joined.facing)))


def _pieces(facing: Facing, spaces: Labels, floor: Bool, grid: OccupancyGrid) -> Boundary:
    """The pieces of one facing."""
    solid_map = grid.states == OCCUPIED
    turn = facing.axis == 1  # rows then run along the wall
    label = spaces.T if turn else spaces
    ground, solid = (floor.T, solid_map.T) if turn else (floor, solid_map)
    beyond = _shifted(label, facing.sign, 1)
    edge = (label > 0) & (beyond != label)
    along, across = np.nonzero(edge)
    mine = label[along, across]
    chain = label_patches(edge, connectivity=8)[0]
    against = _against(along, across, facing.sign, ground, solid)
    order = np.lexsort((across, along, mine, chain[along, across]))
    along, across, mine, against = along[order], across[order], mine[order], against[order]
    piece = _straight_runs(along, across, mine, _STRAIGHT)
    return _summary(facing, along, across + (facing.sign < 0), mine, against, piece, grid)


def _shifted(array: Labels, sign: int, cells: int) -> Labels:
    """What lies ``cells`` beyond each cell, against the facing; 0 beyond the map."""
    out = np.zeros_like(array)
    if sign > 0:
        out[:, cells:] = array[:, :-cells]
    else:
        out[:, :-cells] = array[:, cells:]
    return out


def _against(along: Int, across: Int, sign: int, ground: Bool, solid: Bool) -> NDArray[np.int8]:
    """(N,) WALL, OPEN or FRONTIER for each boundary cell."""
    out = np.full(len(along), FRONTIER, dtype=np.int8)
    wall = np.zeros(len(along), dtype=bool)
    for cells in range(1, _WALL_DEPTH + 1):
        at = across - sign * cells
        inside = (at >= 0) & (at < solid.shape[1])
        wall[inside] |= solid[along[inside], at[inside]]
    out[wall] = WALL
    at = across - sign
    inside = (at >= 0) & (at < ground.shape[1])
    open_ = np.zeros(len(along), dtype=bool)
    open_[inside] = ground[along[inside], at[inside]]
    out[open_] = OPEN
    return out


@njit(cache=True, nogil=True)
def _straight_runs(along: Int, across: Int, space: Labels, reach: int) -> Int:
    """(N,) number of the straight piece of each boundary cell: consecutive, and within ``reach`` across."""
    piece = np.zeros(len(along), np.int64)
    if len(along) == 0:
        return piece
    low, high, number = across[0], across[0], 0
    for k in range(1, len(along)):
        low, high = min(low, across[k]), max(high, across[k])
        if space[k] != space[k - 1] or along[k] != along[k - 1] + 1 or high - low > reach:
            number += 1
            low, high = across[k], across[k]
        piece[k] = number
    return piece


def _summary(
    facing: Facing,
    along: Int,
    line: Int,
    space: Labels,
    against: NDArray[np.int8],
    piece: Int,
    grid: OccupancyGrid,
) -> Boundary:
    """One row for each piece."""
    first = np.flatnonzero(np.diff(piece, prepend=-1))
    if len(first) == 0:
        empty = np.zeros(0)
        return Boundary(empty.astype(np.int8), empty.astype(np.int32), *([empty] * 6))
    count = np.diff(first, append=len(piece)).astype(np.float64)
    sure = np.repeat(np.add.reduceat(against == WALL, first) == 0, count.astype(int)) | (against == WALL)
    mean = np.add.reduceat(line * sure, first) / np.add.reduceat(sure, first, dtype=np.float64)
    deviation = np.maximum.reduceat(np.abs(line - np.repeat(mean, count.astype(int))) * sure, first)
    a, o = facing.axis, grid.origin
    return Boundary(
        np.full(len(first), facing, dtype=np.int8),
        space[first],
        o[a] + mean * grid.cell,
        deviation * grid.cell,
        o[1 - a] + along[first] * grid.cell,
        o[1 - a] + (along[first] + count) * grid.cell,
        np.add.reduceat(against == WALL, first, dtype=np.float64) / count,
        np.add.reduceat(against == OPEN, first, dtype=np.float64) / count,
    )


def wall_segments(
    boundary: Boundary, grid: OccupancyGrid, config: Config
) -> tuple[tuple[LayoutSegment, ...], Int]:
    """The walls among the pieces that are long enough to be surfaces, and the row of each piece."""
    long = boundary.length >= config.segments.min_length
    rows = np.flatnonzero((boundary.wall >= _MOSTLY) & long)
    return tuple(_segment(f"s{n + 1}", boundary, int(k), grid) for n, k in enumerate(rows)), rows


def _segment(name: str, boundary: Boundary, k: int, grid: OccupancyGrid) -> LayoutSegment:
    length = float(boundary.length[k])
    return LayoutSegment(
        id=name,
        facing=Facing(int(boundary.facing[k])),
        offset=float(boundary.offset[k]),
        start=float(boundary.start[k]),
        end=float(boundary.end[k]),
        z_min=0.0,
        z_max=0.0,
        area=length * float(boundary.wall[k]),
        points=round(length / grid.cell),
        residual=max(float(boundary.spread[k]), grid.cell / 2),
        sigma=grid.cell / math.sqrt(12.0),
        evidence=("straight boundary of free space",),
    )


def wall_planes(
    segments: Sequence[LayoutSegment], cell: float, config: Config
) -> tuple[tuple[LayoutSegment, ...], tuple[LayoutPlane, ...]]:
    """The fewest planes that explain the segments within the tolerance (or a cell), and each one's plane."""
    reach = max(config.planes.tolerance, cell)
    planes: list[LayoutPlane] = []
    out = list(segments)
    for facing in Facing:
        rows = [k for k, s in enumerate(segments) if s.facing == facing]
        offset = np.array([segments[k].offset for k in rows])
        group = pierce_intervals(offset - reach, offset + reach)
        for g in range(int(group.max(initial=-1)) + 1):
            mine = [rows[i] for i in np.flatnonzero(group == g)]
            plane = _plane(f"p{len(planes) + 1}", facing, [segments[k] for k in mine])
            planes.append(plane)
            for k in mine:
                out[k] = replace(segments[k], plane=plane.id)
    return tuple(out), tuple(planes)


def _plane(name: str, facing: Facing, segments: Sequence[LayoutSegment]) -> LayoutPlane:
    """One plane at the mean of its segments, by their length."""
    length = np.array([s.length for s in segments])
    offset = float(np.average([s.offset for s in segments], weights=length))
    runs = np.array([[s.start, s.end] for s in sorted(segments, key=lambda s: s.start)])
    residual = max(abs(s.offset - offset) + s.residual for s in segments)
    return LayoutPlane(
        name,
        facing,
        offset,
        tuple(s.id for s in segments),
        float(sum(s.area for s in segments)),
        residual,
        walls=runs,
        observed=runs,
    )

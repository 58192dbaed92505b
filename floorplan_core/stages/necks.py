"""Doors of a survey without lintels: the necks of its free space in the lines of its walls.

A planar laser sees no lintel: a doorway is a gap in a wall, and so is the mouth of a side corridor, the end
of a corridor and the space between two cabinets. What tells them apart is the plan. Each gap in the line of a
wall, from its end to the next piece or to the wall across, is a chord of the free space, and it is a door
where the space is wider than the chord on both sides, behind the thickness of the wall: the rule of grid
maps (:mod:`~floorplan_core.stages.grid_map_passages`), with chords in the lines of layout planes. What was
not seen counts as wide, since a room that was seen through its door only shows a fan of rays.
Chords are taken from the shortest, and each that parts closes the space for those after it. What joins two
spaces of many doors is a narrowing of one corridor.
In: planes with their runs, doors found otherwise, voxel columns. Out: doors. Cost: gaps times cells nearby.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.geometry.columns import by_strips, count_bits, height_mask
from floorplan_core.geometry.masks import label_patches
from floorplan_core.model import Door, LayoutPlane
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.blockers import crossing_walls
from floorplan_core.stages.grid_map_chords import march, opening

Float = NDArray[np.float64]
Cells = NDArray[Any]

_BODY = (0.4, 1.8)  # m above the floor, the heights at which a passage is free
_FREE, _STANDS = 0.5, 0.3  # share of these heights from which a cell is floor, or wall
_SPECK = 0.15  # m2 of cells with floor all around: a chair, or noise, not wall
_LINE = 0.25  # m between planes that are one wall to the eye: drift and thickness
_CORNER = 0.5  # m by which a crossing wall may miss the line
_PASSED = 0.45  # m of a chord that must be floor; the rest is clutter beside the jambs
_DEPTH = 0.8  # m that one must be able to go on either side: a niche is no room
_DOOR = 1.6  # m, longer chords are openings, and need more wall
_NECK, _WIDE_NECK = 0.75, 0.8  # largest ratio of the width of a door, of an opening, to that beyond
_FLANK, _LONG_FLANK = 0.6, 1.2  # m of wall in line at one end of a door; of a corner door and of an opening
_SHARE, _WIDE_SHARE = 0.3, 0.45  # of wall in line with a door, with an opening, itself included
_LOOK = 5.0  # m of wall in line that count
_TUNNEL, _BEYOND = 0.8, 0.8  # m: thickest wall, cabinets beside the door included; stretch that is measured
_PASSAGE, _SAME_WIDTH = 4.0, 0.6  # m ahead over which a way on this narrow is a corridor, chord to width
_CORRIDOR = 3.5  # m: what is wider is no corridor
_ROOM, _ROOM_DEPTH, _JAMB = 0.4, 3.5, 0.3  # a corridor ends at a room this wide and deep, between jambs (m)
_FAR = 20.0  # m, the farthest that one looks ahead
_NOWHERE = 1e9  # m, beyond any building
_BESIDE = 0.6  # m between a door and a run of the other face of its wall
_STEP = 0.4  # m off a chord, where the spaces that it parts are looked up
_FEW_DOORS = 3  # that a room may have; a space with more is a corridor or a hall
_TWICE = 0.5  # share of the narrower of two doors that both have in common, from which they are one
_CONFIDENCE = 0.6  # a door that only the plan shows, no lintel


@dataclass(frozen=True)
class _Chord:
    """A gap in the line of a plane; metres along it."""

    plane: LayoutPlane
    start: float
    end: float
    flanks: tuple[float, float]  # m of wall in line beyond either end
    door: Door | None = None  # what was found there by other evidence

    @property
    def width(self) -> float:
        return self.end - self.start


def find_necks(
    planes: Sequence[LayoutPlane], doors: Sequence[Door], evidence: Evidence, config: DoorsConfig
) -> tuple[Door, ...]:
    """Those of ``doors`` that part two spaces, and the other gaps that do, by axis, offset and start.

    Nothing is said of shut doors: what they part was not seen.
    """
    ids = {p.id: p for p in planes}
    shut = [d for d in doors if "shut" in d.evidence]
    chords = [_Chord(ids[d.planes[0]], d.start, d.end, _jambs(d), d) for d in doors if d not in shut]
    across = {axis: crossing_walls(planes, 1 - axis) for axis in (0, 1)}
    chords += [c for p in planes for c in _gaps(p, planes, across[p.facing.axis], config)]
    chords.sort(key=lambda c: (round(c.width, 3), c.door is None, c.plane.id, c.start))
    space = _Space(planes, evidence)
    found = []
    for chord in chords:
        if space.parts(chord):
            space.close(chord)
            found.append(chord)
    healed = _healed(found, space, config)
    known = shut + [c.door for c in healed if c.door is not None]
    kept = known + _once([_door(c, planes, config) for c in healed if c.door is None], known)
    kept.sort(key=lambda d: (d.axis, d.offset, d.start))
    return tuple(replace(d, id=f"d{k + 1}") for k, d in enumerate(kept))


def _jambs(door: Door) -> tuple[float, float]:
    """The wall beside a door as it was found."""
    return _LOOK, _LOOK if "wall on both sides" in door.evidence else 0.0


def _gaps(
    plane: LayoutPlane, planes: Sequence[LayoutPlane], across: Float, config: DoorsConfig
) -> list[_Chord]:
    """The gaps in the line of a plane, and those between its ends and the walls ``across``."""
    near = (across[:, 1] < plane.offset + _CORNER) & (across[:, 2] > plane.offset - _CORNER)
    corners = np.sort(across[near, 0])
    ends = [(-_NOWHERE, -_NOWHERE), *line_runs(plane, planes), (_NOWHERE, _NOWHERE)]
    found = []
    for (s0, e0), (s1, e1) in pairwise(ends):
        before, after = min(e0 - s0, _LOOK), min(e1 - s1, _LOOK)
        inside = corners[(corners > e0 + _CORNER) & (corners < s1 - _CORNER)]
        if len(inside) == 0:
            found.append(_Chord(plane, e0, s1, (before, after)))
            continue
        found.append(_Chord(plane, e0, float(inside[0]), (before, 0.0)))
        found.append(_Chord(plane, float(inside[-1]), s1, (0.0, after)))
    return [c for c in found if config.min_width <= c.width <= config.max_opening]


def line_runs(plane: LayoutPlane, planes: Sequence[LayoutPlane]) -> list[tuple[float, float]]:
    """The runs of all planes in one line with a plane, joined where they meet."""
    runs: list[tuple[float, float]] = []
    mine = [p for p in planes if p.facing.axis == plane.facing.axis and abs(p.offset - plane.offset) <= _LINE]
    for start, end in sorted((float(s), float(e)) for p in mine for s, e in p.walls):
        if runs and start <= runs[-1][1] + 0.05:
            runs[-1] = runs[-1][0], max(runs[-1][1], end)
        else:
            runs.append((start, end))
    return runs


class _Space:
    """The floor and the walls as cells, with the chords that were closed."""

    def __init__(self, planes: Sequence[LayoutPlane], evidence: Evidence) -> None:
        self._origin, self._cell = evidence.origin, evidence.cell
        body = height_mask(*_BODY)
        levels = int(body).bit_count()
        floor = by_strips(evidence.free, lambda some: count_bits(some & body) > _FREE * levels)
        stands = by_strips(evidence.occupied, lambda some: count_bits(some & body) > _STANDS * levels)
        label, _ = label_patches(~floor, connectivity=8)
        speck = np.bincount(label.ravel()) * evidence.cell**2 < _SPECK
        speck[0] = False
        self._floor = floor | speck[label]
        self._open = ~stands | speck[label]
        for plane in planes:
            for start, end in plane.walls:
                self._cells(self._open, plane.facing.axis, plane.offset, start, end)[:] = False

    def close(self, chord: _Chord) -> None:
        """What lies behind a chord is another space from now on."""
        axis, offset = chord.plane.facing.axis, chord.plane.offset
        for mask in (self._floor, self._open):
            self._cells(mask, axis, offset, chord.start - self._cell, chord.end + self._cell)[:] = False

    def _cells(self, grid: Cells, axis: int, offset: float, start: float, end: float) -> Cells:
        """A view of the cells of a line along a wall."""
        grid = grid if axis == 0 else grid.T
        i = int(np.clip((offset - self._origin[axis]) / self._cell, 0, grid.shape[1] - 1))
        j0, j1 = (max(round((v - self._origin[1 - axis]) / self._cell), 0) for v in (start, end))
        return grid[j0:j1, i]

    def _free_part(self, chord: _Chord) -> tuple[float, float] | None:
        """From the first to the last floor of a chord, metres along it; None where it is too little."""
        cells = self._cells(self._floor, chord.plane.facing.axis, chord.plane.offset, chord.start, chord.end)
        at = np.flatnonzero(cells)
        if len(at) * self._cell < _PASSED:
            return None
        return chord.start + float(at[0]) * self._cell, chord.start + float(at[-1] + 1) * self._cell

    def parts(self, chord: _Chord) -> bool:
        """True where a chord is the neck between two spaces."""
        axis, cell = chord.plane.facing.axis, self._cell
        free = self._free_part(chord)
        if free is None:
            return False
        middle = np.array([chord.plane.offset, sum(free) / 2])[:: 1 - 2 * axis]
        x, y = (float(v) for v in (middle - self._origin) / cell - 0.5)
        ways = [(s, 0.0) if axis == 0 else (0.0, s) for s in (1.0, -1.0)]
        ahead = [march(self._floor, x, y, dx, dy, _FAR / cell) * cell for dx, dy in ways]
        tunnel, length = _TUNNEL / cell, chord.width / cell

        def ratios(span: float) -> list[float]:
            return [opening(self._open, x, y, dx, dy, length, tunnel, span / cell)[0] for dx, dy in ways]

        near, far = ratios(_BEYOND), ratios(_PASSAGE)
        if min(near) > _WIDE_NECK or _is_passed_by(chord, near, far, ahead):
            return False
        if chord.door is not None:
            return True
        return min(ahead) >= _DEPTH and max(near) <= _widest(chord.width) and _in_wall(chord)

    def sides(self, chords: Sequence[_Chord]) -> list[tuple[int, int]]:
        """Numbers of the spaces before and behind each chord, once all are closed; 0 where there is none."""
        label, _ = label_patches(self._floor)
        return [(self._behind(c, 1, label), self._behind(c, -1, label)) for c in chords]

    def _behind(self, chord: _Chord, sign: int, label: NDArray[np.int32]) -> int:
        """The space that most of the cells a step off a chord belong to."""
        axis = chord.plane.facing.axis
        at = chord.plane.offset + sign * _STEP
        cells = self._cells(label, axis, at, chord.start, chord.end)
        inside = cells[cells > 0]
        return int(np.bincount(inside).argmax()) if len(inside) else 0


def _healed(found: Sequence[_Chord], space: _Space, config: DoorsConfig) -> list[_Chord]:
    """The chords without those between two spaces of many doors: they are narrowings of one corridor."""
    sides = space.sides(found)
    many = {k for k in {k for pair in sides for k in pair} if sum(k in pair for pair in sides) > _FEW_DOORS}
    return [
        c
        for c, (one, other) in zip(found, sides, strict=True)
        if not (one != other and {one, other} <= many - {0})
        or (min(c.flanks) >= _JAMB and c.width <= config.max_width)
    ]


def _once(necks: Sequence[Door], known: Sequence[Door]) -> list[Door]:
    """The necks without those at a door that other evidence tells, or that another face of the wall told.

    Both faces of a wall have a gap at a doorway, and closing the line of one leaves that of the other open.
    """
    kept: list[Door] = []
    for neck in necks:
        if not any(_same(neck, door) for door in (*known, *kept)):
            kept.append(neck)
    return kept


def _same(one: Door, other: Door) -> bool:
    """True for two doors in one place of one wall."""
    shared = min(one.end, other.end) - max(one.start, other.start)
    near = abs(one.offset - other.offset) <= max(one.thickness, other.thickness) / 2 + _LINE
    least = min(one.end - one.start, other.end - other.start)
    return one.axis == other.axis and near and shared > _TWICE * least


def _widest(width: float) -> float:
    return _NECK if width <= _DOOR else _WIDE_NECK


def _in_wall(chord: _Chord) -> bool:
    """True where enough wall is in line with a gap."""
    least, most = sorted(chord.flanks)
    share = (least + most) / (least + most + chord.width)
    if chord.width > _DOOR:
        return most >= _LONG_FLANK and share >= _WIDE_SHARE
    return most >= (_FLANK if least > 0 else _LONG_FLANK) and share >= _SHARE


def _is_passed_by(chord: _Chord, near: Sequence[float], far: Sequence[float], ahead: Sequence[float]) -> bool:
    """True for a chord through which a corridor goes on, unless it ends there, between jambs, at a room."""
    for this, other in ((0, 1), (1, 0)):
        width = chord.width / max(far[this], 1e-9)
        narrow = min(near[this], far[this]) > _SAME_WIDTH and width <= _CORRIDOR and ahead[this] >= _PASSAGE
        room = far[other] <= _ROOM and ahead[other] >= _ROOM_DEPTH and min(chord.flanks) >= _JAMB
        if narrow and not room:
            return True
    return False


def _door(chord: _Chord, planes: Sequence[LayoutPlane], config: DoorsConfig) -> Door:
    """The chord as a door, a child of both faces of its wall where both were seen."""
    face = chord.plane
    behind = [
        p
        for p in planes
        if p.facing == face.facing.opposite
        and 0.0 < (face.offset - p.offset) * face.facing.sign <= config.max_thickness
        and any(s < chord.end + _BESIDE and e > chord.start - _BESIDE for s, e in p.walls)
    ]
    far = min(behind, key=lambda p: (abs(p.offset - face.offset), p.id), default=face)
    jambs = "wall on both sides" if min(chord.flanks) > 0 else "corner"
    return Door(
        id="",
        planes=(face.id,) if far is face else (face.id, far.id),
        axis=face.facing.axis,
        offset=(face.offset + far.offset) / 2,
        start=chord.start,
        end=chord.end,
        thickness=abs(face.offset - far.offset),
        kind="door" if chord.width <= config.max_width else "opening",
        confidence=_CONFIDENCE,
        evidence=("narrow between two spaces", jambs),
    )

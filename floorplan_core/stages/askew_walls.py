"""Walls that do not follow the frame: long lines of wall at other angles (beyond the paper).

In: the evidence in the frame of the building. Out: patches of wall, and which of them are in such lines; what
of these is in no wing, as a share of all walls, for the user. A corner or an edge that a cell cuts gives a
patch at any angle, and so does noise, but no line of them. Cost: a pass over the surfels.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import FrameConfig
from floorplan_core.geometry.cell_normals import CellNormals, fit_cell_normals
from floorplan_core.geometry.masks import label_patches
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.manhattan_frame import strongest_direction

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

ASKEW = math.radians(10)  # from the frame: walls at less are noise of those that fit
NEAR = math.radians(8)  # of a direction: the wall follows it
STEEP = math.sin(math.radians(15))  # |z| of the normal of a wall
BAND = (1.0, 3.0)  # m above the floor, where walls are looked at: little furniture
_WIDER, _MORE, _WIDEST = 2.0, 1.5, 4.0  # times the usual patch; times as much that it explains; the largest
_LONG = 1.5  # m between the ends of a line of patches: a door's leaf is shorter
_AT_ONCE = 2_000_000  # surfels whose patches are fitted together: 300 MB
_STRIP = 16  # of the widest patches that a strip of a large site is wide: 16 m
_FAR = 30_000  # strips from the origin, beyond which all are one: stray points
_ARRAYS = ("xy", "normal", "angle", "area", "surfels")  # of WallPatches
_PATCHES = 3  # patches that it is long at least
TOLD = 2.0  # m2 of wall at other angles in no wing, from which the user is told


@dataclass(frozen=True)
class WallPatches:
    """The planar, vertical patches of a survey."""

    xy: Float  # (P, 2) metres, manhattan frame
    normal: Float  # (P, 2) of arbitrary sign
    angle: Float  # (P,) radians of the normal
    area: Float  # (P,) m2 that was hit
    cell: float  # m, width of a patch
    surfels: Float  # (K, 2) where their surfels are

    def along(self, turn: float) -> Mask:
        """(P,) which follow the direction at ``turn`` radians to the axes."""
        return np.asarray(np.abs(quarter(self.angle - turn)) < NEAR)

    def extent(self, chosen: Mask) -> float:
        """m2 over which the ``chosen`` patches spread, as sparse as the points may be."""
        return float(np.count_nonzero(chosen)) * self.cell**2

    @property
    def askew(self) -> Mask:
        """(P,) which follow no axis."""
        return np.asarray(np.abs(quarter(self.angle)) > ASKEW)


@dataclass(frozen=True)
class AskewWalls:
    """What of the walls stands in long lines at other angles than the plan and its wings."""

    area: float  # m2
    share: float  # 0 to 1, of all walls

    def warnings(self) -> tuple[str, ...]:
        """What the user should know of them."""
        if self.area < TOLD:
            return ()
        return (
            f"{self.area:.0f} m2 of wall ({self.share:.1%} of all) stand at other angles than the plan, and "
            "no rooms follow them: they come out as steps or are missing.",
        )


def wall_patches(xyz: Float, rows: Mask, surfel: float, config: FrameConfig) -> WallPatches:
    """The patches of all walls among the ``rows`` of surfels (N, 3) of ``surfel`` metres; wider ones where
    noise is thick. Of a large site strip by strip, cut between cells; the fullest strip says how wide.
    """
    if np.count_nonzero(rows) <= _AT_ONCE:
        return _patches_of(xyz[rows], surfel, config)
    strip = _strips(xyz, rows, _STRIP * _WIDEST * config.cell)
    counts = np.bincount(strip)[1:]
    places = 1 + np.flatnonzero(counts)
    first, *others = (1 + np.argsort(-counts, kind="stable")[: len(places)]).tolist()
    found = {first: _patches_of(xyz[strip == first], surfel, config)}
    width = found[first].cell
    for place in others:
        some = xyz[strip == place]
        fitted = fit_cell_normals(some, width, config.planarity, most=len(some))
        found[place] = _walls_of(fitted, some, surfel, width)
    ordered = [found[place] for place in places.tolist()]
    joined = {n: np.concatenate([getattr(w, n) for w in ordered]) for n in _ARRAYS}
    return WallPatches(cell=width, **joined)


def _strips(xyz: Float, rows: Mask, width: float) -> NDArray[np.uint16]:
    """(N,) number of the strip of ``width`` metres along x of a surfel, from 1; 0: not of the rows."""
    strip = np.zeros(len(xyz), dtype=np.uint16)
    for start in range(0, len(xyz), _AT_ONCE):
        part = slice(start, start + _AT_ONCE)
        number = np.clip(np.floor(xyz[part, 0] / width), -_FAR, _FAR) + _FAR + 1
        strip[part] = np.where(rows[part], number, 0)
    return strip


def _patches_of(xyz: Float, surfel: float, config: FrameConfig) -> WallPatches:
    """Those of all of the surfels."""
    if len(xyz) == 0:
        none = np.zeros(0)
        return WallPatches(np.zeros((0, 2)), np.zeros((0, 2)), none, none, config.cell, np.zeros((0, 2)))
    best, width = fit_cell_normals(xyz, config.cell, config.planarity, most=len(xyz)), config.cell
    while width < _WIDEST * config.cell:
        wider = fit_cell_normals(xyz, _WIDER * width, config.planarity, most=len(xyz))
        if wider.weight.sum() <= _MORE * best.weight.sum():
            break
        best, width = wider, _WIDER * width
    return _walls_of(best, xyz, surfel, width)


def _walls_of(found: CellNormals, xyz: Float, surfel: float, width: float) -> WallPatches:
    vertical = np.abs(found.normal[:, 2]) < STEEP
    normal = found.normal[vertical, :2]
    seen = np.append(vertical, False)[found.cell_of]
    angle = np.arctan2(normal[:, 1], normal[:, 0])
    area = found.weight[vertical] * surfel**2
    return WallPatches(found.centre[vertical, :2], normal, angle, area, width, xyz[seen, :2])


def in_band(z: Float) -> Mask:
    """(N,) which heights above the floor are those at which walls are looked at."""
    return np.asarray((z > BAND[0]) & (z < BAND[1]))


def walls_of(evidence: Evidence, config: FrameConfig) -> WallPatches:
    """The patches of the walls of a storey."""
    return wall_patches(evidence.xyz, in_band(evidence.xyz[:, 2]), evidence.surfel, config)


class WallsOnce:
    """:func:`walls_of`, once for the evidence that is asked for again."""

    def __init__(self, config: FrameConfig) -> None:
        self._config = config
        self._last: tuple[Evidence, WallPatches] | None = None

    def __call__(self, evidence: Evidence) -> WallPatches:
        """The patches of the walls in ``evidence``."""
        if self._last is None or self._last[0] is not evidence:
            self._last = evidence, walls_of(evidence, self._config)
        return self._last[1]


def in_long_lines(walls: WallPatches, chosen: Mask) -> Mask:
    """(P,) which of the ``chosen`` patches touch each other in long lines, straight or curved."""
    lines = np.zeros(len(chosen), dtype=bool)
    if not chosen.any():
        return lines
    place = np.floor(walls.xy / walls.cell).astype(np.int64)
    column, row = (place - place.min(axis=0)).T
    mine, others = (np.zeros((row.max() + 1, column.max() + 1)) for _ in range(2))
    np.add.at(mine, (row[chosen], column[chosen]), walls.area[chosen])
    np.add.at(others, (row[~chosen], column[~chosen]), walls.area[~chosen])
    label, count = label_patches(mine > others, connectivity=8)
    of = label[row[chosen], column[chosen]]
    low, high = np.full((count + 1, 2), np.inf), np.full((count + 1, 2), -np.inf)
    np.minimum.at(low, of, walls.xy[chosen])
    np.maximum.at(high, of, walls.xy[chosen])
    with np.errstate(invalid="ignore"):
        long = np.hypot(*(high - low).T) >= max(_LONG, _PATCHES * walls.cell)
    long[0] = False
    lines[chosen] = long[of]
    return lines


def askew_walls(seen: Sequence[tuple[Evidence, Mask]], patches: WallsOnce) -> AskewWalls:
    """The walls that are in no wing; ``seen`` holds evidence, each with the cells of its wings and around."""
    askew = total = 0.0
    for evidence, wings in seen:
        walls = patches(evidence)
        lines = in_long_lines(walls, walls.askew) & ~over_cells(wings, walls.xy, evidence)
        askew, total = askew + float(walls.area[lines].sum()), total + float(walls.area.sum())
    return AskewWalls(askew, askew / total if total else 0.0)


def walls_at_angles(
    xyz: Float, surfel: float, floors: Sequence[float], config: FrameConfig
) -> tuple[AskewWalls, float]:
    """The walls at other angles than the frame that surfels (N, 3) are in, those of wings too, and the angle
    of most of them, radians. ``floors``: m, of the storeys."""
    rows = np.any([in_band(xyz[:, 2] - floor) for floor in floors], axis=0)
    walls = wall_patches(xyz, rows, surfel, config)
    lines = in_long_lines(walls, walls.askew)
    if not lines.any():
        return AskewWalls(0.0, 0.0), 0.0
    area = float(walls.area[lines].sum())
    turn = strongest_direction(walls.angle[lines], walls.area[lines])
    return AskewWalls(area, area / float(walls.area.sum())), turn


def quarter(angle: Float | float) -> Float:
    """Angles modulo 90 degrees, in [-45, 45)."""
    return np.asarray((np.asarray(angle) + math.pi / 4) % (math.pi / 2) - math.pi / 4)


def over_cells(cells: Mask, xy: Float, evidence: Evidence) -> Mask:
    """(N,) which places lie over ``cells`` of the evidence; False beyond the grid."""
    index = np.floor((xy - evidence.origin) / evidence.cell).astype(np.int64)
    ny, nx = cells.shape
    inside = (index >= 0).all(axis=1) & (index[:, 0] < nx) & (index[:, 1] < ny)
    index[~inside] = 0
    return np.asarray(cells[index[:, 1], index[:, 0]] & inside)

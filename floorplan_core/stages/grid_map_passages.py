"""Doors and passages of a map: the chords of its free space that complete a wall.

In: the floor of a map (cells where one can stand). Out: chords that part it into spaces. Ends of walls are
the reflex corners of the free space. Candidate chords join two of them, or prolong a wall from one of them to
the wall ahead: the apertures of the paper's matched filter, for walls of any direction. A chord is

- a *door* where both sides are much wider than it, measured parallel to it behind the wall's thickness, and
  wall stands in its line;
- a *passage* where it is wider, in a line that is mostly wall;
- a *mouth* where a corridor as wide as the chord opens into a hall.

Doors are cut first, then passages, then mouths, each from the shortest; chords with more wall in their line
count as shorter. What turns out to part nothing, or two pieces of one corridor, is healed again.
Cost: the corners times their neighbours within ``max_passage``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import MapsConfig
from floorplan_core.geometry.borders import find_borders, simplified
from floorplan_core.geometry.masks import distance_to_gap, measure_patches
from floorplan_core.stages.grid_map_chords import hall_ahead, in_sight, march, opening, wall_ahead
from floorplan_core.stages.grid_map_doorways import middle_of_wall

Float = NDArray[np.float64]
Bool = NDArray[np.bool_]
Labels = NDArray[np.int32]

DOOR, PASSAGE, MOUTH = "door", "passage", "mouth"

_SMOOTH = 1.5  # cells a wall may deviate from its straight line
_REFLEX = 30.0  # degrees that the boundary turns around the end of a wall
_SPIKE = 170.0  # degrees: a wall one cell thick turns right back
_LEAST_EDGE = 0.3  # m of straight wall whose direction can be trusted
_LOOK = 5.0  # m in which wall in line is looked for
_FACE, _INSIDE = 2.0, 7.0  # cells in front of and behind a wall's face that still belong to it
_NO_WALL = 0.5  # a chord without any wall in its line counts as longer by this share
_TUNNEL, _BEYOND = 0.5, 0.8  # m: thickest wall; stretch behind it in which the free width is taken
_PASSAGE_WALL = 1.0  # m of wall in line that a passage needs at one of its ends
_LEAST_DEPTH = 0.5  # m that one must be able to go on either side
_HALL_REACH = 3.0  # m beyond a mouth in which the hall begins
_CORRIDOR = 1.15  # a corridor is no narrower than its mouth by more than this factor
_MOUTH_DEPTH = 1.5  # of its width that a corridor continues
_SAME_WIDTH = 0.85  # of the width on both sides, from which a chord parts nothing


@dataclass(frozen=True)
class Passage:
    """A chord that parts two spaces; cell coordinates (x, y), the middle of a cell at whole numbers."""

    start: tuple[float, float]
    end: tuple[float, float]
    kind: str  # DOOR, PASSAGE or MOUTH
    opening: float  # its width over the free width beyond, on the narrower side
    wall: float  # 0 to 1: share of wall in its line, the chord included
    flanks: tuple[float, float]  # m of wall in line beyond either end


@dataclass(frozen=True)
class _Chords:
    """Candidates, best first."""

    ends: Float  # (K, 4) x0, y0, x1, y1, cells
    length: Float  # (K,) cells
    flanks: Float  # (K, 2) cells of wall in line beyond either end
    wall: Float  # (K,) share of wall in line


def find_passages(floor: Bool, cell: float, config: MapsConfig) -> tuple[tuple[Passage, ...], Labels]:
    """The chords that part the floor, and (ny, nx) the number of the space of each cell, 0 where none."""
    chords = _candidates(floor, cell, config)
    cut = floor.copy()
    found: list[Passage] = []
    for kind, longest, share in (
        (DOOR, config.max_door, config.door_wall),
        (PASSAGE, config.max_passage, config.passage_wall),
        (MOUTH, config.max_mouth, config.passage_wall),
    ):
        gap = distance_to_gap(cut)
        for k in map(int, np.flatnonzero((chords.wall >= share) & (chords.length <= longest / cell))):
            width = _parts(chords, k, kind, cut, gap, cell, config)
            if width is not None:
                found.append(_passage(chords, k, kind, width, cell))
                _draw(cut, chords.ends[k])
    return _heal(found, floor, cut, cell, config)


def label_spaces(cut: Bool, cell: float, config: MapsConfig) -> Labels:
    """(ny, nx) 4-connected spaces, numbered from 1 in row order; those below ``min_space`` are 0."""
    labels, patches = measure_patches(cut)
    large = np.concatenate([[False], patches[:, 4] * cell**2 >= config.min_space])
    number = np.zeros(len(large), dtype=np.int32)
    number[large] = np.arange(1, np.count_nonzero(large) + 1)
    return np.asarray(number[labels], dtype=np.int32)


def _draw(cut: Bool, ends: Float) -> None:
    """Take out the cells of a chord; a 4-connected line stops rays of any direction, too."""
    import cv2

    x0, y0, x1, y1 = (round(float(v)) for v in ends)
    cv2.line(cut.view(np.uint8), (x0, y0), (x1, y1), 0, 1, cv2.LINE_4)


def _candidates(floor: Bool, cell: float, config: MapsConfig) -> _Chords:
    """Chords between wall ends, and from wall ends in the direction of their walls."""
    corners = _wall_ends(floor)
    limits = config.min_width / cell, max(config.max_passage, config.max_mouth, config.max_door) / cell
    rows = [*_between(floor, corners, *limits), *_prolonged(floor, corners, cell, *limits)]
    ends = np.array(rows, dtype=np.float64).reshape(-1, 4)
    length = np.hypot(ends[:, 2] - ends[:, 0], ends[:, 3] - ends[:, 1])
    ends, length = ends[length >= limits[0]], length[length >= limits[0]]
    flanks = _flanks(floor, ends, length, cell)
    wall = flanks.sum(axis=1) / (flanks.sum(axis=1) + length)
    order = np.lexsort((*ends.T, length * (1 + _NO_WALL * (1 - wall))))
    return _Chords(ends[order], length[order], flanks[order], wall[order])


def _wall_ends(floor: Bool) -> Float:
    """(N, 8) reflex corners: x, y, then direction and length of each of its two walls, towards the corner."""
    rows = [_reflex(simplified(border.cells, _SMOOTH), border.hole) for border in find_borders(floor)]
    return np.concatenate([np.zeros((0, 8)), *rows])


def _reflex(ring: Float, hole: bool) -> Float:
    """The reflex corners of one boundary of the free space; ``hole``: it runs around an obstacle."""
    if len(ring) < 2:
        return np.zeros((0, 8))
    before, after = ring - np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0) - ring
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn = np.degrees(np.arctan2(cross, (before * after).sum(axis=1)))
    area = float(np.sum(ring[:, 0] * np.roll(ring[:, 1], -1) - ring[:, 1] * np.roll(ring[:, 0], -1)))
    turn *= (1.0 if area >= 0 else -1.0) * (-1.0 if hole else 1.0)
    corner = (turn < -_REFLEX) | (np.abs(turn) > _SPIKE)
    a, b = np.linalg.norm(before, axis=1), np.linalg.norm(after, axis=1)
    table = np.column_stack([ring, before / a[:, None], a, -after / b[:, None], b])
    return np.asarray(table[corner])


def _between(floor: Bool, corners: Float, least: float, most: float) -> Float:
    """(K, 4) chords that join two wall ends in sight of each other."""
    from scipy.spatial import cKDTree

    if len(corners) < 2:
        return np.zeros((0, 4))
    pairs = cKDTree(corners[:, :2]).query_pairs(most, output_type="ndarray").astype(np.int64)
    pairs = pairs[in_sight(floor, corners[:, :2].copy(), pairs, least)]
    a, b = corners[pairs[:, 0], :2], corners[pairs[:, 1], :2]
    swapped = (a[:, 0] > b[:, 0]) | ((a[:, 0] == b[:, 0]) & (a[:, 1] > b[:, 1]))
    return np.where(swapped[:, None], np.hstack([b, a]), np.hstack([a, b]))


def _prolonged(floor: Bool, corners: Float, cell: float, least: float, most: float) -> list[Float]:
    """Chords that go on in the direction of a wall, from its end to the wall ahead."""
    rows = []
    for corner in corners:
        for dx, dy, straight in (corner[2:5], corner[5:8]):
            if straight * cell < _LEAST_EDGE:
                continue
            x, y = corner[0] + 1.5 * dx, corner[1] + 1.5 * dy  # off the corner's own cell
            length = march(floor, x, y, dx, dy, most)
            if least <= length < most:
                rows.append(
                    np.array([*corner[:2], round(x + dx * (length - 0.5)), round(y + dy * (length - 0.5))])
                )
    return rows


def _flanks(floor: Bool, ends: Float, length: Float, cell: float) -> Float:
    """(K, 2) cells of wall in line beyond the two ends of each chord."""
    gap, depth = distance_to_gap(floor), distance_to_gap(~floor)
    reach = np.array([_LOOK / cell, _FACE, _INSIDE])
    out = np.zeros((len(ends), 2))
    for k, (x0, y0, x1, y1) in enumerate(ends):
        dx, dy = (x1 - x0) / length[k], (y1 - y0) / length[k]
        out[k] = (
            wall_ahead(gap, depth, x0, y0, -dx, -dy, reach),
            wall_ahead(gap, depth, x1, y1, dx, dy, reach),
        )
    return out


def _parts(
    chords: _Chords, k: int, kind: str, cut: Bool, gap: Float, cell: float, config: MapsConfig
) -> float | None:
    """The ratio of widths of a chord that parts two spaces; None for one that does not."""
    x0, y0, x1, y1 = chords.ends[k]
    length = float(chords.length[k])
    dx, dy = (x1 - x0) / length, (y1 - y0) / length
    if march(cut, x0 + 1.5 * dx, y0 + 1.5 * dy, dx, dy, length - 3) < length - 3.6:
        return None  # crosses one that was cut already
    if kind == PASSAGE and float(chords.flanks[k].max()) * cell < _PASSAGE_WALL:
        return None  # a slanting line between two corners, not a gap in a wall
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    tunnel, beyond = _TUNNEL / cell, _BEYOND / cell
    sides = [opening(cut, x, y, -s * dy, s * dx, length, tunnel, beyond) for s in (1.0, -1.0)]
    if min(depth for _, depth in sides) * cell < _LEAST_DEPTH:
        return None
    if kind == MOUTH:
        return _mouth(x, y, dx, dy, length, cut, gap, cell, config)
    width = max(ratio for ratio, _ in sides)
    return width if width <= (config.door_opening if kind == DOOR else config.passage_opening) else None


def _mouth(
    x: float,
    y: float,
    dx: float,
    dy: float,
    length: float,
    cut: Bool,
    gap: Float,
    cell: float,
    config: MapsConfig,
) -> float | None:
    """The ratio of a corridor's half width to the radius of the hall into which it opens, if it does."""
    reach = _HALL_REACH / cell + length
    halls = [hall_ahead(cut, gap, x, y, -s * dy, s * dx, reach) for s in (1.0, -1.0)]
    wide, narrow = (length / 2 / max(r, 0.1) for r in sorted((r for r, _ in halls), reverse=True))
    goes_on = min(ahead for _, ahead in halls) >= _MOUTH_DEPTH * length
    return wide if goes_on and wide <= config.mouth_opening and narrow <= _CORRIDOR else None


def _passage(chords: _Chords, k: int, kind: str, width: float, cell: float) -> Passage:
    x0, y0, x1, y1 = (float(v) for v in chords.ends[k])
    flanks = (float(chords.flanks[k, 0] * cell), float(chords.flanks[k, 1] * cell))
    return Passage((x0, y0), (x1, y1), kind, width, float(chords.wall[k]), flanks)


def _heal(
    found: Sequence[Passage], floor: Bool, cut: Bool, cell: float, config: MapsConfig
) -> tuple[tuple[Passage, ...], Labels]:
    """Take back what parts nothing, or two pieces of one corridor."""
    gap, labels = distance_to_gap(cut), label_spaces(cut, cell, config)
    radius = np.zeros(int(labels.max()) + 1)
    np.maximum.at(radius, labels, gap)
    radius[0] = np.inf
    kept = [_in_wall(p, floor, cell) for p in found if not _is_idle(p, labels, radius, cell)]
    whole = floor.copy()
    for passage in kept:
        _draw(whole, np.array([*passage.start, *passage.end]))
    return tuple(kept), label_spaces(whole, cell, config)


def _in_wall(passage: Passage, floor: Bool, cell: float) -> Passage:
    """The passage in the middle of its wall; a mouth has no wall."""
    if passage.kind == MOUTH:
        return passage
    start, end = middle_of_wall(floor, passage.start, passage.end, _TUNNEL / cell)
    return replace(passage, start=start, end=end)


def _is_idle(passage: Passage, labels: Labels, radius: Float, cell: float) -> bool:
    """True for a chord with one space all around it, and for one as wide as both spaces beside it."""
    one, other = (int(v) for v in _beside(passage, labels))
    if one == other > 0:
        return True
    beside = [v for v in (one, other) if v > 0]
    half = float(np.hypot(passage.end[0] - passage.start[0], passage.end[1] - passage.start[1])) / 2
    return passage.kind == PASSAGE and bool(beside) and half >= _SAME_WIDTH * float(radius[beside].max())


def _beside(passage: Passage, labels: Labels) -> Labels:
    """Labels two cells off the middle of a chord, on both sides."""
    a, b = np.array(passage.start), np.array(passage.end)
    normal = np.array([a[1] - b[1], b[0] - a[0]]) / np.hypot(*(b - a))
    at = np.round((a + b) / 2 + np.outer([-2.0, 2.0], normal)).astype(int)
    at = np.clip(at, 0, np.array(labels.shape)[::-1] - 1)
    return np.asarray(labels[at[:, 1], at[:, 0]])

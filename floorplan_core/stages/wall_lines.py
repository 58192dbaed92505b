"""Long lines of wall in a survey without viewpoints, and where free space passes them.

A cloud without viewpoints (an occupancy map, say) does not tell a doorway from a gap in the data: behind both
nothing is known for sure, so the wall of a corridor is in pieces and its rooms hang together with it. But
pieces in one line that make up most of it are one wall. It is open where free space passes its whole
thickness, and nowhere else: there it has doors, and everything between is hidden wall.
In: planes with their runs and profiles; voxel columns, of which the free ones hold what may have been seen
(:mod:`~floorplan_core.stages.guessed_viewpoints`). Out: longer runs, and doors. Cost: planes times planes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.geometry.columns import count_bits, height_mask
from floorplan_core.geometry.runs import runs_of
from floorplan_core.model import Door, LayoutPlane
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.blockers import crossing_offsets, crossing_walls

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

_ABREAST = 0.25  # m between two planes of one wall: recesses, and voxels of 0.1 m
_LONG, _BUILT = 6.0, 0.5  # m of a line, and the share of it seen as wall, from which it is one wall
_BODY = 0.4, 1.8  # m above the floor at which a passage is free
_FREE, _GHOST = 0.5, 0.35  # share of it that must be; where a leaf stood for a time, that leaves half a wall
_SKIN = 0.1  # m of free space before and behind a wall that a passage must reach
_NARROWEST = (
    0.15  # m of straight passage, two cells: where a door was seen at a slant, little of it is straight
)
_CORNER = 1.8  # m between the end of a line and the wall across at which it ends: a door beside the corner
_STANDS = 0.12  # of the height below 2 m, seen: wall
_JAMB = 0.5  # m of hidden wall at most that a passage seen at a slant is widened by, on either side
_SILL = 0.15, 0.75  # m above the floor at which wall stands below a window; cabinets leave gaps there
_WIDEST = 1.6  # m: a wider passage is the mouth of a corridor, and no door
_BESIDE = 1.0  # m from a passage, in which a plane is a face of the wall that it passes
_CONFIDENCE = 0.6  # a door that the line of the wall and free space show


@dataclass(frozen=True)
class WallLine:
    """Planes of one wall, from its first to its last piece."""

    planes: tuple[LayoutPlane, ...]  # the one with the most support first
    start: float  # metres along the wall
    end: float
    passages: tuple[tuple[float, float], ...]  # where free space passes it, metres along it


def bridge_lines(
    planes: Sequence[LayoutPlane], evidence: Evidence, config: DoorsConfig
) -> tuple[LayoutPlane, ...]:
    """The planes; the strongest of each long line is wall all along it, but where the line is wide open."""
    runs: dict[str, list[tuple[float, float]]] = {}
    for line in find_lines(planes, evidence, config):
        runs.setdefault(line.planes[0].id, []).extend(_closed(line))
    return tuple(
        replace(p, walls=united([*map(tuple, p.walls.tolist()), *runs[p.id]])) if p.id in runs else p
        for p in planes
    )


def line_doors(
    planes: Sequence[LayoutPlane], doors: Sequence[Door], evidence: Evidence, config: DoorsConfig
) -> tuple[Door, ...]:
    """The passages of long lines in which no other door is known."""
    lines = find_lines(planes, evidence, config)
    found = [_door(line, s, e, config) for line in lines for s, e in line.passages if e - s <= _WIDEST]
    new = [door for door in found if not any(_overlap(door, other) for other in doors)]
    return tuple(replace(door, id=f"d{len(doors) + k + 1}") for k, door in enumerate(new))


def find_lines(planes: Sequence[LayoutPlane], evidence: Evidence, config: DoorsConfig) -> list[WallLine]:
    """The long lines of a survey without viewpoints, the strongest first; a plane is of one line only."""
    if evidence.viewpoints:
        return []
    left = sorted((p for p in planes if p.profile is not None), key=lambda p: (-p.support, p.id))
    lines: list[WallLine] = []
    while left:
        seed = left[0]
        mine = tuple(
            p for p in left if p.facing.axis == seed.facing.axis and abs(p.offset - seed.offset) <= _ABREAST
        )
        left = [p for p in left if p not in mine]
        across = [line for line in lines if line.planes[0].facing.axis != seed.facing.axis]
        for start, end in _stretches(mine, planes, across, config):
            lines.append(WallLine(mine, start, end, _passages(mine, start, end, evidence, config)))
    return lines


def _stretches(
    mine: Sequence[LayoutPlane],
    planes: Sequence[LayoutPlane],
    across: Sequence[WallLine],
    config: DoorsConfig,
) -> list[tuple[float, float]]:
    """From the first to the last of pieces no farther apart than an opening, where most of it is wall.

    A gap that a longer line runs through is a corridor's width. A line whose end comes near a wall across
    ends there.
    """
    offset = mine[0].offset
    crossed = [x.planes[0].offset for x in across if x.start < offset < x.end]
    groups: list[list[tuple[float, float]]] = []
    for s, e in united([(float(s), float(e)) for p in mine for s, e in p.walls]).tolist():
        last = groups[-1][-1][1] if groups else -np.inf
        if s - last <= config.max_opening and not any(last - _ABREAST < c < s + _ABREAST for c in crossed):
            groups[-1].append((s, e))
        else:
            groups.append([(s, e)])
    spans = [(g[0][0], g[-1][1], sum(e - s for s, e in g)) for g in groups]
    meets = crossing_offsets(mine[0], crossing_walls(planes, 1 - mine[0].facing.axis))
    return [
        (_to_corner(s, -1, meets), _to_corner(e, 1, meets))
        for s, e, built in spans
        if e - s >= _LONG and built >= _BUILT * (e - s)
    ]


def _to_corner(end: float, sign: int, meets: Float) -> float:
    """The end of a line, moved to the first wall across within reach."""
    ahead = (meets - end) * sign
    ahead = ahead[(ahead > 0) & (ahead <= _CORNER)]
    return end + sign * float(ahead.min()) if len(ahead) else end


def _passages(
    planes: Sequence[LayoutPlane], start: float, end: float, evidence: Evidence, config: DoorsConfig
) -> tuple[tuple[float, float], ...]:
    """Where a line is open through its whole thickness, as wide as nothing was seen to stand in it."""
    profile = planes[0].profile
    assert profile is not None
    at = profile.start + profile.step * (np.arange(len(profile.low)) + 0.5)
    within = (at > start) & (at < end)
    stands = np.max([p.profile.low for p in planes if p.profile is not None], axis=0) >= _STANDS
    share = np.where(within, _passed(planes, evidence)[: len(at)], 0.0)
    sure, edges = runs_of(share > _FREE), runs_of(share > _GHOST)
    alone = [not ((sure[:, 0] < b) & (sure[:, 1] > a)).any() for a, b in edges]
    edges = np.concatenate([sure, edges[np.array(alone, dtype=bool)]])
    out = []
    sill = _sills(planes, evidence)[: len(at)]
    for a, b in edges:
        if (b - a) * profile.step < _NARROWEST or sill[a:b].all():
            continue
        most = max(round(config.aperture / profile.step), b - a)
        first, last = _widened(stands, int(a), int(b), round(_JAMB / profile.step), int(most))
        out.append((profile.start + profile.step * first, profile.start + profile.step * last))
    return tuple(map(tuple, united(out).tolist()))


def _passed(planes: Sequence[LayoutPlane], evidence: Evidence) -> Float:
    """(B,) share of a body's height that is free, in bins of the profiles, from before to behind the planes:
    the least on the way."""
    body = height_mask(*_BODY)
    free = _band(evidence.free, planes, evidence) & body
    return np.repeat(count_bits(free).min(axis=1) / int(body).bit_count(), 2)


def _sills(planes: Sequence[LayoutPlane], evidence: Evidence) -> Mask:
    """(B,) bins of the profiles in which wall stands at the height of one's knees: no way for anybody."""
    knees = height_mask(*_SILL)
    seen = np.bitwise_or.reduce(_band(evidence.occupied, planes, evidence) & knees, axis=1)
    return np.repeat(count_bits(seen) == int(knees).bit_count(), 2)


def _band(
    columns: NDArray[np.uint64], planes: Sequence[LayoutPlane], evidence: Evidence
) -> NDArray[np.uint64]:
    """The columns along a wall (first axis), from before to behind its planes."""
    axis = planes[0].facing.axis
    offsets = [p.offset for p in planes]
    low, high = min(offsets) - _SKIN, max(offsets) + _SKIN
    first, last = (int((v - evidence.origin[axis]) / evidence.cell) for v in (low, high))
    return (columns if axis == 0 else columns.T)[:, max(first, 0) : last + 1]


def _widened(stands: Mask, a: int, b: int, reach: int, most: int) -> tuple[int, int]:
    """Bins a to b and what is beside them up to where something stands, by turns, no more than ``most``."""
    first, last = a, b
    for _ in range(reach):
        if first > 0 and not stands[first - 1] and last - first < most:
            first -= 1
        if last < len(stands) and not stands[last] and last - first < most:
            last += 1
    return first, last


def _closed(line: WallLine) -> list[tuple[float, float]]:
    """The line without what is too wide for a door."""
    pieces, at = [], line.start
    for s, e in line.passages:
        if e - s > _WIDEST:
            pieces.append((at, s))
            at = e
    return [p for p in (*pieces, (at, line.end)) if p[1] > p[0]]


def united(spans: Sequence[tuple[float, float]]) -> Float:
    """(K, 2) the union of spans."""
    out: list[list[float]] = []
    for s, e in sorted(spans):
        if out and s <= out[-1][1]:
            out[-1][1] = max(out[-1][1], e)
        else:
            out.append([s, e])
    return np.array(out, dtype=np.float64).reshape(-1, 2)


def _overlap(a: Door, b: Door) -> bool:
    """True for two doors in one place of one wall."""
    near = abs(a.offset - b.offset) <= 2 * _ABREAST
    return a.axis == b.axis and near and min(a.end, b.end) > max(a.start, b.start)


def _door(line: WallLine, start: float, end: float, config: DoorsConfig) -> Door:
    """A passage of a line as a door; its wall reaches over all planes that were seen beside it."""
    beside = [
        p for p in line.planes if any(s < end + _BESIDE and e > start - _BESIDE for s, e in p.walls)
    ] or [line.planes[0]]
    offsets = [p.offset for p in beside]
    lintel = any(_lintel(p, start, end) for p in line.planes)
    return Door(
        id="",
        planes=tuple(p.id for p in beside),
        axis=beside[0].facing.axis,
        offset=(min(offsets) + max(offsets)) / 2,
        start=start,
        end=end,
        thickness=max(offsets) - min(offsets),
        kind="door" if end - start <= config.max_width else "opening",
        confidence=_CONFIDENCE,
        evidence=("passage", "lintel") if lintel else ("passage",),
    )


def _lintel(plane: LayoutPlane, start: float, end: float) -> bool:
    """True where wall was seen above most of a passage."""
    profile = plane.profile
    assert profile is not None
    a, b = (round((v - profile.start) / profile.step) for v in (start, end))
    return b > a and float((profile.high[a:b] > 0).mean()) > 0.5

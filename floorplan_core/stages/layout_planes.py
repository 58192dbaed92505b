"""Layout planes: the minimum set of infinite planes that explains the structural segments (paper, section 3).

In: segments, the rows in which each was seen, and the voxel columns. Out: planes with their offset (the mean
of their segments, weighted by what supports them), and a profile along each plane: where wall was seen low
and high, and where free space passes through. From the profile come the runs that are wall: seen, above a
lintel, or hidden between two seen parts. Cost: linear in segments times the length of the building.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig, PlanesConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.columns import LEVEL, count_bits, height_mask, levels_in_all
from floorplan_core.geometry.runs import runs_of
from floorplan_core.geometry.scratch import disk_array, let_go
from floorplan_core.model import Facing, LayoutPlane, LayoutSegment, WallProfile
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.layout_segments import SegmentRows, wall_band
from floorplan_core.stages.model_selection import pierce_intervals

Float = NDArray[np.float64]
_Offset = TypeVar("_Offset", LayoutPlane, LayoutSegment)

_MANY_PROFILES = 64e6  # bytes of the profiles of one facing, from which they leave memory
_LOW_FROM = 0.2  # m, skirting and floor
_PASSAGE = (0.4, 1.8)  # m, heights at which a passage must be free
_RECESSED = 0.8  # share of a plane that must lie behind another wall to be its recess
_PATCHY = 0.7  # m between patches of floor, where no ray told free space
_SEEN, _STRONG = 0.12, 0.35  # of the height below 2 m: something was seen, a wall was seen
_TAIL = (0.25, 0.7)  # m at the end of a wall in which something was seen here and there
_HOLE = 0.4  # m, too narrow to pass
_LINTEL_HOLE = 1.0  # m, the same of a lintel, where as much was seen of it on both sides
_JAMB_HOLE = 0.6  # m, the same between a lintel and the wall that carries it
_LINTEL, _LINTEL_SHARE = 0.4, 0.5  # m beside such a hole, and the share of it that must show lintel
_JAMB_PIECE = 0.25  # m of wall that is a jamb
_SOME_LINTEL = 0.4  # share of a doorway between two jambs under a lintel, where the rest of it was not seen
_EXACT = 1e-6  # m
_DEPTH = 0.4  # m behind a surface that must be free for a passage through the wall


def find_planes(
    segments: tuple[LayoutSegment, ...],
    rows: dict[str, SegmentRows],
    evidence: Evidence,
    config: PlanesConfig,
    doors: DoorsConfig,
) -> tuple[tuple[LayoutSegment, ...], tuple[LayoutPlane, ...]]:
    """The planes, and the segments with the plane that explains each."""
    named: dict[str, LayoutSegment] = {s.id: s for s in segments}
    planes: list[LayoutPlane] = []
    for facing in Facing:
        mine = [s for s in segments if s.facing == facing and s.structural]
        wall = [s for s in segments if s.facing.axis == facing.axis and s.structural]
        wall.sort(key=lambda s: s.offset)
        if not mine:
            continue
        offset = np.array([s.offset for s in mine])
        reach = np.array([config.tolerance + 3 * min(s.sigma, config.tolerance) for s in mine])
        group = pierce_intervals(offset - reach, offset + reach)
        found: list[LayoutPlane] = []
        groups: list[list[LayoutSegment]] = [[] for _ in range(int(group.max()) + 1)]
        for segment, g in zip(mine, group.tolist(), strict=True):
            groups[g].append(segment)
        for members in groups:
            name = f"p{len(planes) + len(found) + 1}"
            found.append(_plane(name, facing, members, wall, rows, evidence, config, doors))
            named.update({s.id: replace(s, plane=name) for s in members})
        planes += _without_memory(found)
    if not planes:
        raise NoPlanError(
            "No wall was recognised: every vertical surface ends below furniture height "
            "(segments.furniture_height) or is too small; scan higher, or lower that setting."
        )
    return tuple(named[s.id] for s in segments), tuple(planes)


def _without_memory(planes: list[LayoutPlane]) -> list[LayoutPlane]:
    """The planes with their profiles on disk, where they take much: each is as long as the site."""
    profiles = [p.profile for p in planes if p.profile]
    sizes = [len(p.low) for p in profiles]
    if 3 * 8 * sum(sizes) <= _MANY_PROFILES:
        return planes
    held, starts = disk_array((3, sum(sizes)), np.float64), np.cumsum([0, *sizes]).tolist()
    moved = []
    for plane, profile, a, b in zip(planes, profiles, starts, starts[1:], strict=False):
        held[:, a:b] = profile.low, profile.high, profile.through
        low, high, through = held[:, a:b]
        moved.append(replace(plane, profile=replace(profile, low=low, high=high, through=through)))
    let_go(held)
    return moved


def pairable(planes: Sequence[LayoutPlane], config: PlanesConfig) -> list[LayoutPlane]:
    """The planes that may bound a rectangle: enough was seen of them, and they are no recess of another.

    What a person said of a plane comes before that.
    """
    return [p for p in planes if (p.by_hand or _is_wall(p, config)) and p.by_hand != "hidden"]


def _is_wall(plane: LayoutPlane, config: PlanesConfig) -> bool:
    return plane.support >= config.min_support and not plane.recess


def mark_recesses(planes: Sequence[LayoutPlane], config: PlanesConfig) -> tuple[LayoutPlane, ...]:
    """The planes, told which of them are recesses in the wall of another."""
    behind = recessed(planes, config.recess)
    return tuple(replace(p, recess=p.id in behind) for p in planes)


def recessed(planes: Sequence[LayoutPlane], depth: float) -> set[str]:
    """Ids of the planes that lie in a recess of another: window panes, shut leaves, niches in a wall.

    Nearly all that was seen of such a plane is behind wall of the same facing at most ``depth`` metres in
    front.
    """
    out = set()
    of = {f: sorted((p for p in planes if p.facing == f), key=lambda p: p.offset) for f in Facing}
    for plane in planes:
        ahead = [
            q
            for q in _within(of[plane.facing], plane.offset, depth)
            if 0.02 < (q.offset - plane.offset) * plane.facing.sign < depth
        ]
        runs = np.concatenate([q.walls for q in ahead]) if ahead else np.zeros((0, 2))
        length = float((plane.observed[:, 1] - plane.observed[:, 0]).sum())
        stronger = any(q.support > plane.support for q in ahead)
        if stronger and length > 0 and _covered(plane.observed, runs) > _RECESSED * length:
            out.add(plane.id)
    return out


def _within(of: Sequence[_Offset], offset: float, reach: float) -> Sequence[_Offset]:
    """Those of what is sorted by offset that lie within ``reach`` metres, and perhaps some just beyond."""
    first = bisect_left(of, offset - reach - _EXACT, key=lambda one: one.offset)
    return of[first : bisect_right(of, offset + reach + _EXACT, key=lambda one: one.offset)]


def _covered(spans: Float, runs: Float) -> float:
    """Metres of ``spans`` (K, 2) that lie inside ``runs`` (R, 2), which may overlap each other."""
    total = 0.0
    for start, end in spans:
        at = float(start)
        for low, high in sorted((float(a), float(b)) for a, b in runs):
            low, high = max(low, at), min(high, float(end))
            if high > low:
                total += high - low
                at = high
    return total


def _plane(
    name: str,
    facing: Facing,
    members: list[LayoutSegment],
    wall: Sequence[LayoutSegment],
    rows: dict[str, SegmentRows],
    evidence: Evidence,
    config: PlanesConfig,
    doors: DoorsConfig,
) -> LayoutPlane:
    weight = np.array([s.area for s in members])
    offset = float(np.average([s.offset for s in members], weights=weight))
    residual = float(
        np.sqrt(np.average([s.residual**2 + 4 * (s.offset - offset) ** 2 for s in members], weights=weight))
    )
    through = _through(facing, offset, evidence)
    own = _profile(facing, through, members, rows, evidence, doors)
    observed = _runs(own, (own.low > 0) | (own.high > 0))
    # A wall is more than one plane: faces, frames and recessed leaves within its thickness close it together.
    close = _within(wall, offset, config.wall_depth)
    near = [s for s in close if abs(s.offset - offset) <= config.wall_depth]
    profile = _profile(facing, through, near, rows, evidence, doors)
    plane = LayoutPlane(
        name,
        facing,
        offset,
        tuple(s.id for s in members),
        float(weight.sum()),
        residual,
        profile=profile,
        observed=observed,
    )
    return replace(plane, walls=_own_part(wall_runs(profile, config, doors), observed))


def _own_part(runs: Float, observed: Float) -> Float:
    """The runs from the first to the last place where this very plane was seen; the rest is of others."""
    kept = []
    for start, end in runs:
        mine = observed[(observed[:, 1] > start) & (observed[:, 0] < end)]
        if len(mine):
            kept.append((max(start, mine[0, 0]), min(end, mine[-1, 1])))
    return np.array(kept, dtype=np.float64).reshape(-1, 2)


def _profile(
    facing: Facing,
    through: Float,
    members: list[LayoutSegment],
    rows: dict[str, SegmentRows],
    evidence: Evidence,
    doors: DoorsConfig,
) -> WallProfile:
    """What was seen along the plane, for every fine cell of the building's extent.

    :param through: (bins,) as :func:`_through` gives it.
    """
    across = facing.axis
    bins = 2 * (evidence.shape[0] if across == 0 else evidence.shape[1])
    bits = np.zeros(bins, dtype=np.uint64)
    for segment in members:
        np.bitwise_or.at(bits, rows[segment.id].row, rows[segment.id].bits)
    low_mask = height_mask(_LOW_FROM, doors.crop_height)
    high_mask = wall_band(evidence) & ~height_mask(0, doors.crop_height)
    low: Float = count_bits(bits & low_mask) / int(low_mask).bit_count()
    high = LEVEL * count_bits(bits & high_mask).astype(np.float64)
    if evidence.inferred:
        # Free space is inferred from patches of floor and ceiling: spread it over the gaps.
        reach = round(_PATCHY / evidence.fine)
        through = np.lib.stride_tricks.sliding_window_view(np.pad(through, reach), 2 * reach + 1).max(axis=1)
        through = np.where(low > 0, 0.0, through)
    return WallProfile(float(evidence.origin[1 - across]), evidence.fine, low, high, through)


def _through(facing: Facing, offset: float, evidence: Evidence) -> Float:
    """(bins,) share of the passage heights at which all cells from before to behind the wall are free."""
    free = evidence.free if facing.axis == 0 else evidence.free.T
    mask = height_mask(*_PASSAGE)
    steps = np.arange(-_DEPTH, 0.11, evidence.cell)
    columns = ((offset + facing.sign * steps - evidence.origin[facing.axis]) / evidence.cell).astype(int)
    crossed = sorted(set(columns[(columns >= 0) & (columns < free.shape[1])].tolist()))
    if not crossed:
        return np.zeros(2 * free.shape[0])
    through = levels_in_all(free, crossed) & mask
    share: Float = count_bits(through) / int(mask).bit_count()
    return np.repeat(share, 2)


def _runs(profile: WallProfile, mask: NDArray[np.bool_]) -> Float:
    """(K, 2) start and end in metres of the runs of True."""
    return profile.start + runs_of(mask).astype(np.float64) * profile.step


def wall_runs(profile: WallProfile, config: PlanesConfig, doors: DoorsConfig) -> Float:
    """(K, 2) runs that are wall: seen low, below a lintel with wall beside it, or hidden between seen parts.

    A gap is bridged when nothing was seen to pass through it and it is shorter than ``config.bridge``; a gap
    under a lintel is part of the wall (its opening is reported as a door or opening).
    """
    solid = _close(is_solid(profile), 2)
    lintel = _whole_lintels((profile.high > 0) & ~solid, solid, profile.step, doors.max_beamless)
    wall = _close(solid | lintel, round(_HOLE / 2 / profile.step))  # beside the jambs a lintel is seen least
    joined: list[list[int]] = []
    for a, b in runs_of(wall).tolist():
        if joined and (
            _is_hidden(profile, joined[-1][1], a, config)
            or _is_in_lintel(lintel, solid, joined[-1][1], a, profile.step)
        ):
            joined[-1][1] = b
        else:
            joined.append([a, b])
    firm = solid | (lintel & ((profile.through < 0.3) | (profile.high >= doors.lintel_depth)))
    firm &= ~_crumbs(profile, joined)
    kept = [t for r in joined if _stands(profile, solid, r) and (t := _trim(firm, r))]
    return profile.start + np.array(kept, dtype=np.float64).reshape(-1, 2) * profile.step


def is_solid(profile: WallProfile) -> NDArray[np.bool_]:
    """Where wall was seen below 2 m: a few returns in a place that is mostly seen through are no wall."""
    return (profile.low >= _SEEN) & ~((profile.through > 0.5) & (profile.low < _STRONG))


def _close(mask: NDArray[np.bool_], reach: int) -> NDArray[np.bool_]:
    """Fill holes of up to ``2 * reach`` cells."""
    grown = mask.copy()
    for start, end in runs_of(mask).tolist():
        grown[max(start - reach, 0) : end + reach] = True
    closed = grown.copy()
    for start, end in runs_of(~grown).tolist():  # shrunk by as much, but not from the ends of the row
        closed[max(start - reach, 0) : end + reach] = False
    return closed


def _is_hidden(profile: WallProfile, a: int, b: int, config: PlanesConfig) -> bool:
    """True where cells a to b are unseen rather than open."""
    through = profile.through[a:b]
    return (b - a) * profile.step <= config.bridge and float((through > 0.15).mean() if b > a else 0.0) < 0.2


def _whole_lintels(
    lintel: NDArray[np.bool_], solid: NDArray[np.bool_], step: float, widest: float
) -> NDArray[np.bool_]:
    """The lintels; whole between two jambs at most ``widest`` metres apart, where enough was seen of one."""
    pieces = [r for r in runs_of(solid).tolist() if (r[1] - r[0]) * step >= _JAMB_PIECE]
    for (_, a), (b, _) in pairwise(pieces):
        if (b - a) * step <= widest + 2 * step and float(lintel[a:b].mean()) >= _SOME_LINTEL:
            lintel[a:b] = ~solid[a:b]
    return lintel


def _is_in_lintel(lintel: NDArray[np.bool_], solid: NDArray[np.bool_], a: int, b: int, step: float) -> bool:
    """True where cells a to b are a hole in a lintel, or between a lintel and its jamb.

    A tilted lidar sees a lintel in stripes, a scanner near by the parts between its beams.
    """
    reach = round(_LINTEL / step)
    sides = slice(max(a - reach, 0), a), slice(b, b + reach)
    spans = [float(lintel[side].mean()) >= _LINTEL_SHARE for side in sides]
    stands = [bool(solid[side].mean() >= _LINTEL_SHARE) for side in sides]
    widest = _LINTEL_HOLE if all(spans) else _JAMB_HOLE
    return (b - a) * step <= widest and any(spans) and all(np.logical_or(spans, stands))


def _trim(firm: NDArray[np.bool_], run: list[int]) -> list[int] | None:
    """A run without the lintels at its ends that no wall carries."""
    inside = np.flatnonzero(firm[run[0] : run[1]])
    return [run[0] + int(inside[0]), run[0] + int(inside[-1]) + 1] if len(inside) else None


def _crumbs(profile: WallProfile, runs: list[list[int]]) -> NDArray[np.bool_]:
    """(B,) the ends of runs where little was seen here and there: things beside a wall that ends before."""
    strong = (profile.low >= _STRONG) | (profile.high > 2 * LEVEL - 1e-6)
    crumbs = np.zeros(len(profile.low), dtype=bool)
    for a, b in runs:
        inside = np.flatnonzero(strong[a:b])
        if len(inside):
            for tail in (slice(a, a + int(inside[0])), slice(a + int(inside[-1]) + 1, b)):
                seen = profile.low[tail] >= _SEEN
                length = len(seen) * profile.step
                crumbs[tail] = _TAIL[0] <= length <= _TAIL[1] and float(seen.mean()) < 0.5
    return crumbs


def _stands(profile: WallProfile, solid: NDArray[np.bool_], run: list[int]) -> bool:
    """A run must hold wall that stands on the floor: a beam below the ceiling alone separates nothing."""
    return float(solid[run[0] : run[1]].sum()) * profile.step >= 0.25

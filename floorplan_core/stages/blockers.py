"""What no rectangle may hold inside: wall runs and doors, closed at the corners (prunings 3 and 4)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.runs import runs_of
from floorplan_core.model import Door, LayoutPlane, WallProfile
from floorplan_core.stages.layout_planes import is_solid

Float = NDArray[np.float64]

_CORNER = 1.2  # m of unseen wall between the end of a run and the wall that it must meet
_ON = 0.5  # m that a crossing wall must go on beyond a beam or a gap on both sides
_FLANK, _STANDS = 0.6, 0.25  # m beside an opening in which that much wall must stand
_HIDDEN_END, _FREE_BESIDE = 0.4, 0.15  # m of unseen wall towards a corner; share free that shows it open
_STUB, _CORNERED = 0.1, 0.5  # m of wall that is a jamb beside a corner, and how near the corner must be
_HIDDEN = 0.5  # m beside an opening of which nothing was seen before its jamb
_SOLID = 0.12  # of the height below 2 m, seen: something stands there
_PASSED = 1.0  # m of an open stretch through which free space was seen
_JAMB = 0.1  # m from the edge of a door, where its jamb is wall
_BESIDE = 4.0  # m of unseen wall between a door and the next corner
_FREE_SHARE, _LINTEL_SHARE = 0.3, 0.7  # shares of a passage that are free, and under a lintel
_EXACT = 1e-6  # m
_TOUCH = 0.3  # m beyond the end of the other wall
_NOWHERE: Float = np.zeros(0)


def crossing_walls(planes: Sequence[LayoutPlane], axis: int) -> Float:
    """(K, 3) offset, start and end of every wall run of the planes across ``axis``."""
    runs = [(p.offset, s, e) for p in planes if p.facing.axis == axis for s, e in p.walls]
    return np.array(runs, dtype=np.float64).reshape(-1, 3)


def reaching_walls(planes: Sequence[LayoutPlane], axis: int) -> Float:
    """The same, each run longer by what was not seen at its ends: near a corner both walls are hidden."""
    runs = [
        (p.offset, s - _hidden_end(p, s, -1), e + _hidden_end(p, e, 1))
        for p in planes
        if p.facing.axis == axis
        for s, e in p.walls.tolist()
    ]
    return np.array(runs, dtype=np.float64).reshape(-1, 3)


def _hidden_end(plane: LayoutPlane, end: float, sign: int) -> float:
    """Metres beyond the end of a run that no free space passes; 0 where it ends in the open."""
    profile = plane.profile
    if profile is None:
        return 0.0
    first, many = (round(v / profile.step) for v in (end - profile.start, _HIDDEN_END))
    open_ = profile.through > _FREE_BESIDE
    ahead = open_[first : first + many] if sign > 0 else open_[max(first - many, 0) : max(first, 0)][::-1]
    return 0.0 if ahead.any() else len(ahead) * profile.step


def crossing_offsets(plane: LayoutPlane, others: Float) -> Float:
    """(M,) where along ``plane`` the wall runs ``others`` (K, 3) of the other axis cross or nearly meet."""
    near = (others[:, 1] - _TOUCH <= plane.offset) & (others[:, 2] + _TOUCH >= plane.offset)
    return np.asarray(others[near, 0])


def passing_offsets(plane: LayoutPlane, others: Float) -> Float:
    """(M,) where along ``plane`` those of the wall runs ``others`` (K, 3) cross that go on on both sides."""
    beyond = (others[:, 1] < plane.offset - _ON) & (others[:, 2] > plane.offset + _ON)
    return np.asarray(others[beyond, 0])


def close_corners(planes: Sequence[LayoutPlane], widest: float = 0.0) -> tuple[LayoutPlane, ...]:
    """Extend each wall run to the crossing wall near its end, where nothing was seen to pass between.

    Where it goes on as a lintel to just before such a wall at most ``widest`` metres away, and nothing was
    seen of the rest, a jamb is hidden there.
    """
    crossing = {axis: crossing_walls(planes, axis) for axis in (0, 1)}
    out = []
    for plane in planes:
        others = crossing[1 - plane.facing.axis]
        meets, past = crossing_offsets(plane, others), passing_offsets(plane, others)
        corners = np.setdiff1d(meets, past)
        reached = [(_reach(plane, s, -1, meets), _reach(plane, e, 1, meets)) for s, e in plane.walls]
        runs = [
            (_carried(plane, s, -1, corners, widest), _carried(plane, e, 1, corners, widest))
            for s, e in reached
        ]
        out.append(replace(plane, walls=_joined(runs)))
    return tuple(out)


def close_beside_doors(
    planes: Sequence[LayoutPlane], doors: Sequence[Door], inferred: bool = False
) -> tuple[LayoutPlane, ...]:
    """Wall on both sides of each door, up to the next door or crossing wall: a door is cut into a wall.

    Of the wall beside a door nothing may have been seen, behind furniture or at too flat an angle; where free
    space passes it, it is none.

    :param inferred: free space was not seen: it tells nothing of where a crossing wall goes on unseen.
    """
    ends = crossing_walls if inferred else reaching_walls
    crossing = {axis: ends(planes, axis) for axis in (0, 1)}
    of: dict[str, list[Door]] = {}
    for door in doors:
        for name in dict.fromkeys(door.planes):
            of.setdefault(name, []).append(door)
    out = []
    for plane in planes:
        mine = of.get(plane.id, [])
        meets = crossing_offsets(plane, crossing[1 - plane.facing.axis]) if mine else _NOWHERE
        stubs = [_stub(plane, jamb, k, meets, mine) for d in mine for jamb, k in ((d.start, -1), (d.end, 1))]
        more = [(a, b) for a, b in stubs if b > a]
        out.append(replace(plane, walls=_joined([*plane.walls.tolist(), *more])) if more else plane)
    return tuple(out)


def _stub(
    plane: LayoutPlane, jamb: float, sign: int, meets: Float, doors: Sequence[Door]
) -> tuple[float, float]:
    """Start and end of the unseen wall beside a jamb; of no length where there is none, or a door is next."""
    tip = _tip(jamb, sign, plane.walls)
    edges = np.array([d.start if sign > 0 else d.end for d in doors])
    ahead = edges[(edges - tip) * sign > -_EXACT]
    if len(ahead) and float(np.abs(ahead - tip).min()) <= _EXACT:
        return tip, tip
    end = _reach(plane, tip, sign, np.concatenate([meets, ahead]), _BESIDE)
    return (tip, end) if sign > 0 else (end, tip)


def _tip(jamb: float, sign: int, runs: Float) -> float:
    """Where the wall that is a door's jamb ends: the jamb itself where no run goes on beside the door."""
    place = jamb + sign * _JAMB
    on = runs[(runs[:, 0] <= place) & (place <= runs[:, 1])]
    return float(max(on[:, 1]) if sign > 0 else min(on[:, 0])) if len(on) else jamb


def _joined(runs: Sequence[Sequence[float]]) -> Float:
    """(K, 2) the runs in order, those that touch as one."""
    out: list[list[float]] = []
    for start, end in sorted((float(a), float(b)) for a, b in runs):
        if out and start <= out[-1][1]:
            out[-1][1] = max(out[-1][1], end)
        else:
            out.append([start, end])
    return np.array(out, dtype=np.float64).reshape(-1, 2)


def remove_beams(
    planes: Sequence[LayoutPlane], widest_lintel: float, shallow: float, widest: float
) -> tuple[LayoutPlane, ...]:
    """Cut from the wall runs what is a beam under the ceiling: it spans from one crossing wall to another.

    A lintel rests on wall that ends beside the opening; a beam rests on walls that go on in front of and
    behind it, or on nothing that stands in its own plane. Only gaps wider than ``widest_lintel`` (metres) are
    judged; up to ``widest`` one jamb is enough where the other end is a corner, or a wall that goes on while
    the surface above is at least ``shallow`` metres deep.
    """
    crossing = {axis: crossing_walls(planes, axis) for axis in (0, 1)}
    out = []
    for plane in planes:
        others = crossing[1 - plane.facing.axis]
        meets, past = crossing_offsets(plane, others), passing_offsets(plane, others)
        wide = [span for span in _open_spans(plane) if span[1] - span[0] > widest_lintel]
        beams = [span for span in wide if _is_beam(span, plane, meets, past, shallow, widest)]
        out.append(replace(plane, walls=_without(plane.walls, beams)) if beams else plane)
    return tuple(out)


def _open_spans(plane: LayoutPlane) -> list[tuple[float, float]]:
    """Stretches with nothing below 2 m, from where free space was first seen to pass to where it was last."""
    profile = plane.profile
    if profile is None:
        return []
    spans = []
    for a, b in runs_of(~is_solid(profile)).tolist():
        if (b - a) * profile.step <= _PASSED:
            continue
        passed = a + np.flatnonzero(profile.through[a:b] > 0.3)
        if len(passed) * profile.step > _PASSED:
            ends = profile.start + profile.step * np.array([passed[0], passed[-1] + 1])
            spans.append((float(ends[0]), float(ends[1])))
    return spans


def _is_beam(
    span: tuple[float, float], plane: LayoutPlane, meets: Float, past: Float, shallow: float, widest: float
) -> bool:
    """True where the span rests on crossing walls, or on nothing in its own plane.

    :param meets: (M,) where walls cross the plane; ``past``: (P,) those of them that go on on both sides.
    """
    ends = list(zip(span, (-1, 1), strict=True))
    open_ends = [(end, sign) for end, sign in ends if not _has_jamb(end, sign, plane, meets, past)]
    if len(open_ends) != 1 or span[1] - span[0] > widest:
        return len(open_ends) > 0
    end, _ = open_ends[0]
    if _is_near(end, past, _TOUCH):
        return _depth(span, plane) < shallow
    return not _is_near(end, meets, _CORNERED)


def _is_near(end: float, crossing: Float, reach: float) -> bool:
    return bool(len(crossing)) and float(np.abs(crossing - end).min()) < reach


def _has_jamb(end: float, sign: int, plane: LayoutPlane, meets: Float, past: Float) -> bool:
    """True where wall stands in the plane beside the end of a span, before any wall that goes on past it.

    Beside a corner a stub is enough.
    """
    profile = plane.profile
    assert profile is not None
    ahead = (past - end) * sign
    stop = float(ahead[ahead >= -_TOUCH].min(initial=np.inf))
    hidden = min(_unseen(profile, end, sign), max(stop, 0.0))
    end, stop = end + sign * hidden, stop - hidden
    reach = min(_FLANK, max(stop, 0.0))
    a, b = sorted(round((v - profile.start) / profile.step) for v in (end, end + sign * reach))
    stands = int((profile.low[max(a, 0) : b] >= _SOLID).sum()) * profile.step
    return stands > (_STUB if _is_near(end, meets, _CORNERED) else _STANDS) - profile.step / 2


def _unseen(profile: WallProfile, end: float, sign: int) -> float:
    """Metres from ``end`` to the first wall, where nothing was seen before it: a jamb may be hidden."""
    first, many = (round(v / profile.step) for v in (end - profile.start, _HIDDEN))
    solid = is_solid(profile)
    ahead = (
        solid[first : first + many + 1] if sign > 0 else solid[max(first - many - 1, 0) : max(first, 0)][::-1]
    )
    return int(ahead.argmax()) * profile.step if ahead.any() else 0.0


def _depth(span: tuple[float, float], plane: LayoutPlane) -> float:
    """Metres of surface above 2 m along most of a span."""
    profile = plane.profile
    assert profile is not None
    a, b = (round((v - profile.start) / profile.step) for v in span)
    return float(np.median(profile.high[a:b])) if b > a else 0.0


def _without(runs: Float, spans: list[tuple[float, float]]) -> Float:
    """The runs (K, 2) less the spans."""
    pieces = [(float(s), float(e)) for s, e in runs]
    for low, high in spans:
        pieces = [p for s, e in pieces for p in ((s, min(e, low)), (max(s, high), e)) if p[1] - p[0] > 0.05]
    return np.array(pieces, dtype=np.float64).reshape(-1, 2)


def _reach(plane: LayoutPlane, end: float, sign: int, meets: Float, farthest: float = _CORNER) -> float:
    """The end of a run, moved to the nearest crossing wall ahead unless free space passes between."""
    ahead = (meets - end) * sign
    ahead = ahead[(ahead > 0) & (ahead <= farthest)]
    if len(ahead) == 0 or plane.profile is None:
        return end
    target = end + sign * float(ahead.min())
    a, b = sorted(round((v - plane.profile.start) / plane.profile.step) for v in (end, target))
    through = plane.profile.through[max(a, 0) : b]
    return end if len(through) and float((through > 0.15).mean()) > 0.3 else target


def _carried(plane: LayoutPlane, end: float, sign: int, meets: Float, widest: float) -> float:
    """The end of a run, moved along a lintel to the crossing wall whose corner hides the lintel's jamb."""
    ahead = (meets - end) * sign
    ahead = ahead[(ahead > _HIDDEN) & (ahead <= widest)]
    profile = plane.profile
    if len(ahead) == 0 or profile is None:
        return end
    target = end + sign * float(ahead.min())
    a, b = sorted(round((v - profile.start) / profile.step) for v in (end, target))
    order = slice(max(a, 0), b)
    passed, above = profile.through[order][::sign] > _FREE_SHARE, profile.high[order][::sign] > 0
    seen = np.flatnonzero(passed)
    if len(seen) * profile.step < _PASSED:
        return end
    last = int(seen[-1]) + 1
    hidden = (len(passed) - last) * profile.step
    if not _STUB < hidden <= _HIDDEN or above[last:].any() or profile.low[order][::sign][last:].any():
        return end
    return target if float(above[:last].mean()) >= _LINTEL_SHARE else end


def blockers(planes: Sequence[LayoutPlane], doors: Sequence[Door]) -> Float:
    """(B, 4) x0, y0, x1, y1: wall runs as lines, doors as boxes between the faces of their wall. Metres."""
    rows = [(p.facing.axis, p.offset, p.offset, s, e) for p in planes for s, e in p.walls]
    rows += [(d.axis, d.offset - d.thickness / 2, d.offset + d.thickness / 2, d.start, d.end) for d in doors]
    return np.array([(u0, v0, u1, v1) if a == 0 else (v0, u0, v1, u1) for a, u0, u1, v0, v1 in rows]).reshape(
        -1, 4
    )

"""Apertures in a wall (paper, section "Door Detection"): histogram along the plane, gradient, matched filter.

In: a plane's profile, its wall runs and where walls cross it. Out: intervals along it that may be openings.
The points of a plane, cropped at 2 m, make a histogram along it; its smoothed gradient falls where an
opening begins and rises where it ends; the matched filter answers to a fall and a rise one aperture apart.
Two kinds have no such pair of steps: openings wider than the filter, under a lintel, and openings in a
corner, where a crossing wall is the second jamb.
Cost: linear in the length of the planes times the number of widths.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.geometry.runs import runs_of
from floorplan_core.model import WallProfile
from floorplan_core.stages.layout_planes import is_solid

Float = NDArray[np.float64]
_NOWHERE: Float = np.zeros(0)
Aperture = tuple[float, float, float]  # start, end (metres along the plane), response

_BARE_CORNER = 1.0  # m, widest corner opening without a lintel that is still a door
_LINTELS = (
    0.003  # of the wall seen below 2 m: 0.06 % at most in lifted planar scans, 0.9 % at least in 3-D ones
)
_CORNER_PASSAGE = 0.45  # m of a corner opening through which free space must be seen
_CORNER_LINTEL = 0.3  # of the width of a corner opening that must be seen under a lintel
_SPANNED = 0.8  # share of a wide corner opening that must be under a lintel, passed, and empty
_CORNER_RESPONSE = 0.5  # there is one step instead of two
_FREE = 0.3  # share of the height of a door that is free where it is open
_FREE_WITHIN = 0.4  # the same within the wall, where it is open by that alone
_FREE_RESPONSE = 0.3  # there is no clear step
_CELL = 0.1  # m: free space is known by cells of this size, and the outermost ones hold the jambs
_JAMB = 0.3  # m, the widest stub of wall between a door and the corner that nobody may have seen
_AT = 0.1  # m from the end of a run to the wall that it ends at
_STUB = 0.15  # m, the same where free space does not tell: a voxel and a half
_PIECE = 0.25  # m, the shortest piece of wall at which a door may begin
_OFF_APERTURE = 0.01  # of the answer, a metre off the aperture that the filter is matched to: ties go to it
_PARAPET = 0.3  # of the height below 2 m, seen all along an aperture: something stands in it


@dataclass(frozen=True)
class DoorResponse:
    """The three signals of the paper along one plane, for the evidence pane; all (B,)."""

    histogram: Float  # 0 to 1: share of the wall height below 2 m that was seen
    gradient: Float  # its derivative, smoothed; 1 at a clean step
    response: Float  # best answer of the matched filter for an aperture that starts here
    width: Float  # metres, the aperture of that answer


def shows_lintels(profiles: Sequence[WallProfile]) -> bool:
    """True where wall is seen above 2 m and none below, often enough to be no accident."""
    lintel = sum(int(((p.high > 0) & (p.low == 0)).sum()) for p in profiles)
    return lintel > _LINTELS * sum(int((p.low > 0).sum()) for p in profiles)


def has_parapet(profile: WallProfile, start: float, end: float, footless: bool = False) -> bool:
    """True where wall was seen along the whole aperture: a window or a hatch, not a door.

    :param footless: nothing was seen free near the floor; wall along most of the aperture tells then.
    """
    a, b = (round((v - profile.start) / profile.step) for v in (start, end))
    inside = profile.low[a + 2 : b - 2]
    return len(inside) > 0 and percentile(inside, 50 if footless else 25) > _PARAPET


def percentile(values: Float, q: float) -> float:
    """``np.percentile`` of a short array, to the bit, at a tenth of its cost: it is asked for every plane."""
    ordered = np.sort(values)
    at = (len(ordered) - 1) * q / 100
    low, share = int(at), at - int(at)
    a, b = float(ordered[low]), float(ordered[min(low + 1, len(ordered) - 1)])
    return a + (b - a) * share if share < 0.5 else b - (b - a) * (1 - share)


def door_response(profile: WallProfile, config: DoorsConfig) -> DoorResponse:
    """Histogram, smoothed gradient and matched filter of one plane."""
    seen = profile.low[profile.low > 0]
    full = percentile(seen, 60) if len(seen) else 1.0
    histogram = np.minimum(profile.low / max(full, 1e-9), 1.0)
    sigma = max(config.smoothing / profile.step, 0.5)
    reach = max(2, round(4 * sigma))
    x = np.arange(-reach, reach + 1, dtype=np.float64)
    kernel = -x * np.exp(-0.5 * (x / sigma) ** 2)
    kernel /= kernel[x < 0].sum()  # so that a step from 0 to 1 peaks at 1
    gradient = np.convolve(histogram, kernel, mode="same")
    best, width = np.zeros(len(histogram)), np.zeros(len(histogram))
    inside = np.concatenate([[0.0], np.cumsum(histogram)])
    least, most = (round(v / profile.step) for v in (config.min_width, config.max_width))
    _match(gradient, inside, profile.step, least, most, config.aperture, best, width)
    return DoorResponse(histogram, gradient, best, width)


@njit(cache=True, nogil=True)
def _match(gradient, inside, step, least, most, aperture, best, width):  # type: ignore[no-untyped-def]
    """Put the best answer of the filter at every bin into ``best``, and its aperture into ``width``.

    ``inside`` (B + 1,) sums the histogram; apertures have ``least`` to ``most`` bins, the first wins ties.
    """
    for bins in range(least, min(most + 1, len(best))):
        penalty = _OFF_APERTURE * abs(bins * step - aperture)
        for k in range(len(best) - bins):
            empty = 1.0 - (inside[k + bins] - inside[k]) / bins
            answer = min(-gradient[k], gradient[k + bins]) * empty - penalty
            if answer > best[k]:
                best[k], width[k] = answer, bins * step


def apertures(
    profile: WallProfile,
    free: Float,
    walls: Float,
    meets: Float,
    config: DoorsConfig,
    lintels: bool = True,
    past: Float = _NOWHERE,
) -> list[Aperture]:
    """(start, end, response) of the openings in one plane: peaks of the filter, gaps under lintels, corners.

    :param lintels: the survey shows any.
    :param free: (B,) 0 to 1, how much of the height of a door is free within the wall.
    :param walls: (K, 2) the plane's wall runs; ``meets``: (M,) where walls cross the plane, ``past``: (P,)
        where they go on before and behind it. Metres along it.
    """
    signal = door_response(profile, config)
    out: list[Aperture] = []
    taken = np.zeros(len(signal.response), dtype=bool)
    for k in np.argsort(-signal.response, kind="stable"):
        if signal.response[k] < config.min_response:
            break
        end = k + round(signal.width[k] / profile.step)
        if not taken[k:end].any():
            first, last = _widen(profile, int(k), int(end), config)
            taken[max(0, first - 1) : last + 1] = True
            out.append((*_edges(profile, first, last), float(signal.response[k])))
    for gap in (
        *_corner_gaps(profile, free, walls, meets, past, config, lintels),
        *_lintel_gaps(profile, free, walls, config),
        *_free_gaps(profile, free, config),
        *_wide_corner_gaps(profile, free, walls, meets, config),
    ):
        if not _overlaps(gap, out):
            out.append(gap)
    return out


def _corner_gaps(
    profile: WallProfile,
    free: Float,
    walls: Float,
    meets: Float,
    past: Float,
    config: DoorsConfig,
    lintels: bool,
) -> list[Aperture]:
    """Openings between the end of a piece of wall and a crossing wall: one of their jambs is in the plane.

    Under a lintel the wall goes on above; where a wall ends, and where the survey shows no lintel anywhere, a
    narrow gap is a door without one, a wide one rather a passage past the wall's end. Where it ends at a wall
    that goes on past it, it has no end of its own: the gap is as wide as the corridor that runs by.
    """
    most = config.max_width
    ends = [
        gap
        for edge in _edges_of(walls)
        if not _is_at(edge[0], past)
        and (gap := _corner_gap(profile, free, *edge, meets, most))
        and _passed(profile, gap) >= _CORNER_PASSAGE
    ]
    under = [_corner_gap(profile, free, *edge, meets, most + _JAMB) for edge in _edges_of(_pieces(profile))]
    widest = most if lintels else min(_BARE_CORNER, most)
    ends += [gap for gap in under if gap and _lintel_share(profile, gap) >= _CORNER_LINTEL]
    return [gap for gap in ends if config.min_width <= gap[1] - gap[0] <= widest]


def _wide_corner_gaps(
    profile: WallProfile, free: Float, walls: Float, meets: Float, config: DoorsConfig
) -> list[Aperture]:
    """The same wider than a door, where a lintel spans them and nothing else shows their edges better."""
    least, most = config.max_width, config.max_opening
    edges = _edges_of(_pieces(profile))
    gaps = [_corner_gap(profile, free, *edge, meets, most + _JAMB) for edge in edges]
    return [
        gap
        for gap in gaps
        if gap and least < gap[1] - gap[0] <= most and _spanned(profile, walls, gap, config.max_beamless)
    ]


def _spanned(profile: WallProfile, walls: Float, gap: Aperture, beamless: float) -> bool:
    """True where a lintel that is no beam spans an aperture, free space passes it, nothing stands in it.

    :param beamless: metres; what is wider and a beam was cut out of the runs.
    """
    common = np.minimum(walls[:, 1], gap[1]) - np.maximum(walls[:, 0], gap[0])
    reaches = (walls[:, 0] < gap[0] + _JAMB) & (gap[1] - _JAMB < walls[:, 1])
    covered = reaches | (common >= _SPANNED * (gap[1] - gap[0]))
    if gap[1] - gap[0] > beamless and not covered.any():
        return False
    a, b = (round((v - profile.start) / profile.step) for v in gap[:2])
    empty = 1.0 - float(is_solid(profile)[a:b].mean())
    passed = _passed(profile, gap) / (gap[1] - gap[0])
    return min(empty, passed, _lintel_share(profile, gap)) >= _SPANNED


def _is_at(edge: float, crossing: Float) -> bool:
    """True where one of the crossing walls stands at the end of a run."""
    return bool(len(crossing)) and float(np.abs(crossing - edge).min()) < _AT


def _edges_of(runs: Float) -> list[tuple[float, int]]:
    """Both ends of each run with the direction in which it ends."""
    return [(v, sign) for run in runs.tolist() for v, sign in zip(run, (-1, 1), strict=True)]


def _passed(profile: WallProfile, gap: Aperture) -> float:
    """Metres of an aperture through which free space reaches."""
    a, b = (round((v - profile.start) / profile.step) for v in gap[:2])
    return float((profile.through[a:b] > _FREE).sum()) * profile.step


def _lintel_share(profile: WallProfile, gap: Aperture) -> float:
    """0 to 1: share of an aperture above which wall was seen."""
    a, b = (round((v - profile.start) / profile.step) for v in gap[:2])
    return float((profile.high[a:b] > 0).mean()) if b > a else 0.0


def _pieces(profile: WallProfile) -> Float:
    """(K, 2) pieces of wall that stand on the floor, metres along the plane."""
    ends = runs_of(is_solid(profile)).astype(np.float64)
    return profile.start + profile.step * ends[(ends[:, 1] - ends[:, 0]) * profile.step >= _PIECE]


def _corner_gap(
    profile: WallProfile, free: Float, edge: float, sign: int, meets: Float, farthest: float
) -> Aperture | None:
    """The opening from ``edge`` to the crossing wall ahead, or to where free space ends before it.

    :param farthest: metres to the crossing wall.
    """
    distance = (meets - edge) * sign
    ahead = float(distance[distance > _JAMB].min(initial=np.inf))
    if ahead > farthest:
        return None
    low, high = sorted((edge, edge + sign * ahead))
    a, b = (round((v - profile.start) / profile.step) for v in (low, high))
    open_ = np.flatnonzero(free[a:b] > _FREE)
    if len(open_) * profile.step < _CORNER_PASSAGE:
        return None
    first, last = profile.start + profile.step * (a + np.array([open_[0], open_[-1] + 1.0]))
    # Where the far jamb is hidden, keep to what was seen to pass; the near one is where the wall ends.
    before, after = (_JAMB, _STUB) if sign > 0 else (_STUB, _JAMB)
    return (
        low if first - low <= before else float(first),
        high if high - last <= after else float(last),
        _CORNER_RESPONSE,
    )


def _widen(profile: WallProfile, first: int, last: int, config: DoorsConfig) -> tuple[int, int]:
    """The whole opening around an aperture: double doors are wider than the filter."""
    most = round((config.max_opening - (last - first) * profile.step) / profile.step)
    empty = ~is_solid(profile) & (profile.through > 0.3)
    a, b = first, last
    while a > max(0, first - most) and empty[a - 1]:
        a -= 1
    while b < min(len(empty), last + most) and empty[b]:
        b += 1
    return (a, b) if (b - a) * profile.step <= config.max_opening else (first, last)


def _edges(profile: WallProfile, first: int, last: int) -> tuple[float, float]:
    """Where the histogram crosses half its height around the two steps: finer than a bin."""

    def crossing(k: int, sign: int) -> float:
        low, high = max(0, k - 3), min(len(profile.low), k + 4)
        h = profile.low[low:high]
        top = h.max()
        if top <= 0:
            return profile.start + k * profile.step
        filled = float(np.minimum(h / top, 1.0).sum())
        return profile.start + (low + filled if sign > 0 else high - filled) * profile.step

    return crossing(first, 1), crossing(last, -1)


def _lintel_gaps(profile: WallProfile, free: Float, walls: Float, config: DoorsConfig) -> list[Aperture]:
    """Openings that lie inside a wall run: nothing below 2 m, wall above, free space in them or through."""
    passed = np.maximum(profile.through, free)
    most = config.max_opening + 2 * _JAMB + profile.step  # a stub at each end may go
    gaps = (
        _seen_part(passed, i, j, profile.step)
        for i, j in runs_of(~is_solid(profile)).tolist()
        if config.min_width <= (j - i) * profile.step <= most
    )
    empty = [
        (i, j)
        for i, j in gaps
        if config.min_width <= (j - i) * profile.step <= config.max_opening and passed[i:j].mean() > _FREE
    ]
    out = []
    for wall in walls.tolist() if empty else []:
        a, b = (round((v - profile.start) / profile.step) for v in wall)
        for i, j in empty:
            lintel = float((profile.high[i:j] > 0).mean())
            if a < i and j < b and lintel >= _CORNER_LINTEL:
                out.append((*_edges(profile, i, j), lintel))
    return out


def _seen_part(passed: Float, i: int, j: int, step: float) -> tuple[int, int]:
    """The bins i to j without a stub of wall at one of their ends that nobody saw."""
    seen = i + np.flatnonzero(passed[i:j] > _FREE)
    if not len(seen):
        return i, j
    first, last = int(seen[0]), int(seen[-1]) + 1
    return (first if 0 < (first - i) * step <= _JAMB else i), (last if 0 < (j - last) * step <= _JAMB else j)


def _free_gaps(profile: WallProfile, free: Float, config: DoorsConfig) -> list[Aperture]:
    """Where free space reaches into the wall under a lintel, though points float in the opening.

    Range sensors mix what lies before and behind an edge; seen at a slant such points fill a door in the
    histogram.
    """
    out = []
    for i, j in runs_of(free > _FREE_WITHIN).tolist():
        gap = profile.start + profile.step * i, profile.start + profile.step * j, _FREE_RESPONSE
        narrow = gap[1] - gap[0] < config.min_width - 1.5 * _CELL
        if (
            not narrow
            and gap[1] - gap[0] <= config.max_width
            and _lintel_share(profile, gap) >= _CORNER_LINTEL
        ):
            out.append(gap)
    return out


def _overlaps(gap: Aperture, others: list[Aperture]) -> bool:
    return any(min(gap[1], o[1]) - max(gap[0], o[0]) > 0.3 * (o[1] - o[0]) for o in others)

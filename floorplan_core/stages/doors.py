"""Doors (paper, section "Door Detection"): histogram along the plane, smoothed gradient, matched filter.

In: planes with their profiles, the voxel columns and the path. Out: doors, children of one or two planes.
The points of a plane, cropped at 2 m, make a histogram along it; its smoothed gradient falls where an
opening begins and rises where it ends; the matched filter answers to a fall and a rise one aperture apart.
An aperture alone may be a gap in the data, so each candidate is then weighed by all other evidence: free
space or the sensor's path through it, wall on both sides, a lintel above, the same opening in the wall's
other face.
Cost: linear in the length of the planes times the number of widths.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, LayoutPlane, WallProfile
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.blockers import crossing_offsets, crossing_walls
from floorplan_core.stages.door_edges import refine_edges
from floorplan_core.stages.layout_planes import is_solid

Float = NDArray[np.float64]

_BARE_CORNER = 1.0  # m, widest corner opening without a lintel that is still a door
_LINTELS = (
    0.015  # of the wall seen below 2 m: 0.7 % at most in lifted planar scans, 2.7 % at least in 3-D ones
)
_CORNER_PASSAGE = 0.45  # m of a corner opening through which free space must be seen
_FLANK = 0.5  # m beside an aperture in which wall is looked for
_OFF_APERTURE = 0.01  # of the answer, a metre off the aperture that the filter is matched to: ties go to it
_PARAPET = 0.3  # of the height below 2 m, seen all along an aperture: something stands in it
_UNSEEN = 0.3  # most that an opening can earn through which nothing was seen to pass
_WEIGHTS = {
    "passage": 0.3,
    "path": 0.35,
    "lintel": 0.2,
    "wall on both sides": 0.15,
    "both faces": 0.15,
    "corner": 0.1,
}


@dataclass(frozen=True)
class DoorResponse:
    """The three signals of the paper along one plane, for the evidence pane; all (B,)."""

    histogram: Float  # 0 to 1: share of the wall height below 2 m that was seen
    gradient: Float  # its derivative, smoothed; 1 at a clean step
    response: Float  # best answer of the matched filter for an aperture that starts here
    width: Float  # metres, the aperture of that answer


def find_doors(planes: tuple[LayoutPlane, ...], evidence: Evidence, config: DoorsConfig) -> tuple[Door, ...]:
    """All doors and openings under a lintel, by axis, offset and start."""
    found: list[Door] = []
    crossing = {a: crossing_walls(planes, a) for a in (0, 1)}
    # Where the survey shows no lintel anywhere, a wide gap at a corner is rather a passage past a wall's end.
    widest = np.inf if _shows_lintels([p.profile for p in planes if p.profile]) else _BARE_CORNER
    for plane in planes:
        assert plane.profile is not None
        meets = crossing_offsets(plane, crossing[1 - plane.facing.axis])
        for start, end, response in apertures(plane.profile, plane.walls, meets, config, widest):
            if not _has_parapet(plane.profile, start, end):
                found.append(_weigh(plane, start, end, response, evidence, config))
    merged = [_kind(d, config) for d in refine_edges(_merge_faces(found, planes, config), planes, evidence)]
    kept = sorted(
        (d for d in merged if d.confidence >= config.min_confidence),
        key=lambda d: (d.axis, d.offset, d.start),
    )
    return tuple(replace(door, id=f"d{k + 1}") for k, door in enumerate(kept))


def _shows_lintels(profiles: Sequence[WallProfile]) -> bool:
    """True where wall is seen above 2 m and none below, often enough to be no accident."""
    lintel = sum(int(((p.high > 0) & (p.low == 0)).sum()) for p in profiles)
    return lintel > _LINTELS * sum(int((p.low > 0).sum()) for p in profiles)


def _has_parapet(profile: WallProfile, start: float, end: float) -> bool:
    """True where wall was seen along the whole aperture: a window or a hatch, not a door."""
    a, b = (round((v - profile.start) / profile.step) for v in (start, end))
    inside = profile.low[a + 2 : b - 2]
    return len(inside) > 0 and float(np.percentile(inside, 25)) > _PARAPET


def door_response(profile: WallProfile, config: DoorsConfig) -> DoorResponse:
    """Histogram, smoothed gradient and matched filter of one plane."""
    seen = profile.low[profile.low > 0]
    full = float(np.percentile(seen, 60)) if len(seen) else 1.0
    histogram = np.minimum(profile.low / max(full, 1e-9), 1.0)
    sigma = max(config.smoothing / profile.step, 0.5)
    reach = max(2, round(4 * sigma))
    x = np.arange(-reach, reach + 1, dtype=np.float64)
    kernel = -x * np.exp(-0.5 * (x / sigma) ** 2)
    kernel /= kernel[x < 0].sum()  # so that a step from 0 to 1 peaks at 1
    gradient = np.convolve(histogram, kernel, mode="same")
    best, width = np.zeros(len(histogram)), np.zeros(len(histogram))
    inside = np.concatenate([[0.0], np.cumsum(histogram)])
    for bins in range(round(config.min_width / profile.step), round(config.max_width / profile.step) + 1):
        if bins >= len(histogram):
            break
        fall, rise = -gradient[:-bins], gradient[bins:]
        empty = 1.0 - (inside[bins:-1] - inside[: -bins - 1]) / bins
        answer = np.minimum(fall, rise) * empty
        answer = answer - _OFF_APERTURE * abs(bins * profile.step - config.aperture)
        better = answer > best[:-bins]
        best[:-bins][better] = answer[better]
        width[:-bins][better] = bins * profile.step
    return DoorResponse(histogram, gradient, best, width)


def apertures(
    profile: WallProfile, walls: Float, meets: Float, config: DoorsConfig, widest_corner: float = np.inf
) -> list[tuple[float, float, float]]:
    """(start, end, response) of the openings in one plane: peaks of the filter, gaps under lintels, corners.

    :param walls: (K, 2) the plane's wall runs; ``meets``: (M,) where walls cross the plane. Metres along it.
    """
    signal = door_response(profile, config)
    out: list[tuple[float, float, float]] = []
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
        *_lintel_gaps(profile, walls, config),
        *_corner_gaps(profile, walls, meets, config, widest_corner),
    ):
        if not _overlaps(gap, out):
            out.append(gap)
    return out


def _corner_gaps(
    profile: WallProfile, walls: Float, meets: Float, config: DoorsConfig, widest: float
) -> list[tuple[float, float, float]]:
    """Openings between the end of a wall run and a crossing wall: only one of their sides is in the plane."""
    out = []
    for start, end in walls:
        for edge, sign in ((start, -1), (end, 1)):
            ahead = (meets - edge) * sign
            ahead = ahead[ahead > 0.3]
            if len(ahead) == 0 or not config.min_width <= ahead.min() <= config.max_width:
                continue
            low, high = sorted((float(edge), float(edge + sign * ahead.min())))
            a, b = (round((v - profile.start) / profile.step) for v in (low, high))
            if high - low > widest:
                continue
            open_ = np.flatnonzero(profile.through[a:b] > 0.3)
            if len(open_) * profile.step >= _CORNER_PASSAGE:
                unseen = len(open_) < 0.5 * (b - a)  # the far jamb is hidden: keep to what was seen to pass
                ends = profile.start + profile.step * (a + np.array([open_[0], open_[-1] + 1]))
                out.append((float(ends[0]), float(ends[1]), 0.5) if unseen else (low, high, 0.5))
    return out


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


def _lintel_gaps(profile: WallProfile, walls: Float, config: DoorsConfig) -> list[tuple[float, float, float]]:
    """Openings that lie inside a wall run: nothing below 2 m, wall above, free space through."""
    out = []
    for start, end in walls:
        a, b = (round((v - profile.start) / profile.step) for v in (start, end))
        empty = ~is_solid(profile)[a:b]
        for i, j in np.flatnonzero(
            np.diff(np.concatenate([[False], empty, [False]]).astype(np.int8))
        ).reshape(-1, 2):
            i, j = i + a, j + a
            width = (j - i) * profile.step
            if not config.min_width <= width <= config.max_opening or i == a or j == b:
                continue
            if profile.through[i:j].mean() > 0.3:
                out.append((*_edges(profile, int(i), int(j)), float((profile.high[i:j] > 0).mean())))
    return out


def _kind(door: Door, config: DoorsConfig) -> Door:
    """A door, or an opening where it is wider."""
    return replace(door, kind="opening" if door.width > config.max_width else "door")


def _overlaps(gap: tuple[float, float, float], others: list[tuple[float, float, float]]) -> bool:
    return any(min(gap[1], o[1]) - max(gap[0], o[0]) > 0.3 * (o[1] - o[0]) for o in others)


def _weigh(
    plane: LayoutPlane, start: float, end: float, response: float, evidence: Evidence, config: DoorsConfig
) -> Door:
    """A candidate with its evidence; the other face is added when faces are merged."""
    profile = plane.profile
    assert profile is not None
    a, b = (round((v - profile.start) / profile.step) for v in (start, end))
    inner = slice(a + 1, max(b - 1, a + 2))
    flank = round(_FLANK / profile.step)
    left, right = profile.low[max(0, a - flank) : a], profile.low[b : b + flank]
    words = []
    if float((profile.through[inner] > 0.4).mean()) > 0.4:
        words.append("passage")
    if _path_crosses(plane, start, end, evidence):
        words.append("path")
    if float((profile.high[inner] > 0).mean()) > 0.5:
        words.append("lintel")
    if min((left > 0.2).sum(), (right > 0.2).sum()) * profile.step >= 0.25:
        words.append("wall on both sides")
    elif max((left > 0.2).sum(), (right > 0.2).sum()) * profile.step >= 0.25:
        words.append("corner")
    return Door(
        id="",
        planes=(plane.id,),
        axis=plane.facing.axis,
        offset=plane.offset,
        start=start,
        end=end,
        evidence=tuple(words),
        confidence=_confidence(words, response),
        height=None,
    )


def _confidence(words: Sequence[str], response: float) -> float:
    """Sum of the evidence; an aperture through which nothing was seen to pass is a gap or a shut door."""
    total = 0.1 * min(response, 1.0) + sum(_WEIGHTS.get(w, 0.0) for w in words)
    if "passage" not in words and "path" not in words:
        total = min(total, _UNSEEN)
    return round(min(1.0, total), 3)


def _path_crosses(plane: LayoutPlane, start: float, end: float, evidence: Evidence) -> bool:
    """True where the sensor itself went through the aperture."""
    a = plane.facing.axis
    u, v = evidence.path[:, a] - plane.offset, evidence.path[:, 1 - a]
    if len(u) < 2:
        return False
    k = np.flatnonzero(u[:-1] * u[1:] < 0)
    step = np.hypot(u[k + 1] - u[k], v[k + 1] - v[k])
    at = v[k] + (v[k + 1] - v[k]) * u[k] / (u[k] - u[k + 1])
    return bool(((at > start) & (at < end) & (step < 2.0)).any())


def _merge_faces(found: list[Door], planes: tuple[LayoutPlane, ...], config: DoorsConfig) -> list[Door]:
    """One door for the two faces of a wall, and for two planes of one face."""
    facing = {p.id: p.facing for p in planes}
    out: list[Door] = []
    for door in sorted(found, key=lambda d: (-d.confidence, d.axis, d.offset, d.start)):
        for k, other in enumerate(out):
            if _same_opening(door, other, config):
                both = facing[door.planes[0]] != facing[other.planes[0]]
                out[k] = _merged(other, door, both)
                break
        else:
            out.append(door)
    return out


def _same_opening(a: Door, b: Door, config: DoorsConfig) -> bool:
    overlap = min(a.end, b.end) - max(a.start, b.start)
    near = abs(a.offset - b.offset) <= config.max_thickness
    return a.axis == b.axis and near and overlap > 0.5 * min(a.width, b.width)


def _merged(sure: Door, other: Door, both_faces: bool) -> Door:
    words = tuple(dict.fromkeys([*sure.evidence, *other.evidence, *(["both faces"] if both_faces else [])]))
    confidence = _confidence(words, 1.0)
    if not both_faces:
        return replace(sure, planes=(*sure.planes, *other.planes), evidence=words, confidence=confidence)
    return replace(
        sure,
        planes=(*sure.planes, *other.planes),
        offset=(sure.offset + other.offset) / 2,
        thickness=max(sure.thickness, abs(sure.offset - other.offset)),
        confidence=confidence,
        start=(sure.start + other.start) / 2,
        end=(sure.end + other.end) / 2,
        evidence=tuple(words),
    )

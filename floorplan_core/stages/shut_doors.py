"""Shut doors: leaves that stand back from the face of their wall, under its lintel and between its jambs.

In: planes, the voxel columns and the surfels. Out: doors that are shut. Nothing passes a shut door, so the
aperture detectors see wall; but a leaf is thinner than its wall and set back from one of its faces, by 3 cm
and more. That is less than the noise of many sensors, so the depth is the median of all surfels over the
height of a leaf, bin by bin along the wall. A recess is told from the wall's other face, seen through a gap
in the data, by the side from which its points were seen; from a window by standing back down to the floor;
from a set-back wall by width and lintel. Without viewpoints nothing can be said. Cost: one pass over the
surfels.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.geometry.boxes import index_boxes
from floorplan_core.geometry.depth_medians import Faces, median_depths
from floorplan_core.geometry.runs import runs_of
from floorplan_core.model import Door, Facing, LayoutPlane
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.blockers import crossing_walls
from floorplan_core.stages.door_evidence import far_walls, goes_on

Float = NDArray[np.float64]

_LEAF = (0.3, 1.8)  # m above the floor, where a leaf and no lintel is
_LOW = (0.08, 0.3)  # m above the floor, where a leaf stands back and the sill of a window does not
_LINTEL = (2.2, 2.6)  # m above the floor: above a door
_BANDS = (_LEAF, _LOW, _LINTEL)
_AT_ONCE = 1000  # walls whose surfels are held together: those of a whole site would be most of them
_DEPTH = (0.025, 0.11)  # m behind the face at which a leaf hangs; deeper are panes, but in inner walls
_SHIN = (0.3, 0.7)  # m above the floor: below the sill of most windows
_BOARD, _INNER = 0.03, 0.25  # m, thickness of a leaf, and of the inner walls that hold one
_ALONG, _FACE = (
    4.0,
    1.0,
)  # m along a wall within which that much of its other face tells that it is an inner one
_LEVEL, _SHARE = 0.02, 0.6  # m, and share of the leaf's depth: what lies less deep is the wall's face
_REACH = (0.08, 0.22)  # m before and behind the face whose surfels are looked at
_FLANK, _JAMB = 0.35, 0.15  # m beside the leaf in which that much wall must stand
_WIDEST = 1.8  # m, a double door
_SIDEWAYS = 0.2  # cosine of the steepest view that still tells from which side a point was seen
_FLAT = 0.012  # m, spread of a leaf's depth along it
_UNDER = 0.5  # share of its width over which the lintel was seen
_UPRIGHT = 0.5  # of its lower part as deep as the leaf: doors from 0.67, a pane above its frame 0.35
_ENOUGH = 4  # surfels whose median is believed
_SEEN = 3  # bins of its lower part that must have been seen
CONFIDENCE = 0.9
WORDS = ("shut", "recess", "lintel", "wall on both sides")


@dataclass(frozen=True)
class DepthProfile:
    """How deep behind a plane the surfaces lie, in bins along it; all (B,) metres, NaN where too few."""

    start: float  # metres along the plane
    step: float  # metres
    leaf: Float  # at the heights of a leaf
    low: Float  # near the floor
    lintel: Float  # above doors


def find_leaves(planes: Sequence[LayoutPlane], evidence: Evidence, config: DoorsConfig) -> list[Door]:
    """The shut doors of every plane, by plane and start; none where there are no viewpoints."""
    walls = [p for p in planes if len(p.walls)]
    if not evidence.viewpoints or not walls:
        return []
    profiles, narrowest = depth_profiles(walls, evidence), config.min_width
    of = {facing: [p for p in planes if p.facing == facing] for facing in Facing}
    alike = {facing: crossing_walls(of[facing], facing.axis) for facing in Facing}
    deep = [
        _inner_recesses(w, p, of[w.facing.opposite], alike[w.facing], narrowest)
        for w, p in zip(walls, profiles, strict=True)
    ]
    known = [recesses(profile, narrowest) for profile in profiles]
    unsure = [k for k in range(len(walls)) if set(deep[k]) - set(known[k])]
    for k, shin in zip(unsure, _shins([walls[k] for k in unsure], evidence), strict=True):
        low = np.where(np.isfinite(profiles[k].low), profiles[k].low, shin)
        sure = recesses(replace(profiles[k], low=low), narrowest, inner=True)
        known[k] = sorted({*known[k], *(set(deep[k]) & set(sure))})
    return [_leaf(wall, *span) for wall, spans in zip(walls, known, strict=True) for span in spans]


def _inner_recesses(
    plane: LayoutPlane,
    profile: DepthProfile,
    opposite: Sequence[LayoutPlane],
    alike: Float,
    narrowest: float,
) -> list[tuple[float, float]]:
    """Recesses in walls that are thicker, whatever was seen near the floor; windows are in outer walls.

    :param opposite: the planes of the other facing; ``alike``: (K, 3) wall runs of the plane's own facing.
    """
    found = recesses(replace(profile, low=profile.leaf), narrowest, inner=True)
    if not found:
        return []
    behind = [q for q in opposite if 0 < (plane.offset - q.offset) * plane.facing.sign <= _INNER]
    onward = far_walls(plane, alike)
    thick = [_thickness(plane, s, behind) or (_INNER if goes_on(*s, onward) else 0.0) for s in found]
    return [s for s, t in zip(found, thick, strict=True) if _depth(profile, s) + _BOARD < t]


def _depth(profile: DepthProfile, span: tuple[float, float]) -> float:
    a, b = (round((v - profile.start) / profile.step) for v in span)
    return float(np.median(profile.leaf[a:b]))


def _thickness(plane: LayoutPlane, span: tuple[float, float], behind: Sequence[LayoutPlane]) -> float:
    """Metres to the wall's other face, within a room's width of a recess; 0 where none was seen.

    :param behind: the planes that may be that face.
    """
    start, end = span[0] - _ALONG, span[1] + _ALONG
    gaps = [
        (plane.offset - q.offset) * plane.facing.sign
        for q in behind
        if float((np.minimum(q.walls[:, 1], end) - np.maximum(q.walls[:, 0], start)).max(initial=0)) > _FACE
    ]
    return max(gaps, default=0.0)


def _shins(walls: Sequence[LayoutPlane], evidence: Evidence) -> list[Float]:
    """Depths by plane just above the band near the floor, which a camera seldom sees."""
    return [of[0] for of in _depths(walls, evidence, (_SHIN,))[1]] if walls else []


def unknown_leaves(leaves: Sequence[Door], doors: Sequence[Door], config: DoorsConfig) -> list[Door]:
    """The shut doors that are none of ``doors``, each once: of two in one place the first."""
    found: list[Door] = []
    for leaf in leaves:
        if not any(_same(leaf, other, config.max_thickness) for other in (*doors, *found)):
            found.append(leaf)
    return found


def _same(a: Door, b: Door, near: float) -> bool:
    """True where two openings lie in the same wall and place."""
    shared = min(a.end, b.end) - max(a.start, b.start)
    return a.axis == b.axis and abs(a.offset - b.offset) <= near and shared > 0


def _box(plane: LayoutPlane) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 of all that lies close to the walls of a plane."""
    u0, u1 = sorted(plane.offset + plane.facing.sign * np.array([_REACH[0], -_REACH[1]]))
    v0, v1 = float(plane.walls.min()) - _FLANK, float(plane.walls.max()) + _FLANK
    return (u0, v0, u1, v1) if plane.facing.axis == 0 else (v0, u0, v1, u1)


def depth_profiles(walls: Sequence[LayoutPlane], evidence: Evidence) -> list[DepthProfile]:
    """The depths of the surfels that were seen from the side to which each plane looks, by plane."""
    found = []
    for first in range(0, len(walls), _AT_ONCE):
        starts, depths = _depths(walls[first : first + _AT_ONCE], evidence, _BANDS)
        found += [DepthProfile(a, evidence.fine, *of) for a, of in zip(starts, depths, strict=True)]
    return found


def _depths(
    walls: Sequence[LayoutPlane], evidence: Evidence, bands: Sequence[tuple[float, float]]
) -> tuple[list[float], list[Any]]:
    """Where each profile starts along its plane, and its depths in each of the bands of height."""
    starts = [float(plane.walls.min()) - _FLANK for plane in walls]
    ends = [float(plane.walls.max()) + _FLANK for plane in walls]
    faces = Faces(
        axis=np.array([plane.facing.axis for plane in walls]),
        sign=np.array([plane.facing.sign for plane in walls]),
        offset=np.array([plane.offset for plane in walls]),
        start=np.array(starts),
        bins=np.array([int((b - a) / evidence.fine) + 1 for a, b in zip(starts, ends, strict=True)]),
    )
    boxes = np.array([_box(plane) for plane in walls])
    near = index_boxes(boxes, evidence.origin, evidence.cell, evidence.shape)
    seen = (evidence.xyz, evidence.view)
    depths = median_depths(faces, near, *seen, np.array(bands), evidence.fine, _SIDEWAYS, _ENOUGH)
    return starts, list(depths)


def recesses(profile: DepthProfile, narrowest: float, inner: bool = False) -> list[tuple[float, float]]:
    """(start, end) metres along the plane where its face stands back between jambs and under a lintel.

    :param inner: for an inner wall, where a leaf may be deeper and less of the lintel seen.
    """
    back = np.nan_to_num(profile.leaf, nan=-1.0) > _DEPTH[0]
    return [
        (profile.start + profile.step * a, profile.start + profile.step * b)
        for a, b in runs_of(back).tolist()
        if narrowest - profile.step < (b - a) * profile.step <= _WIDEST and _is_leaf(profile, a, b, inner)
    ]


def _is_leaf(profile: DepthProfile, a: int, b: int, inner: bool) -> bool:
    """True where the bins from a to b are one flat board in a wall: beside, above, and down to the floor."""
    depth = float(np.median(profile.leaf[a:b]))
    if depth > (_REACH[1] if inner else _DEPTH[1]) or float(np.std(profile.leaf[a + 1 : b - 1])) > _FLAT:
        return False
    face = min(_LEVEL, _SHARE * depth)
    flank, jamb = round(_FLANK / profile.step), round(_JAMB / profile.step)
    beside = profile.leaf[max(0, a - flank) : a], profile.leaf[b : b + flank]
    if min(int((np.abs(side) < face).sum()) for side in beside) < jamb:
        return False
    above = profile.lintel[a:b]
    if inner:  # of what was seen there: the beams of a lidar seldom reach so high near by
        above, face = above[np.isfinite(above)], _LEVEL
    if not len(above) or float((np.abs(above) < face).mean()) < _UNDER:
        return False
    low = profile.low[a:b][np.isfinite(profile.low[a:b])]
    return len(low) >= _SEEN and float((np.abs(low - depth) < _LEVEL).mean()) > _UPRIGHT


def _leaf(plane: LayoutPlane, start: float, end: float) -> Door:
    return Door(
        "",
        (plane.id,),
        plane.facing.axis,
        plane.offset,
        start,
        end,
        confidence=CONFIDENCE,
        evidence=WORDS,
        shut=True,
    )

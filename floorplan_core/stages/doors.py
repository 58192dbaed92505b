"""Doors (paper, section "Door Detection"): apertures of all planes, weighed by all evidence, one a door.

In: planes with their profiles, the voxel columns and the path. Out: doors, children of one or two planes.
An aperture alone (:mod:`~floorplan_core.stages.door_apertures`) may be a gap in the data, so each is weighed
by all other evidence (:mod:`~floorplan_core.stages.door_evidence`), the same opening in the two faces of a
wall is one door, and its edges are measured on the points (:mod:`~floorplan_core.stages.door_edges`).
Cost: linear in the length of the planes times the number of widths.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from floorplan_core.config import DoorsConfig
from floorplan_core.geometry.halves import begin
from floorplan_core.model import Door, Facing, LayoutPlane
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.blockers import crossing_offsets, crossing_walls, passing_offsets, reaching_walls
from floorplan_core.stages.door_apertures import apertures, has_parapet, shows_lintels
from floorplan_core.stages.door_edges import refine_edges
from floorplan_core.stages.door_evidence import DoorMeasures, measure, view_wall
from floorplan_core.stages.shut_doors import find_leaves, unknown_leaves

_LANE = 1.0  # m, width of the lanes along walls in which openings are looked up, at the least
_PASSABLE = 0.5  # m that two faces must have in common
_BESIDE = 0.5  # m from an aperture, within which one of its planes was seen: it is cut into a wall
_REVERSED = 0.02  # m by which noise may bring the face of a wall before its other face
_FAINT = 0.4  # m2 seen of a plane: a weaker one bounds no room (as planes.min_support has it)
_FOOTLESS = 0.4  # of the area near the floor: what is free less may be a window above its sill


@dataclass(frozen=True)
class Candidate:
    """An aperture and what is known about it."""

    door: Door
    measures: DoorMeasures


def find_doors(planes: tuple[LayoutPlane, ...], evidence: Evidence, config: DoorsConfig) -> tuple[Door, ...]:
    """All doors and openings under a lintel, by axis, offset and start."""
    leaves = begin(lambda: find_leaves(planes, evidence, config))  # of all kernels here the longest
    lintels = shows_lintels([p.profile for p in planes if p.profile])
    found = find_candidates(planes, evidence, config, lintels)
    merged = merge_faces(found, planes, config, evidence.viewpoints)
    support = {p.id: p.support for p in planes}
    judged = [_judged(c, lintels, support) for c in merged]
    likely = [d for d in judged if d.confidence >= config.min_confidence]
    edged = refine_edges(likely, planes, evidence)
    kept = [_kind(d, config) for d in edged if d.width >= config.min_width]
    kept += unknown_leaves(leaves(), kept, config)
    kept.sort(key=lambda d: (d.axis, d.offset, d.start))
    return tuple(replace(door, id=f"d{k + 1}") for k, door in enumerate(kept))


def find_candidates(
    planes: Sequence[LayoutPlane], evidence: Evidence, config: DoorsConfig, lintels: bool
) -> list[Candidate]:
    """The apertures of every plane with their measures; ``lintels``: the survey shows any at all."""
    crossing = {a: crossing_walls(planes, a) for a in (0, 1)}
    # without viewpoints what is free was inferred, and tells nothing of where a wall goes on unseen; where no
    # lintel tells a doorway, one beside a corner must not be taken for the hidden end of a wall (Intel lab)
    reaching = {a: reaching_walls(planes, a) for a in (0, 1)} if evidence.viewpoints and lintels else crossing
    alike = {f: crossing_walls([p for p in planes if p.facing == f], f.axis) for f in Facing}
    found = []
    for plane in planes:
        assert plane.profile is not None
        across = 1 - plane.facing.axis
        meets = crossing_offsets(plane, reaching[across])
        past = passing_offsets(plane, crossing[across])
        view = view_wall(plane, evidence, alike[plane.facing])
        for start, end, response in apertures(
            plane.profile, view.open, plane.walls, meets, config, lintels, past
        ):
            seen = measure(plane, start, end, response, view)
            if seen.is_open() or not has_parapet(plane.profile, start, end, seen.foot < _FOOTLESS):
                found.append(_candidate(plane, start, end, seen))
    return found


def _candidate(plane: LayoutPlane, start: float, end: float, measures: DoorMeasures) -> Candidate:
    door = Door("", (plane.id,), plane.facing.axis, plane.offset, start, end, height=None)
    return Candidate(door, measures)


def _judged(candidate: Candidate, lintels: bool, support: dict[str, float]) -> Door:
    """The door with its evidence and confidence; ``support``: m2 that were seen of each plane.

    What stands beside an aperture without a lintel may be a chair: of so little surface no wall is made.
    """
    measures = candidate.measures
    words, likely = measures.words(), measures.confidence(lintels)
    if "lintel" not in words and max(support[p] for p in candidate.door.planes) < _FAINT:
        likely = measures.limited(likely, leads_on=False)
    return replace(candidate.door, evidence=words, confidence=likely)


def _kind(door: Door, config: DoorsConfig) -> Door:
    """A door, or an opening where it is wider."""
    return replace(door, kind="opening" if door.width > config.max_width else "door")


def merge_faces(
    found: Sequence[Candidate], planes: Sequence[LayoutPlane], config: DoorsConfig, viewpoints: bool = True
) -> list[Candidate]:
    """One candidate for the two faces of a wall, and for two planes of one face; the surest come first.

    Where its plane was not seen beside it, an aperture is a gap in the line of a wall that stands elsewhere:
    it only adds to another. Of two in surfaces that look at each other the first stays; which way they
    look is a guess without ``viewpoints``.
    Each is compared with those in neighbouring squares only: a site has thousands.
    """
    named = {p.id: p for p in planes}
    out: list[Candidate] = []
    squares: dict[tuple[int, int, int], list[int]] = {}
    # No opening is longer than a square, so that two that overlap lie in one, or in two side by side.
    sizes = max(_LANE, 2 * config.max_thickness), max((c.door.width for c in found), default=0.0) + _LANE

    def square(door: Door) -> tuple[int, int, int]:
        return door.axis, int(door.offset // sizes[0]), int((door.start + door.end) / 2 // sizes[1])

    for candidate in sorted(found, key=lambda c: (not _is_beside(c.door, named), *_surest_first(c))):
        door = candidate.door
        axis, lane, along = square(door)
        around = ((axis, lane + i, along + j) for i in (-1, 0, 1) for j in (-1, 0, 1))
        near = sorted(k for place in around for k in squares.get(place, ()))
        k = next((k for k in near if _same_opening(door, out[k].door, config)), len(out))
        if k == len(out):
            out.append(candidate)
        else:
            other = out[k].door
            squares[square(other)].remove(k)
            mine, *faces = (named[p] for p in (door.planes[0], *other.planes))
            if not (viewpoints and any(_look_at_each_other(mine, face) for face in faces)):
                out[k] = _merged(out[k], candidate, mine.facing != faces[0].facing, config.min_width)
        squares.setdefault(square(out[k].door), []).append(k)
    return [c for c in out if _is_beside(c.door, named)]


def _look_at_each_other(a: LayoutPlane, b: LayoutPlane) -> bool:
    return a.facing != b.facing and (b.offset - a.offset) * a.facing.sign > _REVERSED


def _is_beside(door: Door, planes: dict[str, LayoutPlane]) -> bool:
    """True where one of its planes was itself seen next to a door."""
    seen = np.concatenate([planes[p].observed for p in door.planes])
    return bool(((seen[:, 0] < door.end + _BESIDE) & (seen[:, 1] > door.start - _BESIDE)).any())


def _surest_first(candidate: Candidate) -> tuple[float, int, float, float]:
    door = candidate.door
    return -candidate.measures.confidence(True), door.axis, door.offset, door.start


def _same_opening(a: Door, b: Door, config: DoorsConfig) -> bool:
    overlap = min(a.end, b.end) - max(a.start, b.start)
    near = abs(a.offset - b.offset) <= config.max_thickness
    return a.axis == b.axis and near and overlap > 0.5 * min(a.width, b.width)


def _merged(sure: Candidate, other: Candidate, both_faces: bool, narrowest: float) -> Candidate:
    a, b = sure.door, other.door
    if a.width < narrowest <= b.width:  # part of an opening, of which more was seen in the other
        a = replace(a, start=b.start, end=b.end)
    elif b.width < narrowest <= a.width:
        b = replace(b, start=a.start, end=a.end)
    door = replace(a, planes=(*a.planes, *b.planes))
    if both_faces:
        start, end = _shared_span(a, b)
        door = replace(
            door,
            offset=(a.offset + b.offset) / 2,
            thickness=max(a.thickness, abs(a.offset - b.offset)),
            start=start,
            end=end,
        )
    return Candidate(door, sure.measures.merged(other.measures, both_faces))


def _shared_span(a: Door, b: Door) -> tuple[float, float]:
    """What is open in both faces: a face that was hidden beside the door makes its aperture too wide."""
    start, end = max(a.start, b.start), min(a.end, b.end)
    if end - start < _PASSABLE:
        return (a.start + b.start) / 2, (a.end + b.end) / 2
    return start, end

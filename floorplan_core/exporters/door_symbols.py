"""Door leaves and their swing: which way a door is drawn to open. Metres, manhattan frame.

A door that was seen shut is drawn shut: its leaf lies in the middle of the wall, and sweeps nothing.

A survey does not show it, so the drawing follows the usual convention: into a room rather than a corridor,
the hinge at the jamb nearer to a corner, the leaf clear of walls and of other doors' leaves. Ties: towards
the lower coordinate, hinge at the start.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.exporters.walls import Opening
from floorplan_core.model import Region

Float = NDArray[np.float64]

ARC_STEPS = 12
CLEAR = 0.97  # share of the swing that must lie on floor
DOUBLE = 1.15  # metres: wider doors get two leaves
APART = 0.1  # metres between the swings of two doors, where there is a choice
REACH = 0.1  # metres behind the face where the region that a door opens into is looked for

_TURN = np.linspace(0, np.pi / 2, ARC_STEPS)[:, None]
_COS, _SIN = np.cos(_TURN), np.sin(_TURN)


@dataclass(frozen=True)
class Leaf:
    """One leaf, open at a right angle; or shut, its free end where it lies when shut."""

    hinge: Float  # (2,)
    tip: Float  # (2,) free end of the open leaf
    closed: Float  # (2,) where the free end lies when shut

    @property
    def shut(self) -> bool:
        """True where the leaf does not stand open."""
        return bool(np.array_equal(self.tip, self.closed))

    @cached_property
    def sector(self) -> Any:
        """The floor that it sweeps, a shapely Polygon; empty where it is shut."""
        if self.shut:
            return shapely.Polygon()
        u, v = self.tip - self.hinge, self.closed - self.hinge
        return shapely.Polygon(np.vstack([self.hinge[None], self.hinge + _COS * u + _SIN * v]))


def swings(openings: Sequence[Opening], regions: Sequence[Region]) -> list[tuple[Leaf, ...]]:
    """The leaves of every opening, in their order; none swings over floor that one before it sweeps."""
    made: list[tuple[Leaf, ...]] = []
    places = [opening.polygon for opening in openings]
    floors, doors = shapely.STRtree([r.polygon for r in regions]), shapely.STRtree(places)
    reach = 2 * max((o.door.width for o in openings if o.door.kind == "door"), default=0.0) + APART
    for opening, place in zip(openings, places, strict=True):
        near = np.sort(floors.query(place, predicate="dwithin", distance=2 * REACH)).tolist()
        before = np.sort(doors.query(place, predicate="dwithin", distance=reach)).tolist()
        swept = [leaf.sector for k in before if k < len(made) for leaf in made[k] if not leaf.shut]
        made.append(leaves(opening, [regions[k] for k in near], swept))
    return made


def leaves(opening: Opening, regions: Sequence[Region], swept: Sequence[Any] = ()) -> tuple[Leaf, ...]:
    """The leaves of a door; none for an opening. Where there is a choice they keep off ``swept`` floor."""
    if opening.door.kind != "door":
        return ()
    if opening.door.turn:
        return _of_wing(opening, regions, swept)
    if opening.door.shut:
        return _shut(opening)
    options: list[tuple[tuple[bool, bool, float], int, tuple[Leaf, ...], Region | None]] = []
    polygons = np.array([r.polygon for r in regions], dtype=object)
    shapely.prepare(polygons)
    for direction in (-1, 1):
        inside = np.flatnonzero(shapely.contains_xy(polygons, *_beyond(opening, direction)))
        region = regions[int(inside[0])] if len(inside) else None
        for hinge in ("start", "end"):
            cost = _cost(opening, region, hinge)
            options.append((cost, len(options), _make(opening, direction, hinge), region))
    options.sort(key=lambda option: option[:2])
    clear = [made for _, _, made, region in options if _clear(made, region)]
    return next((made for made in clear if not _meets(made, swept)), (clear or [options[0][2]])[0])


def _meets(made: tuple[Leaf, ...], swept: Sequence[Any]) -> bool:
    others = np.array(swept, dtype=object)
    return any(bool(np.any(shapely.dwithin(leaf.sector, others, APART))) for leaf in made if swept)


def _of_wing(opening: Opening, regions: Sequence[Region], swept: Sequence[Any]) -> tuple[Leaf, ...]:
    """The same in the axes of the door's wall, brought into the plan."""
    door = opening.door
    own = [replace(r, polygon=shapely.transform(r.polygon, door.in_own)) for r in regions]
    turned = [shapely.transform(sector, door.in_own) for sector in swept]
    made = leaves(replace(opening, door=replace(door, turn=0.0)), own, turned)
    return tuple(Leaf(*door.in_plan(np.array([leaf.hinge, leaf.tip, leaf.closed]))) for leaf in made)


def _cost(opening: Opening, region: Region | None, hinge: str) -> tuple[bool, bool, float]:
    """Smaller is better: outside the plan, opens into a corridor, far from a corner."""
    if region is None:
        return True, True, 0.0
    return False, region.label != "room", _to_corner(opening, region, hinge)


def _clear(made: tuple[Leaf, ...], region: Region | None) -> bool:
    """True where the leaves swing over the region's floor only."""
    if region is None:
        return False
    sectors = [leaf.sector for leaf in made]
    return all(
        shapely.contains(region.polygon, s) or region.polygon.intersection(s).area >= CLEAR * s.area
        for s in sectors
    )


def _to_corner(opening: Opening, region: Region, hinge: str) -> float:
    """Metres from the hinge to the nearest wall that is square to the door's wall."""
    along = 1 - opening.door.axis
    at = getattr(opening.door, hinge)
    corners = shapely.get_coordinates(region.polygon)[:, along]
    beyond = corners[corners <= at + REACH] if hinge == "start" else corners[corners >= at - REACH]
    return round(float(np.abs(beyond - at).min()), 3) if len(beyond) else float("inf")


def _beyond(opening: Opening, direction: int) -> Float:
    """A point just behind the opening's face on that side."""
    axis = opening.door.axis
    point = np.empty(2)
    point[1 - axis] = (opening.door.start + opening.door.end) / 2
    point[axis] = opening.own[axis + 2 * (direction > 0)] + direction * REACH
    return point


def _make(opening: Opening, direction: int, hinge: str) -> tuple[Leaf, ...]:
    """One leaf hung at ``hinge``, or two that meet in the middle."""
    door = opening.door
    if door.width <= DOUBLE:
        ends = (door.start, door.end) if hinge == "start" else (door.end, door.start)
        return (_leaf(opening, direction, *ends),)
    middle = (door.start + door.end) / 2
    return _leaf(opening, direction, door.start, middle), _leaf(opening, direction, door.end, middle)


def _shut(opening: Opening) -> tuple[Leaf, ...]:
    """One leaf across the opening in the middle of the wall, or two that meet there."""
    door = opening.door
    middle = (opening.own[door.axis] + opening.own[door.axis + 2]) / 2
    ends = (
        (door.start, door.end)
        if door.width <= DOUBLE
        else (door.start, (door.start + door.end) / 2, door.end)
    )
    at = np.empty((len(ends), 2))
    at[:, door.axis], at[:, 1 - door.axis] = middle, ends
    return tuple(Leaf(a, b, b) for a, b in pairwise(at))


def _leaf(opening: Opening, direction: int, hung: float, free: float) -> Leaf:
    axis = opening.door.axis
    face = opening.own[axis + 2 * (direction > 0)]
    points = np.empty((3, 2))
    points[:, 1 - axis] = hung, hung, free
    points[:, axis] = face, face + direction * abs(free - hung), face
    return Leaf(*points)

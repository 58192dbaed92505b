"""Flights of stairs: a floor that rises in even steps, along one axis, over the width of a person.

A flight is open to the hall in which it stands, so no wall and no lintel parts them; its treads tell it.
In columns seen from above the topmost surface below the head then rises along the flight, never falls, and as
steeply as stairs do. The flight is a region of its own, entered at its foot, where it has an opening.
In: voxel columns. Out: flights, and regions parted along them. Cost: linear in cells.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.columns import LEVEL, by_strips, height_mask, merged, strips
from floorplan_core.geometry.masks import label_patches
from floorplan_core.geometry.rectilinear import polygons_of
from floorplan_core.geometry.runs import runs_of
from floorplan_core.model import Door
from floorplan_core.model.evidence import Evidence

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

_HEAD = 2.4  # m above the floor, below which treads are looked for
_HIDDEN = 3  # cells along a flight that need not have been seen: a tread above the eye
_FALL, _RISE = -1, 3  # levels from one cell along a flight to the next: noise, and a riser and a half
_SLOPE = (0.45, 1.1)  # rise by run of stairs in a building
_CLEAR = 2, 4  # levels above a tread from which it is free, and so many; more than half must have been seen
_HIGH = 14  # level of a tread, from which the eye of a sensor does not look down on it
_RISES = 1.2  # m, that a flight rises at least: more than a sofa, a rostrum or a few steps
_NARROWEST, _WIDEST = 0.6, 3.0  # m across a flight
_FILLED = 0.6  # share of a flight's box in which treads were seen
_DEEP = 0.1  # m, depth of the opening at the foot
_BESIDE = 0.4  # m from a flight's box to the wall that it ends at: its stringer, and treads above the head
_MOST = 0.5  # of a region: where flights take more of it, they are what it is
_LEADS_ON = 2  # doors of a hall; with fewer it leads only to the stairs: a stairwell, one room
_BY = 0.4  # m from a region to its doors
_LEAST = 1.0  # m2 of a flight, and of what it stands in
_EVIDENCE = ("stairs",)  # of an opening at the foot of a flight
_CONFIDENCE = 0.9  # of the opening at its foot: nothing can stand there


@dataclass(frozen=True)
class Flight:
    """One flight of stairs, metres in the manhattan frame."""

    axis: int  # along which it rises: 0 x, 1 y
    up: int  # +1 or -1, the way it rises along that axis
    bounds: tuple[float, float, float, float]  # x0, y0, x1, y1

    @property
    def foot(self) -> float:
        """Where it begins, along its axis."""
        return self.bounds[self.axis if self.up > 0 else self.axis + 2]


def find_flights(evidence: Evidence) -> tuple[Flight, ...]:
    """The flights of stairs of a storey, those along x first, then by where they are.

    None where free space is inferred: the top of a wall that was seen through a door rises as treads do.
    """
    if evidence.inferred:
        return ()
    top = by_strips(evidence.hits, _tops)
    for first, last in strips(*top.shape):
        top[first:last] = _walked(evidence.free[first:last], top[first:last])
    found = []
    for axis in (0, 1):
        lines = top if axis == 0 else top.T  # one line each row, in the way that a flight would rise
        for up in (1, -1):
            mask = _rising(lines[:, ::up], evidence.cell)[:, ::up]
            found += [Flight(axis, up, b) for b in _boxes(mask if axis == 0 else mask.T, axis, evidence)]
    return tuple(sorted(found, key=lambda f: (f.axis, f.bounds)))


def openings(flights: Sequence[Flight], doors: Sequence[Door]) -> tuple[Door, ...]:
    """An opening at the foot of each flight; the ids go on after those of ``doors``."""
    last = max((int("".join(filter(str.isdigit, d.id)) or 0) for d in doors), default=0)
    return tuple(
        Door(
            f"d{last + k + 1}", (), flight.axis, flight.foot, *_across(flight), thickness=_DEEP,
            kind="opening", confidence=_CONFIDENCE, evidence=_EVIDENCE,
        )
        for k, flight in enumerate(flights)
    )  # fmt: skip


def apart_from_stairs(
    doors: Sequence[Door], flights: Sequence[Flight]
) -> tuple[tuple[Door, ...], tuple[Door, ...], tuple[Flight, ...]]:
    """The other doors, the openings of flights, and the flights that have theirs: who rejects an opening
    says that its flight is a part of the hall.
    """
    feet = tuple(d for d in doors if _EVIDENCE[0] in d.evidence)
    left = tuple(f for f in flights if any(_is_foot(d, f) for d in feet))
    return tuple(d for d in doors if d not in feet), feet, left


def _is_foot(door: Door, flight: Flight) -> bool:
    low, high = _across(flight)
    return door.axis == flight.axis and door.offset == flight.foot and door.start < high and low < door.end


def part_flights(polygon: Any, flights: Sequence[Flight], doors: Sequence[Door]) -> list[Any]:
    """The polygon without the flights in it, largest first, and each flight as a polygon of its own.

    A room that leads nowhere else is a stairwell, and one with its flights.
    """
    out, rest = [], polygon
    boxes = [shapely.box(*flight.bounds) for flight in flights]
    if not boxes or shapely.intersection(shapely.union_all(boxes), polygon).area > _MOST * polygon.area:
        return [polygon]
    lines = [shapely.LineString(door.line()) for door in doors if _EVIDENCE[0] not in door.evidence]
    if sum(line.distance(polygon) < _BY for line in lines) < _LEADS_ON:
        return [polygon]
    for flight in flights:
        box = shapely.box(*_to_walls(flight, rest))
        inside, others = polygons_of(rest.intersection(box)), polygons_of(rest.difference(box))
        least = max(_LEAST, _FILLED * shapely.box(*flight.bounds).area)
        if len(inside) == 1 and others and inside[0].area >= least and others[0].area >= _LEAST:
            out.append(inside[0])
            rest = shapely.union_all(others)
    return [*polygons_of(rest), *out] if out else [polygon]


def _tops(hits: NDArray[np.uint64]) -> NDArray[np.int8]:
    """(ny, nx) number of the topmost level between floor and head that was hit, -1 where none was."""
    bits = merged(hits) & height_mask(0.0, _HEAD)
    highest = np.floor(np.log2(np.maximum(bits, 1).astype(np.float64)))
    return np.asarray(np.where(bits != 0, highest, -1), dtype=np.int8)


def _walked(free: NDArray[np.uint64], tops: NDArray[np.int8]) -> NDArray[np.int8]:
    """``tops`` of cells over whose topmost level it is free, as it is where a person walks; -1 elsewhere."""
    first = np.maximum(tops, 0).astype(np.uint64) + np.uint64(_CLEAR[0])
    above = free >> first & np.uint64((1 << _CLEAR[1]) - 1)
    walked = (np.bitwise_count(above) >= _CLEAR[1] // 2) | (tops > _HIGH)
    return np.where(walked, tops, np.int8(-1))


def _rising(lines: NDArray[np.int8], cell: float) -> Mask:
    """(R, C) cells of the lines that belong to a rise as of stairs to the right.

    What was not seen is as high as what is before it: of a tread above the eye only the riser shows. So is
    floor that was seen between open steps.
    """
    tops = lines.copy()
    for _ in range(_HIDDEN):
        tops[:, 1:] = np.where(tops[:, 1:] <= 0, tops[:, :-1], tops[:, 1:])
    change = np.diff(tops, axis=1, append=np.int8(0))
    linked = (tops > 0) & (np.roll(tops, -1, axis=1) > 0) & (change >= _FALL) & (change <= _RISE)
    linked[:, -1] = False  # the last cell of a line has no next
    out = np.zeros(lines.shape, dtype=bool)
    runs = runs_of(linked.ravel())
    long = runs[:, 1] - runs[:, 0] > _RISES / _SLOPE[1] / cell - 1
    for start, end in runs[long].tolist():
        row, first = divmod(start, lines.shape[1])
        rise = tops[row, first : first + end - start + 1]
        rise = rise[: int(np.argmax(rise)) + 1]  # without the landing
        height, run = LEVEL * float(rise[-1] - rise[0]), cell * (len(rise) - 1)
        if height >= _RISES and _SLOPE[0] * run <= height <= _SLOPE[1] * run:
            out[row, first : first + len(rise)] = True
    return out


def _boxes(mask: Mask, axis: int, evidence: Evidence) -> list[tuple[float, float, float, float]]:
    """The boxes of the patches of ``mask`` (ny, nx) that are as wide as a flight, and whole."""
    label, count = label_patches(mask)
    out = []
    for k in range(1, count + 1):
        rows, columns = np.nonzero(label == k)
        low = np.array([columns.min(), rows.min()])
        size = np.array([columns.max(), rows.max()]) + 1 - low
        across = float(size[1 - axis]) * evidence.cell
        if _NARROWEST <= across <= _WIDEST and len(rows) >= _FILLED * size.prod():
            x0, y0 = (evidence.origin + evidence.cell * low).tolist()
            x1, y1 = (evidence.origin + evidence.cell * (low + size)).tolist()
            out.append((x0, y0, x1, y1))
    return out


def _across(flight: Flight) -> tuple[float, float]:
    """Start and end of the opening at the foot."""
    return flight.bounds[1 - flight.axis], flight.bounds[3 - flight.axis]


def _to_walls(flight: Flight, polygon: Any) -> tuple[float, ...]:
    """The bounds of a flight, but for its foot out to the sides of the region that are near."""
    bounds = list(flight.bounds)
    foot = flight.axis if flight.up > 0 else flight.axis + 2
    for side in (k for k in range(4) if k != foot):
        reach = _BESIDE * (1 if side >= 2 else -1) * (2 if side % 2 == flight.axis else 1)
        beyond = list(bounds)
        beyond[(side + 2) % 4], beyond[side] = bounds[side] + reach, bounds[side] + 1.5 * reach
        strip = shapely.box(*beyond)
        if polygon.intersection(strip).area < 0.1 * strip.area:
            bounds[side] += reach
    return tuple(bounds)

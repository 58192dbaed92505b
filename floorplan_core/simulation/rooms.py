"""Strips beside a corridor become rooms: several sizes, rooms within rooms, halls, lobbies."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.building import Space
from floorplan_core.simulation.circulation import Circulation, Rect, Strip, Walls, mm
from floorplan_core.simulation.spec import BuildingSpec

Float = NDArray[np.float64]

MIN_ROOM = 2.2  # m, narrowest room of a strip
WEIGHTS = (0.6, 0.75, 0.9, 1.0, 1.0, 1.15, 1.4, 1.9)  # relative widths of the rooms of a strip
ROOMS_A_LOBBY = 15  # a building has one lobby, and one more for so many rooms
SMALL, LARGE = 8.0, 28.0  # m2: below a store or washroom, above a meeting room


@dataclass(frozen=True)
class Slot:
    """One place in a strip; local axes: u along the corridor, v away from it, 0 at its side."""

    rect: Rect
    side: str

    @property
    def size(self) -> tuple[float, float]:
        """Metres along u and v."""
        dx, dy = self.rect[2] - self.rect[0], self.rect[3] - self.rect[1]
        return (dx, dy) if self.side in "sn" else (dy, dx)

    def plan(self, u0: float, v0: float, u1: float, v1: float) -> Rect:
        """A local rectangle in the building's axes."""
        x0, y0, x1, y1 = self.rect
        if self.side == "s":
            rect = (x0 + u0, y0 + v0, x0 + u1, y0 + v1)
        elif self.side == "n":
            rect = (x0 + u0, y1 - v1, x0 + u1, y1 - v0)
        elif self.side == "w":
            rect = (x0 + v0, y0 + u0, x0 + v1, y0 + u1)
        else:
            rect = (x1 - v1, y0 + u0, x1 - v0, y0 + u1)
        return mm(rect[0]), mm(rect[1]), mm(rect[2]), mm(rect[3])


def make_spaces(
    spec: BuildingSpec, plan: Circulation, walls: Walls, rng: np.random.Generator
) -> tuple[Space, ...]:
    """The corridor network first, then all rooms; a nested room follows its host."""
    spaces = [Space("corridor", "corridor", np.array(plan.corridors))]
    slots = [slot for strip in plan.strips for slot in _slots(strip, spec, walls.interior, rng)]
    if spec.style == "flat":
        return tuple(_flat_rooms(spaces, slots, spec, walls.interior, rng))
    for slot in slots:
        if rng.random() < spec.halls and min(slot.size) > 3.0:
            lobbies = len(spaces[0].rects) - len(plan.corridors)
            _add_hall(spaces, slot, walls.interior, lobbies <= spec.rooms // ROOMS_A_LOBBY, rng)
        else:
            spaces += _rooms(slot, len(spaces), spec, walls.interior, rng)
    return tuple(spaces)


def _slots(strip: Strip, spec: BuildingSpec, t: float, rng: np.random.Generator) -> list[Slot]:
    """Cut a strip across its corridor into places of varied width."""
    whole = Slot(strip.rect, strip.side)
    length, depth = whole.size
    width = spec.room_width if spec.style != "flat" else 3.2
    if spec.style == "flat" and strip.side in "we":
        width = length  # the living room
    count = max(1, min(round(length / width), int((length + t) / (MIN_ROOM + t))))
    weights = rng.choice(WEIGHTS, count)
    inner = length - (count - 1) * t
    widths = MIN_ROOM + (inner - count * MIN_ROOM) * weights / weights.sum() if count > 1 else [inner]
    ends = np.round(np.cumsum(widths) + t * np.arange(count), 3)  # then every wall is exactly t thick
    ends[-1] = length
    starts = np.concatenate([[0.0], ends[:-1] + t])
    return [Slot(whole.plan(mm(a), 0, mm(b), depth), strip.side) for a, b in zip(starts, ends, strict=True)]


def _room(slot: Slot, *local: float, use: str = "", host: int = -1) -> Space:
    rect = slot.plan(*local) if local else slot.rect
    area = (rect[2] - rect[0]) * (rect[3] - rect[1])
    guess = "store" if area < SMALL else "office" if area < LARGE else "meeting room"
    return Space("room", use or guess, np.array([rect]), host)


def _rooms(slot: Slot, index: int, spec: BuildingSpec, t: float, rng: np.random.Generator) -> list[Space]:
    """The room of a slot, sometimes with a bathroom, closet or back room in it."""
    width, depth = slot.size
    if rng.random() >= spec.nested_rooms or width < 3.4 or depth < 4.2:
        return [_room(slot)]
    form = rng.choice(["corner", "deep", "strip"])
    if form == "corner":
        return _corner(slot, index, t, rng)
    if form == "deep" and depth >= 5.0:
        cut = mm(depth * rng.uniform(0.5, 0.65))
        return [_room(slot, 0, 0, width, cut), _room(slot, 0, cut + t, width, depth, host=index)]
    return _suite(slot, index, t, rng)


def _corner(slot: Slot, index: int, t: float, rng: np.random.Generator) -> list[Space]:
    """A bathroom cut out of a back corner: the room that remains is L-shaped."""
    (width, depth), inner = slot.size, (mm(rng.uniform(1.5, 1.9)), mm(rng.uniform(1.7, 2.3)))
    a, b = inner[0], depth - inner[1]
    rects = [slot.plan(0, 0, width, b - t), slot.plan(a + t, 0, width, depth)]
    bath = slot.plan(0, b, a, depth)
    if rng.random() < 0.5:  # the other corner
        rects = [slot.plan(0, 0, width, b - t), slot.plan(0, 0, width - a - t, depth)]
        bath = slot.plan(width - a, b, width, depth)
    host = Space("room", "office", np.array(rects))
    return [host, Space("room", "bathroom", np.array([bath]), index)]


def _suite(slot: Slot, index: int, t: float, rng: np.random.Generator) -> list[Space]:
    """A side strip split into a closet at the corridor and a bathroom behind it, both off the room."""
    width, depth = slot.size
    side, cut = mm(rng.uniform(1.4, 1.8)), mm(depth * rng.uniform(0.4, 0.55))
    room = _room(slot, side + t, 0, width, depth)
    return [
        room,
        _room(slot, 0, 0, side, cut, use="closet", host=index),
        _room(slot, 0, cut + t, side, depth, use="bathroom", host=index),
    ]


def _add_hall(spaces: list[Space], slot: Slot, t: float, lobby: bool, rng: np.random.Generator) -> None:
    """A lobby becomes part of the corridor; a hall is a room behind a wide opening."""
    width, depth = slot.size
    open_rect = slot.plan(0, -t, width, depth)
    x0, y0, x1, y1 = slot.plan(0, -2 * t, width, -t)
    ways = spaces[0].rects
    faces = (ways[:, 0] <= x0) & (ways[:, 1] <= y0) & (ways[:, 2] >= x1) & (ways[:, 3] >= y1)
    if rng.random() < 0.5 or not (lobby and faces.any()):
        spaces.append(_room(slot, use="hall"))
        return
    spaces[0] = replace(spaces[0], rects=np.vstack([spaces[0].rects, open_rect]))


def _flat_rooms(
    spaces: list[Space], slots: list[Slot], spec: BuildingSpec, t: float, rng: np.random.Generator
) -> list[Space]:
    """Uses of a flat: living room across the end, bedrooms on the deep side, kitchen and bath opposite."""
    small = ["bathroom", "kitchen", "store", "bedroom"]
    for number, slot in enumerate(slots):
        if slot.side == "w":
            spaces.append(_room(slot, use="living room"))
        elif slot.side == "n":
            spaces.append(_room(slot, use=small[number % len(small)]))
        else:
            spaces += _bedroom(slot, len(spaces), spec, t, rng)
    return spaces


def _bedroom(slot: Slot, index: int, spec: BuildingSpec, t: float, rng: np.random.Generator) -> list[Space]:
    rooms = _rooms(slot, index, spec, t, rng)
    return [replace(rooms[0], use="bedroom"), *rooms[1:]]

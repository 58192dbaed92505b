"""Doors between spaces: where a wall stands between them, with lintel, frame and leaf."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.building import DoorOpening, Space
from floorplan_core.simulation.circulation import Walls, mm
from floorplan_core.simulation.spec import BuildingSpec

Float = NDArray[np.float64]

JAMB = 0.15  # m of wall beside a door at least
LEAF = 0.04  # m, thickness of a door leaf
FRAME = (0.06, 0.012)  # m, width of a door frame and how far it stands out of the wall
NARROW = ("closet", "bathroom", "store")
WIDE = ("hall", "living room")


@dataclass(frozen=True)
class Contact:
    """A stretch of wall between two spaces: ``low`` and ``high`` are its faces, from ``start`` to ``end``."""

    axis: int  # of the wall's normal
    low: float
    high: float
    start: float
    end: float
    low_space: int
    high_space: int

    @property
    def length(self) -> float:
        """Metres along the wall."""
        return self.end - self.start


def contacts(spaces: tuple[Space, ...], thickest: float) -> list[Contact]:
    """All stretches where two different spaces are at most ``thickest`` metres apart."""
    rects = np.vstack([s.rects for s in spaces])
    owner = np.repeat(np.arange(len(spaces)), [len(s.rects) for s in spaces])
    found: list[Contact] = []
    for axis in (0, 1):
        order = np.argsort(rects[:, axis], kind="stable")
        faces = rects[order, axis]
        for i in range(len(rects)):
            near = np.searchsorted(faces, [rects[i, axis + 2], rects[i, axis + 2] + thickest + 1e-6])
            found += _facing(rects, owner, axis, i, order[near[0] : near[1]])
    return sorted(found, key=lambda c: (c.low_space, c.high_space, c.axis, c.low, c.start))


def _facing(
    rects: Float, owner: NDArray[np.int64], axis: int, i: int, candidates: NDArray[np.int64]
) -> Iterator[Contact]:
    other = 1 - axis
    for j in candidates:
        start, end = max(rects[i, other], rects[j, other]), min(rects[i, other + 2], rects[j, other + 2])
        low, high = float(rects[i, axis + 2]), float(rects[j, axis])
        if owner[i] != owner[j] and end - start > 1e-6 and high - low > 1e-6:
            yield Contact(axis, low, high, float(start), float(end), int(owner[i]), int(owner[j]))


def make_doors(
    spaces: tuple[Space, ...], spec: BuildingSpec, walls: Walls, rng: np.random.Generator
) -> tuple[DoorOpening, ...]:
    """A door from every room to its host, to the corridor, or to a neighbour that has one."""
    by_room: dict[int, list[Contact]] = {}
    for contact in contacts(spaces, 1.5 * walls.interior):
        by_room.setdefault(contact.low_space, []).append(contact)
        by_room.setdefault(contact.high_space, []).append(contact)
    doors: list[DoorOpening] = []
    reached, waiting = {0}, [i for i in range(1, len(spaces)) if i in by_room]
    while waiting:
        done = [room for room in waiting if _attach(room, by_room[room], spaces, reached, doors, spec, rng)]
        if not done:
            break
        waiting = [room for room in waiting if room not in done]
    return tuple(doors)


def _attach(
    room: int,
    walls: list[Contact],
    spaces: tuple[Space, ...],
    reached: set[int],
    doors: list[DoorOpening],
    spec: BuildingSpec,
    rng: np.random.Generator,
) -> bool:
    """Give ``room`` a door into what is already reached; False where there is no such wall (yet)."""
    host = max(spaces[room].host, 0)
    usable = [c for c in walls if _other(c, room) in reached and c.length > 2 * JAMB + 0.7]
    wanted = [c for c in usable if _other(c, room) == host]
    others = [c for c in usable if spaces[_other(c, room)].use not in NARROW]
    if not (wanted or (others and spaces[room].host < 0)):
        return False
    best = max(wanted or others, key=lambda c: c.length)
    door = _door(best, room, spaces[room], spec, rng, doors)
    if door is None:
        return False
    doors.append(door)
    reached.add(room)
    if best.length > 9 and door.kind != "opening":
        second = _door(best, room, spaces[room], spec, rng, doors)
        doors += [second] if second else []
    return True


def _other(contact: Contact, room: int) -> int:
    return contact.low_space + contact.high_space - room


def _door(
    wall: Contact,
    room: int,
    space: Space,
    spec: BuildingSpec,
    rng: np.random.Generator,
    doors: list[DoorOpening],
) -> DoorOpening | None:
    """Place a door in ``wall``; None where every try lies in another door."""
    kind, width = _kind_and_width(wall, space, spec, rng)
    for _ in range(20):
        slack = max(wall.length - width - 2 * JAMB, 0.0)
        near_end = min(slack, rng.uniform(0, 0.4))
        shift = rng.choice([near_end, slack - near_end, rng.uniform(0, slack)])
        a = mm(wall.start + JAMB + shift)
        b = mm(a + width)
        bounds = (wall.low, a, wall.high, b) if wall.axis == 0 else (a, wall.low, b, wall.high)
        if not any(_close(bounds, door.bounds) for door in doors):
            return _hang(bounds, wall, room, kind, spec, rng)
    return None


def _kind_and_width(
    wall: Contact, space: Space, spec: BuildingSpec, rng: np.random.Generator
) -> tuple[str, float]:
    room = wall.length - 2 * JAMB
    if space.use in WIDE and room > 1.4:
        return "opening", mm(min(rng.uniform(1.6, 2.8), room))
    if room > 2.0 and space.use not in NARROW and rng.random() < spec.double_doors:
        return "double", mm(rng.uniform(1.2, min(1.8, room)))
    low, high = (0.7, 0.8) if space.use in NARROW else (0.8, 1.0)
    return "door", mm(min(rng.uniform(low, high), room))


def _close(a: tuple[float, ...], b: tuple[float, ...], margin: float = 2 * JAMB) -> bool:
    return all(a[k] < b[k + 2] + margin and b[k] < a[k + 2] + margin for k in (0, 1))


def _hang(
    bounds: tuple[float, float, float, float],
    wall: Contact,
    room: int,
    kind: str,
    spec: BuildingSpec,
    rng: np.random.Generator,
) -> DoorOpening:
    """Height, leaf and frame of a door whose opening is known."""
    height = mm(rng.uniform(2.2, 2.3) if kind == "opening" else rng.uniform(2.0, 2.15))
    shut = kind != "opening" and rng.random() < spec.shut_doors
    standing = kind != "opening" and not shut and rng.random() < spec.door_leaves
    into = 1 if wall.high_space == room else -1  # the leaf opens into the room
    leaves = np.zeros((0, 7))
    if kind != "opening":
        leaves = _frame(bounds, wall.axis, height)
    if shut:
        leaves = np.vstack([leaves, _shut_leaf(bounds, wall, height, into)])
    if standing:
        leaves = np.vstack([leaves, *_standing_leaves(bounds, wall, height, into, kind, rng)])
    joins = (_other(wall, room), room)
    return DoorOpening(bounds, wall.axis, joins, height, kind, not shut, leaves)


def _solid(axis: int, a: tuple[float, float], b: tuple[float, float], z: tuple[float, float]) -> Float:
    """(7,) from intervals across the wall (a), along it (b) and in height."""
    x, y = (a, b) if axis == 0 else (b, a)
    return np.array([x[0], y[0], z[0], x[1], y[1], z[1], 0.0])


def _frame(bounds: tuple[float, float, float, float], axis: int, height: float) -> Float:
    """Architraves around the opening, standing a little out of both wall faces."""
    (w, out), other = FRAME, 1 - axis
    across = (bounds[axis] - out, bounds[axis + 2] + out)
    a, b = bounds[other], bounds[other + 2]
    return np.array(
        [
            _solid(axis, across, (a - w, a), (0, height + w)),
            _solid(axis, across, (b, b + w), (0, height + w)),
            _solid(axis, across, (a, b), (height, height + w)),
        ]
    )


def _shut_leaf(bounds: tuple[float, float, float, float], wall: Contact, height: float, into: int) -> Float:
    """The leaf in its frame, flush-ish with the room's face: recessed as seen from the other side."""
    face = wall.high if into > 0 else wall.low
    outer = face - into * min(0.02, wall.high - wall.low - LEAF)
    across = tuple(sorted((outer, outer - into * LEAF)))
    along = (bounds[1 - wall.axis], bounds[3 - wall.axis])
    return _solid(wall.axis, (across[0], across[1]), along, (0.0, height))[None]


def _standing_leaves(
    bounds: tuple[float, float, float, float],
    wall: Contact,
    height: float,
    into: int,
    kind: str,
    rng: np.random.Generator,
) -> list[Float]:
    """One leaf hinged at the end nearer to the room's corner, or two."""
    a, b = bounds[1 - wall.axis], bounds[3 - wall.axis]
    face = wall.high if into > 0 else wall.low
    if kind == "double":
        return [_leaf(wall.axis, face, into, at, s, (b - a) / 2, height, rng) for at, s in ((a, 1), (b, -1))]
    at_start = a - wall.start < wall.end - b
    return [_leaf(wall.axis, face, into, a if at_start else b, 1 if at_start else -1, b - a, height, rng)]


def _leaf(
    axis: int,
    face: float,
    into: int,
    hinge: float,
    sense: int,
    width: float,
    height: float,
    rng: np.random.Generator,
) -> Float:
    """A leaf that stands open by 78 to 92 degrees; solid with yaw about its own middle."""
    angle = np.deg2rad(rng.uniform(78, 92))
    length = width - 0.02
    normal, along = into * np.sin(angle), sense * np.cos(angle)  # towards the leaf's free edge
    across = face + normal * length / 2
    beside = hinge - sense * LEAF / 2 + along * length / 2
    x, y = (across, beside) if axis == 0 else (beside, across)
    dx, dy = (normal, along) if axis == 0 else (along, normal)
    half = (length / 2, LEAF / 2)
    low, high = (x - half[0], y - half[1], 0.01), (x + half[0], y + half[1], height - 0.01)
    return np.array([[*low, *high, np.arctan2(dy, dx)]])

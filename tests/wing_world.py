"""Buildings with a wing at another angle, a room and a chamber behind it, entered by a door.

Of two rooms, of ten along a corridor, or with a second wing.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import shapely

from tests.box_world import EYE, LINTEL, Box, Survey, cast, rotation, slabs, two_rooms, wall

STEP = 0.2  # m, of the pieces that the walls of the wing are made of
EAST = 8.1  # m, inner face of the building's east wall; its outer face is 0.2 m further
DOOR = (2.05, 2.95, LINTEL)  # in the east wall


def building() -> list[Box]:
    """Two rooms of 4 x 5 m, a door between them and one in the east wall."""
    closed = two_rooms((0.5, 1.4, LINTEL))
    east = wall(0, EAST, EAST + 0.2, -0.2, 5.2)
    return [b for b in closed if b not in east] + wall(0, EAST, EAST + 0.2, -0.2, 5.2, DOOR)


class WingWorld:
    """The building and the wing, whose own axes are turned by ``degrees`` about ``corner``."""

    hall = (6.0, 5.0)  # m, of the wing's first room
    chamber = 3.0  # m, depth of the room behind it

    def __init__(self, degrees: float = 45.0) -> None:
        self.turn = rotation(degrees)
        # The wing's westmost corner lies 1.6 m inside the building, behind the door.
        self.corner = np.array([EAST + 0.2 - 1.6, 2.5, 0.0]) - self.turn @ np.array([0.0, self.hall[1], 0.0])
        self.wing = self._pieces()
        self.building = building()

    def _pieces(self) -> list[Box]:
        """Walls of the hall and of the chamber behind it, without what would be in the building."""
        (w, d), far = self.hall, self._far
        walls = [
            *wall(0, -0.2, 0, -0.2, d + 0.2),
            *wall(0, w, w + 0.1, 0, d, (d - 1.4, d - 0.5, LINTEL)),
            *wall(0, far, far + 0.2, -0.2, d + 0.2),
            *wall(1, -0.2, 0, 0, far),
            *wall(1, d, d + 0.2, 0, far),
        ]
        pieces = [p for b in walls for p in (_chopped(b) if b[0] <= 0 else [b])]
        outside = [
            p
            for p in pieces
            if self.world(np.array([[(p[0] + p[3]) / 2, (p[1] + p[4]) / 2, 0]]))[0, 0] > EAST + 0.1
        ]
        return outside + slabs(-0.2, -0.2, far + 0.2, d + 0.2)

    @property
    def _far(self) -> float:
        return self.hall[0] + 0.1 + self.chamber

    def world(self, xyz: np.ndarray) -> np.ndarray:
        """Axes of the wing to those of the building."""
        return xyz @ self.turn.T + self.corner

    def rooms(self) -> list[shapely.Polygon]:
        """The floors: two rooms, the hall without what the building takes of it, the chamber."""

        def turned(*box: float) -> shapely.Polygon:
            return shapely.transform(
                shapely.box(*box), lambda xy: self.world(np.column_stack([xy, np.zeros(len(xy))]))[:, :2]
            )

        w, d = self.hall
        hall = turned(0, 0, w, d).difference(shapely.box(-50, -50, EAST + 0.2, 50))
        return [*self.straight_rooms(), hall, turned(w + 0.1, 0, self._far, d)]

    def straight_rooms(self) -> list[shapely.Polygon]:
        """The floors of the building."""
        return [shapely.box(0, 0, 4, 5), shapely.box(4.1, 0, EAST, 5)]

    def places(self) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
        """Where the scanner stood: in the building, and in the axes of the wing."""
        wing = [(1.9, 2.3), (3.0, 1.2), (4.4, 3.6), (5.7, 4.05), (7.5, 1.6), (7.4, 3.8)]
        return [(1, 1.5), (3, 3.5), (3.8, 1.0), (5.2, 3.5), (6.8, 1.2), (7.6, 2.5), (EAST + 0.1, 2.5)], wing

    def survey(self, yaw: float = 0.0, rays: tuple[int, int] = (200, 60), noise: float = 0.008) -> Survey:
        """Scans from a walk through all rooms and doors; the world is turned by ``yaw`` degrees."""
        inside, own = self.places()
        wing = self.world(np.column_stack([own, np.zeros(len(own))]))
        places = [*inside, *wing[:, :2].tolist()]
        rng = np.random.default_rng(2)
        out, ids, poses, world = [], [], [], rotation(yaw)
        for k, place in enumerate(places):
            points = self._scan(np.array([*place, EYE]), rng, rays, noise)
            pose = np.eye(4)
            pose[:3, :3], pose[:3, 3] = world, world @ np.array([*place, EYE])
            out.append((points + np.array([*place, EYE])) @ world.T)
            ids.append(np.full(len(points), k, dtype=np.int32))
            poses.append(pose)
        return Survey(np.concatenate(out), np.concatenate(ids), np.array(poses), world)

    def _scan(
        self, origin: np.ndarray, rng: np.random.Generator, rays: tuple[int, int], noise: float
    ) -> np.ndarray:
        directions = fan(rays, rng)
        distance = np.minimum(
            cast(self.building, origin, directions),
            cast(self.wing, (origin - self.corner) @ self.turn, directions @ self.turn),
        )
        hit = np.isfinite(distance) & (distance < 30)
        return directions[hit] * (distance[hit] + rng.normal(0, noise, int(hit.sum())))[:, None]


class LongWorld(WingWorld):
    """Five rooms of 4 x 5 m on each side of a corridor, and a small wing at its end."""

    hall = (4.0, 4.0)

    def __init__(self, degrees: float) -> None:
        super().__init__(degrees)
        self.west = [EAST - 4 - 4.1 * k for k in range(5)]
        doors = [(x + 0.5, x + 1.4, LINTEL) for x in self.west]
        first = self.west[-1]
        self.building = [
            *slabs(first - 0.2, -3.8, EAST + 0.2, 8.8),
            *wall(0, first - 0.2, first, -3.8, 8.8),
            *wall(0, EAST, EAST + 0.2, -3.8, 8.8, DOOR),
            *wall(1, -3.8, -3.6, first, EAST),
            *wall(1, 8.6, 8.8, first, EAST),
            *wall(1, 1.4, 1.5, first, EAST, *doors),
            *wall(1, 3.5, 3.6, first, EAST, *doors),
            *(b for x in self.west[:-1] for b in wall(0, x - 0.1, x, -3.6, 1.4)),
            *(b for x in self.west[:-1] for b in wall(0, x - 0.1, x, 3.6, 8.6)),
        ]

    def straight_rooms(self) -> list[shapely.Polygon]:
        """The floors of the rooms and of the corridor."""
        rooms = [shapely.box(x, y, x + 4, y + 5) for x in self.west for y in (-3.6, 3.6)]
        return [*rooms, shapely.box(self.west[-1], 1.5, EAST, 3.5)]

    def places(self) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
        """Three in each room and its doorway, one before it; few in the wing."""
        own = ((1, -1.0), (3, -2.5), (1, 6.0), (3, 7.0), (0.95, 1.45), (0.95, 3.55), (2, 2.4))
        inside = [(x + dx, y) for x in self.west for dx, y in own]
        return [*inside, (EAST + 0.1, 2.5)], [(1.4, 2.2), (2.9, 2.6), (5.6, 1.4)]


class TwoWings:
    """The building with a wing in the east and, half a turn about the middle away, another in the west."""

    def __init__(self, east: float, west: float) -> None:
        self.wings = WingWorld(east), WingWorld(west)
        plain = wall(0, -0.2, 0, -0.2, 5.2)
        door = wall(0, -0.2, 0, -0.2, 5.2, (5 - DOOR[1], 5 - DOOR[0], LINTEL))
        self.building = [b for b in building() if b not in plain] + door

    @staticmethod
    def opposite(xyz: np.ndarray) -> np.ndarray:
        """Half a turn about the middle of the building, and back."""
        return np.column_stack([EAST - xyz[:, 0], 5.0 - xyz[:, 1], xyz[:, 2:]])

    def rooms(self) -> list[shapely.Polygon]:
        """The floors: two rooms, then hall and chamber of either wing."""
        west = [shapely.transform(p, self.opposite) for p in self.wings[1].rooms()[2:]]
        return self.wings[0].rooms() + west

    def survey(self, rays: tuple[int, int] = (150, 46)) -> Survey:
        """Scans from a walk through all rooms and doors."""
        rng, out, ids, poses = np.random.default_rng(2), [], [], []
        for k, place in enumerate(self._places()):
            directions, pose = fan(rays, rng), np.eye(4)
            pose[:3, 3] = place
            distance = self._cast(place, directions)
            hit = np.isfinite(distance) & (distance < 30)
            reach = distance[hit] + rng.normal(0, 0.008, int(hit.sum()))
            out.append(place + directions[hit] * reach[:, None])
            ids.append(np.full(int(hit.sum()), k, dtype=np.int32))
            poses.append(pose)
        return Survey(np.concatenate(out), np.concatenate(ids), np.array(poses), np.eye(3))

    def _places(self) -> np.ndarray:
        """(N, 3) where the scanner stood."""
        rooms = [
            (1, 1.5),
            (3, 3.5),
            (3.8, 1.0),
            (5.2, 3.5),
            (6.8, 1.2),
            (7.6, 2.5),
            (0.4, 2.5),
            (EAST + 0.1, 2.5),
        ]
        own = [(1.9, 2.3), (3.0, 1.2), (4.4, 3.6), (5.7, 4.05), (7.5, 1.6), (7.4, 3.8)]
        own3 = np.column_stack([own, np.full(len(own), EYE)])
        east, west = (w.world(own3) for w in self.wings)
        inside = np.column_stack([[*rooms, (-0.1, 2.5)], np.full(len(rooms) + 1, EYE)])
        return np.vstack([inside, east, self.opposite(west)])

    def _cast(self, origin: np.ndarray, directions: np.ndarray) -> np.ndarray:
        back = directions * [-1, -1, 1]
        seen = [
            cast(w.wing, (o - w.corner) @ w.turn, d @ w.turn)
            for w, o, d in zip(
                self.wings, (origin, self.opposite(origin[None])[0]), (directions, back), strict=True
            )
        ]
        return np.minimum(cast(self.building, origin, directions), np.minimum(*seen))


def fan(rays: tuple[int, int], rng: np.random.Generator) -> np.ndarray:
    """(N, 3) directions of one scan: ``rays`` around and up."""
    around = (np.arange(rays[0]) + rng.uniform()) * 2 * np.pi / rays[0]
    up = np.radians(np.linspace(-75, 75, rays[1]) + rng.uniform(-0.5, 0.5))
    a, e = (m.ravel() for m in np.meshgrid(around, up))
    return np.column_stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])


def _chopped(box: Box) -> list[Box]:
    """A box in pieces along its longer side in plan."""
    x0, y0, z0, x1, y1, z1 = box
    axis = 0 if x1 - x0 > y1 - y0 else 1
    low, high = (x0, x1) if axis == 0 else (y0, y1)
    cuts = np.linspace(low, high, max(1, round((high - low) / STEP)) + 1)
    if axis == 0:
        return [(a, y0, z0, b, y1, z1) for a, b in pairwise(cuts)]
    return [(x0, a, z0, x1, b, z1) for a, b in pairwise(cuts)]

"""A building of two rooms with a wing at another angle: a room and a chamber behind it, entered by a door."""

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

    def __init__(self, degrees: float = 45.0) -> None:
        self.turn = rotation(degrees)
        # The wing's westmost corner lies 1.6 m inside the building, behind the door.
        self.corner = np.array([EAST + 0.2 - 1.6, 2.5, 0.0]) - self.turn @ np.array([0.0, 5.0, 0.0])
        self.wing = self._pieces()

    def _pieces(self) -> list[Box]:
        """Walls of a hall of 6 x 5 m and of a chamber behind it, without what would be in the building."""
        walls = [
            *wall(0, -0.2, 0, -0.2, 5.2),
            *wall(0, 6, 6.1, 0, 5, (3.6, 4.5, LINTEL)),
            *wall(0, 9.1, 9.3, -0.2, 5.2),
            *wall(1, -0.2, 0, 0, 9.1),
            *wall(1, 5, 5.2, 0, 9.1),
        ]
        pieces = [p for b in walls for p in (_chopped(b) if b[0] <= 0 else [b])]
        outside = [
            p
            for p in pieces
            if self.world(np.array([[(p[0] + p[3]) / 2, (p[1] + p[4]) / 2, 0]]))[0, 0] > EAST + 0.1
        ]
        return outside + slabs(-0.2, -0.2, 9.3, 5.2)

    def world(self, xyz: np.ndarray) -> np.ndarray:
        """Axes of the wing to those of the building."""
        return xyz @ self.turn.T + self.corner

    def rooms(self) -> list[shapely.Polygon]:
        """The floors: two rooms, the hall without what the building takes of it, the chamber."""

        def turned(*box: float) -> shapely.Polygon:
            return shapely.transform(
                shapely.box(*box), lambda xy: self.world(np.column_stack([xy, np.zeros(len(xy))]))[:, :2]
            )

        hall = turned(0, 0, 6, 5).difference(shapely.box(-50, -50, EAST + 0.2, 50))
        return [shapely.box(0, 0, 4, 5), shapely.box(4.1, 0, EAST, 5), hall, turned(6.1, 0, 9.1, 5)]

    def survey(self, yaw: float = 0.0, rays: tuple[int, int] = (200, 60)) -> Survey:
        """Scans from a walk through all rooms and doors; the world is turned by ``yaw`` degrees."""
        inside = [(1, 1.5), (3, 3.5), (3.8, 1.0), (5.2, 3.5), (6.8, 1.2), (7.6, 2.5)]
        wing = self.world(
            np.array(
                [(1.9, 2.3, 0), (3.0, 1.2, 0), (4.4, 3.6, 0), (5.7, 4.05, 0), (7.5, 1.6, 0), (7.4, 3.8, 0.0)]
            )
        )
        places = [*inside, (EAST + 0.1, 2.5), *wing[:, :2].tolist()]
        rng = np.random.default_rng(2)
        out, ids, poses, world = [], [], [], rotation(yaw)
        for k, place in enumerate(places):
            points = self._scan(np.array([*place, EYE]), rng, rays)
            pose = np.eye(4)
            pose[:3, :3], pose[:3, 3] = world, world @ np.array([*place, EYE])
            out.append((points + np.array([*place, EYE])) @ world.T)
            ids.append(np.full(len(points), k, dtype=np.int32))
            poses.append(pose)
        return Survey(np.concatenate(out), np.concatenate(ids), np.array(poses), world)

    def _scan(self, origin: np.ndarray, rng: np.random.Generator, rays: tuple[int, int]) -> np.ndarray:
        directions = fan(rays, rng)
        distance = np.minimum(
            cast(building(), origin, directions),
            cast(self.wing, (origin - self.corner) @ self.turn, directions @ self.turn),
        )
        hit = np.isfinite(distance) & (distance < 30)
        return directions[hit] * (distance[hit] + rng.normal(0, 0.008, int(hit.sum())))[:, None]


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

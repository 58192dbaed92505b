"""A house with a half level: two storeys of one room in the west, in the east one room between them.

A flight goes from the lower room up to the half level, another from there to the upper room. The same with a
wing at an angle to it; a gallery over a hall.
"""

from __future__ import annotations

import numpy as np

from tests.box_world import EYE, Box, Survey, survey
from tests.wing_world import DOOR, WingWorld
from tests.wing_world import EAST as FACE

UP, HIGH = 3.0, 2.7  # m from floor to floor, and from floor to ceiling
ROOF = UP + HIGH
WEST = (0.0, 0.0, 6.0, 6.0)  # inside of the western rooms: x0, y0, x1, y1
EAST = (6.2, 0.0, 11.2, 6.0)  # of the half level
LANDING = (6.2, 4.8, 8.6, 6.0)  # where the upper flight arrives, over the half level


def _flight(x0: float, x1: float, y0: float, y1: float, low: float, high: float, up: int) -> list[Box]:
    """Eight treads that rise towards +x or -x."""
    run, rise = (x1 - x0) / 8, (high - low) / 8
    starts = [x0 + k * run if up > 0 else x1 - (k + 1) * run for k in range(8)]
    return [(x, y0, low - 0.2, x + run, y1, low + (k + 1) * rise) for k, x in enumerate(starts)]


def boxes(half: float = 1.4) -> list[Box]:
    """The house, with the floor of its half level at ``half``."""
    top = half + HIGH
    return [
        (-0.2, -0.2, -0.2, 6.2, 6.2, 0.0),
        (-0.2, -0.2, HIGH, 6.1, 6.2, UP),
        (-0.2, -0.2, ROOF, 6.2, 6.2, ROOF + 0.2),
        (-0.2, -0.2, 0.0, 0.0, 6.2, ROOF),
        (-0.2, -0.2, 0.0, 11.4, 0.0, ROOF),
        (-0.2, 6.0, 0.0, 11.4, 6.2, ROOF),
        (11.2, -0.2, 0.0, 11.4, 6.2, ROOF),
        # the wall between: a door below, at y from 0.15 to 1.05, and one above, from 4.95 to 5.85
        (6.0, 0.0, 0.0, 6.2, 0.15, ROOF),
        (6.0, 0.15, 2.1, 6.2, 1.05, ROOF),
        (6.0, 1.05, 0.0, 6.2, 4.95, ROOF),
        (6.0, 4.95, 0.0, 6.2, 5.85, UP),
        (6.0, 4.95, UP + 2.1, 6.2, 5.85, ROOF),
        (6.0, 5.85, 0.0, 6.2, 6.0, ROOF),
        # the half level, its flights and its ceiling, which is open over the upper one
        (6.2, 1.2, half - 0.2, 11.4, 6.2, half),
        (8.2, -0.2, half - 0.2, 11.4, 1.2, half),
        *_flight(6.2, 8.2, 0.0, 1.2, 0.0, half, 1),
        *_flight(6.2, 8.6, 4.8, 6.0, half, UP, -1),
        (6.2, -0.2, top, 11.4, 4.8, top + 0.2),
        (8.6, 4.8, top, 11.4, 6.2, top + 0.2),
        (6.2, 4.8, ROOF, 8.6, 6.2, ROOF + 0.2),
        (8.6, 4.7, top, 8.7, 6.0, ROOF),
        (6.2, 4.7, top, 8.6, 4.8, ROOF),
    ]


def house(half: float = 1.4, roofed: bool = True) -> Survey:
    """Scans from a walk through all of it; the half level may be open to the sky."""
    solid = [b for b in boxes(half) if roofed or b[2] != half + HIGH or b[5] != half + HIGH + 0.2]
    return survey(solid, house_walk(half), noise=0.008, rays=(200, 60))


def house_walk(half: float) -> list[tuple[float, float, float]]:
    """Where the scanner stood."""
    below = [(1.5, 1.5), (4.5, 1.2), (4.4, 4.6), (1.4, 4.5), (5.4, 0.6), (6.1, 0.6)]
    between = [(8.6, 0.7), (10.0, 1.5), (10.0, 4.5), (7.5, 3.5), (9.2, 5.4)]
    above = [(6.1, 5.4), (5.0, 5.0), (4.5, 1.5), (1.5, 1.4), (1.5, 4.5)]
    return [
        *((x, y, EYE) for x, y in below),
        (7.2, 0.6, half / 2 + EYE),
        *((x, y, half + EYE) for x, y in between),
        (7.4, 5.4, half + 0.8 + EYE),
        *((x, y, UP + EYE) for x, y in above),
    ]


class SplitWithWing(WingWorld):
    """The house mirrored, so that a wing of one storey stands where its west was, behind a door."""

    hall = (4.0, 4.0)

    def __init__(self, degrees: float) -> None:
        super().__init__(degrees)
        start, end, lintel = DOOR
        mirrored = [(FACE - x1, y0, z0, FACE - x0, y1, z1) for x0, y0, z0, x1, y1, z1 in boxes()]
        self.building = [b for b in mirrored if b[0] != FACE or b[2] != 0.0] + [
            (FACE, -0.2, 0.0, FACE + 0.2, start, ROOF),
            (FACE, end, 0.0, FACE + 0.2, 6.2, ROOF),
            (FACE, start, lintel, FACE + 0.2, end, ROOF),
        ]

    def survey(self, yaw: float = 0.0, rays: tuple[int, int] = (200, 60), noise: float = 0.008) -> Survey:
        """The walk through the house, and one through the wing; the world is not turned."""
        inside = house_walk(1.4)
        own = np.column_stack(
            [[(1.4, 2.2), (2.9, 2.6), (3.7, 3.05), (5.6, 1.4), (5.5, 2.8)], np.full(5, EYE)]
        )
        mirrored = [(FACE - x, y, z) for x, y, z in [*inside, (-0.1, 2.5, EYE)]]
        rng, out, ids, poses = np.random.default_rng(2), [], [], []
        for k, place in enumerate(np.vstack([mirrored, self.world(own)])):
            points = self._scan(place, rng, rays, noise)
            pose = np.eye(4)
            pose[:3, 3] = place
            out.append(points + place)
            ids.append(np.full(len(points), k, dtype=np.int32))
            poses.append(pose)
        return Survey(np.concatenate(out), np.concatenate(ids), np.array(poses), np.eye(3))


def gallery(edge: float, parapet: float) -> Survey:
    """A hall of 10 x 8 m over two storeys; a gallery over its north, from y = ``edge`` on."""
    solid = [
        (-0.2, -0.2, -0.2, 10.2, 8.2, 0.0),
        (-0.2, -0.2, 6.0, 10.2, 8.2, 6.2),
        (-0.2, -0.2, 0.0, 0.0, 8.2, 6.0),
        (10.0, -0.2, 0.0, 10.2, 8.2, 6.0),
        (-0.2, -0.2, 0.0, 10.2, 0.0, 6.0),
        (-0.2, 8.0, 0.0, 10.2, 8.2, 6.0),
        (0.0, edge, 2.7, 10.0, 8.0, UP),
        (0.0, edge, UP, 10.0, edge + 0.1, UP + parapet),
    ]
    below = [(2.0, 2.0), (8.0, 2.0), (5.0, 4.0), (2.0, 6.5), (8.0, 6.5)]
    above = [(2.0, 6.5), (5.0, 7.0), (8.0, 6.2)]
    places = [(x, y, EYE) for x, y in below] + [(x, y, UP + EYE) for x, y in above]
    return survey(solid, places, noise=0.008, rays=(240, 80))

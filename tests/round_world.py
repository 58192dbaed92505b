"""A round atrium north of a corridor, two rooms south of it: a wall that stands on no plane of the frame."""

from __future__ import annotations

import numpy as np
import shapely

from tests.box_world import EYE, HEIGHT, LINTEL, Box, Survey, cast, rotation, slabs, wall
from tests.wing_world import fan

RADIUS = 5.4  # m, of the atrium's inner face
LENGTH, WIDE, THICK, DEEP = 16.0, 2.0, 0.2, 4.0  # m: corridor, its walls, depth of the rooms
CENTRE = np.array([8.0, WIDE + THICK + RADIUS])
DOOR = (7.4, 8.6)  # m along the corridor, into the atrium
ROOM_DOORS = ((3.0, 3.9, LINTEL), (12.0, 12.9, LINTEL))


def boxes() -> list[Box]:
    """All that is straight: the corridor, two rooms, floor and ceiling."""
    t, south, middle = THICK, -THICK - DEEP, LENGTH / 2
    return [
        *slabs(-t, south - t, LENGTH + t, CENTRE[1] + RADIUS + t),
        *wall(1, WIDE, WIDE + t, -t, LENGTH + t, (*DOOR, LINTEL)),
        *((x, WIDE + t, 0.0, x + 0.03, WIDE + t + 0.05, HEIGHT) for x in (DOOR[0] - 0.03, DOOR[1])),  # jambs
        *wall(1, -t, 0.0, -t, LENGTH + t, *ROOM_DOORS),
        *wall(1, south - t, south, -t, LENGTH + t),
        *wall(0, -t, 0.0, south, WIDE),
        *wall(0, LENGTH, LENGTH + t, south, WIDE),
        *wall(0, middle - 0.05, middle + 0.05, south, -t),
    ]


def atrium() -> shapely.Polygon:
    """The floor of the atrium."""
    return shapely.Point(CENTRE).buffer(RADIUS, quad_segs=64)


def corridor() -> shapely.Polygon:
    """The floor of the corridor."""
    return shapely.box(0, 0, LENGTH, WIDE)


def cast_round(origin: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """(N,) distance along (N, 3) unit directions to the round wall, which has a doorway in the south."""
    from_centre = origin[:2] - CENTRE
    a = (directions[:, :2] ** 2).sum(axis=1)
    b = directions[:, :2] @ from_centre
    root = b**2 - a * (from_centre @ from_centre - RADIUS**2)
    best = np.full(len(directions), np.inf)
    with np.errstate(invalid="ignore", divide="ignore"):
        for sign in (-1, 1):
            t = (-b + sign * np.sqrt(root)) / a
            at = origin + t[:, None] * directions
            inside = (at[:, 0] > DOOR[0]) & (at[:, 0] < DOOR[1]) & (at[:, 1] < CENTRE[1])
            passes = inside & (at[:, 2] < LINTEL)
            stands = (t > 1e-6) & ~passes & (at[:, 2] > 0) & (at[:, 2] < HEIGHT)
            best = np.where(stands & (t < best), t, best)
    return best


def survey(yaw: float = 0.0, rays: tuple[int, int] = (360, 90), noise: float = 0.008) -> Survey:
    """Scans from a walk through corridor, rooms and atrium; the world is turned by ``yaw`` degrees."""
    cx, cy = CENTRE
    places = [(1.0, 1.0), (4.5, 0.9), (8.0, 1.1), (11.5, 1.0), (15.0, 1.1)]
    places += [(2.5, -2.2), (5.8, -3.0), (10.5, -2.0), (14.0, -2.8), (3.45, -0.1), (12.45, -0.1), (8.0, 2.1)]
    places += [(cx, cy - 3), (cx - 3, cy), (cx, cy + 3), (cx + 3, cy), (cx, cy)]
    rng, world = np.random.default_rng(4), rotation(yaw)
    out, ids, poses = [], [], []
    for k, place in enumerate(places):
        origin, directions, pose = np.array([*place, EYE]), fan(rays, rng), np.eye(4)
        distance = np.minimum(cast(boxes(), origin, directions), cast_round(origin, directions))
        hit = np.isfinite(distance) & (distance < 30)
        reach = distance[hit] + rng.normal(0, noise, int(hit.sum()))
        out.append((origin + directions[hit] * reach[:, None]) @ world.T)
        ids.append(np.full(int(hit.sum()), k, dtype=np.int32))
        pose[:3, :3], pose[:3, 3] = world, world @ origin
        poses.append(pose)
    return Survey(np.concatenate(out), np.concatenate(ids), np.array(poses), world)

"""Two rooms side by side with a door between them, two scans in each: enough for a plan in a second.

The scans in the second room look back through the door: without it nobody could tell a door from a gap in the
data. Those in the first do not, so that the second room is new when it is entered.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

WIDTH, DEPTH, HEIGHT, WALL = 4.0, 5.0, 2.6, 0.2  # metres
DOOR = (2.0, 3.0, 2.1)  # from, to along the wall, and the height of the lintel
SECONDS_BETWEEN_SCANS = 10.0


def write_survey(folder: Path, spacing: float = 0.05) -> Path:
    """Write ``points.ply`` and ``trajectory.tum`` into ``folder``; returns the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    rooms = [_room(k * (WIDTH + WALL), door_at_end=k == 0, spacing=spacing) for k in range(2)]
    rooms[1] = np.concatenate([rooms[1], _through_the_door(rooms[0], _sensor(1))])
    scans = [scan for room in rooms for scan in np.array_split(room, 2)]  # two scans in each room
    table = np.zeros(sum(map(len, scans)), dtype=[("xyz", "<f4", 3), ("scan_id", "<i4")])
    table["xyz"] = np.concatenate(scans)
    table["scan_id"] = np.repeat(np.arange(len(scans)), [len(s) for s in scans])
    header = [
        "ply",
        "format binary_little_endian 1.0",
        f"element vertex {len(table)}",
        *(f"property float {axis}" for axis in "xyz"),
        "property int scan_id",
        "end_header\n",
    ]
    (folder / "points.ply").write_bytes("\n".join(header).encode() + table.tobytes())
    rows = [
        f"{100 + SECONDS_BETWEEN_SCANS * i} {' '.join(map(str, _sensor(i // 2)))} 0 0 0 1"
        for i in range(len(scans))
    ]
    (folder / "trajectory.tum").write_text("\n".join(rows) + "\n")
    return folder


def _sensor(room: int) -> tuple[float, float, float]:
    """Where the sensor stands in a room."""
    return WIDTH / 2 + room * (WIDTH + WALL), DEPTH / 2, 1.4


def _through_the_door(points: np.ndarray, sensor: tuple[float, float, float]) -> np.ndarray:
    """The points of the other room whose rays pass the opening in both faces of the wall."""
    ray = points - sensor
    passed = np.ones(len(points), dtype=bool)
    for face in (WIDTH, WIDTH + WALL):
        at = sensor + ray * ((face - sensor[0]) / ray[:, :1])
        passed &= (at[:, 1] > DOOR[0]) & (at[:, 1] < DOOR[1]) & (at[:, 2] < DOOR[2])
    return points[passed]


def _room(x0: float, door_at_end: bool, spacing: float) -> np.ndarray:
    """(N, 3) points on the six faces of a room that begins at ``x0``, shuffled; its door is left out."""
    x, y, z = (np.arange(spacing / 2, size, spacing) for size in (WIDTH, DEPTH, HEIGHT))
    faces = [_grid(x, y, [0.0, HEIGHT]), _grid(x, [0.0, DEPTH], z), _grid([0.0, WIDTH], y, z)]
    points = np.concatenate(faces)
    wall = points[:, 0] == (WIDTH if door_at_end else 0.0)
    opening = (points[:, 1] > DOOR[0]) & (points[:, 1] < DOOR[1]) & (points[:, 2] < DOOR[2])
    points = points[~(wall & opening)] + [x0, 0.0, 0.0]
    rng = np.random.default_rng(int(x0))
    return rng.permutation(points + rng.normal(0, 0.003, points.shape))


def _grid(*axes: object) -> np.ndarray:
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)

"""Grid maps drawn for the tests: a small office with exact dimensions, in any direction, with furniture."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, GridMap

CELL = 0.05
MARGIN = 1.0  # m of unknown around the building
GREY = {int(UNOBSERVED): 205, int(FREE): 254, int(OCCUPIED): 0}

Box = tuple[float, float, float, float]

# Interior faces, metres from the lower left corner of the building; walls of 0.2 m between them.
ROOMS: dict[str, Box] = {
    "south west": (0.2, 0.2, 4.0, 3.4),
    "south middle": (4.2, 0.2, 7.0, 3.4),
    "south east": (7.2, 0.2, 11.8, 3.4),
    "corridor": (0.2, 3.6, 11.8, 5.2),
    "north west": (0.2, 5.4, 6.0, 8.8),
    "north east": (6.2, 5.4, 11.8, 8.8),
}
DOORS: tuple[Box, ...] = (
    (1.0, 3.4, 1.9, 3.6),
    (5.0, 3.4, 5.9, 3.6),
    (10.8, 3.4, 11.8, 3.6),  # in the corner of its room
    (2.0, 5.2, 2.8, 5.4),
    (9.0, 5.2, 10.2, 5.4),
)
SIZE = (12.0, 9.0)


def office(extra: tuple[Box, ...] = (), name: str = "office") -> GridMap:
    """The office with a known 1 m around it; ``extra`` boxes are occupied."""
    nx, ny = (round((v + 2 * MARGIN) / CELL) for v in SIZE)
    states = np.full((ny, nx), UNOBSERVED, dtype=np.uint8)
    fill(states, (0.0, 0.0, *SIZE), OCCUPIED)
    for box in (*ROOMS.values(), *DOORS):
        fill(states, box, FREE)
    for box in extra:
        fill(states, box, OCCUPIED)
    return GridMap(name, states, CELL, (-MARGIN, -MARGIN))


def fill(states: NDArray[np.uint8], box: Box, state: np.uint8) -> None:
    """Set the cells of a box, metres from the corner of the building."""
    x0, y0, x1, y1 = (round((v + MARGIN) / CELL) for v in box)
    states[y0:y1, x0:x1] = state


def turned(source: GridMap, degrees: float) -> GridMap:
    """The same walls in a map whose axes are turned against the building, by nearest cells."""
    angle = math.radians(degrees)
    c, s = math.cos(angle), math.sin(angle)
    ny, nx = source.states.shape
    side = int(np.ceil(np.hypot(nx, ny))) + 2
    y, x = np.mgrid[0:side, 0:side] + 0.5 - side / 2
    ix = np.floor(c * x + s * y + nx / 2).astype(int)
    iy = np.floor(-s * x + c * y + ny / 2).astype(int)
    inside = (ix >= 0) & (iy >= 0) & (ix < nx) & (iy < ny)
    states = np.full((side, side), UNOBSERVED, dtype=np.uint8)
    states[inside] = source.states[iy[inside], ix[inside]]
    return GridMap(source.name, states, source.resolution)


def write_image(source: GridMap, path: Path) -> Path:
    """As a grey picture in the values of ROS; the first row is the top."""
    from PIL import Image

    grey = np.vectorize(GREY.get, otypes=[np.uint8])(source.states[::-1])
    Image.fromarray(grey).save(path)
    return path


def write_yaml(source: GridMap, folder: Path, more: str = "") -> Path:
    """A ROS map: ``map.yaml`` with ``map.pgm``."""
    write_image(source, folder / "map.pgm")
    path = folder / "map.yaml"
    x, y = source.origin
    path.write_text(
        f"image: map.pgm\nresolution: {source.resolution}\norigin: [{x}, {y}, {source.yaw}]\n"
        f"negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n{more}",
        encoding="utf-8",
    )
    return path

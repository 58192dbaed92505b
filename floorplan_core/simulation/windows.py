"""Windows: rows of glazed holes where a wall has the open air behind it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.building import Space, WindowOpening
from floorplan_core.simulation.circulation import Walls, mm
from floorplan_core.simulation.doors import NARROW
from floorplan_core.simulation.spec import BuildingSpec

Float = NDArray[np.float64]

FACADE = 1.5  # m of free air in front of a window


def make_windows(
    spaces: tuple[Space, ...], spec: BuildingSpec, walls: Walls, rng: np.random.Generator
) -> tuple[WindowOpening, ...]:
    """Windows where a wall has the open air behind it."""
    rects = np.vstack([s.rects for s in spaces])
    made = []
    for index, space in enumerate(spaces):
        for axis, face, start, end in _facades(space, rects, walls.exterior):
            made += _window_row(index, space.use, axis, face, (start, end), spec, walls, rng)
    return tuple(made)


def _facades(
    space: Space, rects: Float, thickness: float
) -> Iterator[tuple[int, tuple[float, float], float, float]]:
    """Exterior stretches of a space: axis, wall faces by coordinate, start, end."""
    for rect in space.rects:
        for axis in (0, 1):
            for face, out in ((rect[axis], -1), (rect[axis + 2], 1)):
                strip = sorted((face + out * 0.01, face + out * (thickness + FACADE)))
                taken = _shadows(rects, axis, strip, thickness if out else 0.0)
                wall = tuple(sorted((float(face), mm(face + out * thickness))))
                for start, end in _gaps(rect[1 - axis], rect[3 - axis], taken):
                    yield axis, (wall[0], wall[1]), start, end


def _shadows(rects: Float, axis: int, strip: list[float], margin: float) -> list[tuple[float, float]]:
    """Intervals along the wall behind which another space lies within the strip."""
    other = 1 - axis
    hit = (rects[:, axis] < strip[1]) & (rects[:, axis + 2] > strip[0])
    return [(r[other] - margin, r[other + 2] + margin) for r in rects[hit]]


def _gaps(start: float, end: float, taken: list[tuple[float, float]]) -> Iterator[tuple[float, float]]:
    """What is left of start .. end without the taken intervals."""
    for a, b in sorted(taken):
        if a > start:
            yield start, min(a, end)
        start = max(start, b)
        if start >= end:
            return
    yield start, end


def _window_row(
    index: int,
    use: str,
    axis: int,
    wall: tuple[float, float],
    stretch: tuple[float, float],
    spec: BuildingSpec,
    walls: Walls,
    rng: np.random.Generator,
) -> list[WindowOpening]:
    """Equal windows along a facade, each built with the spec's probability."""
    length = stretch[1] - stretch[0]
    wide = 0.6 if use in NARROW else rng.uniform(1.0, 2.2)
    wide = min(wide, length - 0.6)
    if wide < 0.5:
        return []
    count = max(1, int(length / (wide + rng.uniform(0.6, 1.2))))
    sill, head = mm(rng.uniform(0.8, 1.0)), mm(min(rng.uniform(2.1, 2.4), walls.height - 0.15))
    if use in NARROW:
        sill = mm(rng.uniform(1.2, 1.5))
    if use == "corridor" and rng.random() < 0.5:
        sill = mm(rng.uniform(0.05, 0.3))  # glazed to the floor
    middles = stretch[0] + length * (np.arange(count) + 0.5) / count
    built = rng.random(count) < spec.windows
    spans = [(mm(m - wide / 2), mm(m + wide / 2)) for m in middles[built]]
    return [
        WindowOpening(
            (wall[0], a, wall[1], b) if axis == 0 else (a, wall[0], b, wall[1]), axis, index, sill, head
        )
        for a, b in spans
    ]

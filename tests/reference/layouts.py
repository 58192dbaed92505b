"""Random layouts: coarse steps make ties, duplicates and planes on cell centres frequent."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from floorplan_core.config import CandidatesConfig
from floorplan_core.model import OccupancyGrid

CELL = 0.25


@dataclass(frozen=True)
class RandomLayout:
    """Everything that the candidates are made from."""

    planes: tuple[np.ndarray, ...]  # x_plus, x_minus, y_plus, y_minus
    blockers: np.ndarray
    grid: OccupancyGrid
    config: CandidatesConfig


def random_layout(seed: int, cells: int = 16, most_planes: int = 6) -> RandomLayout:
    """A layout of about 3.5 m; one in ten is degenerate (no cells, no planes of a facing)."""
    rng = np.random.default_rng(seed)
    least = 0 if seed % 10 == 0 else 3
    shape = rng.integers(2 * least, cells, 2)
    universe = rng.random(shape) < rng.random()
    origin = np.round(rng.normal(0, 1, 2), 1)
    grid = OccupancyGrid(origin, CELL, universe.astype(np.uint8), universe, 1.0)
    step = rng.choice([0.25, 0.125, 0.01])
    planes = tuple(
        np.sort(np.round(rng.uniform(-1.5, 4.5, rng.integers(least, most_planes + 1)) / step) * step)
        for _ in range(4)
    )
    return RandomLayout(planes, _blockers(rng, step), grid, _config(rng))


def _blockers(rng: np.random.Generator, step: float) -> np.ndarray:
    """(B, 4) boxes and lines."""
    count = rng.integers(0, 5)
    low = np.round(rng.uniform(-1.5, 5, (count, 2)) / step) * step
    size = np.round(rng.exponential(1, (count, 2)) / step) * step
    size[np.arange(count), rng.integers(0, 2, count)] *= rng.random(count) < 0.3
    return np.column_stack([low, low + size])


def _config(rng: np.random.Generator) -> CandidatesConfig:
    """Settings at which many rectangles are valid."""
    return CandidatesConfig(
        min_side=0.5,
        tolerance=float(rng.choice([0.0, 0.15, 0.25])),
        max_ratio=float(rng.choice([1.5, 4.0, 20.0, 1000.0])),
    )

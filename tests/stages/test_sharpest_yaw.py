"""The sharpest yaw: normals that mislead are overruled, those that are nearly as good are not."""

from __future__ import annotations

import math

import numpy as np
import pytest

from floorplan_core.geometry.cell_normals import CellNormals
from floorplan_core.geometry.surfel_map import SurfelMap, Surfels
from floorplan_core.stages.sharpest_yaw import rough_yaw, wrap
from tests.box_world import rotation


def _walls(yaw_deg: float, size: tuple[float, float] = (8.0, 6.0), at: float = 0.0) -> np.ndarray:
    """(N, 3) points of the four walls of a room, 2.5 m high, 2 cm of noise."""
    rng = np.random.default_rng(1)
    run, side = rng.uniform(0, 1, 24_000), rng.integers(0, 2, 24_000)
    along = np.column_stack([run, side]) * size
    across = np.column_stack([side, run]) * size
    points = np.concatenate([along, across]) + rng.normal(0, 0.02, (48_000, 2))
    points = np.column_stack([points - np.array(size) / 2, rng.uniform(0, 2.5, len(points))])
    return points @ rotation(yaw_deg).T + np.array([at, 0, 0])


def _surfels(points: np.ndarray) -> tuple[Surfels, CellNormals]:
    table = SurfelMap(0.05)
    table.insert(points, np.full(len(points), -1, dtype=np.int32), np.zeros((0, 3)), (0.05, 30.0))
    surfels = table.surfels()
    nowhere = np.full(len(surfels), -1, dtype=np.int32)
    return surfels, CellNormals(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0), nowhere, 0.0)


def _rough(points: np.ndarray, coarse_deg: float) -> float:
    return math.degrees(rough_yaw(*_surfels(points), np.eye(3), math.radians(coarse_deg)))


@pytest.mark.parametrize("yaw", [-44.5, -17, 0, 31, 44.5])
@pytest.mark.parametrize("off", [6, -15, 40])
def test_normals_that_are_off_are_overruled(yaw, off):
    found = _rough(_walls(yaw), yaw + off)
    assert abs(math.degrees(wrap(math.radians(found - yaw)))) <= 1.0


def test_normals_near_the_summit_are_kept_as_they_are():
    assert _rough(_walls(12), 13.7) == pytest.approx(13.7)


def test_of_two_wings_alike_the_normals_choose():
    both = np.concatenate([_walls(0), _walls(30, at=20.0)])
    assert _rough(both, 0.3) == pytest.approx(0.3)
    assert _rough(both, 29.5) == pytest.approx(29.5)

"""The inner faces of slabs: found where a model shows both faces, never made of what a scan sees."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.geometry.surfel_map import SurfelMap, Surfels
from floorplan_core.stages.slab_faces import inner_faces

CEILING, SIDE = 2.6, (6.0, 4.0)  # m


def surface(z: float, low=(0.0, 0.0), high=SIDE, noise: float = 0.0) -> np.ndarray:
    """(N, 3) points 2.5 cm apart at one height."""
    x, y = np.meshgrid(*(np.arange(a + 0.0125, b, 0.025) for a, b in zip(low, high, strict=True)))
    xyz = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, z)])
    return xyz + np.random.default_rng(3).normal(0, noise, xyz.shape) if noise else xyz


def walls() -> np.ndarray:
    """The walls across x, from below the floor to above the ceiling."""
    y, z = np.meshgrid(np.arange(0.0125, SIDE[1], 0.025), np.arange(-0.3, CEILING + 0.3, 0.025))
    sides = [np.column_stack([np.full(y.size, x), y.ravel(), z.ravel()]) for x in (0.01, SIDE[0] - 0.01)]
    return np.concatenate(sides)


def surfels(*parts: np.ndarray, every: int = 1, sensor: np.ndarray | None = None) -> Surfels:
    points = np.concatenate(parts)
    table = SurfelMap(0.05)
    origins = np.zeros((0, 3)) if sensor is None else sensor[None]
    ids = np.full(len(points), -1 if sensor is None else 0, dtype=np.int32)
    table.insert(points, ids, origins, (0.05, 30.0))
    return table.surfels(every)


@pytest.mark.parametrize("every", [1, 3])
@pytest.mark.parametrize("thick", [0.1, 0.2, 0.35, 0.5])
def test_slabs_with_both_faces_are_bounded_by_the_inner_ones(thick, every):
    outer = -thick, CEILING + thick
    faces = surfels(*(surface(z) for z in (0.0, CEILING, *outer)), walls(), every=every)
    floor, ceiling = inner_faces(faces, np.eye(3), *outer)
    assert floor == pytest.approx(0, abs=0.005)
    assert ceiling == pytest.approx(CEILING, abs=0.005)


def test_inner_faces_stay_what_they_are():
    faces = surfels(*(surface(z) for z in (0.0, CEILING, -0.2, CEILING + 0.2)), walls())
    assert inner_faces(faces, np.eye(3), 0.0, CEILING) == (0.0, CEILING)


def test_no_ceiling_is_none():
    assert inner_faces(surfels(surface(0.0), walls()), np.eye(3), 0.0, None) == (0.0, None)


@pytest.mark.parametrize(
    "parts",
    [
        [surface(0.0, high=(3.0, 4.0)), surface(0.3, low=(3.0, 0.0))],  # a floor with a step
        [surface(0.0), surface(0.4, low=(1.0, 1.0), high=(4.0, 3.0))],  # a bed
        [surface(0.0, noise=0.05)],
    ],
    ids=["step", "furniture", "noise"],
)
def test_scans_have_one_face(parts):
    assert inner_faces(surfels(*parts, walls()), np.eye(3), 0.0, CEILING) == (0.0, CEILING)


def test_a_second_floor_that_a_sensor_saw_is_drift():
    twice = surfels(surface(0.0), surface(0.2), walls(), sensor=np.array([3.0, 2.0, 1.4]))
    assert inner_faces(twice, np.eye(3), 0.0, CEILING) == (0.0, CEILING)

"""Heights of regions: the level that holds more surface than the walls explain."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.stages.region_heights import _LEVEL, _LOWEST, _ceiling


def levels(z: np.ndarray) -> np.ndarray:
    return np.bincount(((z - _LOWEST) / _LEVEL).astype(int), minlength=2000)


@pytest.mark.parametrize("height", [2.2, 2.654, 3.5, 6.0])
def test_a_ceiling_among_walls(height: float) -> None:
    rng = np.random.default_rng(1)
    walls = rng.uniform(_LOWEST, height, 3000)
    ceiling = rng.normal(height, 0.01, 4000)
    z = np.concatenate([walls, ceiling])
    assert _ceiling(levels(z[z > _LOWEST]), 200) == pytest.approx(height, abs=0.004)


def test_walls_alone_are_no_ceiling() -> None:
    assert _ceiling(levels(np.random.default_rng(2).uniform(_LOWEST, 2.7, 5000)), 200) is None
    assert _ceiling(np.zeros(2000, dtype=np.int64), 200) is None


def test_a_scrap_is_no_ceiling() -> None:
    assert _ceiling(levels(np.full(50, 2.6)), 200) is None

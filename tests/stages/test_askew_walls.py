"""Patches of walls: those of a large site, which is looked at strip by strip, are those of a small one."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from floorplan_core.config import FrameConfig
from floorplan_core.stages import askew_walls
from floorplan_core.stages.askew_walls import in_band, wall_patches


@pytest.mark.parametrize("noise", [0.002, 0.06])
def test_strips_change_nothing(noise: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Walls of 90 m along x and of 30 m at an angle; where they are noisy, patches are wider."""
    rng = np.random.default_rng(0)
    along, z = rng.uniform(0, 90, 120_000), rng.uniform(0, 2.8, 120_000)
    slanted = rng.uniform(0, 30, 40_000)
    straight = np.column_stack([along, np.zeros_like(along), z])
    other = np.column_stack([5 + 0.8 * slanted, 3 + 0.6 * slanted, z[: len(slanted)]])
    xyz = np.concatenate([straight, other]) - (40.0, 0.0, 0.0) + rng.normal(0, noise, (160_000, 3))
    rows, config = in_band(xyz[:, 2]), FrameConfig()
    whole = wall_patches(xyz, rows, 0.05, config)
    monkeypatch.setattr(askew_walls, "_AT_ONCE", 10_000)
    strips = wall_patches(xyz, rows, 0.05, config)
    assert strips.cell == whole.cell and len(whole.xy) > 100
    a, b = (np.lexsort(w.xy.T) for w in (whole, strips))
    for name in ("xy", "area", "angle"):
        assert getattr(strips, name)[b] == pytest.approx(getattr(whole, name)[a], abs=1e-9)
    assert sorted(map(tuple, strips.surfels)) == sorted(map(tuple, whole.surfels))
    assert {f.name for f in fields(whole)} == {*askew_walls._ARRAYS, "cell"}

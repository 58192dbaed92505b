"""What a side of a region tells about itself: the residual of the surfaces seen along it."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from floorplan_core.model import Facing, LayoutPlane, LayoutSegment
from floorplan_core.stages.region_sides import WallSurfaces, sides_of
from floorplan_core.stages.side_measures import residual_of


def surface(offset: float, length: float, residual: float) -> list[float]:
    return [offset, length, residual]


def _residual(seen: np.ndarray, at: float) -> float:
    """Of a side at ``at`` along which the surfaces were seen."""
    return float(residual_of(np.column_stack([seen[:, 1], np.abs(seen[:, 0] - at), seen[:, 2]])))


def test_one_surface_keeps_its_own_residual() -> None:
    assert _residual(np.array([surface(2.0, 3.0, 0.012)]), 2.0) == pytest.approx(0.012, abs=2e-4)


def test_a_side_off_its_surface_is_worse() -> None:
    residual = _residual(np.array([surface(2.0, 3.0, 0.012)]), 2.03)
    assert residual == pytest.approx(0.03 + 1.645 * 0.012 / 1.96, abs=1e-3)  # one tail counts, far away


def test_sampled_points_agree() -> None:
    rng = np.random.default_rng(7)
    seen = np.array([surface(0.0, 4.0, 0.02), surface(0.015, 2.0, 0.01), surface(0.1, 0.5, 0.03)])
    n = (40_000 * seen[:, 1]).astype(int)
    points = np.concatenate([rng.normal(o, r / 1.96, k) for (o, _, r), k in zip(seen, n, strict=True)])
    assert _residual(seen, 0.005) == pytest.approx(np.percentile(np.abs(points - 0.005), 95), abs=5e-4)


def test_nothing_seen_has_no_residual() -> None:
    assert np.isnan(_residual(np.zeros((0, 3)), 1.0))
    room = shapely.orient_polygons(shapely.box(0, 0, 8, 2))
    assert all(s.residual is None for s in sides_of(room, WallSurfaces([], []), ()))


def test_a_pane_behind_a_side_counts_as_seen_but_does_not_move_it() -> None:
    wall = LayoutPlane("p1", Facing.EAST, 0.0, ("s1",), 3.0)
    pane = LayoutPlane("p2", Facing.EAST, -0.1, ("s2",), 1.0, recess=True)
    seen = [
        LayoutSegment("s1", Facing.EAST, 0.0, 3.0, 9.0, 0.2, 2.5, 3.0, 300, 0.01, 0.001, plane="p1"),
        LayoutSegment("s2", Facing.EAST, -0.1, 0.2, 1.7, 0.9, 2.0, 1.0, 100, 0.01, 0.001, plane="p2"),
    ]
    corridor = shapely.orient_polygons(shapely.box(0, 0, 8, 2))
    walls = WallSurfaces([wall, pane], seen)
    (side,) = (s for s in sides_of(corridor, walls, ()) if s.start[0] == s.end[0] == 0.0)
    assert side.observed == pytest.approx(1.5 / 2.0)
    assert not side.speculated
    assert walls.fit(corridor).bounds[0] == 0.0


def test_a_surface_far_behind_a_side_is_another_wall() -> None:
    far = LayoutPlane("p2", Facing.EAST, -0.6, ("s2",), 1.0, recess=True)
    seen = LayoutSegment("s2", Facing.EAST, -0.6, 0.0, 2.0, 0.9, 2.0, 1.0, 100, 0.01, 0.001, plane="p2")
    corridor = shapely.orient_polygons(shapely.box(0, 0, 8, 2))
    sides = sides_of(corridor, WallSurfaces([far], [seen]), ())
    assert all(s.observed == 0.0 for s in sides)

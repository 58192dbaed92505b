"""One wall with a gap in it, seen from both sides."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, Facing, LayoutPlane, WallProfile
from floorplan_core.stages.narrowings import find_narrowings

CONFIG, STEP = DoorsConfig(), 0.05
Runs = list[tuple[float, float]]


def face(name: str, facing: Facing, offset: float, runs: Runs, passed: bool = True) -> LayoutPlane:
    """Wall along 0 .. 12 m where ``runs`` say, seen through elsewhere."""
    at = STEP * (np.arange(240) + 0.5)
    wall = np.any([(at > s) & (at < e) for s, e in runs], axis=0)
    through = np.where(wall, 0.0, float(passed))
    profile = WallProfile(0.0, STEP, np.where(wall, 0.8, 0.0), np.zeros(240), through)
    return LayoutPlane(name, facing, offset, profile=profile, support=5.0, walls=np.array(runs))


def wall(runs: Runs, passed: bool = True) -> list[LayoutPlane]:
    """Across x, 4.0 to 4.12."""
    return [face("a", Facing.WEST, 4.0, runs, passed), face("b", Facing.EAST, 4.12, runs, passed)]


FREE_ENDS: Runs = [(0.0, 5.0), (8.0, 10.0)]


def test_two_wall_ends_make_an_opening() -> None:
    (found,) = find_narrowings(wall(FREE_ENDS), (), CONFIG)
    assert (found.axis, found.kind, found.planes) == (0, "opening", ("a", "b"))
    assert (found.offset, found.start, found.end) == pytest.approx((4.06, 5.0, 8.0))
    assert found.thickness == pytest.approx(0.12)
    assert CONFIG.min_confidence < found.confidence < 1.0


def test_an_end_at_a_wall_across_is_a_corner() -> None:
    corner = face("c", Facing.NORTH, 4.8, [(4.1, 9.0)])
    assert not find_narrowings([*wall(FREE_ENDS), corner], (), CONFIG)


def test_a_wall_across_far_from_the_end_is_none() -> None:
    across = face("c", Facing.NORTH, 3.0, [(4.1, 9.0)])
    assert len(find_narrowings([*wall(FREE_ENDS), across], (), CONFIG)) == 1


@pytest.mark.parametrize(
    "runs", [[(0.0, 3.0), (8.0, 10.0)], [(0.0, 5.0), (5.5, 10.0)], [(0.0, 5.0), (8.0, 8.4)]]
)
def test_too_wide_too_narrow_or_too_short_an_end(runs: Runs) -> None:
    assert not find_narrowings(wall(runs), (), CONFIG)


def test_a_gap_in_the_data_is_no_opening() -> None:
    assert not find_narrowings(wall(FREE_ENDS, passed=False), (), CONFIG)


def test_one_face_alone_is_no_wall() -> None:
    assert not find_narrowings(wall(FREE_ENDS)[:1], (), CONFIG)


def test_two_walls_far_apart_are_not_two_faces() -> None:
    far = face("b", Facing.EAST, 6.0, FREE_ENDS)
    assert not find_narrowings([wall(FREE_ENDS)[0], far], (), CONFIG)


def test_a_door_that_is_known_stays_one_door() -> None:
    known = Door("d1", ("a", "b"), 0, 4.06, 5.1, 7.9, thickness=0.12)
    assert not find_narrowings(wall(FREE_ENDS), (known,), CONFIG)

"""The confidence of a region: a probability that rises with what was seen of it."""

from __future__ import annotations

from itertools import pairwise

import pytest

from floorplan_core.model import RegionSide
from floorplan_core.stages.region_confidence import measures_of, probability, share_seen


def _square(*observed: float) -> tuple[RegionSide, ...]:
    """Four sides of 4 m of which those shares were seen."""
    corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (0.0, 0.0)]
    ends = zip(pairwise(corners), observed, strict=True)
    return tuple(RegionSide(a, b, "", seen) for (a, b), seen in ends)


def test_measures_are_shares_of_the_boundary_of_the_floor_and_of_four_square_metres() -> None:
    measures = measures_of(_square(1.0, 1.0, 0.0, 0.0), free=200, total=1600, area=16.0)
    assert measures == pytest.approx((0.5, 0.125, 0.5))
    assert share_seen(measures) == pytest.approx(0.312, abs=1e-3)


def test_a_room_seen_whole_is_nearly_certain_and_a_patch_behind_a_door_is_not() -> None:
    whole = probability(measures_of(_square(1, 1, 1, 1), 1600, 1600, 16.0))
    patch = probability(measures_of(_square(0.2, 0, 0, 0), 50, 1600, 16.0))
    assert whole > 0.99
    assert 0.4 < patch < 0.7


@pytest.mark.parametrize("k", [0, 1, 2])
def test_more_seen_is_never_less_sure(k: int) -> None:
    less, more = [0.3, 0.3, 0.3], [0.3, 0.3, 0.3]
    more[k] = 0.6
    assert probability(more) > probability(less)


def test_a_region_without_cells_or_sides_has_a_probability() -> None:
    assert 0 < probability(measures_of((), 0, 0, 0.0)) < 1

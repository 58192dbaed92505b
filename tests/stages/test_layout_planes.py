"""Which runs along a plane are wall, from what was seen along it."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import DoorsConfig, PlanesConfig
from floorplan_core.model import WallProfile
from floorplan_core.stages.layout_planes import wall_runs

STEP = 0.05
Parts = dict[tuple[float, float], float]


def runs(low: Parts, through: Parts | None = None, high: Parts | None = None) -> list[list[float]]:
    """Wall runs of a plane of 10 m of which the parts were seen so well."""
    at = STEP * (np.arange(200) + 0.5)

    def paint(parts: Parts | None) -> np.ndarray:
        values = np.zeros(200)
        for (start, end), value in (parts or {}).items():
            values[(at > start) & (at < end)] = value
        return values

    profile = WallProfile(0.0, STEP, paint(low), paint(high), paint(through))
    return wall_runs(profile, PlanesConfig(), DoorsConfig()).tolist()


def test_one_wall_is_one_run() -> None:
    assert runs({(2.0, 6.0): 0.9}) == [pytest.approx([2.0, 6.0])]


def test_what_was_hidden_between_two_parts_is_wall() -> None:
    assert runs({(2.0, 4.0): 0.9, (5.5, 8.0): 0.9}) == [pytest.approx([2.0, 8.0])]


def test_what_was_seen_through_is_open() -> None:
    parts: Parts = {(2.0, 4.0): 0.9, (5.5, 8.0): 0.9}
    assert len(runs(parts, through={(4.0, 5.5): 1.0})) == 2


def test_a_lintel_that_was_not_seen_beside_its_jambs_is_part_of_the_wall() -> None:
    parts: Parts = {(2.0, 4.0): 0.9, (6.8, 9.0): 0.9}
    through: Parts = {(4.0, 6.8): 1.0}
    assert runs(parts, through, high={(4.35, 6.45): 0.5}) == [pytest.approx([2.0, 9.0])]
    assert runs(parts, through, high={(4.55, 6.25): 0.5}) == [pytest.approx([2.0, 9.0])]
    assert len(runs(parts, through, high={(4.75, 6.05): 0.5})) == 2


def test_a_lintel_seen_in_stripes_is_one_lintel() -> None:
    """A tilted lidar leaves most of it out; what is too far apart is two things that hang there."""
    parts: Parts = {(2.0, 4.0): 0.9, (6.8, 9.0): 0.9}
    through: Parts = {(4.0, 6.8): 1.0}

    def striped(*stripes: tuple[float, float]) -> list[list[float]]:
        return runs(parts, through, dict.fromkeys(stripes, 0.2))

    assert striped((4.2, 5.0), (5.9, 6.5)) == [pytest.approx([2.0, 9.0])]
    assert len(striped((4.2, 4.8), (6.0, 6.5))) == 2
    assert len(striped((4.2, 5.0))) == 2, "nothing hangs before the other jamb"


@pytest.mark.parametrize(("seen", "count"), [(0.8, 1), (0.5, 2)])
def test_a_doorway_between_two_jambs_has_a_lintel_of_which_a_part_was_seen(seen: float, count: int) -> None:
    parts: Parts = {(2.0, 4.0): 0.9, (5.8, 8.0): 0.9}
    found = runs(parts, {(4.0, 5.8): 1.0}, {(4.0, 4.0 + seen): 0.2})
    assert len(found) == count


def test_a_wider_gap_needs_more_of_its_lintel() -> None:
    parts: Parts = {(2.0, 4.0): 0.9, (6.6, 8.5): 0.9}
    assert len(runs(parts, {(4.0, 6.6): 1.0}, {(4.0, 5.2): 0.2})) == 2


def test_a_speck_in_a_gap_is_no_lintel() -> None:
    parts: Parts = {(2.0, 4.0): 0.9, (5.4, 8.0): 0.9}
    assert len(runs(parts, {(4.0, 5.4): 1.0}, {(4.65, 4.75): 0.2})) == 2


def test_a_few_returns_beyond_the_end_make_no_wall() -> None:
    """The side of a cabinet beside the wall's end: hits here and there, and nothing between them."""
    assert runs({(2.0, 6.0): 0.9, (6.35, 6.4): 0.22, (6.5, 6.55): 0.15}) == [pytest.approx([2.0, 6.0])]


def test_a_weak_end_that_is_seen_all_along_stays() -> None:
    assert runs({(2.0, 6.0): 0.9, (6.0, 6.5): 0.2}) == [pytest.approx([2.0, 6.5])]

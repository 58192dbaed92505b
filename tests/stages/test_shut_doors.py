"""Shut doors: a leaf set back under its lintel is one; wall, window and niche to the ceiling are none."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, Facing, FloorPlan, LayoutPlane
from floorplan_core.stages.blockers import crossing_walls
from floorplan_core.stages.shut_doors import DepthProfile, _inner_recesses, recesses
from tests.box_world import EYE, HEIGHT, LINTEL, Box, run, survey, two_rooms

THICK = 0.16
START, END = 2.0, 2.95
PLACES = [
    (x, y, EYE) for x in (1.2, 2.6) for y in (1.5, 2.5, 3.5)
]  # of the west room; nobody enters the other


def leaf(low: float = 0.0, depth: float = 0.1, top: float = LINTEL) -> Box:
    """A board in the opening, ``depth`` metres behind the face that looks west."""
    return (4.0 + depth, START, low, 4.0 + depth + 0.04, END, top)


def sill(top: float) -> Box:
    """The wall under a window."""
    return (4.0, START, 0.0, 4.0 + THICK, END, top)


@cache
def plan_of(*extra: Box, lintel: float = LINTEL, trajectory: bool = True) -> FloorPlan:
    boxes = [*two_rooms((START, END, lintel), thick=THICK), *extra]
    result = run(survey(boxes, PLACES, rays=(200, 70)), trajectory=trajectory)
    assert result.plan is not None, result.error
    return result.plan


def shut_doors(*extra: Box, lintel: float = LINTEL, trajectory: bool = True) -> tuple[Door, ...]:
    return tuple(d for d in plan_of(*extra, lintel=lintel, trajectory=trajectory).doors if d.shut)


def test_a_leaf_that_stands_back_is_a_shut_door():
    (door,) = shut_doors(leaf())
    assert door.axis == 0
    assert door.kind == "door"
    line = plan_of(leaf()).to_world(door.line())
    assert np.sort(line[:, 1]) == pytest.approx([START, END], abs=0.1)
    assert line[:, 0] == pytest.approx(4.0, abs=0.02)
    assert "shut" in door.evidence
    assert 0.5 < door.confidence < 1
    assert len(door.connects) == 1


def profile(depth: float, noise: float = 0.0, sill: float = 0.0) -> DepthProfile:
    """A wall of 3 m whose middle stands back by ``depth`` (near the floor by ``depth - sill``)."""
    rng = np.random.default_rng(4)
    back = np.where((np.arange(60) >= 20) & (np.arange(60) < 38), depth, 0.0)
    low = np.where(back > 0, depth - sill, 0.0)
    return DepthProfile(1.0, 0.05, back + rng.normal(0, noise, 60), low, np.zeros(60))


@pytest.mark.parametrize("depth", [0.035, 0.05, 0.1])
def test_recesses_of_3_to_10_cm_are_doors(depth):
    ((start, end),) = recesses(profile(depth, noise=0.003), 0.6)
    assert (start, end) == pytest.approx((2.0, 2.9), abs=0.051)


@pytest.mark.parametrize("depth", [0.0, 0.015, 0.12, 0.2])
def test_less_is_noise_and_more_a_pane_or_another_wall(depth):
    assert recesses(profile(depth, noise=0.003), 0.6) == []


def test_a_recess_above_a_sill_or_up_to_the_ceiling_is_none():
    niche = profile(0.1)
    assert recesses(profile(0.1, sill=0.1), 0.6) == []
    assert recesses(replace(niche, lintel=niche.leaf), 0.6) == []
    assert recesses(replace(niche, low=np.full(60, np.nan)), 0.6) == []


def test_a_pane_whose_frame_stands_before_and_behind_it_near_the_floor_is_none():
    pane, uneven = profile(0.1), np.arange(60) % 3
    low = np.where(pane.low > 0, np.array([0.07, 0.1, 0.14])[uneven], 0.0)
    assert recesses(replace(pane, low=low), 0.6) == []
    mostly = np.where(pane.low > 0, np.array([0.1, 0.1, 0.14])[uneven], 0.0)
    assert len(recesses(replace(pane, low=mostly), 0.6)) == 1


@pytest.mark.parametrize(
    "extra",
    [(), (sill(0.9), leaf(0.9)), (sill(0.3), leaf(0.3))],
    ids=["open", "window", "window nearly to the floor"],
)
def test_other_openings_are_no_shut_doors(extra):
    assert shut_doors(*extra) == ()


def test_a_niche_up_to_the_ceiling_is_none():
    assert shut_doors(leaf(top=HEIGHT), lintel=HEIGHT) == ()


def test_a_flush_leaf_is_wall():
    assert shut_doors(leaf(depth=0.0)) == ()


def test_without_viewpoints_nothing_is_claimed():
    assert shut_doors(leaf(), trajectory=False) == ()


@pytest.mark.parametrize(
    ("depth", "thick", "along", "found"),
    [
        (0.14, 0.19, 0.0, True),  # deeper than a pane may lie, in an inner wall
        (0.14, 0.19, 8.0, False),  # its other face was seen elsewhere only
        (0.14, 0.40, 0.0, False),  # an outer wall, and a pane
        (0.18, 0.19, 0.0, False),  # the other face itself, through a gap
    ],
)
def test_in_inner_walls_leaves_may_be_deep_and_hidden_near_the_floor(depth, thick, along, found):
    plane = LayoutPlane("a", Facing.EAST, 4.0, walls=np.array([[1.0, 4.0]]))
    other = LayoutPlane("b", Facing.WEST, 4.0 - thick, walls=np.array([[1.0, 2.1]]) + along)
    seen = replace(profile(depth), low=np.full(60, np.nan))
    alike = crossing_walls([plane], 0)
    places = _inner_recesses(plane, seen, [other], alike, DoorsConfig().min_width)
    assert places == ([pytest.approx((2.0, 2.9), abs=1e-6)] if found else [])


@pytest.mark.parametrize(("behind", "found"), [(4.5, True), (9.0, False)])
def test_where_the_other_face_was_not_seen_the_room_behind_tells_an_inner_wall(behind, found):
    plane = LayoutPlane("a", Facing.EAST, 4.0, walls=np.array([[1.0, 4.0]]))
    far = LayoutPlane("b", Facing.EAST, 4.0 - behind, walls=np.array([[1.0, 4.0]]))
    alike = crossing_walls([plane, far], 0)
    places = _inner_recesses(plane, profile(0.14), [], alike, DoorsConfig().min_width)
    assert len(places) == found


@pytest.mark.parametrize("wrong", [0, 3])
def test_in_inner_walls_what_was_seen_of_the_lintel_is_enough(wrong):
    above = np.full(60, np.nan)
    above[25:29] = 0.0
    above[31 : 31 + 2 * wrong] = 0.1
    seen = replace(profile(0.1), lintel=above)
    assert recesses(seen, 0.6) == []
    assert len(recesses(seen, 0.6, inner=True)) == (wrong == 0)
    assert recesses(replace(seen, lintel=np.full(60, np.nan)), 0.6, inner=True) == []


@pytest.mark.parametrize("both_sides", [True, False])
def test_a_leaf_behind_low_things_is_told_from_a_window_where_the_wall_is_an_inner_one(both_sides):
    bench = (3.5, START - 0.2, 0.0, 3.95, END + 0.2, 0.32)
    places = [*PLACES, *((x + 4.0, y, z) for x, y, z in PLACES if both_sides)]
    boxes = [*two_rooms((START, END, LINTEL), thick=THICK), leaf(), bench]
    result = run(survey(boxes, places, rays=(200, 70)))
    assert result.plan is not None, result.error
    assert sum(d.shut for d in result.plan.doors) == both_sides

"""Beams and lintels over a wide gap in a wall along y: what carries them, and how deep they hang."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from floorplan_core.model import Door, Facing, LayoutPlane, WallProfile
from floorplan_core.stages.blockers import (
    close_beside_doors,
    close_corners,
    crossing_offsets,
    passing_offsets,
    reaching_walls,
    remove_beams,
)

STEP, BEAMS = 0.05, (1.9, 0.45, 4.0)
CORNER = 10.0  # where the other walls meet the plane
Runs = list[tuple[float, float]]


def spanned(runs: Runs, depth: float = 0.6) -> LayoutPlane:
    """A wall that stands in ``runs``; surface ``depth`` metres deep above all of it from 2 to 10 m."""
    at = STEP * (np.arange(240) + 0.5)
    stands = np.any([(at > s) & (at < e) for s, e in runs], axis=0)
    above = (at > 2) & (at < CORNER)
    low = np.where(stands, 0.9, 0.0)
    profile = WallProfile(0.0, STEP, low, np.where(above, depth, 0.0), np.where(above & ~stands, 1.0, 0.0))
    return LayoutPlane("a", Facing.EAST, 4.0, profile=profile, support=5.0, walls=np.array([(2.0, CORNER)]))


def across(at: float, *runs: tuple[float, float]) -> LayoutPlane:
    """A wall along x, ``at`` metres along the plane."""
    return LayoutPlane(f"x{at}", Facing.NORTH, at, support=5.0, walls=np.array(runs))


def is_cut(plane: LayoutPlane, *others: LayoutPlane) -> bool:
    """True where part of the wall from 2 to 10 m was taken for a beam."""
    runs = remove_beams([plane, *others], *BEAMS)[0].walls
    return float((runs[:, 1] - runs[:, 0]).sum()) < 8.0 - STEP


GOES_ON, ENDS_HERE = (1.0, 8.0), (4.0, 8.0)  # past the plane at x = 4, and from it on


@pytest.mark.parametrize("runs", [[(2.0, 5.0), (7.0, 10.0)], [(2.0, 7.3), (9.7, 10.0)]])
def test_wall_beside_both_ends_carries_a_lintel(runs: Runs) -> None:
    assert not is_cut(spanned(runs))


@pytest.mark.parametrize("wall", [GOES_ON, ENDS_HERE])
def test_beside_a_corner_a_stub_is_enough(wall: tuple[float, float]) -> None:
    stub = spanned([(2.0, 7.5), (9.85, CORNER)], depth=0.3)
    assert not is_cut(stub, across(CORNER, wall))


def test_a_stub_in_the_open_is_none() -> None:
    assert is_cut(spanned([(2.0, 7.5), (9.85, CORNER)]))


def _with(plane: LayoutPlane, low: float, through: float, start: float, end: float) -> LayoutPlane:
    """The same; from ``start`` to ``end`` that share seen of the wall and free through it."""
    profile = plane.profile
    assert profile is not None
    at = STEP * (np.arange(len(profile.low)) + 0.5)
    inside = (at > start) & (at < end)
    changed = {
        "low": np.where(inside, low, profile.low),
        "through": np.where(inside, through, profile.through),
    }
    return replace(plane, profile=replace(profile, **changed))


@pytest.mark.parametrize(("hidden", "cut"), [(0.4, False), (0.8, True)])
def test_a_jamb_may_begin_behind_a_little_that_nobody_saw(hidden: float, cut: bool) -> None:
    wall = spanned([(2.0, 5.0), (7.0 + hidden, 10.0)])
    assert is_cut(_with(wall, 0.0, 0.0, 7.0, 7.0 + hidden)) is cut


def behind_a_corner(hidden: float, lintel: float = 1.0) -> LayoutPlane:
    """A wall to 7.5 m that goes on as a lintel, passed by free space, to ``hidden`` metres before 10 m."""
    plane = spanned([(2.0, 7.5)])
    profile = plane.profile
    assert profile is not None
    at = STEP * (np.arange(len(profile.low)) + 0.5)
    unseen = at > CORNER - hidden
    shown = (at < 7.5) | (((at - 7.5) % 1.0) < lintel)
    seen = replace(
        profile,
        high=np.where(unseen | ~shown, 0.0, profile.high),
        through=np.where(unseen, 0.0, profile.through),
    )
    return replace(plane, profile=seen, walls=np.array([(2.0, 7.5)]))


def reaches(plane: LayoutPlane, *others: LayoutPlane) -> float:
    """Where the wall ends, lintels behind corners included."""
    return float(close_corners([plane, *others], BEAMS[2])[0].walls[-1, 1])


def test_a_lintel_goes_on_to_the_corner_that_hides_its_jamb() -> None:
    corner = across(CORNER, ENDS_HERE)
    assert reaches(behind_a_corner(0.4), corner) == pytest.approx(CORNER)
    assert reaches(behind_a_corner(0.0), corner) == pytest.approx(7.5), "nothing is hidden there"
    assert reaches(behind_a_corner(0.7), corner) == pytest.approx(7.5), "too much is"
    assert reaches(behind_a_corner(0.4, lintel=0.5), corner) == pytest.approx(7.5), "little hangs there"
    assert reaches(behind_a_corner(0.4), across(CORNER, GOES_ON)) == pytest.approx(7.5), "a beam"
    assert reaches(behind_a_corner(0.4)) == pytest.approx(7.5), "no corner"


@pytest.mark.parametrize(("through", "meets"), [(0.0, [4.0]), (1.0, [])])
def test_a_wall_reaches_the_corner_that_is_hidden(through: float, meets: list[float]) -> None:
    """It ends 0.6 m before the plane that it would meet, and of the rest nothing was seen."""
    wall = _with(spanned([(2.0, 9.4)]), 0.0, through, 9.4, 12.0)
    plane = replace(across(CORNER, (4.8, 8.0)), walls=np.array([(4.8, 8.0)]))
    ends = replace(wall, walls=np.array([(2.0, 9.4)]))
    assert crossing_offsets(plane, reaching_walls([ends], 0)).tolist() == meets
    assert crossing_offsets(plane, reaching_walls([replace(ends, profile=None)], 0)).tolist() == []


@pytest.mark.parametrize(("through", "cut"), [(1.0, False), (0.0, True)])
def test_points_that_float_in_an_opening_do_not_end_it(through: float, cut: bool) -> None:
    wall = spanned([(2.0, 4.5), (7.5, 10.0)])
    assert is_cut(_with(wall, 0.16, through, 5.0, 5.2)) is cut


def test_one_jamb_and_a_wall_that_goes_on_carry_a_deep_lintel_only() -> None:
    wall, other = [(2.0, 7.5)], across(CORNER, GOES_ON)
    assert not is_cut(spanned(wall, depth=0.6), other)
    assert is_cut(spanned(wall, depth=0.3), other)


def test_between_two_walls_that_go_on_hangs_a_beam_even_where_wall_stands_beyond_them() -> None:
    beyond = spanned([(2.0, 5.0), (8.0, 10.0)])
    assert is_cut(beyond, across(5.0, GOES_ON), across(8.0, GOES_ON))
    assert not is_cut(beyond)


def test_a_gap_that_may_be_a_door_is_not_judged() -> None:
    narrow = spanned([(2.0, 8.2)], depth=0.3)
    assert not is_cut(narrow, across(CORNER, GOES_ON))


def test_a_wall_passes_where_it_goes_on_half_a_metre_on_both_sides() -> None:
    others = np.array([[1.0, 3.2, 9.0], [2.0, 3.7, 9.0], [3.0, 0.0, 4.3]])
    assert passing_offsets(spanned([(2.0, 5.0)]), others).tolist() == [1.0]


def test_wider_than_an_opening_both_ends_need_a_jamb() -> None:
    corner = across(CORNER, ENDS_HERE)
    assert not is_cut(spanned([(2.0, 6.5)]), corner)
    assert is_cut(spanned([(2.0, 5.5)]), corner)
    assert not is_cut(spanned([(2.0, 5.5), (9.85, CORNER)]), corner)


@pytest.mark.parametrize(
    ("run", "passed", "closed"),
    [
        ((2.0, 7.0), (), [(2.0, 7.0), (8.0, CORNER)]),  # of the stub beyond the door nothing was seen
        ((2.0, 8.3), (), [(2.0, CORNER)]),  # wall above the door, and a jamb
        ((2.0, 7.0), (8.2, 9.8), [(2.0, 7.0)]),  # seen to be open
    ],
)
def test_a_door_is_cut_into_a_wall_that_goes_on_to_the_corner(run, passed, closed) -> None:
    at = STEP * (np.arange(240) + 0.5)
    through = ((at > passed[0]) & (at < passed[1])).astype(float) if passed else np.zeros(240)
    profile = WallProfile(0.0, STEP, np.zeros(240), np.zeros(240), through)
    plane = LayoutPlane("a", Facing.EAST, 4.0, profile=profile, support=5.0, walls=np.array([run]))
    door = Door("d", ("a",), 0, 4.0, 7.0, 8.0)
    others = [across(2.0, GOES_ON), across(CORNER, GOES_ON)]
    found = close_beside_doors([plane, *others], [door])[0].walls
    assert np.allclose(found, closed)
    assert close_beside_doors([plane, *others], [])[0] is plane


@pytest.mark.parametrize(
    ("runs", "closed"),
    [
        ([(6.9, 7.0), (8.0, CORNER)], [(5.0, 7.0), (8.0, CORNER)]),  # unseen between the doors
        ([(5.0, 7.0), (8.0, CORNER)], [(5.0, 7.0), (8.0, CORNER)]),  # the wall ends at the next door already
    ],
)
def test_the_wall_beside_a_door_ends_at_the_next_door(runs: Runs, closed: Runs) -> None:
    profile = WallProfile(0.0, STEP, *np.zeros((3, 240)))
    plane = LayoutPlane("a", Facing.EAST, 4.0, profile=profile, support=5.0, walls=np.array(runs))
    doors = [Door("d", ("a",), 0, 4.0, 7.0, 8.0), Door("added", ("a",), 0, 4.0, 4.0, 5.0, by_hand="added")]
    found = close_beside_doors([plane, across(4.0, GOES_ON), across(CORNER, GOES_ON)], doors)[0].walls
    assert np.allclose(found, closed)

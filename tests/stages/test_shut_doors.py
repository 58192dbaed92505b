"""Shut doors: a leaf set back under its lintel is one; wall, window and niche to the ceiling are none."""

from __future__ import annotations

from functools import cache

import pytest

from floorplan_core.model import Door
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
def shut_doors(*extra: Box, lintel: float = LINTEL, trajectory: bool = True) -> tuple[Door, ...]:
    boxes = [*two_rooms((START, END, lintel), thick=THICK), *extra]
    result = run(survey(boxes, PLACES, rays=(200, 70)), trajectory=trajectory)
    assert result.plan is not None, result.error
    return tuple(d for d in result.plan.doors if "shut" in d.evidence)


def test_a_leaf_that_stands_back_is_a_shut_door():
    (door,) = shut_doors(leaf())
    assert door.axis == 0
    assert door.kind == "door"
    assert (door.start, door.end) == (pytest.approx(START, abs=0.1), pytest.approx(END, abs=0.1))
    assert door.offset == pytest.approx(4.0, abs=0.02)
    assert 0.5 < door.confidence < 1
    assert len(door.connects) == 1


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

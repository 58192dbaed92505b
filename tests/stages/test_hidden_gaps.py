"""A wall in pieces without a lintel anywhere: a gap that nothing passes straight is hidden wall."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Facing, LayoutPlane, WallProfile
from floorplan_core.stages.hidden_gaps import close_hidden_gaps
from tests.drawn_cells import Box, drawn

CONFIG = DoorsConfig()
Runs = list[tuple[float, float]]
BELOW: Box = (1.0, 1.0, 19.0, 2.95)
ABOVE: Box = (1.0, 3.15, 19.0, 8.0)


def face(name: str, facing: Facing, offset: float, runs: Runs) -> LayoutPlane:
    return LayoutPlane(name, facing, offset, support=5.0, walls=np.array(runs))


def closed(planes: list[LayoutPlane], *free: Box) -> list[Runs]:
    found = close_hidden_gaps(planes, drawn([BELOW, ABOVE, *free], []), CONFIG)
    return [[(float(s), float(e)) for s, e in p.walls] for p in found]


PIECES: Runs = [(1.0, 6.0), (7.0, 19.0)]
WALL = face("a", Facing.SOUTH, 3.0, PIECES)


def test_a_gap_that_nothing_passes_is_wall() -> None:
    assert closed([WALL]) == [[(1.0, 19.0)]]


def test_a_gap_with_a_way_through_is_open() -> None:
    assert closed([WALL], (6.2, 2.9, 6.6, 3.2)) == [PIECES]


def test_free_cells_in_a_gap_that_lead_nowhere_leave_it_closed() -> None:
    assert closed([WALL], (6.0, 2.9, 7.0, 3.0)) == [[(1.0, 19.0)]]
    assert closed([WALL], (6.2, 2.9, 6.3, 3.2)) == [[(1.0, 19.0)]]  # a single ray


def test_the_line_of_a_wall_is_made_of_all_its_planes() -> None:
    """One face was seen to the left of the gap, the other to the right of it."""
    left, right = face("a", Facing.SOUTH, 3.0, [(1.0, 6.0)]), face("b", Facing.NORTH, 3.1, [(7.0, 19.0)])
    assert closed([left, right]) == [[(1.0, 7.0)], [(6.0, 19.0)]]


def test_wide_gaps_and_gaps_beside_stubs_stay() -> None:
    wide, stub = face("a", Facing.SOUTH, 3.0, [(1.0, 6.0), (7.5, 19.0)]), [(1.0, 1.5), (2.5, 19.0)]
    assert closed([wide]) == [[(1.0, 6.0), (7.5, 19.0)]]
    assert closed([face("a", Facing.SOUTH, 3.0, stub)]) == [stub]


def test_surveys_with_lintels_are_not_touched() -> None:
    """There rays and heights tell what is hidden."""
    low = np.where(np.arange(400) < 300, 0.9, 0.0)
    profile = WallProfile(0.0, 0.05, low, np.full(400, 0.5), np.zeros(400))
    (found,) = close_hidden_gaps([replace(WALL, profile=profile)], drawn([BELOW, ABOVE], []), CONFIG)
    assert [(float(s), float(e)) for s, e in found.walls] == PIECES

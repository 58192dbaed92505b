"""A corridor's wall in pieces, seen without viewpoints: one wall, with doors where free space passes it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, Facing, LayoutPlane, WallProfile
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.wall_lines import bridge_lines, line_doors
from tests.drawn_cells import Box, drawn

CONFIG, STEP, BINS = DoorsConfig(), 0.05, 400
Runs = list[tuple[float, float]]


def face(name: str, facing: Facing, offset: float, runs: Runs, support: float = 9.0) -> LayoutPlane:
    """Wall that was seen where ``runs`` say."""
    at = STEP * (np.arange(BINS) + 0.5)
    wall = np.any([(at > s) & (at < e) for s, e in runs], axis=0)
    profile = WallProfile(0.0, STEP, np.where(wall, 0.8, 0.0), np.zeros(BINS), np.zeros(BINS))
    return LayoutPlane(name, facing, offset, profile=profile, support=support, walls=np.array(runs))


PIECES: Runs = [(2.0, 6.0), (7.5, 12.0), (14.0, 16.0)]
WALL = face("a", Facing.SOUTH, 3.0, PIECES)
CORRIDOR: Box = (2.0, 1.0, 16.0, 2.95)
DOOR: Box = (6.5, 2.9, 7.2, 5.0)


def runs(planes: tuple[LayoutPlane, ...], name: str = "a") -> Runs:
    (plane,) = (p for p in planes if p.id == name)
    return [(float(s), float(e)) for s, e in plane.walls]


def test_pieces_in_one_line_are_one_wall() -> None:
    evidence = drawn([CORRIDOR, DOOR], [WALL], viewpoints=False)
    assert runs(bridge_lines([WALL], evidence, CONFIG)) == [(2.0, 16.0)]


def test_a_door_is_where_free_space_passes() -> None:
    (door,) = line_doors([WALL], (), drawn([CORRIDOR, DOOR], [WALL], viewpoints=False), CONFIG)
    assert (door.axis, door.offset, door.kind, door.planes) == (1, 3.0, "door", ("a",))
    assert (door.start, door.end) == (pytest.approx(6.35, abs=0.1), pytest.approx(7.35, abs=0.1))
    assert door.evidence == ("passage",)


def test_a_door_seen_at_a_slant_is_one_though_little_of_it_is_straight() -> None:
    """Two cells pass straight through; one is a ray beside something."""
    slant, ray = ((6.5, 2.9, 6.5 + width, 5.0) for width in (0.2, 0.1))
    (door,) = line_doors([WALL], (), drawn([CORRIDOR, slant], [WALL], viewpoints=False), CONFIG)
    assert door.start < 6.5 and door.end > 6.7
    assert not line_doors([WALL], (), drawn([CORRIDOR, ray], [WALL], viewpoints=False), CONFIG)


def test_the_wall_ends_where_it_was_seen() -> None:
    """A slanting look through a doorway widens to the door, never into the wall."""
    narrow: Box = (6.0, 2.9, 6.3, 5.0)
    (door,) = line_doors([WALL], (), drawn([CORRIDOR, narrow], [WALL], viewpoints=False), CONFIG)
    assert door.start == pytest.approx(6.0, abs=0.01)
    assert 6.3 < door.end <= 6.85


def test_two_faces_and_recesses_are_one_wall() -> None:
    other = face("b", Facing.NORTH, 3.2, [(3.0, 5.0)], support=2.0)
    (door,) = line_doors([WALL, other], (), drawn([CORRIDOR, (6.5, 2.9, 7.2, 5.0)], [], False), CONFIG)
    assert door.planes == ("a",)  # the other was not seen beside the door
    beside = face("b", Facing.NORTH, 3.2, [(3.0, 6.0)], support=2.0)
    (door,) = line_doors([WALL, beside], (), drawn([CORRIDOR, (6.5, 2.9, 7.2, 5.0)], [], False), CONFIG)
    assert door.planes == ("a", "b") and door.thickness == pytest.approx(0.2)


def test_the_mouth_of_a_corridor_stays_open() -> None:
    evidence = drawn([CORRIDOR, (12.0, 2.9, 14.0, 5.0)], [WALL], viewpoints=False)
    assert line_doors([WALL], (), evidence, CONFIG) == ()
    assert runs(bridge_lines([WALL], evidence, CONFIG)) == [(2.0, 12.0), (14.0, 16.0)]


def test_a_known_door_is_not_found_again() -> None:
    known = Door("d1", ("a",), 1, 3.1, 6.4, 7.3)
    assert line_doors([WALL], (known,), drawn([CORRIDOR, DOOR], [WALL], viewpoints=False), CONFIG) == ()


def test_a_corridor_is_not_closed_by_walls_on_both_of_its_sides() -> None:
    south = face("s", Facing.NORTH, 5.0, [(1.0, 19.0)], support=20.0)
    north = face("n", Facing.SOUTH, 7.0, [(1.0, 19.0)], support=20.0)
    across = face("x", Facing.EAST, 9.0, [(1.0, 5.0), (7.0, 11.0)])
    evidence = drawn([(1.0, 5.0, 19.0, 7.0)], [], viewpoints=False)
    assert runs(bridge_lines([south, north, across], evidence, CONFIG), "x") == [(1.0, 5.0), (7.0, 11.0)]


@pytest.mark.parametrize("pieces", [[(2.0, 4.0), (6.0, 7.0)], [(2.0, 4.0), (7.9, 9.0), (12.9, 14.0)]])
def test_short_or_mostly_open_lines_stay_as_they_are(pieces: Runs) -> None:
    wall = face("a", Facing.SOUTH, 3.0, pieces)
    assert runs(bridge_lines([wall], drawn([CORRIDOR], [wall], viewpoints=False), CONFIG)) == pieces


def test_with_viewpoints_gaps_are_believed() -> None:
    evidence = drawn([CORRIDOR, DOOR], [WALL])
    assert runs(bridge_lines([WALL], evidence, CONFIG)) == PIECES
    assert line_doors([WALL], (), evidence, CONFIG) == ()


def ghost(low: float, high: float, levels: int) -> Evidence:
    """A corridor and a doorway behind it in which only some levels are free: a leaf stood there."""
    evidence = drawn([CORRIDOR, (low, 2.9, high, 5.0)], [WALL], viewpoints=False)
    x0, x1 = (round((v - evidence.origin[0]) / evidence.cell) for v in (low, high))
    y0 = round((2.9 - evidence.origin[1]) / evidence.cell)
    free = evidence.free.copy()
    free[y0 : y0 + 5, x0:x1] = np.uint64((1 << levels) - 1) << np.uint64(4)
    return replace(evidence, free=free)


def test_a_leaf_that_stood_in_the_door_for_a_time_does_not_shut_it() -> None:
    (door,) = line_doors([WALL], (), ghost(6.5, 7.0, 6), CONFIG)  # 6 of the 14 levels of a body
    assert door.start <= 6.5 and door.end >= 7.0
    assert not line_doors([WALL], (), ghost(6.5, 7.0, 4), CONFIG)

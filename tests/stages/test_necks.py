"""Corridors and rooms without a lintel anywhere, drawn cell by cell."""

from __future__ import annotations

import numpy as np

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, Facing, LayoutPlane
from floorplan_core.stages.necks import find_necks
from tests.drawn_cells import Box, drawn

CONFIG = DoorsConfig()
Runs = list[tuple[float, float]]


def face(name: str, facing: Facing, offset: float, runs: Runs) -> LayoutPlane:
    return LayoutPlane(name, facing, offset, support=5.0, walls=np.array(runs))


CORRIDOR: Box = (1.0, 1.0, 19.0, 3.0)
SOUTH_WALL = face("s", Facing.NORTH, 1.0, [(1.0, 19.0)])


def corridor_wall(gap: tuple[float, float]) -> list[LayoutPlane]:
    """The wall between corridor and room, y 3.0 to 3.1, with both faces."""
    runs = [(1.0, gap[0]), (gap[1], 19.0)]
    return [face("c", Facing.SOUTH, 3.0, runs), face("r", Facing.NORTH, 3.1, runs)]


def room_beyond(gap: tuple[float, float], x0: float, x1: float) -> tuple[list[Box], list[LayoutPlane]]:
    """A room behind the corridor's wall, y 3.1 to 8, with its side walls."""
    sides = [face("w", Facing.EAST, x0, [(3.1, 8.0)]), face("e", Facing.WEST, x1, [(3.1, 8.0)])]
    boxes = [CORRIDOR, (gap[0], 3.0, gap[1], 3.1), (x0, 3.1, x1, 8.0)]
    return boxes, [SOUTH_WALL, *corridor_wall(gap), *sides]


def necks(boxes: list[Box], planes: list[LayoutPlane], doors: tuple[Door, ...] = ()) -> tuple[Door, ...]:
    return find_necks(planes, doors, drawn(boxes, planes), CONFIG)


def test_a_gap_in_a_wall_between_corridor_and_room_is_a_door() -> None:
    (door,) = necks(*room_beyond((6.0, 7.0), 4.0, 9.0))
    assert (door.axis, door.kind, door.start, door.end) == (1, "door", 6.0, 7.0)
    assert set(door.planes) == {"c", "r"}
    assert door.evidence == ("narrow between two spaces", "wall on both sides")
    assert round(door.offset, 3) == 3.05 and round(door.thickness, 3) == 0.1


def test_a_wide_gap_is_an_opening() -> None:
    (door,) = necks(*room_beyond((5.0, 7.5), 3.0, 9.0))
    assert door.kind == "opening"


def test_a_room_seen_only_through_its_door_is_one_too() -> None:
    """Of the room only the fan of rays is free, and no wall was seen."""
    fan: list[Box] = [(6.0 - k / 10, 3.1 + k / 5, 7.0 + k / 10, 3.3 + k / 5) for k in range(10)]
    planes = [SOUTH_WALL, *corridor_wall((6.0, 7.0))[:1]]
    (door,) = necks([CORRIDOR, (6.0, 3.0, 7.0, 3.1), *fan], planes)
    assert door.planes == ("c",)


def test_the_mouth_of_a_side_corridor_is_no_door() -> None:
    assert not necks(*room_beyond((6.0, 7.4), 6.0, 7.4))


def test_a_niche_is_no_room() -> None:
    planes = [SOUTH_WALL, *corridor_wall((6.0, 7.0))[:1], face("b", Facing.SOUTH, 3.6, [(5.0, 8.0)])]
    assert not necks([CORRIDOR, (5.0, 3.1, 8.0, 3.6), (6.0, 3.0, 7.0, 3.1)], planes)


def test_a_gap_that_nobody_saw_through_is_no_door() -> None:
    boxes, planes = room_beyond((6.0, 7.0), 4.0, 9.0)
    assert not necks([boxes[0], boxes[2]], planes)


def test_two_cabinets_in_a_room_part_nothing() -> None:
    stubs = [face("a", Facing.NORTH, 5.0, [(1.0, 1.5), (4.0, 4.5)])]
    sides = [face("w", Facing.EAST, 1.0, [(1.0, 9.0)]), face("e", Facing.WEST, 4.5, [(1.0, 9.0)])]
    assert not necks([(1.0, 1.0, 4.5, 9.0)], [*stubs, *sides])


def test_the_corner_between_a_wall_and_one_across_is_a_door() -> None:
    wall = [face("c", Facing.SOUTH, 3.0, [(5.0, 19.0)]), face("w", Facing.EAST, 4.0, [(1.0, 8.0)])]
    boxes: list[Box] = [(4.0, 1.0, 19.0, 3.0), (4.0, 3.0, 5.0, 3.1), (4.0, 3.1, 9.0, 8.0)]
    (door,) = necks(boxes, [SOUTH_WALL, *wall, face("e", Facing.WEST, 9.0, [(3.1, 8.0)])])
    assert (door.start, door.end, door.evidence[1]) == (4.0, 5.0, "corner")


def test_a_door_across_a_corridor_is_dropped_and_one_into_a_room_stays() -> None:
    boxes, planes = room_beyond((6.0, 7.0), 4.0, 9.0)
    jamb = face("j", Facing.EAST, 12.0, [(1.0, 1.2), (2.8, 3.0)])
    across = Door("d1", ("j",), 0, 12.0, 1.2, 2.8, evidence=("path",), confidence=0.7)
    known = Door("d2", ("c", "r"), 1, 3.05, 6.0, 7.0, thickness=0.1, confidence=0.9)
    (door,) = necks(boxes, [*planes, jamb], (across, known))
    assert door.confidence == 0.9


def test_two_spaces_of_many_doors_are_one_corridor() -> None:
    """A narrowing with one jamb between two halves of a corridor, each with four rooms."""
    doors = [(1.5 + 2.2 * k, 2.4 + 2.2 * k) for k in range(8)]
    ends = [1.0, *(v for d in doors for v in d), 19.0]
    wall = face("c", Facing.SOUTH, 4.0, list(zip(ends[::2], ends[1::2], strict=True)))
    rooms: list[Box] = [(s - 0.5, 4.1, e + 0.5, 8.0) for s, e in doors]
    gaps: list[Box] = [(s, 3.9, e, 4.1) for s, e in doors]
    jamb = face("j", Facing.EAST, 10.0, [(1.0, 2.8)])
    planes = [SOUTH_WALL, wall, jamb]
    boxes: list[Box] = [(1.0, 1.0, 19.0, 4.0), *gaps, *rooms]
    assert sorted(d.axis for d in necks(boxes, planes)) == [1] * 8


def test_a_shut_door_stays_though_nothing_passes_it() -> None:
    boxes, planes = room_beyond((6.0, 7.0), 4.0, 9.0)
    shut = Door("d1", ("c",), 1, 3.0, 11.0, 12.0, evidence=("shut",))
    assert [d.start for d in necks(boxes, planes, (shut,))] == [11.0, 6.0]


def test_one_doorway_is_one_door() -> None:
    """What was found there by other evidence is wider than the gap, so that the gap comes first."""
    boxes, planes = room_beyond((6.0, 7.0), 4.0, 9.0)
    thick = [planes[0], planes[1], face("r", Facing.NORTH, 3.3, planes[2].walls.tolist()), *planes[3:]]
    boxes = [boxes[0], (6.0, 3.0, 7.0, 3.3), (4.0, 3.3, 9.0, 8.0)]
    known = Door("d1", ("r", "c"), 1, 3.15, 5.95, 7.05, thickness=0.3, evidence=("open", "passage"))
    (door,) = necks(boxes, thick, (known,))
    assert door.evidence == ("open", "passage")
    (alone,) = necks(boxes, thick)
    assert alone.evidence[0] == "narrow between two spaces"

"""Faces that are known by their neighbours: in line with a wall, beside a doorway, on its other side."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.geometry.columns import height_mask
from floorplan_core.model import Facing, LayoutSegment
from floorplan_core.stages.structure import Patches
from floorplan_core.stages.wall_faces import in_line, other_faces
from tests.drawn_cells import seen_free

CLOSED = seen_free(np.zeros((60, 60), dtype=np.uint64))


@pytest.mark.parametrize(
    ("aside", "away", "structure"), [(0.01, 1.0, True), (0.05, 1.0, False), (0.01, 2.0, False)]
)
def test_a_low_piece_in_line_with_a_wall_is_wall(aside: float, away: float, structure: bool) -> None:
    """A wall of 2 m along y, and half a metre of it beside a doorway, rows of 5 cm in any order."""
    patches = _patches(np.arange(40)[::-1], np.arange(10) + 40 + round(away / 0.05))
    judged = [(True, ("reaches ceiling",)), (False, ("low",))]
    wall, piece = in_line(judged, CLOSED, Facing.EAST, patches, np.array([3.0, 3.0 + aside]))
    assert wall == judged[0]
    assert piece[0] == structure


@pytest.mark.parametrize("free_behind", [True, False])
@pytest.mark.parametrize("facing", [Facing.EAST, Facing.SOUTH])
def test_two_low_pieces_are_wall_where_a_way_leads_through_between_them(facing, free_behind) -> None:
    """Half a metre of wall on both sides of a doorway, or two cabinets at a wall and the gap between them."""
    patches = _patches(np.arange(10), np.arange(10) + 26)
    free = np.zeros((60, 60), dtype=np.uint64)
    behind = np.flatnonzero((np.arange(60) * 0.1 + 0.05 - 3.0) * facing.sign < 0)
    before = np.setdiff1d(np.arange(60), behind)
    free[:, before] = height_mask(0, 2.6)
    if free_behind:
        free[5:13, behind] = height_mask(0, 2.0)
    evidence = seen_free(free if facing.axis == 0 else free.T)
    found = in_line([(False, ("low",))] * 2, evidence, facing, patches, np.array([3.0, 3.005]))
    assert [is_wall for is_wall, _ in found] == [free_behind] * 2


def _patches(*rows: np.ndarray) -> Patches:
    first = np.concatenate([[0], np.cumsum([len(of) for of in rows])])
    area = np.array([0.05 * len(of) for of in rows])
    joined = np.concatenate(rows)
    return Patches(np.arange(len(rows)), first, joined, np.ones(len(joined), dtype=np.uint64), area)


@pytest.mark.parametrize(
    ("thick", "known", "top", "structure"),
    [
        (0.12, True, 1.7, True),  # the other face of a wall
        (0.12, False, 2.2, True),  # both seen, neither to its top, and higher than furniture
        (0.12, False, 1.7, False),  # a partition
        (0.05, True, 2.0, False),  # a leaf
        (0.40, False, 2.2, False),  # a cabinet that stands in the open
    ],
)
def test_a_wall_is_known_by_its_two_faces(thick, known, top, structure) -> None:
    one = _surface("a", Facing.EAST, 4.0, 1.0, 2.0, top, known)
    two = _surface("b", Facing.WEST, 4.0 - thick, 1.5, 2.5, 1.7, False)
    assert [s.structural for s in other_faces([one, two], 2.05)] == [known or structure, structure]


def test_faces_that_look_at_each_other_are_no_wall() -> None:
    one = _surface("a", Facing.WEST, 4.0, 1.0, 2.0, 2.4, True)
    two = _surface("b", Facing.EAST, 3.88, 1.0, 2.0, 1.7, False)
    assert other_faces([one, two], 2.05) == (one, two)


def test_faces_beside_each_other_are_no_wall() -> None:
    one = _surface("a", Facing.NORTH, 4.0, 1.0, 2.0, 2.4, True)
    two = _surface("b", Facing.SOUTH, 3.88, 1.8, 3.0, 1.7, False)
    assert other_faces([one, two], 2.05) == (one, two)


def _surface(
    name: str, facing: Facing, offset: float, start: float, end: float, top: float, structural: bool
) -> LayoutSegment:
    return LayoutSegment(
        name, facing, offset, start, end, *(0.2, top, 1.0, 100, 0.01, 0.001), structural=structural
    )

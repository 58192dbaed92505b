"""What is structure and what is furniture, patch by patch; whole rooms are in test_layout_segments."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import SegmentsConfig
from floorplan_core.geometry.columns import height_mask
from floorplan_core.model import Facing, ManhattanFrame
from floorplan_core.stages.structure import Patches, in_line, judge
from tests.drawn_cells import seen_free


@pytest.mark.parametrize(
    ("columns", "rows", "levels", "structure"),
    [
        ((9,), 30, 21, True),  # noise puts the wall into the column before its face
        ((9, 8), 30, 21, False),  # air behind it: a cabinet
        ((9,), 16, 21, False),  # the leaf of a door before a wall
        ((9,), 30, 4, False),  # glass, of which little is seen
    ],
)
def test_a_wall_is_looked_over_where_both_columns_behind_it_are_free(columns, rows, levels, structure):
    assert _is_structure(columns, rows, levels, at=1.0) == structure


@pytest.mark.parametrize(
    ("columns", "at", "structure"),
    [
        ((9,), 0.98, False),  # column 9, up to 1.0 m, is nearly all behind the face
        ((9,), 0.96, True),  # much of it is before the face, where the room is free
        ((9, 8), 0.96, False),  # and air behind it
    ],
)
def test_a_column_that_begins_before_a_face_does_not_tell_what_is_behind(columns, at, structure):
    assert _is_structure(columns, 16, 21, at) == structure


def _is_structure(columns: tuple[int, ...], rows: int, levels: int, at: float) -> bool:
    """A surface at x = ``at`` m that faces east and reaches 2.3 m, below a ceiling of 2.8 m."""
    free = np.zeros((20, 20), dtype=np.uint64)
    free[:, list(columns)] = height_mask(0, 2.8)
    seen = np.full(rows, height_mask(2.3 - 0.1 * levels, 2.3), dtype=np.uint64)
    patch = Patches(
        *(np.array([0]), np.array([0, rows]), np.arange(rows), seen, np.array([rows * levels * 0.005]))
    )
    evidence = seen_free(free, frame=ManhattanFrame(np.eye(3), 0.0, 0.0, 1.0, 10.0, 0.0, 2.8))
    ((found, _),) = judge(evidence, Facing.EAST, patch, np.array([at]), SegmentsConfig())
    return found


@pytest.mark.parametrize(
    ("aside", "away", "structure"), [(0.01, 1.0, True), (0.05, 1.0, False), (0.01, 2.0, False)]
)
def test_a_low_piece_in_line_with_a_wall_is_wall(aside, away, structure):
    """A wall of 2 m along y, and half a metre of it beside a doorway, rows of 5 cm in any order."""
    first = 40 + round(away / 0.05)
    rows = np.concatenate([np.arange(40)[::-1], np.arange(first, first + 10)])
    patches = Patches(
        *(np.array([0, 1]), np.array([0, 40, 50]), rows, np.ones(50, dtype=np.uint64), np.array([4.0, 0.5]))
    )
    judged = [(True, ("reaches ceiling",)), (False, ("low",))]
    wall, piece = in_line(judged, patches, np.array([3.0, 3.0 + aside]), 0.05)
    assert wall == judged[0]
    assert piece[0] == structure

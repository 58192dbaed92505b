"""What is structure and what is furniture, patch by patch; whole rooms are in test_layout_segments."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from floorplan_core.config import SegmentsConfig
from floorplan_core.geometry.columns import height_mask
from floorplan_core.model import Facing, ManhattanFrame
from floorplan_core.stages.structure import Patches, judge
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


@pytest.mark.parametrize(
    ("rows", "levels", "free_from", "structure"),
    [
        (30, 21, 0.3, True),  # the air of the room beyond a thin wall
        (30, 21, 2.3, False),  # air above a cabinet only
        (16, 21, 0.3, False),  # a door's leaf stands in the air
        (30, 4, 0.3, False),  # and so does glass
    ],
)
def test_what_is_as_free_below_the_top_of_a_surface_does_not_look_over_it(rows, levels, free_from, structure):
    assert _is_structure((9, 8), rows, levels, at=1.0, free_from=free_from) == structure


def _is_structure(
    columns: tuple[int, ...], rows: int, levels: int, at: float, free_from: float = 2.3
) -> bool:
    """A surface at x = ``at`` m that faces east and reaches 2.3 m, below a ceiling of 2.8 m."""
    free = np.zeros((20, 20), dtype=np.uint64)
    free[:, list(columns)] = height_mask(free_from, 2.8)
    seen = np.full(rows, height_mask(2.3 - 0.1 * levels, 2.3), dtype=np.uint64)
    patch = Patches(
        *(np.array([0]), np.array([0, rows]), np.arange(rows), seen, np.array([rows * levels * 0.005]))
    )
    evidence = seen_free(free, frame=ManhattanFrame(np.eye(3), 0.0, 0.0, 1.0, 10.0, 0.0, 2.8))
    ((found, _),) = judge(evidence, Facing.EAST, patch, np.array([at]), SegmentsConfig())
    return found


@pytest.mark.parametrize(
    ("top", "structure"),
    [
        (1.9, False),  # a cabinet
        (2.75, True),  # the wall, up to that ceiling
    ],
)
@pytest.mark.parametrize("levels", [1, 2])
def test_a_ceiling_lower_than_the_rest_makes_no_cabinet_a_wall(top, structure, levels):
    """A room of 2.75 m beside others of 3 m: its ceiling lies at one level, or at two, above the surface."""
    free = np.zeros((20, 20), dtype=np.uint64)
    free[:, [8, 9]] = height_mask(0, 2.7) & ~height_mask(0, top)
    seen = height_mask(0.2, top) | height_mask(2.8 - 0.1 * levels, 2.8)
    patch = Patches(
        *(np.array([0]), np.array([0, 16]), np.arange(16), np.full(16, seen), np.array([16 * 0.1]))
    )
    evidence = seen_free(free, frame=ManhattanFrame(np.eye(3), 0.0, 0.0, 1.0, 10.0, 0.0, 3.0))
    ((found, _),) = judge(evidence, Facing.EAST, patch, np.array([1.0]), SegmentsConfig())
    assert found == structure


@pytest.mark.parametrize(
    ("low", "viewpoints", "structure"),
    [
        ((0.3, 0.4), False, False),  # the edge of a desk, and of the ceiling above it
        ((0.3, 1.4), False, True),  # enough of a wall
        ((0.3, 0.4), True, True),  # where it is known what was looked over, that decides
        ((1.3, 1.4), False, True),  # a ring that a scanner left on a wall far away
        ((2.3, 2.4), False, True),  # a beam, or what was seen of a wall above things
    ],
)
def test_without_viewpoints_a_wall_is_what_enough_was_seen_of(low, viewpoints, structure):
    seen = height_mask(*low) | height_mask(2.6, 2.7)
    rows = 30
    patch = Patches(
        np.array([0]),
        np.array([0, rows]),
        np.arange(rows),
        np.full(rows, seen),
        np.array([rows * 0.05 * (low[1] - low[0] + 0.1)]),
    )
    frame = ManhattanFrame(np.eye(3), 0.0, 0.0, 1.0, 10.0, 0.0, 2.8)
    evidence = replace(seen_free(np.zeros((20, 20), dtype=np.uint64), frame=frame), viewpoints=viewpoints)
    ((found, _),) = judge(evidence, Facing.EAST, patch, np.array([1.0]), SegmentsConfig())
    assert found == structure

"""From which sides a surface can have been seen where nothing tells the viewpoint."""

from __future__ import annotations

import numpy as np

from floorplan_core.geometry.columns import height_mask
from floorplan_core.model import Facing
from floorplan_core.stages.upright_surfels import UprightSurfels
from tests.drawn_cells import seen_free

WALL, BEFORE, FREE = 20, 19, 8  # fine columns of a wall and just before it; coarse ones that are free
BAND = height_mask(0.2, 2.6)


def facings(before: np.uint64) -> set[Facing]:
    """Of a wall across x whose room is at lower x, with so much of something just before it."""
    free, hits = np.zeros((4, 20), dtype=np.uint64), np.zeros((8, 40), dtype=np.uint64)
    free[:, :FREE] = height_mask(0.0, 2.6)
    hits[:, WALL], hits[:, BEFORE] = BAND, before
    evidence = seen_free(free, hits=hits, inferred=True, viewpoints=False)
    surfel = np.array([[WALL, 4]], dtype=np.int32)
    one = UprightSurfels(
        evidence, BAND, np.zeros(1, np.int32), surfel, np.full(1, 12, np.uint8), np.zeros(1, np.uint8)
    )
    return {facing for facing in Facing if facing.axis == 0 and one.of(facing)[0]}


def test_a_wall_faces_the_free_space_before_it() -> None:
    assert facings(np.uint64(0)) == {Facing.WEST}


def test_a_beam_close_before_a_wall_hides_none_of_it() -> None:
    assert facings(height_mask(2.1, 2.6)) == {Facing.WEST}


def test_what_stands_before_a_surface_is_the_wall_there() -> None:
    assert Facing.WEST not in facings(height_mask(0.0, 2.6))

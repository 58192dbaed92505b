"""Candidate rectangles on layouts small enough to count by hand."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import CandidatesConfig, CoverConfig
from floorplan_core.errors import Cancelled, NoPlanError
from floorplan_core.model import OccupancyGrid
from floorplan_core.observer import CancelToken, Observer
from floorplan_core.stages.candidates import enumerate_candidates
from floorplan_core.stages.set_cover import greedy_cover

CONFIG = CandidatesConfig()
NO_BLOCKERS = np.empty((0, 4))


def free_grid(width: float, height: float, cell: float = 0.1) -> OccupancyGrid:
    free = np.ones((round(height / cell), round(width / cell)), dtype=bool)
    return OccupancyGrid(np.zeros(2), cell, free.astype(np.uint8), free, 1.0)


def candidates(xp, xm, yp, ym, blockers=NO_BLOCKERS, grid=None, config=CONFIG, observer=None):
    planes = [np.array(p, dtype=float) for p in (xp, xm, yp, ym)]
    return enumerate_candidates(
        *planes, np.array(blockers, dtype=float), grid or free_grid(10, 5), config, observer
    )


def test_one_room():
    found = candidates([0], [4], [0], [3])
    assert found.index().tolist() == [[0, 0, 0, 0]]
    assert found.bounds().tolist() == [[0, 0, 4, 3]]
    assert found.families.tolist() == [[0, 0, 0, 1, 0, 1]]


def test_enumerated_counts_every_pair_of_pairs():
    found = candidates([0, 1, 2], [4, 5], [0], [3, 4, 5, 6])
    assert found.enumerated == 3 * 2 * 1 * 4


def test_outward_facing_pairs_are_pruned():
    assert len(candidates([4], [0], [0], [3])) == 0


@pytest.mark.parametrize(("east", "valid"), [(1.0, 1), (0.99, 0)])
def test_shortest_side(east, valid):
    assert len(candidates([0], [east], [0], [3])) == valid


@pytest.mark.parametrize(("x", "valid"), [(0.15, 1), (0.1501, 0), (2.0, 0), (3.85, 1), (3.8499, 0)])
def test_a_wall_within_the_tolerance_of_a_side_does_not_block(x, valid):
    assert len(candidates([0], [4], [0], [3], [[x, 1, x, 2]])) == valid


def test_a_wall_that_ends_at_the_side_does_not_block():
    assert len(candidates([0], [4], [0], [3], [[2, -1, 2, 0.15]])) == 1
    assert len(candidates([0], [4], [0], [3], [[2, -1, 2, 0.16]])) == 0


def test_a_wall_splits_a_hall():
    found = candidates([0, 5.1], [4.9, 10], [0], [5], [[4.9, 0, 5.1, 5]])
    assert found.bounds().tolist() == [[0, 0, 4.9, 5], [5.1, 0, 10, 5]]


def test_blockers_with_swapped_corners_block():
    assert len(candidates([0], [4], [0], [3], [[3, 2, 1, 1]])) == 0


def test_cells_beyond_the_grid_count_as_unobserved():
    found = candidates([-2], [4], [0], [3], grid=free_grid(3, 3))
    chosen = greedy_cover(found, free_grid(3, 3), CoverConfig())
    assert chosen.total_cells.tolist() == [60 * 30]
    assert chosen.free_cells.tolist() == [30 * 30]


def test_a_centre_on_the_lower_side_is_inside_and_on_the_upper_side_outside():
    grid = free_grid(4, 4, cell=1.0)
    chosen = greedy_cover(candidates([0.5], [2.5], [0], [2], grid=grid), grid, CoverConfig())
    assert (
        chosen.total_cells.tolist() == chosen.gained.tolist() == [2 * 2]
    )  # centres 0.5 and 1.5 of x, 0.5 and 1.5 of y


def test_ratio():
    config = CONFIG.model_copy(update={"max_ratio": 2.0})
    grid = free_grid(2, 2)
    assert len(candidates([0], [4], [0], [2], grid=grid, config=config)) == 1
    assert len(candidates([0], [4.1], [0], [2], grid=grid, config=config)) == 0


def test_a_rectangle_without_free_cells_is_pruned():
    assert len(candidates([20], [24], [0], [3])) == 0


@pytest.mark.parametrize("missing", range(4))
def test_no_plane_of_one_facing(missing):
    planes = [[0], [4], [0], [3]]
    planes[missing] = []
    found = candidates(*planes)
    assert len(found) == found.enumerated == 0


def test_an_empty_courtyard_costs_nothing():
    """Two thousand planes that look into the unknown give a handful of rectangles, not 10^12."""
    far = np.linspace(20, 200, 1000)
    found = candidates([0, *far], [4, *far + 1], [0], [3])
    assert found.bounds().tolist() == [[0, 0, 4, 3], *[[0, 0, w, 3] for w in far + 1 if w <= 200]]


def test_a_corridor_between_many_walls_is_a_family_a_corner():
    """A hundred planes across a corridor: five thousand rectangles in a hundred families."""
    east = np.arange(0, 100, 1.0)
    found = candidates(east, east + 1.0, [0], [2], grid=free_grid(100, 2))
    assert len(found) == 100 * 101 / 2
    assert found.families.tolist() == [[k, 0, k, 100, 0, 1] for k in range(100)]


def test_members_of_a_family_that_are_not_valid_are_cut_out():
    """Only what reaches over the free cells is valid, and only up to the ratio."""
    free = np.zeros((10, 100), dtype=bool)
    free[:, 30:40] = True
    grid = OccupancyGrid(np.zeros(2), 0.1, free.astype(np.uint8), free, 1.0)
    config = CONFIG.model_copy(update={"max_ratio": 6.0})
    found = candidates([0], np.arange(1, 11), [0], [1], grid=grid, config=config)
    assert found.bounds()[:, 2].tolist() == [4, 5, 6]


def test_too_many_candidates_is_one_clear_sentence():
    config = CONFIG.model_copy(update={"max_count": 3})
    with pytest.raises(NoPlanError, match=r"8 rectangles .* 2, 2, 2, 1 planes .* more than the 3"):
        candidates([0, 0.5], [4, 4.5], [0, 0.5], [3], config=config)


def test_cancelled():
    token = CancelToken()
    token.cancel()
    with pytest.raises(Cancelled):
        candidates([0], [4], [0], [3], observer=Observer(token))

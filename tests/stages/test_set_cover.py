"""Greedy and exact cover on layouts whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import CandidatesConfig, CoverConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.model import CandidateSet, OccupancyGrid
from floorplan_core.observer import Observer
from floorplan_core.stages import exact_cover as exact
from floorplan_core.stages.candidates import enumerate_candidates
from floorplan_core.stages.set_cover import cover, greedy_cover

GREEDY, EXACT = CoverConfig(), CoverConfig(solver="exact")


def grid_of(*rows: str) -> OccupancyGrid:
    """Cells of 1 m from a drawing, upper row first: '#' free, '.' not."""
    free = np.array([[c == "#" for c in row] for row in rows[::-1]])
    return OccupancyGrid(np.zeros(2), 1.0, free.astype(np.uint8), free, 1.0)


def candidates_of(grid: OccupancyGrid, xp, xm, yp, ym, max_ratio: float = 100.0) -> CandidateSet:
    planes = [np.array(p, dtype=float) for p in (xp, xm, yp, ym)]
    config = CandidatesConfig(max_ratio=max_ratio)
    return enumerate_candidates(*planes, np.empty((0, 4)), grid, config)


def test_an_l_shape_takes_two_rectangles():
    grid = grid_of("##..", "##..", "####", "####")
    found = greedy_cover(candidates_of(grid, [0], [2, 4], [0], [2, 4]), grid, GREEDY)
    assert found.bounds.tolist() == [[0, 0, 2, 4], [0, 0, 4, 2]]
    assert found.gained.tolist() == [8, 4]
    assert found.weight == 16
    assert not found.uncovered.any()


def test_ties_go_to_the_larger_rectangle():
    grid = grid_of("####", "####")
    found = greedy_cover(candidates_of(grid, [0, 2], [2, 4], [0], [2]), grid, GREEDY)
    assert found.bounds.tolist() == [[0, 0, 4, 2]]


def test_further_ties_go_to_the_first_index():
    grid = grid_of("####")
    found = greedy_cover(candidates_of(grid, [0, 0, 0], [4, 4], [0, 0], [1]), grid, GREEDY)
    assert found.chosen.tolist() == [0]


def test_what_no_rectangle_holds_stays_uncovered():
    grid = grid_of("##.#")
    found = greedy_cover(candidates_of(grid, [0], [2], [0], [1]), grid, GREEDY)
    assert np.argwhere(found.uncovered).tolist() == [[0, 3]]


def test_no_candidates():
    grid = grid_of("####")
    for config in (GREEDY, EXACT):
        found = cover(candidates_of(grid, [], [4], [0], [1]), grid, config)
        assert len(found) == found.weight == 0
        assert found.bounds.shape == (0, 4)
        assert found.uncovered.all()


def test_an_empty_grid():
    grid = OccupancyGrid(np.zeros(2), 1.0, np.zeros((0, 0), np.uint8), np.zeros((0, 0), bool), 1.0)
    found = cover(candidates_of(grid, [0], [4], [0], [4]), grid, GREEDY)
    assert len(found) == 0
    assert found.uncovered.shape == (0, 0)


def test_a_universe_that_shrank_after_the_candidates_were_made():
    """Counts come from the grid that is covered, not from the one that the candidates were made on."""
    before, after = grid_of("####"), grid_of("#...")
    made = candidates_of(before, [0, 2], [1, 2, 4], [0], [1])
    found = greedy_cover(made, after, GREEDY)
    assert found.bounds.tolist() == [[0, 0, 1, 1]]
    assert found.gained.tolist() == [1]


def greedy_trap() -> tuple[CandidateSet, OccupancyGrid]:
    """Greedy takes the free middle (6), then pays 10 for the two end cells; the two halves cost 5 each."""
    grid = grid_of("#.######.#")
    return candidates_of(grid, [0, 2, 5], [5, 8, 10], [0], [1]), grid


def test_greedy_is_the_papers_even_where_it_is_not_optimal():
    made, grid = greedy_trap()
    found = cover(made, grid, GREEDY)
    assert found.bounds.tolist() == [[2, 0, 8, 1], [0, 0, 10, 1]]
    assert found.gained.tolist() == [6, 2]


def test_exact_finds_the_optimum_where_greedy_does_not():
    made, grid = greedy_trap()
    found = cover(made, grid, EXACT)
    assert found.weight == 10
    assert found.gained.sum() == 8
    assert not found.uncovered.any()


def test_exact_without_time_says_what_to_do():
    rng = np.random.default_rng(3)
    free = rng.random((40, 40)) < 0.5
    grid = OccupancyGrid(np.zeros(2), 1.0, free.astype(np.uint8), free, 1.0)
    lines = np.arange(0, 41, 4)
    made = candidates_of(grid, lines, lines, lines, lines)
    with pytest.raises(NoPlanError, match=r"raise cover\.time_limit or use cover\.solver greedy"):
        cover(made, grid, CoverConfig(solver="exact", time_limit=1e-9))


def test_exact_warns_of_an_unproven_cover(monkeypatch):
    heard: list[str] = []

    class Listener(Observer):
        def warning(self, text: str) -> None:
            heard.append(text)

    real = exact._solve
    monkeypatch.setattr(exact, "_solve", lambda *a: (real(*a)[0], False))
    made, grid = greedy_trap()
    exact.exact_cover(made, grid, EXACT, Listener())
    assert heard == [
        "The exact cover of 1 parts of the plan was not proven optimal within 60 s; raise cover.time_limit."
    ]

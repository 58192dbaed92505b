"""Candidates and cover against the plain reading of the paper, on hundreds of random layouts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.buildings import building
from floorplan_core.config import CandidatesConfig, CoverConfig
from floorplan_core.model import CandidateSet
from floorplan_core.simulation.layout import layout_only
from floorplan_core.simulation.spec import BuildingSpec
from floorplan_core.stages.candidates import enumerate_candidates
from floorplan_core.stages.exact_cover import exact_cover
from floorplan_core.stages.set_cover import greedy_cover
from tests.reference.cover import array_greedy, optimal_weight, plain_greedy, valid_rectangles
from tests.reference.layouts import RandomLayout, random_layout

SETTINGS = CoverConfig()


def candidates_of(layout: RandomLayout):
    return enumerate_candidates(*layout.planes, layout.blockers, layout.grid, layout.config)


def in_order(candidates: CandidateSet) -> np.ndarray:
    """The rows sorted by (i0, i1, j0, j1)."""
    return np.lexsort(candidates.index().T[::-1])


def expected_of(layout: RandomLayout):
    return valid_rectangles(*layout.planes, layout.blockers, layout.grid, layout.config)


def assert_like_the_paper(layout: RandomLayout) -> int:
    found, expected = candidates_of(layout), expected_of(layout)
    assert len(found) == len(expected)
    order = in_order(found)
    assert found.index()[order].tolist() == [list(r[0]) for r in expected]
    assert found.bounds()[order].tolist() == [list(r[1]) for r in expected]
    cover = greedy_cover(found, layout.grid, SETTINGS)
    choices = plain_greedy(expected, layout.grid.universe)
    rows = [expected[k] for k, _ in choices]
    assert found.index()[cover.chosen].tolist() == [list(r[0]) for r in rows]
    assert cover.bounds.tolist() == [list(r[1]) for r in rows]
    assert cover.total_cells.tolist() == [r[2] for r in rows]
    assert cover.free_cells.tolist() == [r[3] for r in rows]
    assert cover.gained.tolist() == [gained for _, gained in choices]
    covered = np.any([expected[k][4] for k, _ in choices], axis=0) if choices else False
    assert (cover.uncovered == (layout.grid.universe & ~np.asarray(covered))).all()
    return len(expected)


@pytest.mark.parametrize("block", range(10))
def test_four_hundred_layouts(block):
    sizes = [assert_like_the_paper(random_layout(seed)) for seed in range(40 * block, 40 * block + 40)]
    assert sum(sizes) > 100  # the layouts are not trivially empty


@given(st.integers(0, 2**32))
@settings(max_examples=60, deadline=None)
def test_any_layout(seed):
    assert_like_the_paper(random_layout(seed))


@given(st.integers(0, 2**32))
@settings(max_examples=15, deadline=None)
def test_many_planes_few_cells(seed):
    """Many planes between two cells: nearly every ratio is tied."""
    assert_like_the_paper(random_layout(seed, cells=8, most_planes=9))


@pytest.mark.parametrize("style", ["straight", "l", "ring", "grid", "flat"])
@pytest.mark.parametrize(("rooms", "extra"), [(12, 0), (30, 0), (12, 25)])
def test_whole_buildings(style, rooms, extra):
    """Thousands of candidates: long corridors, furniture, rooms not seen, planes that belong to no wall."""
    rng = np.random.default_rng(rooms + extra)
    layout = layout_only(BuildingSpec(style=style, rooms=rooms), rng, seen=0.8)
    x0, y0, x1, y1 = layout.grid.extent
    planes = [
        np.sort(np.concatenate([p, rng.uniform(low, high, extra)]))
        for p, low, high in (
            (layout.x_plus, x0, x1),
            (layout.x_minus, x0, x1),
            (layout.y_plus, y0, y1),
            (layout.y_minus, y0, y1),
        )
    ]
    found = enumerate_candidates(*planes, layout.blockers, layout.grid, CandidatesConfig())
    cover = greedy_cover(found, layout.grid, SETTINGS)
    assert len(found) > 40
    assert len(found.families) < len(found) / 2
    assert list(zip(cover.chosen.tolist(), cover.gained.tolist(), strict=True)) == array_greedy(
        found, layout.grid
    )


def test_families_grow_with_the_corners_not_with_the_rectangles():
    """A corridor four times as long has over nine times the rectangles, but hardly six times the families."""
    sizes, families = [], []
    for width in (40, 80, 160):
        layout = building(width, 17, np.random.default_rng(3))
        found = enumerate_candidates(*layout.planes, layout.blockers, layout.grid, CandidatesConfig())
        sizes.append(len(found))
        families.append(len(found.families))
        assert len(found.families) < len(layout.x_plus) * len(layout.y_plus)
    assert sizes[2] > 9 * sizes[0]
    assert families[2] < 6 * families[0]


def test_reference_agrees_on_everything_free():
    """A fully free hall, where only ties decide: one rectangle, the largest."""
    layout = random_layout(7)
    free = np.ones((14, 14), dtype=bool)
    grid = type(layout.grid)(np.zeros(2), 0.25, free.astype(np.uint8), free, 1.0)
    planes = (np.array([0.0, 0.5]), np.array([3.0, 3.5]), np.array([0.0, 0.5]), np.array([3.0, 3.5]))
    hall = RandomLayout(planes, np.empty((0, 4)), grid, layout.config)
    assert_like_the_paper(hall)
    cover = greedy_cover(candidates_of(hall), grid, SETTINGS)
    assert cover.bounds.tolist() == [[0.0, 0.0, 3.5, 3.5]]


@pytest.mark.parametrize("block", range(5))
def test_exact_is_the_brute_force_optimum(block):
    tried = 0
    for seed in range(60 * block, 60 * block + 60):
        layout = random_layout(seed, cells=10, most_planes=4)
        expected = expected_of(layout)
        if not 2 <= len(expected) <= 11:
            continue
        found = candidates_of(layout)
        best = exact_cover(found, layout.grid, SETTINGS)
        assert best.weight == optimal_weight(expected, layout.grid.universe)
        tried += 1
    assert tried >= 5


@pytest.mark.parametrize("seed", range(40))
def test_exact_is_no_heavier_than_greedy_and_covers_the_same(seed):
    layout = random_layout(seed)
    found = candidates_of(layout)
    greedy, best = greedy_cover(found, layout.grid, SETTINGS), exact_cover(found, layout.grid, SETTINGS)
    assert best.weight <= greedy.weight
    assert (best.uncovered == greedy.uncovered).all()
    assert best.gained.sum() == greedy.gained.sum()

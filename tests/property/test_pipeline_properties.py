"""Random small buildings of boxes: whatever is built and wherever one looks from, the plan is consistent."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.box_world import EYE, LINTEL, Box, rotation, run, slabs, stations, survey, wall
from tests.plan_invariants import assert_valid

T = 0.2  # m, outer walls


def _row(
    widths: list[float], depth: float, thick: float, doors: list[float]
) -> tuple[list[Box], list[float]]:
    """Rooms side by side with a door from each to the next, and where each begins."""
    starts = [sum(widths[:k]) + k * thick for k in range(len(widths))]
    far = starts[-1] + widths[-1]
    boxes = [
        *slabs(-T, -T, far + T, depth + T),
        *wall(0, -T, 0, -T, depth + T),
        *wall(0, far, far + T, -T, depth + T),
        *wall(1, -T, 0, 0, far),
        *wall(1, depth, depth + T, 0, far),
    ]
    for start, door in zip(starts[1:], doors, strict=False):
        at = 0.3 + door * (depth - 1.5)
        boxes += wall(0, start - thick, start, 0, depth, (at, at + 0.9, LINTEL))
    return boxes, starts


@settings(max_examples=15)
@given(
    widths=st.lists(st.floats(2.5, 6), min_size=1, max_size=3),
    depth=st.floats(2.5, 7),
    thick=st.floats(0.1, 0.3),
    doors=st.lists(st.floats(0, 1), min_size=2, max_size=2),
    yaw=st.floats(-45, 45),
    entered=st.integers(1, 3),
    trajectory=st.booleans(),
    seed=st.integers(0, 1000),
)
def test_rows_of_rooms(widths, depth, thick, doors, yaw, entered, trajectory, seed):
    """Some rooms are only seen through a door: the plan is valid, and the rooms entered have their size."""
    boxes, starts = _row(widths, depth, thick, doors)
    entered = min(entered, len(widths))
    places = [p for k in range(entered) for p in stations(widths[k], depth, starts[k])]
    result = run(
        survey(boxes, places, rays=(160, 60), turned=rotation(yaw), seed=seed), trajectory=trajectory
    )
    assert result.plan is not None, result.error
    assert_valid(result.plan)
    if entered == len(widths):
        sizes = sorted(r.area for r in result.plan.regions)
        assert sizes == pytest.approx(sorted(w * depth for w in widths), rel=0.03)
        assert len(result.plan.doors) <= len(widths) - 1


@settings(max_examples=12)
@given(
    furniture=st.lists(
        st.tuples(
            st.floats(0.05, 0.75),
            st.floats(0.05, 0.75),
            st.floats(0.3, 1.6),
            st.floats(0.3, 1.6),
            st.floats(0.3, 1.9),
        ),
        min_size=1,
        max_size=6,
    ),
    seed=st.integers(0, 1000),
)
def test_any_furniture_in_a_room_leaves_it_one_valid_room(furniture, seed):
    """Boxes of up to 1.9 m at random, at walls, in each other; four random places to look from."""
    width, depth = 5.0, 6.0
    boxes, _ = _row([width], depth, 0.2, [])
    things = [
        (u * width, v * depth, 0.0, min(u * width + a, width), min(v * depth + b, depth), h)
        for u, v, a, b, h in furniture
    ]
    rng = np.random.default_rng(seed)
    places: list[tuple[float, float, float]] = []
    while len(places) < 4:
        x, y = rng.uniform(0.3, [width - 0.3, depth - 0.3])
        if not any(t[0] - 0.1 < x < t[3] + 0.1 and t[1] - 0.1 < y < t[4] + 0.1 for t in things):
            places.append((x, y, EYE))
        elif rng.uniform() < 0.02:  # a crowded room: look from above the furniture
            places.append((x, y, 2.2))
    result = run(survey([*boxes, *things], places, rays=(160, 60), seed=seed))
    assert result.plan is not None, result.error
    assert_valid(result.plan)
    biggest = max(result.plan.regions, key=lambda r: r.area)
    assert biggest.area == pytest.approx(width * depth, rel=0.1)

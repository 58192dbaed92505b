"""A length to a wall that nobody saw says so, in the drawing and in the window; the others do not."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from floorplan_core.exporters.dimensions import chain, ends_guessed, overall_span
from floorplan_core.exporters.svg import svg_text
from floorplan_core.model import FloorPlan
from tests.factories import small_flat


def with_guess(plan: FloorPlan, index: int, observed: float) -> FloorPlan:
    """The plan with one side of its first region seen to this share."""
    first = plan.regions[0]
    sides = tuple(replace(s, observed=observed if i == index else 1.0) for i, s in enumerate(first.sides))
    others = [replace(r, sides=tuple(replace(s, observed=1.0) for s in r.sides)) for r in plan.regions[1:]]
    return replace(plan, regions=(replace(first, sides=sides), *others))


@pytest.mark.parametrize("index", range(4))
def test_only_lengths_that_end_at_the_guessed_side_say_so(index: int) -> None:
    plan = with_guess(small_flat(), index, 0.2)
    side = plan.regions[0].sides[index]
    axis = 0 if side.start[0] == side.end[0] else 1  # of the side's normal: lengths along it end there
    x0, y0, x1, y1 = plan.regions[0].polygon.bounds
    assert ends_guessed(plan.regions[:1], axis, ((x0, x1), (y0, y1))[axis])
    assert not ends_guessed(plan.regions[:1], 1 - axis, ((x0, x1), (y0, y1))[1 - axis])
    for face_axis in (0, 1):
        for sign in (-1, 1):
            for span in chain(plan.regions, face_axis, sign):
                at_side = any(abs(end - side.start[axis]) < 1e-6 for end in (span.start, span.end))
                beside = min(side.start[1 - axis], side.end[1 - axis]) - 1e-6 <= span.face
                beside &= span.face <= max(side.start[1 - axis], side.end[1 - axis]) + 1e-6
                assert span.guessed == (face_axis == 1 - axis and at_side and beside)


def test_a_plan_that_was_all_seen_has_no_such_lengths() -> None:
    plan = with_guess(small_flat(), 0, 1.0)
    assert "≈" not in svg_text(plan)
    assert not any(overall_span(plan.regions, axis).guessed for axis in (0, 1))


def test_the_drawing_marks_them_and_explains_the_mark() -> None:
    text = svg_text(with_guess(small_flat(), 0, 0.2))
    assert re.search(r">≈\d+\.\d\d<", text)
    assert "≈ to a speculated wall" in text

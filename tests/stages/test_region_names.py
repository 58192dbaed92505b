"""Names persist over a run: the largest overlap decides, numbers are never used twice."""

from __future__ import annotations

import shapely
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.model import Region
from floorplan_core.stages.region_names import next_number, persist_names


def region(name: str, *box: float) -> Region:
    return Region(f"r{name}", name, shapely.box(*box), "room", 1, 1, 0.0)


def names(regions: tuple[Region, ...]) -> list[str]:
    return [r.name for r in regions]


def test_the_first_plan_is_numbered_in_order() -> None:
    assert names(persist_names([], [region("7", 0, 0, 1, 1), region("9", 2, 0, 3, 1)])) == ["1", "2"]


def test_a_region_that_grew_keeps_its_name_and_id_and_a_new_one_gets_the_next_number() -> None:
    before = [region("1", 0, 0, 4, 2), region("2", 5, 0, 6, 2)]
    now = persist_names(before, [region("1", 8, 0, 9, 2), region("2", 5, 0, 7.5, 2), region("3", 0, 0, 4, 3)])
    assert [(r.name, r.id) for r in now] == [("3", "r3"), ("2", "r2"), ("1", "r1")]
    assert now[1].polygon.bounds == (5, 0, 7.5, 2)


def test_of_two_halves_the_larger_keeps_the_name() -> None:
    assert names(
        persist_names([region("4", 0, 0, 10, 2)], [region("", 0, 0, 4, 2), region("", 4, 0, 10, 2)])
    ) == [
        "5",
        "4",
    ]


def test_of_two_that_merge_the_larger_gives_the_name() -> None:
    before = [region("1", 0, 0, 2, 2), region("2", 2, 0, 9, 2)]
    assert names(persist_names(before, [region("", 0, 0, 9, 2)])) == ["2"]


def test_equal_overlaps_go_to_the_earlier_region() -> None:
    before = [region("8", 0, 0, 4, 2)]
    assert names(persist_names(before, [region("", 0, 0, 2, 2), region("", 2, 0, 4, 2)])) == ["8", "9"]


def test_touching_or_slightly_overlapping_neighbours_are_not_the_same() -> None:
    before = [region("1", 0, 0, 4, 2)]
    assert names(persist_names(before, [region("", 4, 0, 8, 2), region("", 3.5, 2, 8, 4)])) == ["2", "3"]
    assert names(persist_names(before, [region("", 3.8, 0, 8, 2)])) == ["2"]


def test_a_number_that_vanished_is_not_used_again() -> None:
    before = [region("1", 0, 0, 4, 2)]  # 2 and 3 were there once
    assert names(persist_names(before, [region("", 9, 9, 10, 10)], first_unused=4)) == ["4"]
    assert next_number([region("3", 0, 0, 1, 1), region("lobby", 0, 0, 1, 1)]) == 4


boxes = st.tuples(st.integers(0, 8), st.integers(0, 8), st.integers(1, 5), st.integers(1, 5)).map(
    lambda b: (b[0], b[1], b[0] + b[2], b[1] + b[3])
)


@given(st.lists(boxes, max_size=6), st.lists(boxes, max_size=6), st.integers(1, 20))
def test_names_are_unique_and_new_ones_unused(before_boxes, now_boxes, first_unused) -> None:
    before = persist_names([], [region("", *b) for b in before_boxes])
    now = persist_names(before, [region("", *b) for b in now_boxes], first_unused)
    assert len(set(names(now))) == len({r.id for r in now}) == len(now)
    new = set(names(now)) - set(names(before))
    assert all(int(n) >= max(first_unused, len(before) + 1) for n in new)
    assert [r.polygon for r in now] == [shapely.box(*b) for b in now_boxes]


@given(st.lists(boxes, max_size=6, unique=True))
def test_nothing_changes_when_nothing_changed(some) -> None:
    before = persist_names([], [region("", *b) for b in some])
    again = persist_names(before, before)
    assert {r.polygon.bounds: r.name for r in again} == {r.polygon.bounds: r.name for r in before}

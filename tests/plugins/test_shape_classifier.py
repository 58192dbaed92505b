"""The classifier that asks what a place is for: lobbies, halls, L-shaped rooms, short and dead corridors."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from floorcast_plugins.shape_classifier import ShapeClassifier, betweenness, circulation, typical_width
from floorplan_core.config import Config
from floorplan_core.model import Region
from floorplan_core.plugins import default_registry
from floorplan_core.stages.labels import PaperClassifier, label_regions

CONFIG = Config()
OFFICE = shapely.box(0, 0, 4, 5)
L_ROOM = shapely.union_all([shapely.box(0, 0, 6, 2.2), shapely.box(0, 0, 2.2, 9)])
RING = shapely.box(0, 0, 14, 10).difference(shapely.box(2, 2, 12, 8))


def plan_around(polygon: shapely.Polygon, doors: int, others: int | None = None) -> list[Region]:
    """A place ``x`` with doors to as many offices (``others`` of them have doors to it, the rest none)."""
    count = doors if others is None else others
    place = Region("x", "x", polygon, "", 1, 1, 0.0, doors=tuple(f"d{k}" for k in range(doors)))
    offices = [Region(f"o{k}", f"o{k}", OFFICE, "", 1, 1, 0.0, doors=(f"d{k}",)) for k in range(count)]
    return [place, *offices]


def label(polygon: shapely.Polygon, doors: int, others: int | None = None) -> str:
    plan = plan_around(polygon, doors, others)
    return ShapeClassifier().classify(plan[0], plan, CONFIG)


@pytest.mark.parametrize(
    ("what", "polygon", "doors", "expected"),
    [
        ("office", OFFICE, 1, "room"),
        ("office with two doors", OFFICE, 2, "room"),
        ("short straight corridor", shapely.box(0, 0, 12, 1.6), 6, "corridor"),
        ("corridor around a core", RING, 8, "corridor"),
        ("dead-end corridor", shapely.box(0, 0, 9, 1.8), 3, "corridor"),
        ("L-shaped room with one door", L_ROOM, 1, "room"),
        ("hall behind one opening", shapely.box(0, 0, 9, 7), 1, "room"),
        ("hall with three doors", shapely.box(0, 0, 12, 8), 3, "room"),
        ("lobby", shapely.box(0, 0, 8, 6), 7, "corridor"),
        ("long store room", shapely.box(0, 0, 5, 1.6), 1, "room"),
        (
            "bedroom with bath and closet",
            shapely.box(0, 0, 4.8, 1.9).union(shapely.box(0, 0, 3, 4)),
            3,
            "room",
        ),
    ],
)
def test_label_follows_use(what: str, polygon: shapely.Polygon, doors: int, expected: str) -> None:
    others = doors if doors > 3 else max(0, doors - 1) + 1
    assert label(polygon, doors, others) == expected, what


def test_the_papers_rule_gets_these_wrong() -> None:
    plan = plan_around(shapely.box(0, 0, 12, 1.6), 6)
    assert label_regions(plan, PaperClassifier(), CONFIG)[0].label == "room"
    assert label_regions(plan, ShapeClassifier(), CONFIG)[0].label == "corridor"


def test_betweenness_of_a_star_and_a_path() -> None:
    star = betweenness((("a", ("1", "2", "3")), ("b", ("1",)), ("c", ("2",)), ("d", ("3",))))
    assert star == {"a": 1.0, "b": 0.0, "c": 0.0, "d": 0.0}
    path = betweenness((("a", ("1",)), ("b", ("1", "2")), ("c", ("2", "3")), ("d", ("3",))))
    assert path["b"] == path["c"] == pytest.approx(2 / 3)


def test_betweenness_without_doors_or_with_outer_ones_is_zero() -> None:
    assert betweenness((("a", ()), ("b", ("front",)))) == {"a": 0.0, "b": 0.0}


@given(a=st.floats(0.8, 20), b=st.floats(0.8, 20))
def test_width_of_a_rectangle_is_its_shorter_side(a: float, b: float) -> None:
    assert typical_width(shapely.box(0, 0, a, b)) == pytest.approx(min(a, b), rel=0.02)


@given(scale=st.floats(0.5, 4), turn=st.sampled_from([90, 180, 270]))
def test_width_turns_and_scales(scale: float, turn: int) -> None:
    moved = shapely.affinity.rotate(shapely.affinity.scale(L_ROOM, scale, scale), turn)
    assert typical_width(moved) == pytest.approx(scale * typical_width(L_ROOM), rel=1e-3)


def test_more_doors_and_more_ways_never_speak_for_a_room() -> None:
    odds = [circulation(OFFICE, doors, 0.1 * doors) for doors in range(9)]
    assert np.all(np.diff(odds[1:]) > 0)


def test_found_by_name() -> None:
    assert default_registry().classifier("shape").name == "shape"

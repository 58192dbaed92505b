"""Door symbols: an open door swings, an opening has no leaf, a shut one lies across its opening."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from floorplan_core.exporters.door_symbols import leaves, swings
from floorplan_core.exporters.svg import svg_text
from floorplan_core.exporters.walls import Opening, poche
from floorplan_core.model import Door
from tests.factories import DoorSpec, RoomSpec, make_plan, small_flat

DOOR = Door("d1", ("p1",), 0, 4.06, 2.0, 2.9, thickness=0.12)


def _leaves(door: Door):
    return leaves(Opening(door, (4.0, door.start, 4.12, door.end)), ())


def test_an_open_door_sweeps_a_quarter_and_an_opening_has_no_leaf():
    (leaf,) = _leaves(DOOR)
    assert leaf.sector.area == pytest.approx(np.pi / 4 * 0.9**2, rel=0.01)
    assert not leaf.shut
    assert _leaves(replace(DOOR, kind="opening")) == ()


@pytest.mark.parametrize(("width", "count"), [(0.9, 1), (1.6, 2)])
def test_a_shut_door_lies_in_the_middle_of_its_wall(width, count):
    made = _leaves(replace(DOOR, end=2.0 + width, shut=True))
    assert len(made) == count
    line = shapely.line_merge(shapely.MultiLineString([np.array([m.hinge, m.tip]) for m in made]))
    assert line.bounds == pytest.approx((4.06, 2.0, 4.06, 2.0 + width))
    assert line.length == pytest.approx(width)
    assert all(m.shut and m.sector.is_empty for m in made)


def test_the_drawing_says_shut():
    plan = small_flat()
    one = plan.doors[0]
    text = svg_text(replace(plan, doors=(replace(one, shut=True), *plan.doors[1:])))
    assert f"Shut door {one.id}" in text
    assert text.count("<path") < svg_text(plan).count("<path")  # one arc less


def test_doors_side_by_side_do_not_swing_into_each_other():
    """Two doors into one corner of a room: the later one opens elsewhere."""
    flat = RoomSpec((0.0, 0.0, 4.0, 4.0)), RoomSpec((4.15, 0.0, 8.0, 4.0)), RoomSpec((0.0, 4.15, 8.0, 6.0))
    plan = make_plan(
        flat,
        (DoorSpec(0, 4.075, 2.9, 3.8, joins=(0, 1)), DoorSpec(1, 4.075, 2.9, 3.8, joins=(0, 2))),
    )
    (one,), (other,) = swings(poche(plan).openings, plan.regions)
    assert one.sector.distance(other.sector) > 0.0
    alone = [leaves(opening, plan.regions)[0].sector for opening in poche(plan).openings]
    assert alone[0].intersects(alone[1])

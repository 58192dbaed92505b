"""Flights of stairs: what rises as stairs do is a region of its own, entered at its foot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from floorplan_core.geometry.columns import height_mask
from floorplan_core.model import Door, FloorPlan
from floorplan_core.model import corrections as c
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.stairs import Flight, apart_from_stairs, find_flights, openings, part_flights
from tests.box_world import EYE, HEIGHT, LINTEL, Box, room, run, stations, survey, wall
from tests.drawn_cells import seen_free
from tests.sessions import local

RISER, TREAD, STEPS = 0.18, 0.27, 12
FOOT = 1.0  # m, where the flight begins along y
DOORS = [Door("d1", (), 1, 0.0, 0.2, 1.0), Door("d2", (), 1, 0.0, 3.0, 4.0)]  # to a hall from y = 0


def steps(x0: float, x1: float, riser: float = RISER, count: int = STEPS) -> list[Box]:
    """A flight along y, each step solid down to the floor."""
    return [
        (x0, FOOT + TREAD * k, 0.0, x1, FOOT + TREAD * (k + 1), min(riser * (k + 1), HEIGHT))
        for k in range(count)
    ]


def seen(boxes: list[Box], turn: int = 0, inferred: bool = False) -> Evidence:
    """Columns of 6 x 6 m in which the tops of boxes and the floor were seen, and all above was free."""
    top = np.zeros((120, 120))
    for x0, y0, _, x1, y1, z1 in boxes:
        rows, columns = (slice(round(a / 0.05), round(b / 0.05)) for a, b in ((y0, y1), (x0, x1)))
        top[rows, columns] = np.maximum(top[rows, columns], z1)
    top = np.rot90(top, turn).copy()
    level = np.minimum(np.floor(top / 0.1 + 1e-6), 40).astype(np.uint64)
    coarse = np.maximum.reduce([level[::2, ::2], level[1::2, ::2], level[::2, 1::2], level[1::2, 1::2]])
    free = ~((np.uint64(2) << coarse) - np.uint64(1)) & height_mask(0.0, 2.6)
    return seen_free(free, hits=np.uint64(1) << level, inferred=inferred)


@pytest.mark.parametrize(("turn", "axis", "up"), [(0, 1, 1), (1, 0, 1), (2, 1, -1), (3, 0, -1)])
def test_a_flight_is_found_whichever_way_it_rises(turn, axis, up):
    (flight,) = find_flights(seen(steps(2.0, 3.0), turn))
    assert (flight.axis, flight.up) == (axis, up)
    size = np.array(flight.bounds[2:]) - flight.bounds[:2]
    assert size[1 - axis] == pytest.approx(1.0, abs=0.21)
    assert size[axis] == pytest.approx(TREAD * STEPS, abs=0.4)
    assert flight.foot == pytest.approx(FOOT if up > 0 else 6.0 - FOOT, abs=0.11)


@pytest.mark.parametrize(
    "boxes",
    [
        steps(2.0, 3.0, riser=0.05),  # a ramp
        steps(2.0, 3.0, riser=0.4, count=6),  # shelves, one behind the other
        steps(2.0, 3.0, count=5),  # a rostrum
        steps(2.0, 2.2),  # a railing, or what was seen of a wall at a slant
        [(2.0, 1.0, 0.0, 3.0, 4.0, 0.8), (2.0, 4.0, 0.0, 3.0, 4.5, 1.9)],  # a bed and a cabinet
    ],
)
def test_what_rises_otherwise_is_no_flight(boxes):
    assert find_flights(seen(boxes)) == ()


def test_a_cloud_without_free_space_shows_none():
    assert find_flights(seen(steps(2.0, 3.0), inferred=True)) == ()


def test_a_flight_goes_on_to_the_walls_near_it_and_not_beyond_its_foot():
    hall, flight = shapely.box(0, 0, 5, 6), Flight(1, 1, (0.2, 1.0, 1.0, 5.3))
    rest, stairs = part_flights(hall, [flight], DOORS)
    assert shapely.equals(stairs, shapely.box(0, 1.0, 1.0, 6))
    assert shapely.equals(rest, hall.difference(stairs))


def test_a_stairwell_is_one_room():
    """It has one door only, or nothing but flights."""
    well, flight = shapely.box(0, 0, 5, 6), Flight(1, 1, (0.0, 1.0, 1.2, 4.7))
    assert part_flights(well, [flight], DOORS[:1]) == [well]
    assert part_flights(shapely.box(0, 0, 1.5, 6), [flight], DOORS) == [shapely.box(0, 0, 1.5, 6)]


def test_an_opening_lies_at_the_foot():
    (opening,) = openings([Flight(0, -1, (1.0, 2.0, 4.0, 3.0))], [Door("d7", (), 0, 0.0, 0.0, 1.0)])
    assert (opening.id, opening.axis, opening.offset) == ("d8", 0, 4.0)
    assert (opening.start, opening.end) == (2.0, 3.0)
    assert opening.kind == "opening" and opening.evidence == ("stairs",)


def hall_with_stairs() -> tuple[list[Box], list[tuple[float, float, float]]]:
    """Boxes and stations: the hall has two rooms beside it."""
    ways = wall(0, 5.0, 5.1, 0.0, 6.0, (0.5, 1.4, LINTEL), (4.0, 4.9, LINTEL))
    across = wall(1, 2.9, 3.0, 5.1, 8.0)
    boxes = [*room(8, 6), *ways, *across, *steps(0.0, 1.0)]
    places = [(2.0 + x, y, z) for x, y, z in stations(3, 6)] + [(6.5, 1.0, EYE), (6.5, 4.4, EYE)]
    return boxes, places


def opening_of(plan: FloorPlan) -> list[Door]:
    return [door for door in plan.doors if "stairs" in door.evidence]


def test_the_stairs_of_a_hall_are_a_region_that_an_opening_joins_to_it():
    found = run(survey(*hall_with_stairs(), rays=(400, 160)))
    assert found.plan is not None
    (opening,) = (door for door in found.plan.doors if door.evidence == ("stairs",))
    regions = {r.id: r for r in found.plan.regions}
    stairs, hall = sorted((regions[name] for name in opening.connects), key=lambda r: r.area)
    assert len(regions) == 4
    assert shapely.intersection(stairs.polygon, shapely.box(0, FOOT, 1, 6)).area > 0.85 * stairs.area
    assert 2.5 < stairs.area < 6 - FOOT
    assert hall.area + stairs.area == pytest.approx(5 * 6, abs=0.8)


@pytest.mark.parametrize("said", ["rejected", "accepted"])
def test_an_opening_of_stairs_is_rejected_with_its_flight_or_accepted_as_any_door_is(said):
    def corrected(plan: FloorPlan) -> list[c.Correction]:
        assert len(plan.regions) == 4
        at = local(plan, *opening_of(plan)[0].line().mean(axis=0))
        return [c.RejectDoor(at) if said == "rejected" else c.AcceptDoor(at)]

    plan = run(survey(*hall_with_stairs(), rays=(400, 160)), corrected=corrected).plan
    assert plan is not None and plan.warnings == ()
    if said == "rejected":
        assert len(plan.regions) == 3 and opening_of(plan) == []
    else:
        assert len(plan.regions) == 4
        assert [(d.by_hand, d.confidence) for d in opening_of(plan)] == [("accepted", 1.0)]


def test_doors_are_told_from_the_openings_of_flights():
    flight = Flight(0, -1, (1.0, 2.0, 4.0, 3.0))
    door, opening = DOORS[0], openings([flight], DOORS)[0]
    assert apart_from_stairs([door, opening], [flight]) == ((door,), (opening,), (flight,))
    assert apart_from_stairs([door], [flight]) == ((door,), (), ())
    elsewhere = replace(opening, start=3.5, end=4.0)
    assert apart_from_stairs([elsewhere], [flight]) == ((), (elsewhere,), ())

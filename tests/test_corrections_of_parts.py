"""Corrections on a site of two buildings, and of rooms of a wing: each thing is corrected where it lies."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from floorplan_core.config import Config
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.model import FloorPlan, Region
from floorplan_core.model import corrections as c
from floorplan_core.observer import Observer
from floorplan_core.session import PlanningSession
from floorplan_core.stages.corrections_islands import building_at
from tests.app.surveys import campus
from tests.plan_invariants import assert_valid
from tests.sessions import at_plane, local, plan
from tests.wing_world import WingWorld

LOW = 2.2  # m, the lower half of a ceiling


@pytest.fixture(scope="module")
def session() -> PlanningSession:
    made = PlanningSession(campus().reconstruction(), Config())
    made.read(Observer())
    return made


@pytest.fixture(scope="module")
def machine(session: PlanningSession) -> FloorPlan:
    found = plan(session)
    assert len(found.regions) == 4 and len(found.wings) == 1
    return found


def rooms(made: FloorPlan, large: bool) -> list[Region]:
    """The regions of the large building, which stands in the east, or of the small one; by x."""
    middle = float(np.mean(made.grid.extent[::2]))
    own = [r for r in made.regions if (r.polygon.centroid.x > middle) == large]
    return sorted(own, key=lambda r: r.polygon.bounds[0])


def inside(made: FloorPlan, region: Region) -> c.Point:
    at = region.polygon.representative_point()
    return local(made, at.x, at.y)


def door_of(made: FloorPlan, room: Region):
    return next(d for d in made.doors if room.id in d.connects)


def end_wall(made: FloorPlan, large: bool):
    """The far wall of the east room."""
    east = rooms(made, large)[1]
    x = east.polygon.bounds[2]
    known = {p.id: p for p in made.all_planes}
    return next(known[s.plane] for s in east.sides if s.start[0] == s.end[0] == pytest.approx(x))


def across(made: FloorPlan, room: Region, at: float) -> tuple[c.Point, c.Point]:
    """A line from side to side of a room along y, ``at`` metres from its west wall."""
    x0, y0, _, y1 = room.polygon.bounds
    return local(made, x0 + at, y0), local(made, x0 + at, y1)


def areas(made: FloorPlan, large: bool) -> list[float]:
    return [r.area for r in rooms(made, large)]


Case = tuple[Callable[[FloorPlan, bool], c.Correction], Callable[[FloorPlan, FloorPlan, bool], None]]


def _moved(made: FloorPlan, large: bool) -> c.Correction:
    wall = end_wall(made, large)
    start, end = wall.observed[0]
    return c.MovePlane(at_plane(made, wall), local(made, wall.offset - 0.4, float(start + end) / 2))


def _is_moved(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    assert areas(after, large)[1] == pytest.approx(areas(before, large)[1] - 0.4 * 5.0, abs=0.1)
    assert end_wall(after, large).by_hand == "moved"
    assert end_wall(after, large).id in after.machine


def _hidden(made: FloorPlan, large: bool) -> c.Correction:
    return c.HidePlane(at_plane(made, end_wall(made, large)))


def _is_hidden(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    wall = end_wall(before, large).id
    assert next(p for p in after.all_planes if p.id == wall).by_hand == "hidden"


def _walled(made: FloorPlan, large: bool) -> c.Correction:
    return c.AddWall(*across(made, rooms(made, large)[0], 1.5), 0.1)


def _is_walled(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    assert len(rooms(after, large)) == 3
    assert areas(after, large)[0] == pytest.approx(1.45 * 5.0, abs=0.2)
    assert len([p for p in after.all_planes if p.by_hand == "added"]) == 2


def _doored(made: FloorPlan, large: bool) -> c.Correction:
    west = rooms(made, large)[0].polygon.bounds
    return c.AddDoor(local(made, west[2], west[3] - 1.3), local(made, west[2], west[3] - 0.4))


def _is_doored(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    assert len(after.doors) == len(before.doors) + 1
    (added,) = [d for d in after.doors if d.by_hand == "added"]
    assert set(added.connects) == {r.id for r in rooms(after, large)}


def _rejected(made: FloorPlan, large: bool) -> c.Correction:
    middle = door_of(made, rooms(made, large)[0]).line().mean(axis=0)
    return c.RejectDoor(local(made, *middle))


def _is_rejected(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    assert all(room.doors == () for room in rooms(after, large))
    assert len(after.doors) == 1


def _resized(made: FloorPlan, large: bool) -> c.Correction:
    line = door_of(made, rooms(made, large)[0]).line()
    wider = [line[0] - (line[1] - line[0]) * 0.2, line[1]]
    return c.ResizeDoor(local(made, *line.mean(axis=0)), *(local(made, *end) for end in wider))


def _is_resized(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    old, new = (door_of(made, rooms(made, large)[0]) for made in (before, after))
    assert new.width == pytest.approx(1.2 * old.width, abs=1e-3)
    assert new.by_hand == "resized"


def _accepted(made: FloorPlan, large: bool) -> c.Correction:
    return c.AcceptDoor(local(made, *door_of(made, rooms(made, large)[0]).line().mean(axis=0)))


def _is_accepted(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    assert door_of(after, rooms(after, large)[0]).confidence == 1.0


def _split(made: FloorPlan, large: bool) -> c.Correction:
    return c.SplitRegion(*across(made, rooms(made, large)[0], 1.5))


def _is_split(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    assert len(rooms(after, large)) == 3
    assert sum(areas(after, large)) == pytest.approx(sum(areas(before, large)), abs=1e-3)
    assert areas(after, large)[0] == pytest.approx(1.5 * 5.0, abs=0.1)


def _merged(made: FloorPlan, large: bool) -> c.Correction:
    return c.MergeRegions(tuple(inside(made, r) for r in rooms(made, large)))


def _is_merged(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    (one,) = rooms(after, large)
    assert one.area == pytest.approx(sum(areas(before, large)) + 0.1 * 5.0, abs=0.1)


def _named(made: FloorPlan, large: bool) -> c.Correction:
    return c.NameRegion(inside(made, rooms(made, large)[0]), "Shed")


def _is_named(before: FloorPlan, after: FloorPlan, large: bool) -> None:
    assert rooms(after, large)[0].name == "Shed"


CASES: dict[str, Case] = {
    "move": (_moved, _is_moved),
    "hide": (_hidden, _is_hidden),
    "wall": (_walled, _is_walled),
    "door": (_doored, _is_doored),
    "reject": (_rejected, _is_rejected),
    "resize": (_resized, _is_resized),
    "accept": (_accepted, _is_accepted),
    "split": (_split, _is_split),
    "merge": (_merged, _is_merged),
    "name": (_named, _is_named),
}


@pytest.mark.parametrize("large", [False, True], ids=["small", "large"])
@pytest.mark.parametrize("case", CASES)
def test_a_correction_reaches_the_building_where_it_lies(
    session: PlanningSession, machine: FloorPlan, case: str, large: bool
) -> None:
    say, check = CASES[case]
    after = plan(session, say(machine, large))
    new = set(after.warnings) - set(machine.warnings)
    assert all("of free space are in no region" in text for text in new)  # a wall was taken away from it
    check(machine, after, large)
    untouched = [r.polygon.wkb for r in rooms(machine, not large)]
    assert [r.polygon.wkb for r in rooms(after, not large)] == untouched
    assert_valid(after)
    assert geojson_text(plan(session)) == geojson_text(machine)


def test_regions_of_two_buildings_are_not_merged(session: PlanningSession, machine: FloorPlan) -> None:
    places = inside(machine, rooms(machine, False)[0]), inside(machine, rooms(machine, True)[0])
    after = plan(session, c.MergeRegions(places))
    assert any("stand in different buildings: they cannot be merged" in text for text in after.warnings)
    assert [r.polygon.wkb for r in after.regions] == [r.polygon.wkb for r in machine.regions]


def test_only_the_building_that_is_corrected_is_planned_again(
    session: PlanningSession, machine: FloorPlan, monkeypatch: pytest.MonkeyPatch
) -> None:
    from floorplan_core import layout

    plan(session)
    regions: list[int] = []
    build = layout.build_regions

    def counted(*given):
        regions.append(1)
        return build(*given)

    monkeypatch.setattr(layout, "build_regions", counted)
    plan(session, _moved(machine, False))
    assert len(regions) == 1
    plan(session, _moved(machine, False), _moved(machine, True))
    assert len(regions) == 2


def test_where_boxes_overlap_the_nearer_surface_decides() -> None:
    def building(*columns: tuple[int, int]) -> SimpleNamespace:
        hits = np.zeros((40, 40), dtype=np.uint64)
        for x, y in columns:
            hits[y, x] = 1
        return SimpleNamespace(origin=np.zeros(2), shape=(20, 20), cell=1.0, fine=0.5, hits=hits)

    corner, inner = building((0, 0), (39, 0), (39, 39)), building((8, 30))
    assert building_at([(4.0, 14.0)], [corner, inner]) == 1
    assert building_at([(18.0, 2.0)], [corner, inner]) == 0
    assert building_at([(4.0, 14.0), (18.0, 2.0)], [corner, inner]) is None


def test_parts_of_a_room_in_a_wing_are_as_high_as_they_were_seen() -> None:
    world = WingWorld(45.0)
    world.wing = [*world.wing, (7.6, 0.0, LOW, 9.1, 5.0, 2.6)]
    session = PlanningSession(world.survey(rays=(150, 46)).reconstruction(), Config())
    session.read(Observer())
    before = plan(session)
    ends = world.world(np.array([(7.6, -0.2, 0.0), (7.6, 5.2, 0.0)]))[:, :2]
    far = tuple(before.frame.plan_from_local(world.world(np.array([(8.3, 2.5, 0.0)]))[:, :2])[0])
    assert len(before.wings) == 1
    after = plan(session, c.SplitRegion(*(tuple(map(float, end)) for end in ends)))
    parts = [r for r in after.regions if "split" in r.by_hand]
    assert len(parts) == 2
    low = min(parts, key=lambda r: math.dist(r.polygon.centroid.coords[0], far))
    (high,) = [r for r in parts if r is not low]
    assert low.height == pytest.approx(LOW, abs=0.03)
    assert high.height == pytest.approx(2.6, abs=0.03)
    others = {r.id: r.height for r in before.regions}
    assert all(r.height == others[r.id] for r in after.regions if not r.by_hand)
    again = plan(
        session,
        c.SplitRegion(*(tuple(map(float, end)) for end in ends)),
        c.MergeRegions(tuple(inside(after, r) for r in parts)),
    )
    (one,) = [r for r in again.regions if "merged" in r.by_hand]
    assert one.height == pytest.approx(others[one.id], abs=0.01)

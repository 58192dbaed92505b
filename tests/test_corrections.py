"""What a person says against the machine, on a building that is known: two rooms, a door between."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.model import FloorPlan, LocalFrame
from floorplan_core.model import corrections as c
from floorplan_core.observer import Observer
from floorplan_core.session import PlanningSession
from tests.plan_invariants import assert_valid
from tests.sessions import (
    DEPTH,
    WIDTH,
    at_plane,
    by_size,
    left_and_right,
    local,
    plan,
    stages_run,
    two_room_session,
    wall_between,
)


@pytest.fixture(scope="module")
def session() -> Iterator[PlanningSession]:
    yield two_room_session()


@pytest.fixture(scope="module")
def machine(session) -> FloorPlan:
    """The plan without any correction."""
    made = plan(session)
    assert [round(r.area) for r in made.regions] == [20, 20]
    assert len(made.doors) == 1
    return made


def _door_at(made: FloorPlan, index: int = 0) -> c.Point:
    x, y = made.doors[index].line().mean(axis=0)
    return local(made, x, y)


def _inside(made: FloorPlan, region) -> c.Point:
    at = region.polygon.representative_point()
    return local(made, at.x, at.y)


# ---- walls ----------------------------------------------------------------------------------------


def test_hiding_both_faces_of_a_wall_joins_the_rooms(session, machine):
    left, right = wall_between(machine)
    made = plan(session, c.HidePlane(at_plane(machine, left)), c.HidePlane(at_plane(machine, right)))
    assert_valid(made)
    assert [r.area for r in made.regions] == [pytest.approx((2 * WIDTH + 0.1) * DEPTH, rel=0.01)]
    assert made.doors == ()
    assert made.warnings == ()
    assert set(made.corrected) == {("plane", left.id), ("plane", right.id)}
    assert made.machine[left.id] == f"wall at {left.offset:.3f} m"


def test_a_hidden_wall_can_be_kept_again(session, machine):
    """Switched off and on: the plan is the machine's, but the wall is locked."""
    left, _ = wall_between(machine)
    made = plan(session, c.HidePlane(at_plane(machine, left)), c.KeepPlane(at_plane(machine, left)))
    assert [r.polygon for r in made.regions] == [r.polygon for r in machine.regions]
    assert {p.by_hand for p in made.planes if p.id == left.id} == {"kept"}


def test_keeping_a_wall_makes_it_pairable_whatever_the_settings(session, machine):
    """With a huge least support all sides are guesses; walls that are kept are sides again."""
    demanding = Config().with_values({"planes.min_support": "20"})
    with suppress(NoPlanError):  # guesses need not close a room
        assert any(p.speculated for p in plan(session, config=demanding).planes)
    kept = [c.KeepPlane(at_plane(machine, p)) for p in machine.planes]
    made = plan(session, *kept, config=demanding)
    assert not any(p.speculated for p in made.planes)
    assert [r.area for r in by_size(made)] == pytest.approx([r.area for r in by_size(machine)])


def test_a_moved_wall_is_where_it_was_put(session, machine):
    """To the millimetre, whatever was measured beside it; the door in it follows."""
    face, _ = wall_between(machine)
    for offset in (face.offset - 0.07, face.offset - 0.5):
        made = plan(session, c.MovePlane(at_plane(machine, face), local(machine, offset, 0.0)))
        assert_valid(made)
        left, right = left_and_right(made)
        assert left.polygon.bounds[2] == pytest.approx(offset, abs=1e-6)
        assert right.polygon.bounds == pytest.approx(left_and_right(machine)[1].polygon.bounds, abs=1e-6)
        assert len(made.doors) == 1
        assert made.doors[0].thickness == pytest.approx(0.1 + face.offset - offset, abs=0.01)
        side = max((s for s in left.sides if s.plane == face.id), key=lambda s: s.length)
        assert side.observed == 1.0
        assert [w for w in made.warnings if "in no region" not in w] == []


def test_a_wall_moved_twice_is_found_where_it_is(session, machine):
    face, _ = wall_between(machine)
    first = c.MovePlane(at_plane(machine, face), local(machine, face.offset - 0.3, 0.0))
    there = plan(session, first)
    moved = next(p for p in there.planes if p.id == face.id)
    again = c.MovePlane(at_plane(there, moved), local(machine, face.offset - 0.55, 0.0))
    made = plan(session, first, again)
    assert left_and_right(made)[0].polygon.bounds[2] == pytest.approx(face.offset - 0.55, abs=1e-6)
    assert made.machine[face.id] == f"wall at {face.offset:.3f} m"


@pytest.mark.parametrize("thickness", [0.0, 0.1, 0.3])
def test_an_added_wall_cuts_a_room(session, machine, thickness):
    """Two clicks near the walls, a hand's breadth askew: the wall reaches both and is as thick as said."""
    left, _ = left_and_right(machine)
    x0, y0, x1, y1 = left.polygon.bounds
    middle = (y0 + y1) / 2 - 0.4
    ends = local(machine, x0 + 0.3, middle - 0.02), local(machine, x1 - 0.35, middle + 0.02)
    made = plan(session, c.AddWall(*ends, thickness))
    assert_valid(made)
    assert len(made.regions) == 3
    total = sum(r.area for r in made.regions)
    assert total == pytest.approx(2 * WIDTH * DEPTH - WIDTH * thickness, rel=0.005)
    edges = {round(v, 4) for r in made.regions for v in r.polygon.bounds[1::2]}
    assert {round(middle - thickness / 2, 4), round(middle + thickness / 2, 4)} <= edges
    assert [p.by_hand for p in made.planes if p.id.startswith("hw")] == ["added", "added"]
    new = [s for r in made.regions for s in r.sides if s.plane.startswith("hw")]
    assert len(new) == 2
    assert all(s.observed == 1 and s.residual is None for s in new)  # nobody measured them


def test_a_wall_that_ends_in_the_open_is_in_no_region(session, machine):
    left, _ = left_and_right(machine)
    x0, y0, *_ = left.polygon.bounds
    ends = local(machine, x0, y0 + 2.0), local(machine, x0 + 2.0, y0 + 2.0)
    made = plan(session, c.AddWall(*ends, 0.1))
    assert_valid(made)
    assert left_and_right(made)[0].area == pytest.approx(WIDTH * DEPTH - 2.0 * 0.1, abs=0.15)


def test_no_plane_is_speculated_where_one_was_switched_off():
    """A room whose far wall is not there ends at a guess; refused, the room ends nowhere: it is no region."""
    open_session = two_room_session(open_end=True)
    before = plan(open_session)
    guesses = [p for p in before.planes if p.speculated]
    assert guesses
    assert len(before.regions) == 2
    made = plan(open_session, *(c.HidePlane(at_plane(before, p, 0.0)) for p in guesses))
    assert [p for p in made.planes if p.speculated and p.by_hand != "hidden"] == []
    assert [r.polygon.bounds for r in made.regions] == [
        pytest.approx(left_and_right(before)[0].polygon.bounds)
    ]
    assert any("in no region" in text for text in made.warnings)


# ---- doors ----------------------------------------------------------------------------------------


def test_a_rejected_door_is_wall(session, machine):
    made = plan(session, c.RejectDoor(_door_at(machine)))
    assert_valid(made)
    assert made.doors == ()
    assert [r.area for r in by_size(made)] == pytest.approx([r.area for r in by_size(machine)])
    door = machine.doors[0]
    for face in wall_between(made):
        start, end = max(face.walls, key=lambda w: w[1] - w[0])
        assert start <= door.start and door.end <= end


def test_an_added_door_joins_the_rooms_and_opens_the_wall(session, machine):
    door = machine.doors[0]
    start, end = door.start - 1.5, door.start - 0.6
    drawn = c.AddDoor(local(machine, door.offset + 0.2, start), local(machine, door.offset + 0.2, end))
    made = plan(session, drawn)
    assert_valid(made)
    (added,) = [d for d in made.doors if d.by_hand]
    assert (added.start, added.end) == pytest.approx((start, end))
    assert added.thickness == pytest.approx(0.1, abs=0.01)
    assert set(added.connects) == {r.id for r in made.regions}
    assert ("door", added.id) in made.corrected
    for face in wall_between(made):
        assert not any(s < (start + end) / 2 < e for s, e in face.walls)


def test_an_added_door_takes_the_place_of_one_that_it_overlaps(session, machine):
    door = machine.doors[0]
    ends = [local(machine, door.offset, v) for v in (door.start - 0.2, door.end + 0.1)]
    made = plan(session, c.AddDoor(ends[0], ends[1]))
    assert [d.by_hand for d in made.doors] == ["added"]


def test_an_added_door_ends_where_the_next_one_begins(session, machine):
    """A few centimetres of overlap are the clicks' fault: both doors are there."""
    door = machine.doors[0]
    ends = [local(machine, door.offset, v) for v in (door.end - 0.04, door.end + 0.9)]
    made = plan(session, c.AddDoor(ends[0], ends[1]))
    assert_valid(made)
    old, new = sorted(made.doors, key=lambda d: d.start)
    assert (old.start, old.end) == (door.start, door.end)
    assert (new.start, new.end) == pytest.approx((door.end, door.end + 0.9))


def test_a_resized_door_has_the_width_said(session, machine):
    door = machine.doors[0]
    ends = [local(machine, door.offset, v) for v in (door.start - 0.1, door.end + 0.2)]
    made = plan(session, c.ResizeDoor(_door_at(machine), ends[0], ends[1]))
    assert_valid(made)
    (resized,) = made.doors
    assert resized.width == pytest.approx(door.width + 0.3)
    assert resized.by_hand == "resized"
    assert "by hand" in resized.evidence
    assert made.machine[door.id].startswith(f"door, {door.width:.3f} m wide")


def test_an_accepted_door_stays_whatever_the_settings(session, machine):
    """Settings under which the machine reports no door: the accepted one is there."""
    sceptical = Config().with_values({"doors.min_confidence": "1.0"})
    assert plan(session, config=sceptical).doors == ()
    made = plan(session, c.AcceptDoor(_door_at(machine)), config=sceptical)
    assert_valid(made)
    (door,) = made.doors
    assert door.confidence == 1.0
    assert door.width == pytest.approx(machine.doors[0].width)


# ---- regions ----------------------------------------------------------------------------------------


def test_merged_regions_take_the_wall_in(session, machine):
    made = plan(session, c.MergeRegions(tuple(_inside(machine, r) for r in machine.regions)))
    assert_valid(made)
    (whole,) = made.regions
    assert whole.area == pytest.approx((2 * WIDTH + 0.1) * DEPTH, rel=0.01)
    assert made.doors == ()  # the door between them is none any more
    assert whole.by_hand == ("merged",)
    assert whole.id == by_size(machine)[0].id


def test_split_and_merged_again_is_the_same_room(session, machine):
    left, _ = left_and_right(machine)
    x0, y0, x1, _ = left.polygon.bounds
    cut = c.SplitRegion(local(machine, x0 - 0.2, y0 + 2), local(machine, x1 + 0.01, y0 + 2.1))
    two = plan(session, cut)
    assert_valid(two)
    parts = sorted((r for r in two.regions if r.by_hand), key=lambda r: -r.area)
    assert [p.area for p in parts] == pytest.approx([WIDTH * (DEPTH - 2.05), WIDTH * 2.05], rel=0.01)
    assert parts[0].id == left.id
    one = plan(session, cut, c.MergeRegions(tuple(_inside(two, p) for p in parts)))
    assert_valid(one)
    assert left_and_right(one)[0].area == pytest.approx(left.area, abs=1e-4)
    assert len(one.regions) == 2


def test_a_split_line_needs_to_part_the_region(session, machine):
    left, _ = left_and_right(machine)
    x0, y0, x1, y1 = left.polygon.bounds
    sliver = c.SplitRegion(local(machine, x0, y0 + 0.05), local(machine, x1, y0 + 0.05))
    outside = c.SplitRegion(local(machine, x0 - 3, y0), local(machine, x0 - 3, y1))
    made = plan(session, sliver, outside)
    assert len(made.regions) == 2
    assert len(made.warnings) == 2


def test_labels_and_names(session, machine):
    """A label is any word; a name that another region has goes to the one that a person named."""
    left, right = left_and_right(machine)
    said = [
        c.LabelRegion(_inside(machine, left), "kitchen"),
        c.NameRegion(_inside(machine, left), right.name),
        c.NameRegion(_inside(machine, left), "Küche"),
    ]
    made = plan(session, *said[:2])
    assert_valid(made)
    assert left_and_right(made)[0].name == right.name
    assert left_and_right(made)[1].name not in (left.name, right.name)
    made = plan(session, *said)
    assert left_and_right(made)[0].label == "kitchen"
    assert [r.name for r in left_and_right(made)] == ["Küche", "3"]
    assert made.machine[left.id] == f"label room; name {left.name}"


# ---- all of them ----------------------------------------------------------------------------------------

FAR = (900.0, 900.0)
NOWHERE = (
    c.MovePlane(c.PlaneAt(FAR, (1.0, 0.0)), FAR),
    c.AddWall(FAR, FAR),
    c.AcceptDoor(FAR),
    c.RejectDoor(FAR),
    c.AddDoor(FAR, (901.0, 900.0)),
    c.ResizeDoor(FAR, FAR, (901.0, 900.0)),
    c.LabelRegion(FAR, "x"),
    c.NameRegion(FAR, "x"),
    c.MergeRegions((FAR, (0.0, 0.0))),
    c.SplitRegion(FAR, (901.0, 900.0)),
)


@pytest.mark.parametrize("lost", NOWHERE, ids=lambda x: type(x).__name__)
def test_what_finds_nothing_is_a_sentence(session, machine, lost):
    made = plan(session, lost)
    assert len(made.warnings) == 1
    assert made.warnings[0].endswith(".")
    assert made.corrected == ()
    assert [r.polygon for r in made.regions] == [r.polygon for r in machine.regions]


def test_what_was_corrected_is_marked_in_the_export(session, machine):
    door = c.AcceptDoor(_door_at(machine))
    label = c.LabelRegion(_inside(machine, machine.regions[0]), "kitchen")
    left, _ = wall_between(machine)
    features = json.loads(geojson_text(plan(session, door, label, c.KeepPlane(at_plane(machine, left)))))
    marked = [f["id"] for f in features["features"] if f["properties"].get("corrected")]
    assert sorted(marked) == sorted([machine.doors[0].id, machine.regions[0].id, left.id])
    assert "corrected" not in geojson_text(machine)


def test_a_label_reruns_nothing_and_a_door_not_what_is_before_it(session, machine):
    stages_run(session, Config())
    label = c.LabelRegion(_inside(machine, machine.regions[0]), "kitchen")
    assert stages_run(session, Config(), (label,))[1] == []
    assert "planes" not in stages_run(session, Config(), (c.RejectDoor(_door_at(machine)),))[1]


def test_corrections_stay_where_they_are_in_the_world(session, machine):
    """On the same building with another local frame, and with the voxels along its own axes."""
    _, right = left_and_right(machine)
    said = c.NameRegion(_inside(machine, right), "Store")
    moved = replace(session.reconstruction, local_frame=LocalFrame(shift=np.array([500.0, -200.0, 0.0])))
    other = PlanningSession(moved, Config())
    other.read(Observer())
    assert other.origin == (500.0, -200.0)
    there = c.NameRegion((said.at[0] + 20.0, said.at[1] - 10.0), "Store")
    made = other.plan(Config(), (there,), Observer(), origin=(480.0, -190.0))
    assert left_and_right(made)[1].name == "Store"
    own = Config().with_values({"voxels.own_axes": "true"})
    made = plan(two_room_session(own), said, config=own)
    named = next(r for r in made.regions if r.name == "Store")
    middle = machine.to_world(np.array([right.polygon.centroid.coords[0]]))
    assert made.to_world(np.array([named.polygon.centroid.coords[0]])) == pytest.approx(middle, abs=0.05)


def test_corrections_hold_on_other_settings(session, machine):
    """They are kept through a rerun: the wall, the door and the name are where they were put."""
    _, right = left_and_right(machine)
    at, low = right.polygon.bounds[:2]
    said = (
        c.AddDoor(local(machine, at, 0.3 + low), local(machine, at, 1.2 + low)),
        c.NameRegion(_inside(machine, right), "Store"),
    )
    coarse = Config().with_values(
        {"segments.window": "0.45", "doors.bin": "0.04", "planes.tolerance": "0.06"}
    )
    made = plan(session, *said, config=coarse)
    assert_valid(made)
    assert left_and_right(made)[1].name == "Store"
    assert [d.width for d in made.doors if d.by_hand] == pytest.approx([0.9])


def test_taking_everything_back_gives_the_very_same_plan(session, machine):
    """Names included: after any detour the plan without corrections is byte for byte the first one."""
    left, _ = wall_between(machine)
    plan(session, c.HidePlane(at_plane(machine, left)))
    plan(session, c.MergeRegions(tuple(_inside(machine, r) for r in machine.regions)))
    assert geojson_text(plan(session)) == geojson_text(machine)

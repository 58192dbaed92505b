"""A wing at another angle is planned in a frame of its own, and joined: no nonsense where there is none."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
import shapely

from floorplan_core import intermediates
from floorplan_core.config import Config
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.exporters.svg import svg_text
from floorplan_core.model import FloorPlan
from floorplan_core.pipeline import process
from tests.box_world import LINTEL, Survey, rotation, stations, survey, two_rooms
from tests.plan_invariants import assert_doors, assert_flags
from tests.round_world import survey as round_survey
from tests.wing_world import LongWorld, TwoWings, WingWorld

YAW = 10.0


@pytest.fixture(scope="module")
def world() -> WingWorld:
    return WingWorld(45.0)


@pytest.fixture(scope="module")
def scans(world: WingWorld) -> Survey:
    return world.survey(YAW, rays=(150, 46))


@pytest.fixture(scope="module")
def plan(scans: Survey) -> FloorPlan:
    return process(scans.reconstruction())


def outlines(plan: FloorPlan, scans: Survey) -> list[shapely.Polygon]:
    """The regions in the axes of the building."""
    turn = scans.rotation[:2, :2]
    return [shapely.transform(r.polygon, lambda xy: plan.to_world(xy) @ turn) for r in plan.regions]


def fits(found: list[shapely.Polygon], wanted: shapely.Polygon) -> float:
    """The best intersection over union."""
    return max(p.intersection(wanted).area / p.union(wanted).area for p in found)


def test_all_rooms_of_both_frames_come_out(plan, scans, world):
    found = outlines(plan, scans)
    assert len(found) == 4
    assert [fits(found, room) > 0.97 for room in world.rooms()] == [True] * 4
    assert all(a.intersection(b).area < 1e-6 for k, a in enumerate(found) for b in found[:k])
    assert all(p.is_valid for p in found)


def test_the_wing_is_stated(plan):
    assert len(plan.wings) == 1
    assert abs(np.degrees(plan.wings[0].turn)) == pytest.approx(45, abs=0.15)
    assert any("wing" in w and "frame of its own" in w for w in plan.warnings)


def test_doors_join_the_frames(plan, scans):
    assert len(plan.doors) == 3
    assert sorted(len(d.connects) for d in plan.doors) == [2, 2, 2]
    assert 1 <= sum(d.turn != 0 for d in plan.doors) <= 2  # whichever frame is the building's
    joined = {frozenset(d.connects) for d in plan.doors}
    assert len(joined) == 3  # a chain of four rooms
    assert [d.width for d in plan.doors] == pytest.approx([0.9] * 3, abs=0.05)


def test_the_plan_keeps_its_invariants(plan):
    assert_doors(plan)
    assert_flags(plan)


def test_exports_have_the_wing(plan, scans, world):
    document = json.loads(geojson_text(plan))
    assert document["floorcast"]["wings"][0]["turn_deg"] == pytest.approx(
        np.degrees(plan.wings[0].turn), abs=1e-3
    )
    planes = [f for f in document["features"] if f["properties"].get("frame") == 1]
    ids = {f["id"] for f in planes}
    sides = {s["plane"] for f in document["features"] for s in f["properties"].get("sides", [])}
    assert sides - {""} <= {f["id"] for f in document["features"]} and sides & ids
    T = np.array(document["floorcast"]["wings"][0]["wing_from_world"])
    for feature in planes:
        if feature["properties"]["kind"] == "layout_plane":
            ends = np.array(feature["geometry"]["coordinates"]) @ T[:2, :2].T + T[:2, 3]
            across = 0 if feature["properties"]["facing"] in ("east", "west") else 1
            assert ends[:, across] == pytest.approx(feature["properties"]["offset_m"], abs=2e-3)
    assert svg_text(plan).count("region-") >= 4


def test_it_is_kept_on_disk_without_loss(plan, tmp_path):
    intermediates.save(plan, tmp_path / "plan.bin")
    assert geojson_text(intermediates.load(tmp_path / "plan.bin", FloorPlan)) == geojson_text(plan)


def test_the_same_survey_gives_the_same_bytes(plan, scans):
    assert geojson_text(process(scans.reconstruction(chunk=7_000))) == geojson_text(plan)


def test_one_frame_when_asked(scans):
    one = process(scans.reconstruction(), Config().with_values({"frame.wings": "false"}))
    assert one.wings == () and all(d.turn == 0 for d in one.doors)


def test_two_wings_at_two_angles():
    world = TwoWings(30.0, 60.0)
    scans = world.survey()
    plan = process(scans.reconstruction())
    assert sorted(np.degrees(w.turn) for w in plan.wings) == pytest.approx([-30, 30], abs=0.1)
    found = outlines(plan, scans)
    assert len(found) == 6
    assert min(fits(found, room) for room in world.rooms()) > 0.97
    assert len({frozenset(d.connects) for d in plan.doors}) == 5  # a chain of six rooms
    assert sum("frame of its own" in w for w in plan.warnings) == 2
    assert_doors(plan)
    assert_flags(plan)


@pytest.mark.parametrize(("degrees", "noise"), [(30.0, 0.008), (45.0, 0.03)])
def test_a_small_wing_of_a_long_building(degrees, noise):
    """A tenth of the floor and of the points; thick noise leaves few planar patches of the usual width."""
    world = LongWorld(degrees)
    scans = world.survey(rays=(150, 46), noise=noise)
    wing = scans.points[scans.scan_id >= len(world.places()[0])]
    assert len(wing) < 0.1 * len(scans.points)
    plan = process(scans.reconstruction())
    assert [abs(np.degrees(w.turn)) for w in plan.wings] == pytest.approx([degrees], abs=0.5)
    found = outlines(plan, scans)
    assert len(found) == 13
    assert min(fits(found, room) for room in world.rooms()) > 0.95
    assert plan.frame.askew < 0.01


@pytest.mark.parametrize("viewpoints", [True, False], ids=["viewpoints", "plain"])
def test_walls_that_no_rooms_follow_are_reported(viewpoints):
    """A round atrium: 70 of 90 degrees of its wall are neither along the axes nor one direction."""
    plan = process(round_survey(rays=(240, 60)).reconstruction(trajectory=viewpoints))
    assert plan.wings == ()
    written = json.loads(geojson_text(plan))["floorcast"]["askew_share"]
    assert 0.12 < written < 0.3
    assert any(f"({written:.1%} of all) stand at other angles" in text for text in plan.warnings)


def test_a_building_without_a_wing_has_none(world):
    flat = survey(two_rooms((2, 2.9, LINTEL)), [*stations(4, 5), *stations(4, 5, 4.1)], rays=(120, 40))
    turned = replace(flat, points=flat.points @ rotation(30).T)
    plan = process(turned.reconstruction(trajectory=False))
    assert plan.wings == () and plan.frame.askew == 0.0
    assert not any("other angles" in text for text in plan.warnings)

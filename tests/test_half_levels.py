"""Half levels: each in the plan of one storey, measured from its own floor; raised slabs part nothing."""

from __future__ import annotations

import json

import numpy as np
import pytest
import shapely

from floorplan_core.cli.info import survey_rows
from floorplan_core.config import Config
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.model import FloorPlan, PointChunk, Reconstruction
from floorplan_core.model.storey import HeightMap, Storey, heading
from floorplan_core.observer import Observer
from floorplan_core.pipeline import process_storeys
from floorplan_core.stages.wings import wing_frame
from floorplan_core.survey_info import describe
from tests.box_world import LINTEL, run, survey, two_rooms
from tests.split_world import EAST, HIGH, LANDING, UP, WEST, SplitWithWing, gallery, house
from tests.stages.test_storeys import box

IN_THE_FILES_AXES = Config().with_values({"voxels.own_axes": "false", "input.up": "z"})


def parts_of(plan: FloorPlan, room: tuple[float, float, float, float]) -> float:
    """m2 of the regions that lie in a room."""
    regions = shapely.union_all(
        [shapely.Polygon(plan.to_world(r.polygon.exterior.coords)) for r in plan.regions]
    )
    return float(regions.intersection(shapely.box(*room)).area)


@pytest.mark.parametrize("viewpoints", [True, False], ids=["viewpoints", "plain"])
def test_a_half_level_is_in_the_plan_of_the_nearest_floor(viewpoints):
    lower, upper = process_storeys(house().reconstruction(trajectory=viewpoints), IN_THE_FILES_AXES)
    west, east = sorted(lower.regions, key=lambda r: -r.area)
    assert (west.area, east.area) == (pytest.approx(36, abs=0.2), pytest.approx(30, abs=0.6))
    assert (west.rise, east.rise) == (0.0, pytest.approx(1.4, abs=0.03))
    assert (west.height, east.height) == (pytest.approx(HIGH, abs=0.03), pytest.approx(HIGH, abs=0.03))
    assert {west.id, east.id} in [set(door.connects) for door in lower.doors]
    assert parts_of(upper, WEST) == pytest.approx(36, abs=0.2)
    assert parts_of(upper, EAST) == pytest.approx(parts_of(upper, LANDING), abs=0.2)


@pytest.mark.parametrize("viewpoints", [True, False], ids=["viewpoints", "plain"])
def test_a_half_level_without_a_ceiling_is_in_one_plan(viewpoints):
    survey = house(roofed=False)
    lower, upper = process_storeys(survey.reconstruction(trajectory=viewpoints), IN_THE_FILES_AXES)
    assert parts_of(lower, WEST) == pytest.approx(36, abs=0.2)
    assert parts_of(lower, EAST) == pytest.approx(30, abs=0.6)
    assert all(r.rise == pytest.approx(1.4, abs=0.03) for r in lower.regions if r.area < 35)
    assert parts_of(upper, WEST) == pytest.approx(36, abs=0.2)
    assert parts_of(upper, EAST) == pytest.approx(parts_of(upper, LANDING), abs=0.2)


def test_the_floor_of_a_half_level_is_in_the_geojson():
    plan = process_storeys(house().reconstruction(), IN_THE_FILES_AXES)[0]
    written = json.loads(geojson_text(plan))
    floors = [
        f["properties"].get("floor_z_m") for f in written["features"] if f["properties"]["kind"] == "region"
    ]
    assert sorted(floors, key=str) == [pytest.approx(1.4, abs=0.03), None]
    assert written["floorcast"]["floor_z_m"] == pytest.approx(0, abs=0.03)


def test_info_names_the_floor_of_a_half_level():
    found = describe(house().reconstruction(), IN_THE_FILES_AXES, Observer())
    lower, upper = found.as_dict()["storeys"]
    assert lower["half_levels_m"] == [pytest.approx(1.4, abs=0.03)]
    assert upper["half_levels_m"] == []
    rows = dict(survey_rows(found, []))
    assert rows["storeys"].splitlines()[0].endswith(", a part at 1.40 m")


def plans_of(*parts: np.ndarray) -> tuple[FloorPlan, ...]:
    points = np.concatenate(parts)
    chunk = PointChunk(points + np.random.default_rng(0).normal(0, 0.005, points.shape), None)
    return process_storeys(
        Reconstruction("boxes", lambda: iter([chunk]), len(points), None), IN_THE_FILES_AXES
    )


STACK = [box(0, 0, 6, 6, k * UP, k * UP + HIGH) for k in range(2)]


@pytest.mark.parametrize(("half", "storey"), [(1.2, 0), (1.5, 0), (1.8, 1)])
def test_the_nearest_floor_is_told_by_height_and_the_lower_one_of_equals(half, storey):
    plans = plans_of(*STACK, box(6.2, 0, 11.2, 6, half, half + HIGH))
    assert [len(p.regions) for p in plans] == [2 - storey, 1 + storey]
    assert [parts_of(p, EAST) for p in plans] == pytest.approx([30, 0] if storey == 0 else [0, 30], abs=0.6)
    east = min(plans[storey].regions, key=lambda r: r.area)
    assert east.rise == pytest.approx(half - storey * UP, abs=0.03)


def test_a_hall_over_two_storeys_is_in_the_lower_plan_only():
    solid = np.concatenate([*STACK, box(6.2, 0, 11.2, 6, 0, UP + HIGH)])
    door = (np.abs(solid[:, 0] - 6.1) < 0.15) & (np.abs(solid[:, 1] - 2.5) < 0.45) & (solid[:, 2] < LINTEL)
    lower, upper = plans_of(solid[~door])
    assert sorted(r.area for r in lower.regions) == pytest.approx([30, 36], abs=0.4)
    assert [r.area for r in upper.regions] == [pytest.approx(36, abs=0.3)]
    assert all(r.rise == 0 for r in (*lower.regions, *upper.regions))


@pytest.mark.parametrize("viewpoints", [True, False], ids=["viewpoints", "plain"])
@pytest.mark.parametrize(("edge", "parapet"), [(5.0, 1.0), (5.2, 0.0)])
def test_a_gallery_ends_at_its_edge(edge, parapet, viewpoints):
    scans = gallery(edge, parapet)
    lower, upper = process_storeys(scans.reconstruction(trajectory=viewpoints), IN_THE_FILES_AXES)
    assert [r.area for r in lower.regions] == [pytest.approx(80, abs=0.5)]
    (region,) = upper.regions
    assert upper.to_world(region.polygon.exterior.coords)[:, 1].min() == pytest.approx(edge, abs=0.15)
    assert region.area == pytest.approx(10 * (8 - edge), abs=1.5)


@pytest.mark.parametrize("degrees", [30.0, 45.0])
def test_a_split_level_has_a_wing(degrees):
    """The hall of the wing has one side along the house, which is longer than its own."""
    world = SplitWithWing(degrees)
    lower, upper = process_storeys(world.survey().reconstruction(), IN_THE_FILES_AXES)
    assert [abs(np.degrees(w.turn)) for w in lower.wings] == pytest.approx([degrees], abs=0.3)
    hall, chamber = world.rooms()[2:]
    wanted = sorted([36.0, 30.0, hall.area, chamber.area])
    assert sorted(r.area for r in lower.regions) == pytest.approx(wanted, abs=0.4)
    assert sorted(r.rise for r in lower.regions) == pytest.approx([0, 0, 0, 1.4], abs=0.03)
    assert upper.wings == () and max(r.area for r in upper.regions) == pytest.approx(36, abs=0.2)


def test_the_heights_of_a_storey_are_found_from_a_wings_axes():
    lower = process_storeys(house().reconstruction(), IN_THE_FILES_AXES)[0]
    frame = lower.frame
    step = HeightMap(np.array([[1.0, 2.0], [3.0, 4.0]]))
    storey = Storey(0, 0.0, None, step, HeightMap.constant(9.0), step, heading=heading(frame))
    wing = wing_frame(frame, np.radians(30))
    places = np.array([[0.5, 0.5, 0.0], [1.5, 0.5, 0.0], [0.5, 1.5, 0.0], [1.5, 1.5, 0.0]])
    turned = wing.to_manhattan(frame.from_manhattan(places))[:, :2]
    assert storey.along(frame) is storey
    assert storey.along(wing).bottom.at(turned).tolist() == [1.0, 2.0, 3.0, 4.0]
    assert storey.bottom.at(turned).tolist() != [1.0, 2.0, 3.0, 4.0]
    assert storey.along(wing).floors.at(turned).tolist() == [1.0, 2.0, 3.0, 4.0]


@pytest.mark.parametrize("rise", [0.3, 0.6])
@pytest.mark.parametrize("viewpoints", [True, False], ids=["viewpoints", "plain"])
def test_a_raised_slab_parts_no_room(rise, viewpoints):
    solid = [*two_rooms((0.5, 1.4, LINTEL), width=6.0), (3.5, 0.0, 0.0, 6.0, 5.0, rise)]
    places = [
        (1.0, 1.0, 1.4),
        (2.5, 4.0, 1.4),
        (5.8, 0.9, 1.4 + rise),
        (4.8, 3.5, 1.4 + rise),
        (8.0, 1.5, 1.4),
        (10.5, 3.8, 1.4),
    ]
    plan = run(survey(solid, places), trajectory=viewpoints).plan
    assert plan is not None
    assert sorted(r.area for r in plan.regions) == pytest.approx([30, 30], abs=0.4)

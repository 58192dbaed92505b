"""Buildings that stand far apart: each is laid out over its own rectangle, and the plan is one."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
import shapely

from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.geometry.surfel_map import SurfelMap
from floorplan_core.model import ManhattanFrame
from floorplan_core.stages import islands
from tests.box_world import rotation, run, stations, survey, two_rooms

AWAY = np.array([620.0, 510.0])  # m: together they would take twice the columns that a plan may have


def moved(boxes, by):
    x, y = by
    return [(a + x, b + y, c, d + x, e + y, f) for a, b, c, d, e, f in boxes]


def stand(width, depth, by=(0.0, 0.0)):
    return [(x + by[0], y + by[1], z) for x, y, z in stations(width, depth)]


def both(*places):
    return [place for k in (0.0, 4.1) for place in stand(4.0, 5.0, (places[0] + k, places[1]))]


def small():
    return two_rooms((1.0, 1.9, 2.1)), both(0.0, 0.0)


def large():
    boxes = two_rooms((2.0, 2.9, 2.1), width=5.0)
    return moved(boxes, AWAY), [p for k in (0.0, 5.1) for p in stand(5.0, 5.0, (AWAY[0] + k, AWAY[1]))]


@pytest.fixture(scope="module")
def campus():
    (one, here), (two, there) = small(), large()
    return survey([*one, *two], [*here, *there])


@pytest.fixture(scope="module")
def planned(campus):
    found = run(campus)
    assert found.error is None, found.error
    return found.plan


def test_every_building_is_planned(planned):
    assert len(planned.regions) == 4
    assert sorted(round(r.area) for r in planned.regions) == [20, 20, 25, 25]
    assert len(planned.doors) == 2
    assert all(len(d.connects) == 2 for d in planned.doors)
    assert any("2 buildings stand apart" in text for text in planned.warnings)
    away = [r for r in planned.regions if r.polygon.centroid.x > 300]
    assert len(away) == 2
    corners = shapely.get_coordinates([r.polygon for r in away])
    world = planned.to_world(corners)[:, :2]
    np.testing.assert_allclose(world.min(axis=0), AWAY, atol=0.03)
    np.testing.assert_allclose(world.max(axis=0), AWAY + np.array([10.1, 5.0]), atol=0.03)


def test_a_building_is_planned_as_it_is_alone(planned):
    alone = run(survey(*small())).plan
    here = [r for r in planned.regions if r.polygon.centroid.x < 300]
    for mine, other in zip(here, alone.regions, strict=True):
        assert mine.polygon.symmetric_difference(other.polygon).area < 0.1


def test_one_grid_and_one_path_for_all(planned, campus):
    x0, y0, x1, y1 = planned.grid.extent
    assert x1 - x0 > AWAY[0]
    assert y1 - y0 > AWAY[1]
    assert planned.grid.universe.shape == planned.grid.states.shape == planned.cover.uncovered.shape
    assert len(planned.trajectory) == len(campus.poses)
    free = np.count_nonzero(planned.grid.universe) * planned.grid.cell**2
    assert free == pytest.approx(sum(r.area for r in planned.regions), rel=0.1)
    assert len(planned.wall_points.xy) == len(planned.wall_points.facing)
    assert (planned.wall_points.xy[:, 0] > 300).any()


def test_ids_are_one_of_a_kind_in_the_file(planned):
    features = json.loads(geojson_text(planned))["features"]
    ids = [feature["id"] for feature in features]
    assert len(set(ids)) == len(ids)
    planes = {f["id"] for f in features if f["properties"]["kind"] == "layout_plane"}
    segments = [f for f in features if f["properties"]["kind"] == "layout_segment"]
    assert {s["properties"]["plane"] for s in segments} - {""} <= planes
    sides = {s.plane for r in planned.regions for s in r.sides} - {""}
    assert sides <= {plane.id for plane in planned.all_planes}


def test_a_turned_campus_is_the_same(campus, planned):
    (one, here), (two, there) = small(), large()
    turned = run(survey([*one, *two], [*here, *there], turned=rotation(23.0))).plan
    assert sorted(round(r.area, 1) for r in turned.regions) == pytest.approx(
        sorted(round(r.area, 1) for r in planned.regions), abs=0.4
    )


def test_lone_points_far_away_are_no_building():
    given = survey(*small())
    rng = np.random.default_rng(1)
    ghosts = np.array([2000.0, 1500.0, 1.0]) + rng.normal(0, 0.3, (15, 3))
    strayed = replace(
        given,
        points=np.concatenate([given.points, ghosts]),
        scan_id=np.concatenate([given.scan_id, np.zeros(len(ghosts), dtype=np.int32)]),
    )
    plan = run(strayed, trajectory=False).plan
    assert len(plan.regions) == 2
    assert not any("apart" in text for text in plan.warnings)


def test_a_wide_site_of_one_piece_has_no_islands(campus, monkeypatch):
    monkeypatch.setattr(islands, "WIDE", 1.0)
    plan = run(survey(*small())).plan
    assert plan.wings == ()
    assert not any("apart" in text for text in plan.warnings)


@pytest.mark.parametrize(("ghosts", "found"), [((), 0), (((900.0, 700.0, 1.0),), 1)])
def test_a_site_of_one_piece_is_taken_out_only_where_strays_widen_it(ghosts, found):
    ground = np.stack(np.meshgrid(np.arange(0, 340, 0.25), np.arange(0, 340, 0.25)), axis=-1).reshape(-1, 2)
    points = np.concatenate([np.column_stack([ground, np.zeros(len(ground))]), np.reshape(ghosts, (-1, 3))])
    surfels = SurfelMap(0.05)
    surfels.insert(points, np.full(len(points), -1, dtype=np.int32), np.zeros((0, 3)), (0.05, 30.0))
    frame = ManhattanFrame(np.eye(3), 0.0, 0.0, 1.0, 10.0, 0.0, None)
    sites = islands.find_islands(surfels, frame)
    assert len(sites) == found
    assert all(len(site.surfels_of(surfels)) == len(ground) for site in sites)

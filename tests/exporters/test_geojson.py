"""plan.geojson keeps its contract: names, types, world frame, disjoint regions, the same bytes."""

from __future__ import annotations

import itertools
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry import shape

from floorplan_core.exporters.coverage import matched, rounded
from floorplan_core.exporters.geojson import GeoJsonExporter, geojson_text, plan_to_geojson
from tests.factories import RoomSpec, l_corridor, make_plan, office, small_flat

UTM = (512345.678, 5412345.123, 310.5)
CONTRACT: dict[str, dict[str, type | tuple[type, ...]]] = {
    "region": {
        "name": str,
        "label": str,
        "area_m2": float,
        "perimeter_m": float,
        "turning_distance": float,
        "free_cells": int,
        "total_cells": int,
        "speculated_fraction": float,
        "speculated_sides": int,
        "doors": list,
        "height_m": float,
    },
    "door": {"width_m": float, "connects": list, "confidence": float, "evidence": list, "height_m": float},
    "layout_plane": {"facing": str, "offset_m": float, "support_m2": float, "residual_m": float},
    "layout_segment": {"plane": str, "height_range_m": list},
    "speculated": {},
}
GEOMETRY = {
    "region": "Polygon",
    "door": "LineString",
    "layout_plane": "LineString",
    "layout_segment": "LineString",
    "speculated": "MultiPolygon",
}


def of_kind(document: dict[str, Any], kind: str) -> list[dict[str, Any]]:
    return [f for f in document["features"] if f["properties"]["kind"] == kind]


@pytest.fixture(scope="module")
def document() -> dict[str, Any]:
    return json.loads(geojson_text(l_corridor(shift=UTM)))


@pytest.mark.parametrize("kind", CONTRACT)
def test_every_named_property_is_there(document: dict[str, Any], kind: str) -> None:
    features = of_kind(document, kind)
    assert features
    for feature in features:
        assert feature["geometry"]["type"] == GEOMETRY[kind]
        assert isinstance(feature["id"], str)
        for name, kinds in CONTRACT[kind].items():
            if name == "height_m" and name not in feature["properties"]:
                assert kind == "door"  # an opening without a lintel
                continue
            assert isinstance(feature["properties"][name], kinds), (kind, name)


def test_head(document: dict[str, Any]) -> None:
    head = document["floorcast"]
    assert document["type"] == "FeatureCollection"
    assert head["units"] == "metre"
    assert head["frame"] == "world"
    assert head["source"] == "l-corridor.ply"
    assert head["storey"] == 0
    assert head["slice_height_m"] == 1.5
    assert np.shape(head["manhattan_from_world"]) == (4, 4)


def test_ids_are_unique_and_references_resolve(document: dict[str, Any]) -> None:
    ids = [f["id"] for f in document["features"]]
    assert len(ids) == len(set(ids))
    regions = {f["id"] for f in of_kind(document, "region")}
    doors = {f["id"] for f in of_kind(document, "door")}
    planes = {f["id"] for f in of_kind(document, "layout_plane")}
    for door in of_kind(document, "door"):
        assert set(door["properties"]["connects"]) <= regions
        assert 1 <= len(door["properties"]["connects"]) <= 2
    assert all(set(r["properties"]["doors"]) <= doors for r in of_kind(document, "region"))
    assert all(s["properties"]["plane"] in planes for s in of_kind(document, "layout_segment"))


@pytest.mark.parametrize("make", [small_flat, l_corridor, office])
@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), UTM])
def test_regions_are_valid_disjoint_and_counter_clockwise(make: Any, shift: tuple[float, ...]) -> None:
    document = plan_to_geojson(make(shift=shift))
    regions = [shape(f["geometry"]) for f in of_kind(document, "region")]
    assert all(r.is_valid and r.exterior.is_ccw for r in regions)
    assert not any(hole.is_ccw for r in regions for hole in r.interiors)
    assert shapely.coverage_is_valid(regions)
    assert shapely.union_all(regions).area == pytest.approx(sum(r.area for r in regions), abs=1e-6)


def test_coordinates_have_four_decimals_however_large(document: dict[str, Any]) -> None:
    for feature in document["features"]:
        xy = shapely.get_coordinates(shape(feature["geometry"]))
        assert np.array_equal(np.round(xy, 4), xy)
        assert np.all(np.abs(xy - UTM[:2]) < 40)


def test_world_frame_is_restored(document: dict[str, Any]) -> None:
    """The matrix takes exported coordinates back to the building's own axes."""
    plan = l_corridor(shift=UTM)
    T = np.array(document["floorcast"]["manhattan_from_world"])
    for region, feature in zip(plan.regions, of_kind(document, "region"), strict=True):
        xy = shapely.get_coordinates(shape(feature["geometry"]))
        back = xy @ T[:2, :2].T + T[:2, 3] + T[:2, 2] * UTM[2]
        moved = shapely.Polygon(back)
        assert moved.symmetric_difference(region.polygon).area < 5e-3
        assert feature["properties"]["area_m2"] == pytest.approx(region.area, abs=1e-4)


def test_speculated_lies_within_regions_and_off_the_seen_floor() -> None:
    plan = l_corridor(shift=UTM)
    document = plan_to_geojson(plan)
    predicted = shape(of_kind(document, "speculated")[0]["geometry"])
    regions = {f["id"]: shape(f["geometry"]) for f in of_kind(document, "region")}
    assert predicted.is_valid
    assert shapely.union_all(list(regions.values())).covers(predicted)
    assert predicted.area == pytest.approx(plan.speculated().area, rel=0.02)
    for region in plan.regions:
        share = regions[region.id].intersection(predicted).area / region.area
        assert share == pytest.approx(region.speculated_fraction, abs=0.05)


def test_layout_planes_span_the_extent_of_the_plan() -> None:
    plan = l_corridor(yaw_deg=0.0)
    x0, y0, x1, y1 = shapely.total_bounds([r.polygon for r in plan.regions])
    for feature in of_kind(plan_to_geojson(plan), "layout_plane"):
        a, b = feature["geometry"]["coordinates"]
        if feature["properties"]["facing"] in ("east", "west"):
            assert (a[0], b[0], a[1], b[1]) == pytest.approx((a[0], a[0], y0, y1))
            assert a[0] == pytest.approx(feature["properties"]["offset_m"])
        else:
            assert (a[1], b[1], a[0], b[0]) == pytest.approx((a[1], a[1], x0, x1))


def test_same_plan_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        GeoJsonExporter().write(l_corridor(), tmp_path / name)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_plan_without_regions_is_still_a_document() -> None:
    plan = replace(small_flat(), regions=(), doors=())
    document = json.loads(geojson_text(plan))
    assert of_kind(document, "region") == []
    assert of_kind(document, "speculated")[0]["geometry"]["coordinates"] == []


def test_hostile_names_survive() -> None:
    name = 'Büro "3" <b>&\\\n'
    plan = make_plan([RoomSpec((0, 0, 3, 3), name=name)], source=name)
    document = json.loads(geojson_text(plan))
    assert of_kind(document, "region")[0]["properties"]["name"] == name
    assert document["floorcast"]["source"] == name


def test_a_slanted_side_with_a_corner_of_its_neighbour_stays_a_coverage() -> None:
    """Corners on a slanted side are kept to 1e-6, beside the line that the other region draws."""
    corner = (12.422725, 29.667836)
    one = shapely.Polygon([(12.525, 29.5), (14.0, 29.5), (14.0, 31.1), (11.55, 31.1)])
    other = shapely.Polygon([(12.525, 29.5), corner, (11.55, 31.1), (11.0, 31.1), (11.0, 29.5)])
    assert not shapely.coverage_is_valid([one, other])
    assert shapely.coverage_is_valid(rounded(matched([one, other]), lambda xy: xy, 4))


@settings(max_examples=60, deadline=None)
@given(
    cuts=st.lists(st.floats(0.5, 9.5), min_size=1, max_size=5, unique=True),
    split=st.floats(1.0, 5.0),
    yaw=st.floats(-0.8, 0.8),
    nudge=st.floats(-4e-4, 4e-4),
)
def test_touching_regions_stay_a_coverage_after_rounding(
    cuts: list[float], split: float, yaw: float, nudge: float
) -> None:
    """One long region along many short ones, edges that nearly agree, any rotation."""
    xs = [0.0, *sorted(cuts), 10.0]
    strips = [shapely.box(a, split + nudge, b, 6.0) for a, b in itertools.pairwise(xs) if b - a > 0.01]
    c, s = np.cos(yaw), np.sin(yaw)
    turn = np.array([[c, s], [-s, c]])
    whole = matched([shapely.box(0, 0, 10, split), *strips])
    done = rounded(whole, lambda xy: xy @ turn + 12345.678, 4)
    assert all(p.is_valid for p in done)
    assert shapely.coverage_is_valid(done)


def test_a_hole_too_thin_to_be_written_is_left_out():
    room, thin = shapely.box(0, 0, 4, 3), shapely.box(1, 1, 1.0002, 2)
    (polygon,) = matched([room.difference(thin)])
    assert polygon.is_valid
    assert polygon.equals(room)
    (kept,) = matched([room.difference(shapely.box(1, 1, 1.2, 2))])
    assert len(kept.interiors) == 1

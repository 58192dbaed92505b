"""The models of the layers say what the plan says."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from floorcast_app.layers import free_space
from floorcast_app.layers.dimensions import dimensions_layer
from floorcast_app.layers.evidence import evidence_layer
from floorcast_app.layers.item_shapes import anchor, item_shape
from floorcast_app.layers.label_spots import label_spot
from floorcast_app.layers.observed import points_layer, trajectory_layer
from floorcast_app.layers.planes import planes_layer
from floorcast_app.layers.regions import regions_layer
from floorcast_app.layers.source import source_of
from floorcast_app.layers.walls import doors_layer, walls_layer
from floorcast_app.selection import Item
from floorplan_core.model import FREE


def area(rings) -> float:
    """Of rings filled by the odd-even rule."""
    out = shapely.Polygon()
    for ring in rings:
        out = out.symmetric_difference(shapely.Polygon(ring))
    return out.area


def test_every_thing_has_one_shape(drawn):
    plan, source = drawn.plan, source_of(drawn.plan)
    assert [s.item.id for s in regions_layer(source).shapes] == [r.id for r in plan.regions]
    assert [s.item.id for s in doors_layer(source).shapes] == [d.id for d in plan.doors]
    assert [s.item.id for s in planes_layer(source).shapes] == [p.id for p in plan.planes]
    for shape, region in zip(regions_layer(source).shapes, plan.regions, strict=True):
        assert area(shape.floor) == pytest.approx(region.polygon.area)


def test_walls_do_not_lie_on_floor_and_leave_openings(drawn):
    source = source_of(drawn.plan)
    layer = walls_layer(source)
    assert area(layer.observed) == pytest.approx(source.walls.observed.area)
    for door in doors_layer(source).shapes:
        assert source.walls.observed.intersection(shapely.box(*door.bounds)).area < 1e-6


def test_free_space_codes_count_the_cells(drawn):
    grid = drawn.plan.grid
    layer = free_space.free_space_layer(source_of(drawn.plan))
    assert (layer.codes == free_space.SEEN_FREE).sum() == (grid.states == FREE).sum()
    predicted = (layer.codes == free_space.PREDICTED).sum() * grid.cell**2
    assert 0 < predicted <= sum(r.area for r in drawn.plan.regions)


def test_points_and_path_are_those_of_the_plan(drawn):
    source = source_of(drawn.plan)
    layer = points_layer(source)
    assert np.bincount(layer.facing + 1).tolist() == np.bincount(drawn.plan.wall_points.facing + 1).tolist()
    path = shapely.LineString(drawn.plan.trajectory)
    assert shapely.LineString(trajectory_layer(source).xy).hausdorff_distance(path) < 0.05


def test_dimensions_are_clear_lengths_of_the_regions(drawn):
    layer = dimensions_layer(source_of(drawn.plan))
    corners = [shapely.get_coordinates(r.polygon) for r in drawn.plan.regions]
    for row in layer.rows:
        values = np.concatenate([c[:, 1 - row.axis] for c in corners])
        for span in row.spans:
            assert np.abs(values - span.start).min() < 1e-6
            assert np.abs(values - span.end).min() < 1e-6
    assert {row.level for row in layer.rows} == {1, 2}


@settings(max_examples=40, deadline=None)
@given(st.floats(1, 20), st.floats(1, 20), st.floats(0.2, 0.8), st.floats(0.2, 0.8), st.booleans())
def test_a_label_lies_inside_its_region(width, depth, u, v, cut):
    polygon = shapely.box(0, 0, width, depth)
    if cut:
        polygon = polygon.difference(shapely.box(u * width, v * depth, width, depth))
    spot = label_spot(polygon)
    w, h = (spot.height, spot.width) if spot.turned else (spot.width, spot.height)
    box = shapely.box(spot.x - w / 2, spot.y - h / 2, spot.x + w / 2, spot.y + h / 2)
    assert polygon.buffer(1e-9).contains(box)
    assert spot.width > 0


def test_labels_keep_off_what_they_are_told(drawn):
    room = shapely.box(0, 0, 4, 4)
    taken = shapely.box(1.5, 1.5, 4, 4)
    spot = label_spot(room, [taken])
    assert not taken.contains(shapely.Point(spot.x, spot.y))


def test_a_label_has_all_the_room_around_its_spot():
    deep = label_spot(shapely.box(0, 0, 3.2, 5.5))
    assert not deep.turned
    assert (deep.width, deep.height) == pytest.approx((3.2, 5.5), rel=0.02)
    narrow = label_spot(shapely.box(0, 0, 1.8, 9.0))
    assert narrow.turned
    assert (narrow.width, narrow.height) == pytest.approx((9.0, 1.8), rel=0.02)


def test_item_shapes_and_anchors(drawn):
    source = source_of(drawn.plan)
    for region in drawn.plan.regions:
        item = Item("region", region.id)
        assert item_shape(source, item).bounds == pytest.approx(region.polygon.bounds)
        assert region.polygon.contains(shapely.Point(anchor(source, item)))
    for door in drawn.plan.doors:
        x, y = anchor(source, Item("door", door.id))
        assert shapely.LineString(door.line()).distance(shapely.Point(x, y)) < 0.3
    plane = drawn.plan.planes[0]
    assert item_shape(source, Item("plane", plane.id)).infinite == (plane.facing.axis, plane.offset, 0.0)
    assert item_shape(source, Item("region", "nowhere")).empty


def test_evidence_falls_and_rises_at_the_jambs(drawn):
    """The gradient's extremes lie within two bins of a door that is cut into the plane alone."""
    checked = 0
    for door in drawn.plan.doors:
        layer = evidence_layer(drawn.plan, Item("door", door.id))
        assert layer is not None
        assert door in layer.doors
        near = (layer.at > door.start - 0.3) & (layer.at < door.end + 0.3)
        first = layer.at[near][np.argmin(layer.gradient[near])]
        last = layer.at[near][np.argmax(layer.gradient[near])]
        middle = (door.start + door.end) / 2
        checked += first < middle < last
        assert layer.along(*layer.point(middle)) == (pytest.approx(middle), pytest.approx(0))
    assert checked >= 0.6 * len(drawn.plan.doors)


def test_the_other_face_is_another_plane(drawn):
    door = next(d for d in drawn.plan.doors if len(d.planes) > 1)
    one, two = (evidence_layer(drawn.plan, Item("door", door.id), face) for face in (0, 1))
    assert one.plane != two.plane
    assert evidence_layer(drawn.plan, Item("region", drawn.plan.regions[0].id)) is None

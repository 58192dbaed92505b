"""Rectilinear polygons: corners, moving sides, opening."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from floorplan_core.geometry.raster import edges_of
from floorplan_core.geometry.rectilinear import (
    chords,
    corners,
    map_polygon,
    move_sides,
    open_polygon,
    polygons_of,
    union_boxes,
    without_slits,
)

L_SHAPE = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 5), (0, 5)]


def _ring(points) -> np.ndarray:
    return np.array([*points, points[0]], dtype=float)


def _same(a, b) -> bool:
    return bool(shapely.equals(a, b)) and a.is_valid


def test_corners_drop_what_lies_on_a_side():
    ring = _ring([(0, 0), (1, 0), (3, 0), (4, 0), (4, 2), (3, 2), (2, 2), (2, 5), (0, 5), (0, 3)])
    assert shapely.equals(shapely.Polygon(corners(ring)), shapely.Polygon(L_SHAPE))
    assert len(corners(ring)) == 6


def test_corners_of_a_ring_that_begins_inside_a_side():
    ring = _ring([(2, 0), (4, 0), (4, 2), (2, 2), (2, 5), (0, 5), (0, 0)])
    assert len(corners(ring)) == 6


def test_repeated_points_and_spikes_are_no_corners():
    assert len(corners(_ring([(0, 0), (4, 0), (4, 0), (4, 3), (0, 3), (0, 3)]))) == 4
    assert len(corners(_ring([(0, 0), (4, 0), (2, 0)]))) == 0  # nothing is left of a line


def _offsets(points: np.ndarray) -> np.ndarray:
    """Where the sides of a ring are."""
    after = np.roll(points, -1, axis=0)
    return np.where(np.abs(points[:, 0] - after[:, 0]) < 1e-6, points[:, 0], points[:, 1])


def test_sides_move_across_their_own_direction():
    moved = shapely.Polygon(move_sides(_ring(L_SHAPE), lambda points: _offsets(points) + 0.1))
    assert shapely.equals(moved, shapely.Polygon(np.array(L_SHAPE) + 0.1))


@given(shift=st.lists(st.floats(-0.3, 0.3), min_size=6, max_size=6))
def test_moved_rings_stay_rectilinear_and_each_side_lies_where_it_was_sent(shift):
    ring = _ring(L_SHAPE)
    points = corners(ring)
    wanted = _offsets(points) + shift
    moved = move_sides(ring, lambda _: wanted)
    for k in range(6):
        across = 0 if points[k][0] == points[(k + 1) % 6][0] else 1
        assert moved[k][across] == moved[(k + 1) % 6][across] == wanted[k]


def test_a_ring_does_not_cross_itself_when_sides_of_an_arm_change_places():
    arm = shapely.union_all([shapely.box(0, 0, 4, 4), shapely.box(4, 2, 7, 2.2)])
    sent = {2.0: 2.3, 2.2: 1.9, 4.0: 4.1}  # the sides of the arm past each other; the top a little up

    def targets(points):
        return np.array([sent.get(round(v, 6), v) for v in _offsets(points).tolist()])

    moved = map_polygon(arm, lambda ring: move_sides(ring, targets))
    kept = shapely.union_all([shapely.box(0, 0, 4.1, 4.1), shapely.box(4.1, 2, 7, 2.2)])
    assert moved.is_valid
    assert _same(moved, kept)


def test_a_ring_whose_other_sides_may_pass_each_other_is_moved_all_the_same():
    jog = shapely.union_all([shapely.box(0, 0, 4, 4), shapely.box(4, 0, 8, 4.02)])
    sent = {4.02: 3.98}

    def targets(points):
        return np.array([sent.get(round(v, 6), v) for v in _offsets(points).tolist()])

    moved = map_polygon(jog, lambda ring: move_sides(ring, targets))
    assert _same(moved, shapely.union_all([shapely.box(0, 0, 4, 4), shapely.box(4, 0, 8, 3.98)]))


def test_a_step_turns_round_though_a_spike_elsewhere_must_not_cross_itself():
    """The nearer of two pieces of one wall turns out to be the farther; the sides of the arm would cross."""
    shape = shapely.union_all(
        [shapely.box(0, 0, 4, 4), shapely.box(4, 0, 8, 4.12), shapely.box(8, 2, 9, 2.04)]
    )
    sent = {4.0: 4.02, 4.12: 4.01, 2.0: 2.1, 2.04: 2.0}

    def targets(points):
        return np.array([sent.get(round(v, 6), v) if v > 0 else v for v in _offsets(points).tolist()])

    def along_y(points):  # sides across x stay where they are
        upright = points[:, 0] == np.roll(points[:, 0], -1)
        return np.where(upright, points[:, 0], targets(points))

    moved = map_polygon(shape, lambda ring: move_sides(ring, along_y))
    arm = shapely.box(8, 2, 9, 2.04)
    assert moved.is_valid
    assert _same(moved, shapely.union_all([shapely.box(0, 0, 4, 4.02), shapely.box(4, 0, 8, 4.01), arm]))


def test_rings_are_moved_with_the_inside_at_their_left():
    room = shapely.box(0, 0, 6, 6).difference(shapely.box(2, 2, 3, 3))
    turns = []

    def move(ring):
        turns.append(shapely.LinearRing(ring).is_ccw)
        return move_sides(ring, _offsets)

    assert _same(map_polygon(room, move), room)
    assert turns == [True, False]


def test_a_hole_that_collapses_is_dropped():
    room = shapely.box(0, 0, 6, 6).difference(shapely.box(2, 2, 3, 3))

    def move(ring):
        return corners(ring) if len(ring) and np.ptp(ring[:, 0]) > 2 else corners(ring)[:0]

    assert _same(map_polygon(room, move), shapely.box(0, 0, 6, 6))


def test_opening_removes_what_is_narrower_and_keeps_the_rest():
    room = shapely.union_all([shapely.box(0, 0, 4, 4), shapely.box(4, 1, 7, 1.2)])
    assert _same(shapely.normalize(open_polygon(room, 0.3)), shapely.box(0, 0, 4, 4))
    assert open_polygon(room, 0.15).area == pytest.approx(room.area)
    assert open_polygon(room, 0) is room


def test_polygons_come_largest_first_without_lines_or_points():
    mixed = shapely.GeometryCollection(
        [
            shapely.box(0, 0, 1, 1),
            shapely.LineString([(0, 0), (1, 1)]),
            shapely.box(5, 5, 8, 8),
            shapely.Point(3, 3),
        ]
    )
    assert [p.area for p in polygons_of(mixed)] == [9.0, 1.0]
    assert polygons_of(shapely.Polygon()) == []


@given(
    steps=st.lists(st.floats(1e-5, 1.4e-3), min_size=1, max_size=6),
    signs=st.lists(st.sampled_from([-1, 1]), min_size=6, max_size=6),
)
def test_opening_keeps_polygons_rectilinear_and_within_themselves(steps, signs):
    """A side with steps of less than a millimetre, which a buffer would make one slanted side."""
    offset = np.cumsum([0.0, *(s * sign for s, sign in zip(steps, signs, strict=False))])
    boxes = [shapely.box(k, 0, k + 1, 3 + d) for k, d in enumerate(offset)]
    room = shapely.union_all(boxes)
    opened = open_polygon(room, 0.3)
    assert opened.is_valid
    sides = np.abs(np.diff(np.asarray(opened.exterior.coords), axis=0))
    assert sides.min(axis=1).max() < 2e-6
    assert opened.difference(room).area < 1e-5
    assert opened.area == pytest.approx(room.area, abs=0.02)


def test_opening_keeps_the_parts_of_what_falls_apart():
    room = shapely.union_all([shapely.box(0, 0, 4, 4), shapely.box(4, 1, 7, 1.2), shapely.box(7, 0, 9, 4)])
    assert [p.area for p in polygons_of(open_polygon(room, 0.3))] == pytest.approx([16, 8])


def test_slits_are_filled_and_courtyards_kept():
    room = shapely.box(0, 0, 9, 9).difference(shapely.box(2, 2, 4, 2.001)).difference(shapely.box(5, 5, 6, 7))
    assert _same(without_slits(room, 0.02), shapely.box(0, 0, 9, 9).difference(shapely.box(5, 5, 6, 7)))
    assert _same(without_slits(shapely.box(0, 0, 1, 1), 0.02), shapely.box(0, 0, 1, 1))


def test_the_union_of_boxes_is_that_of_shapely():
    rng = np.random.default_rng(5)
    for _ in range(50):
        corner = np.round(rng.uniform(0, 8, (rng.integers(1, 12), 2)), 1)
        boxes = np.hstack([corner, corner + np.round(rng.uniform(0.1, 4, corner.shape), 1)])
        union = union_boxes(boxes)
        wanted = shapely.union_all(shapely.box(*boxes.T))
        assert union.is_valid
        assert union.symmetric_difference(wanted).area < 1e-9


def test_opening_a_rectangle_gives_what_opening_any_polygon_gives() -> None:
    rng = np.random.default_rng(3)
    for x0, y0, wide, high in rng.uniform([-20, -20, 1.3, 1.3], [20, 20, 30, 30], (40, 4)):
        x1, y1 = x0 + wide, y0 + high
        around = [
            (x0, y0),
            ((x0 + x1) / 2, y0),
            (x1, y0),
            (x1, y1),
            (x0, y1),
        ]  # a point too many for a rectangle
        any_, rectangle = (
            open_polygon(p, 0.6) for p in (shapely.Polygon(around), shapely.box(x0, y0, x1, y1))
        )
        expected = corners(shapely.get_coordinates(shapely.orient_polygons(any_)))
        assert np.array_equal(corners(shapely.get_coordinates(rectangle)), expected)


def test_a_narrow_rectangle_is_opened_away() -> None:
    assert open_polygon(shapely.box(0, 0, 0.5, 9), 0.6).is_empty
    assert open_polygon(shapely.box(0, 0, 0.7, 9), 0.6).area == pytest.approx(6.3)


@given(st.floats(-0.5, 4.5), st.sampled_from([0, 1]))
def test_chords_are_where_a_line_runs_inside(offset, axis):
    room = shapely.Polygon(L_SHAPE).difference(shapely.box(0.2, 0.3, 0.7, 0.6))
    ends = [(offset, -9.0), (offset, 9.0)] if axis == 0 else [(-9.0, offset), (9.0, offset)]
    line = shapely.LineString(ends)
    assume(not line.intersects(shapely.points(shapely.get_coordinates(room))).any())  # along no side
    inside = sum(b - a for a, b in chords(edges_of(room), axis, offset))
    assert inside == pytest.approx(line.intersection(room).length)

"""Segments: walls and not furniture, each face for itself, to the millimetre; and the planes made of them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from floorplan_core.model import Facing, LayoutPlane, LayoutSegment
from tests.box_world import LINTEL, Run, Survey, room, rotation, run, stations, survey, two_rooms

EXACT = 0.003  # m, at 1 cm of noise
DOOR = (2.0, 2.9, LINTEL)
SENSORS = pytest.mark.parametrize("trajectory", [True, False], ids=["viewpoints", "plain"])
CABINETS = [(0.0, 1.5, 0.0, 0.6, 3.0, 1.9), (2.0, 4.4, 0.0, 3.5, 5.0, 1.9)]  # 1.9 m high, along two walls


@cache
def _furnished(trajectory: bool) -> Run:
    return run(survey([*room(4, 5), *CABINETS], stations(4, 5)), trajectory=trajectory)


@cache
def _two_rooms(thick: float, trajectory: bool, yaw: float = 0.0) -> Run:
    places = [*stations(4, 5), *stations(4, 5, 4 + thick)]
    given = survey(two_rooms(DOOR, thick=thick), places, rays=(200, 60), turned=rotation(yaw))
    return run(given, trajectory=trajectory)


def _segments(result: Run, structural: bool = True) -> list[LayoutSegment]:
    return [s for s in result["segments"][0] if s.structural == structural]


def _planes(result: Run) -> tuple[LayoutPlane, ...]:
    assert result.plan is not None, result.error
    return result.plan.planes


def _offsets(segments: list[LayoutSegment], facing: Facing, least: float = 1.0) -> list[float]:
    return sorted(s.offset for s in segments if s.facing == facing and s.length > least)


@pytest.mark.parametrize("yaw", [0, 7, -31])
def test_an_empty_room_is_four_segments_that_look_inwards(yaw):
    result = run(survey(room(4, 5), stations(4, 5), turned=rotation(yaw)))
    segments = _segments(result)
    found = {s.facing: s for s in segments}
    assert len(segments) == len(found) == 4
    for facing, offset, length in zip(Facing, (0, 4, 0, 5), (5, 5, 4, 4), strict=True):
        assert found[facing].offset == pytest.approx(offset, abs=EXACT)
        assert found[facing].length == pytest.approx(length, abs=0.4)
        assert found[facing].residual < 0.03
        assert found[facing].sigma < 0.001
        assert found[facing].z_max > 2.2


@SENSORS
@pytest.mark.parametrize("thick", [0.1, 0.12, 0.2, 0.3])
@pytest.mark.parametrize("yaw", [0, 23])
def test_the_two_faces_of_a_wall_are_two_surfaces(thick, trajectory, yaw):
    segments = _segments(_two_rooms(thick, trajectory, yaw))
    for facing, offset in ((Facing.WEST, 4.0), (Facing.EAST, 4.0 + thick)):
        near = [o for o in _offsets(segments, facing) if 3.5 < o < 4.5 + thick]
        assert near, facing
        assert near == pytest.approx([offset] * len(near), abs=EXACT)


@pytest.mark.parametrize("thick", [0.1, 0.2])
def test_with_viewpoints_no_face_looks_into_its_wall(thick):
    segments = _segments(_two_rooms(thick, True))
    assert all(o < 0.1 or o > 4 + thick / 2 for o in _offsets(segments, Facing.EAST, 0))
    assert all(o < 4 + thick / 2 or o > 8 for o in _offsets(segments, Facing.WEST, 0))


@SENSORS
def test_cabinets_of_190_cm_are_no_structure(trajectory):
    result = _furnished(trajectory)
    for segment in _segments(result):
        wall = (0, 4) if segment.facing.axis == 0 else (0, 5)
        assert min(abs(segment.offset - w) for w in wall) < 0.05, segment
    low = [s for s in _segments(result, structural=False) if s.z_max < 2.15]
    assert any(s.facing == Facing.EAST and abs(s.offset - 0.6) < EXACT for s in low)
    assert any(s.facing == Facing.SOUTH and abs(s.offset - 4.4) < EXACT for s in low)
    assert all(s.evidence for s in low)


def test_a_thin_wall_is_not_looked_over_from_the_room_behind_it():
    """A camera that looks down sees one face to 1.6 m only; what is free above is the next room."""
    places = [*stations(4, 5), *stations(4, 5, 4.1)]
    given = survey(two_rooms(thick=0.1), places, rays=(200, 60))
    x, _, z = given.points.T
    seen = (given.scan_id >= 4) | (abs(x - 4) > 0.2) | (z < 1.6)
    result = run(Survey(given.points[seen], given.scan_id[seen], given.poses, given.rotation))
    assert any(abs(o - 4) < EXACT for o in _offsets(_segments(result), Facing.WEST))


@SENSORS
def test_furniture_makes_no_plane_and_cuts_no_room(trajectory):
    result = _furnished(trajectory)
    for plane in _planes(result):
        wall = (0, 4) if plane.facing.axis == 0 else (0, 5)
        assert min(abs(plane.offset - w) for w in wall) < 0.05
    (region,) = result.plan.regions  # type: ignore[union-attr]
    assert region.polygon.bounds == pytest.approx((0, 0, 4, 5), abs=0.005)


def test_a_wall_hidden_by_a_cabinet_is_still_one_wall():
    """Behind the cabinet only the strip above it was seen; the wall run goes on."""
    (plane,) = [p for p in _planes(_furnished(True)) if p.facing == Facing.EAST]
    assert len(plane.walls) == 1
    assert plane.walls[0] == pytest.approx([0, 5], abs=0.1)


def test_a_partition_to_the_ceiling_is_structure():
    """60 cm deep like the cabinet, but with nothing above it."""
    shaft = (0.0, 1.5, 0.0, 0.6, 3.0, 2.6)
    segments = _segments(run(survey([*room(4, 5), shaft], stations(4, 5))))
    assert any(s.facing == Facing.EAST and abs(s.offset - 0.6) < EXACT for s in segments)


@SENSORS
def test_every_structural_segment_has_a_plane_that_explains_it(trajectory):
    result = _two_rooms(0.1, trajectory)
    planes = {p.id: p for p in _planes(result)}
    segments = result.plan.segments  # type: ignore[union-attr]
    for segment in segments:
        assert bool(segment.plane) == segment.structural
        if segment.plane:
            plane = planes[segment.plane]
            assert plane.facing == segment.facing
            assert abs(plane.offset - segment.offset) < 0.1
            assert segment.id in plane.segments
    assert {s for p in planes.values() for s in p.segments} == {s.id for s in segments if s.plane}


def test_two_patches_of_one_wall_are_one_plane():
    """The wall between the rooms is cut by the door: two segments of a single plane."""
    west = [p for p in _planes(_two_rooms(0.2, True)) if p.facing == Facing.WEST]
    assert sorted(p.offset for p in west) == pytest.approx([4.0, 8.2], abs=EXACT)


def test_a_plane_knows_where_its_wall_is():
    for plane in _planes(_two_rooms(0.2, True)):
        end = 5.0 if plane.facing.axis == 0 else 8.2
        assert plane.walls.min() == pytest.approx(0, abs=0.15)
        assert plane.walls.max() == pytest.approx(end, abs=0.15)
        assert (plane.walls[:, 1] > plane.walls[:, 0]).all()
        assert plane.observed.min() > -0.15
        assert plane.observed.max() < end + 0.15
        assert plane.support == pytest.approx(
            sum(s.area for s in _two_rooms(0.2, True).plan.segments if s.plane == plane.id)  # type: ignore[union-attr]
        )


def test_the_profile_shows_the_door():
    plane = next(p for p in _planes(_two_rooms(0.2, True)) if p.facing == Facing.WEST and p.offset < 5)
    profile = plane.profile
    assert profile is not None
    along = profile.start + (np.arange(len(profile.low)) + 0.5) * profile.step
    door, wall = (along > 2.15) & (along < 2.75), (along > 0.5) & (along < 1.7)
    assert profile.low[door].max() == 0
    assert profile.low[wall].min() > 0.5
    assert np.median(profile.through[door]) > 0.5
    assert profile.through[wall].max() == 0
    assert (profile.high[door] > 0).mean() > 0.5  # the lintel


@pytest.mark.parametrize("degrees", [30, 45])
def test_a_slanted_wall_is_no_segment(degrees):
    """A corner cut off at an angle, as a row of small steps is not: points on the slanted face itself."""
    base = survey(room(5, 5), stations(5, 5), rays=(200, 60))
    rng = np.random.default_rng(1)
    t, z = rng.uniform(0, 2.0, 8000), rng.uniform(0, 2.6, 8000)
    a = np.radians(degrees)
    slanted = np.column_stack([1.5 + t * np.cos(a), 1.5 + t * np.sin(a), z])
    both = type(base)(
        np.concatenate([base.points, slanted]),
        np.concatenate([base.scan_id, np.zeros(8000, dtype=np.int32)]),
        base.poses,
        base.rotation,
    )
    for s in _segments(run(both)):
        middle = s.line().mean(axis=0)
        along = (middle - 1.5) @ [np.cos(a), np.sin(a)]
        across = abs((middle - 1.5) @ [-np.sin(a), np.cos(a)])
        assert not (across < 0.3 and -0.2 < along < 2.2), s


def test_segments_and_rows_are_in_order_and_named():
    segments, rows = _two_rooms(0.2, True)["segments"]
    assert [s.id for s in segments] == [f"s{k + 1}" for k in range(len(segments))]
    keys = [(s.facing, s.offset, s.start) for s in segments]
    assert keys == sorted(keys)
    assert set(rows) == {s.id for s in segments}
    for s in segments:
        assert s.end > s.start
        assert 0 <= s.z_min < s.z_max
        assert len(rows[s.id].row) == len(rows[s.id].bits) > 0
        assert np.bitwise_count(rows[s.id].bits).sum() * 0.05 * 0.1 == pytest.approx(s.area)


@SENSORS
def test_two_faces_make_a_wall_only_where_it_was_seen_which_way_they_look(trajectory):
    """A screen, 15 cm thick and 2.2 m high, with air above it."""
    screen = (1.9, 1.5, 0.0, 2.05, 3.5, 2.2)
    result = run(survey([*room(4, 5), screen], stations(4, 5)), trajectory=trajectory)
    known = [s for s in _segments(result) if "other face of a wall" in s.evidence]
    assert sorted(s.facing for s in known) == ([Facing.EAST, Facing.WEST] if trajectory else [])

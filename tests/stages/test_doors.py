"""Doors: where the openings are, how wide, how high, which rooms they join; and what is none."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, Facing, LayoutPlane, WallProfile
from floorplan_core.stages.door_apertures import apertures, door_response, percentile, shows_lintels
from floorplan_core.stages.door_evidence import DoorMeasures
from floorplan_core.stages.doors import Candidate, merge_faces
from tests.box_world import EYE, LINTEL, Run, run, stations, survey, two_rooms, wall

WIDTH_TOLERANCE = 0.03  # m
SENSORS = pytest.mark.parametrize("trajectory", [True, False], ids=["viewpoints", "plain"])


@cache
def _run(
    openings: tuple[tuple[float, float, float], ...],
    thick: float = 0.12,
    trajectory: bool = True,
    through=False,
) -> Run:
    places = [*stations(4, 5), *stations(4, 5, 4 + thick)]
    if through and openings:  # a walk through the first opening, in steps of a metre
        middle = (openings[0][0] + openings[0][1]) / 2
        places[4:4] = [(x, middle, EYE) for x in (2.5, 3.3, 4.05 + thick / 2, 4.8, 5.5)]
    return run(survey(two_rooms(*openings, thick=thick), places, rays=(200, 70)), trajectory=trajectory)


def _doors(result: Run) -> tuple[Door, ...]:
    assert result.plan is not None, result.error
    return result.plan.doors


@SENSORS
@pytest.mark.parametrize("width", [0.8, 0.9, 1.0, 1.1, 1.2])
def test_doors_of_80_to_120_cm_are_found_to_3_cm(width, trajectory):
    (door,) = _doors(_run(((2.03, 2.03 + width, LINTEL),), trajectory=trajectory))
    assert door.kind == "door"
    assert door.axis == 0
    assert door.width == pytest.approx(width, abs=WIDTH_TOLERANCE)
    assert door.start == pytest.approx(2.03, abs=WIDTH_TOLERANCE)
    assert door.offset == pytest.approx(4.06, abs=0.01)
    assert door.thickness == pytest.approx(0.12, abs=0.01)
    assert door.height == pytest.approx(LINTEL, abs=0.05)
    assert 0.5 < door.confidence <= 1


@pytest.mark.parametrize("thick", [0.1, 0.2, 0.35])
def test_one_door_for_the_two_faces_of_its_wall(thick):
    result = _run(((2.0, 2.9, LINTEL),), thick)
    (door,) = _doors(result)
    planes = {p.id: p for p in result.plan.planes}  # type: ignore[union-attr]
    assert {planes[p].facing.name for p in door.planes} == {"EAST", "WEST"}
    assert "both faces" in door.evidence
    assert door.thickness == pytest.approx(thick, abs=0.01)
    assert door.width == pytest.approx(0.9, abs=WIDTH_TOLERANCE)


@SENSORS
def test_a_door_joins_the_rooms_on_its_two_sides(trajectory):
    result = _run(((2.0, 2.9, LINTEL),), trajectory=trajectory)
    plan = result.plan
    assert plan is not None
    west, east = sorted(plan.regions, key=lambda r: r.polygon.bounds[0])
    (door,) = plan.doors
    assert set(door.connects) == {west.id, east.id}
    assert west.doors == east.doors == (door.id,)


def test_two_doors_in_one_wall():
    doors = _doors(_run(((0.8, 1.7, LINTEL), (3.2, 4.2, LINTEL))))
    assert [d.width for d in doors] == pytest.approx([0.9, 1.0], abs=WIDTH_TOLERANCE)
    assert [d.start for d in doors] == pytest.approx([0.8, 3.2], abs=WIDTH_TOLERANCE)
    assert [d.id for d in doors] == ["d1", "d2"]


@pytest.mark.parametrize("lintel", [2.05, 2.2, 2.35])
def test_the_lintels_height_is_measured(lintel):
    (door,) = _doors(_run(((2.0, 2.9, lintel),)))
    assert "lintel" in door.evidence
    assert door.height == pytest.approx(lintel, abs=0.05)


@pytest.mark.parametrize("at", [(0.0, 0.9), (4.1, 5.0)])
def test_a_door_in_a_corner(at):
    """Its one side is the crossing wall: there is no wall of its own plane beside it."""
    result = _run(((*at, LINTEL),))
    (door,) = _doors(result)
    assert (door.start, door.end) == pytest.approx(at, abs=0.06)
    assert len(door.connects) == 2


def test_the_sensors_own_path_is_evidence():
    walked = _doors(_run(((2.0, 2.9, LINTEL),), through=True))[0]
    seen = _doors(_run(((2.0, 2.9, LINTEL),)))[0]
    assert "path" in walked.evidence
    assert "path" not in seen.evidence
    assert walked.confidence >= seen.confidence


def test_a_wall_without_opening_has_no_door():
    result = _run(())
    assert _doors(result) == ()
    assert len(result.plan.regions) == 2  # type: ignore[union-attr]


def test_a_wide_opening_below_a_lintel_is_an_opening():
    (door,) = _doors(_run(((1.5, 3.3, LINTEL),)))
    assert door.kind == "opening"
    assert door.width == pytest.approx(1.8, abs=0.05)


@pytest.mark.parametrize("at", [(0.0, 1.7), (3.2, 5.0)])
def test_a_wide_opening_in_a_corner(at):
    """The lintel goes from the end of the wall to the crossing wall, which is its other jamb."""
    result = _run(((*at, LINTEL),))
    (opening,) = _doors(result)
    assert opening.kind == "opening"
    assert (opening.start, opening.end) == pytest.approx(at, abs=0.06)
    assert len(result.plan.regions) == len(opening.connects) == 2  # type: ignore[union-attr]


@pytest.mark.parametrize("width", [0.8, 1.0, 1.2])
@pytest.mark.parametrize("trajectory", [True, False], ids=["viewpoints", "plain"])
def test_a_gap_in_the_data_is_no_door(width, trajectory):
    """A strip of the wall was never seen, from either side: nothing passes through it."""
    places = [*stations(4, 5), *stations(4, 5, 4.12)]
    given = survey(two_rooms(thick=0.12), places, rays=(200, 70))
    x, y, _ = given.points.T
    seen = ~((x > 3.9) & (x < 4.25) & (y > 2) & (y < 2 + width))
    gap = type(given)(given.points[seen], given.scan_id[seen], given.poses, given.rotation)
    result = run(gap, trajectory=trajectory)
    assert _doors(result) == ()
    assert len(result.plan.regions) == 2  # type: ignore[union-attr]


def test_the_gap_between_a_cabinet_and_a_wall_is_no_door():
    """A cabinet of 1.9 m stands 0.9 m from the corner: between them one sees the wall behind."""
    places = [*stations(4, 5), *stations(4, 5, 4.12)]
    cabinet = (3.4, 0.9, 0.0, 4.0, 3.5, 1.9)
    result = run(survey([*two_rooms(thick=0.12), cabinet], places, rays=(200, 70)))
    assert _doors(result) == ()


def test_a_window_is_no_door():
    """An opening from 0.9 m up through which rays leave."""
    parapet = [(4.0, 1.5, 0.0, 4.12, 2.5, 0.9)]
    places = [*stations(4, 5), *stations(4, 5, 4.12)]
    result = run(survey([*two_rooms((1.5, 2.5, 2.1), thick=0.12), *parapet], places, rays=(200, 70)))
    assert _doors(result) == ()


def test_a_door_in_a_wall_that_runs_the_other_way():
    """Rooms one behind the other: the wall across y."""
    t, far = 0.2, 10.12
    boxes = [
        (-t, -t, -0.2, 4 + t, far + t, 0.0),
        (-t, -t, 2.6, 4 + t, far + t, 2.8),
        *wall(1, -t, 0, -t, 4 + t),
        *wall(1, far, far + t, -t, 4 + t),
        *wall(0, -t, 0, 0, far),
        *wall(0, 4, 4 + t, 0, far),
        *wall(1, 5, 5.12, 0, 4, (1.2, 2.15, LINTEL)),
    ]
    result = run(survey(boxes, [*stations(4, 5), *stations(4, 5, 0, 5.12)], rays=(200, 70)))
    (door,) = _doors(result)
    assert door.axis == 1
    assert (door.offset, door.start, door.end) == pytest.approx((5.06, 1.2, 2.15), abs=WIDTH_TOLERANCE)


def _profile(*gaps: tuple[int, int], bins: int = 120) -> WallProfile:
    low = np.full(bins, 0.9)
    for a, b in gaps:
        low[a:b] = 0.0
    return WallProfile(0.0, 0.05, low, np.zeros(bins), np.zeros(bins))


@pytest.mark.parametrize("width", [16, 18, 20, 24])
def test_the_matched_filter_answers_where_an_aperture_begins(width):
    signal = door_response(_profile((50, 50 + width)), DoorsConfig())
    best = int(np.argmax(signal.response))
    assert abs(best - 50) <= 1
    assert signal.width[best] == pytest.approx(width * 0.05, abs=0.051)
    assert signal.response[best] > 0.6
    elsewhere = np.r_[signal.response[:40], signal.response[60:]]
    assert elsewhere.max() < 0.25


@pytest.mark.parametrize("gap", [(50, 54), (40, 100)])
def test_the_matched_filter_is_silent_for_other_widths(gap):
    assert door_response(_profile(gap), DoorsConfig()).response.max() < 0.25


def test_the_gradient_of_a_clean_step_peaks_at_one():
    signal = door_response(_profile((50, 70)), DoorsConfig())
    assert signal.gradient.min() == pytest.approx(-1, abs=0.25)
    assert signal.gradient[5:-5].max() == pytest.approx(1, abs=0.25)


@pytest.mark.parametrize("q", [0, 3, 25, 60, 100])
def test_percentiles_are_those_of_numpy(q: int) -> None:
    rng = np.random.default_rng(q)
    for size in (1, 2, 3, 10, 101):
        values = rng.random(size)
        assert percentile(values, q) == np.percentile(values, q)


def _corridor_profile() -> WallProfile:
    """A wall from 0 to 2 m, then 1.2 m that are passed, then unseen; no lintel."""
    low = np.where(np.arange(80) < 40, 0.9, 0.0)
    through = np.where((np.arange(80) >= 40) & (np.arange(80) < 64), 1.0, 0.0)
    return WallProfile(0.0, 0.05, low, np.where(low > 0, 0.5, 0.0), through)


def test_a_gap_between_two_walls_that_go_on_is_as_wide_as_the_corridor_and_no_door():
    profile, walls, meets = _corridor_profile(), np.array([[0.0, 2.0]]), np.array([2.05, 3.2])
    settings = DoorsConfig(min_response=0.9)  # corners alone
    ((start, end, _),) = apertures(profile, profile.through, walls, meets, settings)
    assert (start, end) == pytest.approx((2.0, 3.2))
    assert apertures(profile, profile.through, walls, meets, settings, past=np.array([2.05])) == []
    beyond = apertures(profile, profile.through, walls, meets, settings, past=np.array([3.2]))
    assert len(beyond) == 1  # the corner beyond a door may belong to a wall that goes on


def test_a_wide_corner_opening_needs_its_lintel_all_along():
    """A wall up to 1.8 m, then 2.2 m to the corner that are passed."""
    low = np.where(np.arange(80) < 36, 0.9, 0.0)
    passed, settings = 1.0 - np.minimum(low * 2, 1.0), DoorsConfig(min_response=1.0)  # corners alone

    def found(lintel: np.ndarray, through: np.ndarray = passed, stands: np.ndarray = low, end=4.0) -> list:
        profile = WallProfile(0.0, 0.05, stands, lintel, through)
        return apertures(profile, through, np.array([[0.0, end]]), np.array([4.0]), settings)

    ((start, end, _),) = found(np.full(80, 0.5))
    assert (start, end) == pytest.approx((1.8, 4.0))
    half = np.arange(80) < 60
    ((start, end, _),) = found(np.full(80, 0.5), end=3.6)  # beside the far jamb its lintel was not seen
    assert (start, end) == pytest.approx((1.8, 4.0))
    assert found(np.full(80, 0.5), end=3.5) == []
    assert found(np.full(80, 0.5), end=1.8) == []  # a beam, which is no part of the wall
    assert not any(b - a > 1.3 for a, b, _ in found(np.where(half, 0.5, 0.0)))  # a lintel over half of it
    assert not any(b - a > 1.3 for a, b, _ in found(np.full(80, 0.5), np.where(half, passed, 0.0)))
    pillar = np.where((np.arange(80) >= 55) & (np.arange(80) < 66), 0.9, low)
    assert not any(b - a > 1.3 for a, b, _ in found(np.full(80, 0.5), stands=pillar))


def _seen_at(plane: str, facing: Facing, at: float, start: float, end: float, **sure: float) -> Candidate:
    """An aperture in a plane along x, of which ``sure`` was seen and a lintel between jambs."""
    seen = dict.fromkeys(("open", "foot", "beyond", "path"), 0.0)
    seen |= dict.fromkeys(("passage", "lintel", "flanks", "flank", "response"), 1.0)
    door = Door("", (plane,), facing.axis, at, start, end)
    return Candidate(door, DoorMeasures(**(seen | sure)))


def _planes(*faces: tuple[str, Facing, float]) -> list[LayoutPlane]:
    return [LayoutPlane(n, f, at, observed=np.array([(0.0, 9.0)])) for n, f, at in faces]


def test_the_front_of_a_cabinet_says_nothing_about_the_wall_behind_it():
    planes = _planes(("a", Facing.SOUTH, 5.0), ("b", Facing.NORTH, 5.15), ("c", Facing.SOUTH, 5.5))
    wall = [_seen_at(p.id, p.facing, p.offset, 3.0, 3.9) for p in planes[:2]]
    cabinet = _seen_at("c", Facing.SOUTH, 5.5, 3.0, 3.9, passage=0.0, open=0.8, lintel=0.0)
    (door,) = merge_faces([*wall, cabinet], planes, DoorsConfig())
    assert door.door.planes == ("a", "b")
    assert door.measures.open == 0.0


def test_of_two_faces_the_one_that_shows_part_of_an_opening_only_does_not_narrow_it():
    planes = _planes(("a", Facing.SOUTH, 5.0), ("b", Facing.NORTH, 5.15))
    part = _seen_at("a", Facing.SOUTH, 5.0, 4.0, 4.5, open=1.0, foot=1.0)
    whole = _seen_at("b", Facing.NORTH, 5.15, 2.0, 4.6)
    (door,) = merge_faces([part, whole], planes, DoorsConfig())
    assert (door.door.start, door.door.end) == (2.0, 4.6)


def test_a_few_lintels_show_that_the_sensor_sees_in_three_dimensions():
    low, high = np.full(1000, 0.9), np.full(1000, 0.5)
    low[:8] = 0.0  # of 50 m of wall 40 cm under a lintel
    through = np.where(low > 0, 0.0, 1.0)
    assert shows_lintels([WallProfile(0.0, 0.05, low, high, through)])
    assert not shows_lintels([WallProfile(0.0, 0.05, low, np.where(low > 0, high, 0.0), through)])

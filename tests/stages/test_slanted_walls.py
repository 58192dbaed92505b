"""Walls on no plane of the frame bound the regions in steps; furniture and what was not seen does not."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, FloorPlan, OccupancyGrid
from floorplan_core.pipeline import process
from floorplan_core.stages.slanted_walls import StandingCells
from tests.box_world import Survey
from tests.plan_invariants import assert_valid
from tests.round_world import RADIUS, atrium, corridor, survey

CELL, SIZE = 0.1, 60  # a room of 6 x 6 m
ROOM = shapely.box(0, 0, SIZE * CELL, SIZE * CELL)
J, I = np.mgrid[:SIZE, :SIZE]  # noqa: E741
NOTHING = np.zeros((SIZE, SIZE), dtype=bool)


def standing(stands: np.ndarray, unseen: np.ndarray) -> StandingCells:
    """A room that is free but for what stands in it and what was not seen."""
    states = np.where(stands, OCCUPIED, np.where(unseen, UNOBSERVED, FREE)).astype(np.uint8)
    return StandingCells(OccupancyGrid(np.zeros(2), CELL, states, states == FREE, 1.0), stands)


def test_a_corner_behind_a_slanted_wall_is_cut() -> None:
    across = I + J
    rest = standing((across >= 90) & (across < 92), across >= 92).cut(ROOM, 0.3)
    true = shapely.Polygon([(0, 0), (6, 0), (6, 3), (3, 6), (0, 6)])
    assert rest.intersection(true).area / rest.union(true).area > 0.97
    steps = np.diff(shapely.get_coordinates(rest), axis=0)
    assert (np.abs(steps).min(axis=1) < 1e-9).all()  # along the axes
    assert np.abs(steps).max(axis=1).min() > 0.29


CORNER = (I >= 40) & (J >= 40)
RIM = CORNER & ((I < 42) | (J < 42))
DISC = np.hypot(I - 30, J - 30)


@pytest.mark.parametrize(
    ("stands", "unseen"),
    [
        (RIM, CORNER & ~RIM),  # straight fronts: cabinets, a shaft
        (NOTHING, I + J >= 90),  # only not seen
        ((I + J >= 90) & (I + J < 92) & (I < 38), I + J >= 92),  # most of the border is free
        ((I + J >= 90) & (I + J < 92), NOTHING),  # seen on both sides: it stands in the room
        ((DISC > 3) & (DISC <= 4.5), DISC <= 3),  # a column
    ],
)
def test_what_is_no_slanted_wall_cuts_nothing(stands: np.ndarray, unseen: np.ndarray) -> None:
    assert standing(stands, unseen & ~stands).cut(ROOM, 0.3) is ROOM


def test_what_stands_beside_a_side_was_seen_along_it() -> None:
    tall = standing(J == 30, NOTHING)
    assert tall.along((1.0, 3.2), (4.0, 3.2)) == 1.0
    assert tall.along((1.0, 4.5), (4.0, 4.5)) == 0.0
    assert 0.25 < tall.along((3.0, 1.9), (3.0, 3.0)) < 0.5


@pytest.fixture(scope="module")
def scans() -> Survey:
    return survey(17.0, rays=(180, 45))


@pytest.fixture(scope="module")
def plan(scans: Survey) -> FloorPlan:
    return process(scans.reconstruction())


def test_a_round_atrium_is_as_large_as_it_is(plan: FloorPlan, scans: Survey) -> None:
    turn = scans.rotation[:2, :2]
    found = [shapely.transform(r.polygon, lambda xy: plan.to_world(xy) @ turn) for r in plan.regions]
    assert len(found) == 4
    for true, least in ((atrium(), 0.96), (corridor(), 0.98)):
        assert max(p.intersection(true).area / p.union(true).area for p in found) > least


def test_its_wall_was_seen_and_lies_on_its_sides(plan: FloorPlan) -> None:
    region = max(plan.regions, key=lambda r: r.area)
    length = sum(s.length for s in region.sides)
    assert sum(s.length * s.observed for s in region.sides) > 0.85 * length
    assert region.speculated_fraction < 0.05
    off = [
        shapely.Point(xy).distance(region.polygon.centroid) - RADIUS for xy in region.polygon.exterior.coords
    ]
    assert min(off) > -0.45 and max(off) < 0.35
    assert len(region.doors) == 1
    assert_valid(plan)


@pytest.mark.parametrize(("rays", "noise"), [((360, 90), 0.008), ((240, 60), 0.02)])
def test_its_corners_are_cut_without_viewpoints_too(rays: tuple[int, int], noise: float) -> None:
    """Outside of two of them free space is guessed, past the jambs of the door, and no floor was seen."""
    plan = process(survey(rays=rays, noise=noise).reconstruction(trajectory=False))
    room = max(plan.regions, key=lambda r: r.area)
    assert room.area == pytest.approx(atrium().area, abs=3)  # 115 in the square around it
    assert room.speculated_fraction < 0.15

"""What lies under a pixel: the nearest thing, and what is behind it."""

from __future__ import annotations

import numpy as np
import pytest

from floorcast_app.rendering.camera import TARGET_HEIGHT, camera_of
from floorcast_app.rendering.picking import hits, pick
from floorcast_app.rendering.scene import build_scene
from floorcast_app.selection import Item
from floorcast_app.view_state import LAYERS, Look
from floorplan_core.model import FloorPlan
from tests.factories import small_flat

WIDTH, HEIGHT = 640, 480


@pytest.fixture(scope="module")
def plan() -> FloorPlan:
    return small_flat()


def test_every_room_is_found_from_above(plan: FloorPlan) -> None:
    look = Look(azimuth=-90.0, elevation=90.0, span=30.0, layers=frozenset({"regions"}))
    scene, camera = build_scene(plan, look), camera_of(look, WIDTH, HEIGHT)
    for region in plan.regions:
        spot = region.polygon.representative_point()
        x, y, _ = camera.project(np.array([[spot.x, spot.y, 0.0]]))[0]
        assert pick(scene, camera, x, y) == Item("region", region.id)
    assert pick(scene, camera, 1.0, 1.0) is None


def test_a_wall_is_picked_before_the_floor_behind_it(plan: FloorPlan) -> None:
    look = Look(azimuth=-90.0, elevation=5.0, span=30.0, ceiling_cut=None)
    scene, camera = build_scene(plan, look), camera_of(look, WIDTH, HEIGHT)
    region = plan.regions[0]
    spot = region.polygon.representative_point()
    x, y, _ = camera.project(np.array([[spot.x, spot.y, 0.0]]))[0]
    found = hits(scene, camera, x, y)
    kinds = [item.kind for item, _ in found]
    depths = [depth for _, depth in found]
    assert kinds[0] in ("plane", "door") and Item("region", region.id) in [item for item, _ in found]
    assert depths == sorted(depths)


def test_a_second_click_picks_what_is_behind(plan: FloorPlan) -> None:
    look = Look(azimuth=-90.0, elevation=20.0, span=30.0, ceiling_cut=None)
    scene, camera = build_scene(plan, look), camera_of(look, WIDTH, HEIGHT)
    spot = plan.regions[0].polygon.representative_point()
    x, y, _ = camera.project(np.array([[spot.x, spot.y, 0.0]]))[0]
    items = [item for item, _ in hits(scene, camera, x, y)]
    assert len(items) > 1
    walked = [pick(scene, camera, x, y)]
    for _ in items:
        walked.append(pick(scene, camera, x, y, walked[-1]))
    assert walked == [*items, items[0]]


def test_doors_are_found_in_their_walls(plan: FloorPlan) -> None:
    door = plan.doors[0]
    look = Look(azimuth=-90.0 if door.axis == 1 else 0.0, elevation=0.0, span=20.0)
    look = Look(
        azimuth=look.azimuth,
        elevation=0.0,
        span=20.0,
        layers=frozenset(LAYERS) - {"planes"},
        centre=tuple(door.line().mean(axis=0)),
    )
    scene, camera = build_scene(plan, look), camera_of(look, WIDTH, HEIGHT)
    x, y, _ = camera.project(np.array([[*door.line().mean(axis=0), TARGET_HEIGHT]]))[0]
    assert Item("door", door.id) in [item for item, _ in hits(scene, camera, x, y)]


def test_an_empty_scene_holds_nothing() -> None:
    camera = camera_of(Look(), WIDTH, HEIGHT)
    assert hits(build_scene(None, Look()), camera, 10.0, 10.0) == ()

"""Points on their way into the 3D pane: frames, colours, density, growth."""

from __future__ import annotations

import threading

import numpy as np
import pytest

from floorcast_app.point_store import Points, PointStore
from floorcast_app.rendering import ramps
from floorcast_app.rendering.cloud import (
    Cloud,
    facing_colours,
    make_cloud,
    paint,
    plane_raster,
    scene_matrix,
    storey_height,
)
from floorcast_app.rendering.cloud_loader import CloudLoader, CloudMaker, Loaded, Wanted
from floorplan_core.model import PointChunk
from tests.factories import small_flat

SECONDS = 60.0


def test_points_go_where_the_plan_is() -> None:
    """The scene is the manhattan frame with its floor at zero."""
    plan = small_flat(yaw_deg=17.0)
    local = np.array([[3.0, -2.0, 1.0], [0.0, 0.0, 0.0]])
    cloud = make_cloud(Points(local.astype(np.float32)), scene_matrix(plan))
    expected = plan.frame.to_manhattan(local) - [0.0, 0.0, plan.frame.floor_z]
    np.testing.assert_allclose(cloud.xyz, expected, atol=1e-5)
    moved = make_cloud(Points(local.astype(np.float32)), scene_matrix(plan, origin=(5.0, 1.0, 0.0)))
    expected = plan.frame.to_manhattan(local - [5.0, 1.0, 0.0]) - [0.0, 0.0, plan.frame.floor_z]
    np.testing.assert_allclose(moved.xyz, expected, atol=1e-5)


def test_density_tells_the_spacing_of_a_surface() -> None:
    rng = np.random.default_rng(0)
    flat = np.column_stack([rng.uniform(0, 10, (40_000, 2)), np.zeros(40_000)]).astype(np.float32)
    cloud = make_cloud(Points(flat), np.eye(3, 4))
    assert cloud.density == pytest.approx(400.0, rel=0.1)  # 40,000 points on 100 m2
    assert cloud.spacing(len(cloud)) == pytest.approx(0.05, rel=0.1)
    assert cloud.spacing(len(cloud) // 4) == pytest.approx(0.1, rel=0.1)


def test_heights_rise_in_lightness_on_both_grounds() -> None:
    for theme in ("light", "dark"):
        ramp = ramps.height_ramp(theme)
        channels = np.stack([(ramp >> s) & 255 for s in (16, 8, 0)], axis=1) @ [0.2126, 0.7152, 0.0722]
        assert (np.diff(channels) > -0.8).all() and channels[-1] > channels[0] + 90


def test_points_have_the_colour_of_the_plane_that_they_lie_on() -> None:
    plan = small_flat()
    plane = max(plan.planes, key=lambda p: p.support)
    run = plane.walls[0]
    on = np.full((1, 3), 1.0, dtype=np.float32)
    on[0, plane.facing.axis], on[0, 1 - plane.facing.axis] = plane.offset, run.mean()
    high = on.copy()
    high[0, 2] = storey_height(plan)
    cloud = Cloud(np.concatenate([on, high]))
    wall, ceiling = paint(cloud, "facing", plan, "light").colours
    assert wall == facing_colours("light")[plane.facing]
    assert ceiling not in facing_colours("light")
    cells, _ = plane_raster(plan)
    assert set(np.unique(cells)) <= set(range(-1, len(plan.planes)))


def test_what_the_survey_does_not_hold_is_shown_by_height() -> None:
    cloud = Cloud(np.random.default_rng(0).uniform(0, 2.5, (100, 3)).astype(np.float32))
    plain = paint(cloud, "height", None, "light")
    for by in ("rgb", "intensity", "facing", "plane"):
        other = paint(cloud, by, None, "light")
        assert other.note == by and other.heights == plain.heights
        np.testing.assert_array_equal(other.colours, plain.colours)
    assert plain.note == ""


def test_colours_and_echoes_are_shown_where_there_are_any() -> None:
    rgb = np.array([[1, 2, 3], [255, 0, 128]], dtype=np.uint8)
    echo = np.array([0.0, 4000.0], dtype=np.float32)
    cloud = Cloud(np.zeros((2, 3), dtype=np.float32), rgb, echo)
    assert paint(cloud, "rgb", None, "light").colours.tolist() == [0x010203, 0xFF0080]
    weak, strong = paint(cloud, "intensity", None, "dark").colours.tolist()
    assert (weak, strong) == (ramps.grey_ramp("dark")[0], ramps.grey_ramp("dark")[-1])
    same = Cloud(np.zeros((2, 3), dtype=np.float32), intensity=np.zeros(2, dtype=np.float32))
    assert paint(same, "intensity", None, "dark").note == "intensity"  # it tells nothing


def test_only_colours_are_made_again_where_only_they_change() -> None:
    store = PointStore()
    store.add(PointChunk(np.random.default_rng(0).uniform(0, 3, (1000, 3)).astype(np.float32)))
    plan, maker = small_flat(), CloudMaker()
    first = maker.load(Wanted(store, plan, "height", "light"))
    second = maker.load(Wanted(store, plan, "facing", "dark"))
    assert second.cloud is first.cloud
    store.add(PointChunk(np.zeros((10, 3), dtype=np.float32)))
    assert len(maker.load(Wanted(store, plan, "facing", "dark")).cloud) == 1010


def test_of_a_moment_of_a_run_only_what_was_seen_by_then_is_shown() -> None:
    store, maker = PointStore(), CloudMaker()
    points = np.random.default_rng(0).uniform(0, 3, (1000, 3)).astype(np.float32)
    store.add(PointChunk(points, scan_id=np.repeat(np.arange(10, dtype=np.int32), 100)))
    some = maker.load(Wanted(store, small_flat(), "height", "light", scans=3))
    assert (len(some.cloud), some.read, len(some.paint.colours)) == (300, 1000, 300)
    assert len(maker.load(Wanted(store, small_flat(), "height", "light")).cloud) == 1000


def test_the_loader_answers_the_last_wish() -> None:
    store = PointStore()
    store.add(PointChunk(np.random.default_rng(0).uniform(0, 3, (50_000, 3)).astype(np.float32)))
    answers: list[Loaded] = []
    there = threading.Event()

    def done(loaded: Loaded) -> None:
        answers.append(loaded)
        if loaded.wanted.theme == "dark":
            there.set()

    loader = CloudLoader(done)
    for _ in range(5):
        loader.want(Wanted(store, None, "height", "light"))
    loader.want(Wanted(store, None, "height", "dark"))
    assert there.wait(SECONDS)
    loader.close()
    assert answers[-1].wanted.theme == "dark" and len(answers) <= 2


def test_an_empty_store_makes_an_empty_cloud() -> None:
    loaded = CloudMaker().load(Wanted(PointStore(), None, "height", "light"))
    assert len(loaded.cloud) == 0 and len(loaded.paint.colours) == 0

"""Pictures of points and plans: depth, cuts, translucency, determinism."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from floorcast_app.rendering.camera import camera_of
from floorcast_app.rendering.cloud import Cloud, Paint
from floorcast_app.rendering.ramps import packed
from floorcast_app.rendering.renderer import MAX_SPLAT, Frame, FrameRequest, Renderer, backdrop
from floorcast_app.rendering.scene import Scene, build_scene
from floorcast_app.selection import Item
from floorcast_app.view_state import LAYERS, Look
from tests.factories import small_flat

RED, BLUE = 0xFF0000, 0x0000FF
SIZE = 201
EMPTY = build_scene(None, Look())
TOP_VIEW = Look(azimuth=-90.0, elevation=90.0, span=4.0, ceiling_cut=None)


def cloud_of(*points: tuple[float, float, float], colours: tuple[int, ...] = (RED,)) -> tuple[Cloud, Paint]:
    xyz = np.array(points, dtype=np.float32)
    table = np.array((colours * len(points))[: len(points)], dtype=np.uint32)
    return Cloud(xyz, density=1e6), Paint(table)


def drawn(look: Look, scene: Scene = EMPTY, points: tuple[Cloud, Paint] | None = None, **more: bool) -> Frame:
    cloud, paint = points or (None, None)
    frame = Renderer().render(FrameRequest(look, SIZE, SIZE, scene, cloud, paint), **more)
    assert frame is not None
    return frame


def middle(frame: Frame) -> int:
    """The colour in the middle of a picture."""
    return int(frame.image[SIZE // 2, SIZE // 2]) & 0xFFFFFF


def is_ground(frame: Frame) -> bool:
    return middle(frame) == int(backdrop(SIZE, frame.request.look.theme)[SIZE // 2])


@pytest.mark.parametrize("order", [1, -1])
def test_the_nearer_point_hides_the_farther(order: int) -> None:
    """In whatever order they come."""
    both = cloud_of(*[(0.0, 0.0, 2.0), (0.0, 0.0, 0.5)][::order], colours=(RED, BLUE)[::order])
    assert middle(drawn(TOP_VIEW, points=both)) == RED
    from_below = replace(TOP_VIEW, elevation=-89.0, centre=(0.0, 0.0))
    near = drawn(replace(from_below, azimuth=0.0), points=both)
    assert BLUE in (near.image & 0xFFFFFF)


def test_a_point_is_as_wide_in_every_frame() -> None:
    """While something moves, when it rests, and where the screen has small pixels."""
    cloud, paint = cloud_of((0.0, 0.0, 0.5))
    sparse = replace(cloud, density=1.0)

    def width(frame: Frame) -> int:
        return int((frame.inverse > 0).any(axis=0).sum())

    quick, fine = (drawn(TOP_VIEW, points=(sparse, paint), fine=fine) for fine in (False, True))
    request = FrameRequest(TOP_VIEW, 2 * SIZE, 2 * SIZE, EMPTY, sparse, paint, ratio=2.0)
    small = Renderer().render(request)
    assert small is not None
    assert (width(quick), width(fine), width(small)) == (MAX_SPLAT, MAX_SPLAT, 2 * MAX_SPLAT)


def test_the_depth_of_a_point_is_kept() -> None:
    frame = drawn(TOP_VIEW, points=cloud_of((0.0, 0.0, 1.5)))
    depth = 1.0 / float(frame.inverse[SIZE // 2, SIZE // 2])
    assert depth == pytest.approx(frame.camera.eye[2] - 1.5, rel=1e-4)
    assert frame.inverse[0, 0] == 0.0


def test_the_ceiling_cut_takes_away_what_is_above() -> None:
    both = cloud_of((0.0, 0.0, 2.4), (0.0, 0.0, 0.5), colours=(RED, BLUE))
    assert middle(drawn(replace(TOP_VIEW, ceiling_cut=2.5), points=both)) == RED
    assert middle(drawn(replace(TOP_VIEW, ceiling_cut=2.0), points=both)) == BLUE
    assert is_ground(drawn(replace(TOP_VIEW, ceiling_cut=0.2), points=both))


def test_the_section_box_takes_away_what_is_outside() -> None:
    one = cloud_of((0.0, 0.0, 0.5))
    inside = drawn(replace(TOP_VIEW, section=(-1.0, -1.0, 1.0, 1.0)), points=one)
    outside = drawn(replace(TOP_VIEW, section=(0.3, 0.3, 1.0, 1.0)), points=one)
    assert middle(inside) == RED
    assert RED not in (outside.image & 0xFFFFFF)


def test_points_can_be_switched_off() -> None:
    look = replace(TOP_VIEW, layers=frozenset(LAYERS) - {"points"})
    assert is_ground(drawn(look, points=cloud_of((0.0, 0.0, 0.5))))


def test_points_at_the_edge_and_behind_the_eye_are_harmless() -> None:
    rng = np.random.default_rng(0)
    wild = rng.normal(0.0, 1.0, (20_000, 3)) * 10.0 ** rng.uniform(-3, 6, (20_000, 1))
    cloud = Cloud(wild.astype(np.float32), density=1.0)
    points = cloud, Paint(np.full(len(wild), RED, dtype=np.uint32))
    for azimuth in (0.0, 130.0):
        frame = drawn(Look(azimuth=azimuth, elevation=10.0, span=2.0, ceiling_cut=None), points=points)
        assert np.isfinite(frame.inverse).all()


def test_the_same_request_gives_the_same_picture() -> None:
    plan = small_flat()
    rng = np.random.default_rng(1)
    xyz = rng.uniform((0, 0, 0), (9, 7, 2.5), (50_000, 3)).astype(np.float32)
    points = Cloud(xyz, density=500.0), Paint(rng.integers(0, 1 << 24, len(xyz)).astype(np.uint32))
    look = Look(centre=(4.0, 3.0), span=14.0)
    scene = build_scene(plan, look)
    first = drawn(look, scene, points, fine=True)
    np.testing.assert_array_equal(first.image, drawn(look, build_scene(plan, look), points, fine=True).image)
    renderer = Renderer()
    request = FrameRequest(look, SIZE, SIZE, scene, *points)
    renderer.render(replace(request, look=replace(look, azimuth=10.0)))
    again = renderer.render(request, fine=True)  # what was drawn before leaves no trace
    assert again is not None
    np.testing.assert_array_equal(first.image, again.image)


def test_planes_are_translucent_and_hidden_by_points_before_them() -> None:
    """A wall over the ground is neither the ground nor the wall's colour; a point before it covers it."""
    plan = small_flat()
    plane = max(plan.planes, key=lambda p: p.support)
    facings = frozenset({int(plane.facing)})
    look = Look(layers=frozenset({"planes"}), facings=facings, ceiling_cut=None, span=6.0, elevation=10.0)
    ends = plane.walls[0] if len(plane.walls) else plane.observed[0]
    spot = np.full(3, 1.2)
    spot[plane.facing.axis], spot[1 - plane.facing.axis] = plane.offset, float(np.mean(ends))
    azimuth = {0: 0.0, 1: 180.0, 2: 90.0, 3: -90.0}[int(plane.facing)]
    look = replace(look, centre=(float(spot[0]), float(spot[1])), azimuth=azimuth)
    bare = drawn(look, build_scene(plan, look))
    assert not is_ground(bare)
    towards = np.zeros(3)
    towards[plane.facing.axis] = plane.facing.sign * 0.5
    camera = camera_of(look, SIZE, SIZE)
    on_axis = camera.target + towards  # in front of the wall, in the middle of the picture
    lifted = on_axis + np.array([0.0, 0.0, np.tan(np.radians(look.elevation)) * 0.5])
    layers = look.layers | {"points"}
    covered = drawn(replace(look, layers=layers), build_scene(plan, look), cloud_of(tuple(lifted)))
    shown = covered.image[SIZE // 2 - 3 : SIZE // 2 + 4, SIZE // 2 - 3 : SIZE // 2 + 4] & 0xFFFFFF
    assert RED in shown


def test_what_is_selected_lights_up() -> None:
    plan = small_flat()
    look = replace(TOP_VIEW, centre=plan.regions[0].polygon.centroid.coords[0], span=12.0)
    plain = drawn(look, build_scene(plan, look))
    item = Item("region", plan.regions[0].id)
    lit = drawn(look, build_scene(plan, look, selected=(item,)))
    hovered = drawn(look, build_scene(plan, look, hovered=item))
    assert middle(lit) != middle(plain)
    assert (hovered.image != plain.image).any()


def test_eyes_and_facings_take_things_away() -> None:
    plan = small_flat()
    everything = build_scene(plan, Look())
    region, plane = Item("region", plan.regions[0].id), Item("plane", plan.planes[0].id)
    hidden = build_scene(plan, Look(hidden=frozenset({(region.kind, region.id), (plane.kind, plane.id)})))
    assert {region, plane} <= set(everything.items)
    assert not {region, plane} & set(hidden.items)
    north = build_scene(plan, Look(facings=frozenset({2})))
    facings = {p.id: int(p.facing) for p in plan.planes}
    assert {facings[i.id] for i in north.items if i.kind == "plane"} == {2}


def test_the_section_box_cuts_floors_and_walls() -> None:
    plan = small_flat()
    x0, y0, x1, y1 = plan.regions[0].polygon.bounds
    box = (x0 - 0.3, y0 - 0.3, (x0 + x1) / 2, (y0 + y1) / 2)
    scene = build_scene(plan, Look(section=box))
    for corners in (scene.floors.corners, scene.walls.corners):
        assert len(corners)
        flat = corners.reshape(-1, 3)
        assert (flat[:, :2] >= np.array(box[:2]) - 0.2).all()  # thresholds are as thick as their wall
        assert (flat[:, :2] <= np.array(box[2:]) + 0.2).all()


def test_a_frame_can_be_stopped() -> None:
    cloud = cloud_of((0.0, 0.0, 0.5))
    assert Renderer().render(FrameRequest(TOP_VIEW, SIZE, SIZE, EMPTY, *cloud), stop=lambda: True) is None


def test_the_ground_follows_the_theme() -> None:
    assert int(backdrop(3, "light")[0]) == packed("#fafbfc") or int(backdrop(3, "light")[0]) > 0xE0E0E0
    assert int(backdrop(3, "dark")[0]) < 0x404040

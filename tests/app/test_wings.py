"""A wing at another angle in the window: walls are shown, selected, switched off and moved as any other."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import shapely

from floorcast_app.actions.naming import about
from floorcast_app.layers.evidence import evidence_layer
from floorcast_app.layers.item_shapes import item_shape
from floorcast_app.layers.source import source_of
from floorcast_app.open3d_viewer import plan_parts
from floorcast_app.panels.item_columns import things
from floorcast_app.rendering.cloud import PLANE_CELL, plane_raster
from floorcast_app.rendering.scene import build_scene
from floorcast_app.selection import Item
from floorcast_app.tools.gestures import At
from floorcast_app.tools.select_tool import door_ends
from floorcast_app.view_state import Look
from floorcast_app.workbench import Workbench
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.model import Door, LayoutPlane, Region
from floorplan_core.model.layout import turned
from tests.app.pump import make_workbench, planned, settle
from tests.app.surveys import write_wing
from tests.plan_invariants import assert_doors, assert_flags


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two rooms and a wing at 45 degrees."""
    return write_wing(tmp_path_factory.mktemp("wing"))


@pytest.fixture(scope="module")
def wing(folder: Path) -> Workbench:
    bench = planned(folder)
    assert len(bench.plan.wings) == 1
    return bench


@pytest.fixture
def bench(wing: Workbench):
    """The workbench as it was planned; corrections are undone."""
    yield wing
    wing.document.go_to(0)
    settle(wing)
    wing.selection.select(None)
    wing.set_tool("select")


def chamber(bench: Workbench) -> Region:
    """The room at the end of the wing, all of whose walls are the wing's."""
    turned_ones = [r for r in bench.plan.regions if all(s.plane.startswith("w1") for s in r.sides)]
    return max(turned_ones, key=lambda r: math.dist(r.polygon.centroid.coords[0], _centre(bench)))


def end_wall(bench: Workbench) -> LayoutPlane:
    """The wall of that room that is farthest from the rest: it is 5 m long."""
    sides = [s for s in chamber(bench).sides if math.dist(s.start, s.end) > 4.5]
    far = max(sides, key=lambda s: math.dist(np.mean([s.start, s.end], axis=0), _centre(bench)))
    return bench.find(Item("plane", far.plane))


def _centre(bench: Workbench) -> np.ndarray:
    return np.mean([r.polygon.centroid.coords[0] for r in bench.plan.regions], axis=0)


def middle_of(plane: LayoutPlane) -> float:
    return float(plane.walls[0].mean())


def test_walls_of_wings_are_listed_and_drawn_where_they_stand(bench: Workbench) -> None:
    (wing,) = bench.plan.wings
    assert {p.id for p in wing.planes} <= {p.id for p in things(bench.plan, "plane")}
    wall = end_wall(bench)
    assert bench.find(Item("plane", wall.id)) is wall and wall.turn == wing.turn
    source = source_of(bench.plan)
    lines = item_shape(source, Item("plane", wall.id)).lines
    along = lines[0][1] - lines[0][0]
    slant = math.degrees(math.atan2(along[1], along[0])) % 90
    assert slant == pytest.approx(math.degrees(wing.turn) % 90, abs=0.01)
    edge = chamber(bench).polygon.exterior
    assert all(edge.distance(shapely.Point(p)) < 0.25 for p in lines.mean(axis=1))


def test_they_are_hit_and_snapped_to(bench: Workbench) -> None:
    source, wall = source_of(bench.plan), end_wall(bench)
    x, y = wall.point(middle_of(wall))
    assert source.hits.at(x, y, 0.05, Look(), ("plane",)) == Item("plane", wall.id)
    far = wall.point(middle_of(wall) + 30.0)
    assert source.hits.at(*far, 0.05, Look(), ("plane",), dotted=True) == Item("plane", wall.id)
    inside = wall.point(middle_of(wall), wall.offset + 0.08 * wall.facing.sign)
    snap = source.snaps.wall(*inside, 0.2)
    assert snap is not None and snap.along is not None and min(map(abs, snap.along)) > 0.1
    assert abs(wall.own(snap.xy)[1] - wall.offset) < 0.03


def test_they_stand_in_both_three_dimensional_views(bench: Workbench) -> None:
    wall = end_wall(bench)
    with_wings = build_scene(bench.plan, Look())
    without = build_scene(bench.plan, Look(hidden=frozenset({("plane", wall.id)})))
    assert Item("plane", wall.id) in with_wings.items and Item("plane", wall.id) not in without.items
    extra = len(with_wings.walls.corners) - len(without.walls.corners)
    assert extra == 2 * len(wall.walls)
    corners = np.concatenate([p.vertices for p in plan_parts(bench.plan) if p.index.shape[1] == 3])
    across = turned(corners[:, :2], -wall.turn)[:, wall.facing.axis]
    assert (np.abs(across - wall.offset) < 1e-6).sum() >= 4


def test_a_wall_of_a_wing_is_switched_off_and_on(bench: Workbench) -> None:
    before, wall = chamber(bench).area, end_wall(bench)
    bench.run("correct.hide_plane", plane=wall.id)
    settle(bench)
    hidden = bench.find(Item("plane", wall.id))
    assert hidden.by_hand == "hidden" and ("plane", wall.id) in bench.plan.corrected
    bench.run("correct.keep_plane", plane=wall.id)
    settle(bench)
    assert bench.find(Item("plane", wall.id)).by_hand == "kept"
    assert chamber(bench).area == pytest.approx(before, abs=0.01)
    bench.document.undo()
    bench.document.undo()
    settle(bench)
    assert bench.find(Item("plane", wall.id)).by_hand == ""


def test_it_is_moved_by_an_exact_offset_and_by_a_drag(bench: Workbench) -> None:
    before, wall = chamber(bench).area, end_wall(bench)
    bench.run("correct.move_plane", plane=wall.id, offset=wall.offset - 0.3 * wall.facing.sign)
    settle(bench)
    moved = bench.find(Item("plane", wall.id))
    assert moved.by_hand == "moved"
    assert moved.offset == pytest.approx(wall.offset - 0.3 * wall.facing.sign, abs=1e-6)
    assert chamber(bench).area == pytest.approx(before + 0.3 * 5.0, abs=0.1)
    assert "wall at" in bench.plan.machine[wall.id]
    bench.selection.select(Item("plane", wall.id))
    tool, item = bench.toolbox.tool, Item("plane", wall.id)
    start = moved.point(middle_of(moved))
    end = moved.point(middle_of(moved), wall.offset)
    tool.press(At(*start, 50.0, item))
    tool.drag(At(*end, 50.0, item))
    mark = next(m for m in tool.marks() if m.kind == "plane")
    assert mark.turn == wall.turn
    tool.release(At(*end, 50.0, item), True)
    settle(bench)
    back = bench.find(Item("plane", wall.id))
    assert back.offset == pytest.approx(wall.offset, abs=0.03)
    assert chamber(bench).area == pytest.approx(before, abs=0.2)


def test_what_was_said_of_it_is_found_again_and_taken_back(bench: Workbench) -> None:
    wall = end_wall(bench)
    bench.run("correct.move_plane", plane=wall.id, offset=wall.offset - 0.2 * wall.facing.sign)
    settle(bench)
    bench.run("correct.release", item=f"plane:{wall.id}")
    settle(bench)
    assert bench.state.corrections == ()
    assert bench.find(Item("plane", wall.id)).offset == wall.offset


def test_the_evidence_of_a_door_in_a_wing_is_shown(bench: Workbench) -> None:
    door = next(d for d in bench.plan.doors if d.turn)
    layer = evidence_layer(bench.plan, Item("door", door.id))
    assert layer is not None and layer.turn == door.turn
    x, y = door.line().mean(axis=0)
    along, away = layer.along(float(x), float(y))
    assert door.start < along < door.end and away < 0.2
    assert layer.point(along) == pytest.approx((x, y), abs=0.2)


def inner_door(bench: Workbench) -> Door:
    """The door between the hall and the chamber of the wing: in a wall of the wing."""
    room = chamber(bench)
    return next(d for d in bench.plan.doors if d.turn and room.id in d.connects)


def again(bench: Workbench, *ids: str) -> None:
    """Undo and redo everything; the document and the plan are as before."""
    said, plan = bench.state.corrections, bench.plan
    for _ in ids:
        bench.document.undo()
    settle(bench)
    assert bench.state.corrections == ()
    for _ in ids:
        bench.document.redo()
    settle(bench)
    assert bench.state.corrections == said
    assert geojson_text(bench.plan) == geojson_text(plan)
    assert_doors(bench.plan)
    assert_flags(bench.plan)
    shapes = [r.polygon for r in bench.plan.regions]
    assert all(a.is_valid and a.geom_type == "Polygon" for a in shapes)
    assert all(a.intersection(b).area < 1e-5 for k, a in enumerate(shapes) for b in shapes[:k])


def test_a_door_of_a_wing_is_accepted_and_rejected(bench: Workbench) -> None:
    door = inner_door(bench)
    count = len(bench.plan.doors)
    bench.run("correct.accept_door", door=door.id)
    settle(bench)
    assert bench.find(Item("door", door.id)).by_hand == "accepted"
    assert "sure" in bench.plan.machine[door.id]
    assert about(bench, Item("door", door.id)) == {0}
    bench.run("correct.reject_door", door=door.id)
    settle(bench)
    assert len(bench.plan.doors) == count - 1 and not any(
        chamber(bench).id in d.connects for d in bench.plan.doors
    )
    again(bench, "accept", "reject")


def test_a_door_of_a_wing_is_resized_by_number_and_by_its_end(bench: Workbench) -> None:
    door = inner_door(bench)
    bench.run("correct.resize_door", door=door.id, width=1.3)
    settle(bench)
    wide = bench.find(Item("door", door.id))
    assert wide.width == pytest.approx(1.3, abs=1e-6) and wide.by_hand == "resized"
    assert wide.start + wide.end == pytest.approx(door.start + door.end, abs=1e-6)
    bench.selection.select(Item("door", door.id))
    start, end = door_ends(wide, wide.start, wide.end)
    to = door_ends(wide, wide.start, wide.end - 0.4)[1]
    tool = bench.toolbox.tool
    grips = next(m for m in tool.marks() if m.kind == "grips")
    assert grips.points == (start, end)
    tool.press(At(*end, 50.0, Item("door", door.id)))
    tool.drag(At(*to, 50.0, shift=True))
    assert any(m.text == "0.900 m" for m in tool.marks())
    tool.release(At(*to, 50.0), True)
    settle(bench)
    assert bench.find(Item("door", door.id)).width == pytest.approx(0.9, abs=1e-6)
    again(bench, "resize", "drag")


def test_a_door_is_drawn_in_a_wall_of_a_wing_by_two_clicks(bench: Workbench) -> None:
    wall, count = end_wall(bench), len(bench.plan.doors)
    bench.run("tool.door")
    tool, along = bench.toolbox.tool, middle_of(wall)
    first, second = wall.point(along - 0.45), wall.point(along + 0.45, wall.offset + 0.03)
    tool.move(At(*first, 50.0))
    tool.release(At(*first, 50.0), False)
    tool.move(At(*second, 50.0, shift=True))
    assert any(m.kind == "line" and m.role == "door" for m in tool.marks())
    tool.release(At(*second, 50.0, shift=True), False)
    settle(bench)
    (made,) = [d for d in bench.plan.doors if d.by_hand == "added"]
    assert len(bench.plan.doors) == count + 1 and made.turn == wall.turn and made.kind == "door"
    assert made.width == pytest.approx(0.9, abs=0.02) and wall.id in made.planes
    assert chamber(bench).id in made.connects
    assert about(bench, Item("door", made.id)) == {0}
    again(bench, "add")


def test_a_wall_is_drawn_along_the_axes_of_the_wing(bench: Workbench) -> None:
    room = chamber(bench)
    wall = end_wall(bench)
    bench.run("tool.wall")
    tool = bench.toolbox.tool
    depth, along = wall.offset + 1.2 * wall.facing.sign, middle_of(wall)
    first, second = wall.point(along - 2.0, depth), wall.point(along + 2.0, depth + 0.1)
    for place in (first, second):
        tool.move(At(*place, 50.0, shift=True))
        tool.release(At(*place, 50.0, shift=True), False)
    settle(bench)
    faces = [p for p in bench.plan.all_planes if p.by_hand == "added"]
    assert [p.turn for p in faces] == [wall.turn, wall.turn]
    assert np.mean([p.offset for p in faces]) == pytest.approx(depth, abs=1e-6)
    assert about(bench, Item("plane", faces[0].id)) == {0}
    assert max(r.polygon.intersection(room.polygon).area for r in bench.plan.regions) < 0.8 * room.area
    again(bench, "wall")


def test_a_region_of_a_wing_is_split_and_merged(bench: Workbench) -> None:
    room, wall = chamber(bench), end_wall(bench)
    count = len(bench.plan.regions)
    bench.run("tool.split")
    tool, deep = bench.toolbox.tool, wall.offset + 1.0 * wall.facing.sign
    ends = [wall.point(middle_of(wall) + d, deep) for d in (-2.6, 2.6)]
    for place in ends:
        tool.move(At(*place, 50.0, shift=True))
        tool.release(At(*place, 50.0, shift=True), False)
    settle(bench)
    parts = [r for r in bench.plan.regions if "split" in r.by_hand]
    assert len(bench.plan.regions) == count + 1 and len(parts) == 2
    assert sum(r.area for r in parts) == pytest.approx(room.area, abs=1e-3)
    assert min(r.area for r in parts) == pytest.approx(5.0, abs=0.2)
    assert all(r.height == pytest.approx(room.height, abs=0.03) for r in parts)
    bench.run("correct.merge", regions=[r.id for r in parts])
    settle(bench)
    (one,) = [r for r in bench.plan.regions if "merged" in r.by_hand]
    assert one.polygon.symmetric_difference(room.polygon).area < 1e-3
    assert len(bench.plan.regions) == count
    again(bench, "split", "merge")


def test_rooms_of_a_wing_are_one_with_the_wall_between_them(bench: Workbench) -> None:
    door = inner_door(bench)
    count, before = len(bench.plan.regions), {r.id: r for r in bench.plan.regions}
    bench.run("correct.merge", regions=list(door.connects))
    settle(bench)
    (one,) = [r for r in bench.plan.regions if "merged" in r.by_hand]
    assert len(bench.plan.regions) == count - 1
    assert one.area > sum(before[i].area for i in door.connects) + 0.3  # and the wall between them
    assert all(not s.speculated for s in one.sides if s.length > 2.0)
    assert bench.find(Item("door", door.id)) is None
    again(bench, "merge")


def test_a_region_of_a_wing_is_split_across_its_middle(bench: Workbench) -> None:
    room = chamber(bench)
    bench.run("correct.split", region=room.id)
    settle(bench)
    parts = [r for r in bench.plan.regions if "split" in r.by_hand]
    assert [r.area for r in parts] == pytest.approx([room.area / 2] * 2, rel=0.02)


def test_a_region_of_a_wing_is_named_and_labelled(bench: Workbench) -> None:
    room = chamber(bench)
    bench.run("correct.rename", region=room.id, name="Chapel")
    bench.run("correct.relabel", region=room.id, label="hall")
    settle(bench)
    found = chamber(bench)
    assert (found.name, found.label) == ("Chapel", "hall")
    assert bench.plan.machine[found.id] == f"name {room.name}; label room"
    again(bench, "rename", "relabel")


def test_corrections_of_a_wing_are_kept_in_a_project(bench: Workbench, tmp_path: Path) -> None:
    door, wall = inner_door(bench), end_wall(bench)
    bench.run("correct.resize_door", door=door.id, width=1.2)
    bench.run("correct.move_plane", plane=wall.id, offset=wall.offset - 0.2 * wall.facing.sign)
    bench.run("correct.rename", region=chamber(bench).id, name="Chapel")
    settle(bench)
    plan = geojson_text(bench.plan)
    bench.run("file.save", path=tmp_path / "wing.floorcast")
    other = make_workbench()
    other.open_project(tmp_path / "wing.floorcast")
    settle(other)
    assert other.state.corrections == bench.state.corrections
    assert geojson_text(other.plan) == plan
    other.run("plan.set", name="doors.min_confidence", value=0.45)  # a rerun with other settings
    settle(other)
    assert inner_door(other).width == pytest.approx(1.2, abs=1e-6)
    assert chamber(other).name == "Chapel"


def test_points_of_a_wing_have_the_colours_of_its_planes(bench: Workbench) -> None:
    wall, plan = end_wall(bench), bench.plan
    low, high = wall.walls[0]
    places = np.array([wall.point(t) for t in np.linspace(low + 0.2, high - 0.2, 20)])
    points = plan.wall_points
    for x, y in places:
        k = int(np.hypot(points.xy[:, 0] - x, points.xy[:, 1] - y).argmin())
        assert points.facing[k] in (wall.facing, -1)
    near = np.hypot(*(points.xy[:, None, :] - places[None]).transpose(2, 0, 1)).min(axis=1) < 0.06
    assert np.mean(points.facing[near] == wall.facing) > 0.8
    cells, origin = plane_raster(plan)
    x, y = np.floor((places - origin) / PLANE_CELL).astype(int).T
    number = [p.id for p in plan.all_planes].index(wall.id)
    assert np.mean(cells[y, x] == number) > 0.9
    beside = np.array([wall.point(t, wall.offset + 0.3 * wall.facing.sign) for t in (low + 1, high - 1)])
    x, y = np.floor((beside - origin) / PLANE_CELL).astype(int).T
    assert (cells[y, x] != number).all()

"""A wing at another angle in the window: walls are shown, selected, switched off and moved as any other."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import shapely

from floorcast_app.layers.evidence import evidence_layer
from floorcast_app.layers.item_shapes import item_shape
from floorcast_app.layers.source import source_of
from floorcast_app.open3d_viewer import plan_parts
from floorcast_app.panels.item_columns import things
from floorcast_app.rendering.scene import build_scene
from floorcast_app.selection import Item
from floorcast_app.tools.gestures import At
from floorcast_app.view_state import Look
from floorcast_app.workbench import Workbench
from floorplan_core.model import LayoutPlane, Region
from floorplan_core.model.layout import turned
from tests.app.pump import make_workbench, settle
from tests.wing_world import WingWorld


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two rooms and a wing at 45 degrees as points with their scans, and a trajectory."""
    made = tmp_path_factory.mktemp("wing")
    scans = WingWorld(45.0).survey(10.0, rays=(150, 46))
    names = ("float x", "float y", "float z", "int scan_id")
    head = ("ply", "format ascii 1.0", f"element vertex {len(scans.points)}")
    header = "\n".join([*head, *(f"property {name}" for name in names), "end_header"])
    table = np.column_stack([scans.points, scans.scan_id])
    np.savetxt(made / "points.ply", table, "%.4f %.4f %.4f %d", header=header, comments="")
    at = [f"{k} {x:.4f} {y:.4f} {z:.4f} 0 0 0 1" for k, (x, y, z) in enumerate(scans.poses[:, :3, 3])]
    (made / "trajectory.tum").write_text("\n".join(at) + "\n")
    return made


@pytest.fixture(scope="module")
def planned(folder: Path) -> Workbench:
    bench = make_workbench()
    bench.open_survey(folder)
    settle(bench)
    assert bench.plan is not None and len(bench.plan.wings) == 1, bench.ui.told
    return bench


@pytest.fixture
def bench(planned: Workbench):
    """The workbench as it was planned; corrections are undone."""
    yield planned
    planned.document.go_to(0)
    settle(planned)
    planned.selection.select(None)
    planned.set_tool("select")


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
    assert snap is not None and snap.axis is None
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

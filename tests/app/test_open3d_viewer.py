"""The scene for Open3D's viewer: what is in it, and what is said where it cannot be shown."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from floorcast_app import open3d_viewer
from floorcast_app.jobs import immediately
from floorcast_app.open3d_viewer import Part, geometry_of, load_parts, open_in_open3d, plan_parts, save_parts
from floorcast_app.workbench import Workbench
from floorplan_core.errors import UsageError
from tests.app.plan_panes import drawn_workbench
from tests.factories import small_flat


def test_planes_look_where_they_were_seen_from() -> None:
    plan = small_flat()
    for plane in plan.planes:
        part = open3d_viewer._plane_part(plane, 2.2)
        a, b, c = (part.vertices[part.index[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        assert (normals[:, plane.facing.axis] * plane.facing.sign > 0).all()
        assert part.vertices[:, 2].max() == pytest.approx(2.2)


def test_regions_are_slabs_with_the_edges_of_their_rooms() -> None:
    region = small_flat().regions[0]
    slab, edges = open3d_viewer._region_parts(region, 2.4)
    a, b, c = (slab.vertices[slab.index[:, k]] for k in range(3))
    doubled = np.cross(b - a, c - a)
    upward = doubled[:, 2][doubled[:, 2] > 1e-9].sum() / 2
    assert upward == pytest.approx(region.area)
    assert slab.vertices[:, 2].min() == pytest.approx(-open3d_viewer.SLAB)
    assert edges.index.shape[1] == 2 and edges.vertices[:, 2].max() == pytest.approx(2.4)


def test_the_cut_lowers_everything() -> None:
    top = max(part.vertices[:, 2].max() for part in plan_parts(small_flat(), 1.0))
    assert top == pytest.approx(1.0)


def test_parts_survive_the_way_to_the_other_process(tmp_path: Path) -> None:
    parts = [*plan_parts(small_flat()), Part(np.ones((2, 3)), np.zeros((0, 0), np.int32), np.ones((2, 3)))]
    save_parts(parts, tmp_path / "scene.npz")
    again = load_parts(tmp_path / "scene.npz")
    assert len(again) == len(parts)
    for one, two in zip(parts, again, strict=True):
        np.testing.assert_array_equal(one.vertices, two.vertices)
        np.testing.assert_array_equal(one.index, two.index)


def test_geometries_of_open3d() -> None:
    pytest.importorskip("open3d")
    plan = small_flat()
    cloud = Part(np.zeros((100, 3)), np.zeros((0, 0), np.int32), np.zeros((100, 3)))
    scene = [geometry_of(part) for part in (cloud, *plan_parts(plan))]
    kinds = [type(geometry).__name__ for geometry in scene]
    assert kinds[0] == "PointCloud" and len(scene[0].points) == len(scene[0].colors) == 100
    walls = sum(bool(len(p.walls) or len(p.observed)) for p in plan.planes)
    assert kinds.count("TriangleMesh") == walls + len(plan.regions) + len(plan.doors)
    assert kinds.count("LineSet") == len(plan.regions)
    assert all(len(g.triangles) for g in scene if type(g).__name__ == "TriangleMesh")


def test_without_a_display_one_sentence_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    workbench = drawn_workbench(small_flat())
    monkeypatch.setattr(sys, "platform", "linux")
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    with pytest.raises(UsageError, match="display with OpenGL"):
        open_in_open3d(workbench)


def test_without_a_plan_there_is_nothing_to_show() -> None:
    with pytest.raises(UsageError, match="no plan"):
        open_in_open3d(Workbench(immediately))


def test_a_viewer_that_fails_is_told() -> None:
    assert "no OpenGL" in open3d_viewer._failure(open3d_viewer.NO_OPENGL)
    assert "-6" in open3d_viewer._failure(-6)

"""One simulated survey through the writers of other programs: the plan is that of the PLY.

As far as a format carries it: a mesh knows no viewpoints, an OctoMap only the voxels, a depth image whole
fractions of a millimetre.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
import trimesh

from floorplan_core.model import FloorPlan
from floorplan_core.pipeline import process
from floorplan_core.simulation.files import tum_bytes
from tests.box_world import HEIGHT, LINTEL, cast, stations, survey, two_rooms
from tests.plugins import test_octomap, test_rgbd
from tests.plugins.e57_files import write_scans
from tests.plugins.plugin_files import opened
from tests.plugins.test_e57 import spherical
from tests.plugins.test_mesh import KINDS, write_mesh
from tests.readers.reader_clouds import write_ply, xyz_columns

MILLIMETRE = 1e-3
DOOR = (2.0, 2.9, LINTEL)
BOXES = two_rooms(DOOR)
WANTED = [(0.0, 0.0, 4.0, 5.0), (4.1, 0.0, 8.1, 5.0)]
PLACES = [*stations(4, 5), *stations(4, 5, x0=4.1), (3.9, 2.4, 1.4), (4.3, 2.4, 1.4)]


@pytest.fixture(scope="module")
def seen():
    """The survey as a lidar makes it, its axes those of the world."""
    return survey(BOXES, PLACES, rays=(200, 60))


def plan_of(path: Path, within: float = 0.03) -> FloorPlan:
    plan = process(opened(path))
    assert_the_flat(plan, within)
    return plan


def rooms(plan: FloorPlan) -> list[shapely.Polygon]:
    """The regions in the world, from west to east."""

    def world(xy: np.ndarray) -> np.ndarray:
        return (plan.frame.from_manhattan(xy) + plan.local_frame.shift)[:, :2]

    return sorted((shapely.transform(r.polygon, world) for r in plan.regions), key=lambda p: p.centroid.x)


def assert_the_flat(plan: FloorPlan, within: float) -> None:
    """Two rooms of the size that they have, joined by one door of its width."""
    found = rooms(plan)
    assert len(found) == 2
    for polygon, bounds in zip(found, WANTED, strict=True):
        assert polygon.hausdorff_distance(shapely.box(*bounds)) < within
    (door,) = plan.doors
    assert door.width == pytest.approx(DOOR[1] - DOOR[0], abs=2 * within)


def assert_same(one: FloorPlan, two: FloorPlan, within: float) -> None:
    for a, b in zip(rooms(one), rooms(two), strict=True):
        assert a.hausdorff_distance(b) < within
    assert [d.width for d in one.doors] == pytest.approx([d.width for d in two.doors], abs=2 * within)


def write_survey(folder: Path, points: np.ndarray, ids: np.ndarray, poses: np.ndarray) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "trajectory.tum").write_bytes(tum_bytes(np.arange(len(poses), dtype=float), poses))
    columns = xyz_columns(points, "f8", scan_id=ids.astype("i4"))
    return write_ply(folder / "points.ply", "binary_little_endian", columns)


def test_spherical_scans_of_an_e57(seen, tmp_path):
    scans = []
    for k, T in enumerate(seen.poses):
        local = (seen.points[seen.scan_id == k] - T[:3, 3]) @ T[:3, :3]
        scans.append((spherical(local), T))
    e57 = plan_of(write_scans(tmp_path / "a.e57", scans))
    ply = plan_of(write_survey(tmp_path / "ply", seen.points, seen.scan_id, seen.poses))
    assert_same(e57, ply, MILLIMETRE)


SOLIDS = [(np.array(box[:3]), np.array(box[3:])) for box in BOXES]


def solid_mesh() -> trimesh.Trimesh:
    """What a modeller has of the flat: every wall and slab a closed box, its outside too."""
    parts = [
        trimesh.creation.box(bounds=(low, high)).subdivide_to_size(0.3)
        for low, high in SOLIDS
        if (high > low).all()
    ]
    return trimesh.util.concatenate(parts)


def box_mesh() -> trimesh.Trimesh:
    """What a reconstruction has of the flat: its surfaces without the outside of walls and slabs."""
    mesh = solid_mesh()
    before = mesh.triangles_center + 0.02 * mesh.face_normals  # where one stands to see it
    inside = (before > (0, 0, 0)).all(axis=1) & (before < (8.1, 5.0, HEIGHT)).all(axis=1)
    for low, high in SOLIDS:
        inside &= ~((before > low) & (before < high)).all(axis=1)
    return mesh.submesh([np.flatnonzero(inside)], append=True)


@pytest.fixture(scope="module")
def from_mesh(tmp_path_factory):
    return {
        kind: plan_of(write_mesh(tmp_path_factory.mktemp(kind) / f"a.{kind}", box_mesh())) for kind in KINDS
    }


@pytest.mark.parametrize("kind", [k for k in KINDS if k != "ply"])
def test_meshes(from_mesh, kind):
    assert_same(from_mesh[kind], from_mesh["ply"], MILLIMETRE)


@pytest.mark.parametrize("kind", ["obj", "stl"])
def test_the_inner_faces_of_closed_solids_bound_the_rooms(tmp_path, kind):
    plan_of(write_mesh(tmp_path / f"a.{kind}", solid_mesh()))


def camera_walk() -> np.ndarray:
    """(N, 4, 4) camera to world: twice around at four places, looking down, then up."""
    around = np.arange(12) * np.pi / 6
    turns = [test_rgbd.looking(yaw, pitch) for pitch in (-0.4, 0.4) for yaw in around]
    places = PLACES[::3]
    poses = np.tile(np.eye(4), (len(places) * len(turns), 1, 1))
    poses[:, :3, :3] = np.tile(turns, (len(places), 1, 1))
    poses[:, :3, 3] = np.repeat(places, len(turns), axis=0)
    return poses


def box_depth(T: np.ndarray) -> np.ndarray:
    """A depth image of the flat."""
    rays = test_rgbd.pixel_rays().reshape(-1, 3)
    length = np.linalg.norm(rays, axis=1)
    distance = cast(BOXES, T[:3, 3], rays / length[:, None] @ T[:3, :3].T)
    return (distance / length).reshape(test_rgbd.HEIGHT, test_rgbd.WIDTH)


@pytest.fixture(scope="module")
def depth_plan(tmp_path_factory) -> FloorPlan:
    poses = camera_walk()
    rays = test_rgbd.pixel_rays().reshape(-1, 3)
    local = [rays * box_depth(T).reshape(-1, 1) for T in poses]
    points = np.concatenate([p @ T[:3, :3].T + T[:3, 3] for p, T in zip(local, poses, strict=True)])
    ids = np.repeat(np.arange(len(poses)), len(rays))
    return plan_of(write_survey(tmp_path_factory.mktemp("depth"), points, ids, poses))


@pytest.mark.parametrize(
    ("write", "inverted", "scale"),
    [
        (test_rgbd.write_tum_folder, False, 5000.0),
        (test_rgbd.write_scannet, False, 1000.0),
        (test_rgbd.write_scannet, True, 1000.0),
        (test_rgbd.write_redwood, True, 1000.0),
    ],
)
def test_folders_of_depth_images(depth_plan, tmp_path, monkeypatch, write, inverted, scale):
    monkeypatch.setattr(test_rgbd, "camera_poses", camera_walk)
    monkeypatch.setattr(test_rgbd, "COUNT", len(camera_walk()))
    monkeypatch.setattr(test_rgbd, "render", box_depth)
    (tmp_path / "run").mkdir()
    assert_same(plan_of(write(tmp_path / "run", inverted, scale)), depth_plan, 2 * MILLIMETRE)


VOXEL = 0.1  # m
SHIFT = (0.023, 0.031, 0.02)  # m: walls lie in one layer of voxels, not on the border of two


def octree_leaves(seen, shift=SHIFT) -> dict[tuple[int, int, int, int], int]:
    """Occupied where a point is, free where a ray passed: what an OctoMap server makes of the scans."""

    def keys(points: np.ndarray) -> np.ndarray:
        return np.unique(np.floor(points / VOXEL).astype(int) + 32768, axis=0)

    origins, points = seen.poses[seen.scan_id, :3, 3] + np.array(shift), seen.points + np.array(shift)
    rays = points - origins
    length = np.linalg.norm(rays, axis=1)
    steps = np.arange(0.0, length.max(), VOXEL / 2)
    passed = [keys((origins + rays * (t / length)[:, None])[length > t]) for t in steps]
    leaves = {(*key, 0): test_octomap.FREE for key in np.unique(np.concatenate(passed), axis=0).tolist()}
    return leaves | {(*key, 0): test_octomap.OCCUPIED for key in keys(points).tolist()}


def test_octrees(seen, tmp_path, monkeypatch):
    monkeypatch.setattr(test_octomap, "RES", VOXEL)
    leaves = octree_leaves(seen)
    binary = plan_of(test_octomap.write_bt(tmp_path / "a.bt", leaves), VOXEL)
    full = plan_of(test_octomap.write_ot(tmp_path / "a.ot", leaves), VOXEL)
    assert_same(full, binary, 1e-9)


def test_an_octree_whose_surfaces_lie_on_the_borders_of_voxels(seen, tmp_path, monkeypatch):
    """Noise puts them into both layers: surfaces are thicker than the patches that show directions may be."""
    monkeypatch.setattr(test_octomap, "RES", VOXEL)
    plan_of(test_octomap.write_bt(tmp_path / "a.bt", octree_leaves(seen, (0.0, 0.0, 0.0))), within=VOXEL)


def test_numbers_in_text_without_viewpoints(seen, tmp_path):
    """PTS (a count, then intensity and colour) as PLY: the form of a file makes no difference."""
    rows = np.column_stack([seen.points.round(4), np.full((len(seen.points), 4), 128)])
    np.savetxt(tmp_path / "a.pts", rows, fmt="%.4f %.4f %.4f %d %d %d %d", header=str(len(rows)), comments="")
    (tmp_path / "ply").mkdir()
    columns = xyz_columns(seen.points.round(4), "f8")
    ply = write_ply(tmp_path / "ply" / "a.ply", "binary_little_endian", columns)
    assert_same(plan_of(tmp_path / "a.pts"), plan_of(ply), 1e-6)

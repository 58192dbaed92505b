"""Every format that carries points, through its real writer: the plan is that of the plain PLY.

What is not here is elsewhere: E57 in spherical coordinates, meshes, octrees, folders of depth images and
PTS in ``test_same_plan``, maps in ``tests/grid_map``, IFC in ``tests/evaluation/test_ifc_model``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import laspy
import numpy as np
import pye57
import pytest
from scipy.spatial.transform import Rotation

from floorplan_core.model import FloorPlan
from floorplan_core.pipeline import process
from floorplan_core.readers.trajectory import read_trajectory
from floorplan_core.simulation.files import tum_bytes
from tests.box_world import EYE, Survey, cast, survey
from tests.plugins import test_rgbd
from tests.plugins.plugin_files import opened, whole
from tests.plugins.test_rosbag import START, Messages, write_recording
from tests.plugins.test_rosbag_depth import DepthMessages
from tests.plugins.test_same_plan import (
    BOXES,
    MILLIMETRE,
    PLACES,
    assert_same,
    box_depth,
    camera_walk,
    plan_of,
    write_survey,
)
from tests.readers.reader_clouds import write_pcd, write_ply, xyz_columns
from tests.readers.test_reader_ptx import scan_text
from tests.readers.test_reader_trajectory_forms import write_euroc, write_kitti

Write = Callable[[Path, Survey], Path]


@pytest.fixture(scope="module")
def seen() -> Survey:
    """A lidar that was turned at every place."""
    made = survey(BOXES, PLACES, rays=(160, 50))
    for k, T in enumerate(made.poses):
        T[:3, :3] = Rotation.from_euler("zyx", [37.0 * k, 4.0, -3.0], degrees=True).as_matrix()
    return made


@pytest.fixture(scope="module")
def posed(seen, tmp_path_factory) -> FloorPlan:
    return plan_of(write_survey(tmp_path_factory.mktemp("posed"), seen.points, seen.scan_id, seen.poses))


@pytest.fixture(scope="module")
def merged(seen, tmp_path_factory) -> FloorPlan:
    path = tmp_path_factory.mktemp("merged") / "a.ply"
    return plan_of(write_ply(path, "binary_little_endian", xyz_columns(seen.points, "f8")))


def scans(seen: Survey) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Each scan in the frame of its sensor, with its pose."""
    for k, T in enumerate(seen.poses):
        yield (seen.points[seen.scan_id == k] - T[:3, 3]) @ T[:3, :3], T


def beside(path: Path, seen: Survey) -> Path:
    """``path`` with a trajectory in its folder."""
    (path.parent / "trajectory.tum").write_bytes(
        tum_bytes(np.arange(len(seen.poses), dtype=float), seen.poses)
    )
    return path


def columns(seen: Survey, kind: str = "f8") -> dict[str, np.ndarray]:
    return xyz_columns(seen.points, kind, scan_id=seen.scan_id)


def e57(folder: Path, seen: Survey) -> Path:
    with pye57.E57(str(folder / "a.e57"), "w") as file:
        for local, T in scans(seen):
            fields = {f"cartesian{axis}": local[:, k] for k, axis in enumerate("XYZ")}
            quaternion = np.roll(Rotation.from_matrix(T[:3, :3]).as_quat(), 1)
            file.write_scan_raw(fields, rotation=quaternion, translation=T[:3, 3])
    return folder / "a.e57"


def las(version: str, form: int, suffix: str = "las", joined: str = "") -> Write:
    """Written by laspy; the rows of the trajectory in ``joined``: "scan_id", "gps_time" or nowhere."""

    def write(folder: Path, seen: Survey) -> Path:
        header = laspy.LasHeader(version=version, point_format=form)
        header.scales = np.full(3, 1e-4)
        if joined == "scan_id":
            header.add_extra_dim(laspy.ExtraBytesParams("scan_id", np.uint16))
        data = laspy.LasData(header)
        data.x, data.y, data.z = seen.points.T
        if joined:
            data[joined] = seen.scan_id
            beside(folder / "a", seen)
        data.write(str(folder / f"a.{suffix}"))
        return folder / f"a.{suffix}"

    return write


def text(name: str, separator: str, decimal: str = ".", head: str = "") -> Write:
    def write(folder: Path, seen: Survey) -> Path:
        rows = (separator.join(f"{v:.4f}".replace(".", decimal) for v in row) for row in seen.points)
        (folder / name).write_text(head + "\n".join(rows) + "\n", encoding="utf-8")
        return folder / name

    return write


def table(folder: Path, seen: Survey) -> Path:
    """A table with named columns, the row of the trajectory first."""
    rows = (f"{k},{z:.4f},{x:.4f},{y:.4f}" for k, (x, y, z) in zip(seen.scan_id, seen.points, strict=True))
    (folder / "a.csv").write_text("scan_id,z,x,y\n" + "\n".join(rows))
    return beside(folder / "a.csv", seen)


def ptx(folder: Path, seen: Survey) -> Path:
    (folder / "a.ptx").write_text(
        "".join(scan_text(seen.points[seen.scan_id == k], T) for k, T in enumerate(seen.poses))
    )
    return folder / "a.ptx"


def scan_folder(suffix: str) -> Write:
    def write(folder: Path, seen: Survey) -> Path:
        for k, (local, _) in enumerate(scans(seen)):
            path = folder / f"{k:06d}.{suffix}"
            if suffix == "bin":
                np.column_stack([local, local[:, 0]]).astype("<f4").tofile(path)
            else:
                write_pcd(path, "binary_compressed", xyz_columns(local))
        return beside(folder / "a", seen).parent

    return write


def recording(form: str) -> Write:
    def write(folder: Path, seen: Survey) -> Path:
        def build(m: Messages) -> Iterator[tuple[str, float, Any]]:
            for k, (local, T) in enumerate(scans(seen)):
                yield "/tf", START + k, m.transform(T, START + k, "map", "lidar")
                yield "/points", START + k, m.cloud(local, START + k, kind="f8")

        return write_recording(folder, form, build)

    return write


def with_poses(write_poses: Callable[[Path], object]) -> Write:
    """The PLY, its poses in another form."""

    def write(folder: Path, seen: Survey) -> Path:
        path = write_survey(folder / "a", seen.points, seen.scan_id, seen.poses)
        write_poses(path.parent)
        (path.parent / "trajectory.tum").unlink()
        return path

    return write


def kitti(folder: Path) -> None:
    write_kitti(folder / "trajectory.txt", read_trajectory(folder / "trajectory.tum"))


def euroc(folder: Path) -> None:
    write_euroc(folder / "trajectory.csv", np.loadtxt(folder / "trajectory.tum"))


POSED: dict[str, Write] = {
    "E57": e57,
    "LAS 1.4 with scan_id": las("1.4", 6, joined="scan_id"),
    "LAZ 1.2 joined by time": las("1.2", 1, "laz", "gps_time"),
    "PLY text": lambda d, s: beside(write_ply(d / "a.ply", "ascii", columns(s)), s),
    "PLY big endian, floats": lambda d, s: beside(
        write_ply(d / "a.ply", "binary_big_endian", columns(s, "f4")), s
    ),
    "PCD text": lambda d, s: beside(write_pcd(d / "a.pcd", "ascii", columns(s)), s),
    "PCD binary": lambda d, s: beside(write_pcd(d / "a.pcd", "binary", columns(s)), s),
    "PCD compressed": lambda d, s: beside(write_pcd(d / "a.pcd", "binary_compressed", columns(s, "f4")), s),
    "table with names": table,
    "PTX": ptx,
    "folder of .bin": scan_folder("bin"),
    "folder of .pcd": scan_folder("pcd"),
    "ROS 1 bag": recording("bag"),
    "ROS 2 folder, sqlite": recording("folder_sqlite"),
    "MCAP": recording("mcap"),
    "poses of KITTI": with_poses(kitti),
    "poses of EuRoC": with_poses(euroc),
}


@pytest.mark.parametrize("name", POSED)
def test_with_viewpoints(seen, posed, tmp_path, name):
    assert_same(plan_of(POSED[name](tmp_path, seen)), posed, MILLIMETRE)


MERGED: dict[str, Write] = {
    "LAS 1.2": las("1.2", 3),
    "LAZ 1.4": las("1.4", 7, "laz"),
    "XYZ": text("a.xyz", " "),
    "commas": text("a.csv", ",", head="x,y,z\n"),
    "semicolons and decimal commas": text("a.csv", ";", ",", "Project: a flat\nX [m];Y [m];Z [m]\n"),
    "decimal commas": text("a.txt", "\t", ","),
}


@pytest.mark.parametrize("name", MERGED)
def test_without_viewpoints(seen, merged, tmp_path, name):
    assert_same(plan_of(MERGED[name](tmp_path, seen)), merged, MILLIMETRE)


LAS_FORMS = [("1.2", f) for f in range(4)] + [("1.3", f) for f in (4, 5)] + [("1.4", f) for f in range(6, 11)]


@pytest.mark.parametrize("suffix", ["las", "laz"])
@pytest.mark.parametrize(("version", "form"), LAS_FORMS)
def test_every_point_format_of_las_holds_the_same_points(tmp_path, suffix, version, form):
    """And so gives the same plan; those with waveforms, too."""
    few = survey(BOXES, PLACES[:1], rays=(40, 10))
    points, _ = whole(opened(las(version, form, suffix)(tmp_path, few)))
    np.testing.assert_allclose(points, few.points, atol=6e-5)


BEAMS = -np.pi / 2 + np.arange(361) * np.pi / 360


def planar_poses() -> np.ndarray:
    """(N, 4, 4): a planar laser that turns around at every place."""
    poses = np.tile(np.eye(4), (4 * len(PLACES), 1, 1))
    turns = Rotation.from_euler("z", np.arange(4)[:, None] * 90.0, degrees=True).as_matrix()
    poses[:, :3, :3] = np.tile(turns, (len(PLACES), 1, 1))
    poses[:, :2, 3] = np.repeat(np.array(PLACES)[:, :2], 4, axis=0)
    return poses


def ranges(T: np.ndarray) -> np.ndarray:
    """What the laser measures at a pose whose height is that of its plane."""
    around = np.column_stack([np.cos(BEAMS), np.sin(BEAMS), 0 * BEAMS]) @ T[:3, :3].T
    return cast(BOXES, T[:3, 3] + [0, 0, EYE], around).round(6)


def flaser(T: np.ndarray, k: int) -> str:
    words = " ".join(f"{r:.6f}" for r in ranges(T))
    x, y, yaw = *T[:2, 3], np.arctan2(T[1, 0], T[0, 0])
    return f"FLASER {len(BEAMS)} {words} {x:.9f} {y:.9f} {yaw:.9f} 0 0 0 {k}.5 robot {k}\n"


def laser_scans(m: Messages) -> Iterator[tuple[str, float, Any]]:
    for k, T in enumerate(planar_poses()):
        step, none = float(BEAMS[1] - BEAMS[0]), np.zeros(0, np.float32)
        yield "/odom", START + k, m.odometry(T, START + k, "odom", "laser")
        yield (
            "/scan",
            START + k,
            m.t["sensor_msgs/msg/LaserScan"](
                *(m.header(START + k, "laser"), float(BEAMS[0]), float(BEAMS[-1]), step, 0.0, 0.1, 0.1, 30.0),
                *(ranges(T).astype(np.float32), none),
            ),
        )


@pytest.fixture(scope="module")
def planar(tmp_path_factory) -> FloorPlan:
    poses = planar_poses()
    around = np.column_stack([np.cos(BEAMS), np.sin(BEAMS), 0 * BEAMS])
    points = [(ranges(T)[:, None] * around) @ T[:3, :3].T + T[:3, 3] for T in poses]
    ids = np.repeat(np.arange(len(poses)), len(BEAMS))
    path = write_survey(tmp_path_factory.mktemp("planar"), np.concatenate(points), ids, poses)
    plan = process(opened(path))
    assert len(plan.regions) == 2
    return plan


def test_a_log_of_carmen(planar, tmp_path):
    """Which does not say what stands for no return: the longest reading is left out."""
    (tmp_path / "a.log").write_text("".join(flaser(T, k) for k, T in enumerate(planar_poses())))
    assert_same(process(opened(tmp_path / "a.log")), planar, 2 * MILLIMETRE)


@pytest.mark.parametrize("form", ["bag", "mcap"])
def test_planar_scans_of_a_recording(planar, tmp_path, form):
    assert_same(process(opened(write_recording(tmp_path, form, laser_scans))), planar, MILLIMETRE)


def test_depth_images_of_a_recording(tmp_path):
    """Those of the folder in the form of TUM: both hold whole fractions of a millimetre."""

    def build(m: Messages) -> Iterator[tuple[str, float, Any]]:
        depth = DepthMessages(m)
        yield "/camera/depth/camera_info", START - 1.0, depth.info(START - 1.0)
        for k, T in enumerate(camera_walk()):
            yield "/tf", START + k, m.transform(T, START + k, "map", "optical")
            yield "/camera/depth/image_raw", START + k, depth.image(box_depth(T), START + k, "16UC1")

    rays, poses = test_rgbd.pixel_rays().reshape(-1, 3), camera_walk()
    local = [rays * box_depth(T).round(3).reshape(-1, 1) for T in poses]
    points = np.concatenate([p @ T[:3, :3].T + T[:3, 3] for p, T in zip(local, poses, strict=True)])
    ids = np.repeat(np.arange(len(poses)), len(rays))
    ply = plan_of(write_survey(tmp_path / "ply", points, ids, poses))
    assert_same(plan_of(write_recording(tmp_path, "mcap", build)), ply, 2 * MILLIMETRE)

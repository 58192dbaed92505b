"""Several lidars or cameras in one ROS recording: all that transforms join are one survey."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from floorplan_core.model import Trajectory
from floorplan_core.pipeline import process
from floorplan_core.replay import intervals, path_lengths
from floorplan_core.simulation.files import tum_bytes
from tests.box_world import LINTEL, stations, survey, two_rooms
from tests.plugins.plugin_files import opened, refusal, whole
from tests.plugins.test_rgbd import COUNT, camera_poses, render
from tests.plugins.test_rosbag import START, Messages, write_recording
from tests.plugins.test_rosbag_depth import DepthMessages, farthest_from_walls
from tests.readers.reader_clouds import Remembering, write_ply, xyz_columns

BOXES = two_rooms((2.0, 2.9, LINTEL))
PLACES = [*stations(4, 5), *stations(4, 5, x0=4.1), (3.9, 2.4, 1.4), (4.3, 2.4, 1.4)]
STEP = 0.5  # s


def mounted(x: float, degrees: float) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3] = Rotation.from_euler("z", degrees, degrees=True).as_matrix()
    T[0, 3] = x
    return T


MOUNTS = {"front": mounted(0.25, 0.0), "rear": mounted(-0.25, 180.0)}


def robots() -> np.ndarray:
    """(S, 4, 4) of the robot at each place; it looks another way at each."""
    turned = [mounted(0.0, 40.0 * k) for k in range(len(PLACES))]
    for T, place in zip(turned, PLACES, strict=True):
        T[:3, 3] = place
    return np.array(turned)


@pytest.fixture(scope="module")
def seen() -> dict[str, list[np.ndarray]]:
    """What each lidar saw before it from each place, in its own frame; half of the world each."""
    scans = {}
    for seed, (name, mount) in enumerate(MOUNTS.items()):
        poses = robots() @ mount
        made = survey(BOXES, poses[:, :3, 3], rays=(200, 60), seed=seed)
        parts = [made.points[made.scan_id == k] for k in range(len(PLACES))]
        local = [(p - T[:3, 3]) @ T[:3, :3] for p, T in zip(parts, poses, strict=True)]
        scans[name] = [p[p[:, 0] > 0] for p in local]
    return scans


def recorded(seen, how="transforms", late=0.1, joined=True):
    """The messages: the rear lidar tells ``late`` seconds after the front one, while the robot stands."""

    def build(m: Messages):
        for name, mount in MOUNTS.items():
            if joined or name == "front":
                yield "/tf_static", START - 1.0, m.transform(mount, START - 1.0, "base_link", name)
        for k, T in enumerate(robots()):
            at = START + STEP * k
            for when in (at, at + late):
                if how == "transforms":
                    yield "/tf", when, m.transform(T, when, "odom", "base_link")
                elif how == "odometry":
                    yield "/odom", when, m.odometry(T, when, "odom", "base_link")
            yield "/front/points", at, m.cloud(seen["front"][k], at, "front")
            yield "/rear/points", at + late, m.cloud(seen["rear"][k], at + late, "rear")

    return build


def together(seen) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(points, ids, poses) of both lidars, front and rear in turns."""
    poses = np.stack([robots() @ MOUNTS["front"], robots() @ MOUNTS["rear"]], axis=1).reshape(-1, 4, 4)
    scans = [seen[name][k] for k in range(len(PLACES)) for name in MOUNTS]
    points = [s @ T[:3, :3].T + T[:3, 3] for s, T in zip(scans, poses, strict=True)]
    return np.concatenate(points), np.repeat(np.arange(len(scans)), [len(s) for s in scans]), poses


@pytest.mark.parametrize("form", ["bag", "folder_sqlite", "mcap", "db3"])
@pytest.mark.parametrize("how", ["transforms", "odometry"])
def test_lidars_that_look_opposite_ways_are_one_survey(tmp_path, seen, form, how):
    found = opened(write_recording(tmp_path, form, recorded(seen, how)))
    points, ids = whole(found)
    wanted, wanted_ids, poses = together(seen)
    np.testing.assert_allclose(points, wanted, atol=1e-4)
    np.testing.assert_array_equal(ids, wanted_ids)
    np.testing.assert_allclose(found.trajectory.T_world_sensor, poses, atol=1e-6)
    np.testing.assert_array_equal(found.trajectory.sensor, [0, 1] * len(PLACES))
    assert found.scans == 2 * len(PLACES)
    for name in MOUNTS:
        assert f"/{name}/points: {len(PLACES)} PointCloud2, read" in found.topics
        assert any(
            f"PointCloud2 messages of the topic /{name}/points are read" in a for a in found.assumptions
        )
    assert not any("Not read" in a for a in found.assumptions)


@pytest.mark.parametrize("form", ["bag", "mcap", "db3"])
def test_lidars_that_tell_at_the_same_moment(tmp_path, seen, form):
    points, ids = whole(opened(write_recording(tmp_path, form, recorded(seen, late=0.0))))
    assert (np.diff(ids) >= 0).all()
    np.testing.assert_allclose(points, together(seen)[0], atol=1e-4)


def test_the_plan_is_that_of_all_points_together(tmp_path, seen):
    points, ids, poses = together(seen)
    (tmp_path / "trajectory.tum").write_bytes(tum_bytes(np.arange(len(poses), dtype=float), poses))
    columns = xyz_columns(points, "f8", scan_id=ids.astype("i4"))
    cloud = process(opened(write_ply(tmp_path / "points.ply", "binary_little_endian", columns)))
    robot = process(opened(write_recording(tmp_path, "bag", recorded(seen))))
    assert len(robot.regions) == 2 and len(robot.doors) == 1
    for one, two in zip(cloud.regions, robot.regions, strict=True):
        assert one.polygon.hausdorff_distance(two.polygon) < 2e-3
    assert robot.doors[0].width == pytest.approx(cloud.doors[0].width, abs=2e-3)


def test_a_given_trajectory_is_of_the_first_lidar(tmp_path, seen):
    """Static transforms take it to the other, whose scans come between its rows."""

    def build(m: Messages):
        for name, mount in MOUNTS.items():
            yield "/tf_static", START - 1.0, m.transform(mount, START - 1.0, "base_link", name)
        for k in range(len(PLACES)):
            yield "/front/points", START + STEP * k, m.cloud(seen["front"][k], START + STEP * k, "front")
            at = START + STEP * k + 0.05
            yield "/rear/points", at, m.cloud(seen["rear"][k], at, "rear")

    path = write_recording(tmp_path, "bag", build)
    rows = np.repeat(robots() @ MOUNTS["front"], 2, axis=0)
    stamps = START + (STEP * np.arange(len(PLACES))[:, None] + [0.0, 0.06]).ravel()
    (tmp_path / "t.tum").write_bytes(tum_bytes(stamps, rows))
    points, _ = whole(opened(path, trajectory=tmp_path / "t.tum"))
    np.testing.assert_allclose(points, together(seen)[0], atol=1e-3)


def test_one_topic_can_be_asked_for_and_several_in_an_order(tmp_path, seen):
    path = write_recording(tmp_path, "mcap", recorded(seen))
    alone = opened(path, topic="/rear/points", unit="m", up="z")
    assert alone.trajectory.sensor is None and alone.scans == len(PLACES)
    assert "/front/points: 10 PointCloud2" in alone.topics
    both = opened(path, topic="/rear/points, /front/points", unit="m", up="z")
    np.testing.assert_allclose(whole(both)[0], together(seen)[0], atol=1e-4)
    assert "on the topic '/none'" in refusal(path, topic="/rear/points,/none", unit="m", up="z")


def test_a_lidar_that_nothing_joins_is_named_and_not_read(tmp_path, seen):
    path = write_recording(tmp_path, "bag", recorded(seen, joined=False))
    found = opened(path)
    assert found.scans == len(PLACES) and found.trajectory.sensor is None
    (note,) = [a for a in found.assumptions if "Not read" in a]
    assert "/rear/points (no transform joins its frame rear to front)" in note
    text = refusal(path, topic="/front/points,/rear/points", unit="m", up="z")
    assert "/rear/points" in text and "no transform joins its frame rear to front" in text


def test_the_same_lidar_in_another_form_is_not_read_twice(tmp_path, seen):
    """Filtered in its own frame, put together in the robot's, registered in the world's."""

    def build(m: Messages):
        yield from recorded(seen)(m)
        for k, T in enumerate(robots()):
            at = START + STEP * k
            part = seen["front"][k]
            yield "/z/filtered", at, m.cloud(part[::2], at, "front")
            yield "/z/merged", at, m.cloud(part @ MOUNTS["front"][:3, :3].T, at, "base_link")
            yield "/z/registered", at, m.cloud(part @ T[:3, :3].T + T[:3, 3], at, "odom")

    found = opened(write_recording(tmp_path, "mcap", build))
    np.testing.assert_allclose(whole(found)[0], together(seen)[0], atol=1e-4)
    (note,) = [a for a in found.assumptions if "Not read" in a]
    assert note.count("/z/") == 3


def test_planar_scanners(tmp_path):
    ranges = np.full(300, 2.0)

    def build(m: Messages):
        for name, mount in MOUNTS.items():
            yield "/tf_static", START - 1.0, m.transform(mount, START - 1.0, "base_link", name)
        for k, T in enumerate(robots()):
            yield "/tf", START + k, m.transform(T, START + k, "odom", "base_link")
            for name in MOUNTS:
                yield f"/{name}/scan", START + k, m.scan(ranges, START + k, name)

    found = opened(write_recording(tmp_path, "bag", build))
    points, ids = whole(found)
    assert len(points) == 2 * len(PLACES) * 300
    away = points - found.trajectory.origins[ids]
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), 2.0, atol=1e-4)
    forward = np.einsum("ni,ni->n", away, found.trajectory.T_world_sensor[ids][:, :3, 0])
    assert forward.min() > 0.1  # each sees before itself, so both together all around


def test_the_path_is_that_of_one_of_them(tmp_path, seen):
    """Half a metre from one lidar to the other is no way that the robot drove."""
    found = opened(write_recording(tmp_path, "bag", recorded(seen)))
    alone = found.trajectory.of_main_sensor()
    assert path_lengths(found.trajectory)[-1] == pytest.approx(path_lengths(alone)[-1])
    assert [round(i.path_length, 6) for i in intervals(found, 100.0)] == [round(path_lengths(alone)[-1], 6)]


def test_lengths_of_a_path_do_not_change_when_it_grows():
    rng = np.random.default_rng(5)
    poses = np.tile(np.eye(4), (40, 1, 1))
    poses[:, :3, 3] = rng.normal(size=(40, 3))
    sensor = rng.integers(0, 3, 40).astype(np.int32)
    whole_path = path_lengths(Trajectory(np.arange(40.0), poses, sensor))
    for rows in (1, 2, 7, 39):
        part = Trajectory(np.arange(float(rows)), poses[:rows], sensor[:rows])
        np.testing.assert_array_equal(path_lengths(part), whole_path[:rows])


def test_a_lidar_of_another_time_is_left_out_with_a_warning(tmp_path, seen):
    def build(m: Messages):
        for topic, at, message in recorded(seen, late=0.0)(m):
            if topic == "/rear/points":
                later = m.cloud(seen["rear"][round((at - START) / STEP)], at + 900.0, "rear")
                yield topic, at + 900.0, later
            else:
                yield topic, at, message

    observer = Remembering()
    found = opened(write_recording(tmp_path, "bag", build), observer)
    assert found.scans == len(PLACES)
    assert any("10 of the 10 scans" in text and "/rear/points" in text for text in observer.warnings)


def two_cameras(m: Messages):
    """One looks forward, one back; the images of the first once more, as the colour camera would see them."""
    turned = np.diag([-1.0, 1.0, -1.0, 1.0])  # about the camera's y, which is down
    near = np.eye(4)
    near[0, 3] = 0.015
    yield "/tf_static", START - 1.0, m.transform(turned, START - 1.0, "front", "rear")
    yield "/tf_static", START - 1.0, m.transform(near, START - 1.0, "front", "colour")
    for name in ("front", "rear", "colour"):
        yield f"/{name}/depth/camera_info", START - 1.0, DepthMessages(m, name).info(START - 1.0)
    for k, T in enumerate(camera_poses()):
        at = START + 0.5 * k
        yield "/tf", at, m.transform(T, at, "odom", "front")
        yield "/front/depth/image_raw", at, DepthMessages(m, "front").image(render(T), at, "32FC1")
        yield "/rear/depth/image_raw", at, DepthMessages(m, "rear").image(render(T @ turned), at, "32FC1")
        yield "/colour/depth/image_raw", at, DepthMessages(m, "colour").image(render(T @ near), at, "32FC1")


def test_depth_cameras(tmp_path):
    path = write_recording(tmp_path, "mcap", two_cameras)
    found = opened(path, topic="/front/depth/image_raw,/rear/depth/image_raw", unit="m", up="z")
    points, ids = whole(found)
    assert farthest_from_walls(points + found.local_frame.shift) < 1e-4
    assert len(np.unique(ids)) == 2 * COUNT
    chosen = opened(path)
    assert chosen.scans == 2 * COUNT
    assert any("it sees what" in a for a in chosen.assumptions)

"""ROS recordings: what rosbags writes comes back, placed by transforms, odometry or a given trajectory."""

from __future__ import annotations

import numpy as np
import pytest
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from scipy.spatial.transform import Rotation

from tests.plugins.plugin_files import opened, refusal, survives, whole
from tests.readers.reader_clouds import Remembering, path_in_room, room, write_tum

ROS1, ROS2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_HUMBLE)
ROS1.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
START = 1_700_000_000
SCANS = 12
MOUNT = np.array([0.2, 0.0, 0.6])  # of the lidar on the robot
FORMS = ("bag", "folder_sqlite", "folder_mcap", "mcap", "db3")


class Messages:
    """Makes messages of one ROS."""

    def __init__(self, store):
        self.store, self.t = store, store.types

    def header(self, seconds, frame):
        stamp = self.t["builtin_interfaces/msg/Time"](int(seconds), round((seconds % 1) * 1e9))
        if self.store is ROS1:
            return self.t["std_msgs/msg/Header"](0, stamp, frame)
        return self.t["std_msgs/msg/Header"](stamp, frame)

    def cloud(self, points, seconds, frame="lidar", kind="f4"):
        field, code = self.t["sensor_msgs/msg/PointField"], {"f4": 7, "f8": 8}[kind]
        size = int(kind[1])
        fields = [field(n, size * k, code, 1) for k, n in enumerate("xyz")] + [
            field("intensity", 3 * size, 7, 1)
        ]
        rows = np.zeros(len(points), [("p", "<" + kind, 3), ("i", "<f4")])
        rows["p"] = points
        data, step = np.frombuffer(rows.tobytes(), np.uint8), rows.dtype.itemsize
        return self.t["sensor_msgs/msg/PointCloud2"](
            self.header(seconds, frame), 1, len(points), fields, False, step, step * len(points), data, True
        )

    def scan(self, ranges, seconds, frame="laser"):
        r = np.asarray(ranges, dtype=np.float32)
        return self.t["sensor_msgs/msg/LaserScan"](
            self.header(seconds, frame), -1.5, 1.5, 0.01, 0.0, 0.1, 0.1, 30.0, r, np.zeros(0, np.float32)
        )

    def pose(self, T, wrapped=False):
        q = Rotation.from_matrix(T[:3, :3]).as_quat()
        return self.t["geometry_msgs/msg/Pose"](
            self.t["geometry_msgs/msg/Point"](*T[:3, 3]), self.t["geometry_msgs/msg/Quaternion"](*q)
        )

    def transform(self, T, seconds, parent, child):
        q = Rotation.from_matrix(T[:3, :3]).as_quat()
        inner = self.t["geometry_msgs/msg/Transform"](
            self.t["geometry_msgs/msg/Vector3"](*T[:3, 3]), self.t["geometry_msgs/msg/Quaternion"](*q)
        )
        one = self.t["geometry_msgs/msg/TransformStamped"](self.header(seconds, parent), child, inner)
        return self.t["tf2_msgs/msg/TFMessage"]([one])

    def odometry(self, T, seconds, frame="odom", child="base"):
        zero = self.t["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
        twist = self.t["geometry_msgs/msg/Twist"](zero, zero)
        cov = np.zeros(36)
        return self.t["nav_msgs/msg/Odometry"](
            self.header(seconds, frame),
            child,
            self.t["geometry_msgs/msg/PoseWithCovariance"](self.pose(T), cov),
            self.t["geometry_msgs/msg/TwistWithCovariance"](twist, cov),
        )


def write_recording(folder, form, build):
    """``build(messages)`` gives (topic, seconds, message)."""
    store = ROS1 if form == "bag" else ROS2
    path = folder / ("run.bag" if form == "bag" else "run")
    if form == "bag":
        writer = Writer1(path)
    else:
        mcap = form in ("folder_mcap", "mcap")
        writer = Writer2(
            path, version=9, storage_plugin=StoragePlugin.MCAP if mcap else StoragePlugin.SQLITE3
        )
    connections = {}
    with writer:
        for topic, seconds, message in sorted(build(Messages(store)), key=lambda m: m[1]):
            name = message.__msgtype__
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, name, typestore=store)
            raw = (store.serialize_ros1 if form == "bag" else store.serialize_cdr)(message, name)
            writer.write(connections[topic], round(seconds * 1e9), bytes(raw))
    if form in ("mcap", "db3"):
        (inner,) = path.glob(f"*.{form}")
        return inner.rename(folder / f"alone.{form}")
    return path


def poses():
    """(SCANS, 4, 4) of the lidar along a path in the room."""
    from floorplan_core.readers.trajectory import rotation_from_quaternion

    rows = path_in_room(SCANS)
    T = np.tile(np.eye(4), (SCANS, 1, 1))
    T[:, :3, :3] = rotation_from_quaternion(rows[:, 4:])
    T[:, :3, 3] = rows[:, 1:4]
    return T


def parts(density=10.0):
    return np.array_split(room(np.random.default_rng(4), density=density), SCANS)


def local(points, T):
    return (points - T[:3, 3]) @ T[:3, :3]


def mount():
    T = np.eye(4)
    T[:3, 3] = MOUNT
    return T


def with_transforms(m, kind="f4"):
    yield "/tf_static", START - 1.0, m.transform(mount(), START - 1.0, "base", "lidar")
    for k, (T, part) in enumerate(zip(poses(), parts(), strict=True)):
        at = START + 0.5 * k
        yield "/tf", at, m.transform(T @ np.linalg.inv(mount()), at, "odom", "base")
        yield "/points", at, m.cloud(local(part, T), at, kind=kind)
        yield "/other", at, m.scan([1.0, 2.0], at)


def with_odometry(m):
    yield "/tf_static", START - 1.0, m.transform(mount(), START - 1.0, "base", "lidar")
    for k, (T, part) in enumerate(zip(poses(), parts(), strict=True)):
        at = START + 0.5 * k
        yield "/odom", at, m.odometry(T @ np.linalg.inv(mount()), at)
        yield "/points", at, m.cloud(local(part, T), at)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("build", [with_transforms, with_odometry])
def test_clouds_are_placed(tmp_path, form, build):
    survey = opened(write_recording(tmp_path, form, build))
    points, ids = whole(survey)
    assert survey.format == "ROS bag"
    np.testing.assert_allclose(points, np.concatenate(parts()), atol=1e-4)
    np.testing.assert_array_equal(ids, np.repeat(np.arange(SCANS), [len(p) for p in parts()]))
    np.testing.assert_allclose(survey.trajectory.origins, poses()[:, :3, 3], atol=1e-6)
    np.testing.assert_allclose(survey.trajectory.stamps, START + 0.5 * np.arange(SCANS))


def test_doubles(tmp_path):
    path = write_recording(tmp_path, "bag", lambda m: with_transforms(m, "f8"))
    np.testing.assert_allclose(whole(opened(path))[0], np.concatenate(parts()), atol=1e-4)


def test_poses_between_transforms(tmp_path):
    """Transforms come at other times than scans: halfway on a straight line is halfway."""

    def build(m):
        for k in range(SCANS + 1):
            T = np.eye(4)
            T[:3, 3] = 1.0 + 0.5 * k, 2.5, 1.2
            yield "/tf", START + k, m.transform(T, START + k, "map", "lidar")
        for k, part in enumerate(parts()):
            yield "/points", START + k + 0.5, m.cloud(part - [1.25 + 0.5 * k, 2.5, 1.2], START + k + 0.5)

    points, _ = whole(opened(write_recording(tmp_path, "mcap", build)))
    np.testing.assert_allclose(points, np.concatenate(parts()), atol=1e-4)


def test_registered_clouds_with_odometry(tmp_path):
    """Points in the world already: odometry gives the viewpoints only."""

    def build(m):
        for k, (T, part) in enumerate(zip(poses(), parts(), strict=True)):
            yield "/odom", START + k, m.odometry(T, START + k, "map", "base")
            yield "/registered", START + k, m.cloud(part, START + k, "map")

    survey = opened(write_recording(tmp_path, "folder_mcap", build))
    points, ids = whole(survey)
    np.testing.assert_allclose(points, np.concatenate(parts()), atol=1e-4)
    np.testing.assert_allclose(survey.trajectory.origins, poses()[:, :3, 3], atol=1e-6)
    assert ids.max() == SCANS - 1


def test_planar_scans(tmp_path):
    ranges = np.full(300, 2.0)
    ranges[10:20] = np.inf

    def build(m):
        for k, T in enumerate(poses()):
            yield "/odom", START + k, m.odometry(T, START + k, "odom", "laser")
            yield "/scan", START + k, m.scan(ranges, START + k)

    survey = opened(write_recording(tmp_path, "bag", build))
    points, ids = whole(survey)
    assert len(points) == SCANS * 290
    away = np.linalg.norm(points - survey.trajectory.origins[ids], axis=1)
    np.testing.assert_allclose(away, 2.0, atol=1e-4)


def clouds_only(m):
    for k, (T, part) in enumerate(zip(poses(), parts(), strict=True)):
        yield "/points", START + 0.5 * k, m.cloud(local(part, T), START + 0.5 * k)


def test_a_given_trajectory(tmp_path):
    path = write_recording(tmp_path, "bag", clouds_only)
    assert "no poses for the 12 scans in the frame 'lidar'" in refusal(path)
    rows = path_in_room(SCANS)
    rows[:, 0] += START
    file = tmp_path / "t.tum"
    file.write_text("\n".join(" ".join(f"{v:.12g}" for v in row) for row in rows[:-3]))
    observer = Remembering()
    points, _ = whole(opened(path, observer, file))
    np.testing.assert_allclose(points, np.concatenate(parts()[:-3]), atol=1e-3)
    assert any("3 of the 12 scans" in text for text in observer.warnings)
    write_tum(file, path_in_room(SCANS))
    with pytest.raises(Exception, match="another time"):
        opened(path, trajectory=file)


def test_topics_are_listed(tmp_path):
    def build(m):
        yield "/odom", START, m.odometry(np.eye(4), START)

    assert "its topics: /odom (Odometry)" in refusal(write_recording(tmp_path, "bag", build))


def test_another_topic_can_be_chosen(tmp_path):
    def build(m):
        yield from with_transforms(m)
        yield "/second", START, m.cloud(local(parts()[0], poses()[0]), START)

    path = write_recording(tmp_path, "mcap", build)
    survey = opened(path, topic="/second", unit="m", up="z")
    np.testing.assert_allclose(whole(survey)[0], parts()[0], atol=1e-3)
    assert any("/second" in text for text in survey.assumptions)
    assert "/points: 12 PointCloud2" in survey.topics
    assert "on the topic '/tf'" in refusal(path, topic="/tf", unit="m", up="z")


def with_a_mount_sent_again_and_again(m):
    """As ROS 1's static_transform_publisher does; where the robot is, only the odometry topic knows."""
    for k, (T, part) in enumerate(zip(poses(), parts(), strict=True)):
        at = START + 0.5 * k
        yield "/tf", at, m.transform(mount(), at, "base", "lidar")
        yield "/odom", at, m.odometry(T @ np.linalg.inv(mount()), at)
        yield "/points", at, m.cloud(local(part, T), at)


def test_a_mount_that_is_sent_again_and_again_moves_nothing(tmp_path):
    survey = opened(write_recording(tmp_path, "bag", with_a_mount_sent_again_and_again))
    assert "The topic /odom places the scans." in survey.assumptions
    moved = survey.trajectory.origins + survey.local_frame.shift
    np.testing.assert_allclose(moved, poses()[:, :3, 3], atol=1e-6)


def with_two_lidars(m):
    yield from with_transforms(m)
    for k, (T, part) in enumerate(zip(poses(), parts(), strict=True)):
        yield "/rear/points", START + 0.5 * k, m.cloud(local(part, T), START + 0.5 * k)


def test_topics_that_are_not_read_are_named(tmp_path):
    survey = opened(write_recording(tmp_path, "mcap", with_two_lidars))
    assert sum("Not read: /rear/points (its frame lidar is" in note for note in survey.assumptions) == 1
    alone = opened(write_recording(tmp_path, "bag", with_transforms))
    assert not any("Not read" in note for note in alone.assumptions)


@pytest.mark.parametrize(("form", "tool"), [("bag", "rosbag reindex"), ("mcap", "mcap recover")])
def test_a_recording_that_was_cut_off(tmp_path, form, tool):
    path = write_recording(tmp_path, form, with_transforms)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    assert refusal(path).endswith(f"; {tool} mends one that was cut off.")


@pytest.mark.parametrize("form", ["bag", "mcap", "db3"])
def test_damage(tmp_path, form):
    def build(m):
        for k, (T, part) in enumerate(zip(poses(), parts(2.0), strict=True)):
            yield "/odom", START + k, m.odometry(T, START + k, "odom", "lidar")
            yield "/points", START + k, m.cloud(local(part, T), START + k)

    assert survives(write_recording(tmp_path, form, build), tmp_path) > 15

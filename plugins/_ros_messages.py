"""Points and poses out of ROS messages, as rosbags deserialises them (ROS 1 and ROS 2 alike)."""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.api import rotation_from_quaternion

Float = NDArray[np.float64]
Pose = tuple[float, float, float, float, float, float, float]  # position, quaternion x y z w (of any length)

CLOUD, SCAN = "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/LaserScan"
ODOMETRY, POSE, TRANSFORM, TF = (
    "nav_msgs/msg/Odometry",
    "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/TransformStamped",
    "tf2_msgs/msg/TFMessage",
)
TF_OLD = "tf/msg/tfMessage"
TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}  # of sensor_msgs/PointField
MIN_QUATERNION = 1e-6


def seconds_of(stamp: Any) -> float:
    """Seconds of a ROS time."""
    return float(stamp.sec) + 1e-9 * float(stamp.nanosec)


def header_of(raw: bytes, ros2: bool) -> tuple[float, str]:
    """(seconds, frame) of a message that begins with a header, without reading the rest of it."""
    if ros2:
        order = "<" if raw[1] & 1 else ">"
        sec, nsec, length = struct.unpack_from(order + "iII", raw, 4)
        name = raw[16 : 16 + length]
    else:
        _, sec, nsec, length = struct.unpack_from("<IIII", raw, 0)
        name = raw[16 : 16 + length]
    if len(name) != length:
        raise ValueError("the header of a message is longer than the message")
    return sec + 1e-9 * nsec, clean_frame(name.rstrip(b"\x00").decode("utf-8", "replace"))


def clean_frame(name: str) -> str:
    """A frame's name; ROS 1 wrote a slash before some."""
    return str(name).lstrip("/")


def points_of(message: Any, msgtype: str) -> NDArray[Any]:
    """(N, 3) finite points of a cloud or planar scan, in the sensor's frame; ValueError where damaged."""
    points = cloud_points(message) if msgtype == CLOUD else scan_points(message)
    with np.errstate(invalid="ignore"):
        if len(points) and np.isfinite(points.min()) and np.isfinite(points.max()):  # both are NaN if any is
            return points
        x, y, z = np.isfinite(points).T
        finite: NDArray[Any] = points[x & y & z]
        return finite


def cloud_points(message: Any) -> NDArray[Any]:
    """(N, 3) points of a PointCloud2, float32 or float64 as it has them."""
    order = ">" if message.is_bigendian else "<"
    fields = {field.name.lower(): field for field in message.fields}
    step, width, height = int(message.point_step), int(message.width), int(message.height)
    row = int(message.row_step) or step * width
    if any(name not in fields or fields[name].datatype not in TYPES for name in "xyz"):
        raise ValueError(f"a cloud has no x, y and z, but {', '.join(fields) or 'nothing'}")
    data = np.frombuffer(np.ascontiguousarray(message.data, dtype=np.uint8), np.uint8)
    if step <= 0 or row < step * width or row * height > len(data):
        raise ValueError(f"a cloud of {width} x {height} points does not fit its {len(data)} bytes")
    kinds = [order + TYPES[fields[name].datatype] for name in "xyz"]
    offsets = [int(fields[name].offset) for name in "xyz"]
    dtype = np.dtype({"names": list("xyz"), "formats": kinds, "offsets": offsets, "itemsize": step})
    records = np.ndarray((height, width), dtype, data, strides=(row, step))
    points = np.empty((height, width, 3), np.float32 if all(k.endswith("f4") for k in kinds) else np.float64)
    for axis, name in enumerate("xyz"):
        points[..., axis] = records[name]
    return points.reshape(-1, 3)


def scan_points(message: Any) -> Float:
    """(N, 3) end points of a LaserScan, in its plane."""
    ranges = np.asarray(message.ranges, dtype=np.float64)
    angles = float(message.angle_min) + float(message.angle_increment) * np.arange(len(ranges))
    with np.errstate(invalid="ignore"):
        good = (ranges >= message.range_min) & (ranges < message.range_max)
    ranges, angles = ranges[good], angles[good]
    return np.column_stack([ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(len(ranges))])


def pose_of(position: Any, rotation: Any) -> Pose:
    """A ROS position (or translation) and quaternion; :class:`ValueError` where that is no pose."""
    pose = position.x, position.y, position.z, rotation.x, rotation.y, rotation.z, rotation.w
    if not (all(map(math.isfinite, pose)) and math.hypot(*pose[3:]) > MIN_QUATERNION):
        raise ValueError("a pose is no rotation with a finite position")
    return pose


def matrices(poses: Sequence[Pose]) -> Float:
    """(N, 4, 4) of poses, all at once: robots tell a hundred a second."""
    rows = np.array(poses, dtype=np.float64).reshape(-1, 7)
    T, q = np.tile(np.eye(4), (len(rows), 1, 1)), rows[:, 3:]
    T[:, :3, :3] = rotation_from_quaternion(q / np.linalg.norm(q, axis=1, keepdims=True))
    T[:, :3, 3] = rows[:, :3]
    return T

"""Depth images in ROS recordings: which topics hold them, their camera, and their points.

Raw images (16UC1 in millimetres, 32FC1 in metres, ``REP 118``) and the PNG form of ``compressed_depth``.
"""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins._depth_images import (
    MAX_PIXELS,
    PNG,
    POINTS_OF_IMAGE,
    Camera,
    back_project,
    decode_depth,
)
from floorplan_core.api import InputError

Float = NDArray[np.float64]
IMAGE, COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
INFO = "sensor_msgs/msg/CameraInfo"
DEPTHS = {"16uc1": "u2", "mono16": "u2", "32fc1": "f4"}  # encodings of depth
MILLIMETRES = 1000.0  # in a metre
CONFIG = 12  # bytes before the PNG of compressed_depth: form and two numbers of the quantisation


def depth_topics(reader: Any) -> dict[str, str]:
    """Topic -> type of the topics whose first message is a depth image."""
    found: dict[str, str] = {}
    for connection in reader.connections:
        if (
            connection.msgtype in (IMAGE, COMPRESSED)
            and connection.msgcount
            and connection.topic not in found
        ):
            message = _first(reader, connection)
            if message is not None and is_depth(message, connection.msgtype):
                found[connection.topic] = connection.msgtype
    return found


def is_depth(message: Any, msgtype: str) -> bool:
    """True for what :func:`depth_points` reads; colour images and rectified greys are none."""
    if msgtype == COMPRESSED:
        return "compresseddepth" in str(message.format).lower()
    return str(message.encoding).lower() in DEPTHS


def camera_of(name: str, reader: Any, topic: str) -> Camera:
    """The intrinsics stated in the namespace of ``topic``; :class:`InputError` where there are none."""
    infos = {c.topic: c for c in reversed(reader.connections) if c.msgtype == INFO and c.msgcount}
    parts = topic.split("/")
    for length in range(len(parts) - 1, 0, -1):  # /a/depth/image_raw/compressedDepth: /a/depth, then /a
        connection = infos.get("/".join([*parts[:length], "camera_info"]))
        message = None if connection is None else _first(reader, connection)
        if message is not None:
            return _camera(name, connection.topic, message)
    raise InputError(
        f"{name} holds the depth images {topic} but no camera_info beside them, so their geometry is not "
        f"known; camera_info topics: {', '.join(sorted(infos)) or 'none'}."
    )


def _first(reader: Any, connection: Any) -> Any:
    for _, _, raw in reader.messages([connection]):
        return reader.deserialize(raw, connection.msgtype)
    return None


def _camera(name: str, topic: str, message: Any) -> Camera:
    k = np.asarray(getattr(message, "k", getattr(message, "K", ())), dtype=np.float64)
    if len(k) != 9 or not np.isfinite(k).all() or k[0] <= 0 or k[4] <= 0:
        raise InputError(f"The intrinsics on {topic} of {name} are none (fx and fy must be positive).")
    return Camera(*(float(v) for v in (k[0], k[4], k[2], k[5])), float(message.width), topic)


def depth_points(message: Any, msgtype: str, camera: Camera) -> Float:
    """(N, 3) points in the optical frame; :class:`ValueError` or :class:`InputError` where damaged."""
    metres = _unpacked(message) if msgtype == COMPRESSED else _raw(message)
    return back_project(metres, camera, 1.0, POINTS_OF_IMAGE)


def _raw(message: Any) -> NDArray[Any]:
    """(h, w) metres of an Image."""
    kind = DEPTHS[str(message.encoding).lower()]
    height, width, step = int(message.height), int(message.width), int(message.step)
    dtype = np.dtype((">" if message.is_bigendian else "<") + kind)
    data = np.frombuffer(np.ascontiguousarray(message.data, dtype=np.uint8), np.uint8)
    row = width * dtype.itemsize
    if not 0 < width * height <= MAX_PIXELS or step < row or step * height > len(data):
        raise ValueError(f"a depth image of {width} x {height} does not fit its {len(data)} bytes")
    pixels = np.ascontiguousarray(data[: step * height].reshape(height, step)[:, :row]).view(dtype)
    if kind == "u2":
        return pixels / MILLIMETRES
    return np.where(np.isfinite(pixels), pixels, 0.0)


def _unpacked(message: Any) -> NDArray[Any]:
    """(h, w) metres of a compressed_depth message: PNG of millimetres, or of quantised inverse depth."""
    data = bytes(np.asarray(message.data, dtype=np.uint8))
    if not data[CONFIG:].startswith(PNG):
        raise InputError(
            f"A depth image has the form {str(message.format)!r}; of compressed ones only PNG is read: "
            "republish the images uncompressed."
        )
    pixels = decode_depth(data[CONFIG:], str(message.format))
    if "32fc1" not in str(message.format).lower():
        return pixels / MILLIMETRES
    a, b = struct.unpack_from("<ff", data, 4)
    with np.errstate(divide="ignore", invalid="ignore"):
        metres = a / (pixels.astype(np.float64) - b)
    return np.where((pixels > 0) & np.isfinite(metres), metres, 0.0)

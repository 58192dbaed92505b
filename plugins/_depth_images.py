"""Depth images of a pinhole camera: decoding and points, for folders of images and recordings alike."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.api import InputError, import_library

Float = NDArray[np.float64]
MAX_PIXELS = 1 << 24  # of an image: four times the largest depth camera
POINTS_OF_IMAGE = 80_000  # about so many pixels of each are used: one a centimetre or two at 3 m
FARTHEST = 10.0  # metres: depth cameras are guessing beyond
MOVED, TURNED = 0.05, 3.0  # metres and degrees: an image nearer to the last one used adds nothing
PNG = b"\x89PNG\r\n\x1a\n"
PNG_HEADER = 33  # bytes up to the end of the size
SPARE = 1024  # bytes that packing may add to an image
PART_FRAME = 12  # bytes of a part of a PNG beside its content: length, name, checksum


@dataclass(frozen=True)
class Camera:
    """A pinhole camera; lengths in pixels."""

    fx: float
    fy: float
    cx: float
    cy: float
    width: float  # of the image that these belong to; 0 where not stated
    name: str  # of the file; "" where assumed


def decode_depth(data: bytes, name: str) -> Any:
    """(h, w) uint16 depth of a PNG; :class:`InputError` where it is no such image."""
    if len(data) < PNG_HEADER or not data.startswith(PNG):
        raise InputError(f"The depth image {name} is no PNG file.")
    width, height = struct.unpack(">II", data[16:24])
    if not 0 < width * height <= MAX_PIXELS:
        raise InputError(f"The depth image {name} claims {width} x {height} pixels; it is damaged.")
    if not _is_whole(data, 8 * width * height + height + SPARE):
        raise InputError(f"The depth image {name} is damaged.")
    cv2 = import_library("cv2", "opencv-python-headless", "depth images")
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error as error:
        raise InputError(f"The depth image {name} is damaged.") from error
    if image is None:
        raise InputError(f"The depth image {name} is damaged.")
    if image.ndim != 2 or image.dtype != np.uint16:
        raise InputError(
            f"The depth image {name} has {image.dtype} pixels of shape {image.shape}, not depth."
        )
    return image


def _is_whole(data: bytes, most: int) -> bool:
    """Are the checksums of all parts of a PNG right, to its end? The decoder would say on stderr that not.

    :param most: bytes of packed pixels; more would unpack to more than the image holds.
    """
    at, pixels = len(PNG), 0
    while at + PART_FRAME <= len(data):
        (length,) = struct.unpack_from(">I", data, at)
        end = at + PART_FRAME + length
        if end > len(data) or zlib.crc32(data[at + 4 : end - 4]).to_bytes(4) != data[end - 4 : end]:
            return False
        kind = data[at + 4 : at + 8]
        pixels += length * (kind == b"IDAT")
        if kind == b"IEND":
            return pixels <= most
        at = end
    return False


def back_project(depth: Any, camera: Camera, scale: float, count: int) -> Float:
    """(N, 3) points in the camera's frame (x right, y down, z ahead) of about ``count`` pixels."""
    step = max(1, int(np.sqrt(depth.size / count)))
    rows, columns = np.mgrid[step // 2 : depth.shape[0] : step, step // 2 : depth.shape[1] : step]
    z = depth[rows, columns] / scale
    good = (z > 0) & (z <= FARTHEST)
    z, u, v = z[good], columns[good], rows[good]
    fx, fy, cx, cy = fitted(camera, depth.shape[1])
    return np.column_stack([(u - cx) / fx * z, (v - cy) / fy * z, z])


def fitted(camera: Camera, width: int) -> tuple[float, float, float, float]:
    """Intrinsics for an image of another width than they were stated for."""
    factor = width / camera.width if camera.width > 0 else 1.0
    return camera.fx * factor, camera.fy * factor, camera.cx * factor, camera.cy * factor


def moving(poses: Float) -> NDArray[np.intp]:
    """Rows of the (N, 4, 4) poses that moved or turned since the last one that was kept."""
    kept: list[int] = []
    for row, pose in enumerate(poses):
        if not kept or _differs(poses[kept[-1]], pose):
            kept.append(row)
    return np.array(kept, dtype=np.intp)


def _differs(a: Float, b: Float) -> bool:
    if np.linalg.norm(a[:3, 3] - b[:3, 3]) >= MOVED:
        return True
    cosine = (np.trace(a[:3, :3].T @ b[:3, :3]) - 1) / 2
    return bool(np.degrees(np.arccos(np.clip(cosine, -1, 1))) >= TURNED)

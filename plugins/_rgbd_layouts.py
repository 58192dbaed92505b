"""Folders of depth images: TUM, ScanNet-like, 7-Scenes, Open3D and Redwood; each image and its pose."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins._depth_images import Camera
from floorplan_core.api import InputError, Trajectory, is_rigid, nearest_rows, read_trajectory

Float = NDArray[np.float64]

TUM_SCALE, MILLIMETRES = 5000.0, 1000.0  # depth units in a metre
STAMP_TOLERANCE = 0.05  # seconds between an image and its pose: a walker moves half a voxel
STAMPS_FROM = 1e6  # names that are larger numbers with a fraction are times
MAX_TEXT = 256 << 20  # bytes of a file of poses
PRIMESENSE = (
    525.0,
    525.0,
    319.5,
    239.5,
    640.0,
)  # fx fy cx cy of images so wide: what most depth cameras have
TRAJECTORIES = (
    "groundtruth.txt", "trajectory.log", "scene/trajectory.log", "trajectory.json", "traj.txt",
    "trajectory.txt", "trajectory.tum", "poses.txt", "pose.txt",
)  # fmt: skip
INTRINSICS = (
    "intrinsic/intrinsic_depth.txt", "intrinsic_depth.txt", "intrinsics.txt", "intrinsic.txt",
    "camera-intrinsics.txt", "intrinsic.json", "intrinsics.json", "camera_intrinsic.json",
    "camera_primesense.json", "cam_params.json", "camera.json",
)  # fmt: skip


@dataclass(frozen=True)
class Frame:
    """One depth image and the pose that its file gives."""

    path: Path
    seconds: float
    pose: Float  # (4, 4) as written: camera to world or the other way round


@dataclass(frozen=True)
class RgbdFolder:
    """What a folder holds."""

    kind: str  # "TUM", "ScanNet", ...
    frames: tuple[Frame, ...]  # those with a pose, in order
    without_pose: int
    camera: Camera
    scale: float  # depth units in a metre, by the kind of folder
    note: str
    missing: int = 0  # images that a list names and that are not there


def kind_of(folder: Path) -> str:
    """ "TUM", "ScanNet", "7-Scenes", "Redwood", or "" for a folder without depth images and poses."""
    if not folder.is_dir():
        return ""
    depth = folder / "depth"
    if (folder / "depth.txt").is_file() and depth.is_dir():
        return "TUM"
    if next(folder.glob("frame-*.depth.png"), None) and next(folder.glob("frame-*.pose.txt"), None):
        return "7-Scenes"
    if not depth.is_dir() or next(depth.glob("*.png"), None) is None:
        return ""
    return "ScanNet" if (folder / "pose").is_dir() else "Redwood"


def read_folder(folder: Path, given: Path | None) -> RgbdFolder:
    """List the images and their poses; :class:`InputError` where one or the other is missing."""
    kind = kind_of(folder)
    images = _images(folder, kind)
    if not images:
        raise InputError(f"The folder {folder.name} looks like {kind} but holds no depth images.")
    stamps, missing = [_seconds(image, k) for k, image in enumerate(images)], 0
    if kind == "TUM":
        named, seconds = _tum_list(folder)
        there = [image.is_file() for image in named]
        images = [image for image, here in zip(named, there, strict=True) if here]
        stamps = [second for second, here in zip(seconds, there, strict=True) if here]
        missing = len(named) - len(images)
    if given is None and kind in ("ScanNet", "7-Scenes"):
        poses, note = [_pose_beside(image, folder, kind) for image in images], "each has a file with its pose"
    else:
        file = given or _first(folder, TRAJECTORIES)
        if file is None:
            raise InputError(
                f"The folder {folder.name} holds {len(images)} depth images but no trajectory "
                f"({', '.join(TRAJECTORIES[:4])}, …); name one with --trajectory."
            )
        poses, note = _match(folder.name, file, stamps), f"their poses are in {file.name}"
    frames = tuple(
        Frame(image, t, pose)
        for image, t, pose in zip(images, stamps, poses, strict=True)
        if pose is not None
    )
    if not frames:
        raise InputError(f"None of the {len(images)} depth images of {folder.name} has a usable pose.")
    if len({bool(np.linalg.det(frame.pose[:3, :3]) < 0) for frame in frames}) > 1:
        raise InputError(
            f"Some poses of {folder.name} reflect the axes of the camera and some do not: they are damaged."
        )
    scale = TUM_SCALE if kind == "TUM" else MILLIMETRES
    text = f"{folder.name} holds {len(images):,} depth images ({kind}); {note}."
    return RgbdFolder(kind, frames, len(images) - len(frames), read_camera(folder), scale, text, missing)


def read_camera(folder: Path) -> Camera:
    """Intrinsics of the depth camera; those of a PrimeSense where no file states them."""
    file = _first(folder, INTRINSICS)
    if file is None:
        fx, fy, cx, cy, width = PRIMESENSE
        return Camera(fx, fy, cx, cy, width, "")
    text = _text(file)
    numbers = _from_json(file, text) if file.suffix == ".json" else _from_matrix(file, text)
    values = np.array(numbers, dtype=np.float64)
    if not (np.isfinite(values).all() and (values[:4] > 0).all()):
        raise InputError(f"The intrinsics in {file.name} are not four positive numbers (fx, fy, cx, cy).")
    return Camera(*values.tolist(), file.name)


def _from_json(file: Path, text: str) -> list[float]:
    """Open3D's form (a matrix, column by column), or one with fx, fy, cx, cy."""
    try:
        tree = json.loads(text)
        tree = tree.get("camera", tree)
        if "intrinsic_matrix" in tree:
            m = [float(v) for v in tree["intrinsic_matrix"]]
            return [m[0], m[4], m[6], m[7], float(tree.get("width", 0))]
        return [float(tree[k]) for k in ("fx", "fy", "cx", "cy")] + [float(tree.get("w", 0))]
    except (ValueError, KeyError, TypeError, IndexError, AttributeError, RecursionError) as error:
        raise InputError(f"The intrinsics in {file.name} are in no form that is known.") from error


def _from_matrix(file: Path, text: str) -> list[float]:
    values = _floats(text)
    if values is None or len(values) not in (4, 9, 16):
        raise InputError(f"The intrinsics in {file.name} are no 3 x 3 or 4 x 4 matrix.")
    if len(values) == 4:
        return [*values, 0.0]
    side = 3 if len(values) == 9 else 4
    return [values[0], values[side + 1], values[2], values[side + 2], 0.0]


def _images(folder: Path, kind: str) -> list[Path]:
    found = folder.glob("frame-*.depth.png") if kind == "7-Scenes" else (folder / "depth").glob("*.png")
    return sorted((f for f in found if f.is_file()), key=lambda f: (_number(f), f.name))


def _number(file: Path) -> float:
    """The last number in a file's name, by which images are ordered."""
    numbers = re.findall(r"\d+\.\d+|\d+", file.name.removesuffix(".png"))
    return float(numbers[-1]) if numbers else -1.0


def _seconds(image: Path, index: int) -> float:
    """The time in the image's name (TUM, Redwood: frame-time.png), else its place."""
    number = _number(image)
    return number if number >= STAMPS_FROM and "." in image.stem else float(index)


def _tum_list(folder: Path) -> tuple[list[Path], list[float]]:
    """``depth.txt``: a time and a file name on each line."""
    images, stamps = [], []
    for number, line in enumerate(_text(folder / "depth.txt").splitlines(), start=1):
        words = line.split("#", 1)[0].split()
        if not words:
            continue
        values = _floats(words[0])
        if len(words) != 2 or not values or ".." in Path(words[1]).parts or Path(words[1]).is_absolute():
            raise InputError(f"Line {number} of depth.txt is not a time and the name of an image.")
        images.append(folder / words[1])
        stamps.append(values[0])
    if not images:
        raise InputError(f"depth.txt of {folder.name} lists no images.")
    return images, stamps


def _pose_beside(image: Path, folder: Path, kind: str) -> Float | None:
    """The 4 x 4 matrix for one image; None where it is missing or marked as lost (infinite)."""
    file = folder / "pose" / f"{image.stem}.txt"
    if kind == "7-Scenes":
        file = folder / image.name.replace(".depth.png", ".pose.txt")
    if not file.is_file():
        return None
    values = _floats(_text(file))
    return _rigid(values)


def _match(folder: str, file: Path, stamps: list[float]) -> list[Float | None]:
    """The pose of each image: by its number, by its time, or in order where there are as many."""
    if file.suffix == ".log":
        by_number = _redwood_log(file)
        return [by_number.get(k) for k in range(len(stamps))]
    if file.suffix == ".json":
        rows = _open3d_json(file)
    else:
        rows = read_trajectory(file)
        if stamps[0] >= STAMPS_FROM and rows.stamps[0] >= STAMPS_FROM:
            nearest = nearest_rows(np.array(stamps), rows.stamps, STAMP_TOLERANCE)
            return [rows.T_world_sensor[k] if k >= 0 else None for k in nearest.tolist()]
    if len(rows) < len(stamps):
        raise InputError(
            f"The folder {folder} holds {len(stamps)} depth images, the trajectory {file.name} has "
            f"{len(rows)} poses: one for each image is needed."
        )
    return list(rows.T_world_sensor[: len(stamps)])


def _redwood_log(file: Path) -> dict[int, Float]:
    """Five lines a pose: numbers, of which the first is the image's, then four rows of a matrix."""
    lines = [line for line in _text(file).splitlines() if line.strip()]
    poses: dict[int, Float] = {}
    for start in range(0, len(lines) - 4, 5):
        head, values = _floats(lines[start]), _floats(" ".join(lines[start + 1 : start + 5]))
        pose = _rigid(values)
        if not head or pose is None:
            raise InputError(
                f"The pose after line {start + 1} of {file.name} is no rotation with a position."
            )
        poses[int(head[0])] = pose
    if not poses:
        raise InputError(f"The trajectory {file.name} holds no poses.")
    return poses


def _open3d_json(file: Path) -> Trajectory:
    """A PinholeCameraTrajectory: extrinsics, column by column, world to camera."""
    try:
        rows = [p["extrinsic"] for p in json.loads(_text(file))["parameters"]]
        poses = [_rigid(np.array(row, dtype=np.float64).reshape(4, 4).T.ravel().tolist()) for row in rows]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise InputError(f"The trajectory {file.name} is not in the form of Open3D.") from error
    if not poses or any(pose is None for pose in poses):
        raise InputError(f"The trajectory {file.name} holds a pose that is no rotation with a position.")
    return Trajectory(np.arange(len(poses), dtype=np.float64), np.array(poses))


def _rigid(values: list[float] | None) -> Float | None:
    if values is None or len(values) != 16:
        return None
    T = np.array(values).reshape(4, 4)
    return T if bool(is_rigid(T[None], mirrored=None)[0]) else None


def _first(folder: Path, names: tuple[str, ...]) -> Path | None:
    return next((folder / name for name in names if (folder / name).is_file()), None)


def _floats(text: str) -> list[float] | None:
    try:
        return [float(word) for word in text.replace(",", " ").split()]
    except ValueError:
        return None


def _text(file: Path) -> str:
    if file.stat().st_size > MAX_TEXT:
        raise InputError(f"{file.name} is too large for a text of poses ({file.stat().st_size:,} bytes).")
    try:
        return file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{file.name} is not text.") from error

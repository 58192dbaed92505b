"""Folders of depth images with poses: TUM, ScanNet-like, 7-Scenes, Open3D and Redwood (OpenCV).

Whether poses are camera-to-world or world-to-camera, and how many depth units a metre has, is found out by
carrying the surfaces of one image into another: with the right reading they meet.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins._depth_images import (
    FARTHEST,
    POINTS_OF_IMAGE,
    Camera,
    back_project,
    decode_depth,
    fitted,
    moving,
)
from floorcast_plugins._rgbd_layouts import Frame, RgbdFolder, kind_of, read_folder
from floorplan_core.api import (
    EmptyInput,
    InputError,
    Observer,
    PointSource,
    RawChunk,
    Reader,
    ReadOptions,
    Reconstruction,
    ScanIds,
    Trajectory,
    assemble,
    hookimpl,
    spread_sample,
)

Float = NDArray[np.float64]
SAMPLE_IMAGES = 24
PAIRS, PAIR_PIXELS = 12, 4000  # images and pixels that decide how the poses are meant
SCALES = (1000.0, 4000.0, 5000.0, 6553.5)  # depth units in a metre: millimetres, L515, TUM, Replica
CLEARLY = 0.6  # another reading than the usual one must fit by so much better
AGREE = 0.05  # share of the depth within which two images see one surface
APART = (
    3,
    1,
)  # images between the two of a pair: one where a walk turns so fast that three show nothing twice
CHECKED = 0.5  # share of what one image shows that must be where another shows it


Pair = tuple[Frame, Frame, Any, Any]  # two images and the depth in each


@dataclass(frozen=True)
class Reading:
    """How depth and poses are meant."""

    scale: float  # depth units in a metre
    inverted: bool  # poses are world to camera

    def pose(self, frame: Frame) -> Float:
        """(4, 4) camera to world."""
        return np.linalg.inv(frame.pose) if self.inverted else frame.pose


@hookimpl
def floorcast_readers() -> list[Reader]:
    return [RgbdReader()]


class RgbdReader:
    """Recordings of depth cameras."""

    name = "RGB-D folder"
    suffixes: tuple[str, ...] = ()
    description = "Depth images with poses: TUM, ScanNet-like, 7-Scenes, Open3D and Redwood folders"

    def sniff(self, path: Path, head: bytes) -> float:
        """0.85 for a folder with depth images."""
        return 0.85 if not head and kind_of(path) else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the folder; :class:`InputError` where images, poses or intrinsics are missing or damaged."""
        folder = read_folder(path, options.trajectory)
        if folder.without_pose:
            observer.warning(
                f"{folder.without_pose:,} depth images of {path.name} have no pose; they were left out."
            )
        if folder.missing:
            observer.warning(
                f"{folder.missing:,} depth images that {path.name} lists are not there; they were left out."
            )
        camera = folder.camera
        reading, sentence = find_reading(folder, observer)
        frames = moving_frames(folder.frames, reading)
        poses = np.array([reading.pose(frame) for frame in frames])
        seconds = np.maximum.accumulate(np.array([frame.seconds for frame in frames]))
        notes = [folder.note, f"{len(frames):,} images that moved are read.", sentence]
        if not camera.name:
            notes.append("No file states the intrinsics: those of a PrimeSense camera are assumed.")
        source = PointSource(
            path,
            f"{folder.kind} folder",
            partial(_chunks, frames, camera, reading),
            partial(_sample, frames, camera, reading),
            None,
            True,
            ScanIds(0, len(frames) - 1, True),
            Trajectory(seconds, poses),
            tuple(notes),
            unit="m",
        )
        return assemble(source, replace(options, trajectory=None), observer)


def find_reading(folder: RgbdFolder, observer: Observer) -> tuple[Reading, str]:
    """Direction of the poses and scale of the depth under which images agree; the usual one if in doubt."""
    usual = Reading(folder.scale, folder.kind == "Redwood" and _is_extrinsic(folder))
    for apart in APART:
        misfits = _misfits(folder, usual, list(_pairs(folder, apart, observer)))
        best = min(misfits, key=lambda r: misfits[r])
        if misfits[best] <= 1 - CHECKED:
            break
    best = best if misfits[best] < CLEARLY * misfits[usual] else usual
    words = "world-to-camera" if best.inverted else "camera-to-world"
    meant = f"Poses are taken as {words} and {best.scale:g} depth units as a metre"
    if misfits[best] == 1:
        return (
            best,
            f"{meant}, as is usual: no images show so much of the same surfaces that it can be checked.",
        )
    return best, f"{meant}: so {1 - misfits[best]:.0%} of what one image shows is where another shows it."


def _misfits(folder: RgbdFolder, usual: Reading, pairs: list[Pair]) -> dict[Reading, float]:
    """The median :func:`misfit` of the pairs under every reading, the usual one first."""
    scales = dict.fromkeys((folder.scale, *SCALES))
    readings = [usual, *(Reading(s, i) for s in scales for i in (usual.inverted, not usual.inverted))]
    return {r: float(np.median([misfit(*p, folder.camera, r) for p in pairs] or [1.0])) for r in readings}


def _is_extrinsic(folder: RgbdFolder) -> bool:
    return "trajectory.json" in folder.note  # Open3D's own form holds extrinsics


def _pairs(folder: RgbdFolder, apart: int, observer: Observer) -> Iterator[Pair]:
    """Pairs of images that are some centimetres and degrees apart, spread over the run."""
    frames = moving_frames(folder.frames, Reading(folder.scale, False))
    step = max(1, (len(frames) - 1) // PAIRS)
    for k in range(0, len(frames) - apart, step):
        observer.check_cancelled()
        a, b = frames[k], frames[k + apart]
        yield a, b, read_depth(a.path), read_depth(b.path)


def misfit(a: Frame, b: Frame, depth_a: Any, depth_b: Any, camera: Camera, reading: Reading) -> float:
    """Share of the pixels of ``a`` that are not where ``b`` shows a surface; 1 where too few compare."""
    points = back_project(depth_a, camera, reading.scale, PAIR_PIXELS)
    T = np.linalg.inv(reading.pose(b)) @ reading.pose(a)
    moved = points @ T[:3, :3].T + T[:3, 3]
    fx, fy, cx, cy = fitted(camera, depth_b.shape[1])
    ahead = moved[moved[:, 2] > 1e-3]
    u = np.round(ahead[:, 0] / ahead[:, 2] * fx + cx)
    v = np.round(ahead[:, 1] / ahead[:, 2] * fy + cy)
    inside = (u >= 0) & (v >= 0) & (u < depth_b.shape[1]) & (v < depth_b.shape[0])
    seen = depth_b[v[inside].astype(int), u[inside].astype(int)] / reading.scale
    z = ahead[inside, 2][seen > 0]
    if len(z) < len(points) // 10 or len(z) == 0:
        return 1.0
    return float(1.0 - np.mean(np.abs(z - seen[seen > 0]) < AGREE * z))


def moving_frames(frames: tuple[Frame, ...], reading: Reading) -> tuple[Frame, ...]:
    """The frames that moved or turned since the last one that was kept."""
    return tuple(frames[row] for row in moving(np.array([reading.pose(frame) for frame in frames])))


def read_depth(path: Path) -> Any:
    """(h, w) uint16 depth; :class:`InputError` where the file is no such image."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"Cannot read the depth image {path.name}: {error.strerror}.") from error
    return decode_depth(data, path.name)


def _chunks(frames: tuple[Frame, ...], camera: Camera, reading: Reading) -> Iterator[RawChunk]:
    for row, frame in enumerate(frames):
        yield _scan(frame, camera, reading, row)


def _scan(frame: Frame, camera: Camera, reading: Reading, row: int) -> RawChunk:
    points = back_project(read_depth(frame.path), camera, reading.scale, POINTS_OF_IMAGE)
    ids = np.full(len(points), row, dtype=np.int32)
    return RawChunk(points.astype(np.float32), ids, None, reading.pose(frame))


def _sample(frames: tuple[Frame, ...], camera: Camera, reading: Reading) -> RawChunk:
    """Points of images that are spread over the run."""
    rows = np.unique(np.linspace(0, len(frames) - 1, SAMPLE_IMAGES).astype(int)).tolist()
    parts = [_scan(frames[row], camera, reading, row) for row in rows]
    if not any(len(part.points) for part in parts):
        raise EmptyInput(
            f"No depth image from {frames[0].path.name} on holds a depth of up to {FARTHEST:g} m."
        )
    return spread_sample(parts)

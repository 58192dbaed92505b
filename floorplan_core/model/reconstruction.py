"""What a reader hands over: points in chunks, the sensor's path where known, how the axes were read."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


@dataclass(frozen=True)
class Trajectory:
    """The sensor's path. Row ``i`` is the pose of scan ``i``; those of several sensors are mixed in time."""

    stamps: Float  # (M,) seconds, not decreasing
    T_world_sensor: Float  # (M, 4, 4) sensor to local frame (metres, z up)
    sensor: NDArray[np.int32] | None = (
        None  # (M,) of several sensors of one robot, 0 the main one; None: there is one
    )

    def __len__(self) -> int:
        return len(self.stamps)

    @property
    def origins(self) -> Float:
        """(M, 3) sensor positions, local frame, metres."""
        return self.T_world_sensor[:, :3, 3]

    def of_main_sensor(self) -> Trajectory:
        """The rows of the main sensor only: from one sensor to another nothing moves."""
        if self.sensor is None:
            return self
        rows = self.sensor == 0
        return Trajectory(self.stamps[rows], self.T_world_sensor[rows])


@dataclass(frozen=True)
class LocalFrame:
    """How file coordinates became local ones: ``local = rotation @ (scale * file) - shift``.

    ``world`` is ``rotation @ (scale * file)``: the file's own frame in metres with z up. ``local`` is world
    without its large offset, so that float32 keeps millimetres; every export adds ``shift`` back.
    """

    scale: float = 1.0  # metres per file unit
    unit: str = "m"  # "m", "cm", "mm", "ft" or "us-ft"
    up: str = "z"  # the file's up axis: "x", "y", "z", "-x", "-y", "-z"
    rotation: Float = field(
        default_factory=lambda: np.eye(3)
    )  # (3, 3) file axes to z-up axes; det -1: mirrored
    shift: Float = field(default_factory=lambda: np.zeros(3))  # (3,) metres, world = local + shift
    crs: str = (
        ""  # coordinate reference system of the file (WKT or "EPSG:n") as it states it; "" where it does not
    )

    def to_local(self, points: Float) -> Float:
        """(N, 3) file coordinates to (N, 3) local metres."""
        return np.asarray(points, dtype=np.float64) * self.scale @ self.rotation.T - self.shift


@dataclass(frozen=True)
class PointChunk:
    """A part of the points, small enough to hold. All arrays share their first axis."""

    points: NDArray[np.float32] | Float  # (N, 3) metres, local frame
    scan_id: NDArray[np.int32] | None = None  # (N,) row of the trajectory that saw the point, or None
    stamps: Float | None = None  # (N,) seconds, or None
    free: NDArray[np.float32] | Float | None = None  # (M, 3) centres of voxels known to be free, local frame
    free_size: float = 0.0  # metres, side of those voxels; 0 where there are none
    rgb: NDArray[np.uint8] | None = None  # (N, 3), for pictures only; None where the file has no colours
    intensity: NDArray[np.float32] | None = None  # (N,) in the file's own scale, for pictures only; or None


@dataclass(frozen=True)
class Reconstruction:
    """An opened survey. ``chunks()`` starts a new pass over all points; nothing is held between passes."""

    name: str  # file or folder name, without its path
    chunks: Callable[[], Iterator[PointChunk]]
    point_count: int | None = None  # None where only a pass can tell
    trajectory: Trajectory | None = None
    local_frame: LocalFrame = field(default_factory=LocalFrame)
    scans_ordered: bool = False  # True where scan_id never decreases over the pass (a run can be replayed)
    assumptions: tuple[str, ...] = ()  # sentences: what was guessed (unit, up axis, ...) and why
    format: str = ""  # "PLY", "PCD", ...
    scans: int | None = None  # places or moments from which it was seen; None where not known
    topics: tuple[str, ...] = ()  # of a recording: what is in it, "/points: 120 PointCloud2"

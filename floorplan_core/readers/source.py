"""What every format delivers before its axes are known: points in the file's own coordinates.

A format turns a file into a :class:`PointSource`; :mod:`floorplan_core.readers.assemble` turns that into a
:class:`~floorplan_core.model.Reconstruction` (unit, up axis, shift, trajectory). A new format therefore
only has to say how its points are reached.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import Trajectory

Float = NDArray[np.float64]

CHUNK_POINTS = 1 << 20  # points of a chunk: 16 MB, small enough to cancel between, large enough for numpy
SAMPLE_POINTS = 1 << 15  # points from which unit and axes are guessed: a few milliseconds of work
SAMPLE_BLOCKS = 128  # places of a file from which the sample is taken, so that it covers the whole run


class EmptyInput(InputError):
    """The file is what it claims to be and holds no points; a folder of scans goes on to the next."""


@dataclass(frozen=True)
class RawChunk:
    """Points as the file has them. All arrays share their first axis."""

    points: NDArray[Any]  # (N, 3) float32 or float64, file coordinates (or sensor frame, see below)
    scan_id: NDArray[np.int32] | None = None  # (N,) row of the trajectory
    stamps: Float | None = None  # (N,) seconds
    T_file_sensor: Float | None = None  # (4, 4) where the points are in a sensor's frame: its pose
    dropped: int = 0  # records that hold no point (words where numbers should be)
    free: NDArray[Any] | None = None  # (M, 3) centres of voxels that the file says are free, file coordinates
    free_size: float = 0.0  # side of those voxels, file unit
    rgb: NDArray[np.uint8] | None = None  # (N, 3)
    intensity: NDArray[np.float32] | None = None  # (N,) in the file's own scale


@dataclass(frozen=True)
class ScanIds:
    """What a pass over all scan ids showed."""

    lowest: int
    highest: int
    ordered: bool  # never decreasing over the pass


@dataclass(frozen=True)
class PointSource:
    """An opened file. ``chunks()`` starts a new pass; ``sample()`` costs the same at any size of the file."""

    path: Path
    format: str  # "PLY"
    chunks: Callable[[], Iterator[RawChunk]]
    sample: Callable[[], RawChunk]  # at most about SAMPLE_POINTS points, spread over the file
    count: int | None = None  # None where only a pass can tell
    has_scan_id: bool = False
    scan_ids: ScanIds | None = None  # None where not known without a costly pass
    poses: Trajectory | None = None  # sensor poses that the format itself carries, file coordinates
    notes: tuple[str, ...] = ()  # sentences for Reconstruction.assumptions
    unit: str = "auto"  # "m" where the format fixes it; what the user asks for goes before
    up: str = "auto"  # "z" where the format fixes it
    crs: str = ""  # coordinate reference system that the file states
    scans: int | None = None  # that the file holds, where it says so
    topics: tuple[str, ...] = ()  # of a recording: name, number and type of the messages of each

"""The points that the panes show: a bounded, shuffled sample of the survey; any prefix is a fair picture.

Filled by the job's thread while it reads; the main thread reads whole snapshots. No Qt.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import PointChunk

MOST_POINTS = 10_000_000  # 120 MB of coordinates: what the 3D pane still orbits fluently


@dataclass(frozen=True)
class Points:
    """A snapshot; all arrays share their first axis."""

    xyz: NDArray[np.float32]  # (N, 3) metres, local frame
    rgb: NDArray[np.uint8] | None = None  # (N, 3)
    intensity: NDArray[np.float32] | None = None  # (N,) in the file's own scale
    scan: NDArray[np.int32] | None = None  # (N,) row of the trajectory that saw the point

    def rows(self, rows: slice | NDArray[np.int64]) -> Points:
        """Some of the points; what a slice gives shares their memory."""
        return Points(*(None if part is None else part[rows] for part in self._parts()))  # type: ignore[arg-type]

    def copy(self) -> Points:
        """The points with memory of their own."""
        return Points(*(None if part is None else part.copy() for part in self._parts()))  # type: ignore[arg-type]

    def _parts(self) -> tuple[NDArray | None, ...]:
        return self.xyz, self.rgb, self.intensity, self.scan


class Share:
    """Takes every k-th point of a survey, with k doubled whenever more than ``most`` would be kept."""

    def __init__(self, most: int = MOST_POINTS) -> None:
        self.every = 1
        self._most = most
        self._kept = self._skip = 0

    def take(self, chunk: PointChunk) -> Points:
        """The share of the next chunk; after it, what was taken before is to be thinned to :attr:`every`."""
        count = len(chunk.points)
        while self._kept + -(-count // self.every) > self._most:
            self.every *= 2
            self._kept = -(-self._kept // 2)
        rows = slice(self._skip % self.every, None, self.every)
        self._skip = (rows.start - count) % self.every
        colour, intensity, scan = (getattr(chunk, name, None) for name in ("rgb", "intensity", "scan_id"))
        part = Points(
            np.asarray(chunk.points[rows], dtype=np.float32),
            None if colour is None else np.asarray(colour[rows]),
            None if intensity is None else np.asarray(intensity[rows], dtype=np.float32),
            None if scan is None else np.asarray(scan[rows], dtype=np.int32),
        )
        self._kept += len(part.xyz)
        return part


class PointStore:
    """Keeps the share of a survey's points that the panes show."""

    def __init__(self, most: int = MOST_POINTS) -> None:
        self._share = Share(most)
        self._lock = threading.Lock()
        self._chunks: list[Points] = []
        self._kept = 0
        self._every = 1

    def __len__(self) -> int:
        return self._kept

    def add(self, chunk: PointChunk) -> None:
        """Take a share of the chunk's points."""
        part = self._share.take(chunk)
        self.put(part, self._share.every)

    def put(self, part: Points, every: int) -> None:
        """Keep points that are every ``every``-th of their part of the survey, and of the others no more."""
        with self._lock:
            while self._every < every:
                self._thin()
            self._chunks.append(part)
            self._kept += len(part.xyz)

    def snapshot(self) -> Points:
        """All points kept so far, shuffled by a fixed rule (the same survey gives the same order)."""
        with self._lock:
            chunks = list(self._chunks)
        if not chunks:
            return Points(np.zeros((0, 3), dtype=np.float32))
        xyz = np.concatenate([c.xyz for c in chunks])
        order = np.random.default_rng(0).permutation(len(xyz))
        return Points(
            np.take(xyz, order, axis=0),  # three times as fast as indexing, and without the interpreter lock
            _joined([c.rgb for c in chunks], order),
            _joined([c.intensity for c in chunks], order),
            _joined([c.scan for c in chunks], order),
        )

    def _thin(self) -> None:
        self._every *= 2
        self._chunks = [c.rows(slice(None, None, 2)).copy() for c in self._chunks]
        self._kept = sum(len(c.xyz) for c in self._chunks)


def _joined(parts: list[NDArray | None], order: NDArray[np.int64]) -> NDArray | None:
    """The parts end to end in ``order``; None where any of them is missing."""
    present = [p for p in parts if p is not None]
    return np.take(np.concatenate(present), order, axis=0) if len(present) == len(parts) else None

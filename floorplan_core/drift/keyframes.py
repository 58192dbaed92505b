"""Keyframes: stretches of the path short enough that drift within them does not matter, and their points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import PointChunk, Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.replay import path_lengths

Float = NDArray[np.float64]

FARTHEST = 1e6  # m in the local frame: what lies farther, or is no number, was not measured
MOST_POINTS = 30_000  # of a keyframe that are kept: its walls show in a tenth of them


@dataclass(frozen=True)
class Keyframes:
    """The path cut into stretches."""

    of_scan: NDArray[np.intp]  # (M,) keyframe of each row of the trajectory
    first: NDArray[np.intp]  # (K,) row at which each begins
    origin: Float  # (K, 3) sensor position there, local frame
    path: Float  # (K,) metres of path from the start of the run

    def __len__(self) -> int:
        return len(self.first)


def cut_path(trajectory: Trajectory, length: float) -> Keyframes:
    """A new keyframe at the first scan after every ``length`` metres of path."""
    path = path_lengths(trajectory)
    _, first, of_scan = np.unique(np.floor(path / length), return_index=True, return_inverse=True)
    return Keyframes(of_scan, first, trajectory.origins[first], path[first])


class KeptPoints:
    """The points of a stretch of the path, evenly thinned to a bounded number."""

    def __init__(self) -> None:
        self._points: list[Float] = []
        self._scan: list[NDArray[np.int32]] = []
        self._count, self._every = 0, 1

    def add(self, points: Float, scan_id: NDArray[np.int32]) -> None:
        """Take more points (N, 3), local frame, and the rows (N,) of the trajectory that saw them."""
        points, scan_id = points[:: self._every], scan_id[:: self._every]
        self._points.append(points)
        self._scan.append(scan_id)
        self._count += len(points)
        if self._count > 2 * MOST_POINTS:
            points, scan_id = self.all()
            self._points, self._scan = [points[::2]], [scan_id[::2]]
            self._count, self._every = len(self._scan[0]), 2 * self._every

    def all(self) -> tuple[Float, NDArray[np.int32]]:
        """The points (N, 3) and the rows (N,) of the trajectory that saw them."""
        if not self._points:
            return np.zeros((0, 3)), np.zeros(0, dtype=np.int32)
        return np.concatenate(self._points), np.concatenate(self._scan)


def gather(survey: Reconstruction, keyframes: Keyframes, observer: Observer) -> list[Float]:
    """(N, 3) points of each keyframe, local frame, evenly thinned to a bounded number; one pass."""
    kept = [KeptPoints() for _ in range(len(keyframes))]
    for chunk in survey.chunks():
        observer.check_cancelled()
        for k, points, scan_id in by_keyframe(chunk, keyframes):
            kept[k].add(points, scan_id)
    return [part.all()[0] for part in kept]


def by_keyframe(chunk: PointChunk, keyframes: Keyframes) -> Iterator[tuple[int, Float, NDArray[np.int32]]]:
    """(keyframe, its points (N, 3), the rows (N,) that saw them); none where the chunk knows no rows."""
    if chunk.scan_id is None or not len(chunk.points):
        return
    of_point = keyframes.of_scan[chunk.scan_id]
    order = np.argsort(of_point, kind="stable")
    numbers, starts = np.unique(of_point[order], return_index=True)
    for k, rows in zip(numbers, np.split(order, starts[1:]), strict=True):
        points = np.asarray(chunk.points[rows], np.float64)
        good = (np.abs(points) < FARTHEST).all(axis=1)
        yield int(k), points[good], chunk.scan_id[rows][good]

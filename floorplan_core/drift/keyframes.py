"""Keyframes: stretches of the path short enough that drift within them does not matter, and their points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import PointChunk, Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.replay import path_lengths

Float = NDArray[np.float64]

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


def gather(survey: Reconstruction, keyframes: Keyframes, observer: Observer) -> list[Float]:
    """(N, 3) points of each keyframe, local frame, evenly thinned to a bounded number; one pass."""
    kept: list[list[Float]] = [[] for _ in range(len(keyframes))]
    count = np.zeros(len(keyframes), dtype=np.int64)
    every = np.ones(len(keyframes), dtype=np.int64)
    for chunk in survey.chunks():
        observer.check_cancelled()
        for k, points in _by_keyframe(chunk, keyframes):
            part = points[:: every[k]]
            kept[k].append(part)
            count[k] += len(part)
            if count[k] > 2 * MOST_POINTS:
                thinned = np.concatenate(kept[k])[::2]
                kept[k], count[k], every[k] = [thinned], len(thinned), 2 * every[k]
    return [np.concatenate(parts) if parts else np.zeros((0, 3)) for parts in kept]


def _by_keyframe(chunk: PointChunk, keyframes: Keyframes) -> list[tuple[int, Float]]:
    if chunk.scan_id is None or not len(chunk.points):
        return []
    of_point = keyframes.of_scan[chunk.scan_id]
    order = np.argsort(of_point, kind="stable")
    numbers, starts = np.unique(of_point[order], return_index=True)
    groups = np.split(order, starts[1:])
    return [(int(k), np.asarray(chunk.points[g], np.float64)) for k, g in zip(numbers, groups, strict=True)]

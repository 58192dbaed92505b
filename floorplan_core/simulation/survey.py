"""``simulate_survey`` and ``simulate``: building, walk, rays, errors, truth; in memory or as files."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.observer import Observer
from floorplan_core.simulation.architect import make_building
from floorplan_core.simulation.building import Building
from floorplan_core.simulation.files import SurveyPaths, write_survey
from floorplan_core.simulation.poses import Poses, sensor_poses, world_from_building
from floorplan_core.simulation.sensors import Scene, make_scene, scan
from floorplan_core.simulation.spec import SurveySpec
from floorplan_core.simulation.truth import ground_truth
from floorplan_core.simulation.walk import explore, floor_grid

Float = NDArray[np.float64]

RAYS_AT_ONCE = 1_500_000  # bounds memory: some 100 bytes a ray
WINDOW = 40  # scans that share one thinning voxel grid
BUILDING, WALK, POSES, RANGES, THINNING = range(5)  # streams of random numbers


@dataclass(frozen=True)
class SimulatedSurvey:
    """Points as a mapping system would deliver them, and everything that it does not know."""

    points: Float  # (N, 3) metres, world frame, placed by the estimated poses; ordered by scan
    scan_id: NDArray[np.int32]  # (N,) row of the trajectory that saw the point
    stamps: Float  # (M,) seconds
    trajectory: Float  # (M, 4, 4) estimated T_world_sensor
    trajectory_gt: Float  # (M, 4, 4) true T_world_sensor
    truth: dict[str, Any]  # what goes to truth.json
    building: Building


def stream(seed: int, number: int) -> np.random.Generator:
    """Independent random numbers for each part: another sensor does not change the building."""
    return np.random.default_rng([seed, number])


def simulate_survey(spec: SurveySpec, observer: Observer | None = None) -> SimulatedSurvey:
    """Simulate a survey in memory.

    Raises:
        UsageError: a building that cannot be walked.
        Cancelled: the observer asked for a stop.
    """
    observer = observer or Observer()
    building = make_building(spec.building, stream(spec.seed, BUILDING))
    walk_rng = stream(spec.seed, WALK)
    yaw = float(walk_rng.uniform(-45, 45)) if spec.yaw_deg is None else spec.yaw_deg
    walk = explore(building, floor_grid(building), spec.explore, walk_rng)
    poses = sensor_poses(walk, spec, stream(spec.seed, POSES))
    scene = make_scene(building)
    T_world_building = world_from_building(spec, yaw)
    estimated = T_world_building @ poses.drift @ poses.T_building_sensor
    points, scan_id = _cast_all(scene, spec, poses, estimated, observer)
    truth = ground_truth(spec, building, walk, poses, T_world_building, yaw, scene)
    true = T_world_building @ poses.T_building_sensor
    return SimulatedSurvey(points, scan_id, poses.stamps, estimated, true, truth, building)


def simulate(spec: SurveySpec, out: Path, observer: Observer | None = None) -> SurveyPaths:
    """Simulate a survey and write ``points.ply``, the trajectories and ``truth.json`` into ``out``.

    Raises:
        OutputError: the folder cannot be written.
    """
    observer = observer or Observer()
    survey = simulate_survey(spec, observer)
    started = time.perf_counter()
    observer.stage_started("export")
    paths = write_survey(survey, out)
    observer.stage_finished("export", time.perf_counter() - started)
    return paths


def _cast_all(
    scene: Scene, spec: SurveySpec, poses: Poses, estimated: Float, observer: Observer
) -> tuple[Float, NDArray[np.int32]]:
    """World points of all scans, thinned, at most ``max_points`` of them."""
    started = time.perf_counter()
    observer.stage_started("rays", len(poses.stamps))
    rng = stream(spec.seed, RANGES)
    parts, ids = [], []
    for rows in _batches(len(poses.stamps), spec):
        observer.check_cancelled()
        local, row = scan(scene, spec.sensor, poses.T_building_sensor[rows], rng)
        world = _placed(local, row, estimated[rows])
        keep = thin(world - estimated[0, :3, 3], row // WINDOW, spec.thin)
        parts.append(world[keep])
        ids.append((row[keep] + rows.start).astype(np.int32))
        observer.progress("rays", rows.stop)
    points, scan_id = np.concatenate(parts), np.concatenate(ids)
    kept = _sample(len(points), spec)
    observer.stage_finished("rays", time.perf_counter() - started)
    return points[kept], scan_id[kept]


def _placed(local: NDArray[np.float32], row: NDArray[np.int32], T: Float) -> Float:
    """(N, 3) sensor-frame points, ordered by row, moved by the pose ``T`` of their row."""
    world = np.empty(local.shape)
    ends = np.searchsorted(row, np.arange(len(T) + 1))
    for pose, a, b in zip(T, ends, ends[1:], strict=False):
        world[a:b] = local[a:b] @ pose[:3, :3].T + pose[:3, 3]
    return world


def _batches(count: int, spec: SurveySpec) -> Iterator[slice]:
    """Runs of whole thinning windows where they fit into memory."""
    step = max(1, RAYS_AT_ONCE // (spec.sensor.rows * spec.sensor.columns))
    step = step // WINDOW * WINDOW or step
    for start in range(0, count, step):
        yield slice(start, min(start + step, count))


def thin(points: Float, window: NDArray[np.int32], voxel: float) -> NDArray[np.int64]:
    """Indices, in order, of the first point in each voxel of each window; all where ``voxel`` is 0."""
    if voxel == 0 or len(points) == 0:
        return np.arange(len(points))
    cell = np.floor(points / voxel).astype(np.int64)
    cell -= cell.min(axis=0)
    nx, ny, nz = cell.max(axis=0) + 1
    key = ((window * nx + cell[:, 0]) * ny + cell[:, 1]) * nz + cell[:, 2]
    return np.sort(np.unique(key, return_index=True)[1])


def _sample(count: int, spec: SurveySpec) -> NDArray[np.int64]:
    """At most ``max_points`` indices, in order."""
    if count <= spec.max_points:
        return np.arange(count)
    chosen = stream(spec.seed, THINNING).choice(count, spec.max_points, replace=False)
    return np.sort(chosen)

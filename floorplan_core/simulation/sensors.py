"""Rays, hits and range errors. Open3D's RaycastingScene does the casting, many scans at a time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.open3d_import import load_open3d
from floorplan_core.simulation.building import Building
from floorplan_core.simulation.solids import building_solids, glass_solids, triangles
from floorplan_core.simulation.spec import SensorSpec

Float = NDArray[np.float64]

EDGE = 0.25  # m between neighbouring ranges that makes a depth edge
NEVER = np.float32(np.inf)


@dataclass(frozen=True)
class Scene:
    """What rays can hit: opaque surfaces, and window panes apart."""

    opaque: Any
    glass: Any | None

    def ranges(self, rays: NDArray[np.float32]) -> NDArray[np.float32]:
        """(N,) metres to the first opaque surface along (N, 6) rays; infinite where there is none."""
        return _cast(self.opaque, rays)

    def glass_ranges(self, rays: NDArray[np.float32]) -> NDArray[np.float32]:
        """(N,) metres to the first window pane; infinite where there is none."""
        return _cast(self.glass, rays) if self.glass is not None else np.full(len(rays), NEVER)


def _cast(scene: Any, rays: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.asarray(scene.cast_rays(_tensor(rays))["t_hit"].numpy(), dtype=np.float32)


def _tensor(array: NDArray[Any]) -> Any:
    return load_open3d().core.Tensor.from_numpy(np.ascontiguousarray(array))


def make_scene(building: Building) -> Scene:
    """Put the building into ray casting scenes."""
    glass = glass_solids(building)
    return Scene(_scene(building_solids(building)), _scene(glass) if len(glass) else None)


def _scene(solids: Float) -> Any:
    vertices, faces = triangles(solids)
    scene = load_open3d().t.geometry.RaycastingScene()
    scene.add_triangles(_tensor(vertices), _tensor(faces))
    return scene


def directions(sensor: SensorSpec) -> Float:
    """(rows, columns, 3) unit vectors in the sensor frame: x ahead, y left, z up."""
    low, high = np.deg2rad([sensor.lowest, sensor.highest])
    half = np.deg2rad(sensor.horizontal_fov) / 2
    if sensor.kind == "camera":  # a pinhole: equal steps on the image plane
        left = np.linspace(np.tan(half), -np.tan(half), sensor.columns)
        up = np.linspace(np.tan(high), np.tan(low), sensor.rows)
        y, z = np.meshgrid(left, up)
        rays = np.stack([np.ones_like(y), y, z], axis=-1)
        return np.asarray(rays / np.linalg.norm(rays, axis=-1, keepdims=True))
    full = sensor.horizontal_fov >= 360
    azimuth = np.linspace(half, -half, sensor.columns, endpoint=not full)
    a, e = np.meshgrid(azimuth, np.linspace(high, low, sensor.rows))
    return np.stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)], axis=-1)


def scan(
    scene: Scene, sensor: SensorSpec, T: Float, rng: np.random.Generator
) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """Points in the sensor frame and the row of ``T`` that saw each, in order.

    Args:
        T: (M, 4, 4) true poses, building axes.
    """
    local = directions(sensor)
    flat = local.reshape(-1, 3)
    phase = rng.uniform(0, 2 * np.pi / sensor.columns, len(T)) * (sensor.kind != "camera")
    c, s = np.cos(phase), np.sin(phase)
    spun = np.empty((len(T), len(flat), 3))  # each revolution starts at another angle
    spun[..., 0] = c[:, None] * flat[:, 0] - s[:, None] * flat[:, 1]
    spun[..., 1] = s[:, None] * flat[:, 0] + c[:, None] * flat[:, 1]
    spun[..., 2] = flat[:, 2]
    rays = np.empty((len(T), len(flat), 6), dtype=np.float32)
    rays[..., :3] = T[:, None, :3, 3]
    rays[..., 3:] = spun @ T[:, :3, :3].transpose(0, 2, 1)
    images = (len(T), *local.shape[:2])
    true = scene.ranges(rays.reshape(-1, 6)).reshape(images)
    true = _with_glass(scene, sensor, rays, true, rng)
    measured = _with_errors(true, sensor, rng).reshape(len(T), -1)
    valid = (measured >= sensor.min_range) & (measured <= sensor.max_range)
    row = np.nonzero(valid)[0].astype(np.int32)
    return (spun[valid] * measured[valid, None]).astype(np.float32), row


def _with_glass(
    scene: Scene,
    sensor: SensorSpec,
    rays: NDArray[np.float32],
    true: NDArray[np.float32],
    rng: np.random.Generator,
) -> NDArray[np.float32]:
    """A share of the rays through a window returns from its pane; the others go on."""
    if sensor.glass_return == 0 or scene.glass is None:
        return true
    pane = scene.glass_ranges(rays.reshape(-1, 6)).reshape(true.shape)
    returns = (pane < true) & (rng.random(true.shape, dtype=np.float32) < sensor.glass_return)
    return np.where(returns, pane, true)


def _with_errors(
    true: NDArray[np.float32], sensor: SensorSpec, rng: np.random.Generator
) -> NDArray[np.float32]:
    """Mixed pixels at depth edges, range noise, dropout; (M, rows, columns) in and out."""
    measured = true.copy()
    if sensor.mixed_pixels > 0:
        beside = np.roll(true, -1, axis=2)
        if sensor.horizontal_fov < 360:
            beside[..., -1] = true[..., -1]
        edge = np.isfinite(true) & np.isfinite(beside)
        edge &= np.abs(np.where(edge, true, 0) - np.where(edge, beside, 0)) > EDGE
        at = np.nonzero(edge)
        mixed = rng.random(len(at[0])) < sensor.mixed_pixels
        at = tuple(a[mixed] for a in at)
        part = rng.random(len(at[0]), dtype=np.float32)
        measured[at] = true[at] + part * (beside[at] - true[at])
    if sensor.noise > 0:
        measured += np.float32(sensor.noise) * rng.standard_normal(true.shape, dtype=np.float32)
    if sensor.dropout > 0:
        measured[rng.random(true.shape, dtype=np.float32) < sensor.dropout] = NEVER
    return measured

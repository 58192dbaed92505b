"""Manhattan frame: gravity and yaw (the paper's assumption of three orthogonal directions, made explicit).

In: surfels of the whole survey. Out: a :class:`ManhattanFrame`. Gravity is the mean normal of the horizontal
patches. Yaw starts at the strongest direction of the vertical patches modulo 90 degrees; because normals from
neighbourhoods that reach through a thin wall are biased (a yaw 1.6 degrees off ruins everything), it is then
refined on the surfels themselves: the yaw under which the walls, projected along their own direction, are
sharpest (:mod:`~floorplan_core.stages.sharpest_yaw`), near the normals' answer unless walls are clearly
sharper elsewhere. Cost: one pass over the surfels, plus the search on a bounded sample.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import FrameConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.cell_normals import CellNormals, fit_cell_normals
from floorplan_core.geometry.level_frame import rotation_to_z
from floorplan_core.geometry.surfel_map import Surfels
from floorplan_core.model import ManhattanFrame
from floorplan_core.stages.sharpest_yaw import rough_yaw, sharpest_yaw, wrap
from floorplan_core.stages.slab_faces import inner_faces

Float = NDArray[np.float64]

_UP_CONE = math.radians(35)  # a floor's normal is this near to the file's up axis
_PLANAR = 0.4  # of the surfels in patches that are planar: 0.5 to 0.8 where noise is thinner than patches
_WIDEST = 8.0  # times the usual patch, 2 m: for 8 cm of noise
_WIDER, _MORE = 2.0, 1.5  # times the usual patch; times as many surfels as it explains: for clutter less
_ACROSS = 8  # voxels of a voxel map in a patch: two layers of them are a plane there
_LEVEL_SHARE = 0.08  # of the strongest level: less is a table or a ghost, not a floor
_MIN_WALL_AREA = 0.5  # m2 of vertical surface, below which nothing can be said
_LEVELLED = math.radians(0.25)  # a smaller tilt is that of a levelled instrument
_LEVEL_REACHES = (0.3, 0.15, 0.08)  # m around the strongest level: first for a rough up, then for a better
_POOR = 0.6  # of the walls along the axes: buildings without walls at other angles have 0.7 to 0.98
_FLAT = 0.3  # m of height, below which a cloud is a 2-D scan


def estimate_frame(surfels: Surfels, config: FrameConfig, voxel: float = 0.0) -> ManhattanFrame:
    """The rotation after which walls lie along x and y; raises :class:`NoPlanError` where there is none.

    ``voxel``: metres, side of the voxels where the survey is the centres of a voxel map.
    """
    normals = _patches(surfels, config, voxel)
    up = _gravity(normals)
    level = rotation_to_z(up)
    n = normals.normal @ level.T
    vertical = np.abs(n[:, 2]) < math.sin(math.radians(15))
    area = float(normals.weight[vertical].sum()) * surfels.size**2 * surfels.every
    if area < _MIN_WALL_AREA:
        raise NoPlanError(_no_walls(area, len(surfels), float(np.ptp(surfels.centroid @ up))))
    angle = np.arctan2(n[vertical, 1], n[vertical, 0])
    weight = normals.weight[vertical]
    if config.yaw_deg is not None:
        yaw = wrap(math.radians(config.yaw_deg))
    else:
        coarse = rough_yaw(surfels, normals, level, strongest_direction(angle, weight))
        yaw = sharpest_yaw(surfels, normals, vertical, level, coarse, config)
    support = float(
        weight[np.abs(wrap(angle - yaw)) < math.radians(config.tolerance_deg)].sum() / weight.sum()
    )
    if support < config.min_support:
        raise NoPlanError(
            f"This is no Manhattan world: only {support:.0%} of the wall surface is within "
            f"{config.tolerance_deg:g} degrees of two perpendicular directions "
            f"(frame.min_support is {config.min_support:.0%}); if the building has walls at other angles, "
            "lower it."
        )
    rotation = turned_by(-yaw) @ level
    floor, ceiling = inner_faces(surfels, rotation, *floor_and_ceiling(surfels, normals, rotation))
    tilt = math.acos(float(np.clip(up[2], -1, 1)))
    return ManhattanFrame(rotation, yaw, tilt, support, area, floor, ceiling)


def _patches(surfels: Surfels, config: FrameConfig, voxel: float) -> CellNormals:
    """The planar patches; wider ones where noise is so thick that few of the usual width are planar.

    In a map of ``voxel`` metres a wall on the border of two voxels fills both: thin only in a patch of many.
    """
    usual = fit_cell_normals(surfels.centroid, config.cell, config.planarity)
    if _ACROSS * voxel > config.cell:
        across = fit_cell_normals(surfels.centroid, _ACROSS * voxel, config.planarity)
        if across.share > max(_PLANAR, usual.share):
            return across
    best, width = usual, config.cell
    while best.share <= _PLANAR and width < _WIDEST * config.cell:
        width *= _WIDER
        wider = fit_cell_normals(surfels.centroid, width, config.planarity)
        if wider.share <= _MORE * best.share:
            break
        best = wider
    return best


def seen_from(frame: ManhattanFrame, turn: Float, yaw_deg: float | None = None) -> ManhattanFrame:
    """``frame`` for points that ``turn`` (3, 3) takes into those that it was estimated on.

    Its quadrant stays, whichever the world's is; its yaw is that of the walls, in (-pi/4, pi/4]. With
    ``yaw_deg`` the walls have exactly this direction, as the user wants it.
    """
    rotation = frame.rotation @ turn
    heading = math.atan2(rotation[0, 1], rotation[0, 0])
    yaw = float(wrap(heading if yaw_deg is None else math.radians(yaw_deg)))
    if yaw_deg is not None:
        rotation = turned_by(float(wrap(heading - yaw))) @ rotation
    tilt = math.acos(float(np.clip(rotation[2, 2], -1, 1)))
    return replace(frame, rotation=rotation, yaw=yaw, tilt=tilt)


def misfit(frame: ManhattanFrame) -> tuple[str, ...]:
    """What a user should know of a frame that many walls do not follow; nothing where most do."""
    if frame.support >= _POOR:
        return ()
    return (
        f"Only {frame.support:.0%} of the wall surface fits the two directions of the plan: round walls and "
        "walls at other angles come out as steps or are missing (thick noise lowers the share, too); compare "
        "the planes with the plan, and force another direction with --set frame.yaw_deg=... if it is wrong.",
    )


def refined_direction(surfels: Surfels, coarse: float, config: FrameConfig) -> float:
    """The yaw, radians, near ``coarse`` under which walls of ``surfels`` in a level frame are sharpest."""
    normals = fit_cell_normals(surfels.centroid, config.cell, config.planarity)
    vertical = np.abs(normals.normal[:, 2]) < math.sin(math.radians(15))
    return sharpest_yaw(surfels, normals, vertical, np.eye(3), coarse, config)


def _no_walls(area: float, voxels: int, height: float) -> str:
    what = f"No walls were found: only {area:.2f} m2 of vertical surface among {voxels} occupied voxels"
    if height < _FLAT:
        return (
            f"{what}, all within {height:.2f} m of height; a 2-D scan shows walls only with its trajectory."
        )
    return (
        f"{what}; check the unit and the up axis (--set input.unit=... or input.up=...), or scan more walls."
    )


def _gravity(normals: CellNormals) -> Float:
    """Unit up vector: the mode of the near-horizontal patches' normals, then their mean within 3 degrees."""
    n = normals.normal * np.where(normals.normal[:, 2:] < 0, -1.0, 1.0)
    near = n[:, 2] > math.cos(_UP_CONE)
    n, w = n[near], normals.weight[near]
    up: Float = np.array([0.0, 0.0, 1.0])
    if w.sum() < 50:  # nothing horizontal was seen: trust the file
        return up
    bins = np.round(n[:, :2] / 0.05).astype(int) + 20  # components are at most 1
    place = bins[:, 0] * 41 + bins[:, 1]
    mode = n[place == np.argmax(np.bincount(place, weights=w))].mean(axis=0)
    up = mode / np.linalg.norm(mode)
    for cone in (8.0, 5.0, 3.0, 3.0, 3.0):
        inside = n @ up > math.cos(math.radians(cone))
        if not inside.any():
            break
        mean = (n[inside] * w[inside, None]).sum(axis=0)
        up = mean / np.linalg.norm(mean)
    return up if up[2] > math.cos(_LEVELLED) else _square_to_floor(normals, up)


def _square_to_floor(normals: CellNormals, up: Float) -> Float:
    """``up`` turned until the strongest level is level: patches of a tilted floor are cut askew by the cells,
    and the mean of their normals is some tenths of a degree off; the floor as a whole is not."""
    for reach in _LEVEL_REACHES:
        flat = np.abs(normals.normal @ up) > math.cos(math.radians(10))
        if not flat.any():  # the mean of slopes that all lean away from it
            break
        centre, weight = normals.centre[flat], normals.weight[flat]
        height = centre @ up
        bins = np.floor((height - height.min()) / reach).astype(np.int64)
        peak = height.min() + (np.argmax(np.bincount(bins, weights=weight)) + 0.5) * reach
        near = np.abs(height - peak) < reach
        w = weight[near, None]
        middle = (centre[near] * w).sum(axis=0) / w.sum()
        off = centre[near] - middle
        normal = np.linalg.eigh((off * w).T @ off)[1][:, 0]
        up = normal * np.sign(normal @ up)
    return np.asarray(up)


def turned_by(angle: float) -> Float:
    """(3, 3) rotation about z by ``angle`` radians."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def strongest_direction(angle: Float, weight: Float) -> float:
    """The peak of the directions modulo 90 degrees, smoothed over 2 degrees, then their mean within 4."""
    degrees = np.rad2deg(wrap(angle))
    hist, _ = np.histogram(degrees, bins=180, range=(-45, 45), weights=weight)
    kernel = np.exp(-0.5 * (np.arange(-8, 9) / 3.0) ** 2)
    smooth = np.convolve(np.concatenate([hist[-8:], hist, hist[:8]]), kernel, mode="valid")
    peak = math.radians(-45 + 0.5 * (int(np.argmax(smooth)) + 0.5))
    for _ in range(3):
        delta = wrap(angle - peak)
        near = np.abs(delta) < math.radians(4)
        if near.any():
            peak += float(np.average(delta[near], weights=weight[near]))
    return float(wrap(peak))


def floor_and_ceiling(surfels: Surfels, normals: CellNormals, rotation: Float) -> tuple[float, float | None]:
    """Heights of the lowest strong horizontal level and of the highest at least 1.8 m above it."""
    n = normals.normal @ rotation.T
    z = (normals.centre @ rotation.T)[:, 2]
    flat = np.abs(n[:, 2]) > math.cos(math.radians(20))
    if normals.weight[flat].sum() < 100:
        return float(np.percentile(surfels.centroid @ rotation[2], 0.5)), None
    zf, w = z[flat], normals.weight[flat]
    bins = np.arange(zf.min() - 0.05, zf.max() + 0.11, 0.05)
    hist, _ = np.histogram(zf, bins=bins, weights=w)
    smooth = np.convolve(hist, [0.5, 1.0, 0.5], mode="same")
    strong = np.flatnonzero(smooth > _LEVEL_SHARE * smooth.max())
    floor = _level_near(zf, w, bins[_climb(smooth, strong[0], 1)] + 0.025)
    if not flat.all() and floor > np.median(z[~flat]):  # no floor was seen: a ceiling lies above the walls
        return float(np.percentile(surfels.centroid @ rotation[2], 0.5)), floor
    high = strong[bins[strong] > floor + 1.8]
    return floor, (_level_near(zf, w, bins[_climb(smooth, high[-1], -1)] + 0.025) if len(high) else None)


def _climb(histogram: Float, k: int, step: int) -> int:
    """The peak that bin ``k`` is on the slope of: a smoothed level is strong in the bins beside it, too."""
    while 0 <= k + step < len(histogram) and histogram[k + step] > histogram[k]:
        k += step
    return int(k)


def _level_near(z: Float, weight: Float, level: float) -> float:
    """Weighted mean of the heights within 6 cm of ``level``."""
    for _ in range(3):
        near = np.abs(z - level) < 0.06
        if near.any():
            level = float(np.average(z[near], weights=weight[near]))
    return level

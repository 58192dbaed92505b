"""Sightings: what each keyframe saw of the walls, floors and ceilings around it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import FrameConfig
from floorplan_core.geometry.cell_normals import CellNormals, fit_cell_normals

Float = NDArray[np.float64]

SURFEL = 0.05  # m; points are thinned to one in each such cube, so that weight is area
ALIGNED = math.cos(math.radians(20))  # of a patch's normal to the axis that it is a sighting of
NEAR = math.radians(10)  # of a patch's direction to the frame: what turns is the path, not the wall
GAP = 0.08  # m between the offsets of two surfaces of one keyframe
MIN_PATCHES = 3  # cells of 0.25 m: smaller surfaces are things
PATCH_SIGMA = math.radians(8)  # of the direction of a single patch, furniture and all
OFFSET_SIGMA = 0.1  # m, of a patch across its wall
LEAST_RUN = 1.0  # m2: patches over less length of wall say nothing of its direction
HEADING_ROUNDS = 2
PRIOR = 1e-6  # keeps the heading where no keyframe sees a wall


@dataclass(frozen=True)
class Sightings:
    """Surfaces as single keyframes saw them, ``S`` of them; axes of the Manhattan frame."""

    keyframe: NDArray[np.intp]  # (S,)
    axis: NDArray[np.intp]  # (S,) of the normal
    facing: NDArray[np.intp]  # (S,) +1 or -1: where along the axis the free side is
    distance: Float  # (S,) m from the keyframe's origin to the surface, along the axis
    mass: Float  # (S,) surfels: observed area
    low: Float  # (S, 3) m from the keyframe's origin, of the surface's extent
    high: Float  # (S, 3)

    def __len__(self) -> int:
        return len(self.keyframe)


def keyframe_patches(points: Float, origin: Float, rotation: Float, config: FrameConfig) -> CellNormals:
    """Flat patches in the points (N, 3) of a keyframe, in the Manhattan frame, from its ``origin`` (3,)."""
    local = (points - origin) @ rotation.T
    _, first = np.unique(np.floor(local / SURFEL).astype(np.int64), axis=0, return_index=True)
    return fit_cell_normals(np.ascontiguousarray(local[first]), config.cell, config.planarity)


def headings(
    patches: Sequence[CellNormals], step_sigma: Float, check: Callable[[], None] = lambda: None
) -> Float:
    """(K,) radians that each keyframe is turned against the frame: to be taken back.

    First from the directions of the patches; then, finer, from how straight each wall runs along its axis.
    Orientation is known from the walls at any moment, so it does not drift; ``step_sigma`` (K-1,) radians is
    what the path's own heading may err from a keyframe to the next. ``check`` is called again and again.
    """
    total = np.array([_turn(p) for p in patches], dtype=np.complex128)
    weight = np.abs(total) / PATCH_SIGMA**2
    turn = _smoothed(np.angle(total) / 4, weight, step_sigma)
    for _ in range(HEADING_ROUNDS):
        slopes = []
        for part, angle in zip(patches, turn, strict=True):
            check()
            slopes.append(_slope(part, angle))
        finer, weight = np.array(slopes).T
        turn = _smoothed(turn + finer, weight, step_sigma)
    return turn


def _smoothed(turn: Float, weight: Float, step_sigma: Float) -> Float:
    """Least squares: each keyframe's own heading, and small differences from one to the next."""
    from scipy.linalg import solveh_banded

    stiff = 1.0 / step_sigma**2
    diagonal = weight + np.concatenate([stiff, [0.0]]) + np.concatenate([[0.0], stiff]) + PRIOR
    band = np.vstack([np.concatenate([[0.0], -stiff]), diagonal])
    return np.asarray(solveh_banded(band, weight * turn))


def _slope(patches: CellNormals, turn: float) -> tuple[float, float]:
    """Radians that the walls of a keyframe still run askew, and the weight (1 / variance) of that."""
    centre, normal = _turned_back(patches, turn)
    total = information = 0.0
    for axis in (0, 1):
        along = 1 - axis
        for rows, *_ in _surfaces(centre, normal, patches.weight, axis):
            w = patches.weight[rows] / patches.weight[rows].max()
            u, v = centre[rows, along], centre[rows, axis]
            u, v = u - np.average(u, weights=w), v - np.average(v, weights=w)
            size = float(w @ (u * u))
            # a wall along x that rises is turned to the left, one along y that rises to the right
            total += float(w @ (u * v)) * (1 if axis == 1 else -1)
            information += size
    if information < LEAST_RUN:
        return 0.0, 0.0
    return total / information, information / OFFSET_SIGMA**2


def _turned_back(patches: CellNormals, turn: float) -> tuple[Float, Float]:
    """(C, 3) centres and normals after turning by ``-turn`` about the vertical."""
    c, s = math.cos(-turn), math.sin(-turn)
    back = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return patches.centre @ back.T, patches.normal @ back.T


def _turn(patches: CellNormals) -> complex:
    n = patches.normal
    angle = np.arctan2(n[:, 1], n[:, 0])
    off = (angle + np.pi / 4) % (np.pi / 2) - np.pi / 4
    walls = (np.abs(n[:, 2]) < math.sin(NEAR)) & (np.abs(off) < NEAR)
    return complex(np.sum(np.exp(4j * off[walls])))


def find_sightings(
    patches: Sequence[CellNormals], turn: Float, check: Callable[[], None] = lambda: None
) -> Sightings:
    """The surfaces of all keyframes after turning each by ``-turn`` (K,) radians about the vertical."""
    rows: list[tuple[int, int, int, float, float, Float, Float]] = []
    for k, (part, angle) in enumerate(zip(patches, turn, strict=True)):
        check()
        centre, normal = _turned_back(part, float(angle))
        for axis in range(3):
            for group, facing, distance in _surfaces(centre, normal, part.weight, axis):
                extent = centre[group].min(axis=0), centre[group].max(axis=0)
                rows.append((k, axis, facing, distance, float(part.weight[group].sum()), *extent))
    columns = list(zip(*rows, strict=True)) if rows else [()] * 7
    return Sightings(
        np.array(columns[0], dtype=np.intp),
        np.array(columns[1], dtype=np.intp),
        np.array(columns[2], dtype=np.intp),
        np.array(columns[3], dtype=np.float64),
        np.array(columns[4], dtype=np.float64),
        np.array(columns[5], dtype=np.float64).reshape(-1, 3),
        np.array(columns[6], dtype=np.float64).reshape(-1, 3),
    )


def _surfaces(
    centre: Float, normal: Float, weight: Float, axis: int
) -> list[tuple[NDArray[np.intp], int, float]]:
    """(patches, facing, distance) of the surfaces across ``axis``, parted at gaps of their offset."""
    across = np.abs(normal[:, axis]) > ALIGNED
    found = []
    for facing in (-1, 1):  # the keyframe stands on the free side
        rows = np.flatnonzero(across & (np.sign(centre[:, axis]) == -facing))
        rows = rows[np.argsort(centre[rows, axis], kind="stable")]
        for group in np.split(rows, np.flatnonzero(np.diff(centre[rows, axis]) > GAP) + 1):
            if len(group) >= MIN_PATCHES:
                found.append((group, facing, float(np.average(centre[group, axis], weights=weight[group]))))
    return found

"""Free-space truth from voxels: what a real sensor carved free, what it hit, the corridor's dimensions."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import FloorPlanError, InputError
from floorplan_core.evaluation.truth import ObservedSpace, Truth, TruthDimension
from floorplan_core.evaluation.voxel_corridor import corridor_dimensions

Points = NDArray[np.float64]
FLOOR_SHARE = 0.01  # of the voxels lie below the floor (stray rays)
BAND = (0.9, 1.5)  # m above the floor: the slice at which plans are made, with tolerance for its height
ABOVE_FURNITURE = (1.9, 2.5)  # m above the floor
STANDS = 0.5  # share of the levels of BAND in which a cell is surface, from which it is wall


def load_free_voxels(path: Path) -> Truth:
    """``centers`` (N, 3) of free voxels and their size ``res``; walls come from ``points.ply`` beside it."""
    try:
        with np.load(path, allow_pickle=False) as data:
            centers, res = np.asarray(data["centers"], dtype=np.float64), float(data["res"])
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(
            f"{path.name} is no table of free voxels with 'centers' and 'res': {error}."
        ) from error
    if (
        centers.ndim != 2
        or centers.shape[1] != 3
        or not len(centers)
        or not np.all(np.isfinite(centers))
        or res <= 0
    ):
        raise InputError(
            f"{path.name} holds no finite (N, 3) free voxels (shape {centers.shape}, size {res:g} m)."
        )
    occupied = _occupied(path.with_name("points.ply"))
    return Truth(
        source=path.name,
        dimensions=measured_corridor(centers, occupied, res),
        observed=observed_space(centers, occupied, res),
    )


def _occupied(path: Path) -> Points:
    """(M, 3) centres of occupied voxels; none where the file is absent."""
    if not path.is_file():
        return np.zeros((0, 3))
    from floorplan_core.readers import open_survey

    try:
        survey = open_survey(path)
        parts = [np.asarray(c.points, dtype=np.float64) for c in survey.chunks()]
    except FloorPlanError as error:
        raise InputError(f"The occupied voxels beside the truth cannot be read: {error}") from error
    return np.concatenate(parts) + survey.local_frame.shift if parts else np.zeros((0, 3))


def observed_space(free: Points, occupied: Points, cell: float) -> ObservedSpace:
    """Project both kinds of voxels to the plan in the bands above the floor."""
    floor, origin, shape = _grid(free, occupied, cell)
    carved = _levels(free, floor, BAND, origin, cell, shape) > 0
    wall = _levels(occupied, floor, ABOVE_FURNITURE, origin, cell, shape) > 0
    return ObservedSpace(origin, cell, carved, wall & ~carved)


def measured_corridor(free: Points, occupied: Points, cell: float) -> tuple[TruthDimension, ...]:
    """The dimensions of the longest corridor between surfaces that stand; () where there is none."""
    floor, origin, shape = _grid(free, occupied, cell)
    carved = _levels(free, floor, BAND, origin, cell, shape) > 0
    standing = _levels(occupied, floor, BAND, origin, cell, shape) >= STANDS * (BAND[1] - BAND[0]) / cell
    return corridor_dimensions(carved, standing, origin, cell)


def _grid(free: Points, occupied: Points, cell: float) -> tuple[float, Points, tuple[int, int]]:
    """Height of the floor, lower left corner, and rows and columns of the cells under all voxels."""
    both = np.concatenate([free, occupied])
    origin = both[:, :2].min(axis=0) - 0.5 * cell
    nx, ny = np.floor((both[:, :2].max(axis=0) - origin) / cell).astype(int) + 1
    return float(np.quantile(free[:, 2], FLOOR_SHARE)), origin, (int(ny), int(nx))


def _levels(
    points: Points,
    floor: float,
    band: tuple[float, float],
    origin: Points,
    cell: float,
    shape: tuple[int, int],
) -> NDArray[np.int64]:
    """(ny, nx) voxels of each column within a band of heights above the floor."""
    height = points[:, 2] - floor
    within = points[(height >= band[0]) & (height <= band[1])]
    column, row = np.floor((within[:, :2] - origin) / cell).astype(int).T
    return np.bincount(row * shape[1] + column, minlength=shape[0] * shape[1]).reshape(shape)

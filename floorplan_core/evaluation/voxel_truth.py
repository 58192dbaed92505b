"""Free-space truth from voxels: what a real sensor carved free, and the surfaces it hit."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import FloorPlanError, InputError
from floorplan_core.evaluation.truth import ObservedSpace, Truth

Points = NDArray[np.float64]
FLOOR_SHARE = 0.01  # of the voxels lie below the floor (stray rays)
BAND = (0.9, 1.5)  # m above the floor: the slice at which plans are made, with tolerance for its height
ABOVE_FURNITURE = (1.9, 2.5)  # m above the floor


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
    return Truth(source=path.name, observed=observed_space(centers, occupied, res))


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
    floor = float(np.quantile(free[:, 2], FLOOR_SHARE))
    both = np.concatenate([free, occupied])
    origin = both[:, :2].min(axis=0) - 0.5 * cell
    nx, ny = np.floor((both[:, :2].max(axis=0) - origin) / cell).astype(int) + 1
    height = free[:, 2] - floor
    carved = _columns(free[(height >= BAND[0]) & (height <= BAND[1])], origin, cell, (ny, nx))
    height = occupied[:, 2] - floor
    upper = (height >= ABOVE_FURNITURE[0]) & (height <= ABOVE_FURNITURE[1])
    wall = _columns(occupied[upper], origin, cell, (ny, nx))
    return ObservedSpace(origin, cell, carved, wall & ~carved)


def _columns(points: Points, origin: Points, cell: float, shape: tuple[int, int]) -> NDArray[np.bool_]:
    mask = np.zeros(shape, dtype=bool)
    index = np.floor((points[:, :2] - origin) / cell).astype(int)
    mask[index[:, 1], index[:, 0]] = True
    return mask

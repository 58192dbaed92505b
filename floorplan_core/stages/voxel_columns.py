"""The voxel map in the manhattan frame: free by ray casting, occupied, unobserved (paper, section 3).

In: surfels, the ray counts and the frame. Out: :class:`Evidence`, whose columns hold a bit for each voxel of
0.1 m. Where the sensor's origins are unknown, a voxel is free if it lies between a seen floor (or ceiling)
and the first surface above (below) it. Cost: one pass over surfels and one over the columns.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import VoxelConfig
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.columns import (
    LEVEL,
    LEVELS,
    count_bits,
    height_mask,
    hit_columns,
    merged,
    strips,
)
from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.ray_carving import MissMap
from floorplan_core.geometry.surfel_map import SurfelMap
from floorplan_core.model import ManhattanFrame
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.stray_returns import stray_returns

Float = NDArray[np.float64]

_SAMPLE = 200_000  # surfels from which the extent is taken
_WORTH = 200_000  # surfels of which a second thread takes half
_MARGIN = 1.0  # m of empty cells around the data
_STANDING = height_mask(0.3, 2.0)  # where a wall is full, and a scan of furniture seldom
_FULL = 0.9  # of it that was hit
_WALL = 2  # cells to the face on each side: walls up to 0.3 m, where they lie badly
_FLOOR = 0.01  # m below the floor that are still its level: half of a model's exact floor is below its mean
_TWICE = 10_000_000  # columns that two threads have each for themselves: 80 MB more
LARGEST = 250_000_000  # cells of the fine grid: a site of 790 x 790 m


def gather_evidence(
    surfels: SurfelMap,
    misses: MissMap,
    frame: ManhattanFrame,
    path: Float,
    config: VoxelConfig,
    lifted: bool = False,
) -> Evidence:
    """Turn the maps into the manhattan frame.

    :param path: (M, 3) sensor positions, local frame.
    :param lifted: a planar scan was lifted to walls.
    """
    viewpoints = bool(len(path))
    xyz, count, spread, view = surfels.turned(frame.rotation, -frame.floor_z)
    path_xy = frame.to_manhattan(path)[:, :2] if len(path) else np.zeros((0, 2))
    cell = config.size
    origin, shape = _grid(xyz, path_xy, cell)
    if lifted and misses.blocks:
        stays = ~stray_returns(xyz, count, misses, frame, (origin, cell, shape))
        xyz, count, spread, view = xyz[stays], count[stays], spread[stays], view[stays]
    fine = cell / 2
    hits = surfels.columns(2 * shape[0], 2 * shape[1])
    _mark_hits(xyz, origin, fine, hits, 0.0 if misses.blocks > 0 else _FLOOR)
    free, occupied = surfels.columns(*shape), surfels.columns(*shape)
    for first, last in strips(*shape):
        low, high = max(first - _WALL, 0), min(last + _WALL, shape[0])  # rows that tell what is in a wall
        around = merged(hits[2 * low : 2 * high])
        surface = around[first - low : last - low]
        if misses.blocks > 0:
            least = (config.min_misses, round(1 / config.hit_ratio) + 1)
            grid = (origin, cell, (last - first, shape[1]), frame.floor_z, LEVELS)
            rays, many = misses.column_bits(frame.rotation, *grid, least, first)
            occupied[first:last] = surface & ~(many & ~_solid(surface))
            free[first:last] = rays & ~occupied[first:last]
        else:
            occupied[first:last] = surface
            free[first:last] = _free_between_floor_and_ceiling(around, frame)[first - low : last - low]
    misses.pack()
    return Evidence(
        frame,
        xyz,
        count,
        spread,
        view,
        surfels.size,
        origin,
        fine,
        hits,
        cell,
        free,
        occupied,
        path_xy,
        misses.blocks == 0,
        viewpoints,
    )


def _grid(xyz: Float, path: Float, cell: float) -> tuple[Float, tuple[int, int]]:
    """Origin and shape of the coarse grid; the outermost hundredth of a percent of surfels does not count."""
    xy = np.ascontiguousarray(xyz[:: max(1, len(xyz) // _SAMPLE), :2].T)
    low, high = np.percentile(xy, [0.01, 99.99], axis=1, overwrite_input=True)
    if len(path):
        low, high = np.minimum(low, path.min(axis=0)), np.maximum(high, path.max(axis=0))
    origin = np.floor((low - _MARGIN) / cell) * cell
    nx, ny = (int(n) for n in np.ceil((high + _MARGIN - origin) / cell))
    if 4 * nx * ny > LARGEST:
        raise NoPlanError(
            f"The points spread over {nx * cell:.0f} x {ny * cell:.0f} m, too much for cells of {cell:g} m; "
            "check the unit (--set input.unit=...), crop the survey, or enlarge voxels.size."
        )
    return origin, (ny, nx)


def _mark_hits(xyz: Float, origin: Float, cell: float, out: NDArray[np.uint64], below: float) -> None:
    """Set the levels that hold points, of each fine column; two threads that mark half of the points each.

    A grid that is large is not marked twice.
    """
    if out.size > _TWICE:
        hit_columns(xyz, origin, cell, out, below)
        return
    parts = [out]

    def mark(start: int, stop: int) -> None:
        hits = out if start == 0 else np.zeros_like(out)
        hit_columns(xyz[start:stop], origin, cell, hits, below)
        if start:
            parts.append(hits)

    in_halves(mark, len(xyz), _WORTH)
    for other in parts[1:]:
        np.bitwise_or(out, other, out=out)


def _solid(surface: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Levels whose neighbour above or below is hit too: no lone return of a mixed pixel."""
    one = np.uint64(1)
    return surface & ((surface << one) | (surface >> one))


def _free_between_floor_and_ceiling(surface: NDArray[np.uint64], frame: ManhattanFrame) -> NDArray[np.uint64]:
    top = LEVELS - 1 if frame.ceiling_z is None else round((frame.ceiling_z - frame.floor_z) / LEVEL)
    free = np.asarray(_fill_columns(surface, min(max(top, 3), LEVELS - 1)))
    return np.where(_inside_walls(surface), np.uint64(0), free)


def _inside_walls(surface: NDArray[np.uint64]) -> NDArray[np.bool_]:
    """(ny, nx) True between two faces that stand from floor to head: a model of solids has both of a wall.

    Not on a face itself, beside which it goes on both ways: what is free above a cabinet's front is free.
    """
    full = count_bits(surface & _STANDING) >= _FULL * count_bits(np.array([_STANDING]))
    inside = np.zeros_like(full)
    for faces, out in ((full, inside), (full.T, inside.T)):
        before, behind = np.zeros_like(faces), np.zeros_like(faces)
        for step in range(1, _WALL + 1):
            before[:, step:] |= faces[:, :-step]
            behind[:, :-step] |= faces[:, step:]
        out |= before & behind
    return inside & ~full


@njit(cache=True, nogil=True)
def _fill_columns(surface, top):  # type: ignore[no-untyped-def]
    out = np.zeros_like(surface)
    for iy in range(surface.shape[0]):
        for ix in range(surface.shape[1]):
            word = surface[iy, ix]
            free = np.uint64(0)
            if word & np.uint64(0b111):  # floor seen: free up to the first surface above it
                k = 3
                while k < top - 1 and not (word >> np.uint64(k)) & np.uint64(1):
                    free |= np.uint64(1) << np.uint64(k)
                    k += 1
            if (word >> np.uint64(top - 2)) & np.uint64(
                0b11111
            ):  # ceiling seen: free down to the first surface
                k = top - 3
                while k > 2 and not (word >> np.uint64(k)) & np.uint64(1):
                    free |= np.uint64(1) << np.uint64(k)
                    k -= 1
            out[iy, ix] = free
    return out

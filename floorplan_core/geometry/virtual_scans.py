"""Free space by line of sight from places where a sensor may have stood: scans of a voxel map of itself.

From each place rays go out in all directions. A ray that meets a surface proves nothing new about the
surface, but the voxels on its way are free: had anything stood there, it would have been seen. A ray that
meets nothing within reach tells nothing. Cost: places times rays times voxels of a ray, whatever the points.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]
Bits = NDArray[np.uint64]


def directions(azimuths: int, elevations: int, steepest: float) -> Float:
    """(azimuths * elevations, 3) unit vectors, elevations from ``-steepest`` to ``steepest`` radians."""
    turn = np.arange(azimuths) * (2 * np.pi / azimuths)
    rise = np.linspace(-steepest, steepest, elevations)
    flat = np.cos(rise)[:, None]
    x, y = flat * np.cos(turn), flat * np.sin(turn)
    return np.stack([x, y, np.broadcast_to(np.sin(rise)[:, None], x.shape)], axis=-1).reshape(-1, 3)


def seen_free(occupied: Bits, places: Float, rays: Float, reach: float, least: float) -> Bits:
    """(ny, nx) columns whose bits are voxels that rays passed on their way to a surface.

    :param occupied: (ny, nx) columns of cubic voxels, bit k the k-th from below.
    :param places: (M, 3) positions in voxels: x, y, z from the corner of the map.
    :param rays: (R, 3) unit vectors.
    :param reach: voxels that a ray goes at most.
    :param least: voxels: what is met nearer is the place's own surroundings, and tells nothing.
    """
    return np.asarray(_seen_free(occupied, places, rays, reach, least))


@njit(cache=True, nogil=True)
def _seen_free(occupied, places, rays, reach, least):  # type: ignore[no-untyped-def]
    free = np.zeros_like(occupied)
    ny, nx = occupied.shape
    one = np.uint64(1)
    for m in range(len(places)):
        for r in range(len(rays)):
            met = -1.0
            step = 0.0
            while step < reach:
                ix = int(np.floor(places[m, 0] + step * rays[r, 0]))
                iy = int(np.floor(places[m, 1] + step * rays[r, 1]))
                iz = int(np.floor(places[m, 2] + step * rays[r, 2]))
                if ix < 0 or iy < 0 or iz < 0 or ix >= nx or iy >= ny or iz > 63:
                    break
                if (occupied[iy, ix] >> np.uint64(iz)) & one:
                    met = step
                    break
                step += 0.5
            if met < least:
                continue
            step = 0.0
            while step < met:
                ix = int(np.floor(places[m, 0] + step * rays[r, 0]))
                iy = int(np.floor(places[m, 1] + step * rays[r, 1]))
                iz = int(np.floor(places[m, 2] + step * rays[r, 2]))
                free[iy, ix] |= one << np.uint64(iz)
                step += 0.5
    return free & ~occupied

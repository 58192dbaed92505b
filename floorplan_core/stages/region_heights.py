"""How high each region is: the level above head height that holds more surface than its walls explain.

In: regions, the surfels above the floor. Out: regions with ``height``, where their ceiling was seen. A wall
puts the same number of surfels into every level; a ceiling, or the panels hung from it, puts far more into
one. Cost: linear in the surfels above head height.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.raster import polygon_window
from floorplan_core.model import OccupancyGrid, Region
from floorplan_core.model.evidence import Evidence

Float = NDArray[np.float64]

_LOWEST = 1.9  # m above the floor: nothing lower is taken for a ceiling
_HIGHEST = 12.0  # m: what is higher is another storey, or the roof of a hall
_LEVEL = 0.005  # m between two levels that are counted
_THICK = 13  # levels that surfels of one ceiling spread over: noise, panels
_MORE = 4.0  # times the surfels of as many usual levels, that a ceiling has
_LEAST = 0.5  # m2 of ceiling seen
_WORTH = 200_000  # surfels from which two threads are faster than one


def measure_heights(
    regions: tuple[Region, ...], evidence: Evidence, grid: OccupancyGrid
) -> tuple[Region, ...]:
    """The regions with their heights, and how high they lie; without a ceiling that was seen None."""
    count = round((_HIGHEST - _LOWEST) / _LEVEL)
    halves = np.zeros((2, len(regions), count), dtype=np.int64)
    labels = _labels(regions, grid)

    def count_part(start: int, stop: int) -> None:
        _count(evidence.xyz[start:stop], labels, grid.origin, grid.cell, halves[min(start, 1)])

    in_halves(count_part, len(evidence.xyz), _WORTH)
    levels = halves.sum(axis=0)
    least = _LEAST / evidence.surfel**2
    measured = (replace(r, height=_ceiling(row, least)) for r, row in zip(regions, levels, strict=True))
    return tuple(replace(r, rise=_rise(r, k, labels, evidence, grid)) for k, r in enumerate(measured))


def _rise(
    region: Region, number: int, labels: NDArray[np.int32], evidence: Evidence, grid: OccupancyGrid
) -> float:
    """Metres from the storey's floor to that of most of the region's cells, which have its ``number``."""
    if evidence.floors is None:
        return 0.0
    (rows, columns), _ = polygon_window(region.polygon, grid.origin, grid.cell, labels.shape)
    iy, ix = np.nonzero(labels[rows, columns] == number)
    if not len(iy):
        return 0.0
    at = grid.origin + grid.cell * (np.column_stack([ix + columns.start, iy + rows.start]) + 0.5)
    return float(np.median(evidence.floors.at(at))) - evidence.frame.floor_z


@njit(cache=True, nogil=True)
def _count(xyz: Float, labels: NDArray[np.int32], origin: Float, cell: float, levels: Any) -> None:
    """Add every surfel to its level of the region that it lies over."""
    ny, nx = labels.shape
    a_metre, a_level = 1.0 / cell, 1.0 / _LEVEL
    for k in range(len(xyz)):
        if xyz[k, 2] <= _LOWEST:
            continue
        level = int((xyz[k, 2] - _LOWEST) * a_level)
        if level >= levels.shape[1]:
            continue
        ix, iy = int((xyz[k, 0] - origin[0]) * a_metre), int((xyz[k, 1] - origin[1]) * a_metre)
        if 0 <= ix < nx and 0 <= iy < ny and labels[iy, ix] >= 0:
            levels[labels[iy, ix], level] += 1


def _labels(regions: tuple[Region, ...], grid: OccupancyGrid) -> NDArray[np.int32]:
    """(ny, nx) the number of the region of each cell, -1 where there is none."""
    labels = np.full(grid.states.shape, -1, dtype=np.int32)
    for number, region in enumerate(regions):
        window, mask = polygon_window(region.polygon, grid.origin, grid.cell, grid.states.shape)
        labels[window][mask] = number
    return labels


def _ceiling(levels: NDArray[np.int64], least: float) -> float | None:
    """Metres above the floor of the ceiling, from the number of surfels at each level; None without one."""
    sums = np.convolve(levels, np.ones(_THICK, dtype=np.int64), mode="same")
    best = int(sums.argmax())
    usual = float(np.median(sums[sums > 0])) if sums.any() else 0.0
    if sums[best] < max(least, _MORE * usual):
        return None
    first = max(best - _THICK // 2, 0)
    inside = np.cumsum(levels[first : first + _THICK])
    median = np.interp(inside[-1] / 2, np.concatenate([[0], inside]), np.arange(len(inside) + 1))
    return float(_LOWEST + (first + median) * _LEVEL)

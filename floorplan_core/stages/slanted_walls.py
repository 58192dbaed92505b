"""Walls on no plane of the frame, curved or slanted: what lies behind one is cut from its region, in steps.

Rectangles between planes reach past such a wall into its corners, where nothing was seen. In: the outline of
a region, the grid, and the cells in which something stands from below table height to above furniture. A
pocket of cells that are not free is cut where nearly all of its border inside the region is such cells, most
of them in line at an angle to the frame: a cabinet's front is straight, a column holds no floor, and what
merely was not seen has free space for a border. Cost: linear in the cells of a region, quadratic in those of
the borders of its pockets.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.geometry.columns import by_strips, count_bits, height_mask, merged
from floorplan_core.geometry.masks import label_patches, measure_patches, opened, widened
from floorplan_core.geometry.raster import polygon_window
from floorplan_core.geometry.rectilinear import open_polygon, polygons_of
from floorplan_core.model import FREE, OccupancyGrid
from floorplan_core.model.evidence import Bits, Evidence
from floorplan_core.stages.other_storeys import straight_outline

Float = NDArray[np.float64]
Bool = NDArray[np.bool_]

_FOOT, _HEAD, _BODY = np.uint8(1), np.uint8(2), np.uint8(4)  # bits of what was hit of a column
_ENDS = (((0.1, 0.5), _FOOT), ((2.1, 6.0), _HEAD))  # m above the floor: a wall has something in both
_BETWEEN, _FULL = (0.5, 2.0), 0.6  # m above the floor, and share of it that was hit
_GAP = (1, 2, 3)  # levels above one that was hit, which it stands for: far away beams are sparse
_BORDER = 0.75  # of a pocket's border inside the region must be something that stands
_LONG = 1.5  # m between the ends of what stands there at an angle
_DEEP = 0.8  # m that it goes into the room: cabinets are not as deep
_LINE = 0.8  # of the variance about a cell, by which that along a line is larger than that across it
_AROUND = 0.5  # m about a cell, in which its neighbours tell its direction
_SLANT = 0.17  # rad from the axes: less is a wall of the frame
_ANGLED = 0.5  # of what stands on the border must run at an angle
_AT_ONCE = 500  # places looked at together
_LEAST = 0.3  # m2 of a pocket
_FLOORED = 0.05  # of the floor of a room is seen at least
_STEP = 3  # cells of a step along the wall


@dataclass(frozen=True)
class StandingCells:
    """Where something stands that is as high as a wall."""

    grid: OccupancyGrid
    cells: Bool  # (ny, nx)
    elsewhere: Any = None  # polygons of what is in the plan of another storey, as where a gallery ends
    floor: Bool | None = None  # (ny, nx) over or under which something was seen, where free space is inferred

    def cut(self, polygon: Any, sliver: float) -> Any:
        """``polygon`` without what lies behind slanted walls or elsewhere; itself where that is nothing.

        :param sliver: metres, below which parts that are left over are dropped.
        """
        if self.elsewhere is not None and polygon.intersection(self.elsewhere).area > _LEAST:
            polygon = _less(polygon, self.elsewhere, sliver)
        grid = self.grid
        window, inside = polygon_window(polygon, grid.origin, grid.cell, grid.states.shape)
        stands = self.cells[window] & inside
        if stands.sum() * grid.cell < _LONG:
            return polygon
        free = grid.states[window] == FREE
        if self.floor is not None:
            free = _with_floor(free, self.floor[window], inside & ~stands)
        behind = _behind(stands, inside, free, grid.cell)
        if not behind.any():
            return polygon
        corner = grid.origin + grid.cell * np.array([window[1].start, window[0].start])
        boxes = _steps(behind, inside) * grid.cell + np.tile(corner, 2)
        return _less(polygon, shapely.union_all(shapely.box(*boxes.T)), sliver)

    def along(self, start: tuple[float, float], end: tuple[float, float]) -> float:
        """Share of the line between two places, as near as a step is wide, beside which something stands."""
        grid = self.grid
        a, b = np.array(start), np.array(end)
        count = max(2, round(float(np.hypot(*(b - a))) / grid.cell) + 1)
        at = np.floor((np.linspace(a, b, count) - grid.origin) / grid.cell).astype(int)
        first = np.maximum(at.min(axis=0) - _STEP, 0)
        near = self.cells[first[1] : at[:, 1].max() + _STEP + 1, first[0] : at[:, 0].max() + _STEP + 1]
        for _ in range(_STEP):
            near = widened(near)
        i, j = np.clip((at - first).T, 0, np.array(near.shape)[::-1, None] - 1)
        return round(float(near[j, i].mean()), 4)


def _less(polygon: Any, other: Any, sliver: float) -> Any:
    """``polygon`` without ``other``; itself where nothing would be left."""
    rest = open_polygon(polygon.difference(other), sliver)
    return rest if polygons_of(rest) else polygon


def standing_cells(evidence: Evidence, grid: OccupancyGrid) -> StandingCells:
    """The cells of the grid whose columns are hit from below table height to above furniture."""
    found = by_strips(evidence.hits, _heights)
    around = [widened((found & part) != 0) for part in (_FOOT, _HEAD)]
    cells = ((found & _BODY) != 0) & around[0] & around[1]
    elsewhere = None if evidence.elsewhere is None else straight_outline(evidence)
    floor = (evidence.free & height_mask(*_BETWEEN)) != 0 if evidence.inferred else None
    return StandingCells(grid, cells, elsewhere, floor)


def _heights(hits: Bits) -> NDArray[np.uint8]:
    """Of each cell: whether something is at its foot, at its head, and all the way between."""
    columns, between = merged(hits), height_mask(*_BETWEEN)
    closed = np.bitwise_or.reduce([columns, *(columns << np.uint64(k) for k in _GAP)])
    full = count_bits(closed & between) >= _FULL * int(between).bit_count()
    ends = [np.where(columns & height_mask(*part) != 0, np.uint8(name), np.uint8(0)) for part, name in _ENDS]
    return np.asarray(ends[0] | ends[1] | np.where(full, _BODY, np.uint8(0)))


def _with_floor(free: Bool, floor: Bool, between: Bool) -> Bool:
    """``free`` without those parts of the cells ``between`` walls in which hardly any floor was seen.

    Free space is only guessed there, from places to stand on the other side of a gap in a wall.
    """
    label, count = label_patches(between)
    cells, seen = (np.bincount(label[m], minlength=count + 1) for m in (between, between & floor))
    return np.asarray(free & (seen >= _FLOORED * cells)[label])


def _behind(stands: Bool, inside: Bool, free: Bool, cell: float) -> Bool:
    """Cells of the pockets behind slanted walls, and of the walls."""
    out, beside = np.zeros_like(inside), widened(stands)
    label, boxes = measure_patches(inside & ~free & ~stands)
    for k in np.flatnonzero(boxes[:, 4] * cell**2 >= _LEAST).tolist():
        x, y, width, height = boxes[k, :4].tolist()
        around = slice(max(y - 1, 0), y + height + 1), slice(max(x - 1, 0), x + width + 1)
        pocket = label[around] == k + 1
        if not opened(np.pad(pocket, 1)).any():
            continue
        border = widened(pocket) & ~pocket & inside[around]
        wall = border & stands[around]
        if (border & beside[around]).sum() < _BORDER * border.sum():
            continue
        if _is_slanted(np.argwhere(wall).astype(np.float64) * cell):
            out[around] |= pocket | wall
    return out


def _is_slanted(at: Float) -> bool:
    """True where most of the places (N, 2) are in lines at an angle to the axes, and far enough apart."""
    parts = np.array_split(at, len(at) // _AT_ONCE + 1)
    angled = np.concatenate([_are_angled(part, at) for part in parts])
    if angled.mean() < _ANGLED:
        return False
    extent = np.ptp(at[angled], axis=0)
    return bool(np.hypot(*extent) >= _LONG and extent.min() >= _DEEP)


def _are_angled(part: Float, at: Float) -> Bool:
    """(M,) of some of the places: do those around each lie in a line at an angle to the axes."""
    near = ((part[:, None] - at[None]) ** 2).sum(axis=2) <= _AROUND**2
    count = near.sum(axis=1)
    mean = near @ at / count[:, None]
    square = near @ (at[:, :, None] * at[:, None]).reshape(-1, 4) / count[:, None]
    c = square - (mean[:, :, None] * mean[:, None]).reshape(-1, 4)
    turn = 0.5 * np.arctan2(2 * c[:, 1], c[:, 0] - c[:, 3])
    whole, apart = c[:, 0] + c[:, 3], np.hypot(c[:, 0] - c[:, 3], 2 * c[:, 1])  # of its variances
    slanted = np.abs((turn + np.pi / 4) % (np.pi / 2) - np.pi / 4) > _SLANT
    # No line: the end of a straight front, which turns to the wall.
    return np.asarray(slanted & (apart > _LINE * whole))


def _steps(behind: Bool, inside: Bool) -> NDArray[np.int64]:
    """(B, 4) columns and rows of the blocks, of which most that is inside lies behind."""
    ny, nx = (-(-n // _STEP) * _STEP for n in behind.shape)

    def summed(mask: Bool) -> NDArray[np.int64]:
        whole = np.zeros((ny, nx), dtype=np.int64)
        whole[: mask.shape[0], : mask.shape[1]] = mask
        return np.asarray(whole.reshape(ny // _STEP, _STEP, nx // _STEP, _STEP).sum(axis=(1, 3)))

    j, i = np.nonzero(2 * summed(behind) > summed(inside))
    return np.column_stack([i, j, i + 1, j + 1]) * _STEP

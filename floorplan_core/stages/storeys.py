"""Storeys of one survey, found from its floors and ceilings (the paper has one storey and does not say).

In: surfels of the whole survey and the Manhattan frame. Out: :class:`Storey`, lowest first; one for nearly
every survey. A storey ends at a *slab*: a ceiling with the floor of the next storey closely above it, or a
single level where only one of the two was seen. What else is horizontal is no slab: below a slab there is a
floor of its own, above it a ceiling or walls, under (over) the same places. A table or a raised floor has no
room below, a suspended ceiling none above, a gallery covers too little. Slabs at different heights that lie
beside each other are one: the halves of a split-level house, whose storeys then have a step.
Cost: one pass over the surfels, and nothing for surveys that are too low for two storeys.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import StoreysConfig
from floorplan_core.geometry.cell_normals import fit_cell_normals
from floorplan_core.geometry.surfel_map import SurfelMap, Surfels
from floorplan_core.model import ManhattanFrame
from floorplan_core.model.storey import HeightMap, Storey, heading
from floorplan_core.stages.manhattan_frame import floor_and_ceiling
from floorplan_core.stages.slab_faces import inner_faces
from floorplan_core.stages.slabs import Level, Slab, with_half_levels

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

_COLUMN = 0.5  # m, cells of the plan in which levels are compared: wider than the holes of a scan
_PATCH = 0.25  # m, cells in which normals are fitted
_PLANARITY = 0.15  # largest ratio of a patch's thickness to its width
_BIN = 0.05  # m of height
_APART = 0.12  # m between levels: a thin slab still has two
_LEVEL_REACH = 0.06  # m from a level's height up to which patches count for its height
_SEEN_REACH = 0.12  # m, and for where it was seen
_LEVEL_SHARE = 0.1  # of the largest level: smaller ones are no slabs, only tables, landings and sills
_OVERLAP = 0.3  # share of the smaller of two levels that lies over the other
_WALL_SHARE = 0.4  # of the walls below a slab that must stand above it where no ceiling was seen there
_BESIDE = 0.2  # share of overlap up to which two slabs lie beside each other
_FLAT, _STEEP = math.cos(math.radians(20)), math.sin(math.radians(15))  # |z| of normals of floors and walls
_WALL_BAND = (0.3, 2.2)  # m from a floor, where walls are looked for
_SHARP = 0.1  # m, cells in which a place has the height of the nearest level
_LIKE = 0.3  # m: floors that differ by less are one
_PIECE = 1 << 20  # surfels that are looked at together
_ENDS = (0.002, 0.998)  # quantiles of height: the rest are ghosts


def is_tall(surfels: Surfels, frame: ManhattanFrame, config: StoreysConfig) -> bool:
    """True where two storeys would fit between the lowest and the highest surfels (a sample is enough)."""
    z = surfels.centroid @ frame.rotation[2]
    if not np.ptp(z) > 2 * config.min_height:  # nearly every survey: ghosts and all
        return False
    low, high = np.quantile(z, _ENDS, overwrite_input=True)
    return bool(high - low > 2 * config.min_height)


def find_storeys(surfels: Surfels, frame: ManhattanFrame, config: StoreysConfig) -> tuple[Storey, ...]:
    """All storeys, lowest first; ``surfels`` are those of the whole survey, not a sample."""
    only = _only_storey(frame)
    if not is_tall(surfels, frame, config):
        return (only,)
    raster = _Raster.of(surfels, frame)
    slabs = [] if raster is None else _slabs(raster, config)
    if raster is None or not slabs:
        return (only,)
    xyz = surfels.centroid @ frame.rotation.T
    plain = _between(slabs, only, raster)
    measured = [_with_levels(s, surfels, s.holds(xyz), frame) for s in plain]
    stepped = with_half_levels(slabs, raster.levels(), config.min_height)
    ends = _between(stepped, only, raster)
    bare = [replace(s, bottom=e.bottom, top=e.top) for s, e in zip(measured, ends, strict=True)]
    return tuple(_with_steps(s, stepped, raster) for s in bare)


def _between(slabs: list[list[Slab]], only: Storey, raster: _Raster) -> list[Storey]:
    """The storeys that the slabs part."""
    below, above = HeightMap.constant(-np.inf), HeightMap.constant(np.inf)
    bottoms = [below, *(raster.map([(s, s.lower_end) for s in group]) for group in slabs)]
    tops = [*(raster.map([(s, s.upper_end) for s in group]) for group in slabs), above]
    return [
        replace(only, number=k, bottom=b, top=t) for k, (b, t) in enumerate(zip(bottoms, tops, strict=True))
    ]


def restrict_surfels(surfels: SurfelMap, frame: ManhattanFrame, storey: Storey) -> SurfelMap:
    """The surfels of one storey."""
    storey = storey.along(frame)
    inside = [storey.holds(piece.centroid @ frame.rotation.T) for piece in surfels.pieces(_PIECE)]
    return surfels.select(np.flatnonzero(np.concatenate(inside)))


def restrict_path(path: Float, frame: ManhattanFrame, storey: Storey) -> Float:
    """The (M, 3) sensor positions, local frame, that lie in one storey."""
    return path[storey.along(frame).holds(frame.to_manhattan(path))] if len(path) else path


def _with_steps(storey: Storey, slabs: list[list[Slab]], raster: _Raster) -> Storey:
    """``storey`` with the heights of its floor everywhere, where parts of it lie higher or lower."""
    k = storey.number
    floors = [(s, s.floor) for s in slabs[k - 1] if not s.roof] if k else []
    if k < len(slabs):
        floors += [(s, s.under) for s in slabs[k] if s.under is not None and (s.roof or not k)]
    floors = [(s, z if abs(z - storey.floor_z) > _LIKE else storey.floor_z) for s, z in floors]
    if all(z == storey.floor_z for _, z in floors):
        return storey
    return replace(storey, floors=raster.map(floors))


def _only_storey(frame: ManhattanFrame) -> Storey:
    low, high = HeightMap.constant(-np.inf), HeightMap.constant(np.inf)
    return Storey(0, frame.floor_z, frame.ceiling_z, low, high, heading=heading(frame))


def _with_levels(storey: Storey, surfels: Surfels, inside: Mask, frame: ManhattanFrame) -> Storey:
    """``storey`` with the heights of its own floor and ceiling."""
    part = replace(
        surfels,
        centroid=surfels.centroid[inside],
        count=surfels.count[inside],
        variance=surfels.variance[inside],
        view=surfels.view[inside],
    )
    normals = fit_cell_normals(part.centroid, _PATCH, _PLANARITY)
    levels = floor_and_ceiling(part, normals, frame.rotation)
    floor, ceiling = inner_faces(part, frame.rotation, *levels)
    return replace(storey, floor_z=floor, ceiling_z=ceiling)


@dataclass(frozen=True)
class _Raster:
    """Patches of horizontal and vertical surface over the cells of the plan."""

    origin: Float  # (2,) metres, manhattan frame
    shape: tuple[int, int]  # ny, nx
    flat_cell: NDArray[np.int64]  # (F,) cell of each horizontal patch
    flat_z: Float  # (F,) metres
    flat_xy: Float  # (F, 2) its middle, metres
    wall_cell: NDArray[np.int64]  # (W,) of each vertical patch
    wall_z: Float  # (W,)

    @staticmethod
    def of(surfels: Surfels, frame: ManhattanFrame) -> _Raster | None:
        """From the planar cells of the survey, once more with cells half a cell higher: where both faces
        of a thin slab lie in one cell, it is not planar, and the next cell up parts them. None without."""
        patches = []
        for lift in (np.zeros(3), np.array([0.0, 0.0, _PATCH / 2])):
            found = fit_cell_normals(surfels.centroid + lift, _PATCH, _PLANARITY, most=len(surfels))
            patches.append((found.normal @ frame.rotation[2], (found.centre - lift) @ frame.rotation.T))
        upright = np.abs(np.concatenate([p[0] for p in patches]))
        xyz = np.concatenate([p[1] for p in patches])
        if len(xyz) == 0:
            return None
        origin = np.floor(xyz[:, :2].min(axis=0) / _COLUMN) * _COLUMN
        index = ((xyz[:, :2] - origin) / _COLUMN).astype(np.int64)
        nx, ny = (int(n) + 1 for n in index.max(axis=0))
        cell, flat, wall = index[:, 1] * nx + index[:, 0], upright > _FLAT, upright < _STEEP
        return _Raster(origin, (ny, nx), cell[flat], xyz[flat, 2], xyz[flat, :2], cell[wall], xyz[wall, 2])

    def level(self, z: float) -> Level:
        """The horizontal surface around a height."""
        near = np.abs(self.flat_z - z) < _LEVEL_REACH
        seen = np.abs(self.flat_z - z) < _SEEN_REACH
        return Level(float(self.flat_z[near].mean()) if near.any() else z, self._mask(self.flat_cell[seen]))

    def levels(self) -> list[Level]:
        """The large horizontal surfaces, rising."""
        if len(self.flat_z) == 0:
            return []
        low = float(self.flat_z.min()) - _BIN
        bins = ((self.flat_z - low) / _BIN).astype(np.int64)
        pairs = np.unique(bins * (self.shape[0] * self.shape[1]) + self.flat_cell)
        counts = np.bincount(pairs // (self.shape[0] * self.shape[1]), minlength=int(bins.max()) + 3)
        smooth = np.convolve(counts, np.ones(3), mode="same")
        chosen: list[int] = []
        for k in np.argsort(-smooth, kind="stable").tolist():
            if smooth[k] < _LEVEL_SHARE * smooth.max():
                break
            if all(abs(k - other) * _BIN > _APART for other in chosen):
                chosen.append(k)
        return [self.level(low + (k + 0.5) * _BIN) for k in sorted(chosen)]

    def walls(self, low: float, high: float, where: Mask) -> int:
        """Vertical patches between two heights, over the cells ``where``."""
        between = (self.wall_z > low) & (self.wall_z < high)
        return int(np.count_nonzero(where.ravel()[self.wall_cell[between]]))

    def map(self, pieces: list[tuple[Slab, float]]) -> HeightMap:
        """Everywhere the height that goes with the nearest of the slabs."""
        if len({height for _, height in pieces}) == 1:
            return HeightMap.constant(pieces[0][1])
        from scipy.ndimage import distance_transform_edt

        fine = round(_COLUMN / _SHARP)
        owner = np.full((fine * self.shape[0], fine * self.shape[1]), -1)
        for k, (slab, _) in enumerate(pieces):
            inside = slab.seen.ravel()[self.flat_cell] & slab.is_at(self.flat_z, _SEEN_REACH)
            ix, iy = np.floor((self.flat_xy[inside] - self.origin) / _SHARP).astype(np.int64).T
            owner[iy, ix] = k
        _, (iy, ix) = distance_transform_edt(owner < 0, return_indices=True)
        height = np.array([height for _, height in pieces])[owner[iy, ix]]
        return HeightMap(height, (float(self.origin[0]), float(self.origin[1])), _SHARP)

    def _mask(self, cells: NDArray[np.int64]) -> Mask:
        mask = np.zeros(self.shape, dtype=bool)
        mask.ravel()[cells] = True
        return mask


def _slabs(raster: _Raster, config: StoreysConfig) -> list[list[Slab]]:
    """Between each storey and the next: the slab, in pieces where it has steps. Lowest first."""
    levels = raster.levels()
    least = config.min_share * max((level.size for level in levels), default=0)
    found = [
        slab
        for c in levels
        for f in levels
        if 0 <= f.z - c.z <= config.max_slab and (slab := _slab(c, f, levels, raster, config, least))
    ]
    # two levels are better than one, more common ground is better than less, ties go to the lower slab
    found.sort(key=lambda s: (s.ceiling == s.floor, -s.common, s.ceiling))
    chosen: list[Slab] = []
    for slab in found:
        if not any(_same_place(slab, other, config.min_height) for other in chosen):
            chosen.append(slab)
    return _grouped(sorted(chosen, key=lambda s: s.floor), config.min_height)


def _slab(
    c: Level, f: Level, levels: list[Level], raster: _Raster, config: StoreysConfig, least: float
) -> Slab | None:
    """The slab between two levels (or of one), where there is a room below and a room above it."""
    common = c.seen & f.seen
    if min(c.size, f.size) < least or _overlap(c, f) < _OVERLAP:
        return None
    floors = [b for b in levels if b.z <= c.z - config.min_height and _overlap(b, c) >= _OVERLAP]
    has_ceiling = any(a.z >= f.z + config.min_height and _overlap(a, f) >= _OVERLAP for a in levels)
    if not floors or not (has_ceiling or _walls_above(c, f, raster)):
        return None
    under = max(floors, key=lambda b: int(np.count_nonzero(b.seen & c.seen)))  # the lowest of equals
    return Slab(c.z, f.z, c.seen | f.seen, int(np.count_nonzero(common)), under.z)


def _walls_above(c: Level, f: Level, raster: _Raster) -> bool:
    """True where walls stand above a slab as they do below it."""
    from scipy.ndimage import binary_dilation

    near, far = _WALL_BAND
    where = binary_dilation(c.seen | f.seen)
    above, below = raster.walls(f.z + near, f.z + far, where), raster.walls(c.z - far, c.z - near, where)
    return above > _WALL_SHARE * below > 0


def _overlap(a: Level, b: Level) -> float:
    """Common cells of two levels, as a share of the smaller."""
    return int(np.count_nonzero(a.seen & b.seen)) / max(1, min(a.size, b.size))


def _same_place(a: Slab, b: Slab, height: float) -> bool:
    """True where no storey fits between two slabs, one above the other."""
    smaller = min(int(np.count_nonzero(a.seen)), int(np.count_nonzero(b.seen)))
    beside = int(np.count_nonzero(a.seen & b.seen)) <= _BESIDE * smaller
    return abs(a.floor - b.floor) < height and not beside


def _grouped(slabs: list[Slab], height: float) -> list[list[Slab]]:
    """Rising slabs; those that lie beside each other at nearly the same height are one with steps."""
    groups: list[list[Slab]] = []
    for slab in slabs:
        if groups and slab.floor - groups[-1][0].floor < height:
            groups[-1].append(slab)
        else:
            groups.append([slab])
    return groups

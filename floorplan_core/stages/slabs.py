"""What parts a storey from the next: slabs, and the roofs and floors of half levels beside them.

A half level lies beside a slab, at a height between the floors that the slab parts: the cut at the slab
would go through its room. It belongs to the storey whose floor is nearest in height, to the lower one of
equals, and the cut goes over or under it. A hall open over several storeys belongs to that of its floor.
In: horizontal levels and the slabs found among them. Out: slabs with the pieces that the cut steps to.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.masks import label_patches, opened

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

_THICK = 0.12  # m, a thinner slab has only one level: both storeys get its points
_MARGIN = 0.06  # m around such a level: its noise
_LEAST = 32  # cells of 0.5 m of a half level or a hall: 8 m2; a stairwell has less without treads
_ROOFED = 0.3  # share of these over which a ceiling was seen
_HALF = 0.8  # m from the floors of both storeys: a half level, though nothing above it was seen
_EQUAL = 0.1  # m: two storeys are as near as each other


@dataclass(frozen=True)
class Level:
    """A horizontal surface: where it was seen, and how high."""

    z: float
    seen: Mask  # (ny, nx)

    @property
    def size(self) -> int:
        return int(np.count_nonzero(self.seen))


@dataclass(frozen=True)
class Slab:
    """Ceiling of one storey and floor of the next."""

    ceiling: float
    floor: float
    seen: Mask  # (ny, nx) where either was seen
    common: int  # cells in which both were
    under: float | None = None  # height of the floor below it
    roof: bool = False  # True: nothing of the next storey is above it

    @property
    def lower_end(self) -> float:
        """Height at which the storey above begins."""
        return self.ceiling - _MARGIN if self.floor - self.ceiling < _THICK else self.middle

    @property
    def upper_end(self) -> float:
        """Height at which the storey below ends."""
        return self.floor + _MARGIN if self.floor - self.ceiling < _THICK else self.middle

    @property
    def middle(self) -> float:
        return (self.ceiling + self.floor) / 2

    def is_at(self, z: Float, reach: float) -> Mask:
        """(N,) which of the heights are those of its faces, or of the floor of the room whose roof it is."""
        heights = (self.ceiling, self.floor, *((self.under,) if self.roof and self.under is not None else ()))
        return np.asarray(np.any([np.abs(z - h) < reach for h in heights], axis=0))


def with_half_levels(groups: list[list[Slab]], levels: list[Level], height: float) -> list[list[Slab]]:
    """Each slab with the pieces that the cut steps to; ``groups`` and ``levels`` rise.

    :param height: metres from a floor to the ceiling above it at least.
    """
    if not groups:
        return groups
    main = [max(group, key=lambda s: int(np.count_nonzero(s.seen))) for group in groups]
    floors = [float(main[0].under or 0.0), *(s.floor for s in main)]
    return [
        [*group, *_pieces(k, main[k].middle, group, levels, floors, height)] for k, group in enumerate(groups)
    ]


def _pieces(
    k: int, cut: float, slabs: list[Slab], levels: list[Level], floors: list[float], height: float
) -> Iterator[Slab]:
    """What stands through the cut above storey ``k``: rooms with a floor below it and a ceiling above it, or
    none where their floor is that of neither storey."""
    taken = np.any([s.seen for s in slabs], axis=0)
    for f in (level for level in levels if level.z < cut):
        lower = [level.seen for level in levels if f.z < level.z < cut]
        cells = _rooms(f.seen & ~np.any([taken, *lower], axis=0))
        roofs = [
            c
            for c in levels
            if c.z > max(cut, f.z + height) and (c.seen & cells).sum() > _ROOFED * cells.sum()
        ]
        apart = [abs(f.z - z) for z in floors]
        if not cells.any() or not (roofs or min(apart) > _HALF):  # a ceiling may just be unseen
            continue
        owner = next(n for n, d in enumerate(apart) if d < min(apart) + _EQUAL)
        if owner <= k:
            top = roofs[0].z if roofs else f.z + cut - floors[k]  # as high as the storey
            yield Slab(top, top, cells, 0, f.z, roof=True)
        else:
            yield Slab(f.z, f.z, cells, 0)


def _rooms(cells: Mask) -> Mask:
    """The patches that are as large and wide as a room."""
    label, count = label_patches(opened(np.pad(cells, 1))[1:-1, 1:-1])
    sizes = np.bincount(label.ravel(), minlength=count + 1)
    sizes[0] = 0
    return np.asarray(sizes[label] >= _LEAST)

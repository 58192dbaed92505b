"""The surfels between skirting and ceiling, and from which sides each was seen: what segments are made of.

In: :class:`Evidence`. Out: rows of its surfels with their column, their level and the facings that each can
belong to: those to whose side its sensors were, or without sensors, those before which there is free space.
Floor and ceiling, most of all surfels, are passed over once here. Cost: linear in surfels.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.columns import LEVEL, by_strips, height_mask
from floorplan_core.geometry.halves import in_halves
from floorplan_core.model import Facing
from floorplan_core.model.evidence import Evidence

_WORTH = 200_000  # surfels from which two threads are faster than one
_HEAD = 2.0  # m above the floor: what hangs higher, a beam along a wall, does not stand before it
_SKIN = 1  # cells before a surface that its own noise may fill
_SIDEWAYS = 0.03  # cosine of the steepest view that still tells from which side a surfel was seen


@dataclass(frozen=True)
class UprightSurfels:
    """Rows of the surfels of walls and of all else that stands between floor and ceiling."""

    evidence: Evidence
    band: np.uint64  # the levels that they lie in
    row: NDArray[np.int32]  # (N,) of the evidence's surfels, ascending
    column: NDArray[np.int32]  # (N, 2) fine column, along x and y
    level: NDArray[np.uint8]  # (N,)
    seen_from: NDArray[np.uint8]  # (N,) bit k: from the side of ``Facing(k)``

    def of(self, facing: Facing) -> NDArray[np.bool_]:
        """(N,) True for those that belong to a surface of this facing."""
        if self.evidence.viewpoints:
            return np.asarray(self.seen_from & np.uint8(1 << facing) != 0)
        return self._before_free_space(facing, 0)

    def surely_of(self, facing: Facing) -> NDArray[np.bool_]:
        """The same for measuring: noise just before a surface is no free space behind the other face."""
        return self.of(facing) if self.evidence.viewpoints else self._before_free_space(facing, _SKIN)

    def _before_free_space(self, facing: Facing, skin: int) -> NDArray[np.bool_]:
        """(N,) True where the space in front is open: free there, or at least not free behind.

        ``skin`` cells just in front may hold the surface's own noise.
        """
        at = self.column[:, 0], self.column[:, 1]
        return np.asarray(_first_in_front(*at, facing.axis, facing.sign, skin, *self.around))

    @cached_property
    def around(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Fine columns that hold a wall, and coarse ones that are free."""
        low, body = self.band & height_mask(0.0, _HEAD), height_mask(0.5, 1.9)
        tall = by_strips(self.evidence.hits, lambda hits: np.bitwise_count(hits & low) >= 4)
        return tall, by_strips(self.evidence.free, lambda free: (free & body) != 0)


def upright_surfels(evidence: Evidence, low: float, band: np.uint64) -> UprightSurfels:
    """Those higher than ``low`` metres and not above the levels of ``band``, within the grid."""
    ny, nx = evidence.hits.shape
    high = LEVEL * int(band).bit_length()
    parts: dict[int, tuple[NDArray[Any], ...]] = {}

    def look_at(start: int, stop: int) -> None:
        xyz, view = evidence.xyz[start:stop], evidence.view[start:stop]
        row, *rest = _upright(xyz, view, low, high, evidence.origin, evidence.fine, ny, nx)
        parts[start] = row + np.int32(start), *rest

    in_halves(look_at, len(evidence.xyz), _WORTH)
    found = (np.concatenate(part) for part in zip(*(parts[k] for k in sorted(parts)), strict=True))
    return UprightSurfels(evidence, band, *found)


@njit(cache=True, nogil=True)
def _upright(xyz, view, low, high, origin, cell, ny, nx):  # type: ignore[no-untyped-def]
    """Row, column, level and sides of the surfels with ``low < z < high``."""
    n = len(xyz)  # memory that is not written is not taken
    row, column = np.empty(n, dtype=np.int32), np.empty((n, 2), dtype=np.int32)
    level, seen = np.empty(n, dtype=np.uint8), np.empty(n, dtype=np.uint8)
    k = 0
    for i in range(n):
        if not low < xyz[i, 2] < high:
            continue
        ix, iy = int(np.floor((xyz[i, 0] - origin[0]) / cell)), int(np.floor((xyz[i, 1] - origin[1]) / cell))
        if not (0 <= ix < nx and 0 <= iy < ny):
            continue
        row[k], column[k, 0], column[k, 1] = i, ix, iy
        level[k] = int(np.floor(xyz[i, 2] / LEVEL))
        seen[k] = (
            (view[i, 0] >= _SIDEWAYS)
            | (-view[i, 0] >= _SIDEWAYS) << 1
            | (view[i, 1] >= _SIDEWAYS) << 2
            | (-view[i, 1] >= _SIDEWAYS) << 3
        )
        k += 1
    return row[:k], column[:k], level[:k], seen[:k]


@njit(cache=True, nogil=True)
def _first_in_front(ix, iy, axis, sign, skin, tall, free):  # type: ignore[no-untyped-def]
    out = np.zeros(len(ix), dtype=np.bool_)
    ny, nx = tall.shape
    seen = np.zeros(2, dtype=np.bool_)  # free space in front, behind
    open_ = np.zeros(2, dtype=np.bool_)  # no wall within reach in front, behind
    for i in range(len(ix)):
        for side in range(2):
            seen[side], open_[side] = False, True
            for step in range(1, 9):
                away = sign * step if side == 0 else -sign * step
                jx, jy = (ix[i] + away, iy[i]) if axis == 0 else (ix[i], iy[i] + away)
                if jx < 0 or jx >= nx or jy < 0 or jy >= ny or (step > skin and tall[jy, jx]):
                    open_[side] = seen[side]
                    break
                if free[jy // 2, jx // 2]:
                    seen[side] = True
                    break
        out[i] = seen[0] or (open_[0] and not seen[1])
    return out

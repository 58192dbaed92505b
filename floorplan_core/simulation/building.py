"""A building as data: spaces, openings, furniture. Metres, the building's own axes, floor at z = 0."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


def _no_solids() -> Float:
    return np.zeros((0, 7))


@dataclass(frozen=True)
class Space:
    """A room or the corridor network: a union of rectangles bounded by interior wall faces."""

    kind: str  # "room" or "corridor"
    use: str  # "office", "bathroom", "hall", "corridor", ...
    rects: Float  # (K, 4) x0, y0, x1, y1, metres
    host: int = -1  # index of the space that a nested room opens into; -1: the corridor

    @property
    def polygon(self) -> Any:
        """Shapely polygon of the floor (holes where the circulation rings around a core)."""
        import shapely

        return shapely.union_all(shapely.box(*self.rects.T)).simplify(0.0)

    @property
    def area(self) -> float:
        """m2 of floor."""
        return float(self.polygon.area)


@dataclass(frozen=True)
class DoorOpening:
    """A hole in the wall between two spaces, from the floor to the lintel."""

    bounds: tuple[float, float, float, float]  # x0, y0, x1, y1: width times wall thickness
    axis: int  # axis of the wall's normal: 0 the wall runs along y, 1 along x
    joins: tuple[int, int]  # indices of the spaces; the leaf opens into the second
    height: float  # metres, floor to lintel
    kind: str  # "door", "double" or "opening" (no leaf)
    open: bool
    leaves: Float = field(default_factory=_no_solids)  # (K, 7) solids: leaves and frame

    @property
    def width(self) -> float:
        """Clear width in metres."""
        return self.bounds[3 - self.axis] - self.bounds[1 - self.axis]


@dataclass(frozen=True)
class WindowOpening:
    """A glazed hole in an exterior wall."""

    bounds: tuple[float, float, float, float]
    axis: int  # axis of the wall's normal
    space: int
    sill: float  # metres above the floor
    head: float  # metres above the floor


@dataclass(frozen=True)
class Furniture:
    """One piece; ``solids`` are (K, 7) x0, y0, z0, x1, y1, z1, yaw (radians about the solid's own middle)."""

    kind: str
    space: int
    solids: Float

    @property
    def bounds(self) -> Float:
        """(6,) axis-aligned hull x0, y0, z0, x1, y1, z1."""
        hull = solid_hulls(self.solids)
        return np.concatenate([hull[:, :3].min(axis=0), hull[:, 3:].max(axis=0)])


@dataclass(frozen=True)
class Building:
    """Everything that a sensor can hit, and what it is called. The spaces never overlap."""

    spaces: tuple[Space, ...]  # the first is the corridor network
    doors: tuple[DoorOpening, ...]
    windows: tuple[WindowOpening, ...]
    furniture: tuple[Furniture, ...]
    columns: Float  # (K, 4) x0, y0, x1, y1, floor to ceiling
    height: float  # metres, floor to ceiling
    interior_wall: float  # metres
    exterior_wall: float  # metres

    @property
    def rects(self) -> Float:
        """(N, 4) the rectangles of all spaces."""
        return np.vstack([space.rects for space in self.spaces])

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 of the outer wall faces, metres."""
        lo, hi = self.rects[:, :2].min(axis=0), self.rects[:, 2:].max(axis=0)
        t = self.exterior_wall
        return float(lo[0] - t), float(lo[1] - t), float(hi[0] + t), float(hi[1] + t)


def solid_hulls(solids: Float) -> Float:
    """(N, 6) axis-aligned hulls of (N, 7) solids."""
    middle, half = (solids[:, :3] + solids[:, 3:6]) / 2, (solids[:, 3:6] - solids[:, :3]) / 2
    c, s = np.abs(np.cos(solids[:, 6])), np.abs(np.sin(solids[:, 6]))
    turned = np.column_stack([c * half[:, 0] + s * half[:, 1], s * half[:, 0] + c * half[:, 1], half[:, 2]])
    return np.hstack([middle - turned, middle + turned])

"""What is drawn beside points: translucent triangles and lines as arrays, and what collects them. No Qt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]

OPAQUE = 256


@dataclass(frozen=True)
class Surfaces:
    """Translucent triangles, drawn in order."""

    corners: Float  # (T, 3, 3) metres, scene frame
    colours: NDArray[np.uint32]  # (T,) 0xRRGGBB
    alphas: NDArray[np.uint32]  # (T,) 0 to 256
    hatches: NDArray[np.int64]  # (T,) pixels of a stripe; 0: solid
    owners: NDArray[np.int64]  # (T,) rows of the scene's items; -1: of none

    def far_to_near(self, forward: Float) -> Surfaces:
        """The same in the order in which they must be laid on each other; ties keep their order."""
        depth = self.corners.mean(axis=1) @ forward
        order = np.argsort(-depth, kind="stable")
        return Surfaces(*(getattr(self, name)[order] for name in _SURFACE_FIELDS))


@dataclass(frozen=True)
class Lines:
    """Straight lines in space."""

    ends: Float  # (L, 2, 3) metres, scene frame
    colours: NDArray[np.uint32]  # (L,)
    alphas: NDArray[np.uint32]  # (L,) 0 to 256
    widths: NDArray[np.int64]  # (L,) pixels


_SURFACE_FIELDS = ("corners", "colours", "alphas", "hatches", "owners")


class Builder:
    """Collects triangles and lines."""

    def __init__(self) -> None:
        self.surfaces: list[tuple[Float, int, int, int, int]] = []
        self.lines: list[tuple[Float, int, int, int]] = []

    def surface(self, triangles: Float, colour: int, alpha: int, owner: int, hatch: int = 0) -> None:
        """Add (T, 3, 3) triangles of one colour."""
        if len(triangles):
            self.surfaces.append((triangles, colour, alpha, hatch, owner))

    def line(self, ends: Float, colour: int, alpha: int = OPAQUE, width: int = 1) -> None:
        """Add (L, 2, 3) lines of one colour."""
        if len(ends):
            self.lines.append((ends, colour, alpha, width))

    def made_surfaces(self) -> Surfaces:
        """All triangles, in the order in which they came."""
        counts = [len(s[0]) for s in self.surfaces]
        corners = np.concatenate([s[0] for s in self.surfaces]) if counts else np.zeros((0, 3, 3))
        columns = [
            np.repeat(np.array([s[k] for s in self.surfaces], dtype=np.int64), counts) for k in (1, 2, 3, 4)
        ]
        return Surfaces(
            corners, columns[0].astype(np.uint32), columns[1].astype(np.uint32), columns[2], columns[3]
        )

    def made_lines(self) -> Lines:
        """All lines, in the order in which they came."""
        counts = [len(s[0]) for s in self.lines]
        ends = np.concatenate([s[0] for s in self.lines]) if counts else np.zeros((0, 2, 3))
        columns = [np.repeat(np.array([s[k] for s in self.lines], dtype=np.int64), counts) for k in (1, 2, 3)]
        return Lines(ends, columns[0].astype(np.uint32), columns[1].astype(np.uint32), columns[2])

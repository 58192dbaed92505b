"""Candidate rectangles and the chosen cover, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


@dataclass(frozen=True)
class CandidateSet:
    """The valid rectangles of R = Px x Py; k spans x_plus[i0] .. x_minus[i1], y_plus[j0] .. y_minus[j1]."""

    x_plus: Float  # sorted offsets of east-facing planes, metres, manhattan frame
    x_minus: Float  # sorted offsets of west-facing planes
    y_plus: Float  # sorted offsets of north-facing planes
    y_minus: Float  # sorted offsets of south-facing planes
    index: NDArray[np.int32]  # (K, 4) i0, i1, j0, j1
    total_cells: NDArray[
        np.int64
    ]  # (K,) A: free, occupied and unobserved cells (centre inside the rectangle)
    free_cells: NDArray[np.int64]  # (K,) cells of the universe
    enumerated: int = 0  # |R| = |Px| * |Py| before pruning

    def __len__(self) -> int:
        return len(self.index)

    def bounds(self) -> Float:
        """(K, 4) x0, y0, x1, y1 in metres, manhattan frame."""
        i = self.index
        return np.column_stack(
            [self.x_plus[i[:, 0]], self.y_plus[i[:, 2]], self.x_minus[i[:, 1]], self.y_minus[i[:, 3]]]
        )


@dataclass(frozen=True)
class RectangleCover:
    """The rectangles chosen, in the order in which they were chosen."""

    chosen: NDArray[np.int64]  # (C,) rows of the candidate set
    bounds: Float  # (C, 4) x0, y0, x1, y1 in metres, manhattan frame
    total_cells: NDArray[np.int64]  # (C,) A of each
    free_cells: NDArray[np.int64]  # (C,) cells of the universe in each
    gained: NDArray[np.int64]  # (C,) |R & D| when it was chosen
    uncovered: NDArray[np.bool_]  # (ny, nx) cells of the universe that no chosen rectangle covers

    def __len__(self) -> int:
        return len(self.chosen)

    @property
    def weight(self) -> int:
        """Sum of A over the chosen rectangles: what the cover minimises."""
        return int(self.total_cells.sum())

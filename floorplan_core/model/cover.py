"""Candidate rectangles and the chosen cover, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


@dataclass(frozen=True)
class CandidateSet:
    """The valid rectangles of R = Px x Py; (i0, i1, j0, j1) spans x_plus[i0] .. x_minus[i1] and
    y_plus[j0] .. y_minus[j1].

    They are kept in *families*, each of one corner (i0, j0) with a range of i1 times a range of j1: a
    corridor that n planes cross holds n^2 rectangles in n families. Rows count the members family by family;
    in a family i1 counts before j1.
    """

    x_plus: Float  # sorted offsets of east-facing planes, metres, manhattan frame
    x_minus: Float  # sorted offsets of west-facing planes
    y_plus: Float  # sorted offsets of north-facing planes
    y_minus: Float  # sorted offsets of south-facing planes
    families: NDArray[np.int32]  # (F, 6) i0, j0, first and end of i1, first and end of j1; disjoint
    enumerated: int = 0  # |R| = |Px| * |Py| before pruning
    quarters: int = 0  # quarter turns, counter-clockwise, from the axes of the offsets to those of the plan

    def __len__(self) -> int:
        return int(self.family_sizes().sum())

    def family_sizes(self) -> NDArray[np.int64]:
        """(F,) rectangles of each family."""
        f = self.families.astype(np.int64)
        return np.asarray((f[:, 3] - f[:, 2]) * (f[:, 5] - f[:, 4]))

    def index(self) -> NDArray[np.int32]:
        """(K, 4) i0, i1, j0, j1 of every rectangle: all of them are listed now."""
        sizes = self.family_sizes()
        own = np.repeat(self.families, sizes, axis=0)
        member = np.arange(len(own)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        i, j = np.divmod(member, np.maximum(own[:, 5] - own[:, 4], 1))
        return np.column_stack([own[:, 0], own[:, 2] + i, own[:, 1], own[:, 4] + j]).astype(np.int32)

    def bounds(self) -> Float:
        """(K, 4) x0, y0, x1, y1 in metres, manhattan frame, of every rectangle."""
        from floorplan_core.model.quarter_turns import turned_boxes

        i = self.index()
        own = [self.x_plus[i[:, 0]], self.y_plus[i[:, 2]], self.x_minus[i[:, 1]], self.y_minus[i[:, 3]]]
        return turned_boxes(np.column_stack(own), self.quarters)


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

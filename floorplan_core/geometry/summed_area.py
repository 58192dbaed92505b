"""Summed-area tables: the number of marked cells in any rectangle of a grid in four look-ups.

A cell belongs to the half-open interval [a, b) that holds its centre. Intervals that share an end therefore
share no cell, and a cell whose centre lies exactly on a line belongs to the upper (right) side of it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Int = NDArray[np.int64]


def summed_area(mask: NDArray[np.bool_]) -> Int:
    """(ny + 1, nx + 1) table of an (ny, nx) mask: ``table[r, c]`` cells are marked in rows < r, columns < c.

    >>> summed_area(np.array([[True, False], [True, True]])).tolist()
    [[0, 0, 0], [0, 1, 1], [0, 2, 3]]
    """
    table = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), dtype=np.int64)
    np.cumsum(mask, axis=0, dtype=np.int64, out=table[1:, 1:])
    np.cumsum(table[1:, 1:], axis=1, out=table[1:, 1:])
    return table


def count(table: Int, rows: tuple[int, int], columns: tuple[int, int]) -> int:
    """Marked cells in rows [r0, r1) and columns [c0, c1); nothing is marked beyond the grid."""
    r0, r1 = np.clip(rows, 0, table.shape[0] - 1)
    c0, c1 = np.clip(columns, 0, table.shape[1] - 1)
    if r1 <= r0 or c1 <= c0:
        return 0
    return int(table[r1, c1] - table[r0, c1] - table[r1, c0] + table[r0, c0])


def first_cells(offsets: Float, origin: float, cell: float) -> Int:
    """(P,) first cell of an unbounded row of cells whose centre is >= each offset (metres).

    Cells ``first_cells(a) .. first_cells(b) - 1`` are those with a centre in [a, b). The centre of cell ``i``
    is the float ``origin + cell * (i + 0.5)``; the division may round across it, hence the two corrections.
    """
    offsets = np.asarray(offsets, dtype=np.float64)
    index = np.ceil((offsets - origin) / cell - 0.5).astype(np.int64)
    index += origin + cell * (index + 0.5) < offsets
    index -= origin + cell * (index - 0.5) >= offsets
    return index

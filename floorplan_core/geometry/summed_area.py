"""Marked cells between lines, counted once for all rectangles that the lines bound.

A cell belongs to the half-open interval [a, b) that holds its centre. Intervals that share an end therefore
share no cell, and a cell whose centre lies exactly on a line belongs to the upper (right) side of it.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]
Int = NDArray[np.int64]


def block_counts(mask: NDArray[np.bool_], rows: Int, columns: Int) -> Int:
    """(len(rows) - 1, len(columns) - 1) marked cells between neighbouring lines, in one pass over the mask.

    :param rows: sorted indices of rows at which a block begins or ends; columns: likewise.

    >>> block_counts(np.array([[True, False], [True, True]]), np.array([0, 1, 2]), np.array([0, 2])).tolist()
    [[1], [2]]
    """
    cells = np.ascontiguousarray(mask, dtype=np.bool_).view(np.uint8)
    return np.asarray(_block_counts(cells, rows.astype(np.int64), columns.astype(np.int64)))


@njit(cache=True, nogil=True)
def _block_counts(cells: NDArray[np.uint8], rows: Int, columns: Int) -> Int:
    counts = np.zeros((max(len(rows) - 1, 0), max(len(columns) - 1, 0)), np.int64)
    band = np.empty(cells.shape[1], np.int32)
    for i in range(counts.shape[0]):
        band[:] = 0
        for r in range(rows[i], rows[i + 1]):
            for c in range(len(band)):
                band[c] += cells[r, c]
        for j in range(counts.shape[1]):
            for c in range(columns[j], columns[j + 1]):
                counts[i, j] += band[c]
    return counts


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

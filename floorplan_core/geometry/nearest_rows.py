"""Numbers that are nearest to given ones."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray


def nearest(values: NDArray[np.float64], rows: NDArray[np.float64], tolerance: float) -> NDArray[np.int32]:
    """(N,) index of the one of the (M,) rising ``rows`` nearest to each value, the earlier of two; else -1.

    -1 where none is within ``tolerance``. Values follow each other in most files: the place of the one
    before is tried first, so that a value costs a few comparisons instead of a search.
    """
    out = np.full(len(values), -1, dtype=np.int32)
    if len(rows):
        _nearest(values, rows, tolerance, out)
    return out


@njit(cache=True, nogil=True)
def _nearest(values, rows, tolerance, out):  # type: ignore[no-untyped-def]
    last = len(rows) - 1
    after = 0  # the first row that is not below the value; ``last`` + 1 where all are
    for i in range(len(values)):
        value = values[i]
        below = after == 0 or rows[after - 1] < value
        if not (below and (after > last or rows[after] >= value)):
            after = np.searchsorted(rows, value)
        middle = min(max(after, 1), max(last, 1))
        low, high = middle - 1, min(middle, last)
        best = high if abs(rows[high] - value) < abs(value - rows[low]) else low
        out[i] = best if abs(rows[best] - value) <= tolerance else -1

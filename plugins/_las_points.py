"""Kernels of the LAS reader: coordinates of records in one pass."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]


def scaled(records: NDArray[Any], scales: Float, offsets: Float) -> Float:
    """(N, 3) coordinates of packed records that begin with X, Y and Z as integers of 32 bits.

    ``scales`` and ``offsets`` are (3,); file coordinates.
    """
    out = np.empty((len(records), 3))
    raw = np.ascontiguousarray(records).view(np.uint8).reshape(len(records), records.dtype.itemsize)
    _scale(raw, np.asarray(scales, dtype=np.float64), np.asarray(offsets, dtype=np.float64), out)
    return out


@njit(cache=True, nogil=True)
def _scale(raw, scales, offsets, out):  # type: ignore[no-untyped-def]
    for i in range(len(raw)):
        for axis in range(3):
            value = np.uint32(0)
            for k in range(4):  # the compiler makes one load of them
                value |= np.uint32(raw[i, 4 * axis + k]) << np.uint32(8 * k)
            out[i, axis] = np.int32(value) * scales[axis] + offsets[axis]

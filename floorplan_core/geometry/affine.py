"""Points through an affine map in one pass.

A matrix product with three columns keeps all cores of a BLAS waiting for each other: it took thirty times the
CPU of this loop.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]


def moved(points: NDArray[Any], matrix: Float, offset: Float) -> Float:
    """(N, 3) ``matrix @ point + offset`` of (N, 3) points; what is not finite stays so."""
    out = np.empty((len(points), 3))
    native = points if points.dtype.isnative else points.astype(points.dtype.newbyteorder("="))
    _move(native, np.ascontiguousarray(matrix, dtype=np.float64), np.asarray(offset, dtype=np.float64), out)
    return out


@njit(cache=True, nogil=True)
def _move(points, matrix, offset, out):  # type: ignore[no-untyped-def]
    a, b, c = matrix[0, 0], matrix[0, 1], matrix[0, 2]
    d, e, f = matrix[1, 0], matrix[1, 1], matrix[1, 2]
    g, h, k = matrix[2, 0], matrix[2, 1], matrix[2, 2]
    for i in range(len(points)):
        x, y, z = np.float64(points[i, 0]), np.float64(points[i, 1]), np.float64(points[i, 2])
        out[i, 0] = a * x + b * y + c * z + offset[0]
        out[i, 1] = d * x + e * y + f * z + offset[1]
        out[i, 2] = g * x + h * y + k * z + offset[2]

"""Kernels of the LAS reader: coordinates of records that are no noise, in one pass."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]

_LOW_POINT, _HIGH_NOISE = 7, 18  # ASPRS classes
# Point formats 0 to 5 keep class and flags in one byte, those from 6 on in two.
_OLD = (("raw_classification", 0x1F), ("raw_classification", 0x80))
_NEW = (("classification", 0xFF), ("classification_flags", 0x04))


def unpack(records: NDArray[Any], scales: Float, offsets: Float, out: Float) -> tuple[int, NDArray[np.bool_]]:
    """Coordinates (G, 3) of the good ones of (N,) packed records into ``out``; G, and (N,) which are bad.

    Records begin with X, Y and Z as integers of 32 bits; ``scales`` and ``offsets`` are (3,) of the file.
    Bad are those classified as noise, or withheld.
    """
    fields: Any = records.dtype.fields
    told = [(fields[name][1], mask) for name, mask in (_NEW if _NEW[1][0] in fields else _OLD)]
    raw = np.ascontiguousarray(records).view(np.uint8).reshape(len(records), records.dtype.itemsize)
    bad = np.empty(len(records), dtype=np.bool_)
    scale, offset = np.asarray(scales, dtype=np.float64), np.asarray(offsets, dtype=np.float64)
    return _unpack(raw, np.array(told, dtype=np.int64), scale, offset, out, bad), bad


@njit(cache=True, nogil=True)
def _unpack(raw, told, scales, offsets, out, bad):  # type: ignore[no-untyped-def]
    good = 0
    for i in range(len(raw)):
        kind = raw[i, told[0, 0]] & told[0, 1]
        bad[i] = kind in (_LOW_POINT, _HIGH_NOISE) or (raw[i, told[1, 0]] & told[1, 1]) != 0
        if bad[i]:
            continue
        for axis in range(3):
            value = np.uint32(0)
            for k in range(4):  # the compiler makes one load of them
                value |= np.uint32(raw[i, 4 * axis + k]) << np.uint32(8 * k)
            out[good, axis] = np.int32(value) * scales[axis] + offsets[axis]
        good += 1
    return good

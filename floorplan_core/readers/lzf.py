"""LZF decompression (the format of Marc Lehmann's LibLZF), which PCD uses for ``binary_compressed``.

A control byte below 32 announces that many plus one literal bytes. Otherwise its upper three bits are a
length (7: one more byte adds to it) and its lower five with the next byte a distance back into the output,
from which length + 2 bytes are copied; copies may overlap what they write.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

LITERALS = 32
LONG = 7
MAX_EXPANSION = 88  # three bytes give at most 264


def decompress(
    data: NDArray[np.uint8], size: int, out: NDArray[np.uint8] | None = None
) -> NDArray[np.uint8] | None:
    """The ``size`` bytes that ``data`` holds (in ``out``), or None where it is damaged or of another size."""
    if size > len(data) * MAX_EXPANSION:
        return None
    out = np.empty(size, dtype=np.uint8) if out is None else out
    return out if _decompress(data, out) == size else None


@njit(cache=True, nogil=True)
def _decompress(data, out):  # type: ignore[no-untyped-def]
    """Bytes written, or -1 where the data is not LZF or does not fit."""
    read, write = 0, 0
    while read < len(data):
        control = int(data[read])
        read += 1
        if control < LITERALS:
            run = control + 1
            if read + run > len(data) or write + run > len(out):
                return -1
            for k in range(run):
                out[write + k] = data[read + k]
            read += run
            write += run
            continue
        length = control >> 5
        if length == LONG:
            if read >= len(data):
                return -1
            length += int(data[read])
            read += 1
        if read >= len(data):
            return -1
        start = write - (((control & 31) << 8) | int(data[read])) - 1
        read += 1
        length += 2
        if start < 0 or write + length > len(out):
            return -1
        for k in range(length):  # one by one: the copy may overlap what it writes
            out[write + k] = out[start + k]
        write += length
    return write

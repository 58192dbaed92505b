"""Units of length and up axes: how a file's coordinates become metres with z up."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

US_FOOT = 1200 / 3937  # metres, of the survey foot: 2 parts in a million, 60 cm in state plane coordinates
METRES_PER_UNIT = {"m": 1.0, "cm": 0.01, "mm": 0.001, "ft": 0.3048, "us-ft": US_FOOT}
UNIT_NAMES = {
    "m": "metres",
    "cm": "centimetres",
    "mm": "millimetres",
    "ft": "feet",
    "us-ft": "US survey feet",
}

# Rows of the proper rotations that turn a file's axes into z-up axes; z-up files stay as they are.
_UP_ROWS = {
    "z": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "-z": ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
    "y": ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "-y": ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
    "x": ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
    "-x": ((0, 1, 0), (0, 0, -1), (-1, 0, 0)),
}
UP_AXES = tuple(_UP_ROWS)


def metres_per_unit(unit: str) -> float:
    """Metres in one ``unit`` ("m", "cm", "mm", "ft" or "us-ft"); KeyError for another word.

    >>> metres_per_unit("ft")
    0.3048
    """
    return METRES_PER_UNIT[unit]


def up_rotation(up: str, mirrored: bool = False) -> NDArray[np.float64]:
    """(3, 3) rotation from axes whose up is ``up`` ("x", "-y", ...) to z-up axes; proper unless ``mirrored``.

    The axes of a mirrored (left-handed) file become right-handed: y of the result is reversed.

    >>> (up_rotation("y") @ [0.0, 1.0, 0.0]).tolist()
    [0.0, 0.0, 1.0]
    """
    rows = np.array(_UP_ROWS[up], dtype=np.float64)
    if mirrored:
        rows[1] = 0.0 - rows[1]
    return rows

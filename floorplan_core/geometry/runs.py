"""Runs of True in a row of cells."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def runs_of(mask: NDArray[Any]) -> NDArray[np.int64]:
    """(K, 2) first cell of each run of True, and the first cell after it."""
    padded = np.zeros(len(mask) + 2, dtype=bool)
    padded[1:-1] = mask
    return np.asarray(np.flatnonzero(padded[1:] != padded[:-1]).reshape(-1, 2), dtype=np.int64)

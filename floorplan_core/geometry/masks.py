"""Masks of a regular grid (row = y, column = x): patches, distances, widening.

By OpenCV, which is imported late (docs/decisions/0024-opencv.md). Cost of each: linear in the cells. The
results do not depend on the number of threads.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Bool = NDArray[np.bool_]
Float = NDArray[np.float64]
Labels = NDArray[np.int32]

_SQUARE = np.ones((3, 3), dtype=np.uint8)  # a cell and its eight neighbours
_MASK_SIZE = 5  # cells across that a distance is composed of: within 2 % of the Euclidean one


def label_patches(mask: Bool, connectivity: int = 4) -> tuple[Labels, int]:
    """The connected patches of ``mask``.

    :param connectivity: 4 or 8: do cells that touch at a corner only belong together.
    :return: (ny, nx) numbers from 1 in row order of the first cell, 0 outside; the number of patches.
    """
    import cv2

    if mask.size == 0:
        return np.zeros(mask.shape, dtype=np.int32), 0
    # Of OpenCV's algorithms the one that numbers by rows, whatever the connectivity.
    count, labels = cv2.connectedComponentsWithAlgorithm(_image(mask), connectivity, cv2.CV_32S, cv2.CCL_SAUF)
    return labels, count - 1


def measure_patches(mask: Bool, connectivity: int = 4) -> tuple[Labels, NDArray[np.int32]]:
    """:func:`label_patches`, and (count, 5) x, y, width, height and number of cells of each patch."""
    import cv2

    if mask.size == 0:
        return np.zeros(mask.shape, dtype=np.int32), np.zeros((0, 5), dtype=np.int32)
    _, labels, stats, _ = cv2.connectedComponentsWithStatsWithAlgorithm(
        _image(mask), connectivity, cv2.CV_32S, cv2.CCL_SAUF
    )
    return labels, stats[1:]  # the first is what is in no patch


def widened(mask: Bool) -> Bool:
    """``mask`` and the eight neighbours of its cells."""
    import cv2

    return _mask(cv2.dilate(_image(mask), _SQUARE)) if mask.size else mask.copy()


def opened(mask: Bool) -> Bool:
    """``mask`` without its parts narrower than three cells; beyond the grid counts as filled."""
    import cv2

    return _mask(cv2.morphologyEx(_image(mask), cv2.MORPH_OPEN, _SQUARE)) if mask.size else mask.copy()


def distance_to_gap(mask: Bool) -> Float:
    """(ny, nx) cells from the middle of each cell to that of the nearest False one, within 2 %.

    Beyond the grid there is no gap; a mask without any has the size of the grid everywhere.
    """
    import cv2

    far = float(mask.shape[0] + mask.shape[1])
    if not mask.size:
        return np.zeros(mask.shape)
    cells: Float = cv2.distanceTransform(_image(mask), cv2.DIST_L2, _MASK_SIZE).astype(np.float64)
    return np.minimum(cells, far)


def _image(mask: Bool) -> NDArray[np.uint8]:
    """The same memory as OpenCV wants it."""
    return np.ascontiguousarray(mask, dtype=np.bool_).view(np.uint8)


def _mask(image: Any) -> Bool:
    """The same memory as numpy wants it."""
    return np.asarray(image).view(np.bool_)

"""Free space of a cloud without viewpoints: what its wide places would have seen.

Between floor and ceiling it is inferred, and has holes: under and over furniture, and in rooms that were seen
through a door, where the rays met neither. But where there is room to stand, a sensor may have stood, and
what it would have seen from there, on the way to a surface that really was seen, is free.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.columns import LEVEL, height_mask
from floorplan_core.geometry.virtual_scans import directions, seen_free
from floorplan_core.model.evidence import Bits, Evidence

_EYE = 1.2  # m above the floor
_CLEAR = 0.4  # m of free space around a place where a sensor may have stood
_BODY = (0.5, 1.5)  # m above the floor: the heights at which it is free there
_SPACING = 1.0  # m between two such places
_MOST = 150  # of them; more are thinned out
_REACH = 10.0  # m
_AZIMUTHS, _ELEVATIONS, _STEEPEST = 720, 40, 0.8  # rays of a place; radians up and down


def looked_around(evidence: Evidence) -> Evidence:
    """The evidence with what its wide places would have seen, where free space is inferred; else as it is."""
    if not evidence.inferred:
        return evidence
    return replace(evidence, free=seen_from_the_middle(evidence.free, evidence.occupied, evidence.cell))


def seen_from_the_middle(free: Bits, occupied: Bits, cell: float) -> Bits:
    """``free`` (ny, nx), and what was to be seen from its wide places."""
    places = standing_places(free, cell)
    if len(places) == 0:
        return free
    corners = np.column_stack([places, np.full(len(places), _EYE / LEVEL)])
    rays = directions(_AZIMUTHS, _ELEVATIONS, _STEEPEST)
    return np.asarray(free | seen_free(occupied, corners, rays, _REACH / cell, _CLEAR / cell))


def standing_places(free: Bits, cell: float) -> NDArray[np.float64]:
    """(M, 2) places in cells, a lattice over the middle of the free space; fewer where there are too many."""
    from scipy.ndimage import distance_transform_edt

    body = height_mask(*_BODY)
    wide = distance_transform_edt((free & body) == body) * cell >= _CLEAR
    step = max(1, round(_SPACING / cell))
    while True:
        rows, columns = np.nonzero(wide[::step, ::step])
        if len(rows) <= _MOST:
            return np.column_stack([columns, rows]).astype(np.float64) * step + 0.5
        step += 1

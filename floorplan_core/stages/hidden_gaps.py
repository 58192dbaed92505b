"""Gaps in the walls of a planar survey that nothing passes: hidden wall, not doors.

A laser that sweeps a room full of things sees the wall behind them in pieces. With heights the gaps are known
to be hidden; of a lifted scan a few free cells on either side are enough to call a gap open, and two rooms
hang together there. A doorway can be passed straight on: where no way leads so and wall stands on both sides
in line, the wall goes on.
In: planes with their runs, voxel columns. Out: planes with longer runs. Cost: gaps times cells in them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.geometry.columns import by_strips, count_bits, height_mask
from floorplan_core.model import LayoutPlane
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.door_apertures import shows_lintels
from floorplan_core.stages.necks import line_runs
from floorplan_core.stages.wall_lines import united

Float = NDArray[np.float64]
Mask = NDArray[np.bool_]

_BODY, _FREE = (0.4, 1.8), 0.5  # m above the floor, share of these heights from which a cell is free
_JAMB = 0.6  # m of wall on both sides of a gap
_TOUCH = 0.05  # m between a gap and a run of the plane that it is beside
_THROUGH = 0.3  # m before and behind the wall that a way through it is free
_PASSED = 0.25  # m of a gap through which ways lead, from which it is open


def close_hidden_gaps(
    planes: Sequence[LayoutPlane], evidence: Evidence, config: DoorsConfig
) -> tuple[LayoutPlane, ...]:
    """The planes; in a survey without lintels they are wall in gaps up to a door that nothing passes."""
    if shows_lintels([p.profile for p in planes if p.profile]):
        return tuple(planes)
    body = height_mask(*_BODY)
    least = _FREE * int(body).bit_count()
    free = by_strips(evidence.free, lambda some: count_bits(some & body) > least)
    gaps = [_hidden(p, planes, free, evidence, config.max_width) for p in planes]
    return tuple(
        replace(p, walls=united([*map(tuple, p.walls.tolist()), *hidden])) if hidden else p
        for p, hidden in zip(planes, gaps, strict=True)
    )


def _hidden(
    plane: LayoutPlane, planes: Sequence[LayoutPlane], free: Mask, evidence: Evidence, widest: float
) -> list[tuple[float, float]]:
    """The gaps in the line of a plane, beside runs of its own, that nothing passes."""
    found = []
    for (s0, e0), (s1, e1) in pairwise(line_runs(plane, planes)):
        beside = any(abs(e - e0) < _TOUCH or abs(s - s1) < _TOUCH for s, e in plane.walls)
        walled = s1 - e0 <= widest and min(e0 - s0, e1 - s1) >= _JAMB
        if beside and walled and _passed(plane, e0, s1, free, evidence) < _PASSED:
            found.append((e0, s1))
    return found


def _passed(plane: LayoutPlane, start: float, end: float, free: Mask, evidence: Evidence) -> float:
    """Metres of a gap through which free cells lead straight from before to behind the plane."""
    axis, cell = plane.facing.axis, evidence.cell
    grid = free if axis == 0 else free.T
    first, last = (int((plane.offset + d - evidence.origin[axis]) / cell) for d in (-_THROUGH, _THROUGH))
    a, b = (round((v - evidence.origin[1 - axis]) / cell) for v in (start, end))
    band = grid[max(a, 0) : max(b, 0), max(first, 0) : last + 1]
    return float(band.all(axis=1).sum()) * cell

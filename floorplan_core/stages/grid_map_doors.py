"""Doors of a map: passages in walls along the axes, measured from jamb to jamb.

In: passages, planes and the floor. Out: doors, each a child of the planes of its wall's faces. A passage in
a wall at another angle parts spaces like any other, but has no place in a Manhattan plan: it is counted, not
drawn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, LayoutPlane, OccupancyGrid
from floorplan_core.stages.grid_map_chords import march
from floorplan_core.stages.grid_map_doorways import MAX_LEAN, UPRIGHT, WIDER, Chord, faces, row_in_wall
from floorplan_core.stages.grid_map_passages import MOUTH, Passage

Bool = NDArray[np.bool_]

_FLANK = 0.25  # m of wall in line that make a jamb
_NEAR_PLANE = 0.15  # m between a face of the door's wall and the plane that explains it
_NEAR_RUN = 0.6  # m between the opening and the wall run that it interrupts


def grid_doors(
    passages: Sequence[Passage],
    planes: Sequence[LayoutPlane],
    floor: Bool,
    grid: OccupancyGrid,
    config: DoorsConfig,
) -> tuple[tuple[Door, ...], int]:
    """The doors by axis, offset and start, and how many passages lie in walls at other angles."""
    found = [_door(p, planes, floor, grid, config) for p in passages]
    doors = sorted((d for d in found if d is not None), key=lambda d: (d.axis, d.offset, d.start))
    named = tuple(_named(door, k, planes) for k, door in enumerate(doors))
    return named, len(found) - len(named)


def _door(
    passage: Passage, planes: Sequence[LayoutPlane], floor: Bool, grid: OccupancyGrid, config: DoorsConfig
) -> Door | None:
    """One passage as a door; None where it leans too much."""
    chord = Chord.of(passage.start, passage.end)
    if chord.lean > MAX_LEAN:
        return None
    axis, lean, u, v, low, high = chord.axis, chord.lean, chord.u, chord.v, chord.low, chord.high
    cells = chord.rows(floor)
    row = row_in_wall(cells, u, v, high - low)
    low, high = _jambs(cells, u, row, low, high)
    if passage.kind == MOUTH:
        near = far = v + 0.5
    else:
        near, far = faces(cells, u, row, high - low, config.max_thickness / grid.cell)
    if lean > UPRIGHT and far - near + 1 < (high - low) * math.tan(lean):
        return None  # the wall itself leans
    o = grid.origin
    return Door(
        id="",
        planes=(),
        axis=axis,
        offset=float(o[axis] + (near + far) / 2 * grid.cell),
        start=float(o[1 - axis] + low * grid.cell),
        end=float(o[1 - axis] + high * grid.cell),
        thickness=float((far - near) * grid.cell),
        evidence=_evidence(passage),
        confidence=_confidence(passage),
        kind=_kind(passage, (high - low) * grid.cell, config),
    )


def _jambs(cells: Bool, u: float, row: int, low: float, high: float) -> tuple[float, float]:
    """Edges of the opening along the wall, cells; the chord's own ends where its middle is wider."""
    most = WIDER * (high - low) + 2
    left, right = (march(cells, round(u), row, s, 0.0, most) for s in (-1.0, 1.0))
    start, end = round(u) - math.ceil(left - 0.5), round(u) + math.ceil(right - 0.5)
    if end - start > most:
        return low, high + 1.0
    return float(start + 1), float(end)


def _kind(passage: Passage, width: float, config: DoorsConfig) -> str:
    return "door" if width <= config.max_width and passage.kind != MOUTH else "opening"


def _evidence(passage: Passage) -> tuple[str, ...]:
    if passage.kind == MOUTH:
        return ("corridor opens into a hall",)
    jambs = sum(flank >= _FLANK for flank in passage.flanks)
    return ("narrow between two spaces", "wall on both sides" if jambs == 2 else "corner")


def _confidence(passage: Passage) -> float:
    """The narrower beside its spaces and the more wall in its line, the surer."""
    return round(min(1.0, max(0.0, 1.0 - passage.opening) * 0.6 + passage.wall * 0.4 + 0.2), 3)


def _named(door: Door, k: int, planes: Sequence[LayoutPlane]) -> Door:
    """The door with its id and the planes whose wall it interrupts."""
    mine = [
        p.id
        for p in planes
        if p.facing.axis == door.axis
        and abs(p.offset - door.offset) <= door.thickness / 2 + _NEAR_PLANE
        and any(s < door.end + _NEAR_RUN and e > door.start - _NEAR_RUN for s, e in p.walls)
    ]
    return replace(door, id=f"d{k + 1}", planes=tuple(mine))

"""Faces of a wall that are known by their neighbours: in line with it, beside its doorway, on its other side.

In: surfaces, each judged by itself (:mod:`~floorplan_core.stages.structure`). Out: the same, more of them
structural. Beside a door, or in a closet, a face is often seen too little or too low to be told from
furniture, or air of the room beyond seems to lie above it. Cost: surfaces times surfaces of one facing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.columns import count_bits, height_mask, levels_in_all
from floorplan_core.model import Facing, LayoutSegment
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.structure import LOW, Judgement, Patches

Float = NDArray[np.float64]

_WALL = (0.08, 0.25)  # m between the two faces of an inner wall; a door's leaf has 4 or 5 cm, a cabinet 30
_BOTH = 0.3  # m of a wall that both of its faces must show
_EXACT = 1e-6  # m
_FLUSH = 0.02  # m between two pieces of one face
_PASSABLE, _DOORWAY = 0.5, 1.3  # m between the jambs of a door
_THROUGH = (0.15, -0.05, -0.15, -0.25, -0.35)  # m before (+) and behind (-) a face where its doorway is free
_BODY, _OPEN = (0.4, 1.8), 0.5  # m above the floor, and share of it that is free where one can pass


def in_line(
    judged: list[Judgement], evidence: Evidence, facing: Facing, patches: Patches, offset: Float
) -> list[Judgement]:
    """The judgements, with low pieces that lie in line with structure, a doorway from it: the wall goes on.

    Beside a door often only the lower part of the wall is seen; where on both of its sides, two low pieces
    in one line between which a way leads on are the wall beside a doorway.
    """
    base, fine = float(evidence.origin[1 - facing.axis]), evidence.fine
    start = base + np.minimum.reduceat(patches.row, patches.first[:-1]) * fine
    end = base + (np.maximum.reduceat(patches.row, patches.first[:-1]) + 1) * fine
    structure = np.array([found for found, _ in judged], dtype=bool)
    low = np.array([judgement == (False, (LOW,)) for judgement in judged], dtype=bool)
    out = list(judged)
    for k in np.flatnonzero(low).tolist():
        gap = np.maximum(start - end[k], start[k] - end)
        near = (np.abs(offset - offset[k]) <= _FLUSH) & (gap <= _DOORWAY)
        if (structure & near).any():
            out[k] = True, ("in line with a wall",)
        elif any(
            _leads_on(evidence, facing, float(offset[k]), *sorted((start[k], end[k], start[j], end[j]))[1:3])
            for j in np.flatnonzero(low & near & (gap >= _PASSABLE)).tolist()
        ):
            out[k] = True, ("beside a doorway",)
    return out


def _leads_on(evidence: Evidence, facing: Facing, offset: float, start: float, end: float) -> bool:
    """True where most of a gap in a surface, from ``start`` to ``end``, is free from before to behind it."""
    grid, a = (evidence.free if facing.axis == 0 else evidence.free.T), facing.axis
    across = offset + facing.sign * np.array(_THROUGH) - evidence.origin[a]
    columns = np.clip(across / evidence.cell, 0, grid.shape[1] - 1).astype(int)
    along = (np.array([start, end]) - evidence.origin[1 - a]) / evidence.cell
    first, last = np.clip(np.rint(along), 0, grid.shape[0]).astype(int).tolist()
    body = height_mask(*_BODY)
    free = count_bits(levels_in_all(grid[first:last], columns.tolist()) & body) / int(body).bit_count()
    return last > first and float((free > _OPEN).mean()) > _OPEN


def other_faces(segments: Sequence[LayoutSegment], tall: float) -> tuple[LayoutSegment, ...]:
    """The segments, structural also where what lies just behind one, as a wall is thick, is the other face.

    Air is seen above a thin wall whose top was hidden: that of the room beyond. But nothing else is as thick
    as a wall and seen from both sides; of two faces neither of which is known to be structure, one must be
    higher than ``tall`` metres, since partitions of an office are thin, too.
    """
    out = list(segments)
    for facing in (Facing.EAST, Facing.NORTH):
        one = [k for k, s in enumerate(segments) if s.facing == facing]
        two = [k for k, s in enumerate(segments) if s.facing == facing.opposite]
        for i, j in _back_to_back([segments[k] for k in one], [segments[k] for k in two]).tolist():
            a, b = segments[one[i]], segments[two[j]]
            if a.structural or b.structural or max(a.z_max, b.z_max) > tall:
                for k in (one[i], two[j]):
                    if not segments[k].structural:
                        out[k] = replace(out[k], structural=True, evidence=("other face of a wall",))
    return tuple(out)


def _back_to_back(one: Sequence[LayoutSegment], two: Sequence[LayoutSegment]) -> NDArray[np.int64]:
    """(P, 2) the pairs as far apart as the faces of a wall that look away from each other, in order."""
    a, b = (np.array([(s.offset, s.start, s.end) for s in of]).reshape(-1, 3) for of in (one, two))
    order = np.argsort(b[:, 0])
    b, widest = b[order], _WALL[1] + _EXACT  # what is just beyond is sorted out below
    first, last = np.searchsorted(b[:, 0], a[:, 0] - widest), np.searchsorted(b[:, 0], a[:, 0])
    count = np.maximum(last - first, 0)
    i = np.repeat(np.arange(len(a)), count)
    j = np.arange(len(i)) - np.repeat(np.cumsum(count) - count, count) + first[i]
    apart = a[i, 0] - b[j, 0]
    common = np.minimum(a[i, 2], b[j, 2]) - np.maximum(a[i, 1], b[j, 1])
    kept = (apart > _WALL[0]) & (apart <= _WALL[1]) & (common >= _BOTH)
    pairs = np.column_stack([i[kept], order[j[kept]]])
    return np.asarray(pairs[np.lexsort(pairs.T[::-1])])

"""Structure told from furniture: by the height reached, contact with the ceiling, and being looked over.

In: the patches of one facing, row by row, with their offsets. Out: for each, structure or not, and why.
Only structure makes layout planes. What a patch says of its neighbours is in
:mod:`~floorplan_core.stages.wall_faces`. Cost: linear in rows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.config import SegmentsConfig
from floorplan_core.geometry.columns import LEVEL, count_bits, height_mask
from floorplan_core.model import Facing
from floorplan_core.model.evidence import Evidence

Float = NDArray[np.float64]

_BEHIND = (0.06, 0.2)  # m behind a face: where the other face of a thin wall is
_OTHER_FACE = 2  # levels of it that tell a wall from noise
_WELL_SEEN = 0.7  # m of the height of a patch seen on average: of glass and reveals it is less
_GOES_ON = (2, 3, 4, 5)  # levels below one: the next belongs to it, as a surface may lie between two
_BEFORE = 0.25  # of a column: with so much of it before the face it does not tell what is behind
_LEAF = 1.0  # m: a shorter surface may be the leaf of a door that stands open
_LARGE = 1.2  # m: no door's leaf is as long
_FOOT, _AS_FREE = (
    0.3,
    0.7,
)  # m above the floor; share of what is free above a surface that is so below it, too
_BETWEEN = (1.0, 2.0)  # m above the floor: over furniture, under beams
_SPARSE = (
    0.3  # m of its height seen on average: without viewpoints so little, and nothing between, is no wall
)
LOW = "low"  # the word for what is too short and too low to be told from furniture by itself
OVER = "looked over"  # the word for what has air behind and above it
SPARSE = "hardly seen"  # the word for what may be the edges of furniture and of ceiling in one line
ALL_LEVELS = np.uint64((1 << 64) - 1)

Judgement = tuple[bool, tuple[str, ...]]  # structure or not, and why


@dataclass(frozen=True)
class Patches:
    """The chains of one facing that become segments, row by row."""

    chain: NDArray[np.int64]  # (K,)
    first: NDArray[np.int64]  # (K + 1,) rows from ``first[k]`` to ``first[k + 1]`` are those of patch k
    row: NDArray[np.int64]  # (R,) fine cell along the wall
    bits: NDArray[np.uint64]  # (R,) levels hit
    area: Float  # (K,) m2

    @property
    def lengths(self) -> NDArray[np.int64]:
        """(K,) rows of each patch."""
        return np.diff(self.first)

    def count(self, mask: NDArray[np.bool_]) -> NDArray[np.int64]:
        """(K,) rows of each patch where ``mask`` (R,) is True."""
        return np.diff(np.concatenate([[0], np.cumsum(mask)])[self.first])


def judge(
    evidence: Evidence, facing: Facing, patches: Patches, offset: Float, config: SegmentsConfig
) -> list[Judgement]:
    """Structure or furniture, by height reached, contact with the ceiling, and being looked over."""
    ceiling, bits, fine = evidence.frame.ceiling_z, patches.bits, evidence.fine
    held = _held(bits) if evidence.viewpoints else bits  # else walls are seen in pieces, with holes below
    tall = patches.count((held & ~height_mask(0, config.furniture_height + LEVEL)) != 0)
    top = np.inf if ceiling is None else max(ceiling - evidence.frame.floor_z - config.ceiling_gap, 1.0)
    at_top = np.zeros(len(bits), dtype=bool) if ceiling is None else (held & ~height_mask(0, top)) != 0
    length = fine * patches.lengths
    surely = (tall > 0) & (length > _LEAF) & (patches.area >= _WELL_SEEN * length)
    over = patches.count(_looked_over(evidence, facing, patches, offset, surely))
    numbers = zip(patches.lengths, tall, patches.count(at_top), over, strict=True)
    judged = [_judgement(fine, *(int(n) for n in four)) for four in numbers]
    if evidence.viewpoints:
        return judged
    sparse = _is_sparse(patches, fine)
    return [(False, (SPARSE,)) if no else said for no, said in zip(sparse, judged, strict=True)]


def _is_sparse(patches: Patches, fine: float) -> NDArray[np.bool_]:
    """(K,) True where something low and something high, with nothing between, happen to be in one line.

    Few levels are not enough to say so: of a wall far away a scanner's rings leave few, at all heights.
    """
    extent = fine * (patches.row[patches.first[1:] - 1] - patches.row[patches.first[:-1]] + 1)
    levels = np.bitwise_or.reduceat(patches.bits, patches.first[:-1])
    between = count_bits(levels & height_mask(*_BETWEEN)) > 1
    low = 2 * patches.count((patches.bits & height_mask(0, _BETWEEN[0])) != 0) >= patches.lengths
    return np.asarray((patches.area < _SPARSE * extent) & low & ~between)


def _held(bits: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Levels of (R,) rows below which the surface goes on. One with nothing below is the ceiling of a room
    that is lower than the rest, over a cabinet: it lies where the walls of the higher rooms still are."""
    below = np.bitwise_or.reduce([bits << np.uint64(k) for k in _GOES_ON])
    return np.asarray(bits & below)


def _judgement(fine: float, rows: int, tall: int, at_top: int, looked_over: int) -> Judgement:
    """What so many rows, of them so many tall, at the ceiling and looked over, are."""
    over = looked_over / rows
    if at_top / rows >= 0.2 and over < 0.6:
        return True, ("reaches ceiling",)
    if over > 0.3:  # a cabinet, a curtain, a counter: there is air between it and the ceiling
        return False, (OVER,)
    if tall / rows >= 0.3 or tall * fine >= 1.0:
        return True, ("above furniture",)
    if rows * fine >= 1.0 and over < 0.1:
        return True, ("long, top not seen",)
    return False, (LOW,)


def _looked_over(
    evidence: Evidence, facing: Facing, patches: Patches, offset: Float, surely: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """(R,) True for the rows where free space was seen just behind and above the surface.

    Two columns behind it are asked. The nearer may lie before a wall that noise has moved: for patches that
    are ``surely`` (K,) surfaces, longer than a door's leaf and higher than furniture, both must be free.
    Else the nearer is enough, for shallow things before a wall; the farther may lie on the other side of a
    thin wall: alone it counts only where the wall's other face was not seen to go on above in between. A
    nearer column that begins well before the face is free there by the air of the room: it is not asked.
    """
    a, row = facing.axis, patches.row
    grid = evidence.free if a == 0 else evidence.free.T
    near = offset[:, None] - facing.sign * np.array([0.5, 1.5]) * evidence.cell
    cells = np.floor((near - evidence.origin[a]) / evidence.cell)
    edge = evidence.origin[a] + (cells[:, 0] + (facing.sign > 0)) * evidence.cell  # towards the room
    mixed = (edge - offset) * facing.sign > _BEFORE * evidence.cell
    iu = np.clip(cells.astype(int), 0, grid.shape[1] - 1)
    iu, iv = np.repeat(iu, patches.lengths, axis=0), np.clip(row // 2, 0, grid.shape[0] - 1)
    ceiling = evidence.frame.ceiling_z
    limit = 2.6 if ceiling is None else ceiling - evidence.frame.floor_z - 0.1
    top = np.floor(np.log2(np.maximum(patches.bits, 1).astype(np.float64))).astype(np.uint64)
    above = (ALL_LEVELS << (top + np.uint64(2))) & height_mask(0.5, limit)
    goes_on = count_bits(_surfaces_behind(evidence, facing, patches, offset) & above) >= _OTHER_FACE
    nearer, farther = grid[iv, iu[:, 0]] & above, grid[iv, iu[:, 1]] & above
    beyond = np.where(goes_on, np.uint64(0), farther)
    nearer = np.where(np.repeat(mixed, patches.lengths), beyond, nearer)
    over = np.where(np.repeat(surely, patches.lengths), nearer & farther, nearer | beyond) != 0
    behind = np.where(nearer != 0, grid[iv, iu[:, 0]], grid[iv, iu[:, 1]])
    below = height_mask(_FOOT, limit) & ~(ALL_LEVELS << (top + np.uint64(1)))
    elsewhere = _free_below_too(patches, evidence.fine, over, behind, above, below)
    return np.asarray(over & ~np.repeat(elsewhere, patches.lengths))


def _free_below_too(
    patches: Patches,
    fine: float,
    over: NDArray[np.bool_],
    behind: NDArray[np.uint64],
    above: NDArray[np.uint64],
    below: NDArray[np.uint64],
) -> NDArray[np.bool_]:
    """(K,) True for the large patches behind which it is as free below their top as above: the room beyond.

    :param over: (R,) the rows that seem looked over, ``behind`` the free levels of the column that says so,
        ``above`` and ``below`` the levels above and below the top of the surface.
    """
    shares = [
        np.where(over, count_bits(behind & levels) / np.maximum(count_bits(levels), 1), 0.0)
        for levels in (below, above)
    ]
    low, high = (np.add.reduceat(share, patches.first[:-1]) for share in shares)
    rows = patches.lengths
    large = patches.area >= _WELL_SEEN * fine * rows
    return large & (fine * rows > _LARGE) & (low >= _AS_FREE * high)


def _surfaces_behind(
    evidence: Evidence, facing: Facing, patches: Patches, offset: Float
) -> NDArray[np.uint64]:
    """(R,) levels at which anything was hit within the thickness of a wall behind its face."""
    a = facing.axis
    hits = evidence.hits if a == 0 else evidence.hits.T
    at = np.sort(offset[:, None] - facing.sign * np.array(_BEHIND), axis=1)
    ends = np.clip(np.floor((at - evidence.origin[a]) / evidence.fine).astype(int), 0, hits.shape[1] - 1)
    low, high = np.repeat(ends, patches.lengths, axis=0).T
    row = np.clip(patches.row, 0, hits.shape[0] - 1)
    levels = np.zeros(len(row), dtype=np.uint64)
    for step in range(int((ends[:, 1] - ends[:, 0]).max(initial=-1)) + 1):
        levels |= hits[row, np.minimum(low + step, high)]
    return levels

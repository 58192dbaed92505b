"""Islands: buildings of one site that stand far apart, with nothing between them (beyond the paper).

In: the surfels of a wide site and its frame. Out: the islands, largest first, or () for nearly every survey.
Everything that a plan needs is laid out over a rectangle; for two buildings at opposite corners of a campus
that would be the whole campus. Each island is laid out over its own. Cost: nothing where the site is not
wide, else one pass over the surfels.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.surfel_map import SurfelMap, Surfels
from floorplan_core.model import ManhattanFrame

Float = NDArray[np.float64]
Int = NDArray[np.int64]

WIDE = 20_000.0  # m2 of a site's bounding box, from which islands are looked for
_TOO_WIDE = 100_000.0  # m2: such a site may be refused for its size, so that it is rid of stray points
_MOST = 0.9  # of a site's box that its one building fills: nothing there is worth leaving out
_SITE = 2_000_000.0  # m2 of a site's box: its occupancy grid takes 400 MB then, and a larger site is refused
_SQUARE = 5.0  # m, side of the squares in which surfels are counted
_STRAY = 20  # surfels of a square: fewer bridge no gap
_NEXT = 4  # squares from one to another of the same island: gaps of less than 20 m part nothing
_LEAST = 2000  # surfels of an island: 1 m2 of surface
_PIECE = 1_000_000  # surfels that are looked at together
_BIAS, _BITS = 1 << 30, 31  # of the number of a square: two coordinates in one word


@dataclass(frozen=True)
class Island:
    """Where one island is."""

    squares: Int  # (K,) numbers of its squares, rising
    surfels: int
    level: Float  # (2, 3) rows of the rotation from the map to the frame that the squares are laid in

    def holds(self, xyz: Float) -> NDArray[np.bool_]:
        """(N,) which of (N, 3) positions, frame of the map, lie over its squares."""
        number = _number(xyz @ self.level.T)
        at = np.minimum(np.searchsorted(self.squares, number), len(self.squares) - 1)
        return np.asarray(self.squares[at] == number)

    def surfels_of(self, surfels: SurfelMap) -> SurfelMap:
        """Its own of the site's surfels."""
        inside = [self.holds(piece.centroid) for piece in surfels.pieces(_PIECE)]
        return surfels.select(np.flatnonzero(np.concatenate(inside)))


def is_wide(sample: Surfels, frame: ManhattanFrame) -> bool:
    """True where islands are worth a look: some of the surfels are enough to tell."""
    xy = sample.centroid @ frame.rotation[:2].T
    return len(xy) > 0 and bool(np.prod(np.ptp(xy, axis=0)) > WIDE)


def find_islands(surfels: SurfelMap, frame: ManhattanFrame) -> tuple[Island, ...]:
    """The islands, most surfels first, ties to the smaller x.

    () where there are not two of them, or they lie farther apart than one plan can show; one where only stray
    points make the site wider than a plan can be. A site of one piece is not taken out of itself: its surfels
    would be there twice.
    """
    squares, counts = _squares(surfels, frame)
    whole, dense = _area(squares), counts >= _STRAY
    squares, counts = squares[dense], counts[dense]
    label = _connected(squares)
    total = np.bincount(label, weights=counts).astype(np.int64)
    kept = [k for k in np.argsort(-total, kind="stable").tolist() if total[k] >= _LEAST]
    area = _area(squares[np.isin(label, kept)])
    strayed = whole > _TOO_WIDE and area < _MOST * whole
    if len(kept) < (1 if strayed else 2) or area > _SITE:
        return ()
    return tuple(Island(squares[label == k], int(total[k]), frame.rotation[:2]) for k in kept)


def _squares(surfels: SurfelMap, frame: ManhattanFrame) -> tuple[Int, Int]:
    """Numbers of the squares that hold surfels, rising, and how many each holds."""
    level, found = frame.rotation[:2].T, []
    for piece in surfels.pieces(_PIECE):
        found.append(_counted(np.floor(piece.centroid @ level / _SQUARE).astype(np.int64)))
    numbers, place = np.unique(np.concatenate([f[0] for f in found]), return_inverse=True)
    counts = np.bincount(place, weights=np.concatenate([f[1] for f in found]), minlength=len(numbers))
    return numbers, counts.astype(np.int64)


def _counted(index: Int) -> tuple[Int, Int]:
    """Numbers of the squares among (N, 2), rising, and how often each is there; without sorting where they
    are close together: that is most of the time."""
    low, span = index.min(axis=0), np.ptp(index, axis=0) + 1
    if span[0] * span[1] > _PIECE:
        return np.unique(_numbers(index), return_counts=True)
    counts = np.bincount((index[:, 0] - low[0]) * span[1] + index[:, 1] - low[1])
    there = np.flatnonzero(counts)
    return _numbers(np.column_stack(np.divmod(there, span[1])) + low), counts[there]


def _number(xy: Float) -> Int:
    return _numbers(np.floor(xy / _SQUARE).astype(np.int64))


def _numbers(index: Int) -> Int:
    """(N,) the squares (N, 2), counted along x and y, in one word each."""
    index = index + _BIAS
    return np.asarray((index[:, 0] << _BITS) | index[:, 1])


def _places(squares: Int) -> Int:
    """(K, 2) the squares counted along x and y."""
    return np.column_stack([squares >> _BITS, squares & ((1 << _BITS) - 1)]) - _BIAS


def _area(squares: Int) -> float:
    """m2 of the box around the squares."""
    return float(np.prod((np.ptp(_places(squares), axis=0) + 1) * _SQUARE)) if len(squares) else 0.0


def _connected(squares: Int) -> NDArray[np.int32]:
    """(K,) number of the group of each square; numbers rise with the first square of each."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    xy = _places(squares)
    if len(xy) == 0:
        return np.zeros(0, dtype=np.int32)
    pairs = cKDTree(xy).query_pairs(_NEXT, p=np.inf, output_type="ndarray")
    links = coo_array((np.ones(len(pairs), dtype=bool), tuple(pairs.T)), shape=(len(xy), len(xy)))
    label = connected_components(links, directed=False)[1]
    first = np.unique(label, return_index=True)[1]
    order = np.empty(len(first), dtype=np.int32)
    order[np.argsort(first)] = np.arange(len(first))
    return np.asarray(order[label])

"""Layout segments: observed, bounded patches of structural surfaces (first input of the paper, section 3).

In: :class:`Evidence`. Out: segments of each facing, structural or not. For each facing only the points seen
from its side count, which keeps the two faces of a thin wall apart; without sensor origins the side comes
from where the free space is. Surfaces are found where columns line up along the wall, linked along it, and
their offset is fitted to the surfels themselves, so that it does not know the grid. Structure is told from
furniture in :mod:`floorplan_core.stages.structure` and ``wall_faces``. Cost: linear in surfels and columns.
"""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.config import SegmentsConfig
from floorplan_core.geometry.columns import (
    LEVEL,
    count_bits,
    facing_columns,
    height_mask,
    link_chains,
    strips,
    surface_cells,
    surface_offsets,
)
from floorplan_core.model import Facing, LayoutSegment
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages.structure import Judgement, Patches, judge
from floorplan_core.stages.upright_surfels import UprightSurfels, upright_surfels
from floorplan_core.stages.wall_faces import in_line, other_faces

Float = NDArray[np.float64]

_SKIRTING = 0.2  # m above the floor below which nothing counts as wall
_HIST = 60  # bins of 2.5 mm on each side of a segment, for its robust offset
_HIST_BIN = 0.0025
_WIDEST = 0.04  # m, standard deviation that a surface may have
_AT_A_TIME = 2  # facings: each takes 48 bytes for each column of a strip


@dataclass(frozen=True)
class FacingSurfaces:
    """The raw surfaces of one facing, before anything is called a segment; rows are cells along the wall."""

    facing: Facing
    node: NDArray[np.int64]  # (K, 4) chain, row, first and last column
    offset: Float  # (K,) metres along the normal, manhattan frame
    bits: NDArray[np.uint64]  # (K,) levels hit
    chains: int


@dataclass(frozen=True)
class SegmentRows:
    """Where and how high a segment was seen: one entry for each fine cell along it."""

    row: NDArray[np.int64]  # (R,) fine cell along the wall, counted from the grid's origin
    bits: NDArray[np.uint64]  # (R,) levels hit


class Fit(NamedTuple):
    """Where the surface of a patch lies."""

    offset: float  # metres
    sigma: float  # metres, of the surfels about it
    spread: float  # m2, mean variance inside the surfels
    weight: float  # surfels of the peak
    points: float


def find_segments(
    evidence: Evidence, config: SegmentsConfig
) -> tuple[tuple[LayoutSegment, ...], dict[str, SegmentRows]]:
    """All segments, by facing, then offset, then start; and the rows that each is made of."""
    upright = upright_surfels(evidence, _SKIRTING, wall_band(evidence))
    with ThreadPoolExecutor(_AT_A_TIME) as pool:
        found = list(pool.map(lambda facing: _segments_of(upright, facing, config), Facing))
    segments: list[LayoutSegment] = []
    rows: dict[str, SegmentRows] = {}
    for group in found:
        for segment, row in sorted(group, key=lambda pair: (pair[0].offset, pair[0].start)):
            named = replace(segment, id=f"s{len(segments) + 1}")
            segments.append(named)
            rows[named.id] = row
    if not evidence.viewpoints:  # which way a face looks is a guess there: a cabinet's front has two
        return tuple(segments), rows
    return other_faces(segments, config.furniture_height), rows


def _segments_of(
    upright: UprightSurfels, facing: Facing, config: SegmentsConfig
) -> list[tuple[LayoutSegment, SegmentRows]]:
    surfaces = _surfaces(upright, facing, config)
    if surfaces.chains == 0:
        return []
    mean, histogram, spread, points = _fit_histograms(upright, facing, surfaces)
    patches = _large_patches(surfaces, upright, config)
    chain = patches.chain
    offset, sigma, weight = _robust_offsets(mean[chain], histogram[chain])
    judged = judge(upright.evidence, facing, patches, offset, config)
    judged = in_line(judged, upright.evidence, facing, patches, offset) if judged else judged
    fits = np.column_stack([offset, sigma, spread[chain], weight, points[chain]]).tolist()
    return [
        _segment(upright.evidence, facing, patches, k, Fit(*fits[k]), judged[k]) for k in range(len(fits))
    ]


def _large_patches(surfaces: FacingSurfaces, upright: UprightSurfels, config: SegmentsConfig) -> Patches:
    """The chains that are long and large enough to be segments."""
    order = np.argsort(surfaces.node[:, 0], kind="stable")
    of, row, bits = surfaces.node[order, 0], surfaces.node[order, 1], surfaces.bits[order] & upright.band
    count = np.bincount(of, minlength=surfaces.chains)  # a chain crosses a row once
    fine = upright.evidence.fine
    levels = np.bincount(of, weights=count_bits(bits), minlength=surfaces.chains)
    area = np.asarray(levels * fine * LEVEL, dtype=np.float64)
    large = (count * fine >= config.min_length) & (area >= config.min_area)
    kept = large[of]
    first = np.concatenate([[0], np.cumsum(count[large])])
    return Patches(np.flatnonzero(large), first, row[kept], bits[kept], area[large])


def _surfaces(upright: UprightSurfels, facing: Facing, config: SegmentsConfig) -> FacingSurfaces:
    """Chains of columns that line up; the columns are made strip by strip across the wall."""
    evidence, a = upright.evidence, facing.axis
    fine, (nv, nu) = evidence.fine, _extent(evidence, facing)
    half = max(1, round(config.window / fine / 2 - 0.5))
    tangent = math.tan(math.radians(config.angle_deg))
    chosen, found = upright.of(facing), []
    for first, last in strips(nv, nu):
        low, high = max(first - half, 0), min(last + half, nv)  # a window reaches into the next strip
        bits, sums = facing_columns(
            *(evidence.xyz, upright.row, upright.column, upright.level, chosen),
            *(a, evidence.origin, fine, low, high, nu),
        )
        offsets = surface_offsets(bits, sums, upright.band, fine, half, tangent, 8.0)
        found.append(surface_cells(offsets, bits, low, first - low, last - low))
    cells = [found[0][k] if len(found) == 1 else np.concatenate([f[k] for f in found]) for k in range(3)]
    node, node_u, node_bits, chains = link_chains(
        *(*cells, nv, config.offset_tolerance / fine, round(config.join_gap / fine))
    )
    offset = evidence.origin[a] + node_u * fine
    return FacingSurfaces(facing, node, offset, node_bits, int(chains))


def _extent(evidence: Evidence, facing: Facing) -> tuple[int, int]:
    """Fine columns along the walls of a facing, and across them."""
    ny, nx = evidence.hits.shape
    return (ny, nx) if facing.axis == 0 else (nx, ny)


def wall_band(evidence: Evidence) -> np.uint64:
    """The levels in which walls are looked for: above the skirting, below the ceiling."""
    ceiling = evidence.frame.ceiling_z
    top = 6.0 if ceiling is None else ceiling - evidence.frame.floor_z - 0.1
    return height_mask(_SKIRTING, top)


@njit(cache=True, nogil=True)
def _label_points(node, first, last, nu, column, axis, chosen, out):  # type: ignore[no-untyped-def]
    """Set ``out`` (N,) to the chain that each chosen point in rows ``first`` to ``last`` is near.

    ``node`` are those of these rows. Each chain is spread two cells beyond its columns, where the tails of
    the noise are.
    """
    label = np.full((last - first, nu), -1, dtype=np.int32)
    for reach in (0, 1, 2):
        for k in range(len(node)):
            for iu in range(max(0, node[k, 2] - reach), min(nu, node[k, 3] + reach + 1)):
                if label[node[k, 1] - first, iu] < 0:
                    label[node[k, 1] - first, iu] = node[k, 0]
    for n in range(len(column)):
        if chosen[n] and first <= column[n, 1 - axis] < last:
            out[n] = label[column[n, 1 - axis] - first, column[n, axis]]


def _chains_of(upright: UprightSurfels, facing: Facing, surfaces: FacingSurfaces) -> NDArray[np.int32]:
    """(N,) the chain that each of the upright surfels belongs to; -1: none."""
    nv, nu = _extent(upright.evidence, facing)
    # Where a thin wall's other face is within reach, only what surely belongs to this one counts.
    chosen, out = upright.surely_of(facing), np.full(len(upright.row), -1, dtype=np.int32)
    for first, last in strips(nv, nu):
        nodes = slice(*np.searchsorted(surfaces.node[:, 1], (first, last)).tolist())
        _label_points(surfaces.node[nodes], first, last, nu, upright.column, facing.axis, chosen, out)
    return out


def _fit_histograms(
    upright: UprightSurfels, facing: Facing, surfaces: FacingSurfaces
) -> tuple[Float, Float, Float, Float]:
    """For each chain: mean offset, histogram of distances to it, mean variance inside surfels, points."""
    evidence = upright.evidence
    weight = count_bits(surfaces.bits).astype(float)
    total = np.bincount(surfaces.node[:, 0], weights=weight, minlength=surfaces.chains)
    mean = (
        np.bincount(surfaces.node[:, 0], weights=weight * surfaces.offset, minlength=surfaces.chains) / total
    )
    label = _chains_of(upright, facing, surfaces)
    return mean, *_histograms(
        *(evidence.xyz, evidence.count, evidence.spread, upright.row, label, mean, facing.axis)
    )


@njit(cache=True, nogil=True)
def _histograms(xyz, count, variance, row, label, mean, axis):  # type: ignore[no-untyped-def]
    hist = np.zeros((len(mean), 2 * _HIST))
    spread, points = np.zeros(len(mean)), np.zeros(len(mean))
    for n in range(len(row)):
        c = label[n]
        if c < 0:
            continue
        i = row[n]
        k = int(np.floor((xyz[i, axis] - mean[c]) / _HIST_BIN)) + _HIST
        if 0 <= k < 2 * _HIST:
            hist[c, k] += 1.0
            spread[c] += variance[i, axis]
            points[c] += count[i]
    for c in range(len(mean)):
        spread[c] /= max(hist[c].sum(), 1.0)
    return hist, spread, points


def _robust_offsets(start: Float, counts: Float) -> tuple[Float, Float, Float]:
    """(K,) offset, standard deviation and weight of the main peak of each of the (K, B) histograms.

    A mean within 2.5 sigma, iterated; where a histogram is empty there, the offset is ``start``.
    """
    x = (np.arange(2 * _HIST) - _HIST + 0.5) * _HIST_BIN
    centre, sigma = np.zeros((len(start), 1)), np.full((len(start), 1), _WIDEST)
    full = np.ones(len(start), dtype=bool)
    for _ in range(6):
        w = counts * (np.abs(x - centre) < 2.5 * sigma + _HIST_BIN)
        weight = w.sum(axis=1, keepdims=True)
        full &= weight[:, 0] > 0
        some = np.maximum(weight, 1.0)
        centre = (w * x).sum(axis=1, keepdims=True) / some
        spread = np.sqrt((w * (x - centre) ** 2).sum(axis=1, keepdims=True) / some)
        sigma = np.maximum(0.002, spread * 1.1)
    offset = np.where(full, start + centre[:, 0], start)
    return offset, np.where(full, sigma[:, 0], _WIDEST), np.where(full, weight[:, 0], 0.0)


def _segment(
    evidence: Evidence,
    facing: Facing,
    patches: Patches,
    k: int,
    fit: Fit,
    judged: Judgement,
) -> tuple[LayoutSegment, SegmentRows]:
    """The patch ``k`` as a segment."""
    mine = slice(int(patches.first[k]), int(patches.first[k + 1]))
    rows, bits = patches.row[mine], patches.bits[mine]
    sigma = math.sqrt(fit.sigma**2 + fit.spread)
    structural, words = judged
    union = int(np.bitwise_or.reduce(bits))
    base, fine = float(evidence.origin[1 - facing.axis]), evidence.fine
    segment = LayoutSegment(
        id="",
        facing=facing,
        offset=fit.offset,
        start=base + float(rows.min()) * fine,
        end=base + float(rows.max() + 1) * fine,
        z_min=LEVEL * ((union & -union).bit_length() - 1),
        z_max=LEVEL * union.bit_length(),
        area=float(patches.area[k]),
        points=int(fit.points),
        residual=1.96 * sigma,
        sigma=sigma / math.sqrt(max(fit.weight, 1.0)),
        structural=structural,
        evidence=words,
    )
    return segment, SegmentRows(rows, bits)

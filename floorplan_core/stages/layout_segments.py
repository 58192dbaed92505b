"""Layout segments: observed, bounded patches of structural surfaces (first input of the paper, section 3).

In: :class:`Evidence`. Out: segments of each facing, structural or not. For each facing only the points seen
from its side count, which keeps the two faces of a thin wall apart; without sensor origins the side comes
from where the free space is. Surfaces are found where columns line up along the wall, linked along it, and
their offset is fitted to the surfels themselves, so that it does not know the grid. Structure is told from
furniture by what reaches above furniture, touches the ceiling, or is looked over. Cost: linear in surfels and
columns.
"""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

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
    surface_offsets,
)
from floorplan_core.model import Facing, LayoutSegment
from floorplan_core.model.evidence import Evidence

Float = NDArray[np.float64]

_SKIRTING = 0.2  # m above the floor below which nothing counts as wall
_SKIN = 1  # cells before a surface that its own noise may fill
_HIST = 60  # bins of 2.5 mm on each side of a segment, for its robust offset
_HIST_BIN = 0.0025
_BEHIND = (0.06, 0.2)  # m behind a face: where the other face of a thin wall is
_OTHER_FACE = 2  # levels of it that tell a wall from noise
ALL_LEVELS = np.uint64((1 << 64) - 1)


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


def find_segments(
    evidence: Evidence, config: SegmentsConfig
) -> tuple[tuple[LayoutSegment, ...], dict[str, SegmentRows]]:
    """All segments, by facing, then offset, then start; and the rows that each is made of."""
    upright = _in_wall_band(evidence)
    with ThreadPoolExecutor(len(Facing)) as pool:
        found = list(pool.map(lambda facing: _segments_of(upright, facing, config), Facing))
    segments: list[LayoutSegment] = []
    rows: dict[str, SegmentRows] = {}
    for group in found:
        for segment, row in sorted(group, key=lambda pair: (pair[0].offset, pair[0].start)):
            named = replace(segment, id=f"s{len(segments) + 1}")
            segments.append(named)
            rows[named.id] = row
    return tuple(segments), rows


def _in_wall_band(evidence: Evidence) -> Evidence:
    """The evidence without the surfels of floor and ceiling, which are most of them."""
    top = LEVEL * int(wall_band(evidence)).bit_length()
    xyz, count, spread, view = _between(
        evidence.xyz, evidence.count, evidence.spread, evidence.view, _SKIRTING, top
    )
    return replace(evidence, xyz=xyz, count=count, spread=spread, view=view)


@njit(cache=True, nogil=True)
def _between(xyz, count, spread, view, low, high):  # type: ignore[no-untyped-def]
    """The surfels with ``low < z < high``."""
    n = 0
    for i in range(len(xyz)):
        n += low < xyz[i, 2] < high
    xyz_, count_ = np.empty((n, 3)), np.empty(n, dtype=count.dtype)
    spread_, view_ = np.empty((n, 2)), np.empty((n, 2))
    k = 0
    for i in range(len(xyz)):
        if low < xyz[i, 2] < high:
            xyz_[k, 0], xyz_[k, 1], xyz_[k, 2] = xyz[i, 0], xyz[i, 1], xyz[i, 2]
            count_[k] = count[i]
            spread_[k, 0], spread_[k, 1] = spread[i, 0], spread[i, 1]
            view_[k, 0], view_[k, 1] = view[i, 0], view[i, 1]
            k += 1
    return xyz_, count_, spread_, view_


def _segments_of(
    evidence: Evidence, facing: Facing, config: SegmentsConfig
) -> list[tuple[LayoutSegment, SegmentRows]]:
    surfaces, label = _surfaces(evidence, facing, config)
    if surfaces.chains == 0:
        return []
    histogram, spread, points = _fit_histograms(evidence, facing, surfaces, label)
    out = []
    order = np.argsort(surfaces.node[:, 0], kind="stable")
    bounds = np.searchsorted(surfaces.node[order, 0], np.arange(surfaces.chains + 1))
    for chain in range(surfaces.chains):
        mine = order[bounds[chain] : bounds[chain + 1]]
        segment = _segment(
            evidence, facing, surfaces, mine, histogram[chain], spread[chain], points[chain], config
        )
        if segment is not None:
            out.append(segment)
    return out


def normal_and_tangent(evidence: Evidence, facing: Facing) -> tuple[Float, Float]:
    """(N,) coordinates of the surfels across and along a wall of this facing."""
    return evidence.xyz[:, facing.axis], evidence.xyz[:, 1 - facing.axis]


def _surfaces(
    evidence: Evidence, facing: Facing, config: SegmentsConfig
) -> tuple[FacingSurfaces, NDArray[np.int32]]:
    """Chains of columns that line up, and (nv, nu) the chain near each cell (-1: none)."""
    a, b = facing.axis, 1 - facing.axis
    u, v = normal_and_tangent(evidence, facing)
    n = tuple(2 * s for s in evidence.shape)
    nv, nu = (n[0], n[1]) if a == 0 else (n[1], n[0])
    if evidence.viewpoints:
        toward = evidence.view[:, a] * facing.sign
        eligible = np.ones(len(u), dtype=bool)
    else:
        toward = np.ones(len(u))
        eligible = _faces_free_space(evidence, facing, u, v)
    fine = evidence.fine
    bits, sums = facing_columns(
        u, v, evidence.xyz[:, 2], toward, eligible, evidence.origin[a], evidence.origin[b], fine, nv, nu
    )
    half = max(1, round(config.window / fine / 2 - 0.5))
    tangent = math.tan(math.radians(config.angle_deg))
    offsets = surface_offsets(bits, sums, wall_band(evidence), fine, half, tangent, 8.0)
    node, node_u, node_bits, chains = link_chains(
        offsets, bits, config.offset_tolerance / fine, round(config.join_gap / fine)
    )
    label = _label_cells(node, nv, nu)
    offset = evidence.origin[a] + node_u * fine
    return FacingSurfaces(facing, node, offset, node_bits, int(chains)), label


def wall_band(evidence: Evidence) -> np.uint64:
    """The levels in which walls are looked for: above the skirting, below the ceiling."""
    ceiling = evidence.frame.ceiling_z
    top = 6.0 if ceiling is None else ceiling - evidence.frame.floor_z - 0.1
    return height_mask(_SKIRTING, top)


def _faces_free_space(
    evidence: Evidence, facing: Facing, u: Float, v: Float, skin: int = 0
) -> NDArray[np.bool_]:
    """(N,) True where the space in front of a surfel is open: free there, or at least not free behind.

    ``skin`` cells just in front may hold the surface's own noise.
    """
    a, b = facing.axis, 1 - facing.axis
    band = height_mask(0.5, 1.9)
    tall = count_bits(evidence.hits & wall_band(evidence)) >= 4
    free = np.repeat(np.repeat((evidence.free & band) != 0, 2, axis=0), 2, axis=1)
    if a == 1:
        tall, free = tall.T, free.T
    return np.asarray(
        _first_in_front(
            u,
            v,
            evidence.origin[a],
            evidence.origin[b],
            evidence.fine,
            facing.sign,
            skin,
            np.ascontiguousarray(tall),
            np.ascontiguousarray(free),
        )
    )


@njit(cache=True, nogil=True)
def _first_in_front(u, v, ou, ov, cell, sign, skin, tall, free):  # type: ignore[no-untyped-def]
    out = np.zeros(len(u), dtype=np.bool_)
    nv, nu = tall.shape
    for i in range(len(u)):
        iu, iv = int((u[i] - ou) / cell), int((v[i] - ov) / cell)
        seen = np.zeros(2, dtype=np.bool_)  # free space in front, behind
        open_ = np.zeros(2, dtype=np.bool_)  # no wall within reach in front, behind
        for side in range(2):
            open_[side] = True
            for step in range(1, 9):
                ju = iu + (sign * step if side == 0 else -sign * step)
                if ju < 0 or ju >= nu or iv < 0 or iv >= nv or (step > skin and tall[iv, ju]):
                    open_[side] = seen[side]
                    break
                if free[iv, ju]:
                    seen[side] = True
                    break
        out[i] = seen[0] or (open_[0] and not seen[1])
    return out


@njit(cache=True, nogil=True)
def _label_cells(node, nv, nu):  # type: ignore[no-untyped-def]
    """Spread each chain two cells beyond its columns, where the tails of the noise are."""
    label = np.full((nv, nu), -1, dtype=np.int32)
    for reach in (0, 1, 2):
        for k in range(len(node)):
            for iu in range(max(0, node[k, 2] - reach), min(nu, node[k, 3] + reach + 1)):
                if label[node[k, 1], iu] < 0:
                    label[node[k, 1], iu] = node[k, 0]
    return label


def _fit_histograms(
    evidence: Evidence, facing: Facing, surfaces: FacingSurfaces, label: NDArray[np.int32]
) -> tuple[Float, Float, Float]:
    """For each chain: histogram of distances to its mean offset, mean variance inside surfels, points."""
    u, v = normal_and_tangent(evidence, facing)
    a, b = facing.axis, 1 - facing.axis
    weight = count_bits(surfaces.bits).astype(float)
    total = np.bincount(surfaces.node[:, 0], weights=weight, minlength=surfaces.chains)
    mean = (
        np.bincount(surfaces.node[:, 0], weights=weight * surfaces.offset, minlength=surfaces.chains) / total
    )
    if evidence.viewpoints:
        toward = evidence.view[:, a] * facing.sign
    else:  # the other face of a thin wall is within reach: only what has free space before it counts
        toward = _faces_free_space(evidence, facing, u, v, _SKIN).astype(np.float64)
    band = wall_band(evidence)
    low = _SKIRTING
    high = LEVEL * int(band).bit_length()
    hist, spread, points = _histograms(
        u,
        v,
        evidence.xyz[:, 2],
        toward,
        evidence.count,
        evidence.spread[:, a],
        label,
        mean,
        evidence.origin[a],
        evidence.origin[b],
        evidence.fine,
        low,
        high,
    )
    return np.column_stack([mean, hist]), spread, points


@njit(cache=True, nogil=True)
def _histograms(u, v, z, toward, count, variance, label, mean, ou, ov, fine, low, high):  # type: ignore[no-untyped-def]
    nv, nu = label.shape
    hist = np.zeros((len(mean), 2 * _HIST))
    spread, points = np.zeros(len(mean)), np.zeros(len(mean))
    for i in range(len(u)):
        if toward[i] < 0.03 or z[i] < low or z[i] > high:
            continue
        iu, iv = int(np.floor((u[i] - ou) / fine)), int(np.floor((v[i] - ov) / fine))
        if not (0 <= iu < nu and 0 <= iv < nv):
            continue
        c = label[iv, iu]
        if c < 0:
            continue
        k = int(np.floor((u[i] - mean[c]) / _HIST_BIN)) + _HIST
        if 0 <= k < 2 * _HIST:
            hist[c, k] += 1.0
            spread[c] += variance[i]
            points[c] += count[i]
    for c in range(len(mean)):
        spread[c] /= max(hist[c].sum(), 1.0)
    return hist, spread, points


def _robust_offset(histogram: Float) -> tuple[float, float, float]:
    """Offset, standard deviation and weight of the main peak: a mean within 2.5 sigma, iterated."""
    start, counts = histogram[0], histogram[1:]
    x = (np.arange(2 * _HIST) - _HIST + 0.5) * _HIST_BIN
    centre, sigma, weight = 0.0, 0.04, 0.0
    for _ in range(6):
        w = counts * (np.abs(x - centre) < 2.5 * sigma + _HIST_BIN)
        weight = float(w.sum())
        if weight == 0:
            return start, 0.04, 0.0
        centre = float((w * x).sum() / weight)
        sigma = max(0.002, math.sqrt(float((w * (x - centre) ** 2).sum() / weight)) * 1.1)
    return start + centre, sigma, weight


def _segment(
    evidence: Evidence,
    facing: Facing,
    surfaces: FacingSurfaces,
    mine: NDArray[np.int64],
    histogram: Float,
    spread: float,
    points: float,
    config: SegmentsConfig,
) -> tuple[LayoutSegment, SegmentRows] | None:
    """A chain as a segment, or None where it is too small."""
    rows = surfaces.node[mine, 1]
    bits = surfaces.bits[mine] & wall_band(evidence)
    fine = evidence.fine
    area = float(count_bits(bits).sum()) * fine * LEVEL
    length = len(np.unique(rows)) * fine
    if length < config.min_length or area < config.min_area:
        return None
    offset, sigma, weight = _robust_offset(histogram)
    sigma = math.sqrt(sigma**2 + spread)
    structural, words = _is_structural(evidence, facing, rows, bits, offset, config)
    union = int(np.bitwise_or.reduce(bits))
    base = float(evidence.origin[1 - facing.axis])
    segment = LayoutSegment(
        id="",
        facing=facing,
        offset=offset,
        start=base + float(rows.min()) * fine,
        end=base + float(rows.max() + 1) * fine,
        z_min=LEVEL * ((union & -union).bit_length() - 1),
        z_max=LEVEL * union.bit_length(),
        area=area,
        points=int(points),
        residual=1.96 * sigma,
        sigma=sigma / math.sqrt(max(weight, 1.0)),
        structural=structural,
        evidence=words,
    )
    return segment, SegmentRows(rows, bits)


def _is_structural(
    evidence: Evidence,
    facing: Facing,
    rows: NDArray[np.int64],
    bits: NDArray[np.uint64],
    offset: float,
    config: SegmentsConfig,
) -> tuple[bool, tuple[str, ...]]:
    """Structure or furniture, by height reached, contact with the ceiling, and being looked over."""
    tall = (bits & ~height_mask(0, config.furniture_height + LEVEL)) != 0
    over = _looked_over(evidence, facing, rows, bits, offset)
    ceiling = evidence.frame.ceiling_z
    top = np.inf if ceiling is None else max(ceiling - evidence.frame.floor_z - config.ceiling_gap, 1.0)
    reaches = ceiling is not None and float(((bits & ~height_mask(0, top)) != 0).mean()) >= 0.2
    if reaches and over < 0.6:
        return True, ("reaches ceiling",)
    if over > 0.3:  # a cabinet, a curtain, a counter: there is air between it and the ceiling
        return False, ("looked over",)
    if tall.mean() >= 0.3 or tall.sum() * evidence.fine >= 1.0:
        return True, ("above furniture",)
    if len(np.unique(rows)) * evidence.fine >= 1.0 and over < 0.1:
        return True, ("long, top not seen",)
    return False, ("low",)


def _looked_over(
    evidence: Evidence, facing: Facing, rows: NDArray[np.int64], bits: NDArray[np.uint64], offset: float
) -> float:
    """0 to 1: share of the rows where free space was seen just behind and above the surface.

    The farther of the two columns asked may lie on the other side of a thin wall: it counts only where the
    wall's other face was not seen to go on above in between.
    """
    a = facing.axis
    grid = evidence.free if a == 0 else evidence.free.T
    near = offset - facing.sign * np.array([0.5, 1.5]) * evidence.cell
    iu = np.clip(((near - evidence.origin[a]) / evidence.cell).astype(int), 0, grid.shape[1] - 1)
    iv = np.clip(rows // 2, 0, grid.shape[0] - 1)
    ceiling = evidence.frame.ceiling_z
    limit = 2.6 if ceiling is None else ceiling - evidence.frame.floor_z - 0.1
    top = np.floor(np.log2(np.maximum(bits, 1).astype(np.float64))).astype(np.uint64)
    above = (ALL_LEVELS << (top + np.uint64(2))) & height_mask(0.5, limit)
    goes_on = count_bits(_surfaces_behind(evidence, facing, rows, offset) & above) >= _OTHER_FACE
    free = grid[iv, iu[0]] | np.where(goes_on, np.uint64(0), grid[iv, iu[1]])
    return float(((free & above) != 0).mean())


def _surfaces_behind(
    evidence: Evidence, facing: Facing, rows: NDArray[np.int64], offset: float
) -> NDArray[np.uint64]:
    """(R,) levels at which anything was hit within the thickness of a wall behind its face."""
    a = facing.axis
    hits = evidence.hits if a == 0 else evidence.hits.T
    at = np.sort(offset - facing.sign * np.array(_BEHIND))
    low, high = np.clip(np.floor((at - evidence.origin[a]) / evidence.fine).astype(int), 0, hits.shape[1] - 1)
    levels: NDArray[np.uint64] = np.bitwise_or.reduce(
        hits[np.clip(rows, 0, hits.shape[0] - 1), low : high + 1], axis=1
    )
    return levels

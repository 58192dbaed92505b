"""Columns over the plan: which heights were hit in each, as bits, and where vertical surfaces run.

Bit k of a column stands for the heights from ``k * LEVEL`` to ``(k + 1) * LEVEL`` above the floor, so that
questions like "does it reach the ceiling?" or "is it free from 0.4 to 1.8 m?" are one machine instruction.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import TypeVar

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]
Bits = NDArray[np.uint64]
T = TypeVar("T", bound=np.generic)

LEVEL = 0.1  # m
LEVELS = 62
STRIP_CELLS = 2_000_000  # columns that are worked on together: 100 MB of what is kept of each meanwhile


@lru_cache(maxsize=256)  # the same few heights are asked for at every plane
def height_mask(low: float, high: float) -> np.uint64:
    """Bits of the levels that lie wholly between two heights (metres above the floor)."""
    first = max(0, round(np.ceil(low / LEVEL - 1e-6)))
    last = min(LEVELS, round(np.floor(high / LEVEL + 1e-6)))
    return np.uint64(0) if last <= first else np.uint64(((1 << (last - first)) - 1) << first)


def count_bits(bits: Bits) -> NDArray[np.int64]:
    """Number of set bits of each element."""
    return np.bitwise_count(bits).astype(np.int64)


def levels_in_all(grid: Bits, columns: Iterable[int]) -> Bits:
    """(rows,) levels of ``grid`` (rows, columns) that are set in all of its ``columns``.

    Several times as fast as a reduction along so short an axis.
    """
    out = np.full(len(grid), ~np.uint64(0))
    for column in columns:
        out &= grid[:, column]
    return out


def merged(fine: Bits) -> Bits:
    """Union of each 2 x 2 block of columns."""
    return np.asarray(fine[::2, ::2] | fine[1::2, ::2] | fine[::2, 1::2] | fine[1::2, 1::2])


def strips(rows: int, columns: int, cells: int = STRIP_CELLS) -> list[tuple[int, int]]:
    """First and last row of the strips, of an even number of rows and about so many ``cells``, of a grid."""
    step = max(2, cells // max(columns, 1) // 2 * 2)
    return [(first, min(first + step, rows)) for first in range(0, rows, step)] or [(0, 0)]


def by_strips(grid: Bits, work: Callable[[Bits], NDArray[T]]) -> NDArray[T]:
    """What ``work`` makes of the rows of ``grid``, strip by strip: what it needs meanwhile stays small."""
    return np.concatenate([work(grid[first:last]) for first, last in strips(*grid.shape)])


@njit(cache=True, inline="always")
def popcount(value):  # type: ignore[no-untyped-def]
    """Set bits of a 64-bit word (SWAR)."""
    v = value - ((value >> np.uint64(1)) & np.uint64(0x5555555555555555))
    v = (v & np.uint64(0x3333333333333333)) + ((v >> np.uint64(2)) & np.uint64(0x3333333333333333))
    v = (v + (v >> np.uint64(4))) & np.uint64(0x0F0F0F0F0F0F0F0F)
    return (v * np.uint64(0x0101010101010101)) >> np.uint64(56)


@njit(cache=True, nogil=True)
def hit_columns(xyz, origin, cell, out, below=0.0):  # type: ignore[no-untyped-def]
    """Set the bits of ``out`` (ny, nx): levels in which any of the (N, 3) points (z above the floor) lies.

    What lies less than ``below`` metres under the floor is of its level.
    """
    ny, nx = out.shape
    for i in range(len(xyz)):
        ix, iy = int(np.floor((xyz[i, 0] - origin[0]) / cell)), int(np.floor((xyz[i, 1] - origin[1]) / cell))
        k = int(np.floor(xyz[i, 2] / LEVEL))
        if k < 0 and xyz[i, 2] > -below:
            k = 0
        if 0 <= ix < nx and 0 <= iy < ny and 0 <= k < LEVELS:
            out[iy, ix] |= np.uint64(1) << np.uint64(k)


@njit(cache=True, nogil=True)
def facing_columns(xyz, row, column, level, chosen, axis, origin, cell, first, last, nu):  # type: ignore[no-untyped-def]
    """Bits, and number and sums of u and v, of the ``chosen`` among the points ``row`` of ``xyz``.

    Of the columns in rows ``first`` to ``last`` of the grid, (last - first, nu). Grid rows run along v,
    columns along u, which is the axis ``axis``; u and v are counted from the corner of the ``column`` (N, 2)
    along x and y that a point lies in.
    """
    bits = np.zeros((last - first, nu), dtype=np.uint64)
    sums = np.zeros((last - first, nu, 3), dtype=np.float32)
    for n in range(len(row)):
        if chosen[n] and first <= column[n, 1 - axis] < last:
            iu, iv, i = column[n, axis], column[n, 1 - axis], row[n]
            at = iv - first
            bits[at, iu] |= np.uint64(1) << np.uint64(level[n])
            sums[at, iu, 0] += 1.0
            sums[at, iu, 1] += xyz[i, axis] - (origin[axis] + iu * cell)
            sums[at, iu, 2] += xyz[i, 1 - axis] - (origin[1 - axis] + iv * cell)
    return bits, sums


@njit(cache=True, nogil=True)
def surface_offsets(bits, sums, band, cell, half, tangent, least):  # type: ignore[no-untyped-def]
    """Where the columns line up along v: the local offset (cells along u, as a float), else NaN.

    In a window of ``2 * half + 1`` cells the covariance of the columns, each weighted by its number of levels
    in ``band``, must be long along v: its main direction within the angle whose tangent is ``tangent``.
    """
    nv, nu = bits.shape
    out = np.full((nv, nu), np.nan, dtype=np.float32)
    places = np.flatnonzero(bits & band)
    weight, offset = (
        np.zeros((nv, nu)),
        np.empty((nv, nu, 2)),
    )  # each column is asked for by all its neighbours
    for place in places:
        iv, iu = place // nu, place % nu
        weight[iv, iu] = popcount(bits[iv, iu] & band)
        for k in range(2):
            offset[iv, iu, k] = sums[iv, iu, 1 + k] / (sums[iv, iu, 0] * cell)
    for place in places:
        iv, iu = place // nu, place % nu
        w = wu = wv = wuu = wuv = wvv = 0.0
        for jv in range(max(0, iv - half), min(nv, iv + half + 1)):
            for ju in range(max(0, iu - half), min(nu, iu + half + 1)):
                p = weight[jv, ju]
                if p == 0.0:
                    continue
                du, dv = ju - iu + offset[jv, ju, 0], jv - iv + offset[jv, ju, 1]
                w += p
                wu += p * du
                wv += p * dv
                wuu += p * du * du
                wuv += p * du * dv
                wvv += p * dv * dv
        if w < least:
            continue
        mu, mv = wu / w, wv / w
        cuu, cuv, cvv = wuu / w - mu * mu, wuv / w - mu * mv, wvv / w - mv * mv
        if cvv < 1.0 or cuu > 0.45 * cvv or abs(cuv) > tangent * (cvv - cuu):
            continue
        if abs(mu - offset[iv, iu, 0]) <= 1.6:
            out[iv, iu] = iu + mu
    return out


@njit(cache=True, nogil=True)
def surface_cells(offsets, bits, first, start, stop):  # type: ignore[no-untyped-def]
    """The surface columns in rows ``start`` to ``stop``, in order: what :func:`link_chains` needs of them.

    (K, 2) row, to which ``first`` is added, and column; (K,) offset; (K, 3) bits of the column before, of
    this one and of the one behind.
    """
    nu = offsets.shape[1]
    places = np.flatnonzero(~np.isnan(offsets[start:stop]))  # ten times as fast as looking at each cell here
    cell = np.empty((len(places), 2), dtype=np.int32)
    offset, word = np.empty(len(places), dtype=np.float32), np.zeros((len(places), 3), dtype=np.uint64)
    for k in range(len(places)):
        iv, iu = start + places[k] // nu, places[k] % nu
        cell[k, 0], cell[k, 1], offset[k] = first + iv, iu, offsets[iv, iu]
        for d in range(-1, 2):
            if 0 <= iu + d < nu:
                word[k, 1 + d] = bits[iv, iu + d]
    return cell, offset, word


@njit(cache=True, nogil=True)
def link_chains(cell, offset, word, nv, tolerance, gap):  # type: ignore[no-untyped-def]
    """Link :func:`surface_cells` of ``nv`` rows along v into chains of nearly constant offset.

    ``tolerance`` and ``gap`` are in cells. Returns the nodes (chain, row, first column, last column, offset,
    bits), one for each row that a chain crosses, in order of rows, and the number of chains.
    """
    most = nv * 8 + 64
    chain_u, chain_w, chain_last = np.zeros(most), np.zeros(most), np.full(most, -(1 << 30))
    recent = np.zeros(most)
    n_chains, n_nodes = 0, 0
    node = np.zeros((4096, 4), dtype=np.int64)
    node_u, node_bits = np.zeros(4096), np.zeros(4096, dtype=np.uint64)
    active = np.zeros(most, dtype=np.int64)
    n_active, before, k = 0, -1, 0
    while k < len(cell):
        iv, first = cell[k, 0], cell[k, 1]
        if iv != before:
            n_active, before = _keep_recent(active, n_active, chain_last, iv - gap), iv
        k, u, total, bits = _read_run(cell, offset, word, k)
        best = _nearest_chain(u, active[:n_active], recent, chain_u, chain_last, iv, tolerance)
        if best < 0:
            if n_chains == most:
                continue
            best = n_chains
            n_chains += 1
            active[n_active] = best
            n_active += 1
            recent[best] = u
        chain_u[best] = (chain_u[best] * chain_w[best] + u * total) / (chain_w[best] + total)
        chain_w[best] += total
        recent[best] += 0.2 * (u - recent[best])
        chain_last[best] = iv
        if n_nodes == len(node):
            node = np.concatenate((node, np.zeros_like(node)))
            node_u = np.concatenate((node_u, np.zeros_like(node_u)))
            node_bits = np.concatenate((node_bits, np.zeros_like(node_bits)))
        node[n_nodes, 0], node[n_nodes, 1], node[n_nodes, 2] = best, iv, first
        node[n_nodes, 3] = cell[k - 1, 1]
        node_u[n_nodes], node_bits[n_nodes] = u, bits
        n_nodes += 1
    return node[:n_nodes], node_u[:n_nodes], node_bits[:n_nodes], n_chains


@njit(cache=True, nogil=True)
def _keep_recent(active, count, last, least):  # type: ignore[no-untyped-def]
    """Move the chains met in row ``least`` or later to the front of ``active``; returns how many they are."""
    kept = 0
    for a in range(count):
        if last[active[a]] >= least:
            active[kept] = active[a]
            kept += 1
    return kept


@njit(cache=True, nogil=True)
def _read_run(cell, offset, word, first):  # type: ignore[no-untyped-def]
    """The neighbouring columns of one row that agree from ``first``: end, mean offset, weight and bits."""
    k, total, mean, bits = first, 0.0, 0.0, word[first, 0]  # the neighbours hold the tails of the noise
    while k < len(cell) and cell[k, 0] == cell[first, 0] and cell[k, 1] == cell[first, 1] + k - first:
        if total > 0 and abs(offset[k] - mean / total) > 0.8:
            break
        p = float(popcount(word[k, 1]))
        mean += p * offset[k]
        total += p
        bits |= word[k, 1]
        k += 1
    return k, mean / total, total, bits | word[k - 1, 2]


@njit(cache=True, nogil=True)
def _nearest_chain(u, active, recent, mean, last, row, tolerance):  # type: ignore[no-untyped-def]
    """The chain nearest to ``u`` that has no node in this row; -1 where none is within ``tolerance``."""
    best, best_d = -1, tolerance
    for a in range(len(active)):
        c = active[a]
        d = max(abs(recent[c] - u), abs(mean[c] - u))
        if last[c] < row and d < best_d:
            best, best_d = c, d
    return best

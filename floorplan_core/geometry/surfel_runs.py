"""Surfels that do not fit into memory: parts of the table on disk, and what they add up to.

Sums are integers, so that a voxel met in several parts is their sum, whichever way they were cut. Each part
(a *run*) is kept in partitions by the hash of its voxels; partition by partition all runs are added up in
memory (a Grace hash join, Kitsuregawa et al. 1983). The surfels come out in the order of their first points,
as one table in memory would hold them: what is made of them does not depend on how much memory there was.

In: rows of :class:`~floorplan_core.geometry.surfel_map.SurfelMap`. Out: the same rows, on disk. Cost: three
sequential passes over the rows; memory of one partition, a thirty-second of all.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.scratch import disk_array, let_go
from floorplan_core.geometry.voxel_keys import BIAS, block_slot, pack, spread

Keys = NDArray[np.int64]
Sums = NDArray[np.int32]

_PARTS = 32
_PART_SHIFT = 26  # of a hash of 31 bits: the highest five, the others find the slot within a partition
_MOST = 219_000  # points whose sums of squares surely stay within 32 bits; no more are added up
_SPARSE = 4  # slots of the hash for each row


@dataclass(frozen=True)
class _Run:
    """One part of the table."""

    keys: Keys  # (n,) partition by partition, each in the order of first points
    sums: Sums  # (n, 9) the same
    part: NDArray[np.uint8]  # (n,) partition of each row in the order of first points
    starts: NDArray[np.int64]  # (_PARTS + 1,) where the partitions begin


class SurfelRuns:
    """Rows that were taken out of memory."""

    def __init__(self) -> None:
        self._runs: list[_Run] = []

    def __len__(self) -> int:
        return len(self._runs)

    def append(self, keys: Keys, sums: Sums) -> None:
        """Write (n,) keys and (n, columns) sums, all of different voxels, to disk."""
        part = disk_array((len(keys),), np.uint8)
        counts = np.zeros(_PARTS, dtype=np.int64)
        _assign(keys, part, counts)
        starts = np.concatenate([[0], np.cumsum(counts)])
        out = disk_array((len(keys),), np.int64), disk_array(sums.shape, np.int32)
        _scatter(keys, sums, part, starts[:-1].copy(), *out)
        for array in (*out, part):
            let_go(array)
        self._runs.append(_Run(*out, part, starts))

    def merge(self) -> tuple[Keys, Sums]:
        """All voxels once, in the order of their first points: arrays on disk. No run is left."""
        runs, self._runs = self._runs, []
        columns = runs[0].sums.shape[1]
        rows = sum(len(run.keys) for run in runs)
        keys, sums = disk_array((rows,), np.int64), disk_array((rows, columns), np.int32)
        first = [disk_array((len(run.keys),), np.bool_) for run in runs]
        starts = np.zeros(_PARTS, dtype=np.int64)
        used = 0
        for p in range(_PARTS):
            starts[p] = used
            used += _add_up(runs, first, p, keys[used:], sums[used:])
            for array in (keys, sums, *(run.sums for run in runs)):
                let_go(array)
        out = disk_array((used,), np.int64), disk_array((used, columns), np.int32)
        at = 0
        for run, new in zip(runs, first, strict=True):
            at = _in_order(run.part, new, run.starts[:-1].copy(), starts, keys, sums, *out, at)
            let_go(out[1])
        return out


def _add_up(runs: list[_Run], first: list[NDArray[np.bool_]], p: int, keys: Keys, sums: Sums) -> int:
    """Put one partition of all ``runs`` together; ``first`` tells which rows are of new voxels. How many."""
    most = sum(int(run.starts[p + 1] - run.starts[p]) for run in runs)
    table = np.zeros(1 << max(10, (_SPARSE * most - 1).bit_length()), dtype=np.int32)
    used = 0
    for run, new in zip(runs, first, strict=True):
        rows = slice(int(run.starts[p]), int(run.starts[p + 1]))
        used = int(_join(run.keys[rows], run.sums[rows], table, keys, sums, used, new[rows]))
    return used


@njit(cache=True, nogil=True)
def _assign(keys: Any, part: Any, counts: Any) -> None:
    """The partition of each key, whole blocks together, and how many keys are in each."""
    low = (1 << 21) - 1
    for i in range(len(keys)):
        x, y, z = (keys[i] >> 42) - BIAS, ((keys[i] >> 21) & low) - BIAS, (keys[i] & low) - BIAS
        p = spread(pack(x >> 2, y >> 2, z >> 2)) >> _PART_SHIFT
        part[i] = p
        counts[p] += 1


@njit(cache=True, nogil=True)
def _scatter(keys: Any, sums: Any, part: Any, place: Any, out_keys: Any, out_sums: Any) -> None:
    """Sort the rows into their partitions, which begin at ``place``; the order within each stays."""
    for i in range(len(keys)):
        p = part[i]
        to = place[p]
        place[p] += 1
        out_keys[to] = keys[i]
        for k in range(sums.shape[1]):
            out_sums[to, k] = sums[i, k]


@njit(cache=True, nogil=True)
def _join(keys: Any, sums: Any, table: Any, out_keys: Any, out_sums: Any, used: Any, new: Any) -> Any:
    """Add rows to those that are there; returns how many there are then."""
    mask, low = len(table) - 1, (1 << 21) - 1
    for i in range(len(keys)):
        key = keys[i]
        at = block_slot((key >> 42) - BIAS, ((key >> 21) & low) - BIAS, (key & low) - BIAS, mask)
        while table[at] != 0 and out_keys[table[at] - 1] != key:
            at = (at + 1) & mask
        r = table[at] - 1
        new[i] = r < 0
        if r < 0:
            r = used
            used += 1
            table[at] = used
            out_keys[r] = key
            for k in range(sums.shape[1]):
                out_sums[r, k] = sums[i, k]
        elif out_sums[r, 0] + sums[i, 0] <= _MOST:  # its mean is long settled otherwise
            for k in range(sums.shape[1]):
                out_sums[r, k] += sums[i, k]
    return used


@njit(cache=True, nogil=True)
def _in_order(
    part: Any, new: Any, place: Any, taken: Any, keys: Any, sums: Any, out_keys: Any, out_sums: Any, at: Any
) -> Any:
    """Append the voxels that a run brought first, in the order of its rows; returns how many there are.

    ``place``: next row of each partition of the run; ``taken``: next of the partition that was added up.
    """
    for i in range(len(part)):
        p = part[i]
        row = place[p]
        place[p] += 1
        if new[row]:
            source = taken[p]
            taken[p] += 1
            out_keys[at] = keys[source]
            for k in range(sums.shape[1]):
                out_sums[at, k] = sums[source, k]
            at += 1
    return at

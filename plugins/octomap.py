"""OctoMap .bt and .ot: occupied voxels as points, and the free ones that the real sensor carved.

Coarser leaves are expanded to the finest resolution, a batch at a time. The file's own free space goes along
with the points (``PointChunk.free``), so that it need not be cast again from viewpoints that nobody kept.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from floorplan_core.api import (
    SAMPLE_POINTS,
    EmptyInput,
    InputError,
    Observer,
    PointSource,
    RawChunk,
    Reader,
    ReadOptions,
    Reconstruction,
    assemble,
    hookimpl,
)

BINARY, FULL = b"# Octomap OcTree binary file", b"# Octomap OcTree file"
RECORDS = {"OcTree": 4, "ColorOcTree": 7, "OcTreeStamped": 8}  # bytes of a node's value in a .ot file
MAX_HEADER_BYTES = 1 << 16
BATCH_LEAVES = 1 << 16
BATCH_VOXELS = 1 << 18  # expanded at a time: finding their places takes six times their coordinates
MAX_VOXELS = 1 << 28  # of the finest size: a storey of 10,000 m2 at 5 cm
_OCCUPIED = 1  # state of a leaf, as in ``_octree``
RESOLUTIONS = (1e-3, 10.0)  # metres: what a map of a building may have


@dataclass(frozen=True)
class OctoMapHeader:
    """The text before the tree."""

    binary: bool  # .bt: two bits a node; else .ot
    kind: str  # "OcTree"
    resolution: float  # metres, side of the finest voxel
    nodes: int
    offset: int  # bytes before the tree


@hookimpl
def floorcast_readers() -> list[Reader]:
    return [OctoMapReader()]


class OctoMapReader:
    """Occupancy octrees."""

    name = "OctoMap"
    suffixes: tuple[str, ...] = (".bt", ".ot")
    description = "OctoMap .bt and .ot: occupied and free voxels"

    def sniff(self, path: Path, head: bytes) -> float:
        """1 where the file begins with the line that every OctoMap begins with."""
        return 1.0 if head.startswith((BINARY, FULL)) else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the map; :class:`InputError` where header and tree do not agree."""
        header = read_header(path)
        occupied, free = count_voxels(path, header, observer)
        if occupied == 0:
            raise EmptyInput(f"{path.name} is an OctoMap without occupied voxels.")
        note = (
            f"{path.name} holds {occupied:,} occupied and {free:,} free voxels of "
            f"{header.resolution:g} m; its free space is used as it is."
        )
        source = PointSource(
            path,
            "OctoMap",
            partial(_chunks, path, header),
            partial(_sample, path, header, occupied),
            occupied,
            notes=(note,),
            unit="m",
            up="z",
        )
        return assemble(source, options, observer)


def read_header(path: Path) -> OctoMapHeader:
    """Parse the header; :class:`InputError` names what is missing."""
    with path.open("rb") as handle:
        head = handle.read(MAX_HEADER_BYTES)
    end = re.search(rb"^data\s*?\n", head, re.MULTILINE)
    if end is None:
        raise InputError(f"{path.name} claims to be an OctoMap but its header does not end with 'data'.")
    lines = [line.split() for line in head[: end.start()].decode("latin-1").splitlines()]
    words = {w[0]: w[1] for w in lines if len(w) > 1 and not w[0].startswith("#")}
    try:
        resolution, nodes = float(words["res"]), int(words["size"])
    except (KeyError, ValueError):
        raise InputError(f"The header of the OctoMap {path.name} has no valid 'res' and 'size'.") from None
    if not (math.isfinite(resolution) and RESOLUTIONS[0] <= resolution <= RESOLUTIONS[1]):
        raise InputError(f"The OctoMap {path.name} has voxels of {resolution:g} m, which no building needs.")
    kind, binary = words.get("id", "OcTree"), head.startswith(BINARY)
    if not binary and kind not in RECORDS:
        raise InputError(
            f"{path.name} is an OctoMap of the kind {kind!r}; readable are {', '.join(RECORDS)}."
        )
    return OctoMapHeader(binary, kind, resolution, nodes, end.end())


def count_voxels(path: Path, header: OctoMapHeader, observer: Observer) -> tuple[int, int]:
    """How many finest voxels are occupied and free; :class:`InputError` where they are absurdly many."""
    occupied = free = 0
    for leaves in _leaves(path, header):
        observer.check_cancelled()
        sizes = 8.0 ** leaves[:, 3]
        hit = leaves[:, 4] == _OCCUPIED
        occupied, free = occupied + int(sizes[hit].sum()), free + int(sizes[~hit].sum())
        if occupied + free > MAX_VOXELS:
            raise InputError(
                f"The OctoMap {path.name} holds more than {MAX_VOXELS:,} voxels of {header.resolution:g} m; "
                "it is damaged, or needs a coarser resolution."
            )
    return occupied, free


def _leaves(path: Path, header: OctoMapHeader) -> Iterator[np.ndarray[Any, np.dtype[np.int64]]]:
    """(K, 5) int64 leaves, at most ``BATCH_LEAVES`` at a time."""
    from floorcast_plugins import _octree

    if path.stat().st_size <= header.offset:
        raise InputError(f"The OctoMap {path.name} ends after its header.")
    data = np.memmap(path, dtype=np.uint8, mode="r", offset=header.offset)
    stack = np.zeros((_octree.STACK, 5), dtype=np.int64)
    at, top, more = 0, 0, True
    while more:
        leaves = np.empty((BATCH_LEAVES, 5), dtype=np.int64)
        if header.binary:
            at, top, count = _octree.binary_leaves(data, at, stack, top, leaves)
        else:
            at, top, count = _octree.full_leaves(data, RECORDS[header.kind], at, stack, top, leaves)
        if top == _octree.CUT:
            raise InputError(
                f"The OctoMap {path.name} is truncated: its tree goes on after {at + header.offset:,} bytes."
            )
        if top == _octree.BAD:
            raise InputError(
                f"The OctoMap {path.name} is damaged: a node near byte {at + header.offset:,} lies deeper "
                f"than the {_octree.DEPTH} levels of an OctoMap."
            )
        more = top > 0
        yield leaves[:count]


def _chunks(path: Path, header: OctoMapHeader) -> Iterator[RawChunk]:
    """Occupied voxels as points, free ones beside them; at most ``BATCH_VOXELS`` of each at a time."""
    for leaves in _leaves(path, header):
        hit = leaves[:, 4] == _OCCUPIED
        occupied = _expand(leaves[hit], header.resolution)
        free = _expand(leaves[~hit], header.resolution)
        none = np.empty((0, 3))
        while True:
            points, space = next(occupied, none), next(free, none)
            if not len(points) and not len(space):
                break
            yield RawChunk(points, free=space, free_size=header.resolution)


def _expand(leaves: Any, resolution: float) -> Iterator[Any]:
    """Centres of the finest voxels of the leaves, at most ``BATCH_VOXELS`` at a time."""
    from floorcast_plugins import _octree

    total = int((8 ** leaves[:, 3]).sum())
    for first in range(0, total, BATCH_VOXELS):
        yield _octree.voxels(leaves, np.arange(first, min(total, first + BATCH_VOXELS)), resolution)


def _sample(path: Path, header: OctoMapHeader, occupied: int) -> RawChunk:
    """Every so-many-th occupied voxel, without expanding the others."""
    from floorcast_plugins import _octree

    step, parts = max(1, occupied // SAMPLE_POINTS), []
    for leaves in _leaves(path, header):
        hit = leaves[leaves[:, 4] == _octree.OCCUPIED]
        number = np.arange(0, int((8 ** hit[:, 3]).sum()), step)
        parts.append(_octree.voxels(hit, number, header.resolution))
    return RawChunk(np.concatenate(parts))

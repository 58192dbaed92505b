"""Meshes (trimesh): PLY with faces, OBJ, STL, GLB and glTF, OFF, sampled evenly by area.

Points lie on the triangles about ``SPACING`` apart, from a low-discrepancy sequence: no chance, no gaps.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from floorcast_plugins._mesh_files import check_mesh, load_triangles, mesh_kind
from floorcast_plugins._mesh_pieces import Pieces, check_memory, pieces_of
from floorplan_core.api import (
    CHUNK_POINTS,
    SAMPLE_POINTS,
    EmptyInput,
    Observer,
    PointSource,
    RawChunk,
    Reader,
    ReadOptions,
    Reconstruction,
    assemble,
    damaged,
    hookimpl,
)

SPACING = 0.025  # metres between points: two to a surfel of 5 cm along each axis
MAX_POINTS = 50_000_000  # 31,000 m2 of surface; larger ones are sampled more coarsely
FAR = 100.0  # times the median distance from the middle: a corner beyond is damage, or a sky
BLOCK = 1 << 16  # triangles that are worked on at a time
SAMPLE_TRIANGLES = 1 << 18  # of a mesh that is not held, which show where it lies
# The R2 sequence (M. Roberts 2018): the plane's counterpart of the golden ratio.
R2 = (0.7548776662466927, 0.5698402909980532)


@hookimpl
def floorcast_readers() -> list[Reader]:
    return [MeshReader()]


class MeshReader:
    """Triangles instead of points."""

    name = "mesh"
    suffixes: tuple[str, ...] = (".obj", ".stl", ".glb", ".gltf", ".off")
    description = "Meshes: PLY with faces, OBJ, STL, GLB and glTF, OFF"

    def sniff(self, path: Path, head: bytes) -> float:
        """0.95 where the first bytes are those of a mesh."""
        return 0.95 if head and mesh_kind(path, head) else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the mesh; :class:`InputError` where it is damaged or empty."""
        with path.open("rb") as handle:
            kind = mesh_kind(path, handle.read(4096))
        check_mesh(path, kind)
        mesh = Mesh.of(path, kind)
        observer.check_cancelled()
        # The unit decides how dense the points must be, and only the points show the unit.
        sample = _sample(mesh, path.name)
        probe = mesh.source(path, kind, mesh.spacing_of(SAMPLE_POINTS), sample)
        scale = assemble(probe, options, Observer()).local_frame.scale
        spacing = max(SPACING / scale, mesh.spacing_of(MAX_POINTS))
        return assemble(mesh.source(path, kind, spacing, sample, scale), options, observer)


@dataclass(frozen=True)
class Mesh:
    """All parts of a scene in one frame."""

    blocks: Callable[
        [], Iterator[Any]
    ]  # passes over (B, 3, 3) corners, at most ``BLOCK`` triangles at a time
    triangles: int
    loose: Any  # (L, 3) points that belong to no triangle
    area: float  # file units squared
    left_out: int = 0  # triangles with a corner that is absurdly far away

    @staticmethod
    def of(path: Path, kind: str) -> Mesh:
        """Open a mesh; :class:`EmptyInput` where nothing in it can be sampled."""
        pieces = pieces_of(path, kind)
        if pieces is None:
            check_memory(path, kind)
        mesh = _loaded(path, kind) if pieces is None else _streamed(pieces)
        kept, area = 0, 0.0
        for corners in mesh.blocks():
            kept, area = kept + len(corners), area + float(_areas(corners).sum())
        if not area > 0 and not len(mesh.loose):
            raise EmptyInput(f"{path.name} is a mesh without any surface.")
        return replace(mesh, area=area, triangles=kept, left_out=mesh.triangles - kept)

    def spacing_of(self, count: int) -> float:
        """The spacing, file units, at which the surface takes ``count`` points."""
        return float(np.sqrt(self.area / count))

    def source(
        self, path: Path, kind: str, spacing: float, sample: RawChunk, scale: float = 1.0
    ) -> PointSource:
        """Points ``spacing`` file units apart."""
        count = len(self.loose) + (int(self.area / spacing**2) if spacing > 0 else 0)
        note = (
            f"{path.name} is a mesh of {self.triangles:,} triangles and {self.area * scale**2:,.1f} m2; "
            f"points on it are {spacing * scale:.3f} m apart."
        )
        if self.left_out:
            note += f" {self.left_out:,} triangles with corners absurdly far away were left out."
        return PointSource(
            path,
            f"{kind.upper()} mesh",
            partial(_chunks, self, spacing, path.name),
            lambda: sample,
            count,
            notes=(note,) if self.triangles else (),
            unit="m" if kind in ("glb", "gltf") else "auto",
        )


def _loaded(path: Path, kind: str) -> Mesh:
    """A mesh that is held whole."""
    vertices, faces, loose, count = [], [], [np.empty((0, 3))], 0
    for corners, triangles in load_triangles(path, kind):
        if len(triangles) == 0:
            loose.append(corners)
            continue
        vertices.append(corners)
        faces.append(triangles + count)
        count += len(corners)
    if not vertices:
        vertices, faces = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)]
    corners, triangles = np.concatenate(vertices), np.concatenate(faces)
    near = triangles[_near(corners)[triangles].all(axis=1)]

    def blocks() -> Iterator[Any]:
        for start in range(0, len(near), BLOCK):
            yield corners[near[start : start + BLOCK]]

    return Mesh(blocks, len(triangles), np.concatenate(loose), 0.0)


def _streamed(pieces: Pieces) -> Mesh:
    """A mesh that is read again in each pass; what is far away is told by some of its corners."""
    every = max(1, pieces.count // SAMPLE_TRIANGLES)
    middle, reach = _middle(np.concatenate([corners[::every].reshape(-1, 3) for corners in pieces.corners()]))

    def blocks() -> Iterator[Any]:
        for corners in pieces.corners():
            with np.errstate(over="ignore", invalid="ignore"):
                near = (np.abs(corners - middle).max(axis=(1, 2))) <= reach
            yield corners[near]

    return Mesh(blocks, pieces.count, np.empty((0, 3)), 0.0)


def _sample(mesh: Mesh, name: str) -> RawChunk:
    surface = replace(mesh, loose=mesh.loose[:0])
    points = [chunk.points for chunk in _chunks(surface, mesh.spacing_of(SAMPLE_POINTS), name)]
    points.append(mesh.loose[:: max(1, len(mesh.loose) // SAMPLE_POINTS)])
    return RawChunk(np.concatenate(points))


def _chunks(mesh: Mesh, spacing: float, name: str) -> Iterator[RawChunk]:
    """Loose points, then points on triangles; at most ``CHUNK_POINTS`` at a time."""
    for start in range(0, len(mesh.loose), CHUNK_POINTS):
        yield RawChunk(mesh.loose[start : start + CHUNK_POINTS])
    if not spacing > 0:
        return
    carried, number = 0.5, 0
    for corners in mesh.blocks():
        with damaged(name, "mesh"):
            ends = carried + np.cumsum(_areas(corners) / spacing**2)
            owner_ends = np.floor(ends).astype(np.int64) - int(np.floor(carried))
        total = int(owner_ends[-1]) if len(owner_ends) else 0
        for first in range(0, total, CHUNK_POINTS):
            index = np.arange(first, min(total, first + CHUNK_POINTS))
            owner = np.searchsorted(owner_ends, index, side="right")
            yield RawChunk(_on_triangles(corners[owner], number + index))
        carried, number = float(ends[-1] % 1.0) if len(ends) else carried, number + total


def _near(vertices: Any) -> Any:
    """(V,) which vertices lie where a building's would."""
    if len(vertices) == 0:
        return np.zeros(0, dtype=bool)
    middle, reach = _middle(vertices)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.abs(vertices - middle).max(axis=1) <= reach


def _middle(vertices: Any) -> tuple[Any, float]:
    """(3,) where most vertices lie, and how far from it one may be."""
    with np.errstate(over="ignore", invalid="ignore"):
        middle = np.nanmedian(vertices, axis=0)
        distance = np.abs(vertices - middle).max(axis=1)
        return middle, max(FAR * float(np.nanmedian(distance)), np.finfo(float).tiny)


def _areas(corners: Any) -> Any:
    """(B,) areas of triangles; 0 for those that are not finite."""
    with np.errstate(over="ignore", invalid="ignore"):
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        areas = 0.5 * np.sqrt((normals**2).sum(axis=1))
    return np.where(np.isfinite(areas), areas, 0.0)


def _on_triangles(corners: Any, number: Any) -> Any:
    """(N, 3) a point on each of (N, 3, 3) triangles; point ``number`` of the R2 sequence, folded."""
    u, v = (0.5 + number * R2[0]) % 1.0, (0.5 + number * R2[1]) % 1.0
    outside = u + v > 1
    u, v = np.where(outside, 1 - u, u)[:, None], np.where(outside, 1 - v, v)[:, None]
    return corners[:, 0] * (1 - u - v) + corners[:, 1] * u + corners[:, 2] * v

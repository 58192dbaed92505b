"""The walls of a drawing as straight pieces, one a wall: what a building model has in place of a poché.

A poché is one polygon for all walls that touch. Where it runs along the axes it is cut so that every place
belongs to the longer of the two walls that it could be part of; what stands at another angle stays whole.
Geometry is shapely, metres, manhattan frame.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.exporters.walls import Poche
from floorplan_core.geometry.masks import label_patches

Bool = NDArray[np.bool_]
Float = NDArray[np.float64]

STRAIGHT = 1e-6  # m, an edge that departs less from an axis lies along it
SMALLEST = 1e-4  # m2, pieces below are what clipping leaves


@dataclass(frozen=True)
class WallPiece:
    """One straight wall, with the numbers of the openings in it."""

    polygon: Any  # openings filled: a wall goes on above its doors
    observed: bool
    openings: tuple[int, ...]


def wall_pieces(walls: Poche) -> list[WallPiece]:
    """The walls of a plan, observed ones first. Each opening belongs to the piece that holds most of it."""
    cuts = [opening.polygon for opening in walls.openings]
    beside_guessed = [_borders(cut, walls.guessed) > _borders(cut, walls.observed) for cut in cuts]
    pieces = []
    for observed, area in ((True, walls.observed), (False, walls.guessed)):
        filled = [cut for cut, guessed in zip(cuts, beside_guessed, strict=True) if guessed != observed]
        whole = shapely.union_all([area, *filled])
        pieces += [(polygon, observed) for polygon in straight_pieces(whole)]
    hosts = [_host(cut, [polygon for polygon, _ in pieces]) for cut in cuts]
    return [
        WallPiece(polygon, observed, tuple(k for k, host in enumerate(hosts) if host == i))
        for i, (polygon, observed) in enumerate(pieces)
    ]


def _borders(cut: Any, wall: Any) -> float:
    return float(cut.boundary.intersection(wall).length)


def _host(cut: Any, polygons: Sequence[Any]) -> int:
    """The number of the polygon that holds most of a cut (ties: the first)."""
    return int(np.argmax(shapely.area(shapely.intersection(np.array(polygons, dtype=object), cut))))


def straight_pieces(area: Any) -> list[Any]:
    """The polygons of ``area``, those along the axes cut into straight walls."""
    parts = [p for p in shapely.get_parts(area).tolist() if p.geom_type == "Polygon" and p.area > SMALLEST]
    return [piece for part in parts for piece in (_cut(part) if _along_axes(part) else [part])]


def _along_axes(polygon: Any) -> bool:
    return all(
        bool((np.abs(np.diff(shapely.get_coordinates(ring), axis=0)).min(axis=1) < STRAIGHT).all())
        for ring in (polygon.exterior, *polygon.interiors)
    )


def _cut(polygon: Any) -> list[Any]:
    """Cells between all its coordinates go to the wall along x or along y, whichever is longer there."""
    x, y = (np.unique(np.round(v, 6)) for v in shapely.get_coordinates(polygon).T)
    mask = shapely.contains_xy(polygon, *np.meshgrid((x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2))
    level = mask & (_runs(mask, np.diff(x)) >= _runs(mask.T, np.diff(y)).T)
    return [*_walls(level, x, y), *_walls(mask & ~level, x, y)]


def _runs(mask: Bool, lengths: Float) -> Float:
    """(ny, nx) length of the run of cells along x that holds each cell, 0 outside."""
    begins = mask & ~np.pad(mask, ((0, 0), (1, 0)))[:, :-1]
    run = np.cumsum(begins.ravel()).reshape(mask.shape) * mask
    totals = np.bincount(run.ravel(), weights=np.broadcast_to(lengths, mask.shape).ravel())
    return np.where(mask, totals[run], 0.0)


def _walls(mask: Bool, x: Float, y: Float) -> list[Any]:
    """One polygon for each connected patch of cells."""
    labels, count = label_patches(mask)
    rows, columns = np.nonzero(mask)
    boxes = shapely.box(x[columns], y[rows], x[columns + 1], y[rows + 1])
    owner = labels[rows, columns]
    return [shapely.union_all(boxes[owner == k]).simplify(STRAIGHT) for k in range(1, count + 1)]

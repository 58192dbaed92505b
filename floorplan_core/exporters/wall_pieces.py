"""The walls of a drawing as straight pieces, one a wall: what a building model has in place of a poché.

A poché is one polygon for all walls that touch. Where it runs along the axes it is cut so that every place
belongs to the longer of the two walls that it could be part of; what stands at another angle stays whole.
Geometry is shapely, metres, manhattan frame.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
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
AROUND = 0.5  # m around an opening, where the walls are looked at that it borders on
MOST_CELLS = 1_000_000  # between the coordinates of a polygon that is cut at once: a larger one is halved
CUTS = 64  # lines that are tried to halve it


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
    tree = shapely.STRtree([polygon for polygon, _ in pieces])
    openings: list[list[int]] = [[] for _ in pieces]
    for k, cut in enumerate(cuts):
        openings[_host(cut, tree)].append(k)
    return [
        WallPiece(polygon, observed, tuple(own))
        for (polygon, observed), own in zip(pieces, openings, strict=True)
    ]


def _borders(cut: Any, wall: Any) -> float:
    x0, y0, x1, y1 = cut.bounds  # the walls of a building are one polygon: only what is near is looked at
    near = shapely.clip_by_rect(wall, x0 - AROUND, y0 - AROUND, x1 + AROUND, y1 + AROUND)
    return float(cut.boundary.intersection(near).length)


def _host(cut: Any, polygons: shapely.STRtree) -> int:
    """The number of the polygon that holds most of a cut (ties: the first)."""
    near = np.sort(polygons.query(cut))
    held = shapely.area(shapely.intersection(polygons.geometries[near], cut))
    return int(near[np.argmax(held)]) if held.any() else 0


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
    """Cells between all its coordinates go to the wall along x or along y, whichever is longer there.

    The walls of a large site are cut apart first, where that cuts least of them.
    """
    x, y = (np.unique(np.round(v, 6)) for v in shapely.get_coordinates(polygon).T)
    if len(x) * len(y) > MOST_CELLS:
        return [piece for half in _halves(polygon, x, y) for piece in straight_pieces(half)]
    shapely.prepare(polygon)
    mask = shapely.contains_xy(polygon, *np.meshgrid((x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2))
    level = mask & (_runs(mask, np.diff(x)) >= _runs(mask.T, np.diff(y)).T)
    return [*_walls(level, x, y), *_walls(mask & ~level, x, y)]


def _halves(polygon: Any, x: Float, y: Float) -> list[Any]:
    """The parts of a polygon left and right of a line, or below and above one, near its middle."""
    axis = 0 if len(x) >= len(y) else 1
    edges = (x, y)[axis]
    some = np.unique(np.linspace(len(edges) / 3, 2 * len(edges) / 3, CUTS).astype(int))
    x0, y0, x1, y1 = polygon.bounds
    at = (edges[some] + edges[some + 1]) / 2
    lines = shapely.linestrings([((u, y0), (u, y1)) if axis == 0 else ((x0, u), (x1, u)) for u in at])
    u = float(at[np.argmin(shapely.length(shapely.intersection(lines, polygon)))])
    low = (x0, y0, u, y1) if axis == 0 else (x0, y0, x1, u)
    high = (u, y0, x1, y1) if axis == 0 else (x0, u, x1, y1)
    return [shapely.intersection(polygon, shapely.box(*half)) for half in (low, high)]


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
    order = np.argsort(owner, kind="stable")
    first = np.searchsorted(owner[order], np.arange(1, count + 2))
    return [shapely.union_all(boxes[order[a:b]]).simplify(STRAIGHT) for a, b in pairwise(first)]

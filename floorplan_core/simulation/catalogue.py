"""What rooms hold: kinds of furniture with their ranges of size, and how many of which a room has."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Range = tuple[float, float]
Builder = Callable[[float, float, float], Float]


def _box(length: float, depth: float, height: float) -> Float:
    return np.array([[0, 0, 0, length, depth, height, 0.0]])


def _table(length: float, depth: float, height: float) -> Float:
    """A top on two end panels; local x along the wall, y away from it."""
    panel, top = 0.03, 0.03
    return np.array(
        [
            [0, 0, height - top, length, depth, height, 0],
            [0.05, 0.05, 0, 0.05 + panel, depth - 0.05, height - top, 0],
            [length - 0.05 - panel, 0.05, 0, length - 0.05, depth - 0.05, height - top, 0],
        ]
    )


def _sofa(length: float, depth: float, height: float) -> Float:
    return np.array([[0, 0, 0.05, length, depth, 0.42, 0], [0, 0, 0.42, length, 0.22, height, 0.0]])


def _kitchen(length: float, depth: float, height: float) -> Float:
    """Base cabinets and wall cabinets above them."""
    return np.array([[0, 0, 0, length, depth, 0.9, 0], [0, 0, 1.45, length, 0.35, height, 0.0]])


def _board(length: float, depth: float, height: float) -> Float:
    return np.array([[0, 0, 0.9, length, depth, height, 0.0]])


def _basin(length: float, depth: float, height: float) -> Float:
    return np.array([[0, 0, 0.65, length, depth, height, 0.0]])


@dataclass(frozen=True)
class Piece:
    """One kind of furniture: ranges of length (along the wall), depth and height in metres."""

    kind: str
    length: Range
    depth: Range
    height: Range
    build: Builder = _box
    free: bool = False  # stands in the open as well as against a wall
    flush: bool = False  # touches its wall
    chairs: int = 0


DESK = Piece("desk", (1.3, 1.8), (0.7, 0.8), (0.72, 0.76), _table, chairs=1)
TABLE = Piece("table", (1.6, 3.2), (0.9, 1.2), (0.72, 0.76), _table, free=True, chairs=6)
CABINET = Piece("cabinet", (0.8, 1.6), (0.4, 0.5), (1.6, 2.0))
LOCKER = Piece("cabinet", (1.2, 2.8), (0.45, 0.6), (1.9, 2.0))
SHELF = Piece("shelf", (0.8, 2.0), (0.28, 0.4), (1.5, 2.2))
DRAWERS = Piece("drawers", (0.4, 1.2), (0.4, 0.55), (0.6, 1.2))
DIVIDER = Piece("divider", (1.2, 2.4), (0.4, 0.5), (1.5, 2.0), free=True)
BOARD = Piece("board", (1.2, 2.4), (0.03, 0.05), (1.9, 2.1), _board, flush=True)
PLANT = Piece("plant", (0.35, 0.5), (0.35, 0.5), (0.8, 1.6))
SOFA = Piece("sofa", (1.5, 2.3), (0.8, 0.95), (0.75, 0.9), _sofa)
BED = Piece("bed", (0.9, 1.8), (1.95, 2.1), (0.45, 0.6))
KITCHEN = Piece("kitchen", (1.8, 3.6), (0.6, 0.62), (2.1, 2.2), _kitchen, flush=True)
TOILET = Piece("toilet", (0.36, 0.4), (0.6, 0.7), (0.4, 0.8))
BASIN = Piece("basin", (0.5, 0.7), (0.4, 0.5), (0.82, 0.88), _basin)
BENCH = Piece("bench", (1.0, 1.8), (0.35, 0.42), (0.42, 0.48))

# What a use holds: pieces in order, each with its number per 10 m2 of floor (at least the first).
INVENTORY: dict[str, tuple[tuple[Piece, float], ...]] = {
    "office": (
        (DESK, 1.0),
        (CABINET, 0.5),
        (SHELF, 0.5),
        (DRAWERS, 0.4),
        (BOARD, 0.3),
        (PLANT, 0.3),
        (DIVIDER, 0.15),
    ),
    "meeting room": ((TABLE, 0.3), (BOARD, 0.3), (CABINET, 0.25), (PLANT, 0.2), (LOCKER, 0.15), (DESK, 0.3)),
    "store": ((SHELF, 1.5), (LOCKER, 0.8), (DRAWERS, 0.8)),
    "bathroom": ((TOILET, 2.0), (BASIN, 2.0)),
    "closet": ((SHELF, 2.0),),
    "hall": ((SOFA, 0.4), (PLANT, 0.4), (DRAWERS, 0.3), (LOCKER, 0.15)),
    "corridor": ((BENCH, 0.06), (PLANT, 0.06), (DRAWERS, 0.08), (LOCKER, 0.05)),
    "bedroom": ((BED, 0.7), (LOCKER, 0.7), (DRAWERS, 0.6), (DESK, 0.4)),
    "kitchen": ((KITCHEN, 1.0), (TABLE, 0.4), (CABINET, 0.5)),
    "living room": ((SOFA, 0.5), (TABLE, 0.25), (SHELF, 0.5), (CABINET, 0.3), (PLANT, 0.4), (DRAWERS, 0.3)),
}

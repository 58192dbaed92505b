"""Turning distance by brute force: step functions evaluated segment by segment, shifts from a dense grid."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np


def steps(vertices) -> list[tuple[float, float, float]]:
    """(start, end, direction) of every side of a counter-clockwise polygon of perimeter 1, unwrapped."""
    n = len(vertices)
    pairs = [(vertices[i], vertices[(i + 1) % n]) for i in range(n)]
    sides = [(q[0] - p[0], q[1] - p[1]) for p, q in pairs]
    sides = [s for s in sides if math.hypot(*s) > 0]
    perimeter = sum(math.hypot(*s) for s in sides)
    place, angle, found = 0.0, math.atan2(sides[0][1], sides[0][0]), []
    for k, side in enumerate(sides):
        if k:
            before = sides[k - 1]
            cross, dot = before[0] * side[1] - before[1] * side[0], before[0] * side[0] + before[1] * side[1]
            angle += math.atan2(cross, dot)
        length = math.hypot(*side) / perimeter
        found.append((place, place + length, angle))
        place += length
    return found


def squared_distance(f, g, shift: float) -> float:
    """Variance over [0, 1] of f(s + shift) - g(s)."""
    moved = [(a - shift + k, b - shift + k, t + 2 * math.pi * k) for k in (-1, 0, 1, 2) for a, b, t in f]
    cuts = sorted({0.0, 1.0, *(c for a, b, _ in [*moved, *g] for c in (a, b) if 0 < c < 1)})
    widths, values = [], []
    for low, high in pairwise(cuts):
        middle = (low + high) / 2
        tf = max((a, t) for a, _, t in moved if a <= middle)[1]
        tg = max((a, t) for a, _, t in g if a <= middle)[1]
        widths.append(high - low)
        values.append(tf - tg)
    mean = np.average(values, weights=widths)
    return float(np.average((np.array(values) - mean) ** 2, weights=widths))


def brute_force(a, b, shifts: int) -> float:
    """Least distance over ``shifts`` equal shifts, then refined around the best few by golden section."""
    f, g = steps(a), steps(b)
    grid = np.arange(shifts) / shifts
    values = np.array([squared_distance(f, g, t) for t in grid])
    best = values.min()
    for t in grid[np.argsort(values)[:6]]:
        best = min(best, _refine(f, g, t - 1 / shifts, t), _refine(f, g, t, t + 1 / shifts))
    return math.sqrt(max(best, 0.0))


def _refine(f, g, low: float, high: float) -> float:
    """Least value on [low, high] by repeated dense sampling."""
    best = math.inf
    for _ in range(12):
        grid = np.linspace(low, high, 9)
        values = [squared_distance(f, g, t) for t in grid]
        k = int(np.argmin(values))
        best = min(best, values[k])
        low, high = grid[max(k - 1, 0)], grid[min(k + 1, 8)]
    return best

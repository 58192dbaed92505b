"""Turning distance between simple polygons (Arkin et al. 1991, IEEE PAMI 13(3), 209-216).

The turning function of a polygon gives the direction of its boundary, in radians, against the length walked
along it counter-clockwise, the whole boundary having length 1; it is a step function that gains 2 pi in
every turn. The distance of two polygons is the L2 distance of their turning functions, minimised over
rotation (a constant added to one of them) and start point (a shift of its argument). It does not change with
place, scale or rotation.

For shift t let h(s) = f(s + t) - g(s), a step function. Two facts (section IV of the paper) make it exact:

- the best rotation is minus the mean of h, so the squared distance is the variance of h over [0, 1];
- between two shifts at which a step of f meets a step of g the variance is concave in t: the steps' places
  move linearly, so that the mean square of h is linear, and the mean, which is linear too, enters as minus
  its square. The minimum is therefore at one of the N M shifts at which two steps meet.

Vertices that repeat, or lie on a straight side, are steps of no height: they change nothing but the cost.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numba import njit
from numpy.typing import NDArray

Float = NDArray[np.float64]
SQUARE: Float = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
MINIMUM_LENGTH = 1e-12  # of the perimeter; shorter sides have no direction


def turning_distance(vertices: Float) -> float:
    """Turning distance to the unit square of a simple polygon, (N, 2) vertices in either orientation.

    :raises ValueError: if fewer than three vertices differ or the polygon has no area.

    >>> turning_distance(np.array([[0, 0], [3, 0], [3, 3], [0, 3]]))
    0.0
    """
    return float(_distance(*turning_function(vertices), *_square_function()))


@cache
def _square_function() -> tuple[Float, Float]:
    return turning_function(SQUARE)


def turning_distance_between(a: Float, b: Float) -> float:
    """Turning distance of two simple polygons, (N, 2) and (M, 2); radians, symmetric, 0 for similar polygons.

    Cost O(N M (N + M)): one pass over the merged steps for each shift.
    """
    return float(_distance(*turning_function(a), *turning_function(b)))


def turning_function(vertices: Float) -> tuple[Float, Float]:
    """(N,) places in [0, 1) where each side begins, from 0 on, and (N,) its direction in radians, unwrapped.

    Duplicate vertices are dropped and a clockwise polygon is reversed; the last direction and the first, a
    turn later, differ by the last exterior angle.
    """
    ring = np.asarray(vertices, dtype=np.float64).reshape(-1, 2)
    ring = ring - ring[:1] if len(ring) else ring  # large coordinates would cost the area its digits
    following = np.roll(ring, -1, axis=0)
    area = 0.5 * float(np.sum(ring[:, 0] * following[:, 1] - following[:, 0] * ring[:, 1]))
    if area < 0:
        ring = ring[::-1]
        following = np.roll(ring, -1, axis=0)
    sides = following - ring
    lengths = np.hypot(sides[:, 0], sides[:, 1])
    real = lengths > MINIMUM_LENGTH * lengths.sum()
    if np.count_nonzero(real) < 3 or area == 0.0:
        raise ValueError(f"a polygon of {len(ring)} vertices and area {area} has no turning function")
    sides, lengths = sides[real], lengths[real]
    direction = np.arctan2(sides[:, 1], sides[:, 0])
    turns = np.diff(direction)
    turns -= 2 * np.pi * np.ceil((turns - np.pi) / (2 * np.pi))  # exterior angles, in (-pi, pi]
    places = np.concatenate([[0.0], np.cumsum(lengths)[:-1]]) / lengths.sum()
    return places, direction[0] + np.concatenate([[0.0], np.cumsum(turns)])


@njit(cache=True, nogil=True)
def _distance(places_f: Float, angles_f: Float, places_g: Float, angles_g: Float) -> float:
    """Least standard deviation of f(s + t) - g(s) over the shifts t at which a step meets a step."""
    best = np.inf
    for i in range(len(places_f)):
        for j in range(len(places_g)):
            best = min(best, _variance(places_f, angles_f, i, places_g, angles_g, j))
    return float(np.sqrt(max(best, 0.0)))


@njit(cache=True, nogil=True)
def _variance(places_f: Float, angles_f: Float, i0: int, places_g: Float, angles_g: Float, j0: int) -> float:
    """Variance over one turn of the difference of f from its step ``i0`` on and g from its step ``j0`` on."""
    i, j, s = 0, 0, 0.0
    mean, spread = 0.0, 0.0
    while s < 1.0:
        end_f, end_g = _place(places_f, i0, i + 1), _place(places_g, j0, j + 1)
        end = min(end_f, end_g, 1.0)
        h = _angle(angles_f, i0, i) - _angle(angles_g, j0, j)
        if end > s:  # mean and spread of what came before, joined with one step (West 1979)
            off = h - mean
            mean += off * (end - s) / end
            spread += off * off * (end - s) * s / end
            s = end
        if end_f <= end:
            i += 1
        if end_g <= end:
            j += 1
    return spread


@njit(cache=True, nogil=True)
def _place(places: Float, start: int, steps: int) -> float:
    """Length walked from step ``start`` to the step that is ``steps`` later; 1 after all of them."""
    if steps >= len(places):
        return 1.0
    at = (start + steps) % len(places)
    return float(places[at] - places[start] + (1.0 if at < start else 0.0))


@njit(cache=True, nogil=True)
def _angle(angles: Float, start: int, steps: int) -> float:
    """Direction ``steps`` after step ``start``; a turn more whenever the start of the ring is passed."""
    at = start + steps
    return float(angles[at % len(angles)] + 2 * np.pi * (at // len(angles)))

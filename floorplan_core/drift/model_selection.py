"""SL-LMS on one axis: keyframe positions and plane offsets, with the simplest building that explains them.

Source: Shariati, Pfrommer, Taylor, *Simultaneous localization and layout model selection in Manhattan worlds*
(2018). Orientations are known, so positions are linear and each axis is a small problem of its own. Unknown
are the positions ``p`` (K) of the keyframes and an offset ``m`` for each sighting; measured are the steps
between keyframes and the distance of each sighting. The sum of ``w_ij |m_i - m_j|`` over pairs that may be
one plane is minimised within the noise of the measurements: pairs that land on one offset are one plane, and
loop closure falls out of it. Then least squares with these equalities; plane by plane more pairs come into
reach, and it repeats.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Index = NDArray[np.intp]

DISTANCE_SIGMA = 0.02  # m, of the distance of a surface
STEP_FLOOR = 0.002  # m, of any step between keyframes
SAME = 0.005  # m, two offsets nearer than this after the selection are one plane
SMALLEST = 1e-3  # m below which the absolute value is rounded off (iteratively reweighted least squares)
ROUNDS = 25  # of the reweighting
NEIGHBOURS = 6  # nearest planes by offset with which a plane is compared
BESIDE = 0.3  # m along the wall: sightings of one plane overlap, or nearly; other walls may have its offset
TRIM = 3.0  # sigma from its plane beyond which a sighting is not of it
STRENGTHS = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0)  # of the model selection; the largest within the noise counts


@dataclass(frozen=True)
class AxisProblem:
    """The measurements along one axis."""

    step: Float  # (K-1,) m from each keyframe to the next, as the trajectory says
    step_sigma: Float  # (K-1,)
    keyframe: Index  # (S,) of each sighting
    distance: Float  # (S,)
    mass: Float  # (S,)
    facing: Index  # (S,)
    low: Float  # (S, 2) extent along the two other axes, local frame (as the trajectory says)
    high: Float  # (S, 2)


def solve_axis(
    problem: AxisProblem, reaches: tuple[float, ...], check: Callable[[], None] = lambda: None
) -> tuple[Float, Index]:
    """(K,) positions of the keyframes, the first at 0, and (S,) plane of each sighting.

    ``reaches`` rise: how far (metres) the offsets of one plane may lie apart in each round. ``check`` is
    called again and again; it raises where nobody wants the answer any more.
    """
    plane = np.arange(len(problem.distance), dtype=np.intp)
    positions, offsets = least_squares(problem, plane)
    for reach in reaches:
        pairs, weights = candidate_pairs(problem, plane, offsets, reach)
        if not len(pairs):
            continue
        plane = select(problem, plane, pairs, weights, check)
        positions, offsets = least_squares(problem, plane)
        plane = part_misfits(problem, plane, positions, offsets)
        positions, offsets = least_squares(problem, plane)
    return positions, plane


def least_squares(
    problem: AxisProblem, plane: Index, pairs: Index | None = None, pull: Float | None = None
) -> tuple[Float, Float]:
    """(K,) positions and (P,) offsets for given planes; ``pull`` (1/m) draws ``pairs`` of planes together."""
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import spsolve

    K, S = len(problem.step) + 1, len(plane)
    P = int(plane.max()) + 1 if S else 0
    steps, seen = np.arange(K - 1), np.arange(S)
    rows = [steps, steps, K - 1 + seen, K - 1 + seen]
    columns = [steps + 1, steps, K + plane, problem.keyframe]
    w_step, w_seen = 1 / problem.step_sigma, np.full(S, 1 / DISTANCE_SIGMA)
    values = [w_step, -w_step, w_seen, -w_seen]
    right = [w_step * problem.step, w_seen * problem.distance]
    count = K - 1 + S
    if pairs is not None and pull is not None:
        more, root = count + np.arange(len(pairs)), np.sqrt(pull)
        rows += [more, more]
        columns += [K + pairs[:, 0], K + pairs[:, 1]]
        values += [root, -root]
        right.append(np.zeros(len(pairs)))
        count += len(pairs)
    entries = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    A = coo_array(entries, shape=(count, K + P)).tocsc()[:, 1:]  # the first keyframe is the origin
    x = spsolve((A.T @ A).tocsc(), A.T @ np.concatenate(right))
    return np.concatenate([[0.0], x[: K - 1]]), np.asarray(x[K - 1 :])


def candidate_pairs(problem: AxisProblem, plane: Index, offsets: Float, reach: float) -> tuple[Index, Float]:
    """(N, 2) pairs of planes that may be one, and the weights that the paper gives them."""
    P = len(offsets)
    mass = np.bincount(plane, problem.mass, P)
    facing = np.zeros(P, dtype=np.intp)
    facing[plane] = problem.facing
    low, high = np.full((P, 2), np.inf), np.full((P, 2), -np.inf)
    np.minimum.at(low, plane, problem.low)
    np.maximum.at(high, plane, problem.high)
    order = np.lexsort((offsets, facing))
    found = []
    for step in range(1, NEIGHBOURS + 1):
        a, b = order[:-step], order[step:]
        apart = np.maximum(low[a] - high[b], low[b] - high[a]).max(axis=1)
        near = (np.abs(offsets[a] - offsets[b]) < reach) & (facing[a] == facing[b]) & (apart < BESIDE)
        found.append(np.column_stack([a[near], b[near]]))
    pairs = np.concatenate(found) if found else np.zeros((0, 2), dtype=np.intp)
    gap = offsets[pairs[:, 0]] - offsets[pairs[:, 1]]
    weights = (mass[pairs[:, 0]] + mass[pairs[:, 1]]) * np.exp(-(gap**2) / (2 * (reach / 3) ** 2))
    return pairs, weights / max(float(mass.mean()), 1e-9)


def select(
    problem: AxisProblem, plane: Index, pairs: Index, weights: Float, check: Callable[[], None] = lambda: None
) -> Index:
    """The planes after those that land on one offset are made one, as strongly as the noise allows."""
    best = plane
    for strength in STRENGTHS:
        positions, offsets = _draw_together(problem, plane, pairs, strength * weights, check)
        if not _within_noise(problem, plane, positions, offsets):
            break
        best = _merged(plane, pairs, offsets)
    return best


def _draw_together(
    problem: AxisProblem, plane: Index, pairs: Index, weights: Float, check: Callable[[], None]
) -> tuple[Float, Float]:
    """Least squares plus ``weights`` times the absolute distances of the pairs."""
    pull = weights / SMALLEST / 10
    positions, offsets = least_squares(problem, plane, pairs, pull)
    for _ in range(ROUNDS):
        check()
        gap = np.abs(offsets[pairs[:, 0]] - offsets[pairs[:, 1]])
        pull = weights / np.maximum(gap, SMALLEST)
        before = offsets
        positions, offsets = least_squares(problem, plane, pairs, pull)
        if np.abs(offsets - before).max() < SMALLEST / 10:
            break
    return positions, offsets


def _within_noise(problem: AxisProblem, plane: Index, positions: Float, offsets: Float) -> bool:
    """The paper's constraints: residuals at most twice what the noise makes."""
    seen = (offsets[plane] - positions[problem.keyframe] - problem.distance) / DISTANCE_SIGMA
    step = (np.diff(positions) - problem.step) / problem.step_sigma
    return bool((seen**2).mean() <= 4.0 and (step**2).mean() <= 4.0)


def _merged(plane: Index, pairs: Index, offsets: Float) -> Index:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    P = len(offsets)
    same = pairs[np.abs(offsets[pairs[:, 0]] - offsets[pairs[:, 1]]) < SAME]
    graph = coo_array((np.ones(len(same)), (same[:, 0], same[:, 1])), shape=(P, P))
    _, group = connected_components(graph, directed=False)
    return np.asarray(group[plane], dtype=np.intp)


def part_misfits(problem: AxisProblem, plane: Index, positions: Float, offsets: Float) -> Index:
    """Sightings far from their plane become planes of their own again."""
    off = np.abs(offsets[plane] - positions[problem.keyframe] - problem.distance)
    wrong = off > TRIM * DISTANCE_SIGMA
    parted = plane.copy()
    parted[wrong] = len(offsets) + np.arange(int(wrong.sum()))
    return np.asarray(np.unique(parted, return_inverse=True)[1], dtype=np.intp)

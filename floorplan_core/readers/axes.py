"""Which axis of a file is up, and in which unit it counts: guessed from a sample, stated, never silent.

Up is the axis along which points lie in two flat outer layers (floor and ceiling), along which the building
is low, along which its layers are a storey apart in some unit (a tower is not low), and along which the
sensor's path stays level; the points of a single surface do not tell. The unit is
the one that makes storey height, extent and sensor height those of a building. Every term is bounded, so that
no single oddity decides.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.model import Trajectory
from floorplan_core.readers.layers import Layers, find_layers
from floorplan_core.units import METRES_PER_UNIT, UNIT_NAMES

Float = NDArray[np.float64]

LAYER_WEIGHT = 6.0  # of the strength of the layers (0 to 1)
LOW_WEIGHT = 1.0  # of ln(extent of the others / extent along the axis)
SIZE_WEIGHT, SIZE_LEAST = 1.0, -6.0  # of the likelihood of the sizes in the best unit, and its least
LEVEL_WEIGHT = 2.0  # of ln(path's spread along the others / along the axis)
UPRIGHT_WEIGHT = 3.0  # of the sensor's own vertical, where only one of its axes stays constant
LEVEL_FLOOR = 0.02  # a path is never more level than this share of its length
MIN_PATH = 0.03  # of the cloud's extent: a shorter path says nothing about level
FLAT = 0.02  # of the second spread: a cloud no thicker, densest in its middle, is one wall, floor or scan
STOREY_SHARE = 0.5  # of the strongest layer: floors and ceilings are alike, table tops are weaker
UPRIGHT_DECIDES = 0.7  # cosine from which the sensor's vertical says which end is up
CLUTTER_FROM, CLUTTER_TO = 0.08, 0.35  # shares of the height: above floor and skirting, below table tops
SENSOR_SHARE = 0.55  # of the height: carried by hand; robots are lower
SENSOR_SHARE_WEIGHT = 2.0
# Evidence (logarithm of a ratio) from which an axis points down. Camera frames have y down, so little is
# needed there; files with z or x down are rare.
UPSIDE_DOWN = {"x": 0.5, "y": 0.25, "z": 0.5}


@dataclass(frozen=True)
class Typical:
    """A log-normal belief about a length in metres; ``cap`` bounds what an odd value can cost."""

    centre: float
    sigma: float  # of the natural logarithm
    cap: float

    def score(self, value: float) -> float:
        """Log-likelihood, 0 at the centre."""
        if not value > 0:
            return 0.0
        return -min(self.cap, 0.5 * (math.log(value / self.centre) / self.sigma) ** 2)


STOREY = Typical(2.8, 0.3, 12.0)  # floor to ceiling
HEIGHT = Typical(3.5, 0.7, 6.0)  # of everything, where no ceiling shows
EXTENT = Typical(20.0, 1.3, 8.0)  # longer side of the plan
SENSOR = Typical(1.1, 0.5, 2.5)  # of the sensor above the floor
SPEED = Typical(0.5, 0.9, 1.5)  # metres a second of whoever carries it
PRIOR = {"m": 0.0, "mm": -1.0, "cm": -1.5, "ft": -2.5}  # logarithms: how often files come in each unit
UNLIKELY = -3.5  # the same of a unit that is never guessed, only believed: the US survey foot
# Logarithm of how much likelier a file is in the unit that its format fixes: no hall or site costs metres
# this much; a building of millimetres written as metres (a storey of 3 km) costs them 20.
FORMAT_WEIGHT = 12.0


@dataclass(frozen=True)
class AxisGuess:
    """Up axis and unit with the sentences that say why."""

    up: str
    unit: str
    sentences: tuple[str, ...]


def guess_axes(
    points: Float, trajectory: Trajectory | None, unit: str, up: str, usual: str = "auto"
) -> AxisGuess:
    """Decide what is "auto"; ``points`` (N, 3) finite, N > 0, ``trajectory`` in the same file coordinates.

    ``usual`` is the unit that the format fixes: believed unless no building is of that size.
    """
    layers = [find_layers(points[:, axis]) for axis in range(3)]
    units = (*PRIOR, *({usual} - {"auto", *PRIOR})) if unit == "auto" else (unit,)
    sizes = [guess_unit(layers, None, axis, usual, units)[1] for axis in "xyz"]
    up_guess = guess_up(points, layers, trajectory, sizes) if up == "auto" else up
    unit_guess = guess_unit(layers, trajectory, up_guess, usual, units)[0]
    sentences = (_up_sentence(up, up_guess), _unit_sentence(unit, unit_guess, layers, up_guess))
    return AxisGuess(up_guess, unit_guess, sentences)


def guess_up(points: Float, layers: list[Layers], trajectory: Trajectory | None, sizes: list[float]) -> str:
    """ "x", "y", "z", "-x", "-y" or "-z"; ties go to z, then y.

    :param sizes: how likely the sizes of a building are with each axis up.
    """
    extents = np.array([layer.high - layer.low for layer in layers])
    if extents.max() <= 0:
        return "z"
    extents = np.maximum(extents, 1e-3 * extents.max())
    scores = np.zeros(3)
    if not _is_one_surface(points, layers):  # a wall is as flat and as low as a floor
        scores += LAYER_WEIGHT * np.array([layer.strength for layer in layers])
        scores += LOW_WEIGHT * _log_ratio_to_others(extents)
        scores += SIZE_WEIGHT * np.maximum(sizes, max(sizes) + SIZE_LEAST)
    scores += _level_scores(trajectory, float(extents.max()))
    upright = _upright(trajectory)
    scores += UPRIGHT_WEIGHT * np.abs(upright)
    axis: int = max((2, 1, 0), key=lambda a: float(scores[a]))
    if abs(upright[axis]) > UPRIGHT_DECIDES:
        down = bool(upright[axis] < 0)
    else:
        heights = None if trajectory is None else trajectory.origins[:, axis]
        down = _is_upside_down(points[:, axis], layers[axis], heights, UPSIDE_DOWN["xyz"[axis]])
    return ("-" if down else "") + "xyz"[axis]


def _is_one_surface(points: Float, layers: list[Layers]) -> bool:
    """Does the cloud lie in one plane of any direction, so that its shape cannot tell what is up?"""
    low, high = (np.array([getattr(layer, end) for layer in layers]) for end in ("low", "high"))
    inner = points[((points >= low) & (points <= high)).all(axis=1)]
    if len(inner) < 3:
        return False
    variances, axes = np.linalg.eigh(np.cov(inner.T))
    if variances[0] > FLAT**2 * variances[1]:
        return False
    across = inner @ axes[:, 0]
    quarter = np.ptp(across) / 4
    return bool(
        np.mean(np.abs(across - across.min() - 2 * quarter) <= quarter) >= 0.5
    )  # no floor and ceiling


def guess_unit(
    layers: list[Layers], trajectory: Trajectory | None, up: str, usual: str, units: tuple[str, ...]
) -> tuple[str, float]:
    """Which of ``units`` makes the sizes those of a building, the first of equals; how likely they are."""
    axis = "xyz".index(up[-1])
    plan = max(layers[a].high - layers[a].low for a in range(3) if a != axis)
    storey, tall = storey_height(layers[axis]), layers[axis].high - layers[axis].low
    sensor = 0.0 if trajectory is None else _sensor_height(layers[axis], trajectory.origins[:, axis], up)
    speed = 0.0 if trajectory is None else _speed(trajectory)

    def score(unit: str) -> float:
        size = METRES_PER_UNIT[unit]
        vertical = STOREY.score(storey * size) if storey else HEIGHT.score(tall * size)
        rest = EXTENT.score(plan * size) + SENSOR.score(sensor * size) + SPEED.score(speed * size)
        return PRIOR.get(unit, UNLIKELY) + vertical + rest + (FORMAT_WEIGHT if unit == usual else 0.0)

    best = max(units, key=score)
    return best, score(best)


def storey_height(layers: Layers) -> float:
    """Median of the larger gaps between neighbouring strong layers, file units; 0 where there is no pair."""
    if len(layers.positions) == 0:
        return 0.0
    gaps = np.diff(layers.positions[layers.shares >= STOREY_SHARE * layers.shares.max()])
    return float(np.median(gaps[gaps >= 0.5 * gaps.max()])) if len(gaps) else 0.0


def _log_ratio_to_others(sizes: Float) -> Float:
    """(3,) ln(geometric mean of the other two / size)."""
    logs = np.log(sizes)
    return np.asarray((logs.sum() - logs) / 2 - logs)


def _level_scores(trajectory: Trajectory | None, extent: float) -> Float:
    """(3,) how much more level the path is along each axis than along the others."""
    if trajectory is None or len(trajectory) < 3:
        return np.zeros(3)
    spread = np.ptp(trajectory.origins, axis=0)
    if spread.max() < MIN_PATH * extent:
        return np.zeros(3)
    spread = np.maximum(spread, LEVEL_FLOOR * spread.max())
    return LEVEL_WEIGHT * _log_ratio_to_others(spread)


def _upright(trajectory: Trajectory | None) -> Float:
    """(3,) file direction that one axis of the sensor keeps while the others turn: its up; else zero.

    Lidars have z up; cameras have y down, x right and z forward.
    """
    if trajectory is None or len(trajectory) < 3:
        return np.zeros(3)
    means = trajectory.T_world_sensor[:, :3, :3].mean(axis=0)
    steady = np.linalg.norm(means, axis=0)
    if steady[2] > 0.95 and max(steady[0], steady[1]) < 0.9:
        return np.asarray(means[:, 2])
    if steady[1] > 0.9 and max(steady[0], steady[2]) < 0.85:
        return np.asarray(-means[:, 1])
    return np.zeros(3)


def _is_upside_down(values: Float, layers: Layers, heights: Float | None, threshold: float) -> bool:
    """True where the clutter stands, or the sensor moves, clearly nearer to what would be the ceiling.

    ``values`` (N,) and ``heights`` (M,) of points and sensors along the axis, file units.
    """
    if len(layers.positions) < 2:
        return False
    bottom, top = layers.positions[0], layers.positions[-1]
    share = (values - bottom) / (top - bottom)
    low = np.count_nonzero((share > CLUTTER_FROM) & (share < CLUTTER_TO))
    high = np.count_nonzero((share < 1 - CLUTTER_FROM) & (share > 1 - CLUTTER_TO))
    evidence = math.log((high + 1) / (low + 1))
    if heights is not None and len(heights):
        sensor = float(np.clip((np.median(heights) - bottom) / (top - bottom), 0.0, 1.0))
        evidence += SENSOR_SHARE_WEIGHT * (sensor - SENSOR_SHARE)
    return evidence > threshold


def _sensor_height(layers: Layers, along: Float, up: str) -> float:
    """Median height of the sensor above the next layer below it (else the lowest point), file units."""
    sign = -1.0 if up[0] == "-" else 1.0
    height = float(np.median(sign * along))
    positions = sign * layers.positions
    below = positions[positions < height]
    return height - float(below.max() if len(below) else min(sign * layers.low, sign * layers.high))


def _speed(trajectory: Trajectory) -> float:
    """Median of distance over time between rows, file units a second; 0 where it cannot be told."""
    path = trajectory.of_main_sensor()
    seconds = np.diff(path.stamps)
    moved = np.linalg.norm(np.diff(path.origins, axis=0), axis=1)
    good = (seconds > 0) & (moved > 0)
    return float(np.median(moved[good] / seconds[good])) if good.any() else 0.0


def _up_sentence(asked: str, up: str) -> str:
    if asked != "auto":
        return f"The file's {up} axis is up, as asked."
    return (
        f"The file's {up} axis is taken as up (flat layers, low extent, level path); force it with input.up."
    )


def _unit_sentence(asked: str, unit: str, layers: list[Layers], up: str) -> str:
    if asked != "auto":
        return f"Coordinates are in {UNIT_NAMES[unit]}, as asked."
    axis = layers["xyz".index(up[-1])]
    storey, tall = storey_height(axis), axis.high - axis.low
    size = METRES_PER_UNIT[unit]
    if storey:
        what = f"floor to ceiling is then {storey * size:.2f} m"
    elif tall:
        what = f"the height is then {tall * size:.2f} m"
    else:
        what = "the points are flat, so only their extent could tell"
    return f"Coordinates are taken as {UNIT_NAMES[unit]} ({what}); force it with input.unit."

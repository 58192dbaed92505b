"""The frame that a cloud has by itself: its middle, its level, and the direction along which it spreads most.

Grids are laid in this frame, so that what comes out does not depend on where and how turned the world of the
file happens to lie: points that are moved, turned or tilted give the same numbers up to rounding. Only
moments and a fit to the points themselves are used, since these turn with the points.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.geometry.halves import in_halves
from floorplan_core.geometry.level_frame import level_rotation

Float = NDArray[np.float64]

_ENOUGH = 10  # points
# Between the largest spread and the frame's x: walls run along the one, and cells along walls would put all
# points of one into the same layer, or half of them into the next.
_ASIDE = np.radians(20.0)
_MOST = 25_000  # points that are looked at
_ROUNDS = 3  # of leaving out what is far from the middle
_WORTH = 100_000  # points from which a second thread moves half of them
_FAR = 4.0  # times the mean distance from the middle: ghosts, which would pull it


@dataclass(frozen=True)
class OwnFrame:
    """``own = rotation @ (point - centre)``."""

    rotation: Float = field(default_factory=lambda: np.eye(3))  # (3, 3) proper: levels, turns about z
    centre: Float = field(default_factory=lambda: np.zeros(3))  # (3,) metres

    @property
    def is_another(self) -> bool:
        """False where it is the frame of the points."""
        return bool(self.centre.any() or (self.rotation != np.eye(3)).any())

    def move(self, points: NDArray[Any]) -> NDArray[np.float32]:
        """(N, 3) points in the own frame."""
        given, out = np.ascontiguousarray(points), np.empty((len(points), 3), dtype=np.float32)
        in_halves(lambda a, b: _move(given, self.rotation, self.centre, out, a, b), len(given), _WORTH)
        return out

    def move_exactly(self, points: Float) -> Float:
        """The same in float64, for poses."""
        return np.asarray((np.asarray(points, dtype=np.float64) - self.centre) @ self.rotation.T)


def own_frame(points: NDArray[Any], level: bool = True) -> OwnFrame:
    """The own frame of (N, 3) points; those that are not finite do not count.

    :param level: also make the strongest level (a floor, a ceiling) level; else heights stay heights.
    """
    p = np.asarray(points[:: max(1, len(points) // _MOST)], dtype=np.float64)
    p = p[np.isfinite(p).all(axis=1)]
    if len(p) < _ENOUGH:
        return OwnFrame()
    for _ in range(_ROUNDS):
        distance = np.linalg.norm(p - p.mean(axis=0), axis=1)
        p = p[distance <= _FAR * distance.mean()]
    centre = p.mean(axis=0)
    upright = level_rotation(p - centre) if level else np.eye(3)
    u = (p - centre) @ upright[:2].T
    _, vectors = np.linalg.eigh(u.T @ u)
    along = vectors[:, 1]
    if ((u @ along) ** 3).sum() < 0:  # both ends of the axis are alike but for the skewness
        along = -along
    c, s = np.cos(_ASIDE), np.sin(_ASIDE)
    x, y = c * along[0] - s * along[1], s * along[0] + c * along[1]
    return OwnFrame(np.array([[x, y, 0.0], [-y, x, 0.0], [0.0, 0.0, 1.0]]) @ upright, centre)


@njit(cache=True, nogil=True)
def _move(points, r, c, out, start, stop):  # type: ignore[no-untyped-def]
    for i in range(start, stop):
        x, y, z = points[i, 0] - c[0], points[i, 1] - c[1], points[i, 2] - c[2]
        for k in range(3):
            out[i, k] = r[k, 0] * x + r[k, 1] * y + r[k, 2] * z

"""What tells a door from a gap in the data: measures of an aperture, their words, a calibrated confidence.

In: a plane with its profile, an aperture in it, the voxel columns and the sensor's path. Out: measures from 0
to 1. A cabinet that hides a wall leaves an aperture with a lintel and wall on both sides too, but nothing was
seen behind it; a window is free to pass above its sill only, and nothing is free beyond its pane; rays cross
the thickness of the wall from the floor up where there is a door. So these measures weigh most.
The confidence is the probability that the aperture is a door or an opening of the building: a logistic
regression on the apertures of the tuning half of the accuracy benchmark and of 36 surveys more;
``docs/accuracy.md`` has its reliability on the other half.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from floorplan_core.geometry.columns import count_bits, height_mask
from floorplan_core.model import LayoutPlane, WallProfile
from floorplan_core.model.evidence import Evidence

Float = NDArray[np.float64]

_BODY = (0.4, 1.8)  # m above the floor at which a door is open
_FOOT = (0.2, 0.8)  # m above the floor: below the sill of a window, above skirting and threshold
_WITHIN, _BEYOND = 0.08, 0.25  # m behind the face: inside any wall, and on the other side of an inner one
_FLANK = 0.5  # m beside an aperture in which wall is looked for
_STANDS = 0.2  # of the height below 2 m, seen: wall
_STEP = 2.0  # m between two poses, the longest step that is still a path
_NO_LINTELS = 0.9  # taken for the lintel where the survey shows none at all: the share over usual doors
_NO_PASSAGE = 0.05  # of the width: less is no straight passage at all
_PASSED, _CLEARLY = 0.6, 0.7  # shares of an aperture from which it is open, whatever was seen in it
_OUTWARD = 0.3  # most that an opening can earn behind which neither passage nor wall was seen
_WHOLE_PASSAGE = 0.3  # of the width: more of a straight passage tells no more
_ROOM = (4.0, 8.0)  # m, the width and the depth within which a room behind a wall has its far wall
_THICK = 0.5  # m: what is nearer behind a face may be its own wall
_DECIMALS = 3

# Log odds of a whole measure, and of none. Fitted on 1377 apertures, penalty 0.0005 on the squared weights.
_BIAS = -6.32
_WEIGHTS = {
    "open": 1.29,
    "foot": 3.05,
    "beyond": 1.72,
    "passage": 2.48,
    "path": 1.16,
    "lintel": 0.49,
    "flanks": 0.56,
    "flank": 0.66,
    "response": 1.11,
    "both": 0.55,
}
SHARES = tuple(_WEIGHTS)  # what is weighed, in the order of the table above


@dataclass(frozen=True)
class DoorMeasures:
    """Evidence about one aperture, all 0 to 1; what is open, free or seen is a share of its area or width."""

    open: float  # free within the thickness of the wall, at the heights of a body
    foot: float  # the same near the floor
    beyond: float  # free just behind the wall
    passage: float  # width at which free space reaches straight through the wall
    path: float  # 1 where the sensor itself went through
    lintel: float  # width above which wall was seen
    flanks: float  # wall on the side where there is less of it, as a share of half a metre
    flank: float  # and on the other side
    response: float  # of the matched filter
    both: float = 0.0  # 1 where the other face of the wall shows the same aperture
    onward: float = 0.0  # 1 where the building goes on behind the wall

    def merged(self, other: DoorMeasures, both: bool) -> DoorMeasures:
        """The better of each; ``both``: the two are opposite faces of one wall."""
        names = [f.name for f in fields(self)]
        best = DoorMeasures(**{n: max(getattr(self, n), getattr(other, n)) for n in names})
        return replace(best, both=max(best.both, float(both)))

    def is_open(self) -> bool:
        """True where so much is free from the floor up that surfaces seen in it are points that float."""
        return min(self.foot, self.passage) > _PASSED and min(self.beyond, self.lintel) > _CLEARLY

    def words(self) -> tuple[str, ...]:
        """What speaks for a door, in words."""
        found = {
            "open": self.open > 0.4,
            "passage": self.passage > 0.4,
            "path": self.path > 0,
            "lintel": self.lintel > 0.5,
            "wall on both sides": self.flanks >= 0.5,
            "corner": self.flanks < 0.5 <= self.flank,
            "both faces": self.both > 0,
        }
        return tuple(word for word, true in found.items() if true)

    def shares(self, lintels: bool) -> dict[str, float]:
        """What is weighed, 0 to 1; ``lintels``: the survey shows any, so that none here counts."""
        seen = {name: float(getattr(self, name)) for name in SHARES}
        if not lintels:
            seen["lintel"] = _NO_LINTELS
        seen["passage"] = min(1.0, seen["passage"] / _WHOLE_PASSAGE)
        return seen

    def confidence(self, lintels: bool) -> float:
        """Probability of a door or opening; ``lintels``: the survey shows any."""
        odds = _BIAS + sum(_WEIGHTS[name] * share for name, share in self.shares(lintels).items())
        return round(self.limited(1.0 / (1.0 + math.exp(-odds)), self.leads_on()), _DECIMALS)

    @staticmethod
    def limited(likely: float, leads_on: bool) -> float:
        """The probability, limited for what leads nowhere."""
        return likely if leads_on else min(likely, _OUTWARD)

    def leads_on(self) -> bool:
        """False for glass to the outside: rays pass it, but nothing was seen to lie on its other side."""
        return self.passage > _NO_PASSAGE or max(self.path, self.both, self.onward) > 0


@dataclass(frozen=True)
class WallView:
    """What lies in and behind a wall; shares, 0 to 1, in the bins of its plane's profile (B,)."""

    open: Float  # free within its thickness, at the heights of a body
    foot: Float  # the same near the floor
    beyond: Float  # free just behind it
    path: Float  # (K,) where along it the sensor itself went through, metres
    onward: Float  # (K, 2) start and end of the far walls of what may be a room behind it


def view_wall(plane: LayoutPlane, evidence: Evidence, alike: Float) -> WallView:
    """What is seen of ``plane``, once for all of its apertures.

    :param alike: (K, 3) offset, start and end of all wall runs that look the way of ``plane``.
    """
    return WallView(
        open=_free_share(plane, evidence, _WITHIN, _BODY),
        foot=_free_share(plane, evidence, _WITHIN, _FOOT),
        beyond=_free_share(plane, evidence, _BEYOND, _BODY),
        path=_crossings(plane, evidence),
        onward=far_walls(plane, alike),
    )


def measure(
    plane: LayoutPlane,
    start: float,
    end: float,
    response: float,
    view: WallView,
) -> DoorMeasures:
    """The evidence about an aperture from ``start`` to ``end`` (metres along ``plane``)."""
    profile = plane.profile
    assert profile is not None
    a, b = (round((v - profile.start) / profile.step) for v in (start, end))
    inner = slice(max(a + 1, 0), max(b - 1, a + 2))
    flanks = sorted(_standing(low, profile.step) for low in _beside(profile, a, b))
    return DoorMeasures(
        open=_mean(view.open[inner]),
        foot=_mean(view.foot[inner]),
        beyond=_mean(view.beyond[inner]),
        passage=_mean(profile.through[inner] > 0.4),
        path=float(((view.path > start) & (view.path < end)).any()),
        lintel=_mean(profile.high[inner] > 0),
        flanks=flanks[0],
        flank=flanks[1],
        response=min(response, 1.0),
        onward=float(goes_on(start, end, view.onward)),
    )


def far_walls(plane: LayoutPlane, alike: Float) -> Float:
    """(K, 2) start and end of those of the runs ``alike`` (offset, start, end) that a room may lie before."""
    behind = (plane.offset - alike[:, 0]) * plane.facing.sign
    return np.asarray(alike[(behind > _THICK) & (behind < _ROOM[1]), 1:])


def goes_on(start: float, end: float, onward: Float) -> bool:
    """True where the far wall of a room behind the aperture, or of one beside that, was seen."""
    beside = np.minimum(onward[:, 1], end + _ROOM[0]) - np.maximum(onward[:, 0], start - _ROOM[0])
    return bool((beside > _FLANK).any())


def _mean(values: NDArray[np.generic]) -> float:
    return float(values.mean()) if len(values) else 0.0


def _beside(profile: WallProfile, a: int, b: int) -> tuple[Float, Float]:
    """What was seen of the wall low beside bins a to b."""
    reach = round(_FLANK / profile.step)
    return profile.low[max(0, a - reach) : max(a, 0)], profile.low[b : b + reach]


def _standing(low: Float, step: float) -> float:
    """0 to 1: wall in one flank."""
    return min(1.0, float((low > _STANDS).sum()) * step / _FLANK)


def _free_share(plane: LayoutPlane, evidence: Evidence, depth: float, body: tuple[float, float]) -> Float:
    """(bins,) 0 to 1: share of the heights ``body`` that are free ``depth`` metres behind the wall's face."""
    axis = plane.facing.axis
    free = evidence.free if axis == 0 else evidence.free.T
    at = plane.offset - plane.facing.sign * depth
    column = int(np.clip((at - evidence.origin[axis]) / evidence.cell, 0, free.shape[1] - 1))
    mask = height_mask(*body)
    share: Float = count_bits(free[:, column] & mask) / int(mask).bit_count()
    return np.repeat(share, 2)


def _crossings(plane: LayoutPlane, evidence: Evidence) -> Float:
    """(K,) where along the plane the sensor itself went through it."""
    a = plane.facing.axis
    u, v = evidence.path[:, a] - plane.offset, evidence.path[:, 1 - a]
    k = np.flatnonzero(u[:-1] * u[1:] < 0)
    step = np.hypot(u[k + 1] - u[k], v[k + 1] - v[k])
    at = v[k] + (v[k + 1] - v[k]) * u[k] / (u[k] - u[k + 1])
    return np.asarray(at[step < _STEP])

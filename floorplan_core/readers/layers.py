"""Flat layers along an axis: floors, ceilings and slabs show as peaks of the density of points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]

BINS = 120  # over the trimmed extent: 2 to 4 cm of a storey, as thick as a noisy floor
SIGNIFICANT = 0.4  # a layer holds at least this share of the points of the strongest one
CONTRAST = 2.0  # and this many times the points of a median bin
MIN_GAP = 0.15  # of the extent: nearer peaks are one layer (a raised slab, a lowered ceiling)


@dataclass(frozen=True)
class Layers:
    """Peaks of the density along one axis."""

    positions: Float  # (K,) rising, unit of the input
    shares: Float  # (K,) share of all points within a bin of each
    low: float  # 0.2 % and 99.8 % of the points lie beyond these
    high: float
    outside: float  # share of the points below the lowest or above the highest layer by more than 3 bins

    @property
    def strength(self) -> float:
        """0 to 1: how much of the cloud lies in its two outermost layers with nothing beyond them."""
        if len(self.positions) == 0:
            return 0.0
        ends = self.shares[[0, -1]].sum() if len(self.positions) > 1 else self.shares[0] / 2
        return float(max(0.0, ends - self.outside))


def find_layers(values: Float) -> Layers:
    """Layers of (N,) coordinates along one axis; N > 0, all finite."""
    low, high = (float(v) for v in np.quantile(values, [0.002, 0.998]))
    if not high > low:
        return Layers(np.array([low]), np.ones(1), low, high, 0.0)
    width = (high - low) / BINS
    inner = values[(values >= low) & (values <= high)]
    index = np.minimum(((inner - low) / width).astype(np.int64), BINS - 1)
    counts = np.bincount(index, minlength=BINS).astype(np.float64)
    triple = np.convolve(counts, np.ones(3), mode="same")
    peaks = _peaks(triple)
    centres = np.asarray(low + width * (np.arange(BINS) + 0.5), dtype=np.float64)
    positions = np.array([_centre(centres, counts, p) for p in peaks])
    outside = 0.0
    if len(peaks):
        first, last = _outer_faces(triple, peaks)
        below, above = counts[: max(0, first - 3)].sum(), counts[last + 4 :].sum()
        outside = float((below + above) / len(values))
    return Layers(positions, triple[peaks] / len(values), low, high, outside)


def _peaks(triple: Float) -> list[int]:
    """Bins of the layers, rising: greedily the strongest, then what is far enough from those chosen."""
    order = np.argsort(-triple, kind="stable")
    floor = max(SIGNIFICANT * triple[order[0]], CONTRAST * float(np.median(triple)))
    chosen: list[int] = []
    for bin_ in order.tolist():
        if triple[bin_] < floor:
            break
        if all(abs(bin_ - other) >= MIN_GAP * BINS for other in chosen):
            chosen.append(bin_)
    return sorted(chosen)


def _outer_faces(triple: Float, peaks: list[int]) -> tuple[int, int]:
    """First and last bin of the outermost layers: models of closed solids have both faces of a slab."""
    gap, least = int(MIN_GAP * BINS), SIGNIFICANT * triple[peaks].max()
    first, last = max(0, peaks[0] - gap), min(BINS, peaks[-1] + gap + 1)
    contrast = CONTRAST * float(np.median(triple))
    strong = first + np.flatnonzero(triple[first:last] >= max(least, contrast))
    return int(strong[0]), int(strong[-1])


def _centre(centres: Float, counts: Float, peak: int) -> float:
    part = slice(max(0, peak - 1), peak + 2)
    weight = counts[part].sum()
    return float((centres[part] * counts[part]).sum() / weight) if weight else float(centres[peak])

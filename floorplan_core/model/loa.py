"""Level of accuracy (LOA) of the U.S. Institute of Building Documentation, specification 3.0.

A band is named by how far 95 % of the measured points lie from what is drawn: LOA10 up to 15 cm, LOA20 up to
5 cm, LOA30 up to 15 mm, LOA40 up to 5 mm, LOA50 up to 1 mm. Each limit belongs to the better band.
"""

from __future__ import annotations

from collections.abc import Sequence

from floorplan_core.model.region import Region

# Largest 95 % deviation of each band, metres; best first.
LOA_LIMITS = (("LOA50", 0.001), ("LOA40", 0.005), ("LOA30", 0.015), ("LOA20", 0.05), ("LOA10", 0.15))
NO_BAND = "none"  # worse than every band, or not measured


def loa_band(residual: float | None) -> str:
    """The band that a 95 % deviation meets; ``"none"`` above 15 cm and where nothing was measured.

    :param residual: metres, of either sign; None where no surface was seen.

    >>> loa_band(0.012), loa_band(-0.05), loa_band(0.2), loa_band(None)
    ('LOA30', 'LOA20', 'none', 'none')
    """
    if residual is None:
        return NO_BAND
    return next((band for band, limit in LOA_LIMITS if abs(residual) <= limit), NO_BAND)


def side_lengths_by_band(regions: Sequence[Region]) -> dict[str, float]:
    """Metres of side, over all regions, that meet each band (all bands, the best first, then ``"none"``)."""
    metres = dict.fromkeys([*(band for band, _ in LOA_LIMITS), NO_BAND], 0.0)
    for side in (side for region in regions for side in region.sides):
        metres[loa_band(side.residual)] += side.length
    return metres


def mean_side_residual(regions: Sequence[Region]) -> float | None:
    """Metres: mean of the sides' 95 % residuals, each weighed by its length; None where none was measured."""
    seen = [(s.length, s.residual) for region in regions for s in region.sides if s.residual is not None]
    total = sum(length for length, _ in seen)
    return sum(length * residual for length, residual in seen) / total if total else None

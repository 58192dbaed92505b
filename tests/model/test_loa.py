"""USIBD bands of accuracy, and how much side meets each."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.model.loa import LOA_LIMITS, loa_band, mean_side_residual, side_lengths_by_band
from floorplan_core.report import loa_summary, run_report
from tests.factories import l_corridor


@pytest.mark.parametrize(
    ("residual", "band"),
    [
        (0.0, "LOA50"),
        (0.001, "LOA50"),
        (0.0011, "LOA40"),
        (0.005, "LOA40"),
        (0.015, "LOA30"),
        (0.0151, "LOA20"),
        (0.05, "LOA20"),
        (-0.12, "LOA10"),
        (0.15, "LOA10"),
        (0.151, "none"),
        (None, "none"),
    ],
)
def test_band_by_its_limits(residual: float | None, band: str) -> None:
    assert loa_band(residual) == band


@given(a=st.floats(0, 1), b=st.floats(0, 1))
def test_smaller_deviation_is_never_a_worse_band(a: float, b: float) -> None:
    order = [band for band, _ in LOA_LIMITS] + ["none"]
    assert order.index(loa_band(min(a, b))) <= order.index(loa_band(max(a, b)))


def test_lengths_are_those_of_all_sides() -> None:
    regions = l_corridor().regions
    metres = side_lengths_by_band(regions)
    assert sum(metres.values()) == pytest.approx(sum(s.length for r in regions for s in r.sides))
    assert metres["LOA30"] == pytest.approx(
        sum(s.length for r in regions for s in r.sides if s.residual is not None)
    )
    assert metres["LOA30"] > 0


def test_mean_residual_is_weighed_by_length() -> None:
    region = l_corridor().regions[0]
    long, short = sorted(region.sides, key=lambda s: -s.length)[0], min(region.sides, key=lambda s: s.length)
    pair = (replace(long, residual=0.01), replace(short, residual=0.04))
    expected = (long.length * 0.01 + short.length * 0.04) / (long.length + short.length)
    assert mean_side_residual([replace(region, sides=pair)]) == pytest.approx(expected)
    assert mean_side_residual([replace(region, sides=(replace(long, residual=None),))]) is None


def test_report_tells_shares_that_add_up() -> None:
    plan = l_corridor()
    loa = run_report(plan)["loa"]
    assert loa == loa_summary(plan)
    assert sum(loa["share"].values()) == pytest.approx(1.0, abs=1e-3)
    assert loa["mean_residual_m"] == pytest.approx(0.009)

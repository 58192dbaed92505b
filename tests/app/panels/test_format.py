"""Numbers as people read and type them."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorcast_app.format import angle, area, count, length, parse_length, percent, seconds, small

SIXTEENTH = 0.0254 / 16


@given(st.floats(-500, 500))
def test_feet_and_inches_read_back_to_a_sixteenth(metres: float) -> None:
    assert parse_length(length(metres, "ft-in")) == pytest.approx(metres, abs=SIXTEENTH / 2 + 1e-6)


@given(st.floats(-500, 500))
def test_metres_read_back_to_a_millimetre(metres: float) -> None:
    assert parse_length(length(metres)) == pytest.approx(metres, abs=0.00051)


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("3.2", 3.2),
        ("3,2 m", 3.2),
        ("320cm", 3.2),
        ("3200 mm", 3.2),
        ("10 ft", 3.048),
        ("10'", 3.048),
        ("10' 6\"", 3.2004),
        ('6"', 0.1524),
        ("12′ 3 1/2″", 3.7465),
        ("-1' 0\"", -0.3048),
    ],
)
def test_lengths_are_read_as_they_are_typed(text: str, metres: float) -> None:
    assert parse_length(text) == pytest.approx(metres)


@pytest.mark.parametrize("text", ["", "wall", '1/0"', "3..2", "12' x"])
def test_what_is_no_length_is_none(text: str) -> None:
    assert parse_length(text) is None


def test_twelve_inches_are_never_written() -> None:
    assert length(0.3048 - SIXTEENTH / 4, "ft-in") == "1' 0\""


def test_the_rest() -> None:
    assert area(12.5) == "12.50 m²"
    assert area(1 / 10.7639, "ft-in") == "1.0 sq ft"
    assert small(-0.012) == "-12 mm"
    assert angle(math.degrees(0.3)) == "17.19°"
    assert percent(None) == "–"
    assert (count(999_999), count(1_000_000)) == ("999,999", "1.0 M")
    assert seconds(59.96) == "60.0 s"

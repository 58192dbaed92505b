"""Numbers as people read them: metres, or feet and inches as surveyors write them. No Qt."""

from __future__ import annotations

from fractions import Fraction

from floorplan_core.drawing_style import METRES_PER_FOOT

SQUARE_FEET_PER_M2 = 1 / METRES_PER_FOOT**2
INCH_FRACTION = 16  # a sixteenth is what a tape shows
DASH = "–"

_marks = {".": ".", ",": ","}  # of the language: the decimal mark, and what parts thousands


def use_marks(decimal: str, thousands: str) -> None:
    """Write numbers with these marks from now on. What is exported never goes through this module."""
    _marks.update({".": decimal, ",": thousands})


def number(value: float, spec: str) -> str:
    """A number by a format specification, with the marks of the language.

    >>> number(1234.5, ",.2f")
    '1,234.50'
    """
    return localised(f"{value:{spec}}")


def localised(text: str) -> str:
    """A number that was written with a decimal point, with the marks of the language."""
    return text.translate(str.maketrans(_marks))


def length(metres: float | None, units: str = "m") -> str:
    """A length with its unit; a dash where there is none.

    >>> length(3.2), length(3.746500, "ft-in"), length(-0.05, "ft-in"), length(None)
    ('3.200 m', '12\\' 3 1/2"', '-0\\' 1 15/16"', '–')
    """
    if metres is None:
        return DASH
    if units == "ft-in":
        return _feet(metres)
    return f"{number(metres + 0.0, '.3f')} m"


def area(m2: float | None, units: str = "m") -> str:
    """An area with its unit; a dash where there is none.

    >>> area(12.3456), area(12.3456, "ft-in")
    ('12.35 m²', '132.9 sq ft')
    """
    if m2 is None:
        return DASH
    if units == "ft-in":
        return f"{number(m2 * SQUARE_FEET_PER_M2, ',.1f')} sq ft"
    return f"{number(m2, ',.2f')} m²"


def small(metres: float | None, units: str = "m") -> str:
    """A difference or a residual: millimetres, or sixteenths of an inch.

    >>> small(0.0082), small(-0.0304), small(0.0082, "ft-in")
    ('8 mm', '-30 mm', '5/16"')
    """
    if metres is None:
        return DASH
    if units == "ft-in":
        sign = "-" if metres < 0 else ""
        return f"{sign}{_inches(round(abs(metres) / METRES_PER_FOOT * 12 * INCH_FRACTION))}"
    return f"{round(metres * 1000)} mm"


def angle(degrees: float | None) -> str:
    """An angle in degrees.

    >>> angle(17.234), angle(-0.001)
    ('17.23°', '0.00°')
    """
    return DASH if degrees is None else f"{number(round(degrees, 2) + 0.0, '.2f')}°"


def percent(share: float | None, digits: int = 0) -> str:
    """A share between 0 and 1.

    >>> percent(0.918), percent(0.0178, 2)
    ('92 %', '1.78 %')
    """
    return DASH if share is None else f"{number(share * 100, f'.{digits}f')} %"


def count(things: int) -> str:
    """A number of things, with separators of thousands; millions are shortened.

    >>> count(18204), count(2_412_000)
    ('18,204', '2.4 M')
    """
    return f"{number(things / 1e6, '.1f')} M" if things >= 1e6 else number(things, ",")


def seconds(value: float) -> str:
    """A time, as short as it can be said.

    >>> seconds(0.214), seconds(8.04), seconds(75), seconds(4000)
    ('0.21 s', '8.0 s', '1:15 min', '1:06:40 h')
    """
    if value < 60:
        return f"{number(value, '.2f' if value < 1 else '.1f')} s"
    minutes, rest = divmod(round(value), 60)
    if minutes < 60:
        return f"{minutes}:{rest:02d} min"
    return f"{minutes // 60}:{minutes % 60:02d}:{rest:02d} h"


def parse_length(text: str) -> float | None:
    """Metres from what a person types: "3.2", "3,2 m", "320 cm", "3200 mm", 12' 3 1/2", "12.5 ft"; else None.

    >>> parse_length("3,20"), parse_length("320 cm"), parse_length("12' 3 1/2" + '"'), parse_length("x")
    (3.2, 3.2, 3.7465, None)
    """
    cleaned = text.strip().lower()
    if "." in cleaned and "," in cleaned:  # the one that comes first parts thousands
        cleaned = cleaned.replace(min(".,", key=cleaned.index), "")
    cleaned = cleaned.replace("′", "'").replace("″", '"').replace("''", '"')
    try:
        if "'" in cleaned or '"' in cleaned:
            return _parse_feet(cleaned)
        for suffix, factor in (("mm", 0.001), ("cm", 0.01), ("ft", METRES_PER_FOOT), ("m", 1.0)):
            if cleaned.endswith(suffix):
                return round(float(cleaned.removesuffix(suffix).replace(",", ".")) * factor, 6)
        return float(cleaned.replace(",", "."))
    except (ValueError, ZeroDivisionError):
        return None


def _feet(metres: float) -> str:
    sixteenths = round(abs(metres) / METRES_PER_FOOT * 12 * INCH_FRACTION)
    feet, rest = divmod(sixteenths, 12 * INCH_FRACTION)
    sign = "-" if metres < 0 and sixteenths else ""
    return f"{sign}{feet}' {_inches(rest)}"


def _inches(sixteenths: int) -> str:
    whole, rest = divmod(sixteenths, INCH_FRACTION)
    fraction = f"{Fraction(rest, INCH_FRACTION)}" if rest else ""
    return " ".join(part for part in (str(whole) if whole or not rest else "", fraction) if part) + '"'


def _parse_feet(text: str) -> float:
    """Metres of feet, inches and a fraction of an inch."""
    sign = -1 if text.startswith("-") else 1
    feet, _, inches = text.lstrip("-").partition("'") if "'" in text else ("0", "", text.lstrip("-"))
    parts = inches.replace('"', " ").split()
    total = float(feet or 0) * 12 + sum(float(Fraction(part)) for part in parts)
    return round(sign * total / 12 * METRES_PER_FOOT, 6)

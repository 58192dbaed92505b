"""How a drawing speaks: metric or imperial measures, English or German words.

Only what people read: the geometry of every export, and all of GeoJSON, stays in metres. The wording is that
of the workbench. Imperial drawings have imperial scales and paper, too (:mod:`.exporters.sheet`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, TypeVar, runtime_checkable

from floorplan_core.errors import UsageError

METRES_PER_FOOT = 0.3048
INCH_PARTS = 4  # drawings say a quarter of an inch (6 mm), as they say a centimetre
NEARLY = "≈"
FRACTIONS = ("", "¼", "½", "¾")
SYSTEMS = ("metric", "imperial")
LANGUAGES = ("en", "de")

GERMAN = {
    "Floor plan": "Grundriss",
    "Floor plan of {}": "Grundriss von {}",
    "Floor plan of {}, {}": "Grundriss von {}, {}",
    "Net area to the inside of walls {}, {} % of it predicted, not seen": (
        "Nettofläche bis zu den Wänden {}, davon {} % vorhergesagt, nicht gesehen"
    ),
    "{}, coordinates of the input; layers -PRED hold what was predicted": (
        "{}, Koordinaten der Aufnahme; die Layer -PRED enthalten Vorhergesagtes"
    ),
    "Metres": "Meter",
    "Dimensions in feet and inches, drawn in metres": "Maße in Fuß und Zoll, gezeichnet in Metern",
    "Legend": "Legende",
    "Scale and north": "Maßstab und Norden",
    "north = world +y": "Nord = +y der Welt",
    "Wall, observed": "Wand, gesehen",
    "Wall, speculated": "Wand, vermutet",
    "Floor, seen": "Boden, gesehen",
    "Floor, predicted": "Boden, vorhergesagt",
    "Door": "Tür",
    "Door, found shut": "Tür, geschlossen",
    "Shut door": "Geschlossene Tür",
    "Shut opening": "Geschlossener Durchgang",
    "Opening": "Durchgang",
    "Room": "Raum",
    "Corridor": "Flur",
    "{} net internal area to wall faces; {} % observed": "{} Nettofläche bis zu den Wänden; {} % gesehen",
    "{} region": "{} Region",
    "{} regions": "{} Regionen",
    "{} door": "{} Tür",
    "{} doors": "{} Türen",
    "storey {}": "Geschoss {}",
    "lengths in metres": "Längen in Metern",
    "lengths in feet and inches": "Längen in Fuß und Zoll",
    "≈ to a speculated wall": "≈ bis zu einer vermuteten Wand",
    "Scale {} when printed on {} at full size": "Maßstab {} beim Druck auf {} in voller Größe",
    "A0 or larger": "A0 oder größer",
    "E or larger": "E oder größer",
    "Drawn along the walls: {}° from the survey's axes (support {} %)": (
        "Entlang der Wände gezeichnet: {}° zu den Achsen der Aufnahme (Rückhalt {} %)"
    ),
    "Doors swing by convention": "Türen schlagen nach Übereinkunft auf",
    "slice {} above the floor": "Schnitt {} über dem Boden",
    "{} % seen": "{} % gesehen",
    "confidence {}": "Sicherheit {}",
    "room": "Raum",
    "corridor": "Flur",
    "door": "Tür",
    "shut door": "geschlossene Tür",
    "predicted": "vorhergesagt",
    "guessed side": "geratene Seite",
    "free, known": "frei, bekannt",
    "free, speculated": "frei, vermutet",
    "plan": "Plan",
    "x planes ({})": "x-Ebenen ({})",
    "y planes ({})": "y-Ebenen ({})",
    "other points": "andere Punkte",
}
WORDS = {"en": {}, "de": GERMAN}
MARKS = {"en": str.maketrans({}), "de": str.maketrans(".,", ",.")}


@dataclass(frozen=True)
class DrawingStyle:
    """The measures and the language of a drawing, and what it is called."""

    units: str = "metric"  # of SYSTEMS
    language: str = "en"  # of LANGUAGES
    title: str = ""  # "" is the name of the input

    def __post_init__(self) -> None:
        if self.units not in SYSTEMS:
            raise UsageError(f"Drawings are {' or '.join(SYSTEMS)} (asked: {self.units!r}).")
        if self.language not in LANGUAGES:
            raise UsageError(f"Drawings speak {' or '.join(LANGUAGES)} (asked: {self.language!r}).")

    @property
    def imperial(self) -> bool:
        """True where lengths are in feet and inches, areas in square feet."""
        return self.units == "imperial"

    def say(self, text: str, *values: object) -> str:
        """An English word or sentence in the language, its gaps filled; what is not known stays."""
        return WORDS[self.language].get(text, text).format(*values)

    def label(self, label: str) -> str:
        """A region's label as it begins a name; a word of a classifier plugin stays as it is.

        >>> DrawingStyle(language="de").label("corridor"), DrawingStyle().label("lobby")
        ('Flur', 'Lobby')
        """
        return WORDS[self.language].get(label.capitalize(), label.capitalize())

    def count(self, n: int, noun: str) -> str:
        """So many "region" or "door"."""
        return self.say(f"{{}} {noun}" if n == 1 else f"{{}} {noun}s", n)

    def number(self, value: float, digits: int) -> str:
        """A number with the decimal mark of the language; thousands are parted where they are usual."""
        rounded = round(value, digits) + 0.0  # no negative zero
        return f"{rounded:{',' if self.imperial else ''}.{digits}f}".translate(MARKS[self.language])

    def short(self, value: float) -> str:
        """A round number, without zeros behind the mark."""
        return f"{value:g}".translate(MARKS[self.language])

    def dimension(self, metres: float, guessed: bool = False) -> str:
        """A length as it is written at a dimension line, without the unit that goes without saying.

        A length to a wall that was ``guessed`` carries the sign of what is nearly equal.

        >>> DrawingStyle().dimension(3.2), DrawingStyle("imperial").dimension(3.2)
        ('3.20', '10\\' 6"')
        >>> DrawingStyle("imperial").dimension(0.9), DrawingStyle("metric", "de").dimension(0.9)
        ('2\\' 11½"', '0,90')
        """
        return (NEARLY if guessed else "") + (
            feet_and_inches(metres) if self.imperial else self.number(metres, 2)
        )

    def length(self, metres: float) -> str:
        """A length with its unit."""
        return self.dimension(metres) + ("" if self.imperial else " m")

    def area(self, m2: float, digits: int = 2) -> str:
        """An area with its unit; square feet have one digit less than square metres, and are finer still.

        >>> DrawingStyle().area(18.286), DrawingStyle("imperial").area(18.286)
        ('18.29 m²', '196.8 sq ft')
        """
        if self.imperial:
            return f"{self.number(m2 / METRES_PER_FOOT**2, max(digits - 1, 0))} sq ft"
        return f"{self.number(m2, digits)} m²"

    @property
    def metres_per_unit(self) -> float:
        """Of the unit of scale bars: a metre or a foot."""
        return METRES_PER_FOOT if self.imperial else 1.0

    @property
    def unit(self) -> str:
        """The unit of scale bars."""
        return "ft" if self.imperial else "m"


PLAIN = DrawingStyle()


def feet_and_inches(metres: float) -> str:
    """Feet and inches to a quarter of an inch.

    >>> feet_and_inches(3.0480), feet_and_inches(1.85), feet_and_inches(-0.1)
    ('10\\' 0"', '6\\' 0¾"', '-0\\' 4"')
    """
    parts = round(abs(metres) / METRES_PER_FOOT * 12 * INCH_PARTS)
    feet, rest = divmod(parts, 12 * INCH_PARTS)
    inches, quarters = divmod(rest, INCH_PARTS)
    return f"{'-' if metres < 0 and parts else ''}{feet}' {inches}{FRACTIONS[quarters]}\""


E = TypeVar("E")


@runtime_checkable
class Styled(Protocol):
    """An exporter of drawings, that can write them in another style."""

    def styled(self, style: DrawingStyle) -> Any:
        """The same exporter, writing in this style."""


def in_style(exporter: E, style: DrawingStyle) -> E:
    """``exporter`` in a style; one that writes no words (GeoJSON) as it is."""
    made: E = exporter.styled(style) if isinstance(exporter, Styled) else exporter
    return made

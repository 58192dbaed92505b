"""Colours of a plan, shared by the drawing and the pictures: those of the paper, softened for print.

Never the only cue: what is predicted is hatched, what is guessed is dashed, labels are written.
"""

from __future__ import annotations

from dataclasses import dataclass

INK = "#1f2933"
WALL = "#2b343d"
GREY = "#5b6873"
FAINT = "#b4bdc5"
PAPER = "#ffffff"
ACCENT = "#0f7285"


@dataclass(frozen=True)
class Tone:
    """Floor tint and the darker accent that reads on it."""

    tint: str
    accent: str


ROOM = Tone("#dbf0f3", "#0f7285")
CORRIDOR = Tone("#f8e1ed", "#9c2a6b")
OTHER = Tone("#ece9dd", "#6e6440")  # labels of classifier plugins
DOOR = Tone("#fdeeb5", "#a8700c")

TONES = {"room": ROOM, "corridor": CORRIDOR}


def tone(label: str) -> Tone:
    """The tone of a region's label; one neutral tone for every label that the paper does not know."""
    return TONES.get(label, OTHER)


def rgb(colour: str) -> tuple[int, int, int]:
    """``#rrggbb`` to 0..255 each."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)

"""The columns of the lists of regions, doors and planes: what they say, and what they sort by. No Qt."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from floorcast_app.format import area, length, number, percent, small
from floorcast_app.panels.by_hand import by_hand, hand_note
from floorplan_core.model import Door, Facing, FloorPlan, LayoutPlane, Region, loa_band

Words = Callable[[str], str]  # translates a word


@dataclass(frozen=True)
class Column:
    """One column: ``key(thing)`` sorts, ``text(thing, units, words)`` shows."""

    title: str
    key: Callable[[Any], Any]
    text: Callable[[Any, str, Words], str]
    number: bool = True  # right-aligned, in figures of equal width
    tip: str = ""


def _word(title: str, value: Callable[[Any], str], tip: str = "") -> Column:
    return Column(title, value, lambda thing, units, words: words(value(thing)), False, tip)


def _none_first(value: float | None) -> float:
    return float("-inf") if value is None else value


def natural(text: str) -> tuple[tuple[int, int, str], ...]:
    """A key that sorts "p2" before "p10".

    >>> sorted(["p10", "p2", "hall"], key=natural)
    ['hall', 'p2', 'p10']
    """
    import re

    parts = re.findall(r"\d+|\D+", text)
    return tuple((0, int(p), "") if p.isdigit() else (1, 0, p.casefold()) for p in parts)


REGIONS = (
    Column("Name", lambda r: natural(r.name), lambda r, u, w: r.name, False),
    _word("Kind", lambda r: r.label, "Room or corridor, by perimeter and turning distance"),
    Column("Area", lambda r: r.area, lambda r, u, w: area(r.area, u), tip="To the inside faces of the walls"),
    Column("Perimeter", lambda r: r.perimeter, lambda r, u, w: length(r.perimeter, u)),
    Column(
        "Seen",
        lambda r: 1 - r.speculated_fraction,
        lambda r, u, w: percent(1 - r.speculated_fraction),
        tip="Share of the floor that was seen free; the rest is predicted",
    ),
    Column(
        "Height", lambda r: _none_first(r.height), lambda r, u, w: length(r.height, u), tip="Floor to ceiling"
    ),
    Column(
        "Turning",
        lambda r: r.turning_distance,
        lambda r, u, w: number(r.turning_distance, ".2f"),
        tip="Turning distance to the unit square: how little it is like a room",
    ),
    Column("Doors", lambda r: len(r.doors), lambda r, u, w: str(len(r.doors))),
)

DOORS = (
    Column("Door", lambda d: natural(d.id), lambda d, u, w: d.id, False),
    _word("Kind", lambda d: d.kind, "A door, or an opening: wider, or without a lintel"),
    Column("Width", lambda d: d.width, lambda d, u, w: length(d.width, u)),
    Column("Height", lambda d: _none_first(d.height), lambda d, u, w: length(d.height, u)),
    Column("Wall", lambda d: d.thickness, lambda d, u, w: small(d.thickness or None, u), tip="Its thickness"),
    Column("Sure", lambda d: d.confidence, lambda d, u, w: percent(d.confidence), tip="Confidence"),
    Column(
        "Joins",
        lambda d: tuple(natural(r) for r in d.connects),
        lambda d, u, w: " – ".join(d.connects),
        False,
        "The regions on its two sides",
    ),
)


def facing_word(plane: LayoutPlane) -> str:
    """ "north", "east", "south" or "west"."""
    return Facing(plane.facing).name.lower()


def _offset_text(plane: LayoutPlane, units: str, words: Words) -> str:
    return f"{'x' if Facing(plane.facing).axis == 0 else 'y'} {length(plane.offset, units)}"


PLANES = (
    Column("Plane", lambda p: natural(p.id), lambda p, u, w: p.id, False),
    _word("Faces", facing_word),
    Column("Offset", lambda p: (Facing(p.facing).axis, p.offset), _offset_text),
    Column("Seen", lambda p: p.support, lambda p, u, w: area(p.support, u), tip="Surface that was observed"),
    Column(
        "Residual",
        lambda p: p.residual,
        lambda p, u, w: small(p.residual if p.support else None, u),
        tip="95 % of the points lie closer than this",
    ),
    Column(
        "LOA",
        lambda p: loa_band(p.residual if p.support else None),
        lambda p, u, w: loa_band(p.residual if p.support else None).replace("none", "–"),
        False,
        "Level of accuracy (USIBD) that the residual meets",
    ),
    Column("Parts", lambda p: len(p.segments), lambda p, u, w: str(len(p.segments)), tip="Observed segments"),
    _word(
        "Note", lambda p: "predicted" if p.speculated else "recess" if p.recess else "", "What it is made of"
    ),
)

CORRECTION = Column(  # the list adds what the machine had said
    "Correction",
    lambda thing: bool(by_hand(thing)),
    lambda thing, u, words: hand_note(thing, words),
    False,
    "What was said by hand, and what the machine had said",
)

COLUMNS: dict[str, tuple[Column, ...]] = {
    "region": (*REGIONS, CORRECTION),
    "door": (*DOORS, CORRECTION),
    "plane": (*PLANES, CORRECTION),
}


def things(plan: FloorPlan | None, kind: str) -> tuple[Region | Door | LayoutPlane, ...]:
    """What the list of ``kind`` holds."""
    if plan is None:
        return ()
    lists: dict[str, tuple[Any, ...]] = {"region": plan.regions, "door": plan.doors, "plane": plan.all_planes}
    return lists[kind]

"""What the selected thing is, why it is there, how sure that is, and what it was made from. No Qt.

English words with gaps, translated by ``words`` when they are shown.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from floorcast_app.actions.measure_actions import check_row
from floorcast_app.format import angle, area, count, length, number, percent, seconds, small
from floorcast_app.panels.by_hand import hand_note, machine_said
from floorcast_app.panels.evidence_words import EVIDENCE
from floorcast_app.panels.item_columns import facing_word
from floorcast_app.selection import Item
from floorcast_app.workbench import Workbench
from floorplan_core.model import Door, Facing, FloorPlan, LayoutPlane, LayoutSegment, Region, loa_band

Words = Callable[[str], str]


@dataclass(frozen=True)
class Fact:
    """One line: what, how much, and what that means."""

    name: str
    value: str
    tip: str = ""
    item: Item | None = None  # what the value names: a click selects it
    setting: str = ""  # the setting that decides it: a click shows it in the settings form


@dataclass(frozen=True)
class Section:
    """Some lines under a heading."""

    title: str
    facts: tuple[Fact, ...]


@dataclass(frozen=True)
class Portrait:
    """Everything the properties panel shows."""

    title: str
    subtitle: str = ""
    chips: tuple[tuple[str, str], ...] = ()  # (text, role): "chip", "chip-good" or "chip-warning"
    sections: tuple[Section, ...] = ()


def portrait(workbench: Workbench, item: Item | None, words: Words) -> Portrait | None:
    """What there is to say of ``item``; of the whole plan where it is None; None without a plan."""
    plan, units = workbench.plan, workbench.view.look.units
    if plan is None:
        return None
    thing = workbench.find(item)
    if thing is None or item is None:
        return _plan(plan, units, words)
    made = _MAKERS[item.kind](plan, thing, units, words)
    hand = hand_note(thing, words)
    if not hand:
        return made
    note = Fact(words("By hand"), hand)
    said = machine_said(workbench, item, words)
    facts = (note, Fact(words("Machine had said"), said)) if said else (note,)
    section = Section(words("Correction"), facts)
    return Portrait(
        made.title, made.subtitle, (*made.chips, (words("Corrected"), "chip-good")), (section, *made.sections)
    )


def _plan(plan: FloorPlan, units: str, words: Words) -> Portrait:
    seen = sum(r.area * (1 - r.speculated_fraction) for r in plan.regions)
    total = sum(r.area for r in plan.regions)
    rooms = sum(r.label == "room" for r in plan.regions)
    what = Section(
        words("What it is"),
        (
            Fact(
                words("Area"), area(total, units), words("Of all regions, to the inside faces of the walls")
            ),
            Fact(words("Seen"), f"{area(seen, units)} · {percent(seen / total if total else None)}"),
            Fact(words("Predicted"), area(total - seen, units), words("Free space that was not seen")),
            Fact(words("Regions"), _regions(len(plan.regions), rooms, words)),
            Fact(words("Doors"), str(len(plan.doors))),
        ),
    )
    frame = Section(
        words("How sure"),
        (
            Fact(
                words("Frame"),
                angle(math.degrees(plan.frame.yaw)),
                words("Turn of the walls against the file's axes"),
                setting="frame.yaw_deg",
            ),
            Fact(
                words("Support"), percent(plan.frame.support), words("Share of the wall along the two axes")
            ),
            Fact(words("Warnings"), str(len(plan.warnings))),
        ),
    )
    made = Section(
        words("Made from"),
        (
            Fact(words("Points"), count(plan.point_count)),
            Fact(words("Segments"), count(len(plan.segments))),
            Fact(words("Planes"), count(len(plan.all_planes))),
            Fact(
                words("Rectangles"), count(len(plan.cover.chosen)) if hasattr(plan.cover, "chosen") else "–"
            ),
            *(Fact(words("Time"), seconds(plan.seconds["total"])) for _ in (1,) if "total" in plan.seconds),
        ),
    )
    return Portrait(words("Floor plan"), plan.source, (), (what, frame, made))


def _regions(count: int, rooms: int, words: Words) -> str:
    if count < 2:
        return str(count)
    text = words("{n}, of them 1 room") if rooms == 1 else words("{n}, of them {rooms} rooms")
    return text.format(n=count, rooms=rooms)


def _region(plan: FloorPlan, region: Region, units: str, words: Words) -> Portrait:
    chips = [(words(region.label), "chip")]
    if region.speculated_fraction > 0.5:
        chips.append((words("mostly predicted"), "chip-warning"))
    guessed = [s for s in region.sides if s.speculated]
    worst = max((s.residual for s in region.sides if s.residual is not None), default=None)
    what = Section(
        words("What it is"),
        (
            Fact(words("Area"), area(region.area, units)),
            Fact(words("Perimeter"), length(region.perimeter, units), setting="labels.max_room_perimeter"),
            Fact(words("Height"), length(region.height, units), words("Floor to ceiling")),
            Fact(
                words("Turning distance"),
                number(region.turning_distance, ".2f"),
                words("To the unit square: a corridor where it is over the limit"),
                setting="labels.max_room_turning",
            ),
            *(Fact(words("Door"), _door_name(plan, d, units), item=Item("door", d)) for d in region.doors),
        ),
    )
    sure = Section(
        words("How sure"),
        (
            Fact(
                words("Seen"), percent(1 - region.speculated_fraction), words("Share of its floor seen free")
            ),
            Fact(words("Confidence"), percent(region.confidence)),
            Fact(
                words("Guessed sides"),
                words("{n} of {total}").format(n=len(guessed), total=len(region.sides)),
                words("Sides along which less than half was seen; they are dashed"),
            ),
            Fact(
                words("Worst side"),
                _residual(worst, units),
                words("95 % of its points lie closer"),
                setting="planes.tolerance",
            ),
        ),
    )
    planes = tuple(dict.fromkeys(s.plane for s in region.sides if s.plane))
    made = Section(
        words("Made from"),
        (
            Fact(words("Stage"), words("Set cover of the free space, then connected unions")),
            Fact(
                words("Rectangles"),
                "–" if region.rectangles is None else str(len(region.rectangles)),
                words("Candidates that the greedy cover chose"),
                setting="candidates.max_ratio",
            ),
            Fact(
                words("Cells"),
                words("{free} free of {total}").format(
                    free=count(region.free_cells), total=count(region.total_cells)
                ),
                setting="regions.risk",
            ),
            *(Fact(words("Wall"), _plane_name(plan, p, units, words), item=Item("plane", p)) for p in planes),
        ),
    )
    title = words("Region {name}").format(name=region.name)
    return Portrait(title, region.id, tuple(chips), (what, sure, made))


def _door(plan: FloorPlan, door: Door, units: str, words: Words) -> Portrait:
    sure = "chip-good" if door.confidence >= 0.7 else "chip" if door.confidence >= 0.5 else "chip-warning"
    what = Section(
        words("What it is"),
        (
            Fact(words("Width"), length(door.width, units), setting="doors.min_width"),
            Fact(words("Height"), length(door.height, units), words("From the floor to the lintel")),
            Fact(
                words("Wall"), small(door.thickness or None, units), words("Thickness between its two faces")
            ),
            *(
                Fact(words("Joins"), _region_name(plan, r, words), item=Item("region", r))
                for r in door.connects
            ),
        ),
    )
    why = Section(
        words("Why it is there"),
        (
            *(Fact("", words(EVIDENCE.get(word, word))) for word in door.evidence),
            Fact(words("Confidence"), percent(door.confidence), setting="doors.min_confidence"),
        ),
    )
    made = Section(
        words("Made from"),
        (
            Fact(
                words("Stage"),
                words("Histogram, gradient and matched filter along the wall"),
                setting="doors.aperture",
            ),
            *(
                Fact(words("Wall"), _plane_name(plan, p, units, words), item=Item("plane", p))
                for p in door.planes
            ),
        ),
    )
    title = words("Door {name}") if door.kind == "door" else words("Opening {name}")
    chips = ((words("{share} sure").format(share=percent(door.confidence)), sure),)
    return Portrait(title.format(name=door.id), "", chips, (what, why, made))


def _plane(plan: FloorPlan, plane: LayoutPlane, units: str, words: Words) -> Portrait:
    parts = [s for s in plan.all_segments if s.id in plane.segments]
    points = sum(s.points for s in parts)
    walls = float(sum(b - a for a, b in plane.walls))
    seen = float(sum(b - a for a, b in plane.observed))
    band = loa_band(plane.residual if plane.support else None)
    chips: list[tuple[str, str]] = [(band, "chip-good")] if band != "none" else []
    if plane.speculated:
        chips.append((words("predicted"), "chip-warning"))
    if plane.recess:
        chips.append((words("recess"), "chip"))
    axis = "x" if Facing(plane.facing).axis == 0 else "y"
    wing = words(
        "Of a wing that stands at this angle to the plan: its offset and the way it faces are along the"
        " wing's own axes."
    )
    what = Section(
        words("What it is"),
        (
            Fact(words("Offset"), f"{axis} {length(plane.offset, units)}", words("Along the way it faces")),
            *((Fact(words("Turned"), angle(math.degrees(plane.turn)), wing),) if plane.turn else ()),
            Fact(
                words("Wall"), length(walls, units), words("Length that is wall: seen, or between seen parts")
            ),
        ),
    )
    sure = Section(
        words("How sure"),
        (
            Fact(
                words("Residual"),
                _residual(plane.residual if plane.support else None, units),
                words("95 % of the points lie closer than this"),
                setting="planes.tolerance",
            ),
            Fact(
                words("Seen"), f"{length(seen, units)} · {percent(min(1.0, seen / walls) if walls else None)}"
            ),
            Fact(
                words("Surface"), area(plane.support, units), words("Observed"), setting="planes.min_support"
            ),
        ),
    )
    made = Section(
        words("Made from"),
        (
            Fact(words("Stage"), words("The fewest planes that explain all segments")),
            Fact(words("Points"), count(points)),
            *(Fact(words("Segment"), _segment_name(s, units), item=Item("segment", s.id)) for s in parts),
        ),
    )
    title = words("Wall {name}, faces {facing}").format(name=plane.id, facing=words(facing_word(plane)))
    return Portrait(title, "", tuple(chips), (what, sure, made))


def _segment(plan: FloorPlan, segment: LayoutSegment, units: str, words: Words) -> Portrait:
    what = Section(
        words("What it is"),
        (
            Fact(words("Length"), length(segment.length, units), setting="segments.min_length"),
            Fact(words("From"), length(segment.z_min, units), words("Above the floor")),
            Fact(
                words("To"),
                length(segment.z_max, units),
                words("Above the floor"),
                setting="segments.furniture_height",
            ),
            Fact(words("Surface"), area(segment.area, units), setting="segments.min_area"),
        ),
    )
    why = Section(
        words("Why it is there"),
        (
            Fact(words("Taken for"), words("wall") if segment.structural else words("furniture")),
            *(Fact("", words(EVIDENCE.get(word, word))) for word in segment.evidence),
        ),
    )
    made = Section(
        words("Made from"),
        (
            Fact(words("Points"), count(segment.points)),
            Fact(
                words("Residual"),
                _residual(segment.residual, units),
                words("95 % of the points lie closer than this"),
            ),
            Fact(
                words("Standard error"), f"{number(segment.sigma * 1000, '.2f')} mm", words("Of its offset")
            ),
            *(
                Fact(words("Wall"), _plane_name(plan, p, units, words), item=Item("plane", p))
                for p in (segment.plane,)
                if p
            ),
        ),
    )
    chip = (words("wall"), "chip-good") if segment.structural else (words("furniture"), "chip-warning")
    return Portrait(words("Segment {name}").format(name=segment.id), "", (chip,), (what, why, made))


def _check(plan: FloorPlan, check: Any, units: str, words: Words) -> Portrait:
    row = check_row(check)
    facts = (
        Fact(words("From plan"), length(row.plan, units)),
        Fact(words("Laser meter"), length(row.measured, units)),
        Fact("Δ", small(row.difference, units)),
        Fact("LOA", row.band or "–"),
    )
    return Portrait(
        words("Check {name}").format(name=check.id), check.note, (), (Section(words("What it is"), facts),)
    )


def _residual(metres: float | None, units: str) -> str:
    band = loa_band(metres)
    return small(metres, units) if band == "none" else f"{small(metres, units)} · {band}"


def _plane_name(plan: FloorPlan, id: str, units: str, words: Words) -> str:
    plane = next((p for p in plan.all_planes if p.id == id), None)
    return id if plane is None else f"{id}, {words(facing_word(plane))}"


def _door_name(plan: FloorPlan, id: str, units: str) -> str:
    door = next((d for d in plan.doors if d.id == id), None)
    return id if door is None else f"{id}, {length(door.width, units)}"


def _region_name(plan: FloorPlan, id: str, words: Words) -> str:
    region = next((r for r in plan.regions if r.id == id), None)
    return id if region is None else f"{words(region.label)} {region.name}"


def _segment_name(segment: LayoutSegment, units: str) -> str:
    return f"{segment.id}, {length(segment.length, units)}"


_MAKERS: dict[str, Callable[[FloorPlan, Any, str, Words], Portrait]] = {
    "region": _region,
    "door": _door,
    "plane": _plane,
    "segment": _segment,
    "check": _check,
}

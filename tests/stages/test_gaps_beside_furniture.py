"""Gaps beside furniture and chairs that are no doors: nothing but free space shows them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door
from floorplan_core.stages.door_evidence import DoorMeasures
from floorplan_core.stages.doors import Candidate, _judged
from floorplan_core.stages.regions import connect_doors
from tests.factories import l_corridor

PLAN = l_corridor()
BARE = ("open", "passage", "path", "corner")


def linked(
    evidence: tuple[str, ...], beyond: bool, others: tuple[str, ...] = ("lintel",), **changes: str
) -> bool:
    """Whether a door with that evidence is kept; ``beyond``: there is a region on its other side, too."""
    door, *rest = PLAN.doors
    door = replace(door, evidence=evidence, **changes)
    regions = PLAN.regions if beyond else [r for r in PLAN.regions if r.id != door.connects[0]]
    made = [door, *(replace(d, evidence=others) for d in rest)]
    return door.id in {d.id for d in connect_doors(regions, made)[1]}


@pytest.mark.parametrize("words", [(*BARE, "lintel"), (*BARE, "both faces"), ("shut",), ("passage",)])
def test_a_door_out_of_the_building_shows_a_lintel_or_its_other_face(words: tuple[str, ...]) -> None:
    assert linked(words, beyond=False)
    assert not linked(BARE, beyond=False)
    assert not linked(("open", "wall on both sides", "both faces"), beyond=False), "a window"


def test_a_bare_gap_between_two_regions_or_by_hand_or_in_a_planar_run_stays() -> None:
    assert linked(BARE, beyond=True)
    assert linked(BARE, beyond=False, by_hand="accepted")
    assert linked(BARE, beyond=False, others=BARE), "no door of this survey shows a lintel"


@pytest.mark.parametrize(("lintel", "support", "is_door"), [(0, 0.2, False), (0, 2.0, True), (1, 0.2, True)])
def test_of_a_chair_no_wall_is_made_and_no_door_beside_it(lintel: int, support: float, is_door: bool) -> None:
    measures = DoorMeasures(1, 1, 1, 1, 1, lintel, 1, 1, 1)
    only = Candidate(Door("", ("p1",), 0, 4.0, 1.5, 2.4), measures)
    assert (_judged(only, True, {"p1": support}).confidence >= DoorsConfig().min_confidence) is is_door

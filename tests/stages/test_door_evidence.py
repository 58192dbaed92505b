"""What speaks for a door: each kind of evidence raises its probability; gaps and windows stay low."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Facing, LayoutPlane, WallProfile
from floorplan_core.stages.door_apertures import apertures
from floorplan_core.stages.door_evidence import DoorMeasures, measure, view_wall
from tests.drawn_cells import drawn

DOOR = DoorMeasures(1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.9, 1.0)
# A cabinet before a wall: no surface below 2 m, wall above and beside, nothing seen behind.
HIDDEN = DoorMeasures(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.9, 0.0)
# A window: free above its sill up to the pane.
WINDOW = DoorMeasures(0.5, 0.0, 0.05, 0.0, 0.0, 1.0, 1.0, 1.0, 0.5, 0.0)
# A door seen at a slant from one side only: no straight passage, the room behind is dark.
SLANTED = DoorMeasures(0.95, 0.95, 0.9, 0.2, 0.0, 1.0, 1.0, 1.0, 0.9, 0.0)
NAMES = [f.name for f in fields(DoorMeasures)]
shares = st.floats(0.0, 1.0)


def test_doors_are_told_from_gaps_and_windows():
    assert DOOR.confidence(True) > 0.95
    assert SLANTED.confidence(True) > 0.8
    assert HIDDEN.confidence(True) < 0.1
    assert WINDOW.confidence(True) < 0.2


@given(
    values=st.lists(shares, min_size=len(NAMES), max_size=len(NAMES)),
    name=st.sampled_from(NAMES),
    more=shares,
)
def test_each_measure_speaks_for_a_door(values, name, more):
    measures = DoorMeasures(*values)
    raised = replace(measures, **{name: max(more, getattr(measures, name))})
    assert raised.confidence(True) >= measures.confidence(True)
    assert 0 <= measures.confidence(True) <= 1


def test_a_survey_without_lintels_is_not_blamed_for_it():
    flat = replace(DOOR, lintel=0.0)
    assert flat.confidence(False) > flat.confidence(True)


def test_two_faces_keep_the_better_of_each():
    both = HIDDEN.merged(SLANTED, both=True)
    assert both.open == SLANTED.open
    assert "both faces" in both.words()
    assert both.confidence(True) >= max(HIDDEN.confidence(True), SLANTED.confidence(True))


def test_glass_to_the_outside_stays_below_the_threshold():
    outward = replace(DOOR, passage=0.0, both=0.0)
    assert outward.confidence(True) < DoorsConfig().min_confidence
    assert replace(outward, both=1.0).confidence(True) > 0.9


def test_what_is_dark_behind_a_wall_of_the_building_is_no_glass_to_the_outside():
    outward = replace(SLANTED, passage=0.0)
    assert outward.confidence(True) < DoorsConfig().min_confidence
    assert replace(outward, onward=1.0).confidence(True) > DoorsConfig().min_confidence


@pytest.mark.parametrize(
    ("offset", "start", "onward"), [(4.0, 0.0, 1.0), (4.0, 8.0, 0.0), (9.7, 0.0, 0.0)], ids=str
)
def test_a_door_leads_on_where_a_room_behind_it_has_its_far_wall(offset, start, onward):
    none = np.zeros(240)
    plane = LayoutPlane("p1", Facing.EAST, 10.0, profile=WallProfile(0.0, 0.05, none, none, none))
    alike = np.array([[10.0, 0.0, 4.0], [offset, start, start + 4.0]])
    view = view_wall(plane, drawn([], []), alike)
    assert measure(plane, 1.0, 2.0, 0.9, view).onward == onward


def test_words_name_what_was_found():
    assert set(DOOR.words()) == {"open", "passage", "lintel", "wall on both sides", "both faces"}
    assert "open" not in HIDDEN.words()


def profile(low: str, high: str, through: str) -> WallProfile:
    """Ten bins a digit row, tenths; 5 cm a bin."""
    rows = [np.array([int(c) for c in row], dtype=float) / 9 for row in (low, high, through)]
    return WallProfile(0.0, 0.05, *rows)


CORNER = {  # the crossing wall at 0, a stub that nobody saw, a door from 0.25 to 1.15, then wall
    "low": "0" * 23 + "9" * 20,
    "through": "00000" + "9" * 18 + "0" * 20,
}


def corner_gaps(high: str, walls: list[list[float]]) -> list[tuple[float, float, float]]:
    seen = profile(high=high, **CORNER)
    runs = np.array(walls, dtype=float).reshape(-1, 2)
    return apertures(seen, seen.through, runs, np.array([0.0]), DoorsConfig())


def test_a_corner_door_under_its_lintel_begins_where_free_space_does():
    """The lintel makes the run of wall reach the corner, so no run ends at the door."""
    ((start, end, _),) = corner_gaps("5" * 43, [[0.0, 2.15]])
    assert (start, end) == (pytest.approx(0.25, abs=0.051), pytest.approx(1.15, abs=0.051))


def test_a_gap_in_a_corner_without_lintel_is_no_door_unless_the_wall_ends_there():
    assert corner_gaps("0" * 23 + "5" * 20, [[0.0, 2.15]]) == []
    assert len(corner_gaps("0" * 23 + "5" * 20, [[1.15, 2.15]])) == 1

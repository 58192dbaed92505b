"""Whatever a person says, in whatever order, the plan stays valid; on a building of two rooms and a door."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.errors import NoPlanError
from floorplan_core.model import corrections as c
from floorplan_core.session import PlanningSession
from tests.plan_invariants import assert_valid
from tests.sessions import plan, two_room_session


@pytest.fixture(scope="module")
def session() -> Iterator[PlanningSession]:
    yield two_room_session()


_PLACE = st.tuples(st.floats(-2.5, 8.5), st.floats(-1, 8))  # the building and a little around it
_NORMAL = st.sampled_from([(0.956, 0.292), (-0.956, -0.292), (-0.292, 0.956), (0.292, -0.956)])
_PLANE = st.builds(c.PlaneAt, _PLACE, _NORMAL)
_ANY = st.one_of(
    st.builds(c.HidePlane, _PLANE),
    st.builds(c.KeepPlane, _PLANE),
    st.builds(c.MovePlane, _PLANE, _PLACE),
    st.builds(c.AddWall, _PLACE, _PLACE, st.sampled_from([0.0, 0.1, 0.4])),
    st.builds(c.AcceptDoor, _PLACE),
    st.builds(c.RejectDoor, _PLACE),
    st.builds(c.AddDoor, _PLACE, _PLACE, st.sampled_from(["door", "opening"])),
    st.builds(c.ResizeDoor, _PLACE, _PLACE, _PLACE),
    st.builds(c.LabelRegion, _PLACE, st.sampled_from(["room", "kitchen"])),
    st.builds(c.NameRegion, _PLACE, st.sampled_from(["A", "1", "2", "9"])),
    st.builds(c.MergeRegions, st.lists(_PLACE, min_size=2, max_size=3).map(tuple)),
    st.builds(c.SplitRegion, _PLACE, _PLACE),
)


@settings(max_examples=120)
@given(said=st.lists(_ANY, max_size=6))
def test_random_corrections_keep_a_plan_valid(session, said):
    """Whatever is said in whatever order: a valid plan, or one sentence why there is none."""
    try:
        made = plan(session, *said)
    except NoPlanError:
        return
    assert_valid(made)
    kinds = {"plane": made.planes, "door": made.doors, "region": made.regions}
    assert all(any(x.id == ident for x in kinds[kind]) for kind, ident in made.corrected)
    assert all(text.endswith(".") for text in made.warnings)
    assert np.isfinite([v for r in made.regions for v in r.polygon.bounds]).all()

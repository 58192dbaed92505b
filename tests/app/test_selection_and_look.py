"""Selection, look and its saved form, the point store: the small models that the panes share."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorcast_app.point_store import PointStore
from floorcast_app.saved_look import look_from_dict, look_to_dict
from floorcast_app.selection import Item, Selection
from floorcast_app.view_state import LAYERS, Look, ViewState
from floorplan_core.model import PointChunk

DOOR, ROOM = Item("door", "d1"), Item("region", "r1")


def test_selecting_adding_and_taking_away() -> None:
    selection = Selection()
    heard: list[tuple[Item, ...]] = []
    selection.changed.connect(lambda: heard.append(selection.items))
    selection.select(DOOR)
    selection.select(DOOR)
    selection.select(ROOM, add=True)
    assert selection.item == ROOM and selection.items == (DOOR, ROOM)
    selection.select(DOOR, add=True)
    selection.select(None)
    assert heard == [(DOOR,), (DOOR, ROOM), (ROOM,), ()]


def test_many_things_are_selected_in_one_step() -> None:
    selection = Selection()
    selection.select(DOOR)
    heard: list[tuple[Item, ...]] = []
    selection.changed.connect(lambda: heard.append(selection.items))
    many = [Item("region", f"r{k}") for k in range(300)]
    selection.select_all([*many, many[0]])
    selection.select_all(many)
    assert heard == [tuple(many)] and selection.item == many[-1]
    selection.select_all([])
    assert heard[1:] == [()]


def test_what_a_new_plan_does_not_have_is_not_selected_any_more() -> None:
    selection = Selection()
    selection.select(DOOR)
    selection.select(ROOM, add=True)
    selection.hover(DOOR)
    selection.keep_only(lambda item: item.kind == "region")
    assert selection.items == (ROOM,) and selection.hovered is None


def test_the_look_tells_only_real_changes() -> None:
    view = ViewState()
    heard: list[Look] = []
    view.changed.connect(lambda before, after: heard.append(after))
    view.set(span=20.0)
    view.set(span=10.0, theme="dark")
    assert len(heard) == 1 and heard[0].theme == "dark"


looks = st.builds(
    Look,
    centre=st.tuples(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)),
    span=st.floats(0.1, 1e4),
    layers=st.frozensets(st.sampled_from(LAYERS)),
    facings=st.frozensets(st.integers(0, 3)),
    hidden=st.frozensets(st.tuples(st.sampled_from(["door", "plane"]), st.text(max_size=4))),
    ceiling_cut=st.none() | st.floats(0, 10),
    section=st.none() | st.tuples(*[st.floats(-99, 99)] * 4),
    units=st.sampled_from(["m", "ft-in"]),
)


@given(looks)
def test_a_look_comes_back_from_json(look: Look) -> None:
    assert look_from_dict(json.loads(json.dumps(look_to_dict(look)))) == look


@pytest.mark.parametrize("bad", [{"centre": "x"}, {"units": "miles"}, {"hidden": [1]}, {"layers": 5}, {}])
def test_what_is_not_a_look_is_left_as_it_comes(bad: dict[str, object]) -> None:
    assert look_from_dict(bad) == Look()


def test_the_point_store_is_bounded_and_even() -> None:
    store = PointStore(most=1000)
    line = np.zeros((700, 3), dtype=np.float32)
    for k in range(9):
        line[:, 0] = np.arange(700) + 700 * k
        store.add(PointChunk(line.copy()))
    kept = np.sort(store.snapshot().xyz[:, 0])
    assert 250 <= len(kept) <= 1000 and len(store) == len(kept)
    assert np.ptp(np.diff(kept)) <= 8  # every k-th point, from first to last
    assert kept[-1] > 6200


def test_a_snapshot_is_shuffled_and_the_same_each_time() -> None:
    store = PointStore()
    store.add(PointChunk(np.arange(300, dtype=np.float32).reshape(100, 3)))
    one, two = store.snapshot(), store.snapshot()
    assert np.array_equal(one.xyz, two.xyz)
    assert not np.array_equal(one.xyz[:, 0], np.sort(one.xyz[:, 0]))
    assert len(PointStore().snapshot().xyz) == 0

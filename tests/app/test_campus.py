"""A site of two buildings in the window: what is said of a thing is found again, in either building."""

from __future__ import annotations

import numpy as np
import pytest

from floorcast_app.actions.naming import about
from floorcast_app.selection import Item
from floorcast_app.workbench import Workbench
from tests.app.pump import planned, settle
from tests.app.surveys import write_campus


@pytest.fixture(scope="module")
def campus(tmp_path_factory: pytest.TempPathFactory) -> Workbench:
    bench = planned(write_campus(tmp_path_factory.mktemp("campus")))
    assert len(bench.plan.regions) == 4
    return bench


@pytest.fixture
def bench(campus: Workbench):
    """The workbench as it was planned; corrections are undone."""
    yield campus
    campus.document.go_to(0)
    settle(campus)


def rooms(bench: Workbench, large: bool) -> list:
    middle = float(np.mean(bench.plan.grid.extent[::2]))
    return sorted(
        (r for r in bench.plan.regions if (r.polygon.centroid.x > middle) == large),
        key=lambda r: r.polygon.bounds[0],
    )


def test_walls_drawn_in_both_buildings_are_told_apart(bench: Workbench) -> None:
    for large in (True, False, False):
        x0, y0, _, y1 = rooms(bench, large)[-1].polygon.bounds
        bench.run("correct.add_wall", start=(x0 + 1.2, y0), end=(x0 + 1.2, y1), thickness=0.1)
        settle(bench)
    added = [p for p in bench.plan.all_planes if p.by_hand == "added"]
    assert len(added) == 6 and len({p.id for p in added}) == 6
    assert (len(rooms(bench, True)), len(rooms(bench, False))) == (3, 4)
    said = {p.id: about(bench, Item("plane", p.id)) for p in added}
    assert sorted(said.values(), key=sorted) == [frozenset({k}) for k in (0, 0, 1, 1, 2, 2)]
    west = min(added, key=lambda p: p.offset)
    bench.run("correct.release", item=f"plane:{west.id}")
    settle(bench)
    assert (len(rooms(bench, True)), len(rooms(bench, False))) == (3, 3)
    assert about(bench, Item("plane", west.id)) in (frozenset({1}), frozenset())


def test_all_that_was_said_of_the_smaller_building_is_taken_back(bench: Workbench) -> None:
    door = next(d for d in bench.plan.doors if set(d.connects) == {r.id for r in rooms(bench, False)})
    wall = max((p for p in bench.plan.wings[0].planes if p.facing.axis == 0), key=lambda p: p.offset)
    room = rooms(bench, False)[1]
    bench.run("correct.resize_door", door=door.id, width=1.1)
    bench.run("correct.move_plane", plane=wall.id, offset=wall.offset + 0.2)
    bench.run("correct.rename", region=room.id, name="Shed")
    settle(bench)
    assert bench.find(Item("door", door.id)).width == pytest.approx(1.1, abs=1e-3)
    assert bench.find(Item("plane", wall.id)).by_hand == "moved"
    assert rooms(bench, False)[1].name == "Shed"
    for item in (f"door:{door.id}", f"plane:{wall.id}", f"region:{rooms(bench, False)[1].id}"):
        bench.run("correct.release", item=item)
        settle(bench)
    assert bench.state.corrections == ()

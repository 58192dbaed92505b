"""Random actions on a workbench: what is done, with what, and what must hold after each."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

from floorcast_app.selection import Item
from floorcast_app.state import Check
from floorcast_app.workbench import Workbench
from floorplan_core.errors import UsageError
from floorplan_core.exporters.geojson import geojson_text
from tests.app.pump import settle
from tests.plan_invariants import assert_valid

PLAN_EVERY = 20  # actions between two waits for the plan; in between, jobs overtake each other

Arguments = Callable[[random.Random, Workbench], dict[str, Any]]


def _some(kind: str) -> Callable[[random.Random, Workbench], str]:
    """The id of a random thing of the present plan; now and then one that is not there."""

    def choose(rng: random.Random, workbench: Workbench) -> str:
        plan = workbench.plan
        assert plan is not None
        things = {"plane": plan.all_planes, "door": plan.doors, "region": plan.regions}[kind]
        return rng.choice([*(t.id for t in things), "nothing"])

    return choose


def _place(rng: random.Random, workbench: Workbench) -> tuple[float, float]:
    """Half of the time in or near a room: most of a site of several buildings is nowhere."""
    assert workbench.plan is not None
    x0, y0, x1, y1 = workbench.plan.grid.extent
    if rng.random() < 0.5:
        x0, y0, x1, y1 = rng.choice(workbench.plan.regions).polygon.buffer(1.0).bounds
    return rng.uniform(x0, x1), rng.uniform(y0, y1)


def _pair(rng: random.Random, workbench: Workbench) -> dict[str, Any]:
    """Two places, half of the time along an axis and near each other."""
    x, y = _place(rng, workbench)
    if rng.random() < 0.5:
        return {"start": (x, y), "end": _place(rng, workbench)}
    return {"start": (x, y), "end": (x + rng.uniform(0.2, 3), y) if rng.random() < 0.5 else (x, y + 1.0)}


ACTIONS: dict[str, Arguments] = {
    "correct.hide_plane": lambda r, w: {"plane": _some("plane")(r, w)},
    "correct.keep_plane": lambda r, w: {"plane": _some("plane")(r, w)},
    "correct.move_plane": lambda r, w: {
        "plane": _some("plane")(r, w),
        "to": _place(r, w),
        "snap": r.random() < 0.5,
    },
    "correct.add_wall": lambda r, w: {**_pair(r, w), "thickness": r.choice([None, 0.0, 0.2])},
    "correct.accept_door": lambda r, w: {"door": _some("door")(r, w)},
    "correct.reject_door": lambda r, w: {"door": _some("door")(r, w)},
    "correct.add_door": lambda r, w: {**_pair(r, w), "kind": r.choice(["auto", "door", "opening"])},
    "correct.resize_door": lambda r, w: {"door": _some("door")(r, w), "width": r.uniform(-0.5, 3)},
    "correct.relabel": lambda r, w: {
        "region": _some("region")(r, w),
        "label": r.choice(["hall", "room", " "]),
    },
    "correct.rename": lambda r, w: {"region": _some("region")(r, w), "name": r.choice(["A", "1", "B", ""])},
    "correct.merge": lambda r, w: {"regions": (_some("region")(r, w), _some("region")(r, w))},
    "correct.split": lambda r, w: _pair(r, w) if r.random() < 0.5 else {"region": _some("region")(r, w)},
    "correct.release": lambda r, w: {"item": f"plane:{_some('plane')(r, w)}"},
    "correct.clear": lambda r, w: {},
    "edit.delete": lambda r, w: {},
    "edit.clear_selection": lambda r, w: {},
    "edit.undo": lambda r, w: {},
    "edit.redo": lambda r, w: {},
    "edit.history": lambda r, w: {"position": r.randrange(-1, len(w.document.history) + 1)},
}
WEIGHTS = {"correct.clear": 0.3, "edit.undo": 4, "edit.redo": 2, "edit.delete": 2}

OF_STOREYS: dict[str, Arguments] = {
    "plan.storey": lambda r, w: {"number": r.randrange(-1, len(w.storeys) + 1)},
    "plan.storey_up": lambda r, w: {},
    "plan.storey_down": lambda r, w: {},
}


def _select(rng: random.Random, workbench: Workbench) -> None:
    kind = rng.choice(["plane", "door", "region", "check"])
    checks = [c.id for c in workbench.state.checks]
    ids = checks if kind == "check" else [_some(kind)(rng, workbench)]
    for ident in ids:
        if workbench.exists(Item(kind, ident)):
            workbench.selection.select(Item(kind, ident), add=rng.random() < 0.5)


def play(workbench: Workbench, seed: int, count: int) -> None:
    """``count`` random actions, all of them undone, and done again; the workbench is left as it was."""
    document, rng = workbench.document, random.Random(seed)
    first, first_plan = document.state, geojson_text(workbench.plan)
    actions = ACTIONS | (OF_STOREYS if len(workbench.storeys) > 1 else {})
    weights = [WEIGHTS.get(name, 1.0) for name in actions]
    seen: dict[int, Any] = {}
    refused = 0
    for step in range(count):
        if rng.random() < 0.3:
            _select(rng, workbench)
        if rng.random() < 0.05:
            number = f"c{step}"
            checks = (*workbench.state.checks, Check(number, (0.0, 0.0), (1.0, 0.0), rng.random()))
            workbench.change(f"Add check {number}", checks=checks)
        (name,) = rng.choices(list(actions), weights)
        position, state = document.position, document.state
        try:
            workbench.run(name, **actions[name](rng, workbench))
        except UsageError:
            refused += 1
            assert document.position == position  # what is refused changes nothing
            assert document.state == state
        assert_consistent(workbench)
        seen[document.position] = document.state
        if step % PLAN_EVERY == 0:
            settle(workbench)
            assert_plan(workbench)
    assert count / 25 < refused < count / 2
    settle(workbench)
    _undo_all(workbench, first, first_plan, seen)


def _undo_all(workbench: Workbench, first: Any, first_plan: str, seen: dict[int, Any]) -> None:
    document = workbench.document
    last = document.position
    for position in range(last, -1, -1):
        assert document.position == position
        assert document.history[position].state == document.state
        document.undo()
    assert document.state == first
    assert document.state is document.history[0].state
    settle(workbench)
    assert geojson_text(workbench.plan) == first_plan
    workbench.run("edit.history", position=last)
    assert document.state == seen.get(last, first)
    document.go_to(0)
    settle(workbench)
    assert geojson_text(workbench.plan) == first_plan


def assert_consistent(workbench: Workbench) -> None:
    """The history leads to the state; what is selected exists."""
    document = workbench.document
    assert 0 <= document.position < len(document.history)
    assert document.history[document.position].state is document.state
    assert all(step.text for step in document.history)
    assert all(a.state != b.state for a, b in zip(document.history, document.history[1:], strict=False))
    assert all(workbench.exists(item) for item in workbench.selection.items)
    hash(document.state.corrections)  # plain values only


def assert_plan(workbench: Workbench) -> None:
    """The plan is a valid one; where none could be made of the corrections, somebody was told."""
    told = workbench.ui.told  # type: ignore[attr-defined]
    failed = [text for kind, text in told if kind == "error"]
    assert all("No region came out" in text or "No wall" in text for text in failed), failed
    told.clear()
    assert workbench.plan is not None
    assert_valid(workbench.plan)

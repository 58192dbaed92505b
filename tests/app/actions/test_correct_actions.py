"""Every action of the edit and correct menus, on the bundled survey: what it says, what the plan becomes."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from floorcast_app.actions import correct_actions, edit_actions
from floorcast_app.selection import Item
from floorcast_app.state import Check
from floorcast_app.workbench import Workbench
from floorplan_core.errors import UsageError
from floorplan_core.model.corrections import AddWall, HidePlane
from tests.app.pump import settle
from tests.plan_invariants import assert_valid


class _Answers:
    """A person who answers every question with the same text."""

    def __init__(self, text: str | None) -> None:
        self.text = text
        self.told: list[tuple[str, str]] = []
        self.shown: list[str] = []

    def ask_text(self, title: str, label: str, text: str) -> str | None:
        return self.text

    def tell(self, text: str, kind: str = "info") -> None:
        self.told.append((kind, text))

    def show(self, what: str, **arguments: object) -> None:
        self.shown.append(what)


@pytest.fixture
def bench(sample_workbench) -> Iterator[Workbench]:
    """The bundled survey, planned; after the test as before it."""
    ui = sample_workbench.ui
    yield sample_workbench
    sample_workbench.ui = ui
    sample_workbench.selection.select(None)
    sample_workbench.set_tool("select")
    sample_workbench.document.go_to(0)
    settle(sample_workbench)


def run(bench: Workbench, id: str, **arguments: object) -> None:
    """Run an action and wait for the plan, which must be a valid one."""
    bench.run(id, **arguments)
    settle(bench)
    assert bench.plan is not None
    assert_valid(bench.plan)


def _wall(bench: Workbench):
    """The wall that is the longest side of a region."""
    assert bench.plan is not None
    sides = [s for r in bench.plan.regions for s in r.sides if s.plane]
    return bench.find(Item("plane", max(sides, key=lambda s: s.length).plane))


def _pick(bench: Workbench, *items: tuple[str, str]) -> None:
    bench.selection.select(None)
    for kind, ident in items:
        bench.selection.select(Item(kind, ident), add=True)


def test_hide_keep_and_release_a_wall(bench):
    """Switched off, on again, and nothing said: three steps, each of which undo takes back."""
    wall = _wall(bench)
    run(bench, "correct.hide_plane", plane=wall.id)
    assert bench.find(Item("plane", wall.id)).by_hand == "hidden"
    assert bench.document.undo_text == f"Switch off wall {wall.id}"
    run(bench, "correct.keep_plane", plane=wall.id)
    assert bench.find(Item("plane", wall.id)).by_hand == "kept"
    run(bench, "correct.release", item=f"plane:{wall.id}")
    assert bench.state.corrections == ()
    assert bench.find(Item("plane", wall.id)).by_hand == ""
    run(bench, "edit.undo")
    assert bench.find(Item("plane", wall.id)).by_hand == "kept"


def test_move_a_wall_by_place_by_offset_by_question_and_to_evidence(bench):
    wall = _wall(bench)
    axis = wall.facing.axis
    run(bench, "correct.move_plane", plane=wall.id, to=[wall.offset + 0.11] * 2)
    assert bench.find(Item("plane", wall.id)).offset == pytest.approx(wall.offset + 0.11)
    run(bench, "correct.move_plane", plane=wall.id, offset=wall.offset - 0.08)
    assert bench.find(Item("plane", wall.id)).offset == pytest.approx(wall.offset - 0.08)
    sides = [s for r in bench.plan.regions for s in r.sides if s.plane == wall.id]
    assert any(abs(s.start[axis] - (wall.offset - 0.08)) < 1e-6 for s in sides)
    bench.ui = _Answers(f"{wall.offset + 0.05:.3f} m")
    _pick(bench, ("plane", wall.id))
    run(bench, "correct.move_plane")
    assert bench.find(Item("plane", wall.id)).offset == pytest.approx(wall.offset + 0.05, abs=1e-3)
    run(bench, "correct.move_plane", offset=wall.offset + 0.04, snap=True)
    offsets = [s.offset for s in bench.plan.segments if s.facing == wall.facing]
    assert min(abs(bench.find(Item("plane", wall.id)).offset - o) for o in offsets) < 1e-6
    run(bench, "correct.release", item=Item("plane", wall.id))
    assert bench.find(Item("plane", wall.id)).offset == wall.offset


def test_add_a_wall_and_delete_it(bench):
    """Two clicks make two rooms of one; deleted, it was never there."""
    room = max((r for r in bench.plan.regions if r.label == "room"), key=lambda r: r.area)
    x0, y0, x1, y1 = room.polygon.bounds
    count, middle = len(bench.plan.regions), (y0 + y1) / 2
    run(bench, "correct.add_wall", start=(x0 + 0.1, middle), end=(x1 - 0.1, middle))
    assert len(bench.plan.regions) == count + 1
    (said,) = bench.state.corrections
    assert isinstance(said, AddWall)
    assert 0.05 < said.thickness < 0.3  # like the other walls
    _pick(bench, ("plane", "hw1a"))
    run(bench, "edit.delete")
    assert bench.state.corrections == ()
    assert len(bench.plan.regions) == count


def test_accept_reject_resize_and_add_doors(bench):
    doors = [d for d in bench.plan.doors if len(d.connects) == 2 and d.kind == "door"]
    door, other = doors[:2]
    run(bench, "correct.accept_door", door=door.id)
    assert bench.find(Item("door", door.id)).confidence == 1.0
    run(bench, "correct.resize_door", door=door.id, width=1.1)
    assert bench.find(Item("door", door.id)).width == pytest.approx(1.1)
    assert bench.document.undo_text == f"Resize door {door.id} to 1.100 m"
    _pick(bench, ("door", other.id))
    run(bench, "edit.delete")
    assert bench.document.undo_text == f"Delete {other.id}"
    assert not bench.exists(Item("door", other.id))
    assert bench.selection.items == ()
    ends = other.line()
    run(bench, "correct.add_door", start=tuple(ends[0]), end=tuple(ends[1]))
    (added,) = [d for d in bench.plan.doors if d.by_hand == "added"]
    assert added.width == pytest.approx(other.width)
    assert set(added.connects) == set(other.connects)
    assert added.kind == "door"


def test_regions_are_relabelled_renamed_merged_and_split(bench):
    room = bench.plan.regions[0]
    bench.ui = _Answers("Lobby")
    _pick(bench, ("region", room.id))
    run(bench, "correct.rename")
    run(bench, "correct.relabel", label="foyer")
    assert (bench.find(Item("region", room.id)).name, bench.find(Item("region", room.id)).label) == (
        "Lobby",
        "foyer",
    )
    assert bench.plan.machine[room.id] == f"name {room.name}; label {room.label}"
    count = len(bench.plan.regions)
    run(bench, "correct.split", region=room.id)
    assert len(bench.plan.regions) == count + 1
    parts = [r for r in bench.plan.regions if "split" in r.by_hand]
    _pick(bench, *(("region", r.id) for r in parts))
    run(bench, "correct.merge")
    assert len(bench.plan.regions) == count
    assert bench.find(Item("region", room.id)).name == "Lobby"
    run(bench, "correct.clear")
    assert bench.state.corrections == ()


def test_several_things_are_one_step(bench):
    walls = [p.id for p in bench.plan.planes[:3]]
    _pick(bench, *(("plane", w) for w in walls))
    bench.run("correct.hide_plane")
    assert len(bench.state.corrections) == 3
    assert bench.document.undo_text == "Switch off 3 walls"
    assert bench.document.position == 1
    settle(bench)


def test_deleting_walls_doors_and_checks_is_one_step(bench):
    bench.change(
        "Add check", checks=(Check("c1", (0.0, 0.0), (1.0, 0.0)), Check("c2", (0.0, 0.0), (2.0, 0.0)))
    )
    wall, door = _wall(bench), bench.plan.doors[0]
    _pick(bench, ("check", "c1"), ("plane", wall.id), ("door", door.id))
    run(bench, "edit.delete")
    assert [c.id for c in bench.state.checks] == ["c2"]
    assert isinstance(bench.state.corrections[0], HidePlane)
    assert len(bench.state.corrections) == 2
    assert bench.document.position == 2


def test_undo_redo_and_history(bench):
    room = bench.plan.regions[0]
    for label in ("a", "b", "c"):
        bench.run("correct.relabel", region=room.id, label=label)
    states = [s.state for s in bench.document.history]
    bench.run("edit.undo")
    assert bench.state is states[2]
    bench.run("edit.history", position=1)
    assert bench.state is states[1]
    bench.run("edit.redo")
    assert bench.state is states[2]
    bench.ui = _Answers(None)
    bench.run("edit.history")
    assert bench.ui.shown == ["history"]
    bench.run("edit.history", position=0)
    assert not bench.actions["edit.undo"].enabled(bench)
    settle(bench)


@pytest.mark.parametrize(
    ("action", "tool"),
    [
        ("correct.add_wall", "wall"),
        ("correct.add_door", "door"),
        ("correct.split", "split"),
        ("correct.merge", "merge"),
    ],
)
def test_without_places_the_tool_is_taken(bench, action, tool):
    bench.run(action)
    assert bench.tool == tool
    assert bench.state.corrections == ()


@pytest.mark.parametrize(
    "action", ["correct.move_plane", "correct.resize_door", "correct.relabel", "correct.rename"]
)
def test_a_question_that_is_dismissed_changes_nothing(bench, action):
    bench.ui = _Answers(None)
    kind = {"correct.move_plane": "plane", "correct.resize_door": "door"}.get(action, "region")
    _pick(
        bench,
        (kind, {"plane": _wall(bench), "door": bench.plan.doors[0]}.get(kind, bench.plan.regions[0]).id),
    )
    bench.run(action)
    assert bench.document.position == 0


@pytest.mark.parametrize(
    ("action", "arguments", "said"),
    [
        ("correct.hide_plane", {}, "Select a wall first"),
        ("correct.hide_plane", {"plane": "p999"}, "no wall 'p999'"),
        ("correct.merge", {"regions": ["r1"]}, "at least 2 regions"),
        ("correct.move_plane", {"plane": "p1", "to": (float("nan"), 0)}, "two numbers in metres"),
        ("correct.add_wall", {"start": (0, 0), "end": (1, 0), "thickness": -1}, "between 0 and 2"),
        ("correct.add_door", {"start": (0, 0), "end": (1, 0), "kind": "gate"}, "not 'gate'"),
        ("correct.resize_door", {"door": "d1", "width": 0}, "cannot be 0 m wide"),
        ("correct.relabel", {"region": "r1", "label": " "}, "label is a word"),
        ("correct.rename", {"region": "r1", "name": "2"}, "region 2 already"),
        ("correct.release", {"item": "door:d1"}, "Nothing was said"),
        ("edit.history", {"position": 7}, "no step 7"),
    ],
)
def test_what_is_wrong_is_said_and_changes_nothing(bench, action, arguments, said):
    with pytest.raises(UsageError, match=said):
        bench.run(action, **arguments)
    assert bench.document.position == 0


def test_nothing_of_it_is_possible_without_a_plan(workbench):
    for action in correct_actions.ACTIONS:
        assert not action.enabled(workbench)
    assert not workbench.actions["edit.delete"].enabled(workbench)


def test_every_action_teaches():
    """Text in sentence case, a tip that is a sentence, an icon that is there, no shortcut twice."""
    from importlib.resources import files

    icons = files("floorcast_resources") / "icons"
    actions = (*correct_actions.ACTIONS, *edit_actions.ACTIONS)
    for action in actions:
        assert action.text[0].isupper()
        assert action.tip.endswith(".")
        assert not action.icon or (icons / f"{action.icon}.svg").is_file(), action.icon
    shortcuts = [a.shortcut for a in actions if a.shortcut]
    assert len(shortcuts) == len(set(shortcuts))

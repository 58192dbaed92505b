"""The document: states are values, history is a list of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from floorcast_app.document import Document
from floorcast_app.state import Check, DocumentState, SurveyRef


def state(number: int) -> DocumentState:
    return DocumentState(checks=(Check("c1", (0.0, 0.0), (float(number), 0.0)),))


def test_undo_and_redo_walk_through_the_states() -> None:
    document = Document()
    first = document.state
    document.apply("one", state(1))
    document.apply("two", state(2))
    assert (document.undo_text, document.redo_text) == ("two", "")
    document.undo()
    assert document.state == state(1) and document.redo_text == "two"
    document.undo()
    assert document.state == first and document.undo_text == ""
    document.undo()  # nothing is left: nothing happens
    document.redo()
    document.redo()
    assert document.state == state(2)


def test_a_step_after_undo_forgets_what_was_undone() -> None:
    document = Document()
    document.apply("one", state(1))
    document.undo()
    document.apply("other", state(5))
    assert [step.text for step in document.history] == ["Open", "other"]


def test_what_changes_nothing_is_no_step() -> None:
    document = Document()
    heard: list[tuple[DocumentState, DocumentState]] = []
    document.changed.connect(lambda before, after: heard.append((before, after)))
    document.apply("nothing", document.state)
    assert len(document.history) == 1 and heard == []
    document.apply("one", state(1))
    assert heard == [(DocumentState(), state(1))]


def test_dirty_is_told_from_the_saved_state() -> None:
    document = Document()
    document.apply("one", state(1))
    assert document.dirty
    document.mark_saved()
    assert not document.dirty
    document.undo()
    assert document.dirty
    document.redo()
    assert not document.dirty


def test_reset_begins_a_new_history() -> None:
    document = Document()
    document.apply("one", state(1))
    opened = replace(state(1), survey=SurveyRef(Path("a.ply")))
    document.reset(opened, "Open a.ply", saved=False)
    assert len(document.history) == 1 and document.state == opened and document.dirty


@given(st.lists(st.sampled_from(["do", "undo", "redo", "jump"]), max_size=60), st.integers(0, 9))
def test_undoing_everything_gives_the_first_state(steps: list[str], jump: int) -> None:
    document = Document()
    first = document.state
    for number, step in enumerate(steps):
        if step == "do":
            document.apply(str(number), state(number + 1))
        elif step == "jump":
            document.go_to(jump)
        else:
            getattr(document, step)()
        assert document.state == document.history[document.position].state
    document.go_to(0)
    assert document.state == first

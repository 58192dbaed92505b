"""Bars on a terminal: one line a stage, messages between them, nothing where there is no terminal."""

from __future__ import annotations

import io
import sys
from types import SimpleNamespace
from typing import Any

import pytest

from floorplan_core.cli.console import Console, StageBars


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def console(**options: bool) -> Console:
    context: Any = SimpleNamespace(obj=None)
    return Console(context, **options)


def test_bars_and_messages_share_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    with console().observer() as observer:
        observer.stage_started("frame", 4)
        observer.progress("frame", 2)
        observer.stage_finished("frame", 1.25)
        observer.stage_started("frame")
        observer.stage_finished("frame", 0.5)
        observer.warning("Walls [0.5] are thin.")
        observer.warning("Walls [0.5] are thin.")
    text = terminal.getvalue()
    assert "1.75 s" in text  # both steps of the stage
    assert text.count("Warning: Walls [0.5] are thin.") == 1


def test_no_bars_without_a_terminal_and_none_when_quiet(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with console().observer() as observer:
        observer.stage_started("frame", 4)
        observer.stage_finished("frame", 1.0)
        observer.warning("Thin walls.")
    assert capsys.readouterr() == ("", "Warning: Thin walls.\n")
    monkeypatch.setattr(sys, "stderr", Terminal())
    for options in ({"quiet": True}, {"as_json": True}):
        with console(**options).observer() as observer:
            observer.stage_started("frame", 4)
            observer.warning("Thin walls.")
        assert sys.stderr.getvalue() == ""  # type: ignore[attr-defined]
        assert observer.warnings == ["Thin walls."]


def test_results_are_kept_in_order_only_when_asked_for() -> None:
    kept, dropped = console().observer(keep_results=True), console().observer()
    for observer in (kept, dropped):
        for stage, result in (("frame", 1), ("planes", 2), ("frame", 3), ("read", None)):
            observer.stage_finished(stage, 0.1, result)
    assert kept.results == [("frame", 1), ("planes", 2), ("frame", 3)]
    assert dropped.results == []


def test_a_stage_that_finishes_without_having_begun_gets_its_line() -> None:
    bars = StageBars()
    bars.advance("cover", 3)  # unknown: nothing to advance
    bars.finish("cover", 0.25)
    (task,) = bars.progress.tasks
    assert task.finished and "0.25 s" in task.fields["note"]

"""What a command says, and where: results on stdout, messages and progress on stderr."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

import typer

from floorplan_core.observer import CancelToken, Observer

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID
    from rich.table import Table


class Console:
    """The voice of one command."""

    def __init__(self, context: typer.Context, *, as_json: bool = False, quiet: bool = False) -> None:
        self.as_json = as_json
        self.quiet = quiet
        self.live: Progress | None = None  # the bars on the terminal, while there are any
        self.token = context.obj if isinstance(context.obj, CancelToken) else CancelToken()

    def result(self, data: dict[str, Any], text: str) -> None:
        """The command's result: ``data`` as one line of JSON with ``--json``, else ``text``."""
        if self.as_json:
            sys.stdout.write(json.dumps({"ok": True, **data}, ensure_ascii=False) + "\n")
        elif not self.quiet:
            sys.stdout.write(text.rstrip("\n") + "\n")

    def table(self, data: dict[str, Any], table: Table) -> None:
        """A result that is a table on a terminal."""
        self.result(data, "" if self.as_json or self.quiet else render(table))

    def message(self, text: str) -> None:
        """Something worth knowing, on stderr."""
        if self.quiet or self.as_json:
            return
        if self.live is not None:  # a line between the bars, which are drawn anew below it
            self.live.console.print(text, markup=False, highlight=False, soft_wrap=True)
        else:
            sys.stderr.write(text + "\n")

    def observer(self, *, bars: bool = True, keep_results: bool = False) -> CommandObserver:
        """The observer that shows this command's progress, with ``bars`` where stderr is a terminal."""
        shown = bars and not self.quiet and not self.as_json and sys.stderr.isatty()
        return CommandObserver(self, bars=shown, keep_results=keep_results)


class CommandObserver(Observer):
    """Collects what the stages report; draws a bar for each stage where stderr is a terminal."""

    def __init__(self, console: Console, *, bars: bool = False, keep_results: bool = False) -> None:
        super().__init__(console.token)
        self.console = console
        self.warnings: list[str] = []
        self.results: list[tuple[str, object]] = []
        self.keep_results = keep_results
        self._bars = StageBars() if bars else None

    def __enter__(self) -> CommandObserver:
        if self._bars:
            self._bars.progress.start()
            self.console.live = self._bars.progress
        return self

    def __exit__(self, *_: object) -> None:
        if self._bars:
            self._bars.progress.stop()
            self.console.live = None

    def stage_started(self, stage: str, total: int | None = None) -> None:
        if self._bars:
            self._bars.start(stage, total)

    def progress(self, stage: str, done: int) -> None:
        if self._bars:
            self._bars.advance(stage, done)

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        if self._bars:
            self._bars.finish(stage, seconds)
        if self.keep_results and result is not None:
            self.results.append((stage, result))

    def warning(self, text: str) -> None:
        if text not in self.warnings:
            self.warnings.append(text)
            self.console.message(f"Warning: {text}")


class StageBars:
    """One line a stage: name, bar, seconds."""

    def __init__(self) -> None:
        from rich.console import Console as RichConsole
        from rich.progress import BarColumn, Progress, TextColumn

        self.progress: Progress = Progress(
            TextColumn("{task.description:<11}"),
            BarColumn(bar_width=32),
            TextColumn("{task.fields[note]}"),
            console=RichConsole(stderr=True),
        )
        self._tasks: dict[str, TaskID] = {}
        self._seconds: dict[str, float] = {}  # a stage may take several steps

    def start(self, stage: str, total: int | None) -> None:
        """Begin (or begin again) the line of ``stage``."""
        if stage in self._tasks:
            self.progress.reset(self._tasks[stage], total=total, note="")
        else:
            self._tasks[stage] = self.progress.add_task(stage, total=total, note="")

    def advance(self, stage: str, done: int) -> None:
        """``done`` steps are finished."""
        if stage in self._tasks:
            self.progress.update(self._tasks[stage], completed=done)

    def finish(self, stage: str, seconds: float) -> None:
        """Fill the bar of ``stage`` and note the seconds of all its steps so far."""
        if stage not in self._tasks:
            self.start(stage, 1)
        self._seconds[stage] = seconds = self._seconds.get(stage, 0.0) + seconds
        self.progress.update(self._tasks[stage], total=1, completed=1, note=f"{seconds:6.2f} s")


def render(table: Table) -> str:
    """``table`` as text: as wide as the terminal, or unlimited where there is none."""
    from io import StringIO

    from rich.console import Console as RichConsole

    terminal = sys.stdout.isatty()
    buffer = StringIO()
    RichConsole(file=buffer, width=None if terminal else 200, force_terminal=terminal).print(table)
    return "\n".join(line.rstrip() for line in buffer.getvalue().splitlines())

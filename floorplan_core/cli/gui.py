"""``floorcast gui``: the desktop application."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from floorplan_core.cli.options import DebugFlag, named_path

APPLICATION = "floorcast_app"
QT = "PySide6"


def gui(
    survey: Annotated[
        Path | None, typer.Argument(metavar="[INPUT]", parser=named_path, help="Survey or project to open.")
    ] = None,
    script: Annotated[
        Path | None,
        typer.Option(
            "--script",
            metavar="FILE",
            parser=named_path,
            help="Run a script offscreen: Python that uses `app`, or a JSON list of actions.",
        ),
    ] = None,
    debug: DebugFlag = False,
) -> None:
    """Open the desktop application, or run a script of its actions without a display."""
    from importlib import import_module

    from floorplan_core.errors import UsageError

    if find_spec(APPLICATION) is None or find_spec(QT) is None:
        raise UsageError("The desktop application needs Qt, which is not installed; 'make setup' brings it.")
    raise typer.Exit(import_module(APPLICATION).run(survey, script))

"""``floorcast gui``: the desktop application, where it is installed."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from floorplan_core.cli.options import DebugFlag

APPLICATION = "floorcast_app"


def gui(
    survey: Annotated[Path | None, typer.Argument(metavar="[INPUT]", help="Survey or plan to open.")] = None,
    script: Annotated[
        Path | None, typer.Option("--script", metavar="FILE", help="Run a script offscreen.")
    ] = None,
    debug: DebugFlag = False,
) -> None:
    """Open the desktop application (not part of this version)."""
    from floorplan_core import __version__
    from floorplan_core.errors import UsageError

    if find_spec(APPLICATION) is None:
        raise UsageError(
            f"The desktop application is not part of Floorcast {__version__}; "
            "use 'floorcast plan' and open plan.svg in a browser."
        )
    from importlib import import_module

    raise typer.Exit(import_module(APPLICATION).run(survey, script))

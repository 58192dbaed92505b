"""``floorcast export``: a saved plan to any format that a plugin writes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from floorplan_core.cli.console import Console
from floorplan_core.cli.options import (
    DebugFlag,
    DrawingLanguage,
    DrawingTitle,
    DrawingUnits,
    JsonFlag,
    QuietFlag,
    named_path,
)


def export(
    context: typer.Context,
    plan: Annotated[
        Path,
        typer.Argument(
            metavar="PLAN",
            parser=named_path,
            help="A folder that `floorcast plan` wrote, or its plan.floorplan.",
        ),
    ],
    to: Annotated[
        list[Path],
        typer.Option(
            "--to",
            metavar="FILE",
            parser=named_path,
            help="A file to write; may be repeated.",
            show_default=False,
        ),
    ],
    format_: Annotated[
        str | None, typer.Option("--format", metavar="NAME", help="Exporter to use instead of the suffix's.")
    ] = None,
    units: DrawingUnits = "metric",
    language: DrawingLanguage = "en",
    title: DrawingTitle = "",
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """Write a saved plan to files; the format follows from the suffix, or from --format."""
    from floorplan_core.drawing_style import DrawingStyle
    from floorplan_core.plan_files import export as write
    from floorplan_core.plan_files import load_plan

    console = Console(context, as_json=as_json, quiet=quiet)
    write(load_plan(plan), *to, format=format_, style=DrawingStyle(units, language, title))
    console.result({"files": [str(p) for p in to]}, f"Wrote {', '.join(str(p) for p in to)}.")

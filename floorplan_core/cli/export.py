"""``floorcast export``: a saved plan to any format that a plugin writes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from floorplan_core.cli.console import Console
from floorplan_core.cli.options import (
    DebugFlag,
    DrawingLanguage,
    DrawingTitle,
    DrawingUnits,
    JsonFlag,
    QuietFlag,
)

if TYPE_CHECKING:
    from floorplan_core.model import FloorPlan


def export(
    context: typer.Context,
    plan: Annotated[
        Path,
        typer.Argument(metavar="PLAN", help="A folder that `floorcast plan` wrote, or its plan.floorplan."),
    ],
    to: Annotated[
        list[Path],
        typer.Option("--to", metavar="FILE", help="A file to write; may be repeated.", show_default=False),
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
    from floorplan_core.drawing_style import DrawingStyle, in_style
    from floorplan_core.files import output_file
    from floorplan_core.plugins import default_registry

    console = Console(context, as_json=as_json, quiet=quiet)
    style = DrawingStyle(units, language, title)
    exporters = [(path, in_style(default_registry().exporter(path, format_), style)) for path in to]
    saved = load_plan(plan)
    for path, exporter in exporters:
        with output_file(path) as temporary:
            exporter.write(saved, temporary)
    console.result({"files": [str(p) for p in to]}, f"Wrote {', '.join(str(p) for p in to)}.")


def load_plan(path: Path) -> FloorPlan:
    """The plan saved in ``path``, a file or a folder that holds one. Raises :class:`InputError`."""
    from floorplan_core import intermediates
    from floorplan_core.cli.plan_files import PLAN_FILE
    from floorplan_core.errors import InputError
    from floorplan_core.model import FloorPlan

    file = path / PLAN_FILE if path.is_dir() else path
    if path.is_dir() and not file.exists():
        raise InputError(
            f"The folder {path} holds no {PLAN_FILE}; 'floorcast plan INPUT --out {path}' makes one."
        )
    return intermediates.load(file, FloorPlan)

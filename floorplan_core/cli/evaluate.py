"""``floorcast evaluate``: a plan against a ground truth."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from floorplan_core.cli.console import Console
from floorplan_core.cli.options import DebugFlag, JsonFlag, QuietFlag, named_path


def evaluate(
    context: typer.Context,
    plan: Annotated[
        Path,
        typer.Argument(
            metavar="PLAN", parser=named_path, help="A plan.geojson, or the folder that holds one."
        ),
    ],
    truth: Annotated[
        Path,
        typer.Argument(
            metavar="TRUTH", parser=named_path, help="A truth.json, or an IFC model of the building."
        ),
    ],
    storey: Annotated[
        int, typer.Option("--storey", min=0, help="Storey of an IFC model, from the lowest, which is 0.")
    ] = 0,
    save_truth: Annotated[
        Path | None,
        typer.Option(
            "--save-truth", metavar="FILE", parser=named_path, help="Write the truth as truth.json, too."
        ),
    ] = None,
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """Compare a plan with a ground truth: dimensions, rooms, labels, doors, free space."""
    from rich.table import Table
    from rich.text import Text

    from floorplan_core.evaluation import compare, load_truth, read_plan
    from floorplan_core.evaluation.truth_file import write_truth

    console = Console(context, as_json=as_json, quiet=quiet)
    known = load_truth(truth, storey)
    report = compare(read_plan(plan), known)
    if save_truth is not None:
        write_truth(known, save_truth)
    table = Table(title=f"{plan} against {truth}", show_header=False)
    rows = report.rows()
    for index in range(max(map(len, rows), default=0)):
        table.add_column(justify="left" if index == 0 else "right")
    for row in rows:
        table.add_row(*(Text(str(cell)) for cell in row))
    console.table(report.as_dict(), table)

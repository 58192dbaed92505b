"""The table of commands; each lives in a module of its name and imports what is heavy when it runs."""

from __future__ import annotations

from typing import Annotated

import typer

from floorplan_core.cli import evaluate, export, gui, info, plan, plugins, settings, simulate, watch

app = typer.Typer(
    name="floorcast",
    help="Predictive, semantic floor plans from incomplete indoor 3D reconstructions.",
    epilog="Exit status: 0 done; 2 wrong use; 3 input not readable or output not writable; "
    "4 no plan can be made of it; 130 interrupted.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["--help", "-h"]},
)


def _show_version(value: bool) -> None:
    if value:
        from floorplan_core import __version__

        typer.echo(f"floorcast {__version__}")
        raise typer.Exit


@app.callback()
def floorcast(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version.", callback=_show_version, is_eager=True)
    ] = False,
) -> None:
    """Predictive, semantic floor plans from incomplete indoor 3D reconstructions."""


app.command()(plan.plan)
app.command()(watch.watch)
app.command()(info.info)
app.command()(evaluate.evaluate)
app.command()(export.export)
app.command()(simulate.simulate)
app.command()(settings.settings)
app.command()(plugins.plugins)
app.command()(gui.gui)

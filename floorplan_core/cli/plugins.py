"""``floorcast plugins``: what was found, what it brings, and what was switched off and why."""

from __future__ import annotations

import typer

from floorplan_core.cli.console import Console
from floorplan_core.cli.options import DebugFlag, JsonFlag, QuietFlag


def plugins(
    context: typer.Context, as_json: JsonFlag = False, quiet: QuietFlag = False, debug: DebugFlag = False
) -> None:
    """List the readers, exporters and region classifiers that plugins bring."""
    from rich.table import Table
    from rich.text import Text

    from floorplan_core.plugin_discovery import user_plugin_folder
    from floorplan_core.plugins import default_registry

    console = Console(context, as_json=as_json, quiet=quiet)
    registry, folder = default_registry(), user_plugin_folder()
    table = Table("plugin", "from", "brings", "state", title=f"Plugins (your own go into {folder})")
    for status in registry.statuses:
        state = "works" if status.enabled else f"switched off: {status.error}"
        brings = "\n".join(f"{n} – {a}" for n, a in zip(status.brings, status.about, strict=True))
        table.add_row(*map(Text, (status.name, status.origin, brings, state)))
    shown = ("name", "origin", "brings", "about", "enabled", "error")
    rows = [{name: getattr(status, name) for name in shown} for status in registry.statuses]
    console.table({"plugins": rows, "user_folder": str(folder)}, table)

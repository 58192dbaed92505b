"""``floorcast settings``: every number of the method with its bounds, unit and meaning."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from floorplan_core.cli.console import Console
from floorplan_core.cli.options import Assignments, ConfigFile, DebugFlag, JsonFlag, QuietFlag, resolve_config

if TYPE_CHECKING:
    from rich.table import Table

    from floorplan_core.settings_table import SettingRow


def settings(
    context: typer.Context,
    yaml: Annotated[bool, typer.Option("--yaml", help="As a YAML file for --config.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="As docs/settings.md.")] = False,
    config: ConfigFile = None,
    set_: Assignments = None,
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """List all settings, as a table, as YAML to edit, or as the page of the documentation."""
    from floorplan_core.errors import UsageError
    from floorplan_core.settings_table import markdown_page, setting_rows, yaml_text

    if yaml + markdown + as_json > 1:
        raise UsageError("--yaml, --markdown and --json exclude each other; give one of them.")
    console = Console(context, as_json=as_json, quiet=quiet)
    resolved = resolve_config(config, set_)
    if yaml or markdown:
        console.result({}, yaml_text(resolved) if yaml else markdown_page(resolved))
    else:
        console.table({"settings": resolved.model_dump(mode="json")}, _table(setting_rows(resolved)))


def _table(rows: list[SettingRow]) -> Table:
    from rich.table import Table
    from rich.text import Text

    table = Table("setting", "value", "unit", "bounds", "meaning", title="Settings")
    for row in rows:
        table.add_row(*map(Text, (row.name, row.value, row.unit, row.bounds, row.meaning)))
    return table

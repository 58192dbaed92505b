"""``python -m benchmarks.accuracy``: simulate (once), plan, evaluate, compare with the last result."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from rich.console import Console
from rich.table import Table

from benchmarks.accuracy import store, tables
from benchmarks.accuracy.cases import Case, chosen_cases
from benchmarks.accuracy.record import Record
from benchmarks.accuracy.runner import headline, picture, run_cases
from benchmarks.accuracy.surveys import cache_folder
from floorplan_core.config import Config
from floorplan_core.errors import FloorPlanError

WIDTH = 200  # columns, where the output is no terminal


def main(arguments: list[str] | None = None) -> int:
    """Exit status 0; 2 where no survey has the given name."""
    options = parse(arguments)
    console = Console(width=None if sys.stdout.isatty() else WIDTH)
    cases = chosen_cases(options.quick, options.only, options.fresh)
    if not cases:
        console.print(f"No survey's name holds {options.only!r}.")
        return 2
    config = Config() if options.config is None else Config.load(options.config)
    config = config.with_values(dict(item.split("=", 1) for item in options.set))
    records = run_cases(cases, config, lambda case, entry: tell(console, case, entry))
    last = store.load()
    show(console, records, last)
    full = not options.quick and options.only is None and not options.fresh
    draw(
        console, cases, records, store.PICTURES if full and not options.no_save else cache_folder() / "worst"
    )
    if full and not options.no_save:
        store.save(records)
        store.write_document(records, last)
        console.print(
            f"Kept in {store.RESULTS.relative_to(store.ROOT)} and {store.DOCUMENT.relative_to(store.ROOT)}."
        )
    return 0


def parse(arguments: list[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.accuracy", description=__doc__)
    parser.add_argument(
        "--quick", action="store_true", help="a few surveys, under 90 s; the result is not kept"
    )
    parser.add_argument(
        "--only", metavar="NAME", help="surveys whose name holds NAME; the result is not kept"
    )
    parser.add_argument(
        "--fresh",
        type=int,
        action="append",
        default=[],
        metavar="SEED",
        help="18 new surveys, seeds from SEED (3000, 4000 ...); may be repeated; the result is not kept",
    )
    parser.add_argument("--no-save", action="store_true", help="leave the last result as it is")
    parser.add_argument("--config", type=Path, metavar="YAML", help="settings other than the defaults")
    parser.add_argument("--set", action="append", default=[], metavar="STAGE.FIELD=VALUE", help="one setting")
    return parser.parse_args(arguments)


def tell(console: Console, case: Case, entry: Record) -> None:
    """One line a survey, as they come."""
    console.print(f"[dim]{entry['seconds']:6.2f} s[/]  {case.name:<42} {headline(entry)}", highlight=False)


def show(console: Console, records: list[Record], last: list[Record]) -> None:
    """All tables on the terminal."""
    console.print(rich_table("Surveys", tables.surveys(records)))
    if any(r["half"] != "shared" for r in records):
        console.print(rich_table("Totals (means of surveys)", tables.totals(records, last)))
        console.print(rich_table("Prediction by exploration", tables.exploration(records)))
        console.print(rich_table("Confidence of doors", tables.reliability(records)))
    worst = store.worst_records(records, 1)[0]
    console.print(f"Worst: [bold]{worst['name']}[/] ({worst['half']}): {headline(worst)}", highlight=False)


def rich_table(title: str, content: tables.Table) -> Table:
    """A rich table; misses in red."""
    header, rows = content
    table = Table(title=title, header_style="bold", title_justify="left")
    for i, name in enumerate(header):
        table.add_column(name, justify="left" if i == 0 else "right", no_wrap=i == 0)
    for row in rows:
        table.add_row(*(f"[red]{cell}[/]" if "✗" in cell or "worse" in cell else cell for cell in row))
    return table


def draw(console: Console, cases: list[Case], records: list[Record], folder: Path) -> None:
    """Pictures of the five worst."""
    folder.mkdir(parents=True, exist_ok=True)
    by_name = {case.name: case for case in cases}
    for rank, entry in enumerate(store.worst_records(records), start=1):
        picture(by_name[entry["name"]], entry, folder / store.picture_path(rank).name)
    console.print(f"Pictures of the worst in {folder}.")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except FloorPlanError as failure:
        Console(stderr=True).print(str(failure))
        sys.exit(failure.exit_status)

"""``python -m benchmarks.robustness``: which sensor, noise and clutter a plan stands, and which it does not.

Every sensor meets every noise and every clutter in the same few buildings, of which six rooms in ten are
entered; everything else is as in :mod:`benchmarks.accuracy`, whose functions simulate (once), plan and judge.
Rules were made on what these seeds showed; ``--seed`` makes others. Figures go to
``benchmarks/results/robustness.json`` and, as a table, to ``docs/robustness.md``; with ``--seed``, ``--only``
or ``--no-save`` they are only shown. A first run takes about five minutes of CPU, most of them to simulate; a
later one about two.
"""

from __future__ import annotations

import argparse
import sys
from itertools import product

from rich.console import Console

from benchmarks.accuracy import store, tables
from benchmarks.accuracy.__main__ import WIDTH, draw, rich_table, tell
from benchmarks.accuracy.cases import FURNITURE, Case
from benchmarks.accuracy.record import Record
from benchmarks.accuracy.runner import run_cases
from benchmarks.accuracy.store import ROOT
from benchmarks.accuracy.surveys import cache_folder
from floorplan_core.config import Config
from floorplan_core.errors import FloorPlanError
from floorplan_core.simulation import BuildingSpec, SurveySpec, sensor_preset

SENSORS = {
    "station": "scanner on a tripod",
    "camera": "RGB-D, handheld",
    "tilted": "spinning lidar, tilted",
    "planar": "planar laser",
}
CONDITION = ("sensor", "furniture", "noise")
NOISE = (0.005, 0.02, 0.05)  # m, standard deviation of a range
BUILDINGS = (("l", 10), ("flat", 7))  # style and number of rooms
EXPLORE = 0.6
FIRST_SEED = 20_000
MAX_POINTS = 400_000
RESULTS = ROOT / "benchmarks" / "results" / "robustness.json"
DOCUMENT = ROOT / "docs" / "robustness.md"
INTRODUCTION = f"""# Sensors, noise and clutter

Written by `python -m benchmarks.robustness`; do not edit. Each row is the mean of {len(BUILDINGS)} simulated
surveys: the same buildings, of which {EXPLORE:.0%} of the rooms were entered, in every row. What the columns
mean: [accuracy](accuracy.md). Noise is of each range, along its ray. These seeds were looked at for rules
([how](decisions/0023-door-evidence.md)) and are blind for them no more; `--seed` makes others. What comes out
wrong, and why: [limits](limits.md).
"""


def cases(first_seed: int = FIRST_SEED) -> list[Case]:
    """The surveys: each building in every condition."""
    conditions = product(SENSORS, FURNITURE, NOISE, range(len(BUILDINGS)))
    return [_case(*condition, first_seed) for condition in conditions]


def _case(sensor: str, furniture: str, noise: float, building: int, first_seed: int) -> Case:
    style, rooms = BUILDINGS[building]
    seed = first_seed + building
    spec = SurveySpec(
        building=BuildingSpec(style=style, rooms=rooms, furniture=furniture),
        sensor=sensor_preset(sensor, noise=noise),
        seed=seed,
        explore=EXPLORE,
        max_points=MAX_POINTS,
    )
    factors = {"sensor": sensor, "furniture": furniture, "noise": f"{100 * noise:.1f} cm", "style": style}
    name = f"{sensor}-{furniture}-{1000 * noise:.0f}mm-{style}-{seed}"
    return Case(name, "robustness", spec=spec, factors=tuple(factors.items()))


def conditions(records: list[Record]) -> tables.Table:
    """One row a condition: sensor, clutter, noise and the means of its surveys."""
    groups: dict[tuple[str, ...], list[Record]] = {}
    for entry in records:
        groups.setdefault(tuple(entry["factors"][name] for name in CONDITION), []).append(entry)
    return [*CONDITION, *tables.EFFECTS], [
        [*levels, *tables.effects(group)] for levels, group in groups.items()
    ]


def main(arguments: list[str] | None = None) -> int:
    """Exit status 0; 2 where no survey has the given name."""
    options = parse(arguments)
    console = Console(width=None if sys.stdout.isatty() else WIDTH)
    chosen = [case for case in cases(options.seed) if options.only in case.name]
    if not chosen:
        console.print(f"No survey's name holds {options.only!r}.")
        return 2
    records = run_cases(chosen, Config(), lambda case, entry: tell(console, case, entry))
    found = conditions(records)
    console.print(rich_table("Conditions", found))
    console.print(rich_table("What hurts", tables.factors(records)))
    draw(console, chosen, records, cache_folder() / "worst")
    if options.seed == FIRST_SEED and not options.only and not options.no_save:
        save(found, records)
        console.print(f"Kept in {RESULTS.relative_to(ROOT)} and {DOCUMENT.relative_to(ROOT)}.")
    return 0


def save(found: tables.Table, records: list[Record]) -> None:
    """Keep the records without their apertures, and write the document."""
    store.save([{k: v for k, v in entry.items() if k != "apertures"} for entry in records], RESULTS)
    sensors = "\n".join(f"- **{name}**: {what}" for name, what in SENSORS.items())
    what_hurts = tables.markdown(tables.factors(records))
    parts = [INTRODUCTION, sensors, "", tables.markdown(found), "\n## What hurts\n", what_hurts]
    DOCUMENT.write_text("\n".join(parts) + "\n", encoding="utf-8")


def parse(arguments: list[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.robustness", description=__doc__)
    parser.add_argument(
        "--seed", type=int, default=FIRST_SEED, help="of the first building; others are not kept"
    )
    parser.add_argument("--only", default="", metavar="NAME", help="surveys whose name holds NAME")
    parser.add_argument("--no-save", action="store_true", help="leave the last result as it is")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except FloorPlanError as failure:
        Console(stderr=True).print(str(failure))
        sys.exit(failure.exit_status)

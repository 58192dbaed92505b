"""Tables on the terminal, figures in files, and the figures of the run before beside the new ones."""

from __future__ import annotations

import json
import os
import platform
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

RESULTS = Path(__file__).parent / "results"


@dataclass(frozen=True)
class Outcome:
    """What a benchmark found: a table, and named figures that can be compared with the last run."""

    title: str
    header: Sequence[str] = ()
    rows: Sequence[Sequence[Any]] = ()
    figures: dict[str, float] = field(default_factory=dict)
    notes: Sequence[str] = ()
    skipped: str = ""  # why nothing was run


def best_seconds(
    work: Callable[[], Any], repeat: int = 3, clock: Callable[[], float] = time.perf_counter
) -> float:
    """Least wall time of ``repeat`` calls, after one that warms up."""
    work()
    times = []
    for _ in range(repeat):
        began = clock()
        work()
        times.append(clock() - began)
    return min(times)


def cpu_seconds(work: Callable[[], Any], repeat: int = 3) -> float:
    """The same in CPU time, for work in one thread: what else the machine does counts for less."""
    return best_seconds(work, repeat, time.process_time)


def report(name: str, outcome: Outcome) -> None:
    """Print the outcome beside the last one, and keep it."""
    print(f"\n{name}: {outcome.title}")
    if outcome.skipped:
        print(f"  skipped: {outcome.skipped}")
        return
    _print_table([outcome.header, *outcome.rows])
    path = RESULTS / f"{name}.json"
    before = json.loads(path.read_text(encoding="utf-8"))["figures"] if path.exists() else {}
    figures = [("figure", "now", "last run")]
    figures += [
        (k, f"{v:.4g}", f"{before[k]:.4g}" if k in before else "") for k, v in outcome.figures.items()
    ]
    print()
    _print_table(figures)
    for note in outcome.notes:
        print(f"  {note}")
    _keep(path, outcome)


def _print_table(rows: Sequence[Sequence[Any]]) -> None:
    """Columns aligned to the right, the first to the left."""
    text = [[str(cell) for cell in row] for row in rows if row]
    widths = [max(len(row[k]) for row in text) for k in range(len(text[0]))] if text else []
    for row in text:
        cells = [row[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(row[1:], widths[1:], strict=True))]
        print("  " + "  ".join(cells).rstrip())


def _keep(path: Path, outcome: Outcome) -> None:
    """Write the figures with what they were measured on."""
    machine = {"cpu": platform.machine(), "cores": os.cpu_count(), "python": platform.python_version()}
    data = {"title": outcome.title, "figures": outcome.figures, "machine": machine}
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps(data, indent=2) + "\n", encoding="utf-8")

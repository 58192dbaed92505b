"""The measure menu: rows of the ground-truth table, and the table as CSV."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from floorcast_app.actions.registry import Action, with_plan
from floorcast_app.selection import Item
from floorcast_app.state import Check
from floorplan_core.errors import UsageError
from floorplan_core.model import loa_band

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

Point = tuple[float, float]
ToPlan = Callable[[Point], Point]
HEADER = ("id", "note", "plan_m", "laser_m", "difference_m", "difference_percent", "loa")


@dataclass(frozen=True)
class CheckRow:
    """A row of the ground-truth table as it is shown."""

    id: str
    note: str
    plan: float  # metres between the two points
    measured: float | None  # metres by the laser meter
    difference: float | None  # metres, plan - measured
    percent: float | None  # of the measured length
    band: str  # level of accuracy that the difference meets; "" where nothing was measured


@dataclass(frozen=True)
class CheckMeans:
    """What the rows with a measured length say together."""

    count: int
    mean_error: float  # metres, mean of the absolute differences
    mean_percent: float
    band: str  # level of accuracy that 95 % of the differences meet


def check_row(check: Check, to_plan: ToPlan | None = None) -> CheckRow:
    """The figures of one check.

    :param to_plan: local to plan coordinates; without it lengths are those of the local frame, which are
        shorter where the survey's up axis is tilted.

    >>> row = check_row(Check("c1", (0.0, 0.0), (3.0, 4.0), 4.98))
    >>> row.plan, round(row.difference, 6), round(row.percent, 3), row.band
    (5.0, 0.02, 0.402, 'LOA20')
    """
    length = math.dist(*(to_plan(p) if to_plan else p for p in (check.start, check.end)))
    if check.measured is None:
        return CheckRow(check.id, check.note, length, None, None, None, "")
    difference = length - check.measured
    percent = 100 * difference / check.measured
    return CheckRow(check.id, check.note, length, check.measured, difference, percent, loa_band(difference))


def check_rows(checks: tuple[Check, ...], to_plan: ToPlan | None = None) -> tuple[CheckRow, ...]:
    """The table's rows."""
    return tuple(check_row(check, to_plan) for check in checks)


def check_means(rows: tuple[CheckRow, ...]) -> CheckMeans | None:
    """Means over the rows that were measured; None where none was."""
    errors = sorted(abs(r.difference) for r in rows if r.difference is not None)
    if not errors:
        return None
    shares = [abs(r.percent) for r in rows if r.percent is not None]
    nearly_all = errors[math.ceil(0.95 * len(errors)) - 1]
    return CheckMeans(len(errors), sum(errors) / len(errors), sum(shares) / len(shares), loa_band(nearly_all))


def table_csv(checks: tuple[Check, ...], to_plan: ToPlan | None = None) -> str:
    """The ground-truth table as CSV: one row for each check, and the means."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(HEADER)
    rows = check_rows(checks, to_plan)
    for r in rows:
        writer.writerow([r.id, r.note, *map(_number, (r.plan, r.measured, r.difference, r.percent)), r.band])
    means = check_means(rows)
    if means is not None:
        errors = (_number(means.mean_error), _number(means.mean_percent))
        writer.writerow(["mean", f"absolute, of {means.count}", "", "", *errors, means.band])
    return out.getvalue()


def add(workbench: Workbench, start: Point, end: Point, measured: float | None = None, note: str = "") -> str:
    """Add a distance between two points in plan coordinates; returns its id."""
    a, b = (workbench.to_local((float(x), float(y))) for x, y in (start, end))
    if math.dist(a, b) == 0:
        raise UsageError("The two points of a measurement are the same; give two different ones.")
    check = Check(_next_id(workbench.state.checks), a, b, _checked(measured), note)
    workbench.change(f"Measure {math.dist(start, end):.3f} m", checks=(*workbench.state.checks, check))
    workbench.selection.select(Item("check", check.id))
    return check.id


def set_measured(workbench: Workbench, id: str, metres: float | None = None, note: str | None = None) -> None:
    """What the laser meter said (None: nothing), and a note."""
    check = _find(workbench, id)
    made = replace(check, measured=_checked(metres), note=check.note if note is None else note)
    checks = tuple(made if c.id == id else c for c in workbench.state.checks)
    text = f"Set {id} to {metres:.3f} m" if metres is not None else f"Clear {id}"
    workbench.change(text if made.measured != check.measured else f"Note on {id}", checks=checks)


def remove(workbench: Workbench, id: str | None = None) -> None:
    """Take a row out: that of ``id``, or the selected ones."""
    chosen = [id] if id is not None else [i.id for i in workbench.selection.items if i.kind == "check"]
    if not chosen:
        raise UsageError("Select a measurement first; then it can be removed.")
    for name in chosen:
        _find(workbench, name)
    left = tuple(c for c in workbench.state.checks if c.id not in chosen)
    workbench.change(f"Remove {', '.join(chosen)}", checks=left)


def export(workbench: Workbench, path: Path | str | None = None) -> None:
    """Write the table to a CSV file."""
    from floorplan_core.files import write_text

    if path is None:
        path = workbench.ui.ask_save("Export the ground-truth table", "CSV (*.csv)", "ground-truth.csv")
    if path is None:
        return
    target = Path(path)
    to_plan = workbench.to_plan if workbench.plan is not None else None
    write_text(target, table_csv(workbench.state.checks, to_plan))
    workbench.ui.tell(f"Wrote {target.name}.")


def _next_id(checks: tuple[Check, ...]) -> str:
    """The first of c1, c2, … beyond all that are taken."""
    taken = [int(c.id[1:]) for c in checks if c.id[1:].isdigit()]
    return f"c{max(taken, default=0) + 1}"


def _find(workbench: Workbench, id: str) -> Check:
    found = next((c for c in workbench.state.checks if c.id == id), None)
    if found is None:
        known = ", ".join(c.id for c in workbench.state.checks) or "none"
        raise UsageError(f"There is no measurement {id!r}; the measurements are: {known}.")
    return found


def _checked(metres: float | None) -> float | None:
    """A length above zero."""
    if metres is None:
        return None
    if not (math.isfinite(float(metres)) and float(metres) > 0):
        raise UsageError(f"A measured length must be above 0 m, not {metres}.")
    return float(metres)


def _number(value: float | None) -> str:
    return "" if value is None else f"{value + 0.0:.4f}"


def _has_checks(workbench: Workbench) -> bool:
    return bool(workbench.state.checks)


ACTIONS: tuple[Action, ...] = (
    Action("measure.add", "Add a measurement…", add, "A distance between two points.", enabled=with_plan),
    Action(
        "measure.set",
        "Set a measured length…",
        set_measured,
        "What the laser meter said.",
        enabled=_has_checks,
    ),
    Action(
        "measure.remove",
        "Remove the measurement",
        remove,
        "Take the selected row out of the ground-truth table.",
        "",
        "trash-2",
        lambda w: any(i.kind == "check" for i in w.selection.items),
    ),
    Action(
        "measure.export",
        "Export the ground-truth table…",
        export,
        "Lengths, differences, percentages, means and accuracy bands as CSV.",
        "",
        "table",
        _has_checks,
    ),
)

"""``floorcast info``: what a file is, and what a plan of it would assume."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from floorplan_core.cli.console import CommandObserver, Console
from floorplan_core.cli.options import (
    Assignments,
    ConfigFile,
    DebugFlag,
    JsonFlag,
    QuietFlag,
    Resolution,
    SurveyArguments,
    TrajectoryFile,
    resolve_config,
)

if TYPE_CHECKING:
    from floorplan_core.config import Config
    from floorplan_core.survey_info import SurveyInfo

QUICK_POINTS = 1 << 22  # four million: some seconds of a lidar, a second of work
Rows = list[tuple[str, str]]


def info(
    context: typer.Context,
    survey: SurveyArguments,
    trajectory: TrajectoryFile = None,
    resolution: Resolution = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Look at the first four million points only.")
    ] = False,
    config: ConfigFile = None,
    set_: Assignments = None,
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """Say what a survey is: extent, unit, storeys, how Manhattan it is, and what a plan would assume."""
    from floorplan_core.readers.grid_map import is_grid_map

    console = Console(context, as_json=as_json, quiet=quiet)
    settings = resolve_config(config, set_)
    if len(survey) == 1 and is_grid_map(survey[0]):
        data, rows = describe_map(survey[0], resolution)
    else:
        with console.observer() as observer:
            found = describe_survey(survey, trajectory, settings, observer, QUICK_POINTS if quick else None)
        data = {"kind": "survey", **found.as_dict(), "warnings": observer.warnings}
        rows = survey_rows(found, survey)
    console.table(data, _table(data["name"], rows))


def describe_survey(
    survey: list[Path],
    trajectory: Path | None,
    config: Config,
    observer: CommandObserver,
    most_points: int | None,
) -> SurveyInfo:
    """Open and read a survey."""
    from floorplan_core.cli.planning import announce_compilation
    from floorplan_core.plugins import default_registry
    from floorplan_core.readers import open_survey

    opened = open_survey(survey, trajectory, config.input, observer, default_registry(), colours=False)
    announce_compilation(observer)
    from floorplan_core.survey_info import describe  # after opening: bad input is answered at once

    return describe(opened, config, observer, most_points)


def describe_map(path: Path, resolution: float | None) -> tuple[dict[str, Any], Rows]:
    """The facts of an occupancy grid map."""
    from floorplan_core.model import FREE, OCCUPIED
    from floorplan_core.readers.grid_map import read_grid_map

    made = read_grid_map(path, resolution)
    ny, nx = made.states.shape
    cell = made.resolution**2
    free, wall = (float((made.states == state).sum()) * cell for state in (FREE, OCCUPIED))
    data = {
        "kind": "grid map",
        "name": made.name,
        "cells": [nx, ny],
        "resolution_m": made.resolution,
        "extent": {"size": [nx * made.resolution, ny * made.resolution]},
        "free_m2": round(free, 2),
        "occupied_m2": round(wall, 2),
        "assumptions": list(made.assumptions),
    }
    rows = [
        ("what it is", "occupancy grid map"),
        ("cells", f"{nx} x {ny} of {made.resolution:g} m"),
        ("extent", f"{nx * made.resolution:.1f} x {ny * made.resolution:.1f} m"),
        ("free, occupied", f"{free:.1f} m2, {wall:.1f} m2"),
        ("assumed", "\n".join(made.assumptions) or "nothing"),
    ]
    return data, rows


def survey_rows(found: SurveyInfo, paths: list[Path]) -> Rows:
    """The lines of the table."""
    rows = [
        ("what it is", _kind(found, paths)),
        ("points", _points(found)),
        ("extent", "{:.1f} x {:.1f} m, {:.1f} m high".format(*found.size)),
        ("from, to", f"{_place(found.low)}, {_place(found.high)}"),
        ("unit, up", f"{found.unit}, {found.up}" + (", left-handed" if found.mirrored else "")),
        ("CRS", _crs_name(found.crs) if found.crs else "none"),
    ]
    if found.scans is not None:
        rows.append(("scans", f"{found.scans:,}"))
    rows.append(("trajectory", _path(found)))
    rows += [("topics", "\n".join(found.topics))] if found.topics else []
    rows += [("Manhattan", _manhattan(found)), ("storeys", _storeys(found))]
    return [*rows, ("assumed", "\n".join(found.assumptions) or "nothing")]


def _kind(found: SurveyInfo, paths: list[Path]) -> str:
    size = sum(path.stat().st_size for path in paths if path.is_file())
    return f"{found.format} survey" + (f", {_size(size)}" if size else "")


def _size(size: int) -> str:
    return f"{size / 1e6:,.1f} MB" if size >= 1e5 else f"{size / 1e3:,.1f} kB"


def _points(found: SurveyInfo) -> str:
    if found.whole:
        return f"{found.points:,}"
    total = f" of {found.points_in_file:,}" if found.points_in_file is not None else ""
    return f"the first {found.points:,}{total} were looked at (--quick)"


def _place(corner: Any) -> str:
    return "({:.2f}, {:.2f}, {:.2f})".format(*corner)


def _crs_name(crs: str) -> str:
    first = crs.split('"')
    return first[1] if len(first) > 1 else crs[:60]


def _path(found: SurveyInfo) -> str:
    if found.trajectory is None:
        return "none: where the points were seen from is not known"
    t = found.trajectory
    return f"{t['poses']:,} poses, {t['length_m']:.1f} m, {t['seconds']:.0f} s"


def _manhattan(found: SurveyInfo) -> str:
    if found.frame is None:
        return f"no: {found.no_frame}"
    from floorplan_core.stages.manhattan_frame import misfit

    facts = found.as_dict()["manhattan"]
    other = found.as_dict()["other_direction"]
    wing = (
        ""
        if other is None
        else (
            f"\n{other['share']:.1%} are long walls at other angles, most of them at "
            f"{abs(other['from_frame_deg']):.0f} degrees: where rooms follow them they are a wing, planned "
            "in a frame of its own, elsewhere they come out as steps"
        )
    )
    doubt = misfit(found.frame) if other is None else ()
    return (
        f"{facts['support']:.0%} of {facts['wall_area_m2']:.0f} m2 of wall within 5 degrees of the frame "
        f"(yaw {round(facts['yaw_deg'], 2) + 0.0:.2f}, tilt {facts['tilt_deg']:.2f} degrees){wing}"
        + "".join(f"\n{sentence}" for sentence in doubt)
    )


def _storeys(found: SurveyInfo) -> str:
    if found.planar:
        return "a planar scan has no heights"
    facts = found.as_dict()["storeys"]
    lines = [
        f"{s['storey']}: floor at {s['floor_m']:.2f} m, "
        + ("no ceiling seen" if s["ceiling_m"] is None else f"{s['ceiling_m'] - s['floor_m']:.2f} m high")
        + "".join(f", a part at {z:.2f} m" for z in s["half_levels_m"])
        for s in facts
    ]
    return "\n".join(lines) or "none found"


def _table(name: str, rows: Rows) -> Any:
    from rich.table import Table
    from rich.text import Text

    table = Table(title=name, show_header=False)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for name, value in rows:
        table.add_row(name, Text(value))
    return table

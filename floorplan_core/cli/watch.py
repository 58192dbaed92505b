"""``floorcast watch``: the online job, a run replayed with a plan every few seconds of run time."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated, Any

import typer

from floorplan_core.cli.console import CommandObserver, Console
from floorplan_core.cli.options import (
    Assignments,
    ConfigFile,
    DebugFlag,
    JsonFlag,
    OutFolder,
    QuietFlag,
    SurveyArgument,
    TrajectoryFile,
    resolve_config,
)

if TYPE_CHECKING:
    from floorplan_core.model import FloorPlan, Reconstruction
    from floorplan_core.pipeline import FloorPlanner
    from floorplan_core.replay import Interval

TIMELINE, FILM_STRIP = "timeline.json", "filmstrip.png"
SUFFIXES = (".geojson", ".svg", ".png")
MAX_FRAMES = 12  # of the film strip; a longer run shows every second, fourth, ... plan


def watch(
    context: typer.Context,
    survey: SurveyArgument,
    out: OutFolder,
    every: Annotated[
        float, typer.Option("--every", metavar="SECONDS", min=0.1, help="Run time between two plans.")
    ] = 20.0,
    trajectory: TrajectoryFile = None,
    config: ConfigFile = None,
    set_: Assignments = None,
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """Replay a run and write a numbered plan each interval, timeline.json and a film strip."""
    from floorplan_core.cli.plan import open_input
    from floorplan_core.errors import NoPlanError
    from floorplan_core.files import output_folder
    from floorplan_core.pipeline import FloorPlanner

    console = Console(context, as_json=as_json, quiet=quiet)
    settings = resolve_config(config, set_)
    with output_folder(out), console.observer() as observer:  # fails now, not after the first interval
        run = open_input(survey, trajectory, settings, observer)
        film = Film()
        timeline = replay(run, FloorPlanner(settings, observer), every, out, film, observer)
        plans = [entry for entry in timeline if entry["plan"]]
        if not plans:
            raise NoPlanError(_never(timeline, run))
        film.write(out / FILM_STRIP)
    data = {"out": str(out), "plans": len(plans), "intervals": len(timeline), "timeline": timeline}
    console.result(data, f"Wrote {len(plans)} plans, {TIMELINE} and {FILM_STRIP} into {out}.")


def replay(
    run: Reconstruction,
    planner: FloorPlanner,
    every: float,
    out: Path,
    film: Film,
    observer: CommandObserver,
) -> list[dict[str, Any]]:
    """Integrate and plan, interval by interval; each one's files and the timeline so far appear together."""
    from floorplan_core.replay import intervals

    timeline: list[dict[str, Any]] = []
    for interval in intervals(run, every):
        observer.check_cancelled()
        seconds, plan, note = _advance(planner, interval, run)
        entry = timeline_entry(interval, plan, seconds, note)
        timeline.append(entry)
        if plan is not None:
            entry["plan"] = f"plan-{len(timeline):04d}"
            film.add(plan, f"{interval.end:.0f} s, {interval.path_length:.0f} m")
        _write_interval(out, entry["plan"], plan, timeline)
        observer.console.message(_line(entry))
    return timeline


def _advance(
    planner: FloorPlanner, interval: Interval, run: Reconstruction
) -> tuple[tuple[float, float], FloorPlan | None, str]:
    """Integrate the interval and plan; returns the seconds of both, and the plan or why there is none yet."""
    from floorplan_core.errors import NoPlanError

    started = perf_counter()
    for chunk in interval.chunks:
        planner.integrate_chunk(chunk, run.trajectory)
    integrated = perf_counter()
    plan, note = None, ""
    try:
        plan = planner.plan()
    except NoPlanError as error:
        note = str(error)
    return (integrated - started, perf_counter() - integrated), plan, note


def timeline_entry(
    interval: Interval, plan: FloorPlan | None, seconds: tuple[float, float], note: str
) -> dict[str, Any]:
    """One row of ``timeline.json``; times in seconds, lengths in metres, areas in m2."""
    regions = plan.regions if plan else ()
    cell_area = plan.grid.cell**2 if plan else 0.0
    seen = sum(region.free_cells for region in regions) * cell_area
    return {
        "time_s": round(interval.end, 3),
        "path_length_m": round(interval.path_length, 3),
        "plan": None,
        "regions": len(regions),
        "names": [region.name for region in regions],
        "doors": len(plan.doors) if plan else 0,
        "seen_m2": round(seen, 3),
        "predicted_m2": round(sum(region.total_cells for region in regions) * cell_area - seen, 3),
        "integrate_s": round(seconds[0], 6),
        "plan_s": round(seconds[1], 6),
        "note": note,
    }


def _write_interval(
    out: Path, name: str | None, plan: FloorPlan | None, timeline: list[dict[str, Any]]
) -> None:
    from floorplan_core.files import output_folder, writing
    from floorplan_core.plugins import default_registry

    with output_folder(out) as staging, writing(out):
        if plan is not None:
            for suffix in SUFFIXES:
                default_registry().exporter(Path(f"plan{suffix}")).write(plan, staging / f"{name}{suffix}")
        (staging / TIMELINE).write_text(json.dumps(timeline, indent=1) + "\n", encoding="utf-8")


def _line(entry: dict[str, Any]) -> str:
    head = f"{entry['time_s']:8.1f} s {entry['path_length_m']:7.1f} m"
    if entry["note"]:
        return f"{head}  no plan yet: {entry['note']}"
    return (
        f"{head}  {entry['regions']:3d} regions {entry['doors']:3d} doors "
        f"{entry['seen_m2']:8.1f} m2 seen {entry['predicted_m2']:7.1f} m2 predicted "
        f"(integrated in {entry['integrate_s']:.2f} s, planned in {entry['plan_s']:.2f} s)"
    )


def _never(timeline: list[dict[str, Any]], run: Reconstruction) -> str:
    last = timeline[-1]["note"] if timeline else "it holds no points"
    return f"No interval of {run.name} gave a plan; at its end: {last}"


class Film:
    """The frames of the film strip: at most ``limit``, evenly spread over the run, always with the last."""

    def __init__(self, limit: int = MAX_FRAMES) -> None:
        self._limit, self._stride, self._count = limit, 1, 0
        self._kept: list[tuple[FloorPlan, str]] = []
        self._last: tuple[FloorPlan, str] | None = None

    def add(self, plan: FloorPlan, title: str) -> None:
        """Take the next plan; when there are too many, every second one is let go."""
        self._last = (plan, title)
        if self._count % self._stride == 0:
            self._kept.append(self._last)
        self._count += 1
        if len(self._kept) > self._limit:
            self._kept, self._stride = self._kept[::2], self._stride * 2

    def frames(self) -> list[tuple[FloorPlan, str]]:
        """The frames to show, in order."""
        if self._last is None or self._kept[-1] is self._last:
            return self._kept
        return [*self._kept[: self._limit - 1], self._last]

    def write(self, path: Path) -> None:
        """Write the strip as a PNG."""
        from floorplan_core.exporters.filmstrip import filmstrip_png
        from floorplan_core.files import output_file

        frames = self.frames()
        strip: Callable[..., None] = filmstrip_png
        with output_file(path) as temporary:
            strip([plan for plan, _ in frames], [title for _, title in frames], temporary)

"""``floorcast watch``: the online job: a run replayed or followed, a plan every few seconds of it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated, Any

import typer

from floorplan_core.cli.console import CommandObserver, Console
from floorplan_core.cli.options import (
    Assignments,
    ConfigFile,
    DebugFlag,
    DrawingLanguage,
    DrawingUnits,
    JsonFlag,
    OutFolder,
    QuietFlag,
    StoreyNumber,
    SurveyArguments,
    TrajectoryFile,
    resolve_config,
)

if TYPE_CHECKING:
    from floorplan_core.config import Config
    from floorplan_core.drawing_style import DrawingStyle
    from floorplan_core.drift.online import CorrectingPlanner
    from floorplan_core.model import FloorPlan, Reconstruction
    from floorplan_core.pipeline import FloorPlanner
    from floorplan_core.replay import Interval

    OnlinePlanner = FloorPlanner | CorrectingPlanner

TIMELINE, FILM_STRIP = "timeline.json", "filmstrip.png"
SUFFIXES = (".geojson", ".svg", ".png")
MAX_FRAMES = 12  # of the film strip; a longer run shows every second, fourth, ... plan


def watch(
    context: typer.Context,
    survey: SurveyArguments,
    out: OutFolder,
    every: Annotated[
        float, typer.Option("--every", metavar="SECONDS", min=0.1, help="Run time between two plans.")
    ] = 20.0,
    follow: Annotated[
        float | None,
        typer.Option(
            "--follow",
            metavar="SECONDS",
            min=1.0,
            help="Follow a folder of scans that still grows, until nothing new came for so long.",
        ),
    ] = None,
    trajectory: TrajectoryFile = None,
    storey: StoreyNumber = None,
    units: DrawingUnits = "metric",
    language: DrawingLanguage = "en",
    config: ConfigFile = None,
    set_: Assignments = None,
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """Replay or follow a run and write a numbered plan each interval, timeline.json and a film strip."""
    from floorplan_core.cli.planning import announce_compilation
    from floorplan_core.drawing_style import DrawingStyle
    from floorplan_core.errors import NoPlanError
    from floorplan_core.files import output_folder

    console = Console(context, as_json=as_json, quiet=quiet)
    settings, style = resolve_config(config, set_), DrawingStyle(units, language)
    observer = console.observer(bars=False)  # a line for each interval instead
    with output_folder(out):  # made now, and removed again if nothing comes of it
        run, intervals = open_run(survey, trajectory, every, follow, settings, observer)
        announce_compilation(observer)
        recorder = Recorder(out, observer, storey or 0, style)
        recorder.record(intervals, _planner(run, settings, observer))
        if not recorder.film.frames():
            raise NoPlanError(_never(recorder.timeline, run))
        recorder.film.write(out / FILM_STRIP)
    plans = sum(entry["plan"] is not None for entry in recorder.timeline)
    data = {"out": str(out), "plans": plans, "timeline": recorder.timeline, "warnings": observer.warnings}
    console.result(data, f"Wrote {plans} plans, {TIMELINE} and {FILM_STRIP} into {out}.")


def _planner(run: Reconstruction, config: Config, observer: CommandObserver) -> OnlinePlanner:
    """Imported after opening: bad input is answered at once."""
    if config.drift.correct:
        from floorplan_core.drift.online import CorrectingPlanner

        return CorrectingPlanner(config, observer, run.name, run.local_frame)
    from floorplan_core.pipeline import FloorPlanner

    return FloorPlanner(config, observer, run.name, run.local_frame)


def open_run(
    survey: list[Path],
    trajectory: Path | None,
    every: float,
    patience: float | None,
    config: Config,
    observer: CommandObserver,
) -> tuple[Reconstruction, Iterator[Interval]]:
    """The run and its intervals: replayed, or followed with so much ``patience`` (seconds)."""
    from floorplan_core.cli.planning import open_input
    from floorplan_core.replay import intervals

    if patience is None:
        run = open_input(survey, trajectory, config, observer)
        return run, intervals(run, every)
    from floorplan_core.errors import UsageError
    from floorplan_core.following import GrowingFolder, follow

    if len(survey) != 1:
        raise UsageError("--follow is for one folder of scans that grows.")
    observer.console.message(f"Following {survey[0]} until nothing new came for {patience:g} s.")
    growing = GrowingFolder(survey[0], trajectory, patience, observer)
    run, following = follow(growing, every, config.input, observer)
    for sentence in run.assumptions:
        observer.console.message(sentence)
    return run, following


class Recorder:
    """Writes what a run gives, interval by interval; its files and the timeline so far appear together."""

    def __init__(self, out: Path, observer: CommandObserver, storey: int, style: DrawingStyle) -> None:
        from floorplan_core.drawing_style import in_style
        from floorplan_core.plugins import default_registry

        self.timeline: list[dict[str, Any]] = []
        self.film = Film(style)
        self._out, self._observer, self._storey = out, observer, storey
        exporters = ((s, default_registry().exporter(Path(f"plan{s}"))) for s in SUFFIXES)
        self._exporters = {s: in_style(exporter, style) for s, exporter in exporters}

    def record(self, intervals: Iterator[Interval], planner: OnlinePlanner) -> None:
        """Integrate and plan until the run is over."""
        for interval in intervals:
            self._observer.check_cancelled()
            seconds, plan, note = _advance(planner, interval, self._storey)
            entry = timeline_entry(interval, plan, seconds, note) | _correction(planner)
            self.timeline.append(entry)
            if plan is not None:
                entry["plan"] = f"plan-{len(self.timeline):04d}"
                self.film.add(plan, f"{interval.end:.0f} s, {interval.path_length:.0f} m")
            self._write(entry["plan"], plan)
            self._observer.console.message(_line(entry))

    def _write(self, name: str | None, plan: FloorPlan | None) -> None:
        from floorplan_core.files import output_folder, writing

        with output_folder(self._out) as staging, writing(self._out):
            if plan is not None:
                for suffix in list(self._exporters):
                    self._export(plan, suffix, staging / f"{name}{suffix}")
            (staging / TIMELINE).write_text(json.dumps(self.timeline, indent=1) + "\n", encoding="utf-8")

    def _export(self, plan: FloorPlan, suffix: str, path: Path) -> None:
        """Write one file; where its plugin fails, the run goes on without this kind of file."""
        from floorplan_core.plugin_guard import PluginFailed

        try:
            self._exporters[suffix].write(plan, path)
        except PluginFailed as error:
            del self._exporters[suffix]
            path.unlink(missing_ok=True)
            self._observer.warning(str(error))


def _advance(
    planner: OnlinePlanner, interval: Interval, storey: int
) -> tuple[tuple[float, float], FloorPlan | None, str]:
    """Integrate the interval and plan; returns the seconds of both, and the plan or why there is none yet."""
    from floorplan_core.errors import NoPlanError

    started = perf_counter()
    for chunk in interval.chunks:
        planner.integrate_chunk(chunk, interval.trajectory)
    integrated = perf_counter()
    plan, note = None, ""
    try:
        if storey < len(planner.storeys()):
            plan = planner.plan(storey=storey)
        else:
            note = f"Storey {storey} was not reached yet."
    except NoPlanError as error:
        note = str(error)
    return (integrated - started, perf_counter() - integrated), plan, note


def _correction(planner: OnlinePlanner) -> dict[str, Any]:
    """What a robot needs to place itself in the plan, where the path is corrected."""
    from floorplan_core.pipeline import FloorPlanner

    return (
        {}
        if isinstance(planner, FloorPlanner)
        else {"map_from_odom": planner.map_from_odom.round(9).tolist()}
    )


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

    def __init__(self, style: DrawingStyle, limit: int = MAX_FRAMES) -> None:
        self._style = style
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
            strip([plan for plan, _ in frames], [title for _, title in frames], temporary, self._style)

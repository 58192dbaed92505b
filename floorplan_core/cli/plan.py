"""``floorcast plan``: the main job, a reconstruction in, a floor plan out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated

import typer

from floorplan_core.cli.console import CommandObserver, Console
from floorplan_core.cli.options import (
    Assignments,
    ConfigFile,
    DebugFlag,
    JsonFlag,
    OutFolder,
    QuietFlag,
    Resolution,
    SurveyArgument,
    TrajectoryFile,
    resolve_config,
)

if TYPE_CHECKING:
    from floorplan_core.config import Config
    from floorplan_core.model import FloorPlan, Reconstruction

PLAN_FILE = "plan.floorplan"
DRAWINGS = ("plan.geojson", "plan.svg")
PICTURES = ("planes.png", "occupancy.png", "plan.png")
LABEL_IMAGE = "labels.png"


def plan(
    context: typer.Context,
    survey: SurveyArgument,
    out: OutFolder,
    trajectory: TrajectoryFile = None,
    resolution: Resolution = None,
    pictures: Annotated[bool, typer.Option(help="Write the paper's three figures as PNG too.")] = True,
    labels_png: Annotated[
        bool, typer.Option("--labels-png", help="Write the regions as a label image, labels.png, too.")
    ] = False,
    save_stages: Annotated[
        bool, typer.Option("--save-stages", help="Keep what every stage made, in DIR/stages.")
    ] = False,
    from_stage: Annotated[
        str | None,
        typer.Option("--from", metavar="STAGE", help="INPUT is a DIR with stages: begin again at this one."),
    ] = None,
    config: ConfigFile = None,
    set_: Assignments = None,
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """Make a floor plan of a survey: plan.geojson, plan.svg, report.json and pictures."""
    from floorplan_core.files import output_folder

    started = perf_counter()
    console = Console(context, as_json=as_json, quiet=quiet)
    stages = _stages_of(survey) if from_stage else None
    settings = resolve_config(config, set_, stages)
    with output_folder(out) as staging, console.observer(keep_results=save_stages) as observer:
        if from_stage and stages:
            made, clock = replan(stages, from_stage, settings, observer)
        else:
            made, clock = make_any_plan(survey, trajectory, resolution, settings, observer)
        names = DRAWINGS + (PICTURES if pictures else ()) + ((LABEL_IMAGE,) if labels_png else ())
        clock["export"] = write_plan(made, staging, names, observer)
        if save_stages:
            _save_stages(made, observer, staging)
        clock["total"] = perf_counter() - started
        report = _write_report(made, clock, observer, staging)
        files = sorted(str(p.relative_to(staging)) for p in staging.rglob("*") if p.is_file())
    counts = {k: report[k] for k in ("regions", "doors", "planes", "points")}
    data = {
        "out": str(out),
        "files": files,
        **counts,
        "seconds": clock["total"],
        "warnings": report["warnings"],
    }
    console.result(data, summary(made, clock["total"], out, files))


def make_any_plan(
    survey: Path, trajectory: Path | None, resolution: float | None, config: Config, observer: CommandObserver
) -> tuple[FloorPlan, dict[str, float]]:
    """The plan of an occupancy grid map or of a reconstruction, by what ``survey`` is."""
    from floorplan_core.errors import UsageError
    from floorplan_core.readers.grid_map import is_grid_map

    if is_grid_map(survey):
        if trajectory is not None or observer.keep_results:
            raise UsageError(f"{survey.name} is a grid map: --trajectory and --save-stages are for surveys.")
        return make_map_plan(survey, resolution, config, observer)
    if resolution is not None:
        raise UsageError(f"--resolution is for pictures of grid maps; {survey.name} is none.")
    return make_plan(survey, trajectory, config, observer)


def make_map_plan(
    path: Path, resolution: float | None, config: Config, observer: CommandObserver
) -> tuple[FloorPlan, dict[str, float]]:
    """Read an occupancy grid map and run its pipeline; returns the plan and the seconds spent in reading."""
    from floorplan_core.readers.grid_map import read_grid_map

    started = perf_counter()
    grid_map = read_grid_map(path, resolution)
    clock = {"read": perf_counter() - started}
    for sentence in grid_map.assumptions:
        observer.console.message(sentence)
    announce_compilation(observer)
    from floorplan_core.grid_pipeline import plan_grid_map  # after reading: bad input is answered at once

    return plan_grid_map(grid_map, config, observer), clock


def make_plan(
    survey: Path, trajectory: Path | None, config: Config, observer: CommandObserver
) -> tuple[FloorPlan, dict[str, float]]:
    """Read ``survey`` and run the pipeline; returns the plan and the seconds spent in reading."""
    started = perf_counter()
    reconstruction = open_input(survey, trajectory, config, observer)
    clock = {"read": perf_counter() - started}
    announce_compilation(observer)
    from floorplan_core.pipeline import process  # after opening: bad input is answered at once

    return process(timed_chunks(reconstruction, clock), config, observer), clock


def announce_compilation(observer: CommandObserver) -> None:
    """Say why the first run takes longer: no kernels of this version are compiled yet."""
    from floorplan_core.kernel_cache import kernels_compiled, use_kernel_cache

    use_kernel_cache()
    if not kernels_compiled():
        observer.console.message("The first run compiles the kernels, which takes about a minute.")


def replan(
    stages: Path, from_stage: str, config: Config, observer: CommandObserver
) -> tuple[FloorPlan, dict[str, float]]:
    """Begin again at a stage; returns the plan and the seconds spent in reading what came before."""
    from floorplan_core.restart import restart

    started = perf_counter()
    plan = restart(stages, from_stage, config, observer)
    return plan, {"read": perf_counter() - started - sum(plan.seconds.values())}


def _stages_of(survey: Path) -> Path:
    """The folder of stages in (or at) ``survey``."""
    from floorplan_core.restart import STAGE_FOLDER

    inside = survey / STAGE_FOLDER
    return inside if inside.is_dir() else survey


def open_input(
    survey: Path, trajectory: Path | None, config: Config, observer: CommandObserver
) -> Reconstruction:
    """Open ``survey`` with the readers of all plugins; what had to be guessed is shown."""
    from floorplan_core.plugins import default_registry
    from floorplan_core.readers import open_survey

    registry = default_registry()
    opened = open_survey(survey, trajectory, config.input, observer, registry)
    for sentence in opened.assumptions:
        observer.console.message(sentence)
    return opened


def timed_chunks(reconstruction: Reconstruction, clock: dict[str, float]) -> Reconstruction:
    """The same survey; the seconds that its reader takes for its chunks are added to ``clock["read"]``."""
    from collections.abc import Iterator

    from floorplan_core.model import PointChunk

    def chunks() -> Iterator[PointChunk]:
        source = reconstruction.chunks()
        while True:
            started = perf_counter()
            chunk = next(source, None)
            clock["read"] += perf_counter() - started
            if chunk is None:
                return
            yield chunk

    return replace(reconstruction, chunks=chunks)


def write_plan(plan: FloorPlan, folder: Path, names: tuple[str, ...], observer: CommandObserver) -> float:
    """Write ``plan`` losslessly and with the exporter for each of ``names``; returns the seconds it took."""
    from floorplan_core import intermediates
    from floorplan_core.files import writing

    started = perf_counter()
    observer.stage_started("export", len(names) + 1)
    with writing(folder.parent / PLAN_FILE):
        intermediates.save(plan, folder / PLAN_FILE)
    for done, name in enumerate(names, start=1):
        observer.check_cancelled()
        observer.progress("export", done)
        _export(plan, folder / name, observer)
    seconds = perf_counter() - started
    observer.stage_finished("export", seconds)
    return seconds


def _export(plan: FloorPlan, path: Path, observer: CommandObserver) -> None:
    """Write one file; a picture whose plugin fails is left out with a warning, the drawings are a must."""
    from floorplan_core.files import writing
    from floorplan_core.plugin_guard import PluginFailed
    from floorplan_core.plugins import default_registry

    try:
        with writing(path.parent.parent / path.name):
            default_registry().exporter(Path(path.name)).write(plan, path)
    except PluginFailed as error:
        if path.name in DRAWINGS:
            raise
        path.unlink(missing_ok=True)
        observer.warning(str(error))


def _save_stages(plan: FloorPlan, observer: CommandObserver, staging: Path) -> None:
    from floorplan_core.files import writing
    from floorplan_core.restart import STAGE_FOLDER, save_stages

    with writing(staging.parent / STAGE_FOLDER):
        save_stages(observer.results, plan, staging / STAGE_FOLDER)


def _write_report(
    plan: FloorPlan, clock: dict[str, float], observer: CommandObserver, folder: Path
) -> dict[str, object]:
    from floorplan_core.files import writing
    from floorplan_core.plugins import default_registry
    from floorplan_core.report import as_json, run_report

    failed = default_registry().failures()
    for sentence in failed:
        observer.warning(sentence)
    report = run_report(plan, clock, [*observer.warnings, *failed])
    with writing(folder.parent / "report.json"):
        (folder / "report.json").write_text(as_json(report), encoding="utf-8")
    return report


def summary(plan: FloorPlan, seconds: float, out: Path, files: list[str]) -> str:
    """What was made, in two sentences and a list of files."""
    labels = [region.label for region in plan.regions]
    kinds = ", ".join(
        f"{labels.count(label)} {label}{'s' * (labels.count(label) != 1)}" for label in sorted(set(labels))
    )
    area = sum(region.area for region in plan.regions)
    doors = f"{len(plan.doors)} door{'s' * (len(plan.doors) != 1)}"
    head = f"{plan.source}: {kinds or 'no regions'}, {doors}, {area:.1f} m2, in {seconds:.1f} s."
    return "\n".join([head, f"Wrote into {out}: {', '.join(files)}."])

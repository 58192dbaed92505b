"""``floorcast plan``: the main job, a reconstruction in, a floor plan out, or one for each storey.

The files of the lowest storey (or of the one that ``--storey`` names) lie in the output folder itself. Where
there are several, every storey also has a folder of its own, ``storey-0`` for the lowest.
"""

from __future__ import annotations

from dataclasses import dataclass
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
    DrawingTitle,
    DrawingUnits,
    JsonFlag,
    OutFolder,
    QuietFlag,
    Resolution,
    StoreyNumber,
    SurveyArguments,
    TrajectoryFile,
    resolve_config,
)
from floorplan_core.cli.plan_files import (
    DRAWINGS,
    LABEL_IMAGES,
    PICTURES,
    STOREY_FOLDER,
    save_run,
    write_plan,
    write_report,
)
from floorplan_core.cli.planning import make_any_plans, replan, stages_of
from floorplan_core.kernel_times import kernel_seconds

if TYPE_CHECKING:
    from floorplan_core.drawing_style import DrawingStyle
    from floorplan_core.model import FloorPlan


def plan(
    context: typer.Context,
    survey: SurveyArguments,
    out: OutFolder,
    trajectory: TrajectoryFile = None,
    resolution: Resolution = None,
    storey: StoreyNumber = None,
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
    units: DrawingUnits = "metric",
    language: DrawingLanguage = "en",
    title: DrawingTitle = "",
    config: ConfigFile = None,
    set_: Assignments = None,
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """Make a floor plan of a survey: plan.geojson, plan.svg, report.json and pictures."""
    from floorplan_core.drawing_style import DrawingStyle
    from floorplan_core.files import output_folder

    started = perf_counter()
    console = Console(context, as_json=as_json, quiet=quiet)
    stages = stages_of(_only(survey)) if from_stage else None
    settings, style = resolve_config(config, set_, stages), DrawingStyle(units, language, title)
    names = DRAWINGS + (PICTURES if pictures else ()) + (LABEL_IMAGES if labels_png else ())
    with output_folder(out) as staging, console.observer(keep_results=save_stages) as observer:
        if from_stage and stages:
            plans = iter([replan(stages, from_stage, settings, observer)])
        else:
            plans = make_any_plans(survey, trajectory, resolution, storey, settings, observer)
        writer = Writer(staging, names, save_stages, observer, started, style)
        for made, clock in plans:
            writer.write(made, clock)
        writer.lift_first()
        files = sorted(str(p.relative_to(staging)) for p in staging.rglob("*") if p.is_file())
    seconds = perf_counter() - started
    console.result(
        writer.summary(out, files, seconds), summary([d.plan for d in writer.done], seconds, out, files)
    )


@dataclass(frozen=True)
class Written:
    """One plan, and the report of its run."""

    plan: FloorPlan
    report: dict[str, Any]


class Writer:
    """Writes plan after plan, each into the folder of its storey."""

    def __init__(
        self,
        staging: Path,
        names: tuple[str, ...],
        stages: bool,
        observer: CommandObserver,
        started: float,
        style: DrawingStyle,
    ) -> None:
        self.done: list[Written] = []
        self._staging, self._names, self._stages = staging, names, stages
        self._observer, self._started, self._style = observer, started, style

    def write(self, plan: FloorPlan, clock: dict[str, float]) -> None:
        """Write one plan with its report."""
        folder = self._folder(plan)
        folder.mkdir()
        times = {**clock, "export": write_plan(plan, folder, self._names, self._observer, self._style)}
        if self._stages:
            save_run(plan, self._observer, folder)
        self._observer.results.clear()  # what the next storey makes is its own
        times["kernels"] = kernel_seconds()
        times["total"] = perf_counter() - self._started
        self.done.append(Written(plan, write_report(plan, times, self._observer, folder)))

    def lift_first(self) -> None:
        """Put the files of the first plan where everybody looks; the only plan needs no folder of its own."""
        import shutil

        first = self._folder(self.done[0].plan)
        shutil.copytree(first, self._staging, dirs_exist_ok=True)
        if len(self.done) == 1:
            shutil.rmtree(first)

    def summary(self, out: Path, files: list[str], seconds: float) -> dict[str, Any]:
        """The result for ``--json``: that of the first plan, and what each storey holds."""
        first = self.done[0].report
        counts = ("regions", "doors", "planes", "points")
        storeys = [{"storey": d.plan.storey, **{k: d.report[k] for k in counts}} for d in self.done]
        warnings = list(dict.fromkeys(w for d in self.done for w in d.report["warnings"]))
        return {
            "out": str(out),
            "files": files,
            **{k: first[k] for k in counts},
            "storeys": storeys,
            "seconds": seconds,
            "warnings": warnings,
        }

    def _folder(self, plan: FloorPlan) -> Path:
        return self._staging / STOREY_FOLDER.format(plan.storey)


def _only(surveys: list[Path]) -> Path:
    from floorplan_core.errors import UsageError

    if len(surveys) != 1:
        raise UsageError(f"--from takes the folder of one run (given {len(surveys)} inputs).")
    return surveys[0]


def summary(plans: list[FloorPlan], seconds: float, out: Path, files: list[str]) -> str:
    """What was made: a line for each storey, and a list of files."""
    lines = [_contents(plan) for plan in plans]
    if len(plans) > 1:
        lines = [f"Storey {plan.storey}: {line}" for plan, line in zip(plans, lines, strict=True)]
        lines.insert(0, f"{plans[0].source}: {len(plans)} storeys, in {seconds:.1f} s.")
    else:
        lines = [f"{plans[0].source}: {lines[0]}, in {seconds:.1f} s."]
    return "\n".join([*lines, f"Wrote into {out}: {', '.join(files)}."])


def _contents(plan: FloorPlan) -> str:
    labels = [region.label for region in plan.regions]
    kinds = ", ".join(
        f"{labels.count(label)} {label}{'s' * (labels.count(label) != 1)}" for label in sorted(set(labels))
    )
    area = sum(region.area for region in plan.regions)
    doors = f"{len(plan.doors)} door{'s' * (len(plan.doors) != 1)}"
    return f"{kinds or 'no regions'}, {doors}, {area:.1f} m2"

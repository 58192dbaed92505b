"""The files of a plan: drawings, pictures, the plan without loss, stages, and the report of the run."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from floorplan_core.cli.console import CommandObserver
from floorplan_core.plan_files import PLAN_FILE

if TYPE_CHECKING:
    from floorplan_core.drawing_style import DrawingStyle
    from floorplan_core.model import FloorPlan

DRAWINGS = ("plan.geojson", "plan.svg")
PICTURES = ("planes.png", "occupancy.png", "plan.png")
LABEL_IMAGES = ("labels.png", "labels.predicted.png")
STOREY_FOLDER = "storey-{}"


def write_plan(
    plan: FloorPlan, folder: Path, names: tuple[str, ...], observer: CommandObserver, style: DrawingStyle
) -> float:
    """Write ``plan`` losslessly and with the exporter for each of ``names``; returns the seconds it took."""
    from floorplan_core import intermediates
    from floorplan_core.files import writing

    started = perf_counter()
    observer.stage_started("export", len(names) + 1)
    with writing(folder.parent / PLAN_FILE):
        intermediates.save(replace(plan, seconds={}), folder / PLAN_FILE)  # the same run, the same bytes
    for done, name in enumerate(names, start=1):
        observer.check_cancelled()
        observer.progress("export", done)
        _export(plan, folder / name, observer, style)
    seconds = perf_counter() - started
    observer.stage_finished("export", seconds)
    return seconds


def _export(plan: FloorPlan, path: Path, observer: CommandObserver, style: DrawingStyle) -> None:
    """Write one file; a picture whose plugin fails is left out with a warning, the drawings are a must."""
    from floorplan_core.drawing_style import in_style
    from floorplan_core.files import writing
    from floorplan_core.plugin_guard import PluginFailed
    from floorplan_core.plugins import default_registry

    try:
        with writing(path.parent.parent / path.name):
            in_style(default_registry().exporter(Path(path.name)), style).write(plan, path)
    except PluginFailed as error:
        if path.name in DRAWINGS:
            raise
        path.unlink(missing_ok=True)
        observer.warning(str(error))


def save_run(plan: FloorPlan, observer: CommandObserver, staging: Path) -> None:
    from floorplan_core.files import writing
    from floorplan_core.restart import STAGE_FOLDER, save_stages

    with writing(staging.parent / STAGE_FOLDER):
        save_stages(observer.results, plan, staging / STAGE_FOLDER)


def write_report(
    plan: FloorPlan, clock: dict[str, float], observer: CommandObserver, folder: Path
) -> dict[str, Any]:
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

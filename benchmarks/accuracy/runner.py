"""Run the pipeline on one survey after the other and evaluate each plan."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from benchmarks.accuracy.cases import Case
from benchmarks.accuracy.overlay import draw_overlay
from benchmarks.accuracy.paper_labels import mislabelled, on_true_outlines
from benchmarks.accuracy.record import Record, record
from benchmarks.accuracy.reliability import Keeper, judge
from benchmarks.accuracy.surveys import cache_folder, cloud, survey_folder
from floorplan_core.config import Config
from floorplan_core.errors import Cancelled, FloorPlanError
from floorplan_core.evaluation import compare, load_truth, read_plan
from floorplan_core.evaluation.plan_file import PlanFile
from floorplan_core.evaluation.truth import Truth
from floorplan_core.model import FloorPlan
from floorplan_core.observer import Observer

OTHER_CLASSIFIER = "shape"  # compared with the paper's, which is the default


def run_cases(cases: list[Case], config: Config, report: Callable[[Case, Record], None]) -> list[Record]:
    """One record a case, in order; ``report`` hears of each."""
    records = []
    for case in cases:
        entry = run_case(case, config)
        report(case, entry)
        records.append(entry)
    return records


def run_case(case: Case, config: Config) -> Record:
    """Simulate (or find) the survey, plan it, compare. No plan scores zero and keeps its reason."""
    keeper = Keeper()
    folder = survey_folder(case, keeper)
    truth = load_truth(folder)
    started, error, made = time.perf_counter(), "", None
    try:
        made = make_plan(cloud(folder), plan_folder(case), config, keeper)
    except Cancelled:
        raise
    except FloorPlanError as failure:
        error = str(failure)
    except Exception as failure:  # noqa: BLE001  a bug costs this survey, not the whole run; it is printed and kept
        error = f"{type(failure).__name__}: {failure}"
    seconds = time.perf_counter() - started
    head = {
        "name": case.name,
        "half": case.half,
        "factors": dict(case.factors),
        "error": error,
        "seconds": seconds,
    }
    if made is None:
        return {**head, **record(compare(nothing(), truth)), "apertures": []}
    plan, file = made
    other = relabelled(file, other_labels(plan, config))
    judged = judge(keeper.apertures(config.doors), plan, truth)
    report = compare(file, truth)
    return {
        **head,
        **record(report, compare(other, truth)),
        "labels_outlines": on_true_outlines(truth, config.labels),
        "mislabelled": mislabelled(report, truth, config.labels),
        "apertures": judged,
    }


def make_plan(points: Path, out: Path, config: Config, observer: Observer) -> tuple[FloorPlan, PlanFile]:
    """The main job, down to the file that others read."""
    from floorplan_core import open_survey, process
    from floorplan_core.exporters.geojson import GeoJsonExporter

    out.mkdir(parents=True, exist_ok=True)
    file = out / "plan.geojson"
    file.unlink(missing_ok=True)
    plan = process(open_survey(points), config, observer)
    GeoJsonExporter().write(plan, file)
    return plan, read_plan(file)


def other_labels(plan: FloorPlan, config: Config) -> dict[str, str]:
    """Each region's label by the other classifier."""
    from floorplan_core.plugins import default_registry

    other = default_registry().classifier(OTHER_CLASSIFIER)
    return {r.id: other.classify(r, plan.regions, config) for r in plan.regions}


def relabelled(plan: PlanFile, labels: dict[str, str]) -> PlanFile:
    """The plan with other labels; regions that ``labels`` does not name keep theirs."""
    return replace(plan, regions=tuple(replace(r, label=labels.get(r.id, r.label)) for r in plan.regions))


def nothing() -> PlanFile:
    """The plan of a survey that gave none."""
    import shapely

    return PlanFile("no plan", (), (), shapely.MultiPolygon(), None, None)


def plan_folder(case: Case) -> Path:
    """Where the plan of the last run lies."""
    return cache_folder() / "plans" / case.name


def picture(case: Case, entry: Record, path: Path) -> None:
    """The last plan of ``case`` with its truth on top."""
    folder = survey_folder(case, Observer())
    truth: Truth = load_truth(folder)
    file = plan_folder(case) / "plan.geojson"
    plan = read_plan(file) if file.is_file() else nothing()
    remark = "   ".join(f"{key} {value}" for key, value in case.factors) or "shared survey"
    draw_overlay(plan, truth, f"{case.name} ({case.half})", f"{remark}   {headline(entry)}", path)


def headline(entry: Record) -> str:
    """The record in a few words."""
    if entry["error"]:
        return entry["error"]
    words = []
    for key, title, digits in (
        ("dimension_m", "dimensions", 3),
        ("f1_entered", "F1", 2),
        ("iou_entered", "IoU", 3),
        ("door_precision", "doors P", 2),
        ("door_recall", "R", 2),
        ("free_precision", "free P", 3),
        ("free_recall", "R", 3),
    ):
        if entry.get(key) is not None:
            words.append(f"{title} {entry[key]:.{digits}f}")
    return " · ".join(words)

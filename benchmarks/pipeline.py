"""The whole job on a real-sized survey, stage by stage, beside Open3D's time to read the file."""

from __future__ import annotations

import resource
import time
from pathlib import Path

from benchmarks.record import Outcome, best_seconds
from floorplan_core.model import FloorPlan

SURVEY = Path(__file__).resolve().parents[1].parent / "shared" / "data" / "sim_aws_hospital" / "points.ply"
TARGET = 5.0  # times the read
RUNS = 3  # of which the fastest counts, for the read and for the job alike


def _job() -> tuple[float, float, FloorPlan]:
    """Seconds from the file to the texts of its SVG and GeoJSON, those of the texts alone, and the plan."""
    from floorplan_core import open_survey, process
    from floorplan_core.exporters.geojson import geojson_text
    from floorplan_core.exporters.svg import svg_text

    began = time.perf_counter()
    plan = process(open_survey(SURVEY))
    planned = time.perf_counter()
    geojson_text(plan)
    svg_text(plan)
    ended = time.perf_counter()
    return ended - began, ended - planned, plan


def stages() -> Outcome:
    """Seconds of every stage, warm."""
    title = "whole job on sim_aws_hospital"
    if not SURVEY.exists():
        return Outcome(title, skipped="the surveys are not beside the checkout (../shared/data)")
    import open3d

    reading = best_seconds(lambda: open3d.io.read_point_cloud(str(SURVEY)), RUNS)
    best = min((_job() for _ in range(RUNS + 1)), key=lambda run: run[0])  # the first one warms up
    total, drawing, plan = best
    rows = [("Open3D reads the file", f"{reading:.3f}", "1.00")]
    rows += [(name, f"{s:.3f}", f"{s / reading:.2f}") for name, s in plan.seconds.items()]
    rows.append(("file to plan", f"{total - drawing:.3f}", f"{(total - drawing) / reading:.2f}"))
    rows.append(("SVG and GeoJSON", f"{drawing:.3f}", f"{drawing / reading:.2f}"))
    rows.append(("whole job", f"{total:.3f}", f"{total / reading:.2f}"))
    figures = {
        "times the read": total / reading,
        "total s": total,
        "Open3D read s": reading,
        "points": float(plan.point_count),
        "regions": float(len(plan.regions)),
        "doors": float(len(plan.doors)),
        "valid rectangles": float(len(plan.candidates)),
        "peak memory MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }
    figures |= {f"{name} s": s for name, s in plan.seconds.items()}
    return Outcome(
        f"{title} (target {TARGET:g} times the read)",
        ("stage", "s", "x read"),
        rows,
        figures,
        ("Peak memory includes Open3D itself, which the job does not load.",),
    )

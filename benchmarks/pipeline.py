"""The whole job on a real-sized survey, stage by stage, beside Open3D's time to read the file."""

from __future__ import annotations

import resource
import time
from pathlib import Path

from benchmarks.record import Outcome, best_seconds

SURVEY = Path(__file__).resolve().parents[1].parent / "shared" / "data" / "sim_aws_hospital" / "points.ply"
TARGET = 5.0  # times the read


def stages() -> Outcome:
    """Seconds of every stage, warm."""
    title = "whole job on sim_aws_hospital"
    if not SURVEY.exists():
        return Outcome(title, skipped="the surveys are not beside the checkout (../shared/data)")
    import open3d

    from floorplan_core import open_survey, process

    reading = best_seconds(lambda: open3d.io.read_point_cloud(str(SURVEY)), 3)
    process(open_survey(SURVEY))
    began = time.perf_counter()
    plan = process(open_survey(SURVEY))
    total = time.perf_counter() - began
    rows = [("Open3D reads the file", f"{reading:.3f}", "1.00")]
    rows += [(name, f"{s:.3f}", f"{s / reading:.2f}") for name, s in plan.seconds.items()]
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

"""What a run did, as plain data: ``report.json`` (names fixed by the documented contract)."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from floorplan_core.model import FloorPlan

STAGES = (
    "read", "frame", "segments", "planes", "occupancy", "doors", "candidates", "cover", "regions", "labels",
    "export", "total",
)  # fmt: skip
MICROSECONDS = 6  # decimals of a time
MILLIMETRES, TENTHS, SHARES = 3, 4, 4  # decimals of a length, of a residual, of a share


def run_report(
    plan: FloorPlan, seconds: Mapping[str, float] | None = None, warnings: Sequence[str] = ()
) -> dict[str, Any]:
    """The report of ``plan``; ``seconds`` adds what the pipeline cannot know (read, export, total)."""
    from floorplan_core import __version__

    return {
        "seconds": stage_seconds({**plan.seconds, **(seconds or {})}),
        "peak_memory_mb": peak_memory_mb(),
        **counts(plan),
        "loa": loa_summary(plan),
        "warnings": list(dict.fromkeys([*plan.warnings, *warnings])),
        "config": plan.config.model_dump(mode="json"),
        "version": __version__,
        "source": plan.source,
    }


def counts(plan: FloorPlan) -> dict[str, int]:
    """How many of everything."""
    return {
        "points": plan.point_count,
        "planes": len(plan.planes),
        "candidates_total": int(plan.candidates.enumerated),
        "candidates_valid": len(plan.candidates),
        "rectangles": len(plan.cover),
        "regions": len(plan.regions),
        "doors": len(plan.doors),
    }


def loa_summary(plan: FloorPlan) -> dict[str, Any]:
    """How well the walls are known: the share of the regions' sides, by length, in each USIBD band.

    ``none`` holds what was not seen and what lies off by more than 15 cm; ``mean_residual_m`` is over what
    was seen.
    """
    from floorplan_core.model.loa import mean_side_residual, side_lengths_by_band

    metres = side_lengths_by_band(plan.regions)
    total = sum(metres.values())
    residual = mean_side_residual(plan.regions)
    return {
        "length_m": round(total, MILLIMETRES),
        "share": {band: round(m / total if total else 0.0, SHARES) for band, m in metres.items()},
        "mean_residual_m": None if residual is None else round(residual, TENTHS),
    }


def stage_seconds(seconds: Mapping[str, float]) -> dict[str, float]:
    """Seconds of every stage of the contract (0 for one that was not run), then of any other."""
    known = {name: round(float(seconds.get(name, 0.0)), MICROSECONDS) for name in STAGES}
    return known | {n: round(float(s), MICROSECONDS) for n, s in seconds.items() if n not in known}


def peak_memory_mb() -> float | None:
    """The most memory that this process held so far, in MB; None where the system does not say."""
    try:
        import resource
    except ImportError:  # Windows
        return None
    unit = 1 if sys.platform == "darwin" else 1024  # bytes there, KiB elsewhere
    return round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 1e6, 1)


def as_json(report: Mapping[str, Any]) -> str:
    """The text of ``report.json``."""
    return json.dumps(report, indent=1, ensure_ascii=False) + "\n"

"""A run planned again as the sensor moved: one snapshot for each interval of run time. No Qt."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.model import FloorPlan, Reconstruction
from floorplan_core.observer import Observer


@dataclass(frozen=True)
class Snapshot:
    """One moment of a run."""

    time: float  # seconds since the first pose
    path_length: float  # metres
    plan: FloorPlan | None  # None: there was no plan yet
    seen: float = 0.0  # m2 of the regions that were seen free
    predicted: float = 0.0  # m2 of the regions that were not


def snapshots(run: Reconstruction, config: Config, every: float, observer: Observer) -> Iterator[Snapshot]:
    """Integrate and plan interval by interval; raises :class:`InputError` where nobody knows when."""
    from floorplan_core.pipeline import FloorPlanner
    from floorplan_core.replay import intervals

    planner = FloorPlanner(config, Observer(observer.cancel), run.name, run.local_frame)
    stamps = run.trajectory.stamps if run.trajectory is not None else []
    total = int(stamps[-1] - stamps[0]) if len(stamps) else None
    observer.stage_started("replay", total)
    for interval in intervals(run, every):
        for chunk in interval.chunks:
            observer.check_cancelled()
            planner.integrate_chunk(chunk, run.trajectory)
        try:
            plan = planner.plan()
        except NoPlanError:
            yield Snapshot(interval.end, interval.path_length, None)
        else:
            yield _snapshot(interval.end, interval.path_length, plan)
        observer.progress("replay", int(interval.end))


def _snapshot(time: float, path_length: float, plan: FloorPlan) -> Snapshot:
    area = sum(r.area for r in plan.regions)
    predicted = sum(r.area * r.speculated_fraction for r in plan.regions)
    return Snapshot(time, path_length, plan, area - predicted, predicted)

"""A run planned again as the sensor moved: one snapshot for each interval of run time. No Qt."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.model import FloorPlan, Reconstruction
from floorplan_core.observer import Observer

if TYPE_CHECKING:
    from floorplan_core.pipeline import FloorPlanner

SAME_FLOOR = 1.0  # metres: storeys are further apart than this, and a floor half seen is known better


@dataclass(frozen=True)
class ShownStorey:
    """Which storey of a survey is replayed; numbers change while a run reaches more of them."""

    number: int  # in the whole survey
    floor: float  # metres, z of the local frame
    alone: bool  # True where the survey has no other

    @staticmethod
    def of(whole: FloorPlan, run: Reconstruction, alone: bool) -> ShownStorey:
        """The storey of a plan of the whole ``run``."""
        up = float(whole.local_frame.shift[2] - run.local_frame.shift[2])
        return ShownStorey(whole.storey, whole.frame.floor_z + up, alone)

    def among(self, planner: FloorPlanner) -> int | None:
        """Its number in what was seen so far; None where it was not reached yet."""
        storeys = planner.storeys()  # first: it settles the map, whose centre moves
        up = float(planner.map.own.centre[2])
        apart = [abs(s.floor_z + up - self.floor) for s in storeys]
        nearest = apart.index(min(apart))  # of two as near the lower one
        return nearest if self.alone or apart[nearest] < SAME_FLOOR else None


@dataclass(frozen=True)
class Snapshot:
    """One moment of a run."""

    time: float  # seconds since the first pose
    path_length: float  # metres
    plan: FloorPlan | None  # None: there was no plan yet
    seen: float = 0.0  # m2 of the regions that were seen free
    predicted: float = 0.0  # m2 of the regions that were not


def scans_until(run: Reconstruction, moment: float | None) -> int | None:
    """Rows of the trajectory up to a moment (seconds of run time); None: all of them."""
    if moment is None or run.trajectory is None:
        return None
    stamps = run.trajectory.stamps
    return bisect_right(stamps, stamps[0] + moment)


def snapshots(
    run: Reconstruction, config: Config, every: float, observer: Observer, shown: ShownStorey
) -> Iterator[Snapshot]:
    """Integrate and plan one storey interval by interval; :class:`InputError` where nobody knows when."""
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
            number = shown.among(planner)
            plan = None if number is None else replace(planner.plan(storey=number), storey=shown.number)
        except NoPlanError:
            plan = None
        yield _snapshot(interval.end, interval.path_length, plan)
        observer.progress("replay", int(interval.end))


def _snapshot(time: float, path_length: float, plan: FloorPlan | None) -> Snapshot:
    if plan is None:
        return Snapshot(time, path_length, None)
    area = sum(r.area for r in plan.regions)
    predicted = sum(r.area * r.speculated_fraction for r in plan.regions)
    return Snapshot(time, path_length, plan, area - predicted, predicted)

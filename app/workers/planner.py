"""What the workbench asks of whoever plans, and the planner that does it in this process. No Qt."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol

from floorcast_app.point_store import PointStore
from floorcast_app.run_replay import ShownStorey, Snapshot, snapshots
from floorplan_core.config import Config
from floorplan_core.model import FloorPlan, Reconstruction
from floorplan_core.model.corrections import Correction, Point
from floorplan_core.model.storey import Storey
from floorplan_core.observer import Observer
from floorplan_core.session import Names, PlanningSession


class Session(Protocol):
    """What :class:`floorplan_core.session.PlanningSession` is: a survey read once and planned often."""

    @property
    def reconstruction(self) -> Reconstruction:
        """What is known of the survey; only who reads it can ask for its points."""

    @property
    def ready(self) -> bool:
        """True once all points were integrated."""

    @property
    def names(self) -> Names:
        """Id, name and outline of the regions of the last plan."""

    @property
    def origin(self) -> Point:
        """World metres of what corrections are relative to."""

    def must_read_again(self, config: Config) -> bool:
        """True where ``config`` changes how points are read."""

    def plan(
        self,
        config: Config,
        corrections: Sequence[Correction],
        observer: Observer,
        storey: int = 0,
        origin: Point | None = None,
    ) -> FloorPlan:
        """The plan with these settings and corrections."""

    def storeys(self, config: Config) -> tuple[Storey, ...]:
        """The storeys of the survey, lowest first."""


class Planner(Protocol):
    """Opens surveys and reads them; every call is made in a job's thread, one at a time."""

    def open(
        self, path: Path, trajectory: Path | None, config: Config, names: Names, observer: Observer
    ) -> Session:
        """Open a survey; its regions go on with ``names``."""

    def read(self, session: Session, store: PointStore, observer: Observer) -> None:
        """Integrate all points; ``store`` gets its share of them."""

    def replay(
        self,
        session: Session,
        config: Config,
        every: float,
        shown: ShownStorey,
        observer: Observer,
        each: Callable[[Snapshot], None],
    ) -> None:
        """Plan a run again, every ``every`` seconds of it."""

    def forget(self) -> None:
        """The survey was closed: what was given up need not come to an end before another is opened."""

    def start(self) -> None:
        """Get ready for the first survey; may be left out."""

    def close(self) -> None:
        """End what it started; a call that is under way fails. Whoever calls it again starts it again."""


class LocalPlanner:
    """Plans in this process: for tests and programs without a window."""

    def open(
        self, path: Path, trajectory: Path | None, config: Config, names: Names, observer: Observer
    ) -> PlanningSession:
        """See :class:`Planner`."""
        session = PlanningSession.open(path, trajectory, config, observer)
        session.begin_with_names(names)
        return session

    def read(self, session: Session, store: PointStore, observer: Observer) -> None:
        """See :class:`Planner`."""
        assert isinstance(session, PlanningSession)
        session.read(observer, store.add)

    def replay(
        self,
        session: Session,
        config: Config,
        every: float,
        shown: ShownStorey,
        observer: Observer,
        each: Callable[[Snapshot], None],
    ) -> None:
        """See :class:`Planner`."""
        for snapshot in snapshots(session.reconstruction, config, every, observer, shown):
            each(snapshot)

    def forget(self) -> None:
        """Nothing is kept."""

    def start(self) -> None:
        """Nothing is needed."""

    def close(self) -> None:
        """Nothing was started."""

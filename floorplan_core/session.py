"""A survey that is read once and planned many times: what a window or a notebook works with.

``open`` finds the reader, ``read`` integrates all points (once), ``plan`` brings the plan up to date with
settings and corrections and runs only the steps that depend on what changed. Steps that were done stay done
when a run is cancelled. One thread at a time; nothing here knows a screen.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from floorplan_core.config import Config
from floorplan_core.errors import UsageError
from floorplan_core.model import GridMap, PointChunk, Reconstruction, Region
from floorplan_core.model.corrections import Correction, Point
from floorplan_core.observer import Observer
from floorplan_core.stages.corrections import shifted
from floorplan_core.stages.region_names import NamesOfSession
from floorplan_core.steps import StepMemory

if TYPE_CHECKING:
    from floorplan_core.model import FloorPlan
    from floorplan_core.model.storey import Storey
    from floorplan_core.pipeline import FloorPlanner

Keep = Callable[[PointChunk], None]
Names = tuple[tuple[str, str, str], ...]  # id, name and outline (WKB, hexadecimal) of regions


def reads_alike(one: Config, other: Config) -> bool:
    """True where points are read and integrated the same with both settings."""
    return (one.input, one.drift, one.voxels) == (other.input, other.drift, other.voxels)


class PlanningSession:
    """One opened survey (or occupancy grid map) with everything that replanning needs."""

    def __init__(
        self, reconstruction: Reconstruction, config: Config, grid_map: GridMap | None = None
    ) -> None:
        self.reconstruction = reconstruction
        self.ready = grid_map is not None  # True once all points were integrated
        self._grid_map = grid_map
        self._read_with = config
        self._planner: FloorPlanner | None = None
        self._read_seconds = 0.0
        self._memory: dict[int, StepMemory] = {}  # by storey
        self._names = NamesOfSession()

    @classmethod
    def open(
        cls,
        path: Path,
        trajectory: Path | None,
        config: Config,
        observer: Observer,
        resolution: float | None = None,
    ) -> PlanningSession:
        """Open a survey with the readers of all plugins, or a grid map.

        :param resolution: metres a pixel, for the picture of a grid map without its YAML.
        :raises InputError: for anything that cannot be read or is not what it claims.
        """
        from floorplan_core.kernel_cache import kernels_compiled, use_kernel_cache
        from floorplan_core.plugins import default_registry
        from floorplan_core.readers import open_survey
        from floorplan_core.readers.grid_map import is_grid_map, read_grid_map

        use_kernel_cache()
        if is_grid_map(path):
            grid_map = read_grid_map(path, resolution)
            empty = Reconstruction(
                grid_map.name, lambda: iter(()), 0, assumptions=grid_map.assumptions, format="grid map"
            )
            return cls(empty, config, grid_map)
        opened = open_survey(path, trajectory, config.input, observer, default_registry())
        if not kernels_compiled():
            observer.stage_started("compile")  # the first run of a version: one to two minutes
        return cls(opened, config)

    def must_read_again(self, config: Config) -> bool:
        """True where ``config`` changes how points are read or integrated: open the survey anew."""
        if self._grid_map is not None:
            return False
        return not reads_alike(config, self._read_with)

    def read(self, observer: Observer, keep: Keep | None = None) -> None:
        """Integrate all points; ``keep`` sees every chunk. Cancelled half way, it begins anew next time."""
        if self.ready:
            return
        from floorplan_core.drift import as_configured
        from floorplan_core.kernel_times import stopwatch
        from floorplan_core.pipeline import FloorPlanner

        survey = self.reconstruction = as_configured(self.reconstruction, self._read_with, observer)
        planner = FloorPlanner(self._read_with, observer, survey.name, survey.local_frame)
        planner.map.expect(survey.point_count or 0)
        seconds, done = stopwatch(), 0
        observer.stage_started("read", survey.point_count)
        for chunk in survey.chunks():
            observer.check_cancelled()
            if keep is not None:
                keep(chunk)
            planner.integrate_chunk(chunk, survey.trajectory)
            done += len(chunk.points)
            observer.progress("read", done)
        planner.map.finish()
        planner.names = self._names
        self._read_seconds = seconds()
        observer.stage_finished("read", self._read_seconds)
        self._planner, self.ready = planner, True

    def storeys(self, config: Config) -> tuple[Storey, ...]:
        """The storeys of the survey, lowest first; none for a grid map. After :meth:`read`."""
        if self._grid_map is not None:
            return ()
        planner = self._read_planner()
        planner.config = config
        return planner.storeys()

    @property
    def names(self) -> Names:
        """Id, name and outline (WKB, hexadecimal) of the regions: for :meth:`begin_with_names` of another."""
        import shapely

        return tuple((r.id, r.name, str(shapely.to_wkb(r.polygon, hex=True))) for r in self._names.last)

    def begin_with_names(self, names: Names) -> None:
        """Regions go on with the names that they had elsewhere; outlines that make no sense are left out."""
        import shapely

        outlines = shapely.from_wkb([outline for *_, outline in names], on_invalid="ignore")
        polygons = [
            p if p is not None and p.geom_type == "Polygon" and p.is_valid else None for p in outlines
        ]
        known = [
            Region(ident, name, polygon, "", 0, 0, 0.0)
            for (ident, name, _), polygon in zip(names, polygons, strict=True)
            if polygon is not None
        ]
        if known and len({r.id for r in known}) == len({r.name for r in known}) == len(known):
            self._names.begin_with(known)

    @property
    def origin(self) -> Point:
        """World metres of the origin of the survey's local frame: what corrections are relative to."""
        x, y, _ = self.reconstruction.local_frame.shift
        return float(x), float(y)

    def plan(
        self,
        config: Config,
        corrections: Sequence[Correction],
        observer: Observer,
        storey: int = 0,
        origin: Point | None = None,
    ) -> FloorPlan:
        """The plan with these settings and corrections; only what they change is made anew.

        :param storey: number of the storey, 0 for the lowest or the only one.
        :param origin: what the corrections are relative to, where they come from another survey of the same
            place; None: this survey's :attr:`origin`.
        :raises NoPlanError: where no plan can be made; :class:`UsageError` before :meth:`read`.
        """
        memory = self._memory.setdefault(storey, StepMemory())
        if self._grid_map is not None:
            from floorplan_core.grid_pipeline import plan_grid_map

            return plan_grid_map(self._grid_map, config, observer, corrections, memory, self._names)
        planner = self._read_planner()
        planner.config, planner.observer = config, observer
        here, there = planner.local_frame.shift + planner.map.own.centre, origin or self.origin
        said = shifted(corrections, (there[0] - float(here[0]), there[1] - float(here[1])))
        plan = planner.plan(storey=storey, corrections=said, memory=memory)
        plan.seconds["read"] = self._read_seconds - plan.seconds["integrate"]
        return plan

    def _read_planner(self) -> FloorPlanner:
        if self._planner is None or not self.ready:
            raise UsageError("The survey was not read yet.")
        return self._planner

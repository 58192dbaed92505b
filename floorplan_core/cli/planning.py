"""What ``plan`` does before it writes: open what was named, read it, plan one storey after the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from floorplan_core.cli.console import CommandObserver

if TYPE_CHECKING:
    from floorplan_core.config import Config
    from floorplan_core.model import FloorPlan, Reconstruction

Clock = dict[str, float]
COMPILES_FIRST = "The first run compiles the kernels, which takes one to two minutes."
COMPILES_MORE = "This input needs kernels that no earlier run did: they are compiled now, once."


def make_any_plans(
    surveys: Sequence[Path],
    trajectory: Path | None,
    resolution: float | None,
    storey: int | None,
    config: Config,
    observer: CommandObserver,
) -> Iterator[tuple[FloorPlan, Clock]]:
    """The plans of a grid map (one) or of a reconstruction (one a storey), by what ``surveys`` are."""
    from floorplan_core.errors import UsageError
    from floorplan_core.readers.grid_map import is_grid_map

    maps = [survey for survey in surveys if is_grid_map(survey)]
    if not maps:
        if resolution is not None:
            raise UsageError(f"--resolution is for pictures of grid maps; {surveys[0].name} is none.")
        yield from make_plans(surveys, trajectory, storey, config, observer)
        return
    name = maps[0].name
    if len(surveys) > 1:
        raise UsageError(f"{name} is a grid map, which is planned by itself: name one input.")
    if trajectory is not None or observer.keep_results or storey is not None:
        raise UsageError(f"{name} is a grid map: --trajectory, --storey and --save-stages are for surveys.")
    yield make_map_plan(maps[0], resolution, config, observer)


def make_map_plan(
    path: Path, resolution: float | None, config: Config, observer: CommandObserver
) -> tuple[FloorPlan, Clock]:
    """Read an occupancy grid map and run its pipeline; returns the plan and the seconds spent in reading."""
    from floorplan_core.readers.grid_map import read_grid_map

    started = perf_counter()
    grid_map = read_grid_map(path, resolution)
    clock = {"read": perf_counter() - started}
    for sentence in grid_map.assumptions:
        observer.console.message(sentence)
    announce_compilation(observer)
    from floorplan_core.grid_pipeline import plan_grid_map  # after reading: bad input is answered at once

    return plan_grid_map(grid_map, config, observer), clock


def make_plans(
    surveys: Sequence[Path],
    trajectory: Path | None,
    storey: int | None,
    config: Config,
    observer: CommandObserver,
) -> Iterator[tuple[FloorPlan, Clock]]:
    """Read ``surveys`` as one and plan its storeys, lowest first, or the one that was asked for.

    A storey of which no plan can be made is left out with a warning, where there are others.
    """
    from floorplan_core.errors import NoPlanError

    clock = {"start": find_plugins()}
    started = perf_counter()
    reconstruction = open_input(surveys, trajectory, config, observer)
    clock["read"] = perf_counter() - started
    started = perf_counter()
    announce_compilation(observer)
    from floorplan_core.pipeline import integrate_all  # after opening: bad input is answered at once

    clock["start"] += perf_counter() - started
    planner, _ = integrate_all(timed_chunks(reconstruction, clock), config, observer)
    numbers = [s.number for s in planner.storeys()] if storey is None else [storey]
    failed: list[NoPlanError] = []
    for number in numbers:
        try:
            yield planner.plan(storey=number), clock
        except NoPlanError as error:
            failed.append(error)
            if len(numbers) > 1:
                observer.warning(f"Storey {number}: {error}")
    if len(failed) == len(numbers):
        raise failed[0]


def announce_compilation(observer: CommandObserver) -> None:
    """From now on say so when kernels have to be compiled, which makes the first run of a kind longer."""
    from floorplan_core.kernel_cache import (
        import_numba,
        kernels_compiled,
        on_first_compilation,
        use_kernel_cache,
    )
    from floorplan_core.kernel_times import time_kernels

    use_kernel_cache()
    import_numba()
    time_kernels()
    sentence = COMPILES_MORE if kernels_compiled() else COMPILES_FIRST
    on_first_compilation(lambda: observer.console.message(sentence))


def find_plugins() -> float:
    """Find the plugins; returns the seconds that it took, which are none of the reader's."""
    from floorplan_core.plugins import default_registry

    started = perf_counter()
    default_registry()
    return perf_counter() - started


def replan(
    stages: Path, from_stage: str, config: Config, observer: CommandObserver
) -> tuple[FloorPlan, Clock]:
    """Begin again at a stage; returns the plan and the seconds spent in reading what came before."""
    from floorplan_core.restart import restart

    started = perf_counter()
    plan = restart(stages, from_stage, config, observer)
    return plan, {"read": perf_counter() - started - sum(plan.seconds.values())}


def stages_of(survey: Path) -> Path:
    """The folder of stages in (or at) ``survey``."""
    from floorplan_core.restart import STAGE_FOLDER

    inside = survey / STAGE_FOLDER
    return inside if inside.is_dir() else survey


def open_input(
    surveys: Sequence[Path], trajectory: Path | None, config: Config, observer: CommandObserver
) -> Reconstruction:
    """Open ``surveys`` as one with the readers of all plugins; what had to be guessed is shown."""
    from floorplan_core.plugins import default_registry
    from floorplan_core.readers import open_survey

    opened = open_survey(surveys, trajectory, config.input, observer, default_registry(), colours=False)
    for sentence in opened.assumptions:
        observer.console.message(sentence)
    return opened


def timed_chunks(reconstruction: Reconstruction, clock: Clock) -> Reconstruction:
    """The same survey; the seconds that its reader takes for its chunks are added to ``clock["read"]``."""
    from floorplan_core.kernel_times import stopwatch
    from floorplan_core.model import PointChunk

    def chunks() -> Iterator[PointChunk]:
        source = reconstruction.chunks()
        while True:
            seconds = stopwatch()
            chunk = next(source, None)
            clock["read"] += seconds()
            if chunk is None:
                return
            yield chunk

    return replace(reconstruction, chunks=chunks)

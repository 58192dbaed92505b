"""What every stage of a run made, kept in a folder, and runs that begin again at any of the stages.

One file a step, ``NN-STAGE.stage`` (a stage may take several steps), beside ``run.stage``, which holds what
the steps do not: the name of the input, the number of points, how its axes were read, the settings.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floorplan_core import intermediates
from floorplan_core.config import Config
from floorplan_core.errors import InputError, UsageError

if TYPE_CHECKING:
    from floorplan_core.model import FloorPlan
    from floorplan_core.observer import Observer

STAGE_FOLDER = "stages"
RUN_FILE = "run.stage"
SUFFIX = ".stage"
SKIPPED = ("read", "export")  # stages around the plan, not of it


def save_stages(steps: Sequence[tuple[str, object]], plan: FloorPlan, folder: Path) -> None:
    """Write the ``steps`` (stage, result) of the run that made ``plan`` into the new ``folder``."""
    folder.mkdir()
    kept = [(stage, result) for stage, result in steps if stage not in SKIPPED]
    for number, (stage, result) in enumerate(kept):
        intermediates.save(result, folder / f"{number:02d}-{stage}{SUFFIX}")
    run = {
        "source": plan.source,
        "points": plan.point_count,
        "config": plan.config,
        "frame": plan.local_frame,
        "storey": plan.storey,
    }
    intermediates.save(run, folder / RUN_FILE)


def saved_config(folder: Path) -> Config:
    """The settings of the run that was kept in ``folder``."""
    config = _run(folder)["config"]
    assert isinstance(config, Config)
    return config


def restart(folder: Path, stage: str, config: Config, observer: Observer) -> FloorPlan:
    """Plan again from ``stage`` on, with ``config``; what came before is read from ``folder``.

    Raises :class:`InputError` where the folder holds no run, :class:`UsageError` for an unknown stage.
    """
    from floorplan_core.pipeline import FloorPlanner

    run = _run(folder)
    given = [intermediates.load(file, object) for file in _before(folder, stage)]
    planner = FloorPlanner(config, observer, run["source"], run["frame"])
    return replace(planner.plan(given), point_count=run["points"], storey=run["storey"])


def _run(folder: Path) -> dict[str, Any]:
    from floorplan_core.type_check import conforms

    file = folder / RUN_FILE
    if not file.is_file():
        raise InputError(
            f"The folder {folder} holds no stages of a run; "
            "'floorcast plan INPUT --out DIR --save-stages' keeps them."
        )
    run = {"storey": 0, **intermediates.load(file, dict)}  # earlier versions knew of one
    wanted = {"source": str, "points": int, "config": Config, "frame": _local_frame(), "storey": int}
    if not all(conforms(run.get(name), kind) for name, kind in wanted.items()):
        raise InputError(f"{file.name} in {folder} does not describe a run.")
    return run


def _local_frame() -> type:
    from floorplan_core.model import LocalFrame

    return LocalFrame


def _before(folder: Path, stage: str) -> list[Path]:
    """The files of the steps before the first one of ``stage``, in order; none may be missing."""
    files = sorted(f for f in folder.glob(f"*{SUFFIX}") if f.name != RUN_FILE)
    stages = [f.stem.partition("-")[2] for f in files]
    if stage not in stages:
        known = ", ".join(dict.fromkeys(stages))
        raise UsageError(f"There is no stage {stage!r} to start from; {folder} holds {known or 'none'}.")
    first = stages.index(stage)
    if [f.name.partition("-")[0] for f in files[:first]] != [f"{k:02d}" for k in range(first)]:
        raise InputError(
            f"The stages before {stage} are not complete in {folder}; run again with --save-stages."
        )
    return files[:first]

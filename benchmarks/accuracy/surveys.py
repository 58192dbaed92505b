"""Simulated surveys, made once and kept: a folder's key covers its settings and the simulator's source."""

from __future__ import annotations

import hashlib
import os
import shutil
from pathlib import Path

import platformdirs

import floorplan_core.simulation
from benchmarks.accuracy.cases import Case
from floorplan_core.observer import Observer

CACHE_VARIABLE = "FLOORCAST_BENCHMARK_CACHE"  # folder; default: the user's cache folder
# What a survey's file is called, in the order in which it is looked for.
CLOUDS = ("points.ply", "points3d_extruded.ply")


def cache_folder() -> Path:
    """Where surveys and the plans of the last run are kept."""
    given = os.environ.get(CACHE_VARIABLE)
    return Path(given) if given else Path(platformdirs.user_cache_dir("floorcast")) / "accuracy"


def simulator_version() -> str:
    """A hash of the simulator's source: another simulator makes other surveys."""
    home = Path(floorplan_core.simulation.__file__).parent
    sources = sorted(home.glob("*.py"))
    return hashlib.sha256(b"".join(s.read_bytes() for s in sources)).hexdigest()


def survey_folder(case: Case, observer: Observer) -> Path:
    """The folder of the survey; simulated and cached where needed."""
    if case.folder is not None:
        return case.folder
    from floorplan_core.simulation import simulate

    key = hashlib.sha256(f"{case.spec!r} {simulator_version()}".encode()).hexdigest()[:12]
    home = cache_folder() / "surveys"
    folder = home / f"{case.name}.{key}"
    if not (folder / "truth.json").is_file():
        for old in home.glob(f"{case.name}.*"):
            shutil.rmtree(old)
        part = home / f"{case.name}.part"
        part.mkdir(parents=True)
        simulate(case.spec, part, observer)
        part.rename(folder)
    return folder


def cloud(folder: Path) -> Path:
    """The survey's points."""
    return next((folder / name for name in CLOUDS if (folder / name).is_file()), folder)

"""Kill a program while it saves, again and again: ``python -m tests.app.kills KIND TIMES FOLDER``.

KIND is ``project``, ``autosave`` or ``export``. What is saved is counted; a child saves as fast as it can and
says which version is done; it is killed at a random moment, and what lies on the disk must be a whole file,
that version or the next. Writes one line for each thing that does not hold; none is good.
"""

from __future__ import annotations

import os
import random
import signal
import sys
import time
import traceback
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from floorcast_app.recovery import Recovery, recoverable
from floorcast_app.workbench import Workbench
from floorplan_core.model.corrections import NameRegion
from floorplan_core.project_file import load
from tests.app.pump import SAMPLE, make_workbench, settle

LONGEST = 0.12  # s until a child is killed, after its first version is done
FORMATS = (".geojson", ".svg", ".png", ".planes.png", ".labels.png")

Say = Callable[[int], None]  # a version is done
Work = Callable[[Workbench, Path, Say], None]  # saves for ever
Check = Callable[[Workbench, Path, int], str]  # after so many versions: what does not hold, or ""


def rename(bench: Workbench, version: int) -> None:
    """Another version of the document: as many corrections, and the last says which it is."""
    names = tuple(NameRegion((0.0, 0.0), f"v{k}") for k in (*range(200), version))
    bench.document.apply(f"Version {version}", replace(bench.state, corrections=names))


def version_of(path: Path) -> int:
    return int(load(path).corrections[-1].name.removeprefix("v"))


def save_projects(bench: Workbench, folder: Path, say: Say) -> None:
    version = 0
    while True:
        rename(bench, version)
        bench.save_project(folder / "house.floorcast")
        say(version)
        version += 1


def check_project(bench: Workbench, folder: Path, done: int) -> str:
    found = version_of(folder / "house.floorcast")
    bench.save_project(folder / "house.floorcast")  # the next save clears up
    others = sorted(p.name for p in folder.iterdir())
    if found not in (done, done + 1):
        return f"version {found} on the disk after version {done} was saved"
    return "" if others == ["house.floorcast"] else f"left behind: {others}"


def autosave(bench: Workbench, folder: Path, say: Say) -> None:
    recovery, version = Recovery(bench, folder), 0
    while True:
        rename(bench, version)
        recovery.flush()
        say(version)
        version += 1


def check_autosave(bench: Workbench, folder: Path, done: int) -> str:
    from floorcast_app.recovery import discard

    (item,) = recoverable(folder)
    found = version_of(item.autosave)
    discard(item)
    others = sorted(p.name for p in folder.iterdir())
    if found not in (done, done + 1):
        return f"version {found} can be recovered after version {done} was kept"
    return "" if not others else f"left behind: {others}"


def export(bench: Workbench, folder: Path, say: Say) -> None:
    version = 0
    while True:
        suffix = FORMATS[version % len(FORMATS)]
        bench.run("file.export", path=folder / f"plan{suffix}")
        settle(bench)
        say(version)
        version += 1


def check_export(bench: Workbench, folder: Path, done: int) -> str:
    whole = folder.parent / "whole"
    if not whole.exists():
        whole.mkdir()
        for suffix in FORMATS:
            bench.run("file.export", path=whole / f"plan{suffix}")
            settle(bench)
    for path in folder.glob("plan.*"):
        if path.read_bytes() != (whole / path.name).read_bytes():
            return f"{path.name} is not what a quiet export writes"
    for left in folder.glob(".floorcast-*"):
        os.utime(left, (0, 0))  # long ago
    bench.run("file.export", path=folder / "plan.svg")
    settle(bench)
    others = [p.name for p in folder.iterdir() if p.name.startswith(".")]
    return f"left behind: {others}" if others else ""


KINDS: dict[str, tuple[Work, Check]] = {
    "project": (save_projects, check_project),
    "autosave": (autosave, check_autosave),
    "export": (export, check_export),
}


def killed_once(bench: Workbench, work: Work, folder: Path, wait: float) -> int:
    """The last version that a child said was done before it was killed."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        try:
            work(bench, folder, lambda version: os.write(writing, version.to_bytes(4, "little")) and None)
        except BaseException:  # noqa: BLE001 (whatever it is, the one who forked is to read it)
            traceback.print_exc()
        finally:
            os._exit(1)
    os.close(writing)
    first = os.read(reading, 4)
    time.sleep(wait)
    os.kill(child, signal.SIGKILL)
    _, status = os.waitpid(child, 0)
    assert first and os.WIFSIGNALED(status), "the child ended by itself"
    said = first
    while more := os.read(reading, 4096):
        said += more
    os.close(reading)
    return int.from_bytes(said[-4:], "little")


def main(kind: str, times: int, folder: Path, seed: int = 0) -> int:
    """The number of times that something was lost."""
    work, check = KINDS[kind]
    rng, bench, wrong = random.Random(seed), make_workbench(), 0
    if kind == "export":
        bench.open_survey(SAMPLE)
        settle(bench)
    versions = []
    for time_ in range(times):
        place = folder / f"{kind}-{time_}"
        place.mkdir()
        done = killed_once(bench, work, place, rng.uniform(0, LONGEST * (4 if kind == "export" else 1)))
        versions.append(done)
        problem = check(bench, place, done)
        if problem:
            wrong += 1
            sys.stdout.write(f"{kind}, kill {time_}: {problem}\n")
    sys.stdout.write(f"{kind}: {times} kills after {min(versions)} to {max(versions)} saves, {wrong} wrong\n")
    return wrong


if __name__ == "__main__":
    sys.exit(min(main(sys.argv[1], int(sys.argv[2]), Path(sys.argv[3])), 1))

"""How long the window ever stands still: ``python -m benchmarks.ui`` (``make bench-ui``).

A timer of 10 ms runs in the event loop while a survey of 5 M points is loaded and planned, while a setting is
changed, while it is orbited, while a second load is cancelled half way, and while the theme is changed.
Reported are the largest gaps between two ticks, with and without the time in which other programs had the
processor, and the time until the first window stands. ``--format`` chooses between PLY, LAZ and E57,
``--who`` tells what every thread did in the gaps.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import shutil
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QEventLoop, QTimer

from benchmarks.big import WRITERS
from benchmarks.stand_still import Gap, StandStill

LEAST = 15.0  # ms: any gap longer than this is looked at
TOLD = 3  # gaps of each piece of work that --who tells
SAMPLE = Path(__file__).resolve().parents[1] / "resources" / "sample_survey"


def big_survey(folder: Path, kind: str, points: int) -> Path:
    """The bundled survey with every point repeated, moved by 2 mm of noise, and its trajectory."""
    from floorplan_core import open_survey
    from floorplan_core.observer import Observer

    survey = open_survey(SAMPLE, observer=Observer())
    chunks = list(survey.chunks())
    assert survey.trajectory is not None
    xyz = np.concatenate([c.points for c in chunks])
    scan = np.concatenate([c.scan_id for c in chunks])
    rows = np.resize(np.argsort(scan, kind="stable"), points)
    rows = rows[np.argsort(scan[rows], kind="stable")]
    rng, poses = np.random.default_rng(0), survey.trajectory.T_world_sensor
    target = folder / f"points.{kind}"
    shutil.copy(SAMPLE / "trajectory.tum", folder / "stations.tum")
    if kind != "e57":  # it holds its poses itself
        shutil.copy(SAMPLE / "trajectory.tum", folder / "trajectory.tum")
    with WRITERS[kind](target, points) as write:
        for k, own in ((k, rows[scan[rows] == k]) for k in np.unique(scan)):
            moved = xyz[own] + rng.normal(0, 0.002, (len(own), 3))
            write(((moved - poses[k][:3, 3]) @ poses[k][:3, :3], poses[k], int(k)))
    return target


def made_apart(folder: Path, kind: str, points: int) -> Path:
    """The survey, made in a process of its own: the window's memory is as a user's."""
    context = multiprocessing.get_context("spawn")
    process = context.Process(target=big_survey, args=(folder, kind, points))
    process.start()
    while process.is_alive():
        spin(0.1)
    if process.exitcode:
        raise SystemExit(f"The survey could not be made (status {process.exitcode}).")
    return folder / f"points.{kind}"


def spin(seconds: float) -> None:
    """Let events happen for a while."""
    loop = QEventLoop()
    QTimer.singleShot(round(seconds * 1000), loop.quit)
    loop.exec()


def main(arguments: list[str]) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.ui")
    parser.add_argument("--who", action="store_true", help="tell what every thread did in the gaps")
    parser.add_argument("--format", choices=sorted(WRITERS), default="ply", help="of the survey")
    parser.add_argument("--points", type=float, default=5e6)
    asked = parser.parse_args(arguments)
    from floorcast_app.warm_up import WarmUp, load_without_collecting

    load_without_collecting()
    from floorcast_app.main import make_application, make_window
    from floorcast_app.script import ScriptedApplication

    who, kind = asked.who, asked.format
    began = time.perf_counter()
    app = make_application()
    window = make_window(unattended=True)
    window.resize(1440, 900)
    window.show()
    app.processEvents()
    _say("first window, s", time.perf_counter() - began)
    warming = WarmUp(window.workbench.planner)
    warming.start()
    script, watch = ScriptedApplication(window), StandStill(LEAST, who)
    spin(3)  # as long as somebody takes to choose a file
    _tell("until a file is chosen", watch.take(), who)
    with tempfile.TemporaryDirectory() as folder:
        survey = made_apart(Path(folder), kind, int(asked.points))
        watch.take()
        for name, work in (
            ("load and plan", lambda: _as_a_user(script, "file.open", path=survey)),
            ("look at it", lambda: spin(3)),
            (
                "change a door setting",
                lambda: _as_a_user(script, "plan.set", name="doors.max_width", value=1.2),
            ),
            ("orbit", lambda: _orbit(window.workbench)),
            ("cancel half way", lambda: _cancel(script, survey)),
            ("change the theme", lambda: _as_a_user(script, "view.theme")),
            ("and back", lambda: _as_a_user(script, "view.theme")),
        ):
            started = time.perf_counter()
            work()
            spin(0.5)
            _say(f"{name}, s", time.perf_counter() - started)
            _tell(name, watch.take(), who)
        window.close()
        window.workbench.jobs.wait()
    warming.stop()
    watch.stop()
    return 0


def _say(name: str, value: float) -> None:
    sys.stdout.write(f"{name:60s} {value:8.2f}\n")
    sys.stdout.flush()


def _tell(name: str, gaps: list[Gap], who: bool) -> None:
    """The largest gaps, each by its own measure; ``gaps`` are longest first, without other programs."""
    _say("    largest gap, ms", max((g.milliseconds for g in gaps), default=0.0))
    _say("    the same without waiting for a processor, ms", gaps[0].own if gaps else 0.0)
    _say("    the window's own work between two ticks, at most, ms", max((g.busy for g in gaps), default=0.0))
    for gap in gaps[:TOLD]:
        sys.stdout.write(
            f"      {gap.milliseconds:.0f} ms: {gap.busy:.0f} of its own work, "
            f"the processor was away for {gap.waited:.0f}\n"
        )
    for gap in gaps[:TOLD] if who else ():
        others = ", ".join(f"{thread} {ms:.0f}" for thread, ms in gap.threads if ms >= 1)
        sys.stdout.write(f"      {gap.own:.0f} ms; the others computed: {others}\n{gap.stacks}\n")


def _as_a_user(script, action: str, **arguments) -> None:  # type: ignore[no-untyped-def]
    """Run an action and let events happen until it is done; a script would hurry the panels afterwards."""
    script.run(action, wait=False, **arguments)
    while script.workbench.jobs.running:
        spin(0.05)


def _orbit(workbench) -> None:  # type: ignore[no-untyped-def]
    for step in range(60):
        workbench.view.set(azimuth=float(step * 6))
        spin(0.03)


def _cancel(script, survey: Path) -> None:  # type: ignore[no-untyped-def]
    script.run("file.open", wait=False, path=survey)
    spin(0.7)
    if script.workbench.jobs.running:
        script.workbench.run("plan.cancel")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

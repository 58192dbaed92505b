"""How long the window ever stands still: ``python -m benchmarks.ui [--who]`` (``make bench-ui``).

A timer of 10 ms runs in the event loop while a survey of 5 M points is loaded and planned, while a setting is
changed, while it is orbited, while a second load is cancelled half way, and while the theme is changed.
Reported are the largest gaps between two ticks, with and without the time in which other programs had the
processor, and the time until the first window stands. ``--who`` tells what every thread did in the gaps.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QEventLoop, QTimer

from benchmarks.stand_still import Gap, StandStill

POINTS = 5_000_000
LEAST = 15.0  # ms: any gap longer than this is looked at
TOLD = 3  # gaps of each piece of work that --who tells
SAMPLE = Path(__file__).resolve().parents[1] / "resources" / "sample_survey"


def big_survey(folder: Path, points: int) -> Path:
    """The bundled survey with every point repeated, moved by 2 mm of noise, and its trajectory."""
    import shutil

    from floorplan_core import open_survey
    from floorplan_core.observer import Observer

    chunks = list(open_survey(SAMPLE, observer=Observer()).chunks())
    xyz = np.concatenate([c.points for c in chunks]).astype(np.float32)
    scan = np.concatenate([c.scan_id for c in chunks])
    times = -(-points // len(xyz))
    rng = np.random.default_rng(0)
    rows = np.tile(np.arange(len(xyz)), times)[:points]
    rows.sort()
    dtype = [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("scan_id", "<i4")]
    out = np.empty(points, dtype=dtype)
    moved = xyz[rows] + rng.normal(0, 0.002, (points, 3)).astype(np.float32)
    out["x"], out["y"], out["z"], out["scan_id"] = *moved.T, scan[rows]
    header = "ply\nformat binary_little_endian 1.0\n" + f"element vertex {points}\n"
    header += "property float x\nproperty float y\nproperty float z\nproperty int scan_id\nend_header\n"
    target = folder / "big" / "points.ply"
    target.parent.mkdir()
    target.write_bytes(header.encode() + out.tobytes())
    shutil.copy(SAMPLE / "trajectory.tum", target.parent / "trajectory.tum")
    return target


def spin(seconds: float) -> None:
    """Let events happen for a while."""
    loop = QEventLoop()
    QTimer.singleShot(round(seconds * 1000), loop.quit)
    loop.exec()


def main() -> int:
    """Print the table."""
    from floorcast_app.warm_up import WarmUp, load_without_collecting

    load_without_collecting()
    from floorcast_app.main import make_application, make_window
    from floorcast_app.script import ScriptedApplication

    who = "--who" in sys.argv[1:]
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
        survey = big_survey(Path(folder), POINTS)
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
            ("change the theme", lambda: script.run("view.theme")),
            ("and back", lambda: script.run("view.theme")),
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
    sys.exit(main())

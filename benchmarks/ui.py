"""How long the window ever stands still: ``python -m benchmarks.ui`` (``make bench-ui``).

A timer of 10 ms runs in the event loop while a survey of 5 M points is loaded and planned, while a setting is
changed, and while a second load is cancelled half way. Reported are the largest gaps between two ticks, and
the time until the first window stands.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QEventLoop, QTimer

POINTS = 5_000_000
TICK = 10  # ms
SAMPLE = Path(__file__).resolve().parents[1] / "resources" / "sample_survey"


@dataclass
class Gaps:
    """The largest time between two ticks since the last :meth:`take`, ms.

    ``busy`` is the processor time that the main thread itself spent between two ticks: where that is small
    and the gap is not, the machine had other things to do, or another thread held the interpreter.
    """

    largest: float = 0.0
    busy: float = 0.0
    last: tuple[float, float] = (0.0, 0.0)

    def tick(self) -> None:
        now = _clocks()
        self.largest = max(self.largest, now[0] - self.last[0])
        self.busy = max(self.busy, now[1] - self.last[1])
        self.last = now

    def take(self) -> tuple[float, float]:
        taken = (self.largest, self.busy)
        self.largest, self.busy, self.last = 0.0, 0.0, _clocks()
        return taken


def _clocks() -> tuple[float, float]:
    return time.perf_counter() * 1000, time.thread_time() * 1000


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
    from floorcast_app.main import make_application, make_window
    from floorcast_app.script import ScriptedApplication
    from floorcast_app.warm_up import WarmUp

    began = time.perf_counter()
    app = make_application()
    window = make_window(unattended=True)
    window.resize(1440, 900)
    window.show()
    app.processEvents()
    rows = [("first window, s", time.perf_counter() - began)]
    warming = WarmUp()
    warming.start()
    script, gaps = ScriptedApplication(window), Gaps()
    timer = QTimer(interval=TICK)
    timer.timeout.connect(gaps.tick)
    timer.start()
    with tempfile.TemporaryDirectory() as folder:
        survey = big_survey(Path(folder), POINTS)
        gaps.take()
        spin(2)  # as long as somebody takes to choose a file
        rows.append(("until a file is chosen: largest gap, ms", gaps.take()[0]))
        for name, work in (
            ("load and plan", lambda: script.run("file.open", path=survey)),
            ("look at it", lambda: spin(3)),
            ("change a door setting", lambda: script.run("plan.set", name="doors.max_width", value=1.2)),
            ("orbit", lambda: _orbit(window.workbench)),
            ("cancel half way", lambda: _cancel(script, survey)),
        ):
            started = time.perf_counter()
            work()
            spin(0.2)
            gap, busy = gaps.take()
            rows += [(f"{name}: s", time.perf_counter() - started), ("    largest gap, ms", gap)]
            rows += [("    of it the window's own work, at most, ms", busy)]
        window.close()
    warming.stop()
    for name, value in rows:
        sys.stdout.write(f"{name:44s} {value:8.2f}\n")
    return 0


def _orbit(workbench) -> None:  # type: ignore[no-untyped-def]
    for step in range(60):
        workbench.view.set(azimuth=float(step * 6))
        spin(0.03)


def _cancel(script, survey: Path) -> None:  # type: ignore[no-untyped-def]
    script.run("file.open", wait=False, path=survey)
    spin(0.7)
    script.workbench.run("plan.cancel")


if __name__ == "__main__":
    sys.exit(main())

"""``python -m benchmarks.site [--side M] [--share S] [--points N] [--memory MB] [--keep FOLDER]``: a campus.

One office is simulated and repeated over a square of ``--side`` metres, each copy a little out of line, so
that hardly any wall of one is in line with one of another. ``--share`` of the copies are there: the others
are empty ground, and corridors of one box each join what is left. ``--points`` are those of one office. The
cloud is planned with ``voxels.memory`` in a process of its own; for each stage the seconds of wall and CPU,
the most memory that the system cannot take back (``RssAnon``) and the most that was resident (``VmHWM``),
then the same for each file that is written.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.bench_io import SMALL
from benchmarks.big import OFFICE, SEED, YAW, Turn, ply_file, trajectory_of, turns
from benchmarks.record import Outcome, report
from floorplan_core.observer import Observer

Float = np.ndarray
GAP, JITTER = 0.6, 0.15  # m between two offices, and by which each is out of line
WIDE, HIGH = 2.4, 2.8  # m, section of a corridor between two offices
DENSITY, EVERY, NOISE = 1500, 6.0, 0.003  # points a m2 of a corridor, m between its stations, m
LOOK = 0.02  # s between two looks at the memory of the process
FILES = (
    *("plan.geojson", "plan.svg", "plan.png", "planes.png", "occupancy.png", "labels.png"),
    *("plan.ifc", "plan.dxf", "plan.pdf", "map.yaml", "map.predicted.yaml"),
)


def site(folder: Path, side: float, share: float, points: int) -> Path:
    """The cloud and its stations; how many points it has is in its name."""
    office = list(turns(points, folder, OFFICE))
    rooms = json.loads((folder / "truth.json").read_text())["rooms"]
    outline = np.concatenate([np.array(room["polygon"]) for room in rooms])
    low, pitch = outline.min(axis=0), np.ptp(outline, axis=0) + GAP
    shifts, links = _places(np.maximum(1, (side / pitch).astype(int)), share, pitch)
    turn = np.eye(3)
    turn[:2, :2] = _rotation(YAW)
    made = [_moved(t, turn @ [*shift, 0.0]) for shift in shifts for t in office]
    floor = min(float((t[0] @ t[1][:3, :3].T + t[1][:3, 3])[:, 2].min()) for t in office[:1])
    rng = np.random.default_rng(SEED)
    for a, b in links:
        middle = low + pitch / 2 - GAP / 2
        made += _corridor(a + middle, b + middle, pitch - GAP, floor, turn, rng)
    path = folder / f"site-{sum(len(t[0]) for t in made) / 1e6:.1f}M.ply"
    poses: list[Float] = []
    with ply_file(path, sum(len(t[0]) for t in made)) as write:
        for own, pose, _ in made:
            if not poses or not np.array_equal(pose, poses[-1]):
                poses.append(pose)
            write((own, pose, len(poses) - 1))
    from floorplan_core.simulation.files import tum_bytes

    (folder / "stations.tum").write_bytes(tum_bytes(np.arange(len(poses)) * 60.0, np.stack(poses)))
    return path


def _places(count: Float, share: float, pitch: Float) -> tuple[list[Float], list[tuple[Float, Float]]]:
    """Where the offices are, and pairs of them with empty ground in between; all of the first column are."""
    rng = np.random.default_rng(SEED)
    there = rng.random(count) < share
    there[0] = True
    at = np.stack(np.indices(count), axis=-1) * pitch
    at = at + rng.uniform(-JITTER, JITTER, at.shape)
    links = []
    for j in range(count[1]):
        row = np.flatnonzero(there[:, j])
        links += [(at[a, j], at[b, j]) for a, b in pairwise(row) if b > a + 1]
    return [at[i, j] for i, j in zip(*np.nonzero(there), strict=True)], links


def _corridor(a: Float, b: Float, office: Float, floor: float, turn: Float, rng: Any) -> list[Turn]:
    """A box along x between the offices whose middles are ``a`` and ``b``, seen from stations in it."""
    x0, x1, y0 = a[0] + office[0] / 2 + GAP / 2, b[0] - office[0] / 2 - GAP / 2, (a[1] + b[1] - WIDE) / 2
    length = x1 - x0
    faces = rng.choice(4, round(2 * (WIDE + HIGH) * length * DENSITY), p=_shares())
    along, across = rng.uniform(x0, x1, len(faces)), rng.random(len(faces))
    y = np.select([faces == 0, faces == 1], [0.0, WIDE], across * WIDE) + y0
    z = np.select([faces == 2, faces == 3], [0.0, HIGH], across * HIGH) + floor
    xyz = np.stack([along, y, z], axis=1) + rng.normal(0, NOISE, (len(faces), 3))
    stations = np.linspace(x0, x1, max(1, round(length / EVERY)) + 2)[1:-1]
    nearest = np.abs(along[:, None] - stations).argmin(axis=1)
    found = []
    for k, x in enumerate(stations.tolist()):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = turn, turn @ [x, y0 + WIDE / 2, floor + 1.5]
        found.append((xyz[nearest == k] - [x, y0 + WIDE / 2, floor + 1.5], pose, k))
    return found


def _shares() -> Float:
    return np.array([HIGH, HIGH, WIDE, WIDE]) / (2 * (WIDE + HIGH))


def _moved(turn: Turn, shift: Float) -> Turn:
    pose = turn[1].copy()
    pose[:3, 3] += shift
    return turn[0], pose, turn[2]


def _rotation(degrees: float) -> Float:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s], [s, c]])


class Meter(Observer):
    """Seconds and most memory of each stage; a thread looks at the memory."""

    def __init__(self) -> None:
        super().__init__()
        self.most: dict[str, float] = {}  # MB that the system cannot take back
        self.resident: dict[str, float] = {}  # MB, pages of files too
        self.took: dict[str, float] = {}
        self.cpu: dict[str, float] = {}
        self._now, self._since, self._used = "start", time.perf_counter(), time.process_time()
        self._stop = threading.Event()

    @contextmanager
    def watching(self) -> Iterator[None]:
        """Look at the memory meanwhile."""
        thread = threading.Thread(target=self._look)
        thread.start()
        try:
            yield
        finally:
            self.begin("end")
            self._stop.set()
            thread.join()

    def begin(self, stage: str) -> None:
        """What is done from now on."""
        now, used, at = time.perf_counter(), time.process_time(), self._now
        self.took[at] = self.took.get(at, 0.0) + now - self._since
        self.cpu[at] = self.cpu.get(at, 0.0) + used - self._used
        self.resident[at] = max(_most_resident(), self.resident.get(at, 0.0))
        print(
            f"{now - self._since:8.1f} s  {used - self._used:8.1f} s CPU  {self.most.get(at, 0.0):8.0f} MB  "
            f"{self.resident[at]:8.0f} MB resident  {at}",
            file=sys.stderr,
        )
        self._now, self._since, self._used = stage, now, used

    def stage_started(self, stage: str, total: int | None = None) -> None:
        self.begin(stage)

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        self.begin("between stages")

    def _look(self) -> None:
        while not self._stop.wait(LOOK):
            status = Path("/proc/self/status").read_text()
            own = int(status.partition("RssAnon:")[2].split()[0]) / 1024
            self.most[self._now] = max(own, self.most.get(self._now, 0.0))


def _most_resident() -> float:
    """MB, since the last call."""
    status = Path("/proc/self/status").read_text()
    Path("/proc/self/clear_refs").write_text("5")  # the mark begins anew
    return int(status.partition("VmHWM:")[2].split()[0]) / 1024


def plan(path: Path, memory: float) -> dict[str, Any]:
    """Plan the cloud in this process, after the kernels were loaded from their cache, and write all files."""
    from floorplan_core import Config, intermediates
    from floorplan_core.pipeline import process
    from floorplan_core.plan_files import PLAN_FILE
    from floorplan_core.plugins import default_registry
    from floorplan_core.readers import open_survey

    process(open_survey(SMALL))
    registry, meter = default_registry(), Meter()
    config = Config().with_values({"voxels.memory": str(memory)})
    with meter.watching():
        survey = open_survey(path, trajectory_of(path), registry=registry)
        made = process(survey, config, meter)
        meter.begin(PLAN_FILE)
        intermediates.save(made, path.parent / PLAN_FILE)
        for name in FILES:
            meter.begin(name)
            registry.exporter(Path(name)).write(made, path.parent / name)
    usage = resource.getrusage(resource.RUSAGE_SELF)
    sizes = {"regions": len(made.regions), "doors": len(made.doors), "planes": len(made.planes)}
    return {
        "most": meter.most,
        "took": meter.took,
        "resident": meter.resident,
        "cpu_of": meter.cpu,
        "cpu": usage.ru_utime + usage.ru_stime,
        "sizes": sizes | {"points": made.point_count},
    }


def main(arguments: Sequence[str]) -> int:
    """The table of one site."""
    parser = argparse.ArgumentParser(prog="benchmarks.site", description=__doc__)
    parser.add_argument("--side", type=float, default=500.0, help="m")
    parser.add_argument("--share", type=float, default=1.0, help="of the site that is built")
    parser.add_argument("--points", type=lambda t: int(float(t)), default=10**6, help="of one office")
    parser.add_argument("--memory", type=float, default=1000.0, help="voxels.memory, MB")
    parser.add_argument("--keep", type=Path, help="folder that keeps the cloud, and plans the one in it")
    parser.add_argument("--one", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args(arguments)
    if given.one:
        print(json.dumps(plan(given.one, given.memory)))
        return 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        path = next(folder.glob("site-*.ply"), None) or site(folder, given.side, given.share, given.points)
        command = [sys.executable, "-m", "benchmarks.site", "--one", str(path), "--memory", str(given.memory)]
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    found = json.loads(done.stdout.splitlines()[-1])
    rows = [
        (
            n,
            *(f"{found[k][n]:.1f}" for k in ("took", "cpu_of")),
            *(f"{found[k].get(n, 0.0):.0f}" for k in ("most", "resident")),
        )
        for n in found["took"]
    ]
    title = f"{given.side:g} x {given.side:g} m, {given.share:.0%} built, voxels.memory={given.memory:g}"
    figures = {"s CPU": found["cpu"], "most MB": max(found["most"].values()), **found["sizes"]}
    figures["most resident MB"] = max(found["resident"].values())
    report(
        f"site_{given.share:g}",
        Outcome(title, ("stage", "s", "s CPU", "most MB", "resident MB"), rows, figures),
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""``python -m benchmarks.bench_io [--points N] [FORMAT ...]`` (``make bench-io``): reading and plain reading.

A survey of N points (default 20 million) is made by laying a simulated one on itself with 5 mm of noise and
written as LAS, LAZ, E57, PLY, PCD (binary, and compressed: ``pcdz``), text (XYZ, PTS, PTX) and recordings
(``bag`` of ROS 1, ``db3`` and ``mcap`` of ROS 2: a message of 28,800 points each, with transforms). Each is
read by the format's own library alone (all coordinates; Open3D for PLY, PCD, XYZ and PTS, numpy for PTX,
rosbags for recordings), then opened and planned by Floorcast, each in a process of its own: wall and CPU
seconds, MB a second, most memory.

A tenth of the points tells what grows with the file from what does not: the seconds of each further million
points, plainly read or read and integrated, and their ratio; and the seconds of the rest (opening the file,
planning the building, which depends on the building). Memory must not grow. The last column is what a
thousand million points would take.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.io_writers import BAGS, BLOCK, CLOUD, FORMATS, write
from benchmarks.record import Outcome
from benchmarks.record import report as keep

SMALL = Path(__file__).resolve().parents[1] / "resources" / "sample_survey"  # warms the kernels up
PROJECTED = 10**9
CLOCKS = {"seconds": "wall", "cpu": "CPU"}  # of a measurement; how they are called
WHOLE = (
    "      points      file     plain: wall     CPU       rate   memory"
    "   planned: wall     CPU       rate   memory (of a tenth)"
)
GROWTH = (
    "a million points more, s",
    "plain: wall",
    "CPU",
    "integrated: wall",
    "CPU",
    "ratio: wall",
    "CPU",
    "the rest: wall",
    "CPU",
    "1000 M: wall",
    "CPU",
)


def plain(path: Path) -> int:
    """All coordinates with the format's own library; returns how many points there were."""
    kind = path.suffix[1:]
    readers = {"las": _plain_las, "laz": _plain_las, "e57": _plain_e57, "ptx": _plain_ptx}
    readers |= dict.fromkeys(BAGS, _plain_bag)
    return readers.get(kind, _plain_by_open3d)(path)


def _plain_las(path: Path) -> int:
    import laspy

    total = 0
    with laspy.open(path) as file:
        for records in file.chunk_iterator(BLOCK):
            total += len(np.column_stack([records.x, records.y, records.z]))
    return total


def _plain_e57(path: Path) -> int:
    import pye57

    file = pye57.E57(str(path))
    total = 0
    for k in range(file.scan_count):
        scan = file.read_scan_raw(k)
        total += len(np.column_stack([scan[f"cartesian{a}"] for a in "XYZ"]))
    return total


def _plain_by_open3d(path: Path) -> int:
    import open3d as o3d

    return len(np.asarray(o3d.io.read_point_cloud(str(path), format=path.suffix[1:4]).points))


def _plain_ptx(path: Path) -> int:
    return len(np.loadtxt(path, skiprows=10, usecols=(0, 1, 2)))


def _plain_bag(path: Path) -> int:
    from rosbags.highlevel import AnyReader

    total = 0
    with AnyReader([path]) as reader:
        clouds = [c for c in reader.connections if c.msgtype == CLOUD]
        for connection, _, raw in reader.messages(clouds):
            message = reader.deserialize(raw, connection.msgtype)
            rows = message.data.view("<f4").reshape(-1, message.point_step // 4)
            total += len(np.ascontiguousarray(rows[:, :3]))
    return total


def planned(path: Path) -> tuple[int, float, float]:
    """Opened and planned by Floorcast: points, and wall and CPU seconds of the plan, after the last point."""
    from floorplan_core.pipeline import integrate_all, plan_storey
    from floorplan_core.plugins import default_registry
    from floorplan_core.readers import open_survey

    planner, took = integrate_all(open_survey(path, registry=default_registry(), colours=False))
    wall, cpu = time.perf_counter(), time.process_time()
    points = plan_storey(planner, 0, took).point_count
    return points, time.perf_counter() - wall, time.process_time() - cpu


def measure(path: Path, how: str) -> dict[str, float]:
    """One job in this process, after the kernels were loaded from their cache."""
    if how == "planned":
        planned(SMALL)
    wall, cpu = time.perf_counter(), time.process_time()
    points, *plan = planned(path) if how == "planned" else (plain(path), 0.0, 0.0)
    seconds, cpu = time.perf_counter() - wall, time.process_time() - cpu
    took = {"seconds": seconds, "cpu": cpu, "plan seconds": plan[0], "plan cpu": plan[1]}
    return {"points": points, "peak_mb": _peak_mb()} | took


def _peak_mb() -> float:
    """Most memory of this process (``ru_maxrss`` would count its parent's from before the start, too)."""
    status = Path("/proc/self/status").read_text()
    return int(status.partition("VmHWM:")[2].split()[0]) / 1024


def run_apart(path: Path, how: str, twice: bool = False) -> dict[str, float]:
    """:func:`measure` in a process of its own; RuntimeError with what it said where it fails.

    ``twice``: whatever took less of two runs; a small file takes seconds, which show what else is on.
    """
    if twice:
        runs = run_apart(path, how), run_apart(path, how)
        return {name: min(run[name] for run in runs) for name in runs[0]}
    command = [sys.executable, "-m", "benchmarks.bench_io", "--one", how, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{path.name}, {how}: ended with {done.returncode}.\n{done.stderr}")
    result: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return result


def bench(kind: str, count: int, folder: Path) -> dict[str, Any]:
    """One format at a tenth of the points and at all of them."""
    found: dict[str, Any] = {"format": kind}
    for name, points in (("tenth", count // 10), ("all", count)):
        path = folder / f"{name}.{kind}"
        write(path, points)
        files = [path] if path.is_file() else list(path.iterdir())
        found[name] = {how: run_apart(path, how, twice=name == "tenth") for how in ("plain", "planned")}
        if any(round(took["points"]) != points for took in found[name].values()):
            raise RuntimeError(f"{path.name}: not all of its {points:,} points were read.")
        found["mb"] = sum(file.stat().st_size for file in files) / 1e6
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    return found


def row(found: dict[str, Any]) -> str:
    """What the whole file took: one line of the table."""
    mb, small = found["mb"], found["tenth"]["planned"]["peak_mb"]
    text = f"{found['format']:<6}{found['all']['plain']['points'] / 1e6:6.1f}{mb:7.0f} MB"
    for took in (found["all"]["plain"], found["all"]["planned"]):
        text += f"{took['seconds']:14.1f} s {took['cpu']:6.1f} s"
        text += f"{mb / took['cpu']:6.0f} MB/s{took['peak_mb']:6.0f} MB"
    return f"{text} ({small:5.0f} MB)"


def growth(found: dict[str, Any], how: str, clock: str) -> tuple[float, float]:
    """Seconds of a million points more, and of what does not depend on them, by one of ``CLOCKS``."""
    small, large = found["tenth"][how], found["all"][how]
    grown = (large[clock] - large[f"plan {clock}"]) - (small[clock] - small[f"plan {clock}"])
    slope = grown / (large["points"] - small["points"]) * 1e6
    return slope, max(0.0, large[clock] - slope * large["points"] / 1e6)


def figures(found: dict[str, Any]) -> dict[str, float]:
    """What is kept of one format, by name."""
    out = {}
    for how in ("plain", "planned"):
        took, name = found["all"][how], f"{found['format']} {found['all'][how]['points'] / 1e6:g} M, {how}"
        out |= {f"{name}: s wall": took["seconds"], f"{name}: s CPU": took["cpu"]}
        out |= {f"{name}: most MB": took["peak_mb"]}
        for clock, word in CLOCKS.items():
            out[f"{name}: s {word} a million more"] = growth(found, how, clock)[0]
    return out


def growth_row(found: dict[str, Any]) -> list[str]:
    """One line of the second table: what grows with the points, what does not, and where that leads."""
    plain_, mine = ([growth(found, how, clock) for clock in CLOCKS] for how in ("plain", "planned"))
    pairs = [(ours[0], theirs[0]) for ours, theirs in zip(mine, plain_, strict=True)]
    return [
        found["format"],
        *(f"{slope:.3f}" for slope, _ in (*plain_, *mine)),
        *(f"{ours / theirs:.2f} x" if min(ours, theirs) > 0 else "too few points" for ours, theirs in pairs),
        *(f"{fixed:.1f}" for _, fixed in mine),
        *(f"{fixed + slope * PROJECTED / 1e6:.0f}" for slope, fixed in mine),
    ]


def is_one(arguments: list[str], measure: Callable[[Path, str], dict[str, float]]) -> bool:
    """Whether this is the process of one measurement (``run_apart``), whose figures it then tells."""
    if arguments[:1] != ["--one"]:
        return False
    print(json.dumps(measure(Path(arguments[2]), arguments[1])))
    return True


def parser_of(program: str, points: int, formats: Sequence[str]) -> argparse.ArgumentParser:
    """The command line: how many points, which formats."""
    parser = argparse.ArgumentParser(prog=f"python -m benchmarks.{program}")
    parser.add_argument("--points", type=lambda text: int(float(text)), default=points)
    parser.add_argument("formats", nargs="*", choices=[*formats, []])
    return parser


def main(arguments: list[str]) -> int:
    """The table; 2 for wrong use."""
    if is_one(arguments, measure):
        return 0
    given = parser_of("bench_io", 20_000_000, FORMATS).parse_args(arguments)
    print(WHOLE)
    kept: dict[str, float] = {}
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for kind in given.formats or FORMATS:
            found = bench(kind, given.points, Path(folder))
            kept |= figures(found)
            rows.append(growth_row(found))
            print(row(found), flush=True)
    keep("bench_io", Outcome("what grows with the points, from a tenth of them to all", GROWTH, rows, kept))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""``python -m benchmarks.bench_io [--points N] [FORMAT ...]`` (``make bench-io``): reading and plain reading.

A survey of N points (default 20 million) is made by laying a simulated one on itself with 5 mm of noise and
written as LAS, LAZ, E57, PLY, PCD (binary, and compressed: ``pcdz``) and text. Each is read by the format's
own library alone (all coordinates; Open3D for the last four), then opened and planned by Floorcast, each in a
process of its own: CPU seconds, MB a second, most memory.
A tenth of the points shows what grows with the file: time does, memory must not. The last columns project the
CPU of 100 million and of a thousand million points.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.record import Outcome
from benchmarks.record import report as keep

SMALL = Path(__file__).resolve().parents[1] / "resources" / "sample_survey"  # warms the kernels up
BLOCK = 1 << 20  # points that are written and read at a time
NOISE = 0.005  # m between two visits of one place
FORMATS = ("las", "laz", "e57", "ply", "pcd", "pcdz", "xyz")  # pcdz: compressed PCD
PROJECTED = (10**8, 10**9)


def blocks(count: int) -> Iterator[np.ndarray]:
    """(N, 3) float64 points of a simulated building, again and again with other noise, ``count`` in all."""
    from floorplan_core.simulation import BuildingSpec, SurveySpec, sensor_preset, simulate_survey

    building = BuildingSpec(style="l", rooms=12)
    points = simulate_survey(SurveySpec(building, sensor_preset("station"), seed=7)).points
    rng = np.random.default_rng(0)
    at = left = 0
    left = count
    while left > 0:
        rows = np.arange(at, at + min(BLOCK, left)) % len(points)
        yield points[rows] + rng.normal(0, NOISE, (len(rows), 3))
        at, left = at + len(rows), left - len(rows)


def write(path: Path, count: int) -> None:
    """Stream ``count`` points into ``path``."""
    writers = {
        "las": _write_las,
        "laz": _write_las,
        "e57": _write_e57,
        "ply": _write_ply,
        "pcd": _write_pcd,
        "pcdz": _write_pcdz,
        "xyz": _write_xyz,
    }
    writers[path.suffix[1:]](path, count)


def _write_las(path: Path, count: int) -> None:
    import laspy

    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales = np.full(3, 1e-3)
    with laspy.open(path, mode="w", header=header) as file:
        for block in blocks(count):
            record = laspy.ScaleAwarePointRecord.zeros(len(block), header=header)
            record.x, record.y, record.z = block.T
            file.write_points(record)


def _write_e57(path: Path, count: int) -> None:
    import pye57

    with pye57.E57(str(path), "w") as file:
        for block in blocks(count):
            file.write_scan_raw(
                {f"cartesian{a}": np.ascontiguousarray(block[:, k]) for k, a in enumerate("XYZ")}
            )


def _write_ply(path: Path, count: int) -> None:
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {count}"]
    head += [f"property float {axis}" for axis in "xyz"] + ["end_header", ""]
    _write_floats(path, head, count)


def _write_pcd(path: Path, count: int) -> None:
    head = ["VERSION .7", "FIELDS x y z", "SIZE 4 4 4", "TYPE F F F", "COUNT 1 1 1", f"WIDTH {count}"]
    head += ["HEIGHT 1", "VIEWPOINT 0 0 0 1 0 0 0", f"POINTS {count}", "DATA binary", ""]
    _write_floats(path, head, count)


def _write_floats(path: Path, head: list[str], count: int) -> None:
    with path.open("wb") as file:
        file.write("\n".join(head).encode())
        for block in blocks(count):
            file.write(block.astype("<f4").tobytes())


def _write_pcdz(path: Path, count: int) -> None:
    import open3d as o3d

    points = np.concatenate(list(blocks(count)))
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
    other = path.with_suffix(".pcd")
    o3d.io.write_point_cloud(str(other), cloud, compressed=True)
    other.rename(path)


def _write_xyz(path: Path, count: int) -> None:
    with path.open("w") as file:
        for block in blocks(count):
            file.write("".join(f"{x:.4f} {y:.4f} {z:.4f}\n" for x, y, z in block.tolist()))


def plain(path: Path) -> int:
    """All coordinates with the format's own library; returns how many points there were."""
    readers = {"las": _plain_las, "laz": _plain_las, "e57": _plain_e57}
    return readers.get(path.suffix[1:], _plain_by_open3d)(path)


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


def planned(path: Path) -> int:
    """Opened and planned by Floorcast."""
    from floorplan_core.pipeline import process
    from floorplan_core.plugins import default_registry
    from floorplan_core.readers import open_survey

    return process(open_survey(path, registry=default_registry(), colours=False)).point_count


def measure(path: Path, how: str) -> dict[str, float]:
    """One job in this process, after the kernels were loaded from their cache."""
    work = {"plain": plain, "planned": planned}[how]
    if how == "planned":
        planned(SMALL)
    wall, cpu = time.perf_counter(), time.process_time()
    points = work(path)
    seconds, cpu = time.perf_counter() - wall, time.process_time() - cpu
    return {"points": points, "seconds": seconds, "cpu": cpu, "peak_mb": _peak_mb()}


def _peak_mb() -> float:
    """Most memory of this process (``ru_maxrss`` would count its parent's from before the start, too)."""
    status = Path("/proc/self/status").read_text()
    return int(status.partition("VmHWM:")[2].split()[0]) / 1024


def run_apart(path: Path, how: str) -> dict[str, float]:
    """:func:`measure` in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.bench_io", "--one", how, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    result: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return result


def bench(kind: str, count: int, folder: Path) -> dict[str, Any]:
    """One format at a tenth of the points and at all of them."""
    found: dict[str, Any] = {"format": kind}
    for name, points in (("tenth", count // 10), ("all", count)):
        path = folder / f"{name}.{kind}"
        write(path, points)
        megabytes = path.stat().st_size / 1e6
        found[name] = {how: run_apart(path, how) for how in ("plain", "planned")} | {"mb": megabytes}
        path.unlink()
    return found


def row(found: dict[str, Any]) -> str:
    """One line of the table, with the projections."""
    small, large = found["tenth"]["planned"], found["all"]["planned"]
    slope = (large["cpu"] - small["cpu"]) / (large["points"] - small["points"])
    fixed = max(0.0, large["cpu"] - slope * large["points"])
    plain_ = found["all"]["plain"]
    slower = slope / max(
        (plain_["cpu"] - found["tenth"]["plain"]["cpu"]) / (large["points"] - small["points"]), 1e-12
    )
    ahead = "  ".join(f"{fixed + slope * n:7.0f} s" for n in PROJECTED)
    return (
        f"{found['format']:<6}{large['points'] / 1e6:7.1f} M {found['all']['mb']:8.0f} MB"
        f"{plain_['cpu']:9.1f} s {found['all']['mb'] / plain_['cpu']:7.0f} MB/s {plain_['peak_mb']:7.0f} MB"
        f"{large['cpu']:9.1f} s {found['all']['mb'] / large['cpu']:7.0f} MB/s {large['peak_mb']:7.0f} MB"
        f" (a tenth: {small['peak_mb']:5.0f} MB) {slower:5.1f} x   {ahead}"
    )


def figures(found: dict[str, Any]) -> dict[str, float]:
    """What is kept of one format, by name."""
    out = {}
    for how in ("plain", "planned"):
        name = f"{found['format']} {found['all']['planned']['points'] / 1e6:g} M, {how}"
        out[f"{name}: s CPU"], out[f"{name}: most MB"] = (
            found["all"][how]["cpu"],
            found["all"][how]["peak_mb"],
        )
    return out


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
    print(
        "       points      file   plain reading: CPU, rate, memory    opened and planned: CPU, rate, memory"
    )
    kept: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as folder:
        for kind in given.formats or FORMATS:
            found = bench(kind, given.points, Path(folder))
            kept |= figures(found)
            print(row(found), flush=True)
    keep("bench_io", Outcome("reading and planning beside plain reading", figures=kept))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

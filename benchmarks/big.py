"""``python -m benchmarks.big [--points N] [--keep FOLDER] [laz e57 ply]``: a cloud of 100 million points.

``--points 2e7`` is the short form; ``--dense`` only counts the voxels that ever more points fill.

A large office is simulated and every point is a ray cast of its own: tripod stations in each room and along
the corridors turn as often as it takes, each turn from another start angle and with its own errors. The
points are written station by station, so that making them needs the memory of one turn. As E57 each station
is a scan with its pose; as LAZ the cloud is merged, with GPS times and the stations as a trajectory beside
it; as PLY it is merged and carries the number of the station.

Each file, and one of a tenth of the points, is read by the format's own library alone and then planned as
``floorcast plan --no-pictures`` does, each in a process of its own: wall and CPU seconds, points and MB a
second, the most memory of the process and its children. From the growth between the two sizes follow the
figures of 1000 million points. What the plan is worth is measured against the simulated truth.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.bench_io import SMALL, is_one, parser_of, plain
from benchmarks.record import RESULTS, Outcome
from benchmarks.record import report as keep

FORMATS = ("laz", "e57", "ply")
RAYS = 900_000  # of one turn of the scanner: memory while the cloud is made
OFFICE = {"style": "grid", "rooms": 80}
FEW_ROOMS = {"style": "straight", "rooms": 2}  # what stands for it at higher densities
ASPECT, RETURNS = 2.4, 0.98  # columns by rows of a turn; share of its rays that come back
SEED, YAW = 5, 17.0
PROJECTED = 10**9
SURFEL_BYTES = 160  # of memory for each voxel that holds points: in the map, in the plan, in its stages
LOOK = 0.02  # s between two looks at the memory of a process
RESIDENT = ("VmRSS", "RssAnon", "RssFile")  # of /proc/self/status
Float = np.ndarray
Turn = tuple[np.ndarray, np.ndarray, int]  # (N, 3) points in the station's frame, its pose, its number


def turns(count: int, folder: Path, kind: Mapping[str, Any] = OFFICE) -> Iterator[Turn]:
    """``count`` ray casts, turn by turn; the truth and the stations go to ``folder``."""
    from floorplan_core.simulation import BuildingSpec, SurveySpec, sensor_preset
    from floorplan_core.simulation.architect import make_building
    from floorplan_core.simulation.files import tum_bytes
    from floorplan_core.simulation.poses import sensor_poses, world_from_building
    from floorplan_core.simulation.sensors import make_scene, scan
    from floorplan_core.simulation.truth import ground_truth
    from floorplan_core.simulation.walk import explore, floor_grid

    spec = SurveySpec(BuildingSpec(**kind), sensor_preset("station"), seed=SEED)
    rng = np.random.default_rng(SEED)
    building = make_building(spec.building, rng)
    walk = explore(building, floor_grid(building), 1.0, rng)
    poses, scene = sensor_poses(walk, spec, rng), make_scene(building)
    T_world_building = world_from_building(spec, YAW)
    truth = ground_truth(spec, building, walk, poses, T_world_building, YAW, scene)
    (folder / "truth.json").write_text(json.dumps(truth))
    T = T_world_building @ poses.T_building_sensor
    (folder / "stations.tum").write_bytes(tum_bytes(poses.stamps, T))
    shares = np.diff(np.linspace(0, count, len(T) + 1).astype(int))
    rows = max(8, round((min(RAYS, shares.max() / RETURNS) / ASPECT) ** 0.5))
    sensor = sensor_preset("station", rows=rows, columns=round(ASPECT * rows))
    for k, left in enumerate(shares.tolist()):
        while left > 0:
            points, _ = scan(scene, sensor, poses.T_building_sensor[k : k + 1], rng)
            if len(points) > left:
                points = points[np.sort(rng.permutation(len(points))[:left])]
            left -= len(points)
            yield points, T[k], k


@contextmanager
def laz_file(path: Path, count: int) -> Iterator[Callable[[Turn], None]]:
    """A merged cloud, millimetres, GPS time."""
    import laspy

    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales = np.full(3, 1e-3)
    seconds = np.loadtxt(path.parent / "stations.tum")[:, 0]
    with laspy.open(path, mode="w", header=header) as file:

        def write(turn: Turn) -> None:
            points, pose, k = turn
            record = laspy.ScaleAwarePointRecord.zeros(len(points), header=header)
            record.x, record.y, record.z = (points @ pose[:3, :3].T + pose[:3, 3]).T
            record.gps_time = np.full(len(points), seconds[k])
            file.write_points(record)

        yield write


@contextmanager
def e57_file(path: Path, count: int) -> Iterator[Callable[[Turn], None]]:
    """A scan for each station."""
    import pye57
    from scipy.spatial.transform import Rotation

    waiting: list[Turn] = []
    with pye57.E57(str(path), "w") as file:

        def flush() -> None:
            points, pose = np.concatenate([t[0] for t in waiting]), waiting[0][1]
            columns = {f"cartesian{a}": points[:, k].astype(np.float64) for k, a in enumerate("XYZ")}
            x, y, z, w = Rotation.from_matrix(pose[:3, :3]).as_quat()
            file.write_scan_raw(columns, rotation=np.array([w, x, y, z]), translation=pose[:3, 3])
            waiting.clear()

        def write(turn: Turn) -> None:
            if waiting and turn[2] != waiting[0][2]:
                flush()
            waiting.append(turn)

        yield write
        flush()


@contextmanager
def ply_file(path: Path, count: int) -> Iterator[Callable[[Turn], None]]:
    """A merged cloud with ``scan_id``, 16 bytes a point."""
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {count}"]
    head += [f"property float {axis}" for axis in "xyz"] + ["property int scan_id", "end_header", ""]
    with path.open("wb") as file:
        file.write("\n".join(head).encode())

        def write(turn: Turn) -> None:
            points, pose, k = turn
            record = np.empty(len(points), dtype=[("xyz", "<f4", 3), ("scan_id", "<i4")])
            record["xyz"], record["scan_id"] = points @ pose[:3, :3].T + pose[:3, 3], k
            file.write(record.tobytes())

        yield write


WRITERS = {"laz": laz_file, "e57": e57_file, "ply": ply_file}


def make(folder: Path, kinds: Sequence[str], count: int) -> None:
    """The cloud of ``count`` points in all formats in which it is not there yet."""
    folder.mkdir(parents=True, exist_ok=True)
    missing = [path for path in (cloud(folder, kind, count) for kind in kinds) if not path.exists()]
    if not missing:
        return
    stream = turns(count, folder)
    first = next(stream)  # leaves the stations, which the writers ask for
    with ExitStack() as files:
        writers = [files.enter_context(WRITERS[path.suffix[1:]](path, count)) for path in missing]
        for turn in chain([first], stream):
            for write in writers:
                write(turn)


def cloud(folder: Path, kind: str, count: int) -> Path:
    """Where the cloud is."""
    return folder / f"big-{count / 1e6:g}M.{kind}"


def trajectory_of(path: Path) -> Path | None:
    """The stations, for formats that do not hold them."""
    return None if path.suffix == ".e57" else path.parent / "stations.tum"


def read_plainly(path: Path) -> None:
    """All coordinates with the format's own library."""
    if path.suffix == ".ply":
        with path.open("rb") as file:  # no library reads it by pieces
            while file.read(1 << 22):
                pass
    else:
        plain(path)


def plan(path: Path) -> None:
    """``floorcast plan`` without pictures into a folder beside the file; the kernels are loaded before."""
    from floorplan_core.cli.main import run as floorcast

    given = trajectory_of(path)
    arguments = [] if given is None else ["--trajectory", str(given)]
    out = path.with_name(path.name + ".plan")
    status = floorcast(["plan", str(path), *arguments, "--out", str(out), "--no-pictures", "--quiet"])
    if status:
        raise SystemExit(status)


def measure(path: Path, how: str) -> dict[str, float]:
    """One job in this process."""
    if how == "plan":
        from floorplan_core.pipeline import process
        from floorplan_core.readers import open_survey

        process(open_survey(SMALL))
    wall, cpu = time.perf_counter(), _cpu()
    {"plain": read_plainly, "plan": plan}[how](path)
    return {"seconds": time.perf_counter() - wall, "cpu": _cpu() - cpu}


def _cpu() -> float:
    """CPU seconds of this process and of its children that ended."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(u.ru_utime + u.ru_stime for u in used)


def run_apart(path: Path, how: str) -> dict[str, float]:
    """:func:`measure` in a process of its own, whose memory is watched with that of its children."""
    command = [sys.executable, "-m", "benchmarks.big", "--one", how, str(path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
        most = np.zeros(3)
        while child.poll() is None:
            most = np.maximum(most, _memory(child.pid))
            time.sleep(LOOK)
        output = child.stdout.read() if child.stdout else ""
    if child.returncode:
        raise SystemExit(child.returncode)
    found: dict[str, float] = json.loads(output.splitlines()[-1])
    return found | dict(zip(("peak_mb", "own_mb", "file_mb"), most.tolist(), strict=True))


def _memory(pid: int) -> Float:
    """MB of a process and all below it: resident, of that its own, and of that pages of files.

    What several processes share is counted for each. Pages of files (libraries, surfels that went to disk)
    are taken back by the system when it needs them; its own are what a computer must have.
    """
    total, waiting = np.zeros(3), [pid]
    while waiting:
        each = waiting.pop()
        try:
            status = Path(f"/proc/{each}/status").read_text()
            waiting += [
                int(c)
                for t in Path(f"/proc/{each}/task").iterdir()
                for c in (t / "children").read_text().split()
            ]
        except (OSError, ValueError):
            continue
        if "VmRSS:" in status:  # a process that just ended has none
            total += [int(status.partition(f"{name}:")[2].split()[0]) / 1024 for name in RESIDENT]
    return total


def bench(folder: Path, kind: str, count: int) -> dict[str, Any]:
    """One format at a tenth of the points and at all of them."""
    found: dict[str, Any] = {"format": kind}
    for points in (count // 10, count):
        path = cloud(folder, kind, points)
        found[str(points)] = {
            "points": points,
            "mb": path.stat().st_size / 1e6,
            "plain": run_apart(path, "plain"),
            "plan": run_apart(path, "plan"),
            "worth": worth(path),
        }
    return found


def worth(path: Path) -> str:
    """The plan against the truth, in one line."""
    from floorplan_core.evaluation import evaluate

    return evaluate(path.with_name(path.name + ".plan"), path.parent / "truth.json").summary()


def figures(found: dict[str, Any], count: int) -> dict[str, float]:
    """What is kept of one format, by name."""
    kind, out = found["format"], {}
    for points in (count // 10, count):
        at = found[str(points)]
        for how in ("plain", "plan"):
            name = f"{kind} {points / 1e6:g} M, {how}"
            out[f"{name}: s CPU"], out[f"{name}: most MB"] = at[how]["cpu"], at[how]["peak_mb"]
            out[f"{name}: s wall"], out[f"{name}: own MB"] = at[how]["seconds"], at[how]["own_mb"]
    return out


def saturation(densities: Sequence[int]) -> Outcome:
    """How many voxels the points fill, at the density of so many points in the whole office.

    A few rooms are scanned as densely.
    """
    from floorplan_core.geometry.ray_carving import MissMap
    from floorplan_core.geometry.surfel_map import SurfelMap

    rows: list[tuple[float, float, int, int]] = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        next(turns(RAYS, folder))
        office = _area(folder / "truth.json")
        next(turns(RAYS, folder, FEW_ROOMS))
        area = _area(folder / "truth.json")
        for density in densities:
            surfels, rays, count = SurfelMap(0.05), MissMap(0.1), round(density * area / office)
            for points, pose, _ in turns(count, folder, FEW_ROOMS):
                world = points @ pose[:3, :3].T + pose[:3, 3]
                near = np.zeros(len(world), dtype=np.int32), pose[None, :3, 3].copy(), (0.05, 30.0)
                surfels.insert(world, *near)
                rays.carve(world, *near)
            rows.append((density / 1e6, count / 1e6, len(surfels), rays.blocks))
    header = ("M points of the office", "M points here", "surfels", "blocks of rays")
    found = {f"surfels a m2 at {row[0]:g} M": row[2] / area for row in rows}
    return Outcome(f"voxels that points fill in {area:.0f} m2, by their density", header, rows, found)


def _area(truth: Path) -> float:
    """m2 of the rooms that were entered."""
    from shapely.geometry import Polygon

    rooms = json.loads(truth.read_text())["rooms"]
    return sum(Polygon(room["polygon"]).area for room in rooms if room["entered"])


def report(found: dict[str, Any], count: int, area: float) -> Iterator[str]:
    """The lines of one format."""
    small, large = found[str(count // 10)], found[str(count)]
    for at in (small, large):
        for how in ("plain", "plan"):
            m, points = at[how], at["points"] / 1e6
            yield (
                f"{found['format']:<5}{points:8.1f} M {at['mb']:7.0f} MB  {how:<6}{m['seconds']:8.1f} s wall "
                f"{m['cpu']:8.1f} s CPU {at['mb'] / m['seconds']:6.0f} MB/s {points / m['seconds']:7.2f} M "
                f"points/s {m['peak_mb']:7.0f} MB, its own {m['own_mb']:5.0f}"
            )
    yield f"      {large['worth']}"
    millions = (large["points"] - small["points"]) / 1e6
    more = (PROJECTED - large["points"]) / 1e6
    reads, plans = ((large[how]["cpu"] - small[how]["cpu"]) / millions for how in ("plain", "plan"))
    yield (
        f"      each further million points: {reads:.3f} s CPU to read, {plans:.3f} s to plan "
        f"({plans / max(reads, 1e-9):.1f} times)"
    )
    yield (
        f"      1000 M points: {large['plain']['cpu'] + more * reads:.0f} s CPU to read, "
        f"{large['plan']['cpu'] + more * plans:.0f} s to plan, "
        f"{large['plan']['peak_mb'] + further_surfels(count, area) * SURFEL_BYTES / 1e6:.0f} MB "
        "(more voxels near surfaces are filled: --dense)"
    )


def further_surfels(count: int, area: float) -> float:
    """How many more voxels 1000 million points fill than ``count`` do, by the last run of ``--dense``."""
    path = RESULTS / "big_dense.json"
    kept = json.loads(path.read_text())["figures"] if path.exists() else {}
    density = sorted((float(name.split()[-2]), value) for name, value in kept.items())
    if not density:
        return 0.0
    points, filled = np.log([d[0] for d in density]), [d[1] for d in density]
    ends = np.interp(np.log([count / 1e6, PROJECTED / 1e6]), points, filled)
    return float((ends[1] - ends[0]) * area)


def main(arguments: list[str]) -> int:
    """The tables; 2 for wrong use."""
    if is_one(arguments, measure):
        return 0
    parser = parser_of("big", 10**8, FORMATS)
    parser.add_argument("--keep", type=Path, help="folder that keeps the clouds for the next time")
    parser.add_argument("--dense", action="store_true", help="only: voxels filled at growing densities")
    given = parser.parse_args(arguments)
    count = given.points
    print(f"load of the machine: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores", flush=True)
    if given.dense:
        keep("big_dense", saturation([count // 100, count // 30, count // 10, count // 3, count]))
        return 0
    kinds, kept = given.formats or FORMATS[:2], dict[str, float]()
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.keep or Path(temporary)
        for points in (count // 10, count):
            make(folder, kinds, points)
        for kind in kinds:
            found = bench(folder, kind, count)
            kept |= figures(found, count)
            for line in report(found, count, _area(folder / "truth.json")):
                print(line, flush=True)
    path = RESULTS / "big.json"
    before = json.loads(path.read_text())["figures"] if path.exists() else {}  # of other formats and sizes
    keep("big", Outcome("clouds of one office, read plainly and planned", figures=before | kept))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

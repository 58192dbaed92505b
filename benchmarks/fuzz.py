"""``python -m benchmarks.fuzz [FORMAT ...]`` (``make fuzz``): damaged files of every format.

Each format is written by its own library, then cut at 50 places, with one to four bytes changed at 500 (half
of them in its head), and with every number of its head made absurd (10^12, 2^31 - 1, 2^32 - 1). A process of
its own reads all versions of one format as the command line does. Allowed is a survey, or an error of ours
in one sentence. Counted are crashes, other exceptions, sentences that are none, more than ``SLOW``
seconds for one, and memory of more than ``MEMORY`` above that of the good file.
"""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

TESTS = Path(__file__).resolve().parents[1] / "tests"
CUTS, FLIPS, HEAD = 50, 500, 512
ABSURD = (10**12, 2**31 - 1, 2**32 - 1)
SLOW = 20  # seconds
MEMORY = 200 << 20  # bytes
MOST_POINTS = 3_000_000  # of a damaged file that are read: a mesh a kilometre wide is no error
WHOLE_RUN = 1200  # seconds for one format

Write = Callable[[Path], Path]


def writers() -> dict[str, Write]:
    """For each format, what writes a small good file into a folder. The tests' own writers."""
    sys.path += [str(TESTS / "plugins"), str(TESTS / "readers")]  # as pytest has it
    import test_carmen
    import test_e57
    import test_las
    import test_mesh
    import test_octomap
    import test_reader_ptx
    import test_rosbag

    from tests.readers.reader_clouds import path_in_room, room, write_pcd, write_ply, write_tum, xyz_columns

    cloud = room(np.random.default_rng(1), density=8)
    columns = xyz_columns(cloud)
    halves = list(enumerate(np.array_split(cloud, 2)))
    leaves = test_octomap.random_leaves(np.random.default_rng(2))
    made: dict[str, Write] = {
        f"ply-{form}": lambda d, form=form: write_ply(d / "a.ply", form, columns)
        for form in ("ascii", "binary_little_endian", "binary_big_endian")
    }
    made |= {
        f"pcd-{kind}": lambda d, kind=kind: write_pcd(d / "a.pcd", kind, columns)
        for kind in ("ascii", "binary", "binary_compressed")
    }
    made |= {
        f"mesh-{kind}": lambda d, kind=kind: test_mesh.write_mesh(d / f"a.{kind}", test_mesh.box())
        for kind in ("obj", "stl", "glb", "gltf", "off", "ply")
    }
    made |= {
        f"ros-{form}": lambda d, form=form: test_rosbag.write_recording(d, form, _small_run)
        for form in ("bag", "mcap", "db3")
    }
    made |= {
        "las": lambda d: test_las.write_las(d / "a.las", cloud),
        "laz": lambda d: test_las.write_las(d / "a.laz", cloud),
        "e57": lambda d: test_e57.write_e57(d / "a.e57", np.array_split(cloud, 3)),
        "e57-spherical": lambda d: test_e57.write_spherical(d / "a.e57", cloud - cloud.mean(axis=0)),
        "octomap-bt": lambda d: test_octomap.write_bt(d / "a.bt", leaves),
        "octomap-ot": lambda d: test_octomap.write_ot(d / "a.ot", leaves),
        "carmen": lambda d: test_carmen.write_log(d / "a.log", beams=91),
        "carmen-gz": lambda d: test_carmen.write_log(d / "a.log.gz", beams=91),
        "xyz": lambda d: _text(d / "a.xyz", cloud),
        "ptx": lambda d: test_reader_ptx.write(
            d / "a.ptx", *(test_reader_ptx.scan_text(p, test_reader_ptx.station(k)) for k, p in halves)
        ),
        "npy": lambda d: _saved(d / "a.npy", lambda p: np.save(p, cloud)),
        "npz": lambda d: _saved(d / "a.npz", lambda p: np.savez_compressed(p, points=cloud)),
        "tum": lambda d: write_tum(d / "a.tum", path_in_room()),
        "map-yaml": _map,
        "map-png": lambda d: _picture(d / "a.png"),
        "floorplan": _plan,
        "project": _project,
        "geojson": _geojson,
        "ifc": _ifc,
    }
    return made


def _small_run(messages: Any) -> Iterator[Any]:
    import test_rosbag as t

    for k, (T, part) in enumerate(zip(t.poses(), t.parts(2.0), strict=True)):
        yield "/odom", t.START + k, messages.odometry(T, t.START + k, "odom", "lidar")
        yield "/points", t.START + k, messages.cloud(t.local(part, T), t.START + k)


def _text(path: Path, cloud: np.ndarray) -> Path:
    np.savetxt(path, cloud, fmt="%.4f")
    return path


def _saved(path: Path, save: Callable[[Path], None]) -> Path:
    save(path)
    return path


def _picture(path: Path) -> Path:
    from tests.grid_map.map_drawings import office, write_image

    return write_image(office(), path)


def _map(folder: Path) -> Path:
    from tests.grid_map.map_drawings import office, write_yaml

    return write_yaml(office(), folder)


def _plan(folder: Path) -> Path:
    from floorplan_core import intermediates
    from tests.factories import small_flat

    path = folder / "a.floorplan"
    intermediates.save(small_flat(), path)
    return path


def _project(folder: Path) -> Path:
    from floorplan_core.project_file import Project, save

    (folder / "a.ply").write_bytes(b"ply")
    path = folder / "a.floorcast"
    save(path, Project(survey=(folder / "a.ply", None, ""), names=(("r1", "Office", "room"),)), b"PNG")
    return path


def _geojson(folder: Path) -> Path:
    from floorplan_core.exporters.geojson import GeoJsonExporter
    from tests.factories import small_flat

    path = folder / "plan.geojson"
    GeoJsonExporter().write(small_flat(), path)
    return path


def _ifc(folder: Path) -> Path:
    from tests.evaluation.ifc_cases import write_house

    return write_house(folder / "a.ifc")


def read(path: Path, kind: str) -> None:
    """Read everything in ``path``, as the program does."""
    if kind == "tum":
        from floorplan_core.readers.trajectory import read_trajectory

        read_trajectory(path)
    elif kind.startswith("map"):
        from floorplan_core.readers.grid_map import read_grid_map

        read_grid_map(path, 0.05 if kind == "map-png" else None)
    elif kind == "floorplan":
        from floorplan_core import intermediates
        from floorplan_core.model import FloorPlan

        intermediates.load(path, FloorPlan)
    elif kind == "project":
        from floorplan_core import project_file

        project_file.load(path)
        project_file.read_thumbnail(path)
    elif kind == "geojson":
        from floorplan_core.evaluation.plan_file import read_plan

        read_plan(path)
    elif kind == "ifc":
        from floorplan_core.evaluation import load_truth

        load_truth(path)
    else:
        _read_survey(path)


def _read_survey(path: Path) -> None:
    from floorplan_core.plugins import default_registry
    from floorplan_core.readers import open_survey

    total = 0
    for chunk in open_survey(path, registry=default_registry()).chunks():
        total += len(chunk.points)
        if total > MOST_POINTS:
            break
    failures = default_registry().failures()
    assert not failures, failures[0]


def damaged(data: bytes, rng: np.random.Generator) -> Iterator[tuple[str, bytes]]:
    """Every damaged version with the name of its damage."""
    for cut in np.unique(np.linspace(0, len(data) - 1, CUTS).astype(int)).tolist():
        yield f"cut at {cut}", data[:cut]
    for number in range(FLIPS):
        changed = bytearray(data)
        last = min(HEAD, len(data)) if number % 2 else len(data)
        for _ in range(int(rng.integers(1, 5))):
            changed[int(rng.integers(0, last))] ^= int(rng.integers(1, 256))
        yield f"flip {number}", bytes(changed)
    for at in range(0, min(HEAD, len(data) - 8), 4):
        for size, value in ((4, ABSURD[1]), (4, ABSURD[2]), (8, ABSURD[0])):
            word = value.to_bytes(size, "little")
            yield f"{value} at {at}", data[:at] + word + data[at + size :]
    for match in re.finditer(rb"\d+", data[:HEAD]):
        yield f"10^12 at {match.start()}", data[: match.start()] + b"%d" % ABSURD[0] + data[match.end() :]


def fuzz(kind: str) -> dict[str, Any]:
    """All damaged versions of one format, in this process."""
    from floorplan_core.errors import FloorPlanError

    made = writers()
    from plugin_files import peak_memory

    result: dict[str, Any] = {"versions": 0, "refused": 0, "bad": [], "memory_mb": 0.0, "slowest_s": 0.0}
    signal.signal(signal.SIGALRM, _too_slow)
    with tempfile.TemporaryDirectory() as folder:
        path = made[kind](Path(folder))
        data = path.read_bytes()
        read(path, kind)
        for name, version in damaged(data, np.random.default_rng(5)):
            path.write_bytes(version)
            before, began = peak_memory(reset=True), time.perf_counter()
            signal.alarm(SLOW)
            try:
                read(path, kind)
            except FloorPlanError as error:
                result["refused"] += 1
                if "\n" in str(error) or not str(error).endswith((".", "…")):
                    result["bad"].append(f"{name}: no sentence: {error}")
            except BaseException as error:  # noqa: BLE001 - that is what we look for
                result["bad"].append(f"{name}: {type(error).__name__}: {str(error)[:200]}")
            signal.alarm(0)
            result["versions"] += 1
            result["slowest_s"] = max(result["slowest_s"], round(time.perf_counter() - began, 2))
            above = peak_memory() - before
            if above > MEMORY:
                result["bad"].append(f"{name}: {above >> 20} MB more than before")
            result["memory_mb"] = max(result["memory_mb"], round(above / 2**20, 1))
    return result


def _too_slow(*_: object) -> None:
    raise TimeoutError(f"more than {SLOW} s")


def main(arguments: list[str]) -> int:
    """Every format in a process of its own; 1 where anything bad was seen, 2 for wrong use."""
    if arguments[:1] == ["--one"]:
        print(json.dumps(fuzz(arguments[1])))
        return 0
    formats = list(writers())
    if unknown := [kind for kind in arguments if kind not in formats]:
        print(f"There is no format {unknown[0]}; choose from: {', '.join(formats)}.", file=sys.stderr)
        return 2
    bad = 0
    print(f"{'format':<24}{'versions':>9}{'refused':>9}{'MB more':>9}{'slowest':>9}  what was bad")
    for kind in arguments or formats:
        command = [sys.executable, "-m", "benchmarks.fuzz", "--one", kind]
        done = subprocess.run(command, capture_output=True, text=True, timeout=WHOLE_RUN, check=False)
        if done.returncode:
            bad += 1
            print(f"{kind:<24} the process ended with {done.returncode}: {done.stderr.strip()[-300:]}")
            continue
        result = json.loads(done.stdout.splitlines()[-1])
        bad += len(result["bad"])
        print(
            f"{kind:<24}{result['versions']:>9}{result['refused']:>9}{result['memory_mb']:>9}"
            f"{result['slowest_s']:>8}s  {len(result['bad'])}"
        )
        for line in result["bad"][:5]:
            print(f"    {line}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Large files of a simulated building in many formats, block by block (for :mod:`benchmarks.bench_io`).

A survey is laid on itself again and again, each time with other noise. Clouds have no viewpoints; recordings
of robots hold the scans of a lidar, a message each, and the transforms that place them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

BLOCK = 1 << 20  # points that are written and read at a time
NOISE = 0.005  # m between two visits of one place
BEAMS = {"columns": 1800, "rows": 16, "dropout": 0.0, "interval": 1.0}  # a usual lidar: 28,800 points a turn
BAGS = ("bag", "db3", "mcap")
MOST = 10_000_000  # points of one lap of the lidar
START, LAP = 1_700_000_000, 10_000  # s: a recording begins, and goes through the building again
CLOUD, TF = "sensor_msgs/msg/PointCloud2", "tf2_msgs/msg/TFMessage"


def simulated(sensor: str, settings: dict[str, float], **spec: Any) -> Any:
    """The survey of a small office."""
    from floorplan_core.simulation import BuildingSpec, SurveySpec, sensor_preset, simulate_survey

    building = BuildingSpec(style="l", rooms=12)
    return simulate_survey(SurveySpec(building, sensor_preset(sensor, **settings), seed=7, **spec))


def blocks(count: int) -> Iterator[np.ndarray]:
    """(N, 3) float64 points of the building, again and again with other noise, ``count`` in all."""
    points = simulated("station", {}).points
    rng = np.random.default_rng(0)
    for at in range(0, count, BLOCK):
        rows = np.arange(at, min(at + BLOCK, count)) % len(points)
        yield points[rows] + rng.normal(0, NOISE, (len(rows), 3))


def scans(count: int) -> Iterator[tuple[float, np.ndarray, np.ndarray]]:
    """Seconds, (4, 4) pose and (N, 3) float32 points in the sensor's frame of each turn of a lidar."""
    survey = simulated("lidar", BEAMS, thin=0.0, max_points=MOST)
    ends = np.searchsorted(survey.scan_id, np.arange(len(survey.stamps) + 1))
    rng = np.random.default_rng(0)
    number = 0
    while count > 0:
        lap, k = divmod(number, len(survey.stamps))
        seen, pose = survey.points[ends[k] : ends[k + 1]][:count], survey.trajectory[k]
        noisy = seen + rng.normal(0, NOISE, seen.shape)
        yield (
            START + LAP * lap + float(survey.stamps[k] - survey.stamps[0]),
            pose,
            ((noisy - pose[:3, 3]) @ pose[:3, :3]).astype("<f4"),
        )
        number, count = number + 1, count - len(seen)


def write(path: Path, count: int) -> None:
    """Stream ``count`` points into ``path``; its suffix tells the format."""
    _WRITERS[path.suffix[1:]](path, count)


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
    _write_lines(path, "", "%.4f %.4f %.4f\n", count)


def _write_pts(path: Path, count: int) -> None:
    _write_lines(path, f"{count}\n", "%.4f %.4f %.4f -1024 90 120 150\n", count)


def _write_ptx(path: Path, count: int) -> None:
    """One scan of columns of at most 1000 points, whose sensor stood at its origin."""
    rows = math.gcd(count, 1000)
    unit = ("1 0 0", "0 1 0", "0 0 1")
    head = [f"{count // rows}", f"{rows}", "0 0 0", *unit, *(f"{row} 0" for row in unit), "0 0 0 1", ""]
    _write_lines(path, "\n".join(head), "%.4f %.4f %.4f 0.5\n", count)


def _write_lines(path: Path, head: str, line: str, count: int) -> None:
    with path.open("w") as file:
        file.write(head)
        for block in blocks(count):
            file.write(line * len(block) % tuple(block.ravel().tolist()))


def _write_bag(path: Path, count: int) -> None:
    """A bag of ROS 1, or the folder of ROS 2 with its storage."""
    from rosbags.rosbag1 import Writer as Writer1
    from rosbags.rosbag2 import StoragePlugin
    from rosbags.rosbag2 import Writer as Writer2
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    first = path.suffix == ".bag"
    store = get_typestore(Stores.ROS1_NOETIC if first else Stores.ROS2_HUMBLE)
    if first:
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TF))
    storage = StoragePlugin.MCAP if path.suffix == ".mcap" else StoragePlugin.SQLITE3
    writer = Writer1(path) if first else Writer2(path, version=9, storage_plugin=storage)
    with writer:
        clouds = writer.add_connection("/points", CLOUD, typestore=store)
        places = writer.add_connection("/tf", TF, typestore=store)
        pack = store.serialize_ros1 if first else store.serialize_cdr
        for seconds, pose, points in scans(count):
            header = _header(store, first, seconds)
            for connection, message in (
                (places, _transform(store, header("map"), pose)),
                (clouds, _cloud(store, header("lidar"), points)),
            ):
                writer.write(connection, round(1e9 * seconds), bytes(pack(message, connection.msgtype)))


def _header(store: Any, first: bool, seconds: float) -> Callable[[str], Any]:
    """Makes headers of that time; those of ROS 1 count."""
    stamp = store.types["builtin_interfaces/msg/Time"](int(seconds), round(seconds % 1 * 1e9))
    return lambda frame: store.types["std_msgs/msg/Header"](*([0] if first else []), stamp, frame)


def _transform(store: Any, header: Any, pose: np.ndarray) -> Any:
    """The lidar in the map."""
    from scipy.spatial.transform import Rotation

    make = {name: store.types[f"geometry_msgs/msg/{name}"] for name in ("Vector3", "Quaternion", "Transform")}
    turn = make["Quaternion"](*Rotation.from_matrix(pose[:3, :3]).as_quat())
    placed = make["Transform"](make["Vector3"](*pose[:3, 3]), turn)
    return store.types[TF]([store.types["geometry_msgs/msg/TransformStamped"](header, "lidar", placed)])


def _cloud(store: Any, header: Any, points: np.ndarray) -> Any:
    """x, y, z and an intensity, 16 bytes a point."""
    field = store.types["sensor_msgs/msg/PointField"]
    fields = [field(name, 4 * k, 7, 1) for k, name in enumerate(("x", "y", "z", "intensity"))]
    rows = np.concatenate([points, np.ones((len(points), 1), "<f4")], axis=1)
    data = np.frombuffer(rows.tobytes(), np.uint8)
    return store.types[CLOUD](header, 1, len(rows), fields, False, 16, len(data), data, True)


_WRITERS = {
    "las": _write_las,
    "laz": _write_las,
    "e57": _write_e57,
    "ply": _write_ply,
    "pcd": _write_pcd,
    "pcdz": _write_pcdz,
    "xyz": _write_xyz,
    "pts": _write_pts,
    "ptx": _write_ptx,
    **dict.fromkeys(BAGS, _write_bag),
}
FORMATS = tuple(_WRITERS)  # pcdz: compressed PCD

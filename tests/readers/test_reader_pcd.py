"""PCD: the three storages, other field types, the viewpoint, and our decoder beside Open3D's encoder."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.geometry.scratch import disk_array
from floorplan_core.readers import open_survey, pcd
from floorplan_core.readers.source import ScanIds
from tests.readers.reader_clouds import all_points, room, write_pcd, xyz_columns

AS_IT_IS = InputConfig(unit="m", up="z")
STORAGES = ("ascii", "binary", "binary_compressed")


@pytest.fixture
def cloud():
    return room(np.random.default_rng(3), density=15)


@pytest.mark.parametrize("storage", STORAGES)
@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_round_trip(tmp_path, cloud, storage, dtype):
    n = len(cloud)
    columns = {"intensity": np.zeros(n, "u2")} | xyz_columns(cloud, dtype, scan_id=np.arange(n, dtype="u4"))
    points, ids = all_points(open_survey(write_pcd(tmp_path / "a.pcd", storage, columns), config=AS_IT_IS))
    np.testing.assert_allclose(points, cloud, atol=1e-5)
    np.testing.assert_array_equal(ids, np.arange(n))


@pytest.mark.parametrize("ids", [np.arange, lambda n, dtype: np.arange(n, dtype=dtype)[::-1]])
def test_a_large_compressed_file_is_unpacked_on_disk(tmp_path, cloud, ids, monkeypatch):
    columns = xyz_columns(cloud, "f4", scan_id=np.ascontiguousarray(ids(len(cloud), dtype="u4")))
    path = write_pcd(tmp_path / "a.pcd", "binary_compressed", columns)
    made: list[tuple[int, ...]] = []
    monkeypatch.setattr(pcd, "CHUNK_POINTS", 100)
    small = pcd.pcd_source(path)
    usual = list(small.chunks())
    monkeypatch.setattr(pcd, "KEPT_BYTES", 64)
    monkeypatch.setattr(pcd, "disk_array", lambda shape, kind: made.append(shape) or disk_array(shape, kind))
    large = pcd.pcd_source(path)
    for _ in range(2):
        for a, b in zip(usual, large.chunks(), strict=True):
            assert a.points.tobytes() == b.points.tobytes()
            assert a.scan_id.tobytes() == b.scan_id.tobytes()
    assert made == [(16 * len(cloud),)]  # once, for two passes
    assert large.scan_ids == small.scan_ids == ScanIds(0, len(cloud) - 1, ids is np.arange)


def test_fields_with_counts_and_padding(tmp_path, cloud):
    n = len(cloud)
    rows = np.zeros(n, dtype=[("a", "<f4", 33), ("p", "<f4", 3), ("_", "u1", 4), ("b", "u1")])
    rows["p"] = cloud
    head = (
        "VERSION 0.7\nFIELDS fpfh x y z _ label\nSIZE 4 4 4 4 1 1\nTYPE F F F F U U\nCOUNT 33 1 1 1 4 1\n"
        f"WIDTH {n}\nHEIGHT 1\nPOINTS {n}\nDATA binary\n"
    ).encode()
    path = tmp_path / "a.pcd"
    path.write_bytes(head + rows.tobytes())
    np.testing.assert_allclose(all_points(open_survey(path, config=AS_IT_IS))[0], cloud, atol=1e-5)


@pytest.mark.parametrize("ascii_", [True, False])
@pytest.mark.parametrize("compressed", [True, False])
def test_files_of_open3d(tmp_path, cloud, ascii_, compressed):
    open3d = pytest.importorskip("open3d")
    path = tmp_path / "o3d.pcd"
    tidy = np.round(cloud, 1)  # repeats itself, so that the encoder finds copies to make
    written = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(tidy))
    assert open3d.io.write_point_cloud(str(path), written, write_ascii=ascii_, compressed=compressed)
    np.testing.assert_allclose(all_points(open_survey(path, config=AS_IT_IS))[0], tidy, atol=1e-5)


def test_the_viewpoint_is_the_sensor(tmp_path, cloud):
    path = write_pcd(tmp_path / "a.pcd", "binary", xyz_columns(cloud), viewpoint="4 2 1.2 0.7071 0 0 0.7071")
    survey = open_survey(path, config=AS_IT_IS)
    assert survey.trajectory is not None
    np.testing.assert_allclose(survey.trajectory.origins, [[4, 2, 1.2]])
    np.testing.assert_allclose(survey.trajectory.T_world_sensor[0, :3, 0], [0, 1, 0], atol=1e-4)
    points, ids = all_points(survey)
    np.testing.assert_allclose(points, cloud, atol=1e-5)
    assert set(ids.tolist()) == {0}


def test_the_default_viewpoint_says_nothing(tmp_path, cloud):
    survey = open_survey(write_pcd(tmp_path / "a.pcd", "binary", xyz_columns(cloud)))
    assert survey.trajectory is None


@pytest.mark.parametrize("storage", STORAGES)
def test_truncated(tmp_path, cloud, storage):
    path = write_pcd(tmp_path / "cut.pcd", storage, xyz_columns(cloud))
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    with pytest.raises(InputError, match=r"cut.pcd is truncated.*promise"):
        open_survey(path)


@pytest.mark.parametrize("storage", STORAGES)
def test_absurd_count(tmp_path, cloud, storage):
    path = write_pcd(tmp_path / "huge.pcd", storage, xyz_columns(cloud), points=10**12)
    with pytest.raises(InputError, match="1,000,000,000,000 points"):
        open_survey(path)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (b"FIELDS x y z", b"FIELDS a b c", "no coordinates"),
        (b"TYPE F F F", b"TYPE F F Q", "FIELDS, SIZE, TYPE"),
        (b"SIZE 4 4 4", b"SIZE 4 4 3", "FIELDS, SIZE, TYPE"),
        (b"SIZE 4 4 4", b"SIZE 4 4", "FIELDS, SIZE, TYPE"),
        (b"COUNT 1 1 1", b"COUNT 1 1 0", "COUNT"),
        (b"DATA binary", b"DATA brotli", "DATA"),
        (b"POINTS ", b"POINTS -", "POINTS"),
        (b"VIEWPOINT 0 0 0 1 0 0 0", b"VIEWPOINT 0 0 0 0 0 0 nan", "VIEWPOINT"),
        (b"SIZE 4 4 4\n", b"", "no SIZE line"),
    ],
)
def test_headers_that_lie(tmp_path, cloud, old, new, says):
    path = write_pcd(tmp_path / "bad.pcd", "binary", xyz_columns(cloud))
    data = path.read_bytes()
    assert old in data
    path.write_bytes(data.replace(old, new))
    with pytest.raises(InputError, match=says):
        open_survey(path)


def test_compressed_data_that_is_damaged(tmp_path, cloud):
    path = write_pcd(tmp_path / "a.pcd", "binary_compressed", xyz_columns(cloud))
    data = bytearray(path.read_bytes())
    start = data.index(b"binary_compressed\n") + 18 + 8
    data[start : start + 3] = b"\xff\xff\xff"  # a copy from before the beginning
    path.write_bytes(bytes(data))
    with pytest.raises(InputError, match="damaged"):
        open_survey(path)

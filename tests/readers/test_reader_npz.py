"""NPZ and NPY: names, orders and types; pickles, bombs and headers that lie are refused."""

from __future__ import annotations

import io
import zipfile

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.readers import open_survey
from tests.readers.reader_clouds import all_points, room

AS_IT_IS = InputConfig(unit="m", up="z")


@pytest.fixture
def cloud():
    return room(np.random.default_rng(5), density=8)


@pytest.mark.parametrize("save", [np.savez, np.savez_compressed])
@pytest.mark.parametrize("key", ["points", "xyz", "whatever"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_npz(tmp_path, cloud, save, key, order):
    ids = (np.arange(len(cloud)) // 9).astype(np.int64)
    path = tmp_path / "a.npz"
    save(path, **{key: np.asarray(cloud, order=order), "scan_id": ids, "note": np.array("hello")})
    survey = open_survey(path, config=AS_IT_IS)
    points, found = all_points(survey)
    np.testing.assert_allclose(points, cloud, atol=1e-5)
    np.testing.assert_array_equal(found, ids)
    assert survey.point_count == len(cloud)


@pytest.mark.parametrize("dtype", ["<f4", ">f8", "<f2"])
def test_npy(tmp_path, cloud, dtype):
    path = tmp_path / "a.npy"
    np.save(path, np.column_stack([cloud, cloud[:, 0]]).astype(dtype))
    points, _ = all_points(open_survey(path, config=AS_IT_IS))
    np.testing.assert_allclose(points, cloud, atol=5e-3 if dtype == "<f2" else 1e-5)


def test_pickles_are_refused(tmp_path):
    path = tmp_path / "evil.npz"
    np.savez(path, points=np.array([object()] * 3, dtype=object))
    with pytest.raises(InputError, match="pickled objects"):
        open_survey(path)


@pytest.mark.parametrize("arrays", [{"points": np.zeros((5, 2))}, {"a": np.zeros(5)}, {"s": np.array("x")}])
def test_no_points(tmp_path, arrays):
    path = tmp_path / "a.npz"
    np.savez(path, **arrays)
    with pytest.raises(InputError, match="no array of points"):
        open_survey(path)


def test_scan_ids_of_another_length(tmp_path, cloud):
    path = tmp_path / "a.npz"
    np.savez(path, points=cloud, scan_id=np.arange(3))
    with pytest.raises(InputError, match="'scan_id' has the shape"):
        open_survey(path)


def header_only(shape):
    buffer = io.BytesIO()
    np.lib.format.write_array_header_1_0(buffer, {"shape": shape, "fortran_order": False, "descr": "<f8"})
    return buffer.getvalue()


@pytest.mark.parametrize("packed", [True, False])
def test_absurd_shapes(tmp_path, packed):
    data = header_only((10**12, 3)) + b"\x00" * 512
    path = tmp_path / ("a.npz" if packed else "a.npy")
    if packed:
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("points.npy", data)
    else:
        path.write_bytes(data)
    with pytest.raises(InputError, match="truncated"):
        open_survey(path)


def test_bombs_are_refused(tmp_path):
    path = tmp_path / "bomb.npz"
    rows = (300 << 20) // 24
    with (
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive,
        archive.open("points.npy", "w") as member,
    ):
        member.write(header_only((rows, 3)))
        for _ in range(300):
            member.write(bytes(1 << 20))
    with pytest.raises(InputError, match="refused"):
        open_survey(path)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9, 0.99])
def test_truncated(tmp_path, cloud, share):
    path = tmp_path / "a.npz"
    np.savez_compressed(path, points=cloud)
    path.write_bytes(path.read_bytes()[: int(path.stat().st_size * share)])
    with pytest.raises(InputError, match=r"a\.npz"):
        open_survey(path)


def test_flipped_bytes_are_noticed(tmp_path, cloud):
    path = tmp_path / "a.npz"
    np.savez_compressed(path, points=cloud)
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 0xFF
    path.write_bytes(bytes(data))
    with pytest.raises(InputError, match="damaged"):
        open_survey(path)


def _voxels(*, solid: bool) -> np.ndarray:
    """Centres of the voxels of 0.1 m of a room, or of its surfaces."""
    box = np.indices((30, 40, 27)).reshape(3, -1).T
    surface = ((box == 0) | (box == np.array([29, 39, 26]))).any(axis=1)
    return (box if solid else box[surface]) * 0.1 + 5.05


def test_free_voxels_are_told_from_surfaces(tmp_path):
    np.savez(tmp_path / "free.npz", centers=_voxels(solid=True).astype(np.float32), res=0.1)
    with pytest.raises(InputError, match=r"free.npz lists voxels of 0.1 m that fill space, .* open the map"):
        open_survey(tmp_path / "free.npz", config=AS_IT_IS)
    np.savez(tmp_path / "walls.npz", centers=_voxels(solid=False).astype(np.float32), res=0.1)
    assert open_survey(tmp_path / "walls.npz", config=AS_IT_IS).point_count == len(_voxels(solid=False))


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("suffix", ["npy", "npz"])
def test_coordinates_row_by_row(tmp_path, cloud, order, suffix):
    path = tmp_path / f"a.{suffix}"
    rows = np.asarray(cloud.T, order=order)
    if suffix == "npy":
        np.save(path, rows)
    else:
        np.savez(path, xyz=rows, scan_id=np.arange(len(cloud)))
    points, ids = all_points(open_survey(path, config=AS_IT_IS))
    np.testing.assert_allclose(points, cloud, atol=1e-5)
    assert (ids is None) == (suffix == "npy")


def test_an_image_of_points(tmp_path, cloud):
    path = tmp_path / "a.npy"
    np.save(path, cloud[:1000].reshape(20, 50, 3))
    np.testing.assert_allclose(all_points(open_survey(path, config=AS_IT_IS))[0], cloud[:1000], atol=1e-5)
    np.save(path, np.zeros((20, 50, 3), np.uint8))  # a picture
    with pytest.raises(InputError, match="no array of points"):
        open_survey(path)


RECORDS = {
    "plain": [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("scan_id", "<i4")],
    "mixed": [("intensity", ">u2"), ("Z", ">f8"), ("Y", ">f8"), ("X", ">f8"), ("scan_id", "u1")],
    "whole": [("rgb", "u1", (3,)), ("xyz", "<f8", (3,)), ("scan_id", "<i8")],
}


@pytest.mark.parametrize("kind", RECORDS)
@pytest.mark.parametrize("align", [False, True])
@pytest.mark.parametrize("suffix", ["npy", "npz"])
def test_records(tmp_path, cloud, kind, align, suffix):
    records = np.zeros(len(cloud), np.dtype(RECORDS[kind], align=align))
    ids = np.arange(len(cloud)) // 40
    records["scan_id"] = ids
    if kind == "whole":
        records["xyz"] = cloud
    else:
        for axis, name in enumerate("xyz"):
            records[name if kind == "plain" else name.upper()] = cloud[:, axis]
    path = tmp_path / f"a.{suffix}"
    if suffix == "npy":
        np.save(path, records)
    else:
        np.savez_compressed(path, frames=records, poses=np.zeros((5, 7)))
    survey = open_survey(path, config=AS_IT_IS)
    points, found = all_points(survey)
    np.testing.assert_allclose(points, cloud, atol=1e-5)
    np.testing.assert_array_equal(found, ids)
    assert survey.point_count == len(cloud)


@pytest.mark.parametrize(
    "descr",
    [
        [("x", "<f4"), ("y", "<f4")],
        [("a", [("x", "<f4"), ("y", "<f4"), ("z", "<f4")])],
        [("x", "<U4"), ("y", "<U4"), ("z", "<U4")],
    ],
)
def test_records_without_coordinates(tmp_path, descr):
    np.save(tmp_path / "a.npy", np.zeros(9, descr))
    with pytest.raises(InputError, match="no array of points"):
        open_survey(tmp_path / "a.npy")


def test_records_of_absurd_size(tmp_path):
    header = {"shape": (9,), "fortran_order": False, "descr": [("x", "<f8", (10**9, 10**6))]}
    buffer = io.BytesIO()
    np.lib.format.write_array_header_1_0(buffer, header)
    (tmp_path / "a.npy").write_bytes(buffer.getvalue() + bytes(64))
    with pytest.raises(InputError, match="damaged"):
        open_survey(tmp_path / "a.npy")

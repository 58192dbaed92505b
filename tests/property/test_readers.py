"""Random bytes never do harm, and random clouds come back as they were."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from floorplan_core.config import InputConfig
from floorplan_core.errors import FloorPlanError
from floorplan_core.readers import open_survey
from floorplan_core.readers.trajectory import read_trajectory

AS_IT_IS = InputConfig(unit="m", up="z")
MEMORY = 64 << 20  # bytes; far above what a file of some kilobytes can need
HEADS = {
    ".ply": [
        b"ply\nformat binary_little_endian 1.0\nelement vertex 7\nproperty float x\nproperty float y\n"
        b"property double z\nproperty int scan_id\nend_header\n",
        b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        b"end_header\n",
        b"ply\nformat binary_big_endian 1.0\nelement face 9\nproperty list uchar int i\nelement vertex 2\n"
        b"property float x\nproperty float y\nproperty float z\nend_header\n",
        b"ply\nformat ascii 1.0\nelement vertex ",
    ],
    ".pcd": [
        b"# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 5\nHEIGHT 1\nPOINTS 5\n"
        b"DATA binary\n",
        b"# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 5\nHEIGHT 1\nDATA binary_compressed\n",
        b"# .PCD v0.7\nFIELDS x y z\nSIZE 4 8 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nDATA ascii\n",
        b"# .PCD v0.7\nFIELDS ",
    ],
    ".npz": [
        b"PK\x03\x04",
        b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'fortran_order': False, 'shape': (9, 3), }",
    ],
    ".npy": [b"\x93NUMPY\x01\x00", b"\x93NUMPY\x02\x00\x10\x00\x00\x00"],
    ".xyz": [b"1 2 3\n4 5 6\n7 8 9\n", b"9999999999\n1 2 3\n", b"x,y,z\n"],
    ".pts": [b"3\n"],
    ".ptx": [
        b"2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 0\n4 5 6 0\n",
    ],
    ".txt": [b"# ", b"0 0 0 0 0 0 0 1\n"],
    ".csv": [b"x;y;z\n1,0;2,0;3,0\n"],
    ".bin": [b""],
}
CASES = [(suffix, head) for suffix, heads in HEADS.items() for head in (b"", *heads)]
TEXT_LIKE = st.text(alphabet="0123456789 .,;-+eEnaif#/\nxyz", max_size=300).map(str.encode)


def read_all(path: Path) -> None:
    for _ in open_survey(path).chunks():
        pass


@pytest.mark.parametrize(("suffix", "head"), CASES)
@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(body=st.one_of(st.binary(max_size=400), TEXT_LIKE))
def test_random_bytes(tmp_path, suffix, head, body):
    path = tmp_path / f"random{suffix}"
    path.write_bytes(head + body)
    tracemalloc.start()
    try:
        read_all(path)
    except FloorPlanError as error:
        assert "\n" not in str(error)
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    assert peak < MEMORY


@settings(max_examples=250, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_damaged_files(tmp_path, data):
    """A good file cut anywhere, or with some bytes changed."""
    points = np.random.default_rng(0).uniform(0, 5, (200, 3)).astype("f4")
    kind = data.draw(st.sampled_from(["ply", "npz", "npy"]))
    path = tmp_path / f"a.{kind}"
    if kind == "npy":
        np.save(path, points)
    elif kind == "npz":
        np.savez_compressed(path, points=points, scan_id=np.arange(200))
    else:
        path.write_bytes(HEADS[".ply"][1].replace(b"ascii", b"binary_little_endian").replace(b"3", b"200", 1))
        path.write_bytes(path.read_bytes() + points.tobytes())
    raw = bytearray(path.read_bytes())
    last = data.draw(st.sampled_from([120, len(raw) - 1]))  # headers are where bytes matter most
    for _ in range(data.draw(st.integers(0, 4))):
        raw[data.draw(st.integers(0, last))] = data.draw(st.integers(0, 255))
    if data.draw(st.booleans()):
        raw = raw[: data.draw(st.integers(0, len(raw)))]
    path.write_bytes(bytes(raw))
    tracemalloc.start()
    try:
        read_all(path)
    except FloorPlanError as error:
        assert "\n" not in str(error)
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    assert peak < MEMORY


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(text=st.one_of(TEXT_LIKE, st.binary(max_size=200)))
def test_random_trajectories(tmp_path, text):
    path = tmp_path / "random.tum"
    path.write_bytes(text)
    try:
        trajectory = read_trajectory(path)
    except FloorPlanError as error:
        assert "\n" not in str(error)
    else:
        assert np.isfinite(trajectory.T_world_sensor).all()


CLOUDS = hnp.arrays(
    np.float32,
    st.tuples(st.integers(1, 60), st.just(3)),
    elements=st.floats(-900, 900, width=32, allow_subnormal=False),
)


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(cloud=CLOUDS, form=st.sampled_from(["ascii", "binary_little_endian", "binary_big_endian"]))
def test_random_clouds_come_back(tmp_path, cloud, form):
    path = tmp_path / "a.ply"
    head = HEADS[".ply"][1].replace(b"ascii", form.encode()).replace(b"vertex 3", b"vertex %d" % len(cloud))
    if form == "ascii":
        body = "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in cloud.tolist()).encode()
    else:
        body = cloud.astype(">f4" if "big" in form else "<f4").tobytes()
    path.write_bytes(head + body)
    chunks = list(open_survey(path, config=AS_IT_IS).chunks())
    np.testing.assert_array_equal(np.concatenate([c.points for c in chunks]), cloud)


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(cloud=CLOUDS, data=st.data())
def test_random_arrays_come_back(tmp_path, cloud, data):
    path = tmp_path / "a.npz"
    ids = np.arange(len(cloud))
    save = data.draw(st.sampled_from([np.savez, np.savez_compressed]))
    save(path, points=np.asarray(cloud, order=data.draw(st.sampled_from("CF"))), scan_id=ids)
    chunks = list(open_survey(path, config=AS_IT_IS).chunks())
    np.testing.assert_array_equal(np.concatenate([c.points for c in chunks]), cloud)
    np.testing.assert_array_equal(np.concatenate([c.scan_id for c in chunks]), ids)


@settings(max_examples=60)
@given(data=st.binary(max_size=500), size=st.integers(0, 2000))
def test_lzf_never_reads_or_writes_outside(data, size):
    from floorplan_core.readers.lzf import decompress

    out = decompress(np.frombuffer(data, np.uint8), size)
    assert out is None or len(out) == size


@settings(max_examples=60)
@given(data=st.binary(max_size=500))
def test_lzf_literals_come_back(data):
    from floorplan_core.readers.lzf import decompress

    runs = (data[k : k + 32] for k in range(0, len(data), 32))
    packed = b"".join(bytes([len(run) - 1]) + run for run in runs)
    out = decompress(np.frombuffer(packed, np.uint8), len(data))
    assert out is not None
    assert out.tobytes() == data
